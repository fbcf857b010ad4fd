//! `etendue convert`: what is written is read as it was.

mod common;

use core::sync::atomic::AtomicBool;
use std::fs;
use std::path::{Path, PathBuf};

use common::{Folder, repository, scene};
use etendue_renderer::{RenderSettings, Renderer};
use etendue_scene::export::{ExportOptions, Loss, export};
use etendue_scene::{Effect, LoadOptions, Scene, load_scene};

/// Every scene file under a folder, in order.
fn scene_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder of scenes") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(scene_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "xml") {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// The definitions of each variant that the first comment of a scene file lists; one without any where it lists none.
fn variants(path: &Path) -> Vec<Vec<(String, String)>> {
    let text = fs::read_to_string(path).expect("a scene file");
    let comment = text.strip_prefix("<!--").and_then(|rest| rest.split_once("-->"));
    let lines = comment.map_or("", |(comment, _)| comment).lines();
    let definitions = lines.filter_map(|line| Some(line.split_once("variants:")?.1));
    let definitions = definitions.map(|line| {
        let pairs = line.split_whitespace().filter_map(|item| item.split_once('='));
        pairs.map(|(name, value)| (name.to_owned(), value.to_owned())).collect()
    });
    let definitions: Vec<_> = definitions.collect();
    if definitions.is_empty() { vec![Vec::new()] } else { definitions }
}

/// The bits of a picture of one sample per pixel.
fn picture(scene: &Scene) -> Vec<[u32; 3]> {
    let settings = RenderSettings { samples_per_pixel: 1, ..RenderSettings::of_scene(scene) };
    let renderer = Renderer::new(scene, settings).expect("settings of the scene");
    let rendering = renderer.render(&|_| {}, &AtomicBool::new(false));
    rendering.image.pixels().iter().map(|pixel| pixel.to_array().map(f32::to_bits)).collect()
}

/// What is lost in a conversion after which the scene is read and shown with the same bits, if nothing is lost.
fn converted(path: &Path, load: &LoadOptions) -> Vec<Loss> {
    let loaded = load_scene(path, load).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let before = picture(&loaded.scene);
    let folder = Folder::new();
    fs::create_dir(folder.path("files")).expect("a writable temporary folder");
    let options = ExportOptions {
        folder: "files".into(),
        remark: "a test".into(),
        layers: loaded.layers.clone(),
    };
    let written = export(loaded.scene, &options).expect("a conversion");
    folder.write("scene.xml", &written.xml);
    for file in &written.files {
        folder.write(&format!("files/{}", file.name), &file.bytes);
    }
    let again = load_scene(&folder.path("scene.xml"), &LoadOptions::default())
        .unwrap_or_else(|e| panic!("{}: {e}\n{}", path.display(), written.xml));
    let after = picture(&again.scene);
    assert_eq!(loaded.layers, again.layers, "{}", path.display());
    if written.losses.is_empty() {
        let differing = before.iter().zip(&after).filter(|(a, b)| a != b).count();
        let count = (before.len(), after.len());
        assert!(
            differing == 0 && count.0 == count.1,
            "{} {:?}: {differing} of {count:?} pixels differ\n{}",
            path.display(),
            load.definitions,
            written.xml
        );
    }
    written.losses.into_iter().collect()
}

/// What files lose, by name.
const LOST: [(&str, Loss); 13] = [
    ("bsdf_coating.xml", Loss::Coating),
    ("bsdf_difftrans.xml", Loss::DiffuseTransmitter),
    ("bsdf_phong.xml", Loss::Phong),
    ("bsdf_roughdiffuse.xml", Loss::RoughDiffuse),
    ("dispersion.xml", Loss::Effect(Effect::Dispersion)),
    ("lambert-oren-nayar.xml", Loss::RoughDiffuse),
    ("materials.xml", Loss::RoughDiffuse),
    ("motion-blur.xml", Loss::Effect(Effect::MotionBlur)),
    ("multiple-scattering.xml", Loss::Effect(Effect::MultipleScattering)),
    ("nested-dielectrics.xml", Loss::Effect(Effect::NestedDielectrics)),
    ("spectral-colours.xml", Loss::Effect(Effect::SpectralColours)),
    ("strict-normals.xml", Loss::Effect(Effect::StrictNormals)),
    ("texture-filtering.xml", Loss::Effect(Effect::TextureFiltering)),
];

/// Converts every scene under a folder in every variant.
fn convert_all(folder: &str, film_size: Option<[u32; 2]>) {
    for path in scene_files(&repository(folder)) {
        // Parts of others.
        if path.parent().is_some_and(|folder| folder.ends_with("include")) {
            continue;
        }
        let name = path.file_name().and_then(|name| name.to_str()).expect("UTF-8");
        let expected = LOST.iter().filter(|(file, _)| *file == name).map(|(_, loss)| *loss);
        let expected: Vec<Loss> = expected.collect();
        for definitions in variants(&path) {
            let options = LoadOptions { definitions, film_size, ..LoadOptions::default() };
            assert_eq!(converted(&path, &options), expected, "{}", path.display());
        }
    }
}

#[test]
fn test_scenes_show_the_same_bits_or_say_what_they_lose() {
    convert_all("tests/scenes", None);
}

#[test]
fn shipped_scenes_show_the_same_bits_or_say_what_they_lose() {
    convert_all("scenes", Some([24, 16]));
}

/// A mesh of one triangle with a normal that is no unit vector to the last bit.
const TRIANGLE: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

#[test]
fn the_command_writes_a_scene_and_a_folder_of_files() {
    let folder = Folder::new();
    folder.write("triangle.ply", TRIANGLE);
    let body = "<shape type=\"ply\" id=\"a &amp; b\"><string name=\"filename\" value=\"triangle.ply\"/></shape>\
        <emitter type=\"constant\"/>";
    folder.write("in.xml", scene(body));
    let outcome = folder.run(&["convert", "in.xml", "out.xml"]);
    assert_eq!((outcome.exit, outcome.stderr.as_str()), (Some(0), ""));
    assert_eq!(folder.names(), ["in.xml", "out.xml", "out_files", "triangle.ply"]);
    let xml = folder.read("out.xml");
    let document = roxmltree::Document::parse(&xml).expect("well-formed XML");
    assert!(document.root_element().has_tag_name("scene"));
    assert!(xml.contains("<!-- Written by étendue") && xml.contains("from in.xml -->"), "{xml}");
    let picture = |name: &str| folder.render(&folder.path(name), &["--spp", "1"]);
    assert_eq!(picture("in.xml").pixels, picture("out.xml").pixels);
    // Again, over what is there.
    assert_eq!(folder.run(&["convert", "in.xml", "out.xml"]).exit, Some(0));
    // A bare mesh is a scene, too.
    assert_eq!(folder.run(&["convert", "triangle.ply", "bare.xml"]).exit, Some(0));
    assert_eq!(picture("triangle.ply").pixels, picture("bare.xml").pixels);
}

#[test]
fn what_is_lost_is_said_once() {
    let folder = Folder::new();
    let rough = "<shape type=\"sphere\"><bsdf type=\"roughdiffuse\"/></shape>";
    folder.write("in.xml", scene(&format!("{rough}{rough}<emitter type=\"constant\"/>")));
    let outcome = folder.run(&["convert", "in.xml", "out.xml"]);
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    assert_eq!(outcome.warnings().len(), 1, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("“roughdiffuse”"), "{}", outcome.stderr);
}

#[test]
fn inputs_are_not_written_over_and_other_names_are_refused() {
    let folder = Folder::new();
    folder.write("in.xml", scene("<emitter type=\"constant\"/>"));
    let text = folder.read("in.xml");
    for (arguments, exit, part) in [
        (["convert", "in.xml", "in.xml"], 2, "which the scene is read from"),
        (["convert", "in.xml", "./in.xml"], 2, "which the scene is read from"),
        (["convert", "in.xml", "out.obj"], 2, "a scene file is named *.xml"),
        (["convert", "in.xml", "nowhere/out.xml"], 4, "is not a folder"),
        (["convert", "none.xml", "out.xml"], 4, "none.xml"),
    ] {
        let outcome = folder.run(&arguments);
        assert_eq!(outcome.exit, Some(exit), "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(part), "{arguments:?}: {}", outcome.stderr);
    }
    assert_eq!(folder.read("in.xml"), text);
    assert_eq!(folder.names(), ["in.xml"]);
    // The files of a converted scene are inputs when it is converted again.
    folder.write("triangle.ply", TRIANGLE);
    assert_eq!(folder.run(&["convert", "triangle.ply", "a.xml"]).exit, Some(0));
    let mesh = fs::read(folder.path("a_files/triangle.ply")).expect("a mesh");
    folder.write("b.xml", folder.read("a.xml"));
    let outcome = folder.run(&["convert", "b.xml", "a.xml"]);
    assert_eq!(outcome.exit, Some(2), "{}", outcome.stderr);
    assert_eq!(fs::read(folder.path("a_files/triangle.ply")).expect("a mesh"), mesh);
}
