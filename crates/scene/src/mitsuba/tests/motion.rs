//! Animations and shutters.

use super::*;
use crate::effect::{Effect, Element};
use crate::geometry::{Ray, Rays, Transform};
use crate::scene::Scene;
use etendue_math::glam::DVec3;

const EXPOSED: &str =
    "<sensor type=\"perspective\"><float name=\"shutter_close\" value=\"1\"/></sensor>";

fn keyframe(time: &str, operations: &str) -> String {
    format!("<transform time=\"{time}\">{operations}</transform>")
}

/// From one place to another.
fn animation(start: &str, end: &str) -> String {
    let keyframes = [keyframe("0", start), keyframe("1", end)].concat();
    format!("<animation name=\"toWorld\">{keyframes}</animation>")
}

fn flight() -> String {
    animation("<translate x=\"-1\"/>", "<translate x=\"3\"/>")
}

/// Whether a ray that descends along y meets the scene at a time; it passes y = 0.02 at height 2.
fn meets(scene: &Scene, x: f32, time: f32) -> bool {
    let ray = Ray::new(Vec3::new(x, -49.98, 52.0), Vec3::new(0.0, 1.0, -1.0));
    scene.geometry.at(time).occluded(&ray)
}

#[test]
fn shapes_of_every_kind_and_instances_move() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.obj");
    std::fs::write(&path, "v -1 -1 1\nv 3 -1 1\nv -1 3 1\nf 1 2 3\n").expect("a writable folder");
    let obj = format!("<string name=\"filename\" value=\"{}\"/>", path.display());
    let group = "<shape type=\"shapegroup\" id=\"g\"><shape type=\"sphere\"/></shape>";
    for (before, plugin, inside) in [
        ("", "sphere", ""),
        ("", "cube", ""),
        ("", "disk", ""),
        ("", "rectangle", ""),
        ("", "cylinder", ""),
        ("", "obj", obj.as_str()),
        (group, "instance", "<ref id=\"g\"/>"),
    ] {
        let up = "<translate x=\"-1\" z=\"2\"/>";
        let animation = animation(up, "<translate x=\"3\" z=\"2\"/>");
        let shape =
            format!("{EXPOSED}{before}<shape type=\"{plugin}\">{inside}{animation}</shape>");
        let loaded = load(&shape).expect(plugin);
        let scene = &loaded.scene;
        for time in [0.0, 0.3, 0.75] {
            let x = -1.0 + 4.0 * time + 0.25;
            assert!(meets(scene, x, time), "{plugin} {time}");
            assert!(!meets(scene, x + 4.0, time), "{plugin} {time}");
        }
        let effects = scene.effects();
        let motion = effects.iter().find(|p| p.effect == Effect::MotionBlur).expect("it moves");
        assert_eq!((motion.because, motion.count), (Element::Moving(0), 1));
        let origin = loaded.origins.of(Element::Moving(0)).expect("a place in the file");
        assert_eq!(origin.element, format!("shape “{plugin}”"));
        let instancing = effects.iter().any(|p| p.effect == Effect::Instancing);
        assert_eq!(instancing, plugin == "instance");
    }
}

#[test]
fn sensors_move() {
    let scene = |keyframes: &str| {
        let shutter =
            "<float name=\"shutterOpen\" value=\"0.5\"/><float name=\"shutterClose\" value=\"1\"/>";
        let sensor = format!("<sensor type=\"orthographic\">{shutter}{keyframes}</sensor>");
        load(&sensor).expect("a scene").scene
    };
    let moving = scene(&animation("", "<rotate z=\"1\" angle=\"90\"/><translate x=\"4\"/>"));
    assert!(moving.has_motion());
    for (share, angle, x) in [(0.0, 45.0, 2.0), (0.5, 67.5, 3.0)] {
        let ray = moving.camera.ray_at([10.0, 20.0], [0.5; 2], share);
        let still = scene(&format!(
            "<transform name=\"to_world\"><rotate z=\"1\" angle=\"{angle}\"/><translate x=\"{x}\"/></transform>"
        ));
        assert!(!still.has_motion());
        let expected = still.camera.ray_at([10.0, 20.0], [0.5; 2], 0.0);
        // Rounding of f32 at coordinates up to 4.
        assert!((ray.origin - expected.origin).length() < 1e-6, "{share}");
        assert_eq!(ray.direction, expected.direction);
        assert!((moving.camera.depth_at(Vec3::Z, share) - 1.0).abs() < 1e-6);
    }
    let [presence] = moving.effects()[..] else { panic!() };
    assert_eq!((presence.effect, presence.because), (Effect::MotionBlur, Element::Camera));
}

#[test]
fn a_shutter_that_opens_for_an_instant_shows_what_stands_there() {
    let shape = |place: &str| format!("<shape type=\"sphere\">{place}</shape>");
    let sensor = |shutter: &str| format!("<sensor type=\"perspective\">{shutter}</sensor>");
    let open = |time: &str| {
        let times = ["shutter_open", "shutter_close"];
        sensor(&times.map(|name| format!("<float name=\"{name}\" value=\"{time}\"/>")).concat())
    };
    let geometry = |content: &str| load(content).expect(content).scene.geometry;
    let still = |x: f64| {
        geometry(&shape(&format!(
            "<transform name=\"to_world\"><translate x=\"{x}\"/></transform>"
        )))
    };
    // Without a shutter: where the animation is at 0.
    for (sensor, x) in
        [(String::new(), -1.0), (open("-3"), -1.0), (open("1"), 3.0), (open("0.5"), 1.0)]
    {
        let found = geometry(&(sensor + &shape(&flight())));
        assert_eq!(found.moving_count(), 0);
        assert_eq!(found.shapes(), still(x).shapes(), "{x}");
    }
}

#[test]
fn equal_keyframes_and_open_shutters_alone_move_nothing() {
    let rest = animation("<rotate x=\"1\" angle=\"30\"/>", "<rotate x=\"1\" angle=\"30\"/>");
    let one = format!(
        "<animation name=\"to_world\">{}</animation>",
        keyframe("7", "<rotate x=\"1\" angle=\"30\"/>")
    );
    let still = "<transform name=\"to_world\"><rotate x=\"1\" angle=\"30\"/></transform>";
    let scene = |place: &str| {
        load(&format!("{EXPOSED}<shape type=\"cube\">{place}</shape>")).expect(place).scene
    };
    for place in [rest.as_str(), &one] {
        assert!(!scene(place).has_motion());
        assert_eq!(scene(place).geometry.shapes(), scene(still).geometry.shapes());
    }
    assert!(!scene(still).has_motion());
}

#[test]
fn animations_that_cannot_be_are_refused_where_they_stand() {
    let sphere = |place: &str| format!("{EXPOSED}\n<shape type=\"sphere\">\n{place}</shape>");
    let of = |keyframes: &[String]| {
        sphere(&format!("<animation name=\"to_world\">\n{}</animation>", keyframes.join("\n")))
    };
    let at = |time| keyframe(time, "");
    refused(&of(&[]), 4, "“to_world”: an animation needs a keyframe");
    refused(&of(&[at("0"), at("1"), at("1")]), 7, "increasing times, but 1 follows 1");
    refused(&of(&[at("0"), at("-1")]), 6, "increasing times, but -1 follows 0");
    refused(&of(&[at("nan")]), 5, "“nan” is not a finite number");
    refused(&of(&["<transform/>".into()]), 5, "<transform> needs the attribute “time”");
    refused(
        &of(&["<translate x=\"1\"/>".into()]),
        5,
        "<translate> cannot stand inside <animation>",
    );
    refused(&of(&["<transform name=\"a\" time=\"0\"/>".into()]), 5, "has no attribute “name”");
    refused(&of(&[at("0"), keyframe("1", "<scale x=\"0\"/>")]), 6, "the transform is singular");
    refused(&of(&[at("0"), keyframe("1", "<scale x=\"-1\"/>")]), 6, "differ in handedness");
    refused(&of(&[at("0"), keyframe("1", "<scale x=\"2\"/>")]), 3, "scales this shape unequally");
    refused(
        &sphere(&format!("{}<transform name=\"to_world\"/>", flight())),
        4,
        "“to_world” is given twice",
    );
    let error = load(&of(&[at("0"), at("1"), keyframe("0.5", "")])).expect_err("out of order");
    assert_eq!(error.location.column, Some(1));
}

#[test]
fn shutters_that_close_before_they_open_are_refused() {
    let sensor = |shutter: &str| {
        format!(
            "<sensor type=\"thinlens\"><float name=\"aperture_radius\" value=\"1\"/>\n{shutter}</sensor>"
        )
    };
    let [open, close] = ["open", "close"].map(|name| {
        move |time: &str| format!("\n<float name=\"shutter_{name}\" value=\"{time}\"/>")
    });
    refused(
        &sensor(&(open("1") + &close("0.5"))),
        5,
        "the shutter closes at 0.5, before it opens at 1",
    );
    refused(&sensor(&open("0.25")), 4, "the shutter closes at 0, before it opens at 0.25");
    refused(&sensor(&(open("-1e308") + &close("1e308"))), 5, "a time of the shutter is not finite");
    refused(&sensor("\n<string name=\"shutter_open\" value=\"0\"/>"), 4, "must be a float");
}

#[test]
fn what_cannot_move_says_so() {
    let flight = flight();
    let lamp = "<emitter type=\"area\"/>";
    refused(
        &format!("{EXPOSED}<shape type=\"sphere\">\n{lamp}{flight}</shape>"),
        3,
        "an emitter cannot move yet",
    );
    refused(
        &format!("<emitter type=\"point\">\n{flight}</emitter>"),
        3,
        "emitter “point” cannot move",
    );
    let group = format!(
        "{EXPOSED}<shape type=\"shapegroup\" id=\"g\">\n<shape type=\"sphere\">{flight}</shape></shape>"
    );
    refused(&group, 3, "a shapegroup cannot contain shapes that move; let its instances move");
    // A lamp stands still where the shutter only opens for an instant.
    assert!(load(&format!("<shape type=\"sphere\">{lamp}{flight}</shape>")).is_ok());
}

#[test]
fn a_half_turn_is_a_warning() {
    let warnings = |angle: &str| {
        let turn = animation("", &format!("\n<rotate y=\"1\" angle=\"{angle}\"/>"));
        let cube = format!("{EXPOSED}\n<shape type=\"cube\">\n{turn}</shape>");
        load(&cube).expect("a cube").warnings
    };
    let [warning] = &warnings("180")[..] else { panic!() };
    assert!(warning.to_string().contains("turns by 180°"), "{warning}");
    assert_eq!(warning.location.line, Some(4));
    assert!(warnings("179").is_empty());
}

#[test]
fn mirrored_shapes_move_as_they_stand() {
    // Vertex normals of a file, or those of its triangles; spheres and cylinders are turned inside out, others are not.
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.obj");
    std::fs::write(&path, "v -1 -1 1\nv 3 -1 1\nv -1 3 1\nf 1 2 3\n").expect("a writable folder");
    let file = format!("<string name=\"filename\" value=\"{}\"/>", path.display());
    let flat = format!("{file}<boolean name=\"face_normals\" value=\"true\"/>");
    for (plugin, inside) in [
        ("sphere", ""),
        ("cube", ""),
        ("disk", ""),
        ("rectangle", ""),
        ("cylinder", ""),
        ("obj", file.as_str()),
        ("obj", flat.as_str()),
    ] {
        let end = "<scale x=\"-1\"/><rotate y=\"1\" angle=\"20\"/>";
        let moving = animation(end, &format!("{end}<translate z=\"1\"/>"));
        let still = format!("<transform name=\"to_world\">{end}</transform>");
        let [moving, still] = [moving, still].map(|place| {
            let shape = format!("{EXPOSED}<shape type=\"{plugin}\">{inside}{place}</shape>");
            load(&shape).expect(plugin).scene.geometry
        });
        // Low enough to meet the side of a cylinder.
        let ray = Ray::new(Vec3::new(0.1, 50.2, 49.8), Vec3::new(0.0, -1.0, -1.0));
        let points = [&moving, &still, &moving.clone().without_motion()].map(|geometry| {
            let hit = geometry.intersect(&ray).expect(plugin);
            geometry.surface_point(&ray, &hit)
        });
        let [a, b, c] = points.map(|point| (point.normal, point.shading.n));
        // Rounding of a placement, and of vertex normals before and after it.
        for (a, b) in [(a, b), (c, b)] {
            let distance = (a.0 - b.0).length().max((a.1 - b.1).length());
            assert!(distance < 1e-6, "{plugin} {a:?} {b:?}");
        }
    }
}

#[test]
fn without_motion_blur_everything_stands_where_the_shutter_opens() {
    let sensor = format!(
        "<sensor type=\"perspective\"><float name=\"shutter_close\" value=\"1\"/>{}</sensor>",
        flight()
    );
    let turning = animation("<rotate z=\"1\" angle=\"20\"/>", "<rotate z=\"1\" angle=\"70\"/>");
    let loaded = load(&format!("{sensor}<shape type=\"cube\">{turning}</shape>")).expect("a scene");
    let without = loaded.scene.without(&[Effect::MotionBlur].into());
    assert!(!without.has_motion());
    assert!(without.effects().iter().all(|presence| presence.effect != Effect::MotionBlur));
    let place = "<transform name=\"to_world\"><rotate z=\"1\" angle=\"20\"/></transform>";
    let still = load(&format!("<shape type=\"cube\">{place}</shape>")).expect("a cube").scene;
    assert_eq!(without.geometry.shapes(), still.geometry.shapes());
    assert_eq!(
        without.camera.position(),
        Transform::translate(-DVec3::X).expect("a shift").point(Vec3::ZERO)
    );
}
