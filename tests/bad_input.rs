//! Input that is wrong: one message with its place, the exit code that the documentation promises, and nothing left behind. Input
//! that means harm is in `hostile`.

mod common;

use common::Folder;
use common::case::{Case, LIGHT, RENDER, ball, check, material, messages};

#[test]
fn scene_files_that_cannot_be_read_are_input_errors() {
    check([Case::new("missing scene", 4, &["scene.xml", "cannot read"])]);
    let folder = Folder::new();
    std::fs::create_dir(folder.path("scene.xml")).expect("a writable folder");
    let outcome = folder.run(&RENDER);
    assert_eq!(outcome.exit, Some(4), "{}", outcome.stderr);
    assert_eq!(messages(&outcome, 4, &["scene.xml"]), None, "{}", outcome.stderr);
    assert_eq!(folder.names(), ["scene.xml"]);
}

#[test]
fn malformed_scene_files_are_refused_with_line_and_column() {
    let whole = |what, says, text: &str| Case::new(what, 3, says).file("scene.xml", text);
    check([
        whole("empty file", &["scene.xml"], ""),
        whole("not XML", &["scene.xml:1:1"], "v 0 0 0\n"),
        whole(
            "unclosed element",
            &["scene.xml:3:", "not well-formed"],
            "<scene version=\"3.0.0\">\n  <shape type=\"sphere\">\n</scene>\n",
        ),
        whole("another root", &["scene.xml:2:1", "<scene>"], "\n<svg version=\"3.0.0\"/>"),
        whole("no version", &["scene.xml:1:1", "version"], "<scene/>"),
        Case::new("UTF-16", 3, &["scene.xml", "UTF-16"]).file("scene.xml", [0xff, 0xfe, b'<', 0]),
        Case::scene(
            "unknown element",
            3,
            &["scene.xml:3:3", "<shap>", "did you mean <shape>?"],
            "  <shap type=\"sphere\"/>",
        ),
        Case::scene(
            "unknown attribute",
            3,
            &["scene.xml:3:", "“typ”"],
            "<shape type=\"sphere\" typ=\"x\"/>",
        ),
        Case::scene(
            "nameless parameter",
            3,
            &["scene.xml:5:1", "“name”"],
            &ball("<float value=\"1\"/>"),
        ),
        Case::scene(
            "word for a number",
            3,
            &["scene.xml:5:1", "“one”"],
            &ball("<float name=\"radius\" value=\"one\"/>"),
        ),
    ]);
}

#[test]
fn what_is_not_supported_is_named_beside_what_is() {
    check([
        Case::scene(
            "unknown shape",
            3,
            &["scene.xml:3:1", "“torus”", "sphere", "rectangle"],
            "<shape type=\"torus\"/>",
        ),
        Case::scene(
            "unknown emitter",
            3,
            &["scene.xml:3:1", "“sunsky”", "envmap"],
            "<emitter type=\"sunsky\"/>",
        ),
        material(
            "unknown bsdf",
            3,
            &["scene.xml:5:1", "“velvet”", "roughconductor"],
            "<bsdf type=\"velvet\"/>",
        ),
        material(
            "misspelt bsdf",
            3,
            &["scene.xml:5:1", "did you mean “diffuse”?"],
            "<bsdf type=\"difuse\"/>",
        ),
        material(
            "unknown parameter",
            3,
            &["scene.xml:6:1", "“reflectence”", "did you mean “reflectance”?"],
            "<bsdf type=\"diffuse\">\n<float name=\"reflectence\" value=\"0.5\"/></bsdf>",
        ),
        material(
            "unknown parameter, lenient",
            0,
            &["scene.xml:6:1", "“reflectence”"],
            "<bsdf type=\"diffuse\">\n<float name=\"reflectence\" value=\"0.5\"/></bsdf>",
        )
        .with(&["--lenient"]),
        material(
            "unknown metal",
            3,
            &["scene.xml:5:", "“Unobtainium”", "Au"],
            "<bsdf type=\"conductor\"><string name=\"material\" value=\"Unobtainium\"/></bsdf>",
        ),
    ]);
}

#[test]
fn names_that_do_not_resolve_are_refused_where_they_stand() {
    let cyclic = "<scene version=\"3.0.0\">\n<include filename=\"b.xml\"/>\n</scene>";
    check([
        Case::new("include cycle", 3, &["b.xml:2:1", "includes itself"])
            .file("scene.xml", cyclic)
            .file("b.xml", cyclic.replace("b.xml", "scene.xml")),
        Case::scene(
            "missing include",
            4,
            &["b.xml", "scene.xml:3:1"],
            "<include filename=\"b.xml\"/>",
        ),
        Case::scene(
            "undefined name",
            3,
            &["scene.xml:5:", "$albedo", "-D albedo="],
            &ball("<float name=\"radius\" value=\"$albedo\"/>"),
        ),
        Case::scene("unused definition", 3, &["size=3"], LIGHT).with(&["-D", "size=3"]),
        Case::scene(
            "id taken twice",
            3,
            &["scene.xml:4:1", "“a”", "scene.xml:3:1"],
            "<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>",
        ),
        Case::scene(
            "dangling reference",
            3,
            &["scene.xml:6:1", "“grey”", "did you mean “gray”?"],
            "<bsdf type=\"diffuse\" id=\"gray\"/>\n<emitter type=\"constant\"/>\n\
             <shape type=\"sphere\">\n<ref id=\"grey\"/></shape>",
        ),
        Case::scene(
            "plugins in a circle",
            3,
            &["scene.xml:3:1", "circle"],
            "<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf>\n\
             <bsdf type=\"twosided\" id=\"b\"><ref id=\"a\"/></bsdf>",
        ),
    ]);
}

#[test]
fn compensation_without_tables_is_refused() {
    let rough = |plugin, parameters: &str| {
        format!(
            "<bsdf type=\"{plugin}\">\n<string name=\"multiple_scattering\" value=\"{parameters}</bsdf>"
        )
    };
    let says: &[&str] = &["scene.xml:6:1", "multiple_scattering"];
    check([
        material("unknown", 3, says, &rough("roughconductor", "heitz\"/>")),
        material("Walter's fit", 3, says, &rough("roughconductor", "turquin\"/>")),
        material(
            "anisotropic",
            3,
            says,
            &rough(
                "roughconductor",
                "kulla-conty\"/><string name=\"distribution\" value=\"ggx\"/><float name=\"alpha_u\" value=\"0.1\"/><float name=\"alpha_v\" value=\"0.2\"/>",
            ),
        ),
        material(
            "Turquin's glass",
            3,
            &["scene.xml:6:1", "“turquin”", "kulla-conty"],
            &rough("roughdielectric", "turquin\"/><string name=\"distribution\" value=\"ggx\"/>"),
        ),
        material(
            "with dispersion",
            3,
            &["scene.xml:6:1", "dispersion"],
            &rough(
                "roughdielectric",
                "kulla-conty\"/><string name=\"distribution\" value=\"ggx\"/><string name=\"glass\" value=\"F2\"/>",
            ),
        ),
    ]);
}

#[test]
fn dispersion_that_is_no_index_is_refused() {
    let glass = |parameters: &str| format!("<bsdf type=\"dielectric\">{parameters}</bsdf>");
    let string = |name, value| glass(&format!("<string name=\"{name}\" value=\"{value}\"/>"));
    let both = "<string name=\"glass\" value=\"F2\"/><float name=\"int_ior\" value=\"1.5\"/>";
    check([
        material(
            "misspelt glass",
            3,
            &["scene.xml:5:", "“N-SF1”", "did you mean “N-SF10”"],
            &string("glass", "N-SF1"),
        ),
        material("glass and index", 3, &["scene.xml:5:", "“glass” or “int_ior”"], &glass(both)),
        material(
            "Abbe number 0",
            3,
            &["scene.xml:5:", "“abbe”", "positive"],
            &glass("<float name=\"abbe\" value=\"0\"/>"),
        ),
        material(
            "one coefficient",
            3,
            &["scene.xml:5:", "“cauchy”", "µm²"],
            &string("cauchy", "1.5"),
        ),
        material("no number", 3, &["scene.xml:5:", "“x”"], &string("cauchy", "1.5, x")),
        material(
            "half a resonance",
            3,
            &["scene.xml:5:", "“sellmeier”", "pairs"],
            &string("sellmeier", "1 0.01 2"),
        ),
        material(
            "resonance in the visible",
            3,
            &["scene.xml:5:", "nm"],
            &string("sellmeier", "1, 0.25"),
        ),
    ]);
}

/// The scene does not exist: that the message is about the output shows that the output was looked
/// at before anything else.
fn output(
    what: &'static str,
    exit: i32,
    says: &'static [&'static str],
    path: &'static str,
) -> Case {
    let case = Case::new(what, exit, says);
    Case { arguments: vec!["render", "missing.xml", "-o", path, "--quiet"], ..case }
}

#[test]
fn outputs_that_cannot_be_written_are_refused_before_the_scene_is_read() {
    check([
        output("missing folder", 4, &["no/such/out.pfm", "cannot write"], "no/such/out.pfm"),
        output("unknown extension", 2, &["out.gif", "*.exr"], "out.gif"),
        output("no extension", 2, &["out", "*.exr"], "out"),
    ]);
    let folder = Folder::new();
    std::fs::create_dir(folder.path("out.pfm")).expect("a writable folder");
    let outcome = folder.run(&["render", "missing.xml", "-o", "out.pfm"]);
    assert_eq!(outcome.exit, Some(4), "{}", outcome.stderr);
    assert_eq!(messages(&outcome, 4, &["out.pfm", "directory"]), None, "{}", outcome.stderr);
}

/// Permissions do not bind the superuser, but nobody creates files in `/proc`.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_takes_no_files_is_refused_before_the_scene_is_read() {
    check([output("/proc", 4, &["/proc/out.pfm", "cannot write"], "/proc/out.pfm")]);
}

#[cfg(unix)]
#[test]
fn a_read_only_file_is_not_replaced() {
    let folder = Folder::new();
    folder.write("out.pfm", "precious");
    let mut permissions = std::fs::metadata(folder.path("out.pfm")).expect("a file").permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(folder.path("out.pfm"), permissions).expect("an own file");
    let outcome = folder.run(&["render", "missing.xml", "-o", "out.pfm"]);
    assert_eq!(outcome.exit, Some(4), "{}", outcome.stderr);
    assert_eq!(messages(&outcome, 4, &["out.pfm", "read-only"]), None, "{}", outcome.stderr);
}

#[test]
fn wrong_command_lines_are_usage_errors() {
    let usage =
        |what, says, arguments: &[&'static str]| Case::scene(what, 2, says, LIGHT).with(arguments);
    let other = |what, says, arguments: &[&'static str]| Case {
        arguments: arguments.to_vec(),
        ..Case::new(what, 2, says)
    };
    let mut cases = vec![
        usage("size 0x0", &["0x0"], &["--size", "0x0"]),
        usage("size with one number", &["WIDTHxHEIGHT"], &["--size", "640"]),
        usage("crop outside the film", &["crop"], &["--crop", "3,3,2,2"]),
        usage("empty crop", &["crop"], &["--crop", "0,0,0,0"]),
        usage("threads 0", &["--threads"], &["--threads", "0"]),
        usage("max-depth -2", &["--max-depth"], &["--max-depth", "-2"]),
        usage("unknown sampler", &["--sampler", "halton"], &["--sampler", "halton"]),
        usage("exposure NaN", &["--exposure"], &["--exposure", "nan"]),
        usage("definition without a value", &["NAME=VALUE"], &["-D", "x"]),
        usage("unknown option", &["--glow"], &["--glow"]),
        other("no output", &["required"], &["render", "scene.xml"]),
        other("unknown command", &["draw"], &["draw"]),
    ];
    // RENDER sets the number of samples itself.
    let spp = ["render", "scene.xml", "-o", "out.pfm", "--spp", "0"];
    cases.push(other("spp 0", &["--spp"], &spp));
    check(cases);
}
