//! Lights and cameras.

use alloc::vec;

use etendue_math::Real;
use etendue_math::glam::Vec3;
use serde_json::{Value, json};

use super::{Draft, warnings};
use crate::Color;
use crate::camera::{Camera, Projection};
use crate::light::Light;
use crate::{LoadOptions, LoadedScene, load_scene};

/// A scene with one node, which has a light and looks along −y.
fn with_light(light: Value) -> Draft {
    let mut draft = Draft::new();
    let half = core::f64::consts::FRAC_1_SQRT_2;
    draft.root["extensions"] = json!({ "KHR_lights_punctual": { "lights": [] } });
    draft.root["extensions"]["KHR_lights_punctual"]["lights"] = Value::Array(vec![light]);
    draft.add(
        "nodes",
        json!({
            "translation": [1, 2, 3],
            "rotation": [-half, 0, 0, half],
            "scale": [7, 7, 7],
            "extensions": { "KHR_lights_punctual": { "light": 0 } },
        }),
    );
    draft
}

fn light(light: Value) -> Light {
    with_light(light).model().lights.remove(0)
}

#[test]
fn numbers_of_candela_and_lux_are_kept() {
    let Light::Point(point) =
        light(json!({ "type": "point", "color": [1, 0.5, 0], "intensity": 4 }))
    else {
        panic!("a point");
    };
    assert_eq!(point.position, Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(point.intensity, Color::new(4.0, 2.0, 0.0));
    let Light::Directional(sun) = light(json!({ "type": "directional", "intensity": 3 })) else {
        panic!("a direction");
    };
    // A quarter of a turn, to a rounding.
    assert!((sun.direction - -Vec3::Y).length() < 1e-7, "{}", sun.direction);
    assert_eq!(sun.irradiance, Color::new(3.0, 3.0, 3.0));
}

#[test]
fn a_spot_shines_along_its_node_between_two_angles() {
    let cone = json!({ "innerConeAngle": 0.25, "outerConeAngle": 0.5 });
    let Light::Spot(spot) = light(json!({ "type": "spot", "spot": cone })) else {
        panic!("a spot")
    };
    assert_eq!(spot.position(), Vec3::new(1.0, 2.0, 3.0));
    assert!((spot.axis() - -Vec3::Y).length() < 1e-7, "{}", spot.axis());
    let [cutoff, beam] = spot.angles();
    // Radians to degrees and back.
    assert!((cutoff - 0.5).abs() < 1e-7 && (beam - 0.25).abs() < 1e-7, "{cutoff} {beam}");
    let Light::Spot(spot) = light(json!({ "type": "spot" })) else { panic!("a spot") };
    assert!(
        (spot.angles()[0] - core::f32::consts::FRAC_PI_4).abs() < 1e-7 && spot.angles()[1] == 0.0
    );
}

#[test]
fn lights_outside_their_domain_are_refused_where_they_stand() {
    let place = "extensions.KHR_lights_punctual.lights[0]";
    for (described, fragments) in [
        (json!({}), ["", "has no “type”"]),
        (json!({ "type": "sun" }), [".type", "“sun” is none of point"]),
        (json!({ "type": "point", "intensity": -1 }), [".intensity", "at least 0, not -1"]),
        (json!({ "type": "point", "color": [1, -1, 1] }), ["", "not negative"]),
        (json!({ "type": "point", "color": [1, 1] }), [".color", "a list of 3 numbers"]),
        (
            json!({ "type": "point", "color": [1e30, 1, 1], "intensity": 1e30 }),
            ["", "beyond single precision"],
        ),
        (
            json!({ "type": "spot", "spot": { "outerConeAngle": 3 } }),
            [".spot.outerConeAngle", "from 0 to"],
        ),
        (json!({ "type": "spot", "spot": { "innerConeAngle": 1 } }), ["", "beam width"]),
    ] {
        let error = with_light(described).error();
        for fragment in [&alloc::format!("{place}{}", fragments[0]), fragments[1]] {
            assert!(error.contains(fragment), "{fragment} in {error}");
        }
    }
    let mut draft = with_light(json!({ "type": "point" }));
    draft.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = json!(1);
    let error = draft.error();
    assert!(
        error.contains("nodes[0].extensions.KHR_lights_punctual.light: there is no"),
        "{error}"
    );
    draft.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = json!(0);
    draft.root["nodes"][0]["translation"] = json!([3e38, 0, 0]);
    draft.add("nodes", json!({ "children": [0], "translation": [3e38, 0, 0] }));
    assert!(draft.error().contains("cannot be placed"), "{}", draft.error());
}

/// A camera at (0, 0, 5) that looks at the origin, in a scene with a square.
fn with_camera(camera: Value) -> Draft {
    let mut draft = Draft::of_material(json!({}));
    draft.root["cameras"] = Value::Array(vec![camera]);
    draft.add("nodes", json!({ "camera": 0, "translation": [0, 0, 5], "scale": [3, 3, 3] }));
    draft
}

fn loaded(draft: &Draft, options: &LoadOptions) -> LoadedScene {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("model.glb");
    std::fs::write(&path, draft.glb()).expect("a writable folder");
    load_scene(&path, options).unwrap_or_else(|error| panic!("{error}"))
}

/// Where the ray through a point of the picture, in shares of it, crosses the plane z = 0.
fn seen(camera: &Camera, size: [u32; 2], [x, y]: [f32; 2]) -> Vec3 {
    let ray = camera.ray([x * size[0] as f32, y * size[1] as f32], [0.5; 2]);
    ray.origin - ray.direction * (ray.origin.z / ray.direction.z)
}

#[test]
fn a_camera_looks_along_its_node_with_up_and_right_where_they_belong() {
    let lens = json!({ "yfov": 0.5, "aspectRatio": 2.0, "znear": 0.1 });
    let draft = with_camera(json!({ "type": "perspective", "perspective": lens }));
    let scene = loaded(&draft, &LoadOptions::default()).scene;
    assert_eq!(scene.film.size, [768, 384]);
    let half = 5.0 * Real::tan(0.25_f32);
    for (at, expected) in [
        ([0.5, 0.5], Vec3::ZERO),
        ([1.0, 0.5], Vec3::X * (2.0 * half)),
        ([0.5, 0.0], Vec3::Y * half),
    ] {
        let found = seen(&scene.camera, scene.film.size, at);
        // Roundings of a ray of length 5.
        assert!((found - expected).length() < 1e-5, "{found} {expected}");
    }
    // Another size sees as much from below to above.
    let options = LoadOptions { film_size: Some([100, 100]), ..LoadOptions::default() };
    let scene = loaded(&draft, &options).scene;
    let found = seen(&scene.camera, scene.film.size, [1.0, 0.0]);
    assert!((found - Vec3::new(half, half, 0.0)).length() < 1e-5, "{found}");
}

#[test]
fn an_orthographic_camera_sees_its_magnification() {
    let lens = json!({ "xmag": 1.5, "ymag": 3.0, "znear": 0.0, "zfar": 10.0 });
    let draft = with_camera(json!({ "type": "orthographic", "orthographic": lens }));
    let scene = loaded(&draft, &LoadOptions::default()).scene;
    assert_eq!(scene.film.size, [384, 768]);
    assert_eq!(scene.camera.projection(), Projection::Orthographic);
    let found = seen(&scene.camera, scene.film.size, [1.0, 0.0]);
    assert!((found - Vec3::new(1.5, 3.0, 0.0)).length() < 1e-5, "{found}");
}

#[test]
fn cameras_that_see_nothing_are_refused() {
    for (camera, fragment) in [
        (json!({ "type": "fisheye" }), "cameras[0].type: “fisheye”"),
        (json!({ "type": "perspective" }), "cameras[0]: has no “perspective”"),
        (
            json!({ "type": "perspective", "perspective": { "yfov": 4, "znear": 1 } }),
            "cameras[0].perspective.yfov: must lie between",
        ),
        (
            json!({ "type": "perspective", "perspective": { "yfov": 1, "znear": 0 } }),
            "znear must be positive",
        ),
        (
            json!({ "type": "perspective", "perspective": { "yfov": 1, "znear": 2, "zfar": 1 } }),
            "zfar must be larger",
        ),
        (
            json!({ "type": "perspective", "perspective": { "yfov": 1, "znear": 1, "aspectRatio": 0 } }),
            "aspectRatio must be positive",
        ),
        (
            json!({ "type": "orthographic", "orthographic": { "xmag": 0, "ymag": 1, "znear": 0 } }),
            "xmag must be positive",
        ),
    ] {
        let error = with_camera(camera).error();
        assert!(error.contains(fragment), "{fragment} in {error}");
    }
    let lens = json!({ "yfov": 0.5, "znear": 0.1 });
    let mut draft = with_camera(json!({ "type": "perspective", "perspective": lens }));
    draft.root["nodes"][1]["scale"] = json!([1, 1, 0]);
    assert!(draft.error().contains("nodes[1]: cannot hold a camera"), "{}", draft.error());
}

#[test]
fn without_light_and_camera_there_are_those_of_a_bare_mesh() {
    let draft = Draft::of_material(json!({}));
    let loaded = loaded(&draft, &LoadOptions::default());
    assert!(matches!(loaded.scene.lights[..], [Light::Constant(_)]));
    assert_eq!(loaded.scene.film.size, [768, 576]);
    assert!(warnings(&draft.model()).is_empty());
}

#[test]
fn the_bsdf_of_the_options_replaces_every_material() {
    let draft = Draft::of_material(json!({}));
    let bsdf = Some("diffuse:reflectance=0.25".into());
    let scene = loaded(&draft, &LoadOptions { bsdf, ..LoadOptions::default() }).scene;
    assert_eq!(scene.effects().iter().filter(|p| p.effect == crate::Effect::Principled).count(), 0);
}
