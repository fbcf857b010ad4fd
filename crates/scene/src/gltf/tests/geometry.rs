//! Meshes, nodes and cameras.

use alloc::vec;
use alloc::vec::Vec;

use etendue_math::glam::Vec3;
use serde_json::json;

use super::{Draft, corners, meshes, warnings};
use crate::geometry::Ray;

/// The corners of the only mesh.
fn only(draft: &Draft) -> Vec<[Vec3; 3]> {
    let meshes = meshes(&draft.model());
    assert_eq!(meshes.len(), 1);
    corners(&meshes[0])
}

/// A triangle in the plane z = 0, anticlockwise as seen from +z.
const TRIANGLE: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

#[test]
fn triangles_strips_and_fans_are_read_with_and_without_indices() {
    let mut draft = Draft::new();
    let points = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [1., 1., 0.]];
    let position = draft.floats(&points);
    draft.node(&[json!({ "attributes": { "POSITION": position } })]);
    let [a, b, c, d] = points.map(Vec3::from);
    // An incomplete triangle at the end is none.
    assert_eq!(only(&draft), [[a, b, c]]);
    draft.root["meshes"][0]["primitives"][0]["mode"] = json!(5);
    assert_eq!(only(&draft), [[a, b, c], [b, d, c]]);
    draft.root["meshes"][0]["primitives"][0]["mode"] = json!(6);
    assert_eq!(only(&draft), [[b, c, a], [c, d, a]]);
    for (component, bytes) in [
        (5121, vec![3, 2, 1]),
        (5123, vec![3, 0, 2, 0, 1, 0]),
        (5125, vec![3, 0, 0, 0, 2, 0, 0, 0, 1, 0, 0, 0]),
    ] {
        let indices = draft.accessor(component, "SCALAR", 3, &bytes);
        draft.root["meshes"][0]["primitives"][0]["indices"] = json!(indices);
        draft.root["meshes"][0]["primitives"][0]["mode"] = json!(4);
        assert_eq!(only(&draft), [[d, c, b]]);
    }
    // Vertices that no triangle has are forgotten.
    assert_eq!(meshes(&draft.model())[0].positions().len(), 3);
}

#[test]
fn points_and_lines_are_left_out_with_a_warning() {
    let mut draft = Draft::new();
    let position = draft.floats(&TRIANGLE);
    draft.node(&[
        json!({ "attributes": { "POSITION": position }, "mode": 1 }),
        json!({ "attributes": { "POSITION": position } }),
        json!({ "attributes": {} }),
    ]);
    let model = draft.model();
    assert_eq!(model.surfaces.len(), 1);
    let warnings = warnings(&model);
    assert!(warnings[0].starts_with("meshes[0].primitives[0]: points, lines"), "{warnings:?}");
    assert_eq!(warnings.len(), 2);
}

#[test]
fn meshes_without_normals_are_faceted_and_normals_decide_the_front() {
    let mut draft = Draft::new();
    let square = draft.square();
    draft.node(&[square]);
    assert!(meshes(&draft.model())[0].normals().is_empty());
    let normal = draft.floats(&[[0.0, 0.0, -1.0]; 4]);
    draft.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(normal);
    let mesh = &meshes(&draft.model())[0];
    assert_eq!(mesh.facet(0).normal, -Vec3::Z);
    assert_eq!(mesh.normals(), [-Vec3::Z; 4]);
}

#[test]
fn sparse_elements_replace_others_and_zeros() {
    let mut draft = Draft::new();
    let position = draft.floats(&TRIANGLE);
    draft.node(&[json!({ "attributes": { "POSITION": position } })]);
    let indices = draft.view(&[2]);
    let values: Vec<u8> = [3.0_f32, 4.0, 5.0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let values = draft.view(&values);
    draft.root["accessors"][position]["sparse"] = json!({
        "count": 1,
        "indices": { "bufferView": indices, "componentType": 5121 },
        "values": { "bufferView": values },
    });
    let [a, b, _] = TRIANGLE.map(Vec3::from);
    let new = Vec3::new(3.0, 4.0, 5.0);
    assert_eq!(only(&draft), [[a, b, new]]);
    let accessor = draft.root["accessors"][position].as_object_mut().expect("an object");
    accessor.remove("bufferView");
    assert_eq!(only(&draft), [[Vec3::ZERO, Vec3::ZERO, new]]);
}

#[test]
fn quantised_positions_are_scaled_by_their_node_and_strides_are_kept() {
    let mut draft = Draft::new();
    // Bytes of four, the last of them filling.
    let bytes = [0, 0, 0, 9, 255, 0, 0, 9, 0, 51, 0, 9];
    let position = draft.accessor(5121, "VEC3", 3, &bytes);
    let view = draft.root["accessors"][position]["bufferView"].as_u64().expect("an index");
    draft.root["bufferViews"][view as usize]["byteStride"] = json!(4);
    let normal: Vec<u8> = [0_i16, 0, 32767].iter().flat_map(|x| x.to_le_bytes()).collect();
    let normal = draft.accessor(5122, "VEC3", 3, &normal.repeat(3));
    draft.root["accessors"][normal]["normalized"] = json!(true);
    let attributes = json!({ "POSITION": position, "NORMAL": normal });
    draft.node(&[json!({ "attributes": attributes })]);
    draft.root["nodes"][0]["scale"] = json!([2, 2, 2]);
    let corners = |draft: &Draft| only(draft)[0].map(|p| p.to_array());
    assert_eq!(corners(&draft), [[0.0; 3], [510.0, 0.0, 0.0], [0.0, 102.0, 0.0]]);
    draft.root["accessors"][position]["normalized"] = json!(true);
    assert_eq!(corners(&draft), [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 0.4, 0.0]]);
    assert_eq!(meshes(&draft.model())[0].normals(), [Vec3::Z; 3]);
}

#[test]
fn signed_numbers_are_normalised_to_one_on_both_sides() {
    let mut draft = Draft::new();
    let position = draft.accessor(5120, "VEC3", 3, &[0x80, 0x81, 127, 0, 0, 0, 127, 0, 0]);
    draft.root["accessors"][position]["normalized"] = json!(true);
    draft.node(&[json!({ "attributes": { "POSITION": position } })]);
    assert_eq!(only(&draft)[0][0], Vec3::new(-1.0, -1.0, 1.0));
}

#[test]
fn nodes_place_what_hangs_below_them() {
    let mut draft = Draft::new();
    let position = draft.floats(&TRIANGLE);
    let child = draft.node(&[json!({ "attributes": { "POSITION": position } })]);
    // A quarter of a turn about z, then twice as large, moved up; then moved along x by a matrix, column by column.
    let half = core::f64::consts::FRAC_1_SQRT_2;
    draft.root["nodes"][child]["rotation"] = json!([0.0, 0.0, half, half]);
    draft.root["nodes"][child]["scale"] = json!([2.0, 3.0, 1.0]);
    draft.root["nodes"][child]["translation"] = json!([0.0, 0.0, 5.0]);
    let matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 10, 0, 0, 1];
    draft.add("nodes", json!({ "children": [child], "matrix": matrix }));
    // Scales act first, so that x, twice as long, becomes y.
    let expected = [[10.0, 0.0, 5.0], [10.0, 2.0, 5.0], [7.0, 0.0, 5.0]].map(Vec3::from);
    for (found, expected) in only(&draft)[0].iter().zip(expected) {
        // The rounding of a number of order 10.
        assert!((found - expected).length() < 1e-6, "{found} {expected}");
    }
}

#[test]
fn mirrored_nodes_keep_fronts_in_front() {
    let mut draft = Draft::new();
    let square = draft.square();
    let node = draft.node(&[square]);
    draft.root["nodes"][node]["scale"] = json!([-1, 1, 1]);
    assert_eq!(meshes(&draft.model())[0].facet(0).normal, Vec3::Z);
    draft.root["nodes"][node]["scale"] = json!([0, 1, 1]);
    let model = draft.model();
    assert_eq!(model.surfaces.len(), 0);
    assert!(warnings(&model)[0].contains("nodes[0]: its mesh is flattened"));
}

#[test]
fn a_mesh_that_is_used_again_is_instanced() {
    let mut draft = Draft::new();
    let square = draft.square();
    draft.node(&[square]);
    draft.add("nodes", json!({ "mesh": 0, "translation": [4, 0, 0] }));
    draft.add("nodes", json!({ "mesh": 0, "translation": [8, 0, 0], "scale": [2, 2, 1] }));
    let model = draft.model();
    assert_eq!(model.surfaces.len(), 1);
    let geometry = model.geometry.build();
    assert_eq!(geometry.instance_count(), 3);
    for (x, is_hit) in
        [(0.5, true), (2.0, false), (4.5, true), (6.5, true), (9.5, true), (10.5, false)]
    {
        let ray = Ray::new(Vec3::new(x, 0.3, 1.0), -Vec3::Z);
        assert_eq!(geometry.intersect(&ray).is_some(), is_hit, "{x}");
    }
}

#[test]
fn places_may_be_listed_in_a_buffer() {
    let mut draft = Draft::new();
    let square = draft.square();
    let node = draft.node(&[square]);
    let translation = draft.floats(&[[0.0, 0.0, 0.0], [4.0, 0.0, 0.0]]);
    let scale = draft.floats(&[[1.0, 1.0, 1.0], [0.5, 0.5, 1.0]]);
    let attributes = json!({ "TRANSLATION": translation, "SCALE": scale });
    draft.root["nodes"][node]["extensions"] =
        json!({ "EXT_mesh_gpu_instancing": { "attributes": attributes } });
    draft.root["nodes"][node]["translation"] = json!([10, 0, 0]);
    let geometry = draft.model().geometry.build();
    assert_eq!(geometry.instance_count(), 2);
    for (x, is_hit) in [(0.5, false), (10.9, true), (14.4, true), (14.6, false)] {
        let ray = Ray::new(Vec3::new(x, 0.3, 1.0), -Vec3::Z);
        assert_eq!(geometry.intersect(&ray).is_some(), is_hit, "{x}");
    }
    let short = draft.floats(&[[1.0, 1.0, 1.0]]);
    draft.root["nodes"][node]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
        json!(short);
    assert!(draft.error().contains("not equally long"), "{}", draft.error());
}

#[test]
fn what_shines_stands_in_the_world_however_often_it_is_used() {
    let mut draft = Draft::of_material(json!({ "emissiveFactor": [1, 1, 1] }));
    draft.add("nodes", json!({ "mesh": 0, "translation": [4, 0, 0] }));
    let model = draft.model();
    assert_eq!((model.surfaces.len(), model.lights.len()), (2, 2));
    assert_eq!(model.geometry.build().instance_count(), 0);
}

/// A triangle that hangs on two joints: its last vertex half on each.
fn skinned() -> Draft {
    let mut draft = Draft::new();
    let position = draft.floats(&TRIANGLE);
    let normal = draft.floats(&[[0.0, 0.0, 1.0]; 3]);
    let joints = draft.accessor(5121, "VEC4", 3, &[0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0]);
    let weights = draft.floats(&[[1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0]]);
    draft.node(&[json!({ "attributes": {
        "POSITION": position, "NORMAL": normal, "JOINTS_0": joints, "WEIGHTS_0": weights,
    }})]);
    // The node of the mesh is ignored, and the second joint is bound where it stands.
    draft.root["nodes"][0]["translation"] = json!([100, 0, 0]);
    draft.root["nodes"][0]["skin"] = json!(0);
    draft.add("nodes", json!({ "translation": [0, 0, 1], "children": [2] }));
    draft.add("nodes", json!({ "translation": [0, 4, 0], "scale": [2, 2, 2] }));
    let unit = [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.];
    let mut bind = [unit; 2];
    bind[1][13] = -1.0;
    let bytes: Vec<u8> = bind.iter().flatten().flat_map(|x: &f32| x.to_le_bytes()).collect();
    let matrices = draft.accessor(5126, "MAT4", 2, &bytes);
    draft.root["skins"] = json!([{ "joints": [1, 2], "inverseBindMatrices": matrices }]);
    draft
}

#[test]
fn skins_hang_on_their_joints_at_rest() {
    // By the second joint: 2 (p − y) + 4 y + z.
    let expected = [[0.0, 0.0, 1.0], [2.0, 2.0, 1.0], [0.0, 0.5 * 1.0 + 0.5 * 4.0, 1.0]];
    assert_eq!(only(&skinned())[0], expected.map(Vec3::from));
    assert_eq!(meshes(&skinned().model())[0].normals(), [Vec3::Z; 3]);
}

#[test]
fn skins_that_do_not_fit_are_refused() {
    for (pointer, value, message) in [
        ("/nodes/0/skin", json!(1), "nodes[0].skin: there is no skins[1]"),
        ("/skins/0/joints/0", json!(9), "skins[0].joints[0]: nodes[9] is no part of the scene"),
        ("/skins/0/joints", json!([1]), "there is no joint 1, the skin has 1"),
        ("/skins/0/joints", json!([1, 2, 1]), "2 matrices are too few for 3 joints"),
    ] {
        let mut draft = skinned();
        *draft.root.pointer_mut(pointer).expect(pointer) = value;
        assert!(draft.error().contains(message), "{message} in {}", draft.error());
    }
    for (name, message) in
        [("WEIGHTS_0", "has JOINTS_0 without WEIGHTS_0"), ("JOINTS_0", "has no JOINTS_0")]
    {
        let mut draft = skinned();
        let attributes = &mut draft.root["meshes"][0]["primitives"][0]["attributes"];
        attributes.as_object_mut().expect("an object").remove(name);
        assert!(draft.error().contains(message), "{message} in {}", draft.error());
    }
}
