//! Files and what they are made of.

use alloc::format;
use alloc::string::ToString;
use alloc::vec::Vec;
use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use super::super::document::Document;
use super::{Draft, container, load, meshes, warnings};
use crate::{ErrorKind, LoadOptions, SceneError, load_scene};

/// The error of a document of this text.
fn refused(text: &str) -> SceneError {
    Document::parse(text.as_bytes(), Path::new("model.gltf")).expect_err(text)
}

#[test]
fn versions_and_required_extensions_are_checked_first() {
    for (text, fragments) in [
        ("{", ["model.gltf: not the JSON of a glTF file", "line 1 column 1"]),
        ("[]", ["must be an object", "a list of 0"]),
        ("{}", ["has no “asset”", "model.gltf"]),
        (r#"{"asset":{}}"#, ["asset: has no “version”", "model.gltf"]),
        (r#"{"asset":{"version":"1.0"}}"#, ["asset.version: glTF of version 1.0", "as glTF 2.0"]),
        (r#"{"asset":{"version":2}}"#, ["asset.version: must be a string", "not 2"]),
        (
            r#"{"asset":{"version":"2.0","minVersion":"2.1"}}"#,
            ["asset.minVersion: glTF of version 2.1", "not supported"],
        ),
        (
            r#"{"asset":{"version":"2.0"},"extensionsRequired":["KHR_texture_basisu","KHR_mesh_quantization"]}"#,
            [
                "extensionsRequired: the file cannot be read without KHR_texture_basisu,",
                "is not supported",
            ],
        ),
    ] {
        let error = refused(text).to_string();
        for fragment in fragments {
            assert!(error.contains(fragment), "{fragment} in {error}");
        }
    }
}

#[test]
fn what_is_used_and_unknown_is_one_warning() {
    let mut draft = Draft::new();
    let square = draft.square();
    draft.node(&[square]);
    let used = ["KHR_materials_ior", "KHR_materials_iridescence", "KHR_animation_pointer"];
    draft.root["extensionsUsed"] = json!(used);
    draft.root["animations"] = json!([{}]);
    let model = draft.model();
    let [unknown, animations] = warnings(&model)[..] else { panic!("{:?}", warnings(&model)) };
    assert!(unknown.contains("KHR_materials_iridescence, KHR_animation_pointer"), "{unknown}");
    assert!(!unknown.contains("ior,") && animations.contains("at rest"), "{unknown} {animations}");
}

#[test]
fn what_is_inside_unknown_extensions_is_nobody_s_business() {
    let material = json!({ "extensions": { "ANY_thing": 5, "ANY_other": { "oddTexture": [] } } });
    assert_eq!(Draft::of_material(material).model().surfaces.len(), 1);
}

#[test]
fn a_container_that_is_cut_off_anywhere_is_refused() {
    let mut draft = Draft::new();
    let square = draft.square();
    draft.node(&[square]);
    let whole = draft.glb();
    assert!(load(&whole).is_ok());
    for length in 0..whole.len() {
        let error = load(&whole[..length]).err().map(|error| error.to_string());
        let error = error.unwrap_or_else(|| panic!("{length} bytes are read"));
        let expected = if length < 4 { "not the JSON" } else { "cut off" };
        assert!(error.contains(expected), "{length}: {error}");
    }
}

#[test]
fn chunks_must_fit_and_begin_with_json() {
    let text = br#"{"asset":{"version":"2.0"}}"#;
    let whole = container(text, &[1, 2, 3]);
    let with = |at: usize, bytes: &[u8]| {
        let mut file = whole.clone();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        load(&file).map(|_| ()).map_err(|error| error.to_string())
    };
    assert_eq!(with(0, b"glTF"), Ok(()));
    for (at, bytes, fragment) in [
        (4, &[1, 0, 0, 0], "version 1"),
        (12, &[0xff; 4], "reaches beyond the container"),
        (16, b"BIN\0", "is not JSON"),
        (8, &[12, 0, 0, 0], "the container is empty"),
        (8, &[0xff; 4], "cut off"),
    ] {
        let error = with(at, bytes).expect_err(fragment);
        assert!(error.contains(fragment), "{fragment} in {error}");
    }
    // A second chunk of an unknown kind is read over.
    assert_eq!(with(whole.len() - 8, b"LATE"), Ok(()));
}

#[test]
fn the_same_square_from_every_kind_of_file_is_the_same() {
    let mut draft = Draft::new();
    let square = draft.square();
    draft.node(&[square]);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let write = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, bytes).expect("a writable folder");
        path
    };
    let base64 = |bytes: &[u8]| {
        const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        let mut text = alloc::string::String::new();
        for group in bytes.chunks(3) {
            let mut word = [0; 4];
            word[1..=group.len()].copy_from_slice(group);
            let word = u32::from_be_bytes(word);
            for place in 0..4 {
                let digit = DIGITS[(word >> (18 - 6 * place)) as usize & 63];
                text.push(if place > group.len() { '=' } else { char::from(digit) });
            }
        }
        text
    };
    write("the buffer.bin", &draft.bytes);
    let length = draft.bytes.len();
    let with = |uri: &str| {
        let mut root = draft.root.clone();
        root["buffers"] = json!([{ "byteLength": length, "uri": uri }]);
        serde_json::to_vec(&root).expect("JSON")
    };
    let data = format!("data:application/octet-stream;base64,{}", base64(&draft.bytes));
    let paths = [
        write("a.glb", &draft.glb()),
        // What a file is is told by its content.
        write("b.gltf", &draft.glb()),
        write("c.gltf", &with("the%20buffer.bin")),
        write("d.gltf", &with("the buffer.bin")),
        write("e.GLTF", &with(&data)),
    ];
    let scenes: Vec<_> = paths
        .iter()
        .map(|path| load_scene(path, &LoadOptions::default()).expect("a model"))
        .collect();
    for loaded in &scenes {
        assert_eq!(loaded.scene.geometry.bounds(), scenes[0].scene.geometry.bounds());
        assert_eq!(loaded.scene.lights.len(), 1, "white light from everywhere");
    }
    assert_eq!(scenes[2].files, [paths[2].clone(), folder.path().join("the buffer.bin")]);

    for (uri, kind, fragment) in [
        ("missing.bin", ErrorKind::Io, "(named at buffers[0].uri)"),
        ("https://example.org/a.bin", ErrorKind::Scene, "“https:…” is not supported"),
        ("data:;base64,AAA!", ErrorKind::Scene, "broken at its byte 3 of 4"),
        ("data:;base64,AAAA", ErrorKind::Scene, "holds 3 bytes instead of"),
        ("data:text/plain,abc", ErrorKind::Scene, "not base64"),
        ("data:nothing", ErrorKind::Scene, "without a comma"),
    ] {
        let path = write("f.gltf", &with(uri));
        let error = load_scene(&path, &LoadOptions::default()).expect_err(uri);
        assert!(error.to_string().contains(fragment), "{fragment} in {error}");
        assert_eq!(error.kind, kind, "{error}");
    }
}

#[test]
fn the_scene_of_the_file_is_read_else_the_first_else_everything() {
    let mut draft = Draft::new();
    for x in 0..3_u8 {
        let square = draft.square();
        let node = draft.node(&[square]);
        draft.root["nodes"][node]["translation"] = json!([x, 0, 0]);
    }
    let left = |draft: &Draft| {
        let meshes = meshes(&draft.model());
        meshes.iter().map(|mesh| mesh.positions()[0].x + 1.0).collect::<Vec<f32>>()
    };
    assert_eq!(left(&draft), [0.0, 1.0, 2.0]);
    draft.root["nodes"][0]["children"] = json!([2]);
    assert_eq!(left(&draft), [0.0, 1.0, 2.0]);
    draft.root["scenes"] = json!([{ "nodes": [1] }, { "nodes": [0] }]);
    assert_eq!(left(&draft), [1.0]);
    draft.root["scene"] = json!(1);
    assert_eq!(left(&draft), [0.0, 2.0]);
    draft.root["scenes"] = json!([{}, {}]);
    assert_eq!(left(&draft), [] as [f32; 0]);
}

#[test]
fn an_empty_model_is_a_scene() {
    let text: Value = json!({ "asset": { "version": "2.0" } });
    let model =
        load(&container(text.to_string().as_bytes(), &[])).map(|model| model.surfaces.len());
    assert_eq!(model, Ok(0));
}
