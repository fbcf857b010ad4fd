//! Documents that were made to do harm.

use alloc::format;
use alloc::string::ToString;
use alloc::vec;
use alloc::vec::Vec;
use std::path::Path;

use serde_json::{Value, json};

use super::super::document::Document;
use super::super::translate;
use super::{Draft, load};
use crate::ErrorKind;

/// A square whose document is changed.
fn changed(change: impl FnOnce(&mut Value)) -> Draft {
    let mut draft = Draft::of_material(json!({ "normalTexture": { "index": 0 } }));
    draft.image([1, 1], ::image::ExtendedColorType::Rgb8, &[128, 128, 255]);
    let colors = draft.floats(&[[1.0, 1.0, 1.0, 1.0]; 4]);
    draft.root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
    change(&mut draft.root);
    draft
}

#[test]
fn indices_beyond_their_list_are_refused_wherever_they_stand() {
    // Each place with the list that it points into.
    for (pointer, message) in [
        ("/nodes/0/mesh", "nodes[0].mesh: there is no meshes[7], the file has 1"),
        (
            "/meshes/0/primitives/0/material",
            "meshes[0].primitives[0].material: there is no materials[7]",
        ),
        (
            "/meshes/0/primitives/0/indices",
            "meshes[0].primitives[0].indices: there is no accessors[7]",
        ),
        (
            "/meshes/0/primitives/0/attributes/POSITION",
            "attributes.POSITION: there is no accessors[7]",
        ),
        (
            "/meshes/0/primitives/0/attributes/COLOR_0",
            "attributes.COLOR_0: there is no accessors[7]",
        ),
        ("/accessors/0/bufferView", "accessors[0].bufferView: there is no bufferViews[7]"),
        ("/bufferViews/0/buffer", "bufferViews[0].buffer: there is no buffers[7]"),
        ("/materials/0/normalTexture/index", "normalTexture.index: there is no textures[7]"),
        ("/textures/0/source", "textures[0].source: there is no images[7]"),
    ] {
        let draft = changed(|root| *root.pointer_mut(pointer).expect(pointer) = json!(7));
        assert!(draft.error().contains(message), "{message} in {}", draft.error());
        for wrong in [json!(-1), json!(0.5), json!(1e300), json!("0"), json!(null), json!({})] {
            let draft = changed(|root| *root.pointer_mut(pointer).expect(pointer) = wrong.clone());
            let error = draft.error();
            assert!(error.contains("must be a whole number that is not negative"), "{error}");
        }
    }
    for (change, message) in [
        (json!({ "scene": 3, "scenes": [{}] }), "scene: there is no scenes[3], the file has 1"),
        (json!({ "scenes": [{ "nodes": [9] }] }), "scenes[0].nodes[0]: there is no nodes[9]"),
        (json!({ "nodes": [{ "children": [9] }] }), "nodes[0].children[0]: there is no nodes[9]"),
        (
            json!({ "nodes": [{ "camera": 0 }] }),
            "nodes[0].camera: there is no cameras[0], the file has 0",
        ),
    ] {
        let draft = changed(|root| {
            for (name, value) in change.as_object().expect("an object") {
                root[name] = value.clone();
            }
        });
        assert!(draft.error().contains(message), "{message} in {}", draft.error());
    }
}

#[test]
fn every_value_may_be_of_any_type() {
    // Each value of the document in turn is replaced by values of every kind; the answer is a model or an error, and nothing else.
    fn places(value: &Value, at: &str, found: &mut Vec<alloc::string::String>) {
        found.push(at.to_string());
        match value {
            Value::Object(properties) => {
                properties
                    .iter()
                    .for_each(|(name, value)| places(value, &format!("{at}/{name}"), found));
            }
            Value::Array(items) => {
                items
                    .iter()
                    .enumerate()
                    .for_each(|(i, value)| places(value, &format!("{at}/{i}"), found));
            }
            _ => {}
        }
    }
    let whole = changed(|_| {});
    let mut found = Vec::new();
    places(&whole.root, "", &mut found);
    let hostile = [
        json!(null),
        json!(true),
        json!("x"),
        json!(-1),
        json!(0),
        json!(1),
        json!(5126),
        json!(0.5),
        json!(1e308),
        json!(u64::MAX),
        json!([]),
        json!({}),
        json!([0]),
        json!([null, [], {}]),
    ];
    let (mut errors, mut models) = (0, 0);
    for place in &found {
        for value in &hostile {
            let draft = changed(|root| *root.pointer_mut(place).expect("a place") = value.clone());
            let mut root = draft.root.clone();
            if root.get("buffers").is_some_and(Value::is_array) {
                root["buffers"] = json!([{ "byteLength": draft.bytes.len() }]);
            }
            let text = serde_json::to_vec(&root).expect("JSON");
            match load(&super::container(&text, &draft.bytes)) {
                Ok(_) => models += 1,
                Err(error) => {
                    errors += 1;
                    assert!(
                        error.to_string().starts_with("model.glb: "),
                        "{place} {value}: {error}"
                    );
                }
            }
        }
    }
    assert!(errors > 100 && models > 10, "{errors} {models}");
}

#[test]
fn what_reaches_beyond_a_buffer_is_refused_before_memory_is_taken() {
    let count = |count: u64| changed(|root| root["accessors"][0]["count"] = json!(count)).error();
    for many in [5, 1 << 31, u64::MAX / 12 + 2, u64::MAX] {
        let error = count(many);
        assert!(
            error.contains("accessors[0]") && error.contains("attributes.POSITION)"),
            "{error}"
        );
    }
    assert!(
        count(5).contains("reads past bufferViews[0], which has 48 bytes: 5 elements of 12 bytes"),
        "{}",
        count(5)
    );
    for (pointer, value, message) in [
        ("/accessors/0/byteOffset", json!(1), "reads past bufferViews[0]"),
        ("/accessors/0/byteOffset", json!(u64::MAX), "reads past bufferViews[0]"),
        ("/bufferViews/0/byteStride", json!(13), "13 apart"),
        ("/bufferViews/0/byteStride", json!(0), "leads nowhere"),
        ("/bufferViews/0/byteStride", json!(u64::MAX), "reads past"),
        (
            "/bufferViews/0/byteLength",
            json!(1 << 20),
            "bufferViews[0]: 1048576 bytes from byte 0 on reach beyond buffers[0]",
        ),
        ("/bufferViews/0/byteOffset", json!(u64::MAX), "reach beyond buffers[0]"),
        ("/accessors/0/type", json!("VEC4"), "reads past"),
        ("/accessors/0/type", json!("VEC2"), "elements of 2 numbers"),
        ("/accessors/0/type", json!("MAT2"), "elements “MAT2” are not supported"),
        ("/accessors/0/componentType", json!(5124), "accessors[0].componentType: 5124 is no type"),
        ("/accessors/2/componentType", json!(5122), "indices must be SCALAR"),
        ("/accessors/1/count", json!(3), "has 3 elements for 4 positions"),
    ] {
        let draft = changed(|root| {
            let (parent, name) = pointer.rsplit_once('/').expect("a place");
            root.pointer_mut(parent).expect(parent)[name] = value;
        });
        assert!(draft.error().contains(message), "{message} in {}", draft.error());
    }
}

#[test]
fn zeros_without_a_buffer_are_not_free() {
    let draft = changed(|root| {
        let accessor = root["accessors"][0].as_object_mut().expect("an object");
        accessor.remove("bufferView");
        accessor.insert("count".into(), json!(1_u64 << 40));
    });
    let error = draft.load().err().expect("an error");
    assert_eq!(error.kind, ErrorKind::Resource);
    assert!(error.to_string().contains("out of all proportion"), "{error}");
}

#[test]
fn vertices_that_are_shared_a_million_times_are_refused() {
    let mut draft = Draft::new();
    let position = draft.accessor(5126, "VEC3", 10_000, &vec![0; 120_000]);
    let primitive = json!({ "attributes": { "POSITION": position } });
    draft.node(&vec![primitive; 2000]);
    let error = draft.load().err().expect("an error");
    assert_eq!(error.kind, ErrorKind::Resource, "{error}");
}

#[test]
fn lists_of_places_may_be_empty_and_are_not_free() {
    let mut draft = Draft::of_material(json!({ "emissiveFactor": [1, 1, 1] }));
    let places = draft.accessor(5121, "VEC3", 0, &[]);
    let attributes = json!({ "TRANSLATION": places });
    draft.root["nodes"][0]["extensions"] =
        json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
    assert_eq!(draft.model().surfaces.len(), 0);
    // Nothing but zeros, and each place a copy of what shines.
    draft.root["accessors"][places] =
        json!({ "componentType": 5121, "type": "VEC3", "count": 2_000_000 });
    let error = draft.load().err().expect("an error");
    assert_eq!(error.kind, ErrorKind::Resource, "{error}");
}

#[test]
fn nodes_that_are_no_tree_are_refused() {
    for (nodes, scenes, message) in [
        (
            json!([{ "children": [0] }]),
            json!([{ "nodes": [0] }]),
            "nodes[0].children[0]: leads to nodes[0] a second time",
        ),
        (
            json!([{ "children": [1] }, { "children": [0] }]),
            json!([{ "nodes": [0] }]),
            "nodes[1].children[0]: leads",
        ),
        (
            json!([{ "children": [2] }, { "children": [2] }, {}]),
            json!([{ "nodes": [0, 1] }]),
            "a second time",
        ),
        (
            json!([{ "children": [1] }, { "children": [0] }]),
            json!([]),
            "every node is the child of another one",
        ),
        (json!([{}]), json!([{ "nodes": [0, 0] }]), "scenes[0].nodes[1]: leads"),
    ] {
        let draft = changed(|root| {
            root["nodes"] = nodes;
            root["scenes"] = scenes;
        });
        assert!(draft.error().contains(message), "{message} in {}", draft.error());
    }
}

#[test]
fn a_tree_of_any_depth_is_walked() {
    let deep = 100_000;
    let draft = changed(|root| {
        let chain = (1..deep).map(|child| json!({ "children": [child] }));
        root["nodes"] = chain.chain([json!({ "mesh": 0 })]).collect();
    });
    assert_eq!(draft.model().surfaces.len(), 1);
}

#[test]
fn brackets_without_end_are_an_error() {
    for open in ["[", "{\"a\":"] {
        let text = open.repeat(1 << 20);
        let error =
            Document::parse(text.as_bytes(), Path::new("model.gltf")).expect_err("an error");
        assert!(error.to_string().contains("recursion limit"), "{error}");
    }
}

#[test]
fn transforms_and_coordinates_that_are_not_finite_are_refused() {
    for (node, message) in [
        (json!({ "mesh": 0, "scale": [1e300, 1, 1] }), "nodes[0].scale[0]: "),
        (
            json!({ "mesh": 0, "rotation": [0, 0, 0, 0] }),
            "nodes[0].rotation: a quaternion of length 0",
        ),
        (json!({ "mesh": 0, "matrix": vec![1; 16] }), "nodes[0].matrix: the last row"),
        (json!({ "mesh": 0, "translation": [0, 0] }), "nodes[0].translation: must be a list of 3"),
        (
            json!({ "mesh": 0, "scale": [3e38, 3e38, 3e38], "translation": [3e38, 0, 0] }),
            "nodes[0]: ",
        ),
    ] {
        let draft = changed(|root| root["nodes"] = json!([node]));
        assert!(draft.error().contains(message), "{message} in {}", draft.error());
    }
    let mut draft = Draft::new();
    let position = draft.floats(&[[0.0, 0.0, f32::NAN], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    draft.node(&[json!({ "attributes": { "POSITION": position } })]);
    let message = "meshes[0].primitives[0].attributes: the position of vertex 0 is not finite";
    assert!(draft.error().contains(message), "{}", draft.error());
    let position = draft.floats(&[[0.0; 3]; 3]);
    let colors = draft.floats(&[[-1.0, 0.0, 0.0]; 3]);
    draft.root["meshes"][0]["primitives"][0]["attributes"] =
        json!({ "POSITION": position, "COLOR_0": colors });
    assert!(draft.error().contains("COLOR_0: value 0 of an attribute"), "{}", draft.error());
}

#[test]
fn indices_of_vertices_and_of_sparse_elements_are_checked() {
    let mut draft = changed(|_| {});
    let indices = draft.indices(&[0, 1, 4]);
    draft.root["meshes"][0]["primitives"][0]["indices"] = json!(indices);
    let message = "index 2 is 4, but meshes[0].primitives[0] has 4 vertices";
    assert!(draft.error().contains(message), "{}", draft.error());
    let mut draft = changed(|_| {});
    let view = draft.view(&[9, 9, 9, 9]);
    let zeros = draft.view(&[0; 48]);
    for (count, message) in [
        (1, "accessors[0].sparse: index 0 replaces element 9, but there are only 4"),
        (5, "accessors[0].sparse.count: 5 elements replace 4"),
    ] {
        draft.root["accessors"][0]["sparse"] = json!({
            "count": count,
            "indices": { "bufferView": view, "componentType": 5121 },
            "values": { "bufferView": zeros },
        });
        assert!(draft.error().contains(message), "{message} in {}", draft.error());
    }
    draft.root["accessors"][0]["sparse"]["count"] = json!(2);
    draft.root["accessors"][0]["sparse"]["indices"]["componentType"] = json!(5125);
    let message = "accessors[0].sparse.indices: reads past";
    assert!(draft.error().contains(message), "{}", draft.error());
}

#[test]
fn a_buffer_without_content_is_an_error_where_it_is_used() {
    let mut draft = changed(|_| {});
    draft.bytes.clear();
    draft.root["buffers"] = json!([{ "byteLength": 8 }]);
    let text = serde_json::to_vec(&draft.root).expect("JSON");
    let document = Document::parse(&text, Path::new("model.gltf")).expect("a document");
    let error = translate(&document).err().expect("an error").to_string();
    assert!(error.contains("buffers[0]: has no content"), "{error}");
}
