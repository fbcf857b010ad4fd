//! Distance fields, curves and merged shapes.

use alloc::vec::Vec;
use std::fs;
use std::path::PathBuf;

use super::*;
use crate::geometry::Ray;

/// A folder with a ball as a distance field, a file of curves, and a broken one of each.
fn assets() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let volume = |values: [f32; 27]| {
        let mut bytes = b"VOL\x03".to_vec();
        bytes.extend([1_i32, 3, 3, 3, 1].iter().flat_map(|word| word.to_le_bytes()));
        bytes.extend([0.0_f32; 6].iter().chain(&values).flat_map(|number| number.to_le_bytes()));
        bytes
    };
    // Linear along each axis: negative below 0.375 in z.
    let slope = core::array::from_fn(|i| (i / 9) as f32 - 0.75);
    let files: [(&str, &[u8]); 5] = [
        ("slope.vol", &volume(slope)),
        ("outside.vol", &volume([1.0; 27])),
        ("short.vol", &volume(slope)[..60]),
        ("curves.txt", b"0 0 0 0.1\n1 0 0 0.1\n2 0 0 0.1\n3 0 0 0.1\n"),
        ("broken.txt", b"0 0 0 0.1\n1 0 0\n"),
    ];
    for (name, content) in files {
        fs::write(folder.path().join(name), content).expect("a writable folder");
    }
    let path = folder.path().to_path_buf();
    (folder, path)
}

fn shape(plugin: &str, file: &Path, inside: &str) -> String {
    let name = file.display();
    format!(
        "<shape type=\"{plugin}\">\n<string name=\"filename\" value=\"{name}\"/>\n{inside}</shape>"
    )
}

#[test]
fn distance_fields_fill_the_unit_cube_of_their_space() {
    let (_folder, path) = assets();
    let twice = "<transform name=\"to_world\"><scale value=\"2\"/></transform>";
    for (inside, side) in [("", 1.0), ("<boolean name=\"flip_normals\" value=\"true\"/>", -1.0)] {
        for normals in ["smooth", "analytic"] {
            let inside = format!("{twice}{inside}<string name=\"normals\" value=\"{normals}\"/>");
            let content = shape("sdfgrid", &path.join("slope.vol"), &inside);
            let loaded = load(&content).expect("a distance field");
            assert!(loaded.files.contains(&path.join("slope.vol")));
            let geometry = &loaded.scene.geometry;
            let ray = Ray::new(Vec3::new(0.3, 0.4, 9.0), -Vec3::Z);
            let hit = geometry.intersect(&ray).expect("the surface");
            let point = geometry.surface_point(&ray, &hit);
            assert_eq!(point.position, Vec3::new(0.3, 0.4, 0.75));
            assert_eq!((point.normal, point.shading.n), (Vec3::Z * side, Vec3::Z * side));
        }
    }
}

#[test]
fn curves_keep_their_radii_and_are_seen_through_instances() {
    let (_folder, path) = assets();
    let grown = "<transform name=\"to_world\"><scale value=\"2\"/></transform>";
    for plugin in ["linearcurve", "bsplinecurve"] {
        let content = shape(plugin, &path.join("curves.txt"), grown);
        let group = format!(
            "<shape type=\"shapegroup\" id=\"g\">{content}</shape>
            <shape type=\"instance\"><ref id=\"g\"/></shape>"
        );
        for content in [content, group] {
            let loaded = load(&content).expect("curves");
            assert!(matches!(loaded.scene.geometry.shapes(), [Shape::Curves(_)]));
            let ray = Ray::new(Vec3::new(3.0, 0.0, 5.0), -Vec3::Z);
            let hit = loaded.scene.geometry.intersect(&ray).expect("twice as far, not as thick");
            assert!((hit.t - 4.9).abs() < 1e-6, "{hit:?}");
        }
    }
}

#[test]
fn what_is_wrong_with_a_file_is_told_with_both_places() {
    let (_folder, path) = assets();
    let refused = |plugin: &str, file: &str, inside: &str, parts: &[&str]| {
        let error = load(&shape(plugin, &path.join(file), inside)).expect_err(file).to_string();
        for part in parts {
            assert!(error.contains(part), "{error}");
        }
    };
    refused("sdfgrid", "short.vol", "", &["short.vol: ", "do not fit", "(shape at scene.xml:2"]);
    refused("sdfgrid", "outside.vol", "", &["scene.xml:2", "one sign"]);
    refused("sdfgrid", "none.vol", "", &["none.vol: cannot read"]);
    let other = "<string name=\"normals\" value=\"flat\"/>";
    refused("sdfgrid", "slope.vol", other, &["scene.xml:4", "“flat”", "smooth and analytic"]);
    let lamp = "<emitter type=\"area\"/>";
    refused("sdfgrid", "slope.vol", lamp, &["scene.xml:2", "a light needs an area", "use a mesh"]);
    refused("linearcurve", "curves.txt", lamp, &["a light needs an area", "use a mesh"]);
    refused("linearcurve", "broken.txt", "", &["broken.txt:2: ", "of 3 numbers", "(shape at"]);
    refused("bsplinecurve", "slope.vol", "", &["slope.vol:1: ", "is not a number"]);
    super::refused("<shape type=\"sdfgrid\"/>", 2, "has no “filename”");
    super::refused("<shape type=\"linearcurve\"/>", 2, "has no “filename”");
}

#[test]
fn merged_shapes_are_those_by_themselves() {
    let shapes = "<shape type=\"cube\" id=\"lamp\"><emitter type=\"area\"/></shape>
        <shape type=\"merge\"><shape type=\"sphere\" id=\"inner\"/></shape>
        <shape type=\"rectangle\" id=\"floor\"/>";
    let merged = load(&format!("<shape type=\"merge\">{shapes}</shape>")).expect("shapes");
    let single = load(shapes).expect("shapes");
    assert_eq!(merged.scene.geometry.shapes(), single.scene.geometry.shapes());
    assert_eq!(merged.scene.lights.len(), 1);
    let names: Vec<&str> = merged.scene.surfaces.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["lamp", "inner", "floor"]);
    let grouped = load(
        "<shape type=\"shapegroup\" id=\"g\"><shape type=\"merge\"><shape type=\"cube\"/>
        <shape type=\"sphere\"/></shape><shape type=\"disk\"/></shape>
        <shape type=\"instance\"><ref id=\"g\"/></shape>",
    );
    let scene = grouped.expect("a group").scene;
    let kinds = scene.geometry.shapes();
    assert!(matches!(kinds, [Shape::Mesh(_), Shape::Sphere(_), Shape::Disk(_)]), "{kinds:?}");
    refused(
        "<shape type=\"shapegroup\" id=\"g\">
        <shape type=\"merge\">
        <shape type=\"cube\"><emitter type=\"area\"/></shape></shape></shape>",
        4,
        "cannot contain emitters",
    );
}
