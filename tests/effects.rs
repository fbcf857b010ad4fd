//! `etendue effects`: what scenes call for, and why.

mod common;

use std::collections::HashSet;

use common::Folder;
use common::effects::{list, names};
use serde_json::Value;

const NOTHING: &str = r#"<scene version="3.0.0">
    <integrator type="path"><integer name="max_depth" value="2"/></integrator>
    <emitter type="point"/>
    <bsdf type="dielectric" id="unused"/>
    <shape type="sphere"><bsdf type="diffuse"/></shape>
</scene>"#;

const MUCH: &str = r#"<scene version="3.0.0">
    <integrator type="path">
        <boolean name="hide_emitters" value="true"/>
        <boolean name="strict_normals" value="true"/>
    </integrator>
    <sensor type="thinlens">
        <float name="aperture_radius" value="0.1"/> <float name="shutter_close" value="1"/>
    </sensor>
    <emitter type="constant"/>
    <emitter type="directional"/>
    <emitter type="spot"/>
    <emitter type="projector"/>
    <texture type="checkerboard" id="board"/>
    <bsdf type="conductor" id="mirror"/>
    <shape type="sphere"><ref id="mirror"/></shape>
    <shape type="sphere"><ref id="mirror"/></shape>
    <shape type="sphere"><bsdf type="thindielectric"/></shape>
    <shape type="sphere"><bsdf type="mask">
        <float name="opacity" value="0.5"/>
        <bsdf type="diffuse"><ref name="reflectance" id="board"/></bsdf>
    </bsdf></shape>
    <shape type="sphere"><bsdf type="null"/></shape>
    <shape type="shapegroup" id="group"><shape type="sphere"><bsdf type="roughdielectric"/></shape></shape>
    <shape type="instance"><ref id="group"/></shape>
    <shape type="instance"><ref id="group"/></shape>
    <shape type="rectangle"><emitter type="area"/></shape>
    <shape type="sphere"><animation name="to_world">
        <transform time="0"/> <transform time="2"><translate x="1"/></transform>
    </animation></shape>
</scene>"#;

/// A mirror and a chequered, half transparent ball under a lamp.
const SEEN: &str = r#"<scene version="3.0.0">
    <sensor type="perspective">
        <transform name="to_world"><lookat origin="0, 0, 6" target="0, 0, 0" up="0, 1, 0"/></transform>
    </sensor>
    <emitter type="point"><point name="position" x="0" y="3" z="5"/></emitter>
    <shape type="sphere"><point name="center" x="-1" y="0" z="0"/><bsdf type="conductor"/></shape>
    <shape type="sphere"><point name="center" x="1" y="0" z="0"/><bsdf type="mask">
        <float name="opacity" value="0.5"/>
        <bsdf type="diffuse"><texture name="reflectance" type="checkerboard"/></bsdf>
    </bsdf></shape>
</scene>"#;

const SURFACES: &str = r#"<scene version="3.0.0">
    <shape type="sphere"><bsdf type="principled"><float name="spec_trans" value="0.5"/></bsdf></shape>
    <shape type="sphere"><bsdf type="blendbsdf"><bsdf type="diffuse"/><bsdf type="diffuse"/></bsdf></shape>
    <shape type="sphere"><bsdf type="normalmap">
        <rgb name="normalmap" value="0.5 0.5 1"/><bsdf type="diffuse"/>
    </bsdf></shape>
</scene>"#;

fn effects(scene: &str) -> Vec<Value> {
    effects_with(scene, &[])
}

fn effects_with(scene: &str, arguments: &[&str]) -> Vec<Value> {
    let folder = Folder::new();
    folder.write("scene.xml", scene);
    list(&folder, "scene.xml", arguments)
}

/// The bytes of a small picture of a scene.
fn picture(scene: &str, arguments: &[&str]) -> Vec<u8> {
    let folder = Folder::new();
    folder.write("scene.xml", scene);
    let fixed = ["render", "scene.xml", "-o", "p.pfm", "-q", "--spp", "4", "--size", "24x24"];
    let outcome = folder.run(&[&fixed, arguments].concat());
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    std::fs::read(folder.path("p.pfm")).expect("a picture")
}

/// Names and reasons of those that are present.
fn present(effects: &[Value]) -> Vec<(&str, &str)> {
    let present = effects.iter().filter(|effect| effect["present"] == true);
    let text = |value| Value::as_str(value).expect("text");
    present.map(|effect| (text(&effect["effect"]), text(&effect["reason"]))).collect()
}

#[test]
fn a_plain_scene_calls_for_its_light_only() {
    let effects = effects(NOTHING);
    assert_eq!(present(&effects), [("point-light", "emitter “point” at scene.xml:3:5")]);
    assert!(effects.len() > 10, "absent ones are listed too");
}

#[test]
fn every_effect_names_the_element_that_calls_for_it() {
    let effects = effects(MUCH);
    let expected = [
        ("indirect-light", "integrator “path” at scene.xml:2:5"),
        ("area-light", "shape “rectangle” at scene.xml:26:5"),
        ("spot-light", "emitter “spot” at scene.xml:11:5"),
        ("projector", "emitter “projector” at scene.xml:12:5"),
        ("directional-light", "emitter “directional” at scene.xml:10:5"),
        ("constant-background", "emitter “constant” at scene.xml:9:5"),
        ("delta-reflection", "bsdf “conductor” at scene.xml:14:5 and 1 more"),
        ("delta-transmission", "bsdf “thindielectric” at scene.xml:17:26"),
        ("rough-reflection", "bsdf “roughdielectric” at scene.xml:23:62"),
        ("rough-transmission", "bsdf “roughdielectric” at scene.xml:23:62"),
        ("opacity-mask", "bsdf “mask” at scene.xml:18:26"),
        ("pass-through", "bsdf “null” at scene.xml:22:26"),
        ("checkerboard-texture", "texture “checkerboard” at scene.xml:13:5"),
        ("instancing", "shape “instance” at scene.xml:24:5 and 1 more"),
        ("depth-of-field", "sensor “thinlens” at scene.xml:6:5"),
        ("motion-blur", "shape “sphere” at scene.xml:27:5"),
        ("hidden-emitters", "integrator “path” at scene.xml:2:5"),
        ("strict-normals", "integrator “path” at scene.xml:2:5"),
    ];
    assert_eq!(present(&effects), expected);
}

#[test]
fn media_are_present_where_the_integrator_sees_them_and_a_shape_bounds_them() {
    let scene = |integrator: &str| {
        format!(
            r#"<scene version="3.0.0">
    <integrator type="{integrator}"/>
    <medium type="homogeneous" id="unused"/>
    <medium type="homogeneous" id="fog"><rgb name="sigma_t" value="1 2 3"/></medium>
    <sensor type="perspective"><ref id="fog"/></sensor>
    <shape type="sphere"><bsdf type="diffuse"/>
        <ref name="exterior" id="fog"/>
        <medium type="heterogeneous" name="interior"><phase type="hg"/></medium>
    </shape>
</scene>"#
        )
    };
    let seen = effects(&scene("volpath"));
    let expected = [
        ("indirect-light", "integrator “volpath” at scene.xml:2:5"),
        ("homogeneous-medium", "medium “homogeneous” at scene.xml:4:5"),
        ("heterogeneous-medium", "medium “heterogeneous” at scene.xml:8:9"),
        ("coloured-extinction", "medium “homogeneous” at scene.xml:4:5"),
        ("anisotropic-scattering", "medium “heterogeneous” at scene.xml:8:9"),
    ];
    assert_eq!(present(&seen), expected);
    let expected = [("indirect-light", "integrator “path” at scene.xml:2:5")];
    assert_eq!(present(&effects(&scene("path"))), expected);
}

#[test]
fn materials_made_of_lobes_and_of_others_name_themselves() {
    let effects = effects(SURFACES);
    let of_bsdfs: Vec<_> =
        present(&effects).into_iter().filter(|(_, reason)| reason.starts_with("bsdf")).collect();
    let expected = [
        ("rough-transmission", "bsdf “principled” at scene.xml:2:26"),
        ("principled", "bsdf “principled” at scene.xml:2:26"),
        ("blend", "bsdf “blendbsdf” at scene.xml:3:26"),
        ("normal-map", "bsdf “normalmap” at scene.xml:4:26"),
    ];
    assert_eq!(of_bsdfs, expected);
}

#[test]
fn the_text_says_what_is_present_and_what_it_costs() {
    let folder = Folder::new();
    folder.write("scene.xml", NOTHING);
    let outcome = folder.run(&["effects", "scene.xml"]);
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    assert!(
        outcome
            .stdout
            .contains("point-light            present: emitter “point” at scene.xml:3:5\n")
    );
    assert!(outcome.stdout.contains("costs a choice among lights"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("opacity-mask           absent\n"), "{}", outcome.stdout);
}

#[test]
fn what_is_left_out_is_not_called_for_and_everything_else_is() {
    let whole = effects(MUCH);
    for &effect in &names(&whole, "present", true) {
        let rest = effects_with(MUCH, &["--without", effect]);
        let mut expected = names(&whole, "simulated", true);
        expected.remove(effect);
        assert_eq!(names(&rest, "simulated", true), expected, "without {effect}");
        assert_eq!(present(&rest), present(&whole), "without {effect}");
    }
}

#[test]
fn only_some_is_without_all_others() {
    let rest = effects_with(MUCH, &["--only", "indirect-light,area-light,bitmap-texture"]);
    assert_eq!(names(&rest, "simulated", true), HashSet::from(["indirect-light", "area-light"]));
}

#[test]
fn leaving_out_what_is_absent_changes_no_bit() {
    let whole = effects(SEEN);
    let all: HashSet<&str> = whole.iter().filter_map(|effect| effect["effect"].as_str()).collect();
    let absent: Vec<&str> = all.difference(&names(&whole, "present", true)).copied().collect();
    assert!(absent.len() > 2, "{absent:?}");
    assert_eq!(picture(SEEN, &["--without", &absent.join(",")]), picture(SEEN, &[]));
    assert_ne!(picture(SEEN, &["--without", "delta-reflection"]), picture(SEEN, &[]));
}

#[test]
fn without_any_light_the_picture_is_black() {
    let black = picture(SEEN, &["--without", "point-light"]);
    let header = b"PF\n24 24\n-1.0\n".len();
    assert!(black[header..].iter().all(|byte| *byte == 0));
    assert!(picture(SEEN, &[])[header..].iter().any(|byte| *byte != 0));
}

#[test]
fn the_price_list_has_every_effect_that_is_simulated() {
    let folder = Folder::new();
    folder.write("scene.xml", SEEN);
    let measure = ["effects", "scene.xml", "--measure", "--json", "-q", "--rounds", "1"];
    let options = ["--spp", "2", "--size", "16x16", "--pictures", "pictures"];
    let outcome = folder.run(&[&measure[..], &options].concat());
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    let prices = outcome.json();
    assert_eq!(prices["configuration"], "surfaces");
    assert!(prices["unused_percent"].is_number(), "{prices}");
    let prices = prices["effects"].as_array().expect("a list");
    let listed: HashSet<_> = prices.iter().filter_map(|price| price["effect"].as_str()).collect();
    assert_eq!(listed, names(&effects(SEEN), "simulated", true));
    for price in prices {
        let name = price["effect"].as_str().expect("a name");
        assert!(price["seconds_without"].as_f64().is_some_and(|s| s > 0.0), "{price}");
        assert!(price["flip"].as_f64().is_some_and(|flip| flip > 0.0), "{price}");
        assert!(folder.path(&format!("pictures/{name}.png")).exists(), "{name}");
        if name == "point-light" {
            assert_eq!(price["mean_difference_percent"], -100.0);
        }
    }
}

#[test]
fn an_unknown_effect_is_refused_with_the_names_that_exist() {
    let folder = Folder::new();
    folder.write("scene.xml", NOTHING);
    let outcome = folder.run(&["render", "scene.xml", "-o", "p.png", "--without", "ponit-light"]);
    assert_eq!(outcome.exit, Some(2), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("'point-light'"), "{}", outcome.stderr);
}

/// Two balls under a lamp, seen through a shutter.
fn seen_through(shutter: &str, place: &str) -> String {
    format!(
        r#"<scene version="3.0.0">
    <sensor type="perspective">{shutter}
        <transform name="to_world"><lookat origin="0, 0, 6" target="0, 0, 0" up="0, 1, 0"/></transform>
    </sensor>
    <emitter type="point"><point name="position" x="0" y="3" z="5"/></emitter>
    <shape type="sphere"><point name="center" x="0.5" y="0" z="-1"/></shape>
    <shape type="sphere"><float name="radius" value="0.8"/>{place}</shape>
</scene>"#
    )
}

#[test]
fn what_stands_still_has_the_same_bits_however_long_the_shutter_is_open() {
    let open = r#"<float name="shutter_open" value="0.5"/><float name="shutter_close" value="1"/>"#;
    let animation = |x: f64| {
        format!(
            r#"<animation name="to_world">
        <transform time="0"><translate x="-1"/></transform>
        <transform time="0.5"><translate x="-0.5"/></transform>
        <transform time="1"><translate x="{x}"/></transform>
    </animation>"#
        )
    };
    let still = r#"<transform name="to_world"><translate x="-0.5"/></transform>"#;
    let expected = picture(&seen_through("", still), &[]);
    assert_eq!(picture(&seen_through(open, still), &[]), expected);
    // Until the shutter opens it moves, and then no more.
    assert_eq!(picture(&seen_through(open, &animation(-0.5)), &[]), expected);
    // Moving, and then told not to: where it is when the shutter opens.
    let moving = seen_through(open, &animation(0.7));
    assert_ne!(picture(&moving, &[]), expected);
    assert_eq!(picture(&moving, &["--without", "motion-blur"]), expected);
}

#[test]
fn the_summary_of_a_scene_says_what_moves() {
    let folder = Folder::new();
    folder.write("moving.xml", MUCH);
    folder.write("still.xml", NOTHING);
    for (scene, says) in [
        ("moving.xml", "motion     1 of the shapes and instances\n"),
        ("still.xml", "motion     none\n"),
    ] {
        let outcome = folder.run(&["info", scene]);
        assert!(outcome.stdout.contains(says), "{}", outcome.stdout);
    }
}
