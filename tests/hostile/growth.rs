//! Small files that ask for more memory or time than there is, and large ones that must not take more than in proportion.

use crate::common::case::{Case, LIGHT, ball};
use crate::common::scene;

/// `count` lines made of their numbers.
fn lines(count: usize, line: impl Fn(usize) -> String) -> String {
    (0..count).map(line).collect::<Vec<_>>().join("\n")
}

/// Plugins each of which refers twice to the one before, `first` being the first: 2⁶⁰ of them if they were written out.
fn doubling(first: &str, line: impl Fn(usize) -> String) -> String {
    format!("{first}\n{}", lines(60, |i| line(i + 1)))
}

pub(super) fn cases() -> Vec<Case> {
    let refused = |what, says, body: &str| Case::scene(what, 5, says, body);
    let rendered = |what, body: &str| {
        Case::scene(what, 0, &[], &format!("{LIGHT}<shape type=\"sphere\"/>{body}"))
    };
    let defined = |i: usize| {
        let value = format!("$a{}$a{}", i - 1, i - 1);
        format!("<default name=\"a{i}\" value=\"{value}\"/>")
    };
    let blends = doubling("<bsdf type=\"diffuse\" id=\"a0\"/>", |i| {
        let part = format!("<ref id=\"a{}\"/>", i - 1);
        format!(
            "<bsdf type=\"blendbsdf\" id=\"a{i}\"><float name=\"weight\" value=\"0.5\"/>{part}{part}</bsdf>"
        )
    });
    let merges = doubling("<shape type=\"sphere\" id=\"a0\"/>", |i| {
        let part = format!("<ref id=\"a{}\"/>", i - 1);
        format!("<shape type=\"merge\" id=\"a{i}\">{part}{part}</shape>")
    });
    let phases = doubling("<phase type=\"isotropic\" id=\"a0\"/>", |i| {
        let part = format!("<ref id=\"a{}\"/>", i - 1);
        format!("<phase type=\"blendphase\" id=\"a{i}\">{part}{part}</phase>")
    });
    let in_medium = "<medium type=\"homogeneous\" name=\"interior\"><ref id=\"a60\"/></medium>";
    let checkers = doubling("<texture type=\"checkerboard\" id=\"a0\"/>", |i| {
        let part = |name| format!("<ref name=\"{name}\" id=\"a{}\"/>", i - 1);
        format!(
            "<texture type=\"checkerboard\" id=\"a{i}\">{}{}</texture>",
            part("color0"),
            part("color1")
        )
    });
    let textured = "<bsdf type=\"diffuse\"><ref name=\"reflectance\" id=\"a60\"/></bsdf>";
    let names = lines(50_000, |i| format!("<default name=\"n{i}\" value=\"{i}\"/>"));
    let uses = lines(50_000, |i| format!("<default name=\"m{i}\" value=\"$n{i}\"/>"));
    let grid: String = (0..101 * 101).map(|i| format!("v {} {} 0\n", i % 101, i / 101)).collect();
    let faces = lines(100 * 100, |i| {
        let first = 101 * (i / 100) + i % 100 + 1;
        format!("f {first} {} {}", first + 1, first + 101)
    });
    let instances = lines(5_000, |i| {
        let shift = format!("<transform name=\"to_world\"><translate z=\"-{i}\"/></transform>");
        format!("<shape type=\"instance\"><ref id=\"a\"/>{shift}</shape>")
    });
    let group = "<shape type=\"shapegroup\" id=\"a\"><shape type=\"obj\"><string name=\"filename\" value=\"mesh.obj\"/></shape></shape>";
    vec![
        refused(
            "definitions that double",
            &["scene.xml:", "grow beyond 1048576 bytes"],
            &format!("<default name=\"a0\" value=\"xxxxxxxx\"/>\n{}", lines(60, |i| defined(i + 1))),
        ),
        refused(
            "definition of half a megabyte, used a thousand times",
            &["grow beyond 67108864 bytes"],
            &format!(
                "<default name=\"a\" value=\"{}\"/>\n{}",
                "x".repeat(500_000),
                lines(1000, |i| format!("<default name=\"b{i}\" value=\"$a\"/>"))
            ),
        ),
        Case::scene("blends that double", 3, &["scene.xml:", "4096 are possible"], &blends),
        refused("merged shapes that double", &["scene.xml:", "without end"], &merges),
        refused(
            "phase functions that double",
            &["scene.xml:", "without end"],
            &format!("<integrator type=\"volpath\"/>{phases}{}", ball(in_medium)),
        ),
        rendered("checkerboards that double", &format!("{checkers}{}", ball(textured))),
        rendered("5·10⁴ definitions, each used", &format!("{names}\n{uses}")),
        rendered("10⁵ plugins in one line", &"<bsdf type=\"diffuse\"/>".repeat(100_000)),
        rendered("10⁵ CDATA sections", &format!("<bsdf type=\"diffuse\">{}</bsdf>", "<![CDATA[a]]>b".repeat(100_000))),
        rendered("a megabyte of entities", &format!("<bsdf type=\"diffuse\">{}</bsdf>", "&amp;".repeat(200_000))),
        rendered("8 MB of comments", &"<!-- x -->".repeat(800_000)),
        Case::scene(
            "10⁵ parameters of one plugin",
            3,
            &["scene.xml:5:1", "no parameter “p0”"],
            &ball(&lines(100_000, |i| format!("<float name=\"p{i}\" value=\"1\"/>"))),
        ),
        Case::scene(
            "10⁵ unknown parameters, lenient",
            0,
            &["no parameter “p0”", "more warnings"],
            &ball(&lines(100_000, |i| format!("<float name=\"p{i}\" value=\"1\"/>"))),
        )
        .with(&["--lenient"]),
        Case::scene(
            "10⁵ references to nothing, lenient",
            0,
            &["nothing has the id “x0”", "more warnings"],
            &format!("{LIGHT}{}", lines(100_000, |i| format!("<ref id=\"x{i}\"/>"))),
        )
        .with(&["--lenient"]),
        rendered(
            "10⁵ references to one material",
            &format!("<bsdf type=\"diffuse\" id=\"a\"/>{}", "<ref id=\"a\"/>".repeat(100_000)),
        ),
        rendered(
            "5·10⁷ triangles by instancing",
            &format!("{group}{instances}"),
        )
        .file("mesh.obj", format!("{grid}{faces}\n")),
        refused(
            "5000 includes",
            &["more than 4096 files"],
            &"<include filename=\"b.xml\"/>".repeat(5000),
        )
        .file("b.xml", "<scene version=\"3.0.0\"/>"),
        refused(
            "a megabyte, included 300 times",
            &["scene.xml:3:", "more than 268435456 bytes"],
            &"<include filename=\"b.xml\"/>".repeat(300),
        )
        .file("b.xml", format!("<scene version=\"3.0.0\"><!--{}--></scene>", " ".repeat(1 << 20))),
        Case::new("spectrum of 10⁵ lines", 0, &[])
            .file("scene.xml", scene("<emitter type=\"constant\"><spectrum name=\"radiance\" filename=\"a.spd\"/></emitter><shape type=\"sphere\"/>"))
            .file("a.spd", lines(100_000, |i| format!("{} 1", 400.0 + 3e-3 * i as f64))),
        Case::scene(
            "10⁵ keyframes",
            0,
            &[],
            &format!(
                "{LIGHT}<shape type=\"sphere\"><animation name=\"to_world\">{}</animation></shape>",
                lines(100_000, |i| format!("<transform time=\"{i}\"/>"))
            ),
        ),
    ]
}
