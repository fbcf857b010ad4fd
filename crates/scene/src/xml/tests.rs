//! Tests of the description as a whole.

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use std::path::Path;

use etendue_math::glam::{DMat4, DVec3};

use super::*;
use crate::load::Sandbox;
use crate::{ErrorKind, SceneError};

fn parse_version(version: &str, content: &str) -> Result<Description, SceneError> {
    let text = format!("<scene version=\"{version}\">\n{content}\n</scene>");
    parse_text(&text, Path::new("scene.xml"), &[], Leniency::Strict)
}

fn parse(content: &str) -> Result<Description, SceneError> {
    parse_version("3.0.0", content)
}

/// The parameters of the only plugin in the scene.
fn properties(content: &str) -> Vec<(String, Value)> {
    let description = parse(&format!("<bsdf type=\"x\">{content}</bsdf>")).unwrap();
    let child = description.root().children[0].node;
    let all = description.node(child).properties.iter();
    all.map(|p| (p.name.clone(), p.value.clone())).collect()
}

fn value(element: &str) -> Value {
    properties(element).remove(0).1
}

fn transform(operations: &str) -> DMat4 {
    match value(&format!("<transform name=\"t\">{operations}</transform>")) {
        Value::Transform(matrix) => matrix,
        other => panic!("{other:?}"),
    }
}

/// Asserts that `content`, whose first line is line 2 of the file, is refused there.
fn refused(content: &str, line: u32, fragment: &str) {
    let error = parse(content).expect_err(content);
    assert!(error.to_string().contains(fragment), "{error}");
    assert_eq!(error.location.line, Some(line), "{error}");
    assert_eq!(error.location.file, Path::new("scene.xml"));
}

#[test]
fn values_of_every_type_are_read() {
    for (element, expected) in [
        (r#"<boolean name="a" value="True"/>"#, Value::Boolean(true)),
        (r#"<integer name="a" value=" -3 "/>"#, Value::Integer(-3)),
        (r#"<float name="a" value="1e-3"/>"#, Value::Float(0.001)),
        (r#"<string name="a" value="x y"/>"#, Value::String("x y".into())),
        (r#"<vector name="a" value="1, 2 3"/>"#, Value::Vector(DVec3::new(1.0, 2.0, 3.0))),
        (r#"<point name="a" x="1" y="2" z="3"/>"#, Value::Vector(DVec3::new(1.0, 2.0, 3.0))),
        (r#"<rgb name="a" value="0.1 0.2, 0.3"/>"#, Value::Rgb([0.1, 0.2, 0.3])),
        (r#"<rgb name="a" value="0.5"/>"#, Value::Rgb([0.5; 3])),
        (r##"<rgb name="a" value="#ff3300"/>"##, Value::Rgb([1.0, 0.2, 0.0])),
        (r#"<spectrum name="a" value="0.25"/>"#, Value::Spectrum(SpectrumValue::Uniform(0.25))),
        (
            r#"<spectrum name="a" value="400:1, 500:2 600:3"/>"#,
            Value::Spectrum(SpectrumValue::Samples(Vec::from([
                (400.0, 1.0),
                (500.0, 2.0),
                (600.0, 3.0),
            ]))),
        ),
    ] {
        assert_eq!(value(element), expected, "{element}");
    }
}

#[test]
fn malformed_values_are_refused() {
    for (element, fragment) in [
        (r#"<boolean name="a" value="yes"/>"#, "“yes” is not a boolean"),
        (r#"<integer name="a" value="1.5"/>"#, "“1.5” is not a whole number"),
        (r#"<float name="a" value="NaN"/>"#, "“NaN” is not a finite number"),
        (r#"<float name="a" value=""/>"#, "“” is not a finite number"),
        (r#"<vector name="a" value="1 2"/>"#, "“1 2” is not a number or three numbers"),
        (r#"<vector name="a" x="1" y="2"/>"#, "<vector> needs the attribute “z”"),
        (r#"<point name="a" value="1" x="2"/>"#, "cannot stand beside"),
        (r##"<rgb name="a" value="#12345"/>"##, "not a colour of the form #rrggbb"),
        (r##"<rgb name="a" value="#+12345"/>"##, "not a colour of the form #rrggbb"),
        (r#"<spectrum name="a" value="400:1"/>"#, "two wavelengths or more"),
        (r#"<spectrum name="a" value="500:1 400:2"/>"#, "wavelength 400 does not lie above 500"),
        (r#"<spectrum name="a" value="400-1 500:2"/>"#, "“400-1” is not a wavelength:value"),
        (r#"<spectrum name="a"/>"#, "needs either “value” or “filename”"),
        (r#"<float value="1"/>"#, "<float> needs the attribute “name”"),
        (r#"<float name="a" value="1" unit="m"/>"#, "<float> has no attribute “unit”"),
        (r#"<float name="a" value="1"><float/></float>"#, "cannot stand inside <float>"),
        (r#"<flaot name="a" value="1"/>"#, "did you mean <float>?"),
        (r#"<blackbody name="a" temperature="5"/>"#, "unknown element <blackbody>"),
        (r#"<translate x="1"/>"#, "can only stand inside <transform>"),
    ] {
        refused(&format!("<bsdf type=\"x\">\n  {element}\n</bsdf>"), 3, fragment);
    }
}

#[test]
fn later_operations_of_a_transform_are_applied_after_earlier_ones() {
    let m = transform(r#"<scale value="2"/><translate x="1"/><rotate z="1" angle="90"/>"#);
    assert!(m.transform_point3(DVec3::X).abs_diff_eq(DVec3::new(0.0, 3.0, 0.0), 1e-15)); // the rounding of cos 90°
    let m = transform(r#"<scale x="2" y="3"/><matrix value="0 1 0 1 0 0 0 0 1"/>"#);
    assert_eq!(m.transform_point3(DVec3::ONE), DVec3::new(3.0, 2.0, 1.0));
    let m = transform(r#"<lookat origin="1, 2, 3" target="1 2 4" up="0, 1, 0"/>"#);
    assert_eq!(m, DMat4::from_translation(DVec3::new(1.0, 2.0, 3.0)));
    assert_eq!(transform(""), DMat4::IDENTITY);
}

#[test]
fn malformed_transforms_are_refused() {
    for (operation, fragment) in [
        (r#"<rotate angle="90"/>"#, "the axis of rotation is zero"),
        (r#"<rotate z="1"/>"#, "<rotate> needs the attribute “angle”"),
        (r#"<matrix value="1 2 3"/>"#, "a matrix has 9 or 16 numbers"),
        (r#"<lookat origin="0 0 0" target="0 0 1" up="0 0 2"/>"#, "the up vector is parallel"),
        (r#"<lookat origin="0 0 0" target="0 0 0"/>"#, "origin and target coincide"),
        (r#"<lookat origin="0 0" target="0 0 0"/>"#, "“0 0” is not a triple"),
        (r#"<scale value="1e300"/><scale value="1e300"/>"#, "overflows"),
        (r#"<shear x="1"/>"#, "<shear> is no transform operation"),
    ] {
        let content = format!("<shape type=\"x\">\n<transform name=\"t\">\n{operation}");
        refused(&format!("{content}</transform></shape>"), 4, fragment);
    }
}

#[test]
fn defaults_are_substituted_from_where_they_stand_on() {
    let text = r#"<scene version="3.0.0">
        <default name="n" value="4"/><default name="type" value="mesh"/>
        <shape type="$type"><integer name="count" value="$n$n"/></shape></scene>"#;
    let given = [("n".to_string(), "7".to_string())];
    let description = parse_text(text, Path::new("x"), &given, Leniency::Strict).unwrap();
    let shape = description.node(description.root().children[0].node);
    assert_eq!(shape.plugin, "mesh");
    assert_eq!(shape.properties[0].value, Value::Integer(77));
    let early = "<bsdf type=\"$t\"/>\n<default name=\"t\" value=\"x\"/>";
    refused(early, 2, "$t is not defined");
    refused(
        "\n<default name=\"size\" value=\"1\"/><bsdf type=\"$sise\"/>",
        3,
        "did you mean $size?",
    );
}

#[test]
fn definitions_that_nothing_uses_are_refused_or_warned_about() {
    let text = "<scene version=\"3.0.0\"/>";
    let given = [("n".to_string(), "7".to_string())];
    let error = parse_text(text, Path::new("x"), &given, Leniency::Strict).unwrap_err();
    assert!(error.to_string().contains("n=7"), "{error}");
    let lenient = parse_text(text, Path::new("x"), &given, Leniency::Lenient).unwrap();
    assert_eq!(lenient.warnings.len(), 1);
}

#[test]
fn references_reach_forwards_and_backwards_and_keep_their_order() {
    let description = parse(
        r#"<shape type="s"><ref id="a"/><bsdf type="y"/><ref name="n" id="c"/></shape>
        <bsdf type="x" id="a"/><alias id="a" as="c"/><null/>"#,
    )
    .unwrap();
    let shape = description.node(description.root().children[0].node);
    let children: Vec<_> = shape
        .children
        .iter()
        .map(|c| (c.name.as_str(), description.node(c.node).plugin.as_str()))
        .collect();
    assert_eq!(children, [("", "x"), ("", "y"), ("n", "x")]);
}

#[test]
fn bad_names_are_refused() {
    refused("<bsdf type=\"x\" id=\"a\"/>\n<bsdf type=\"y\" id=\"a\"/>", 3, "taken already");
    refused("<bsdf type=\"x\" id=\"a\"/>\n<ref id=\"b\"/>", 3, "nothing has the id “b”");
    refused("<alias id=\"b\" as=\"c\"/>", 2, "no “b” before this alias");
    refused("<bsdf/>", 2, "<bsdf> needs the attribute “type”");
    refused("<bsdf type=\"x\" colour=\"red\"/>", 2, "<bsdf> has no attribute “colour”");
    refused("<bsfd type=\"x\"/>", 2, "did you mean <bsdf>?");
    let twice = "<bsdf type=\"x\">\n<float name=\"a\" value=\"1\"/>\n<float name=\"a\" value=\"2\"/></bsdf>";
    refused(twice, 4, "“a” is given twice");
}

#[test]
fn a_lenient_reader_leaves_unknown_references_out() {
    let text = "<scene version=\"3.0.0\"><shape type=\"s\"><ref id=\"b\"/></shape></scene>";
    let d = parse_text(text, Path::new("x"), &[], Leniency::Lenient).unwrap();
    assert!(d.node(d.root().children[0].node).children.is_empty());
    assert_eq!(d.warnings.len(), 1);
}

#[test]
fn circles_of_references_are_refused() {
    refused(
        "<bsdf type=\"x\" id=\"a\"><ref id=\"b\"/></bsdf>\n<bsdf type=\"x\" id=\"b\"><ref id=\"a\"/></bsdf>",
        2,
        "a → b → a",
    );
    refused("<bsdf type=\"x\" id=\"a\"><ref id=\"a\"/></bsdf>", 2, "a → a");
}

#[test]
fn deep_nesting_is_refused_without_exhausting_the_stack() {
    let nested = |n: usize| "<bsdf type=\"x\">".repeat(n) + &"</bsdf>".repeat(n);
    assert!(parse(&nested(60)).is_ok());
    let error = parse(&nested(500)).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Resource);
    let link = |i| format!("<bsdf type=\"x\" id=\"b{i}\"><ref id=\"b{}\"/></bsdf>", i + 1);
    let chain = (0..1000).map(link).collect::<Vec<_>>().concat();
    let error = parse(&(chain + "<bsdf type=\"x\" id=\"b1000\"/>")).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Resource, "{error}");
}

#[test]
fn files_before_version_2_are_brought_up_to_date() {
    let description = parse_version(
        "0.6.0",
        r#"<bsdf type="diffuse">
            <rgb name="diffuseReflectance" value="1"/><float name="intIOR" value="1.5"/>
            <transform name="toWorld"><lookAt origin="0 0 0" target="0 0 1"/></transform>
        </bsdf>
        <texture type="bitmap"><float name="uscale" value="2"/><float name="voffset" value="3"/>
        </texture>"#,
    )
    .unwrap();
    let node = |i: usize| description.node(description.root().children[i].node);
    let names: Vec<_> = node(0).properties.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["reflectance", "int_ior", "to_world"]);
    let Value::Transform(to_uv) = &node(1).properties[0].value else { panic!() };
    assert_eq!(to_uv.transform_point3(DVec3::ONE), DVec3::new(2.0, 4.0, 1.0));
}

#[test]
fn the_root_must_be_a_scene_with_a_version() {
    for (text, fragment) in [
        ("", "not well-formed XML"),
        ("<scene/>", "<scene> has no version"),
        ("<scene version=\"three\"/>", "“three” is not a version"),
        ("<bsdf version=\"3.0.0\" type=\"x\"/>", "the outermost element is <bsdf>"),
        ("<scene version=\"3.0.0\"><a></scene>", "not well-formed XML"),
        ("<!DOCTYPE scene SYSTEM \"x.dtd\"><scene version=\"3.0.0\"/>", "not allowed"),
        ("<!DOCTYPE a [<!ENTITY a \"b\">]><scene version=\"3.0.0\"/>", "not allowed"),
        ("<scene version=\"3.0.0\">&a;</scene>", "not well-formed XML"),
    ] {
        let error = parse_text(text, Path::new("x"), &[], Leniency::Strict).unwrap_err();
        assert!(error.to_string().contains(fragment), "{error}");
    }
}

#[test]
fn a_byte_order_mark_is_no_content_and_columns_count_characters() {
    let text = "\u{feff}<scene version=\"3.0.0\">\nä <bsdf/></scene>";
    let error = parse_text(text, Path::new("x"), &[], Leniency::Strict).unwrap_err();
    assert_eq!(error.location.to_string(), "x:2:3");
}

/// A folder with the given files; the path of the first.
fn files(contents: &[(&str, &str)]) -> (tempfile::TempDir, std::path::PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in contents {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, content).unwrap();
    }
    let first = folder.path().join(contents[0].0);
    (folder, first)
}

#[test]
fn includes_bring_their_content_their_version_and_their_defaults() {
    let (_folder, scene) = files(&[
        (
            "scene.xml",
            r#"<scene version="3.0.0"><path value="lib"/><include filename="part.xml"/>
            <include filename="one.xml"/><shape type="$kind"/></scene>"#,
        ),
        (
            "lib/part.xml",
            r#"<scene version="0.6.0"><default name="kind" value="sphere"/>
            <shape type="s"><float name="maxDepth" value="1"/></shape></scene>"#,
        ),
        ("one.xml", r#"<bsdf version="3.0.0" type="diffuse" id="b"/>"#),
    ]);
    let description = parse_file(&scene, &[], Leniency::Strict, &Sandbox::default()).unwrap();
    let plugins: Vec<_> = description.nodes().iter().map(|n| n.plugin.as_str()).collect();
    assert_eq!(plugins, ["scene", "s", "diffuse", "sphere"]);
    assert_eq!(description.nodes()[1].properties[0].name, "max_depth");
    assert_eq!(description.files.len(), 3);
    let found = description.nodes()[1].search.resolve("part.xml").unwrap();
    assert!(found.ends_with("lib/part.xml"));
}

#[test]
fn circular_and_missing_includes_name_the_files() {
    let (_folder, scene) = files(&[
        ("a.xml", "<scene version=\"3.0.0\">\n<include filename=\"b.xml\"/></scene>"),
        ("b.xml", "<scene version=\"3.0.0\">\n\n<include filename=\"a.xml\"/></scene>"),
    ]);
    let error =
        parse_file(&scene, &[], Leniency::Strict, &Sandbox::default()).unwrap_err().to_string();
    assert!(error.contains("b.xml:3:1: a file includes itself"), "{error}");
    assert!(error.matches("a.xml").count() == 2, "{error}");
    let (_folder, scene) =
        files(&[("a.xml", "<scene version=\"3.0.0\">\n<include filename=\"b.xml\"/></scene>")]);
    let error = parse_file(&scene, &[], Leniency::Strict, &Sandbox::default()).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Io);
    assert!(error.to_string().contains("b.xml"), "{error}");
    assert!(error.to_string().contains("a.xml:2"), "{error}");
}

#[test]
fn files_that_cannot_be_scenes_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let error = parse_file(folder.path(), &[], Leniency::Strict, &Sandbox::default()).unwrap_err();
    assert_eq!(error.kind, ErrorKind::Io);
    let path = folder.path().join("x.xml");
    std::fs::write(&path, b"<scene\n\xff").unwrap();
    let error =
        parse_file(&path, &[], Leniency::Strict, &Sandbox::default()).unwrap_err().to_string();
    assert!(error.contains("x.xml:2: the text is not UTF-8"), "{error}");
    std::fs::write(&path, b"\xff\xfe<\0").unwrap();
    let error =
        parse_file(&path, &[], Leniency::Strict, &Sandbox::default()).unwrap_err().to_string();
    assert!(error.contains("UTF-16"), "{error}");
}

#[test]
fn spectra_are_read_from_files() {
    let (_folder, scene) = files(&[
        (
            "a.xml",
            "<scene version=\"3.0.0\"><bsdf type=\"x\">\
             <spectrum name=\"a\" filename=\"s.spd\"/></bsdf></scene>",
        ),
        ("s.spd", "# silver\n400 1.5\n\n500 2.5 # end\n"),
    ]);
    let description = parse_file(&scene, &[], Leniency::Strict, &Sandbox::default()).unwrap();
    let samples = Vec::from([(400.0, 1.5), (500.0, 2.5)]);
    let value = &description.nodes()[1].properties[0].value;
    assert_eq!(*value, Value::Spectrum(SpectrumValue::Samples(samples)));
    std::fs::write(scene.with_file_name("s.spd"), "400 1\n500 x\n").unwrap();
    let error =
        parse_file(&scene, &[], Leniency::Strict, &Sandbox::default()).unwrap_err().to_string();
    assert!(error.contains("s.spd:2: expected a wavelength and a value"), "{error}");
}
