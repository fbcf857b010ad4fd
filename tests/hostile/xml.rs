//! The text of scene files: entities, encodings, nesting, includes, names.

use crate::common::case::{Case, LIGHT, ball};
use crate::common::scene;

/// Files each of which includes the next.
const NAMES: [&str; 17] = [
    "0.xml", "1.xml", "2.xml", "3.xml", "4.xml", "5.xml", "6.xml", "7.xml", "8.xml", "9.xml",
    "10.xml", "11.xml", "12.xml", "13.xml", "14.xml", "15.xml", "16.xml",
];

pub(super) fn cases() -> Vec<Case> {
    let whole = |what, exit, says, text: &str| Case::new(what, exit, says).file("scene.xml", text);
    let refused = |what, says, body: &str| Case::scene(what, 3, says, body);
    let document_type = |what, declaration: &str| {
        let text = format!("<!DOCTYPE scene {declaration}>\n{}", scene("&x;"));
        Case::new(what, 3, &["scene.xml:1:", "document type declarations and entities"])
            .file("scene.xml", text)
            .file("secret", "the secret")
    };
    let mut cases = vec![
        document_type("external entity", "[<!ENTITY x SYSTEM \"secret\">]"),
        document_type("external entity of a URL", "[<!ENTITY x SYSTEM \"http://localhost/x\">]"),
        document_type("external document type", "SYSTEM \"secret\""),
        document_type("parameter entity", "[<!ENTITY % x SYSTEM \"secret\"> %x;]"),
        document_type(
            "entities that multiply",
            "[<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\"><!ENTITY x \"&b;&b;&b;&b;&b;\">]",
        ),
        whole("undefined entity", 3, &["scene.xml:3:", "not well-formed"], &scene("&x;")),
        whole("NUL", 3, &["scene.xml:3:", "not well-formed"], &scene("\0")),
        whole("control character", 3, &["scene.xml:3:", "not well-formed"], &scene("\u{1b}[2J")),
        whole("control character by its number", 3, &["not well-formed"], &scene("&#27;[2J")),
        whole("text that is cut off", 3, &["not well-formed"], scene(LIGHT).split_at(90).0),
        Case::new("another encoding", 3, &["scene.xml:3", "not UTF-8"]).file(
            "scene.xml",
            scene("<bsdf type=\"diffuse\" id=\"\u{fe}\"/>")
                .replace('þ', "\u{1}")
                .into_bytes()
                .iter()
                .map(|&b| if b == 1 { 0xfe } else { b })
                .collect::<Vec<u8>>(),
        ),
        Case::new("UTF-16, big endian", 3, &["UTF-16"]).file("scene.xml", [0xfe, 0xff, 0, b'<']),
        Case::new("compressed file", 3, &["not UTF-8"])
            .file("scene.xml", [0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 3, 0xff, 0xff]),
        whole("version 1e99", 3, &["scene.xml:1:1", "version"], "<scene version=\"1e99\"/>"),
        whole("version of 10¹⁰", 3, &["version"], "<scene version=\"10000000000.0\"/>"),
        refused("scene in a scene", &["scene.xml:3:"], "<scene version=\"3.0.0\"/>"),
        refused(
            "value in a value",
            &["cannot stand inside"],
            &ball("<float name=\"radius\" value=\"1\"><float name=\"x\" value=\"1\"/></float>"),
        ),
        refused(
            "plugin in a value",
            &["cannot stand inside"],
            &ball("<float name=\"radius\" value=\"1\"><bsdf type=\"diffuse\"/></float>"),
        ),
        refused(
            "parameter given twice",
            &["scene.xml:6:1", "“radius” is given twice", "scene.xml:5:1"],
            &ball("<float name=\"radius\" value=\"1\"/>\n<float name=\"radius\" value=\"2\"/>"),
        ),
        refused(
            "attribute given twice",
            &["scene.xml:5:", "not well-formed"],
            &ball("<float name=\"radius\" name=\"radius\" value=\"1\"/>"),
        ),
        refused(
            "65 attributes",
            &["scene.xml:5:1", "more than 64 attributes"],
            &ball(&format!(
                "<float {}/>",
                (0..65).map(|i| format!("a{i}=\"\" ")).collect::<String>()
            )),
        ),
        refused(
            "name of a megabyte",
            &["has no parameter", "xxxx … xxxx"],
            &ball(&format!("<float name=\"{}\" value=\"1\"/>", "x".repeat(1 << 20))),
        ),
        refused(
            "number of a megabyte",
            &["scene.xml:5:1", "finite number"],
            &ball(&format!("<float name=\"radius\" value=\"1{}\"/>", "0".repeat(1 << 20))),
        ),
        refused(
            "id of a megabyte that is not there",
            &["nothing has the id"],
            &ball(&format!("<ref id=\"{}\"/>", "x".repeat(1 << 20))),
        ),
        refused(
            "marks that turn the direction of text",
            &["\\u{202e}"],
            "<bsdf type=\"diffuse\u{202e}\"/>",
        ),
        refused("empty type", &["scene.xml:3:1", "“”"], "<shape type=\"\"/>"),
        refused("empty id", &["nothing has the id “”"], &ball("<ref id=\"\"/>")),
        refused(
            "dollar sign by itself",
            &["scene.xml:5:", "$ is not defined"],
            &ball("<float name=\"radius\" value=\"$\"/>"),
        ),
        refused("alias of itself", &["there is no “a” before"], "<alias id=\"a\" as=\"a\"/>"),
        refused(
            "texture inside itself",
            &["circle"],
            "<texture type=\"checkerboard\" id=\"a\"><ref name=\"color0\" id=\"a\"/></texture>",
        ),
        refused(
            "merged shape inside itself",
            &["circle"],
            "<shape type=\"merge\" id=\"a\"><ref id=\"a\"/></shape>",
        ),
        refused(
            "group inside itself",
            &["circle"],
            "<shape type=\"shapegroup\" id=\"a\"><shape type=\"merge\"><ref id=\"a\"/></shape></shape>",
        ),
        refused(
            "group that holds its own instance",
            &["circle"],
            "<shape type=\"shapegroup\" id=\"a\"><shape type=\"instance\"><ref id=\"a\"/></shape></shape>",
        ),
        refused(
            "phase function inside itself",
            &["circle"],
            "<phase type=\"blendphase\" id=\"a\"><ref id=\"a\"/><ref id=\"a\"/></phase>",
        ),
        refused(
            "material as a texture",
            &["scene.xml:3:1", "the bsdf “diffuse” is not supported"],
            &format!(
                "<bsdf type=\"diffuse\" id=\"a\"/>\n{}",
                ball("<bsdf type=\"diffuse\"><ref name=\"reflectance\" id=\"a\"/></bsdf>")
            ),
        ),
        refused(
            "instance of no group",
            &["needs a shapegroup"],
            "<shape type=\"sphere\" id=\"a\"/><shape type=\"instance\"><ref id=\"a\"/></shape>",
        ),
        refused("instance of nothing", &["no shapegroup"], "<shape type=\"instance\"/>"),
        refused(
            "group of instances",
            &["cannot contain instances"],
            "<shape type=\"shapegroup\" id=\"a\"><shape type=\"sphere\"/></shape><shape type=\"shapegroup\"><shape type=\"instance\"><ref id=\"a\"/></shape></shape>",
        ),
        refused(
            "group of groups",
            &["cannot contain groups"],
            "<shape type=\"shapegroup\"><shape type=\"shapegroup\"><shape type=\"sphere\"/></shape></shape>",
        ),
        refused(
            "group that shines",
            &["cannot contain emitters"],
            "<shape type=\"shapegroup\"><shape type=\"sphere\"><emitter type=\"area\"/></shape></shape>",
        ),
        Case::scene(
            "two integrators",
            3,
            &["scene.xml:3:26", "more than one integrator"],
            "<integrator type=\"path\"/><integrator type=\"path\"/>",
        ),
        Case::new("included file is no scene", 3, &["b.xml:1:1"])
            .file("scene.xml", scene("<include filename=\"b.xml\"/>"))
            .file("b.xml", "<svg version=\"3.0.0\"/>"),
        Case::new("included file is not XML", 3, &["b.xml:1:1", "not well-formed"])
            .file("scene.xml", scene("<include filename=\"b.xml\"/>"))
            .file("b.xml", "v 0 0 0"),
        Case::new("file that includes itself", 3, &["includes itself"])
            .file("scene.xml", scene("<include filename=\"scene.xml\"/>")),
        Case::scene(
            "folder that is a file",
            3,
            &["there is no folder"],
            "<path value=\"scene.xml\"/>",
        ),
        Case::scene("65 folders", 5, &["more than 64 folders"], &"<path value=\".\"/>".repeat(65)),
        Case::scene("nothing but a light", 0, &["there are no shapes"], LIGHT),
    ];
    let nested = |count: usize| {
        let begin = "<bsdf type=\"twosided\">".repeat(count);
        ball(&format!("{begin}{}", "</bsdf>".repeat(count)))
    };
    let unknown = format!("{}{}", "<a>".repeat(100_000), "</a>".repeat(100_000));
    cases.extend([
        Case::scene("plugins nested 70 deep", 5, &["scene.xml:5:", "64 deep"], &nested(70)),
        Case::scene("plugins nested 10⁵ deep", 5, &["scene.xml:5:", "64 deep"], &nested(100_000)),
        Case::scene("elements nested 10⁵ deep", 3, &["unknown element <a>"], &unknown),
    ]);
    let chain: String = (1..200)
        .map(|i| format!("<bsdf type=\"mask\" id=\"b{i}\"><ref id=\"b{}\"/></bsdf>\n", i - 1))
        .collect();
    cases.push(Case::scene(
        "chain of 200 references",
        5,
        &["more than 128 plugins"],
        &format!("<bsdf type=\"diffuse\" id=\"b0\"/>\n{chain}"),
    ));
    let mut deep = Case::new("includes 17 deep", 3, &["too deeply"])
        .file("scene.xml", scene("<include filename=\"0.xml\"/>"));
    for (i, name) in NAMES.into_iter().enumerate() {
        let next =
            format!("<scene version=\"3.0.0\"><include filename=\"{}.xml\"/></scene>", i + 1);
        deep = deep.file(name, next);
    }
    cases.push(deep);
    cases
}
