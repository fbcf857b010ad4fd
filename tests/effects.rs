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
