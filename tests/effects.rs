//! `etendue effects`: what scenes call for, and why.

mod common;

use common::Folder;
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
        <float name="aperture_radius" value="0.1"/>
    </sensor>
    <emitter type="constant"/>
    <emitter type="directional"/>
    <emitter type="spot"/>
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
</scene>"#;

const SURFACES: &str = r#"<scene version="3.0.0">
    <shape type="sphere"><bsdf type="principled"><float name="spec_trans" value="0.5"/></bsdf></shape>
    <shape type="sphere"><bsdf type="blendbsdf"><bsdf type="diffuse"/><bsdf type="diffuse"/></bsdf></shape>
    <shape type="sphere"><bsdf type="normalmap">
        <rgb name="normalmap" value="0.5 0.5 1"/><bsdf type="diffuse"/>
    </bsdf></shape>
</scene>"#;

fn effects(scene: &str) -> Vec<Value> {
    let folder = Folder::new();
    folder.write("scene.xml", scene);
    let outcome = folder.run(&["effects", "scene.xml", "--json"]);
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    outcome.json().as_array().expect("a list").clone()
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
        ("area-light", "shape “rectangle” at scene.xml:25:5"),
        ("spot-light", "emitter “spot” at scene.xml:11:5"),
        ("directional-light", "emitter “directional” at scene.xml:10:5"),
        ("constant-background", "emitter “constant” at scene.xml:9:5"),
        ("delta-reflection", "bsdf “conductor” at scene.xml:13:5 and 1 more"),
        ("delta-transmission", "bsdf “thindielectric” at scene.xml:16:26"),
        ("rough-reflection", "bsdf “roughdielectric” at scene.xml:22:62"),
        ("rough-transmission", "bsdf “roughdielectric” at scene.xml:22:62"),
        ("opacity-mask", "bsdf “mask” at scene.xml:17:26"),
        ("pass-through", "bsdf “null” at scene.xml:21:26"),
        ("checkerboard-texture", "texture “checkerboard” at scene.xml:12:5"),
        ("instancing", "shape “instance” at scene.xml:23:5 and 1 more"),
        ("depth-of-field", "sensor “thinlens” at scene.xml:6:5"),
        ("hidden-emitters", "integrator “path” at scene.xml:2:5"),
        ("strict-normals", "integrator “path” at scene.xml:2:5"),
    ];
    assert_eq!(present(&effects), expected);
}

#[test]
fn materials_made_of_lobes_and_of_others_name_themselves() {
    let effects = effects(SURFACES);
    let of_bsdfs: Vec<_> =
        present(&effects).into_iter().filter(|(_, reason)| reason.starts_with("bsdf")).collect();
    let expected = [
        ("rough-reflection", "bsdf “principled” at scene.xml:2:26"),
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
