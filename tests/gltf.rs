//! glTF models rendered by the command.

mod common;

use std::path::Path;

use common::{Folder, Outcome, Picture};
use serde_json::{Value, json};

/// A binary container of a document and its buffer.
fn glb(document: &Value, buffer: &[u8]) -> Vec<u8> {
    let mut chunks = Vec::new();
    let text = document.to_string().into_bytes();
    for (kind, content, filler) in [(b"JSON", text, b' '), (b"BIN\0", buffer.to_vec(), 0)] {
        let mut content = content;
        content.resize(content.len().next_multiple_of(4), filler);
        chunks
            .extend_from_slice(&u32::try_from(content.len()).expect("a small file").to_le_bytes());
        chunks.extend_from_slice(kind);
        chunks.extend_from_slice(&content);
    }
    let length = u32::try_from(chunks.len() + 12).expect("a small file");
    let header = [*b"glTF", 2_u32.to_le_bytes(), length.to_le_bytes()].concat();
    [header, chunks].concat()
}

/// A square of side 2 in the plane z = 0 that faces +z.
const SQUARE: [[f32; 3]; 4] = [[-1., -1., 0.], [1., -1., 0.], [1., 1., 0.], [-1., 1., 0.]];

/// A model with squares of some materials, one above the other towards +z, and what else it has.
fn squares(materials: &[Value], rest: &Value) -> Vec<u8> {
    let indices: [u16; 6] = [0, 1, 2, 0, 2, 3];
    let mut buffer: Vec<u8> = SQUARE.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    buffer.extend(indices.iter().flat_map(|i| i.to_le_bytes()));
    let mesh = |material: usize| json!({ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": material }] });
    let count = materials.len();
    let meshes: Vec<Value> = (0..count).map(mesh).collect();
    let nodes = (0..count).map(|i| json!({ "mesh": i, "translation": [0.0, 0.0, 0.5 * i as f64] }));
    let mut nodes: Vec<Value> = nodes.collect();
    nodes.extend(rest["nodes"].as_array().into_iter().flatten().cloned());
    let mut document = json!({
        "asset": { "version": "2.0" },
        "buffers": [{ "byteLength": buffer.len() }],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 },
        ],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4 },
            { "bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 6 },
        ],
        "materials": materials,
        "meshes": meshes,
        "nodes": nodes,
    });
    for name in ["cameras", "extensions", "extensionsRequired"] {
        if let Some(value) = rest.get(name) {
            document[name] = value.clone();
        }
    }
    glb(&document, &buffer)
}

/// A camera at (0, 0, 5) that sees nothing but the square.
fn camera() -> Value {
    json!({
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.35, "aspectRatio": 1, "znear": 0.01 } }],
        "nodes": [{ "camera": 0, "translation": [0, 0, 5] }],
    })
}

fn render(model: &[u8], arguments: &[&str]) -> Picture {
    let folder = Folder::new();
    folder.write("model.glb", model);
    folder.render(Path::new("model.glb"), arguments)
}

/// The same with a light at (1, 2, 3).
fn with_light(mut rest: Value, light: &Value) -> Value {
    rest["extensions"] = json!({ "KHR_lights_punctual": { "lights": [light] } });
    // From there the shortest turn of −z towards the origin.
    let away = [-1.0_f64, -2.0, -3.0].map(|x| x / 14_f64.sqrt());
    let quaternion = [away[1], -away[0], 0.0, 1.0 - away[2]];
    let length = quaternion.iter().map(|x| x * x).sum::<f64>().sqrt();
    let node = json!({
        "translation": [1, 2, 3], "rotation": quaternion.map(|x| x / length),
        "extensions": { "KHR_lights_punctual": { "light": 0 } },
    });
    rest["nodes"].as_array_mut().expect("nodes").push(node);
    rest
}

#[test]
fn the_same_square_in_xml_gives_the_same_picture() {
    let obj = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n";
    let look_at = r#"<lookat origin="0 0 5" target="0 0 0" up="0 1 0"/>"#;
    let fov = 0.35_f64.to_degrees();
    let perspective = format!(
        r#"<sensor type="perspective"><float name="fov" value="{fov}"/><transform name="to_world">{look_at}</transform>"#
    );
    let orthographic = format!(
        r#"<sensor type="orthographic"><transform name="to_world"><scale x="0.75" y="0.75"/>{look_at}</transform>"#
    );
    let lens = json!({ "xmag": 0.75, "ymag": 0.75, "znear": 0.01 });
    let parallel = json!({
        "cameras": [{ "type": "orthographic", "orthographic": lens }],
        "nodes": [{ "camera": 0, "translation": [0, 0, 5] }],
    });
    let to_world = r#"<transform name="to_world"><lookat origin="1 2 3" target="0 0 0" up="0 1 0"/></transform>"#;
    let point = r#"<emitter type="point"><point name="position" x="1" y="2" z="3"/><rgb name="intensity" value="20 10 5"/></emitter>"#;
    let sun = r#"<emitter type="directional"><vector name="direction" x="-1" y="-2" z="-3"/><rgb name="irradiance" value="4 2 1"/></emitter>"#;
    let (cutoff, beam) = (0.25_f64.to_degrees(), 0.125_f64.to_degrees());
    let spot = format!(
        r#"<emitter type="spot"><float name="cutoff_angle" value="{cutoff}"/><float name="beam_width" value="{beam}"/>{to_world}<rgb name="intensity" value="20 10 5"/></emitter>"#
    );
    let shine = |kind: &str, intensity: f64| {
        json!({ "type": kind, "color": [1, 0.5, 0.25], "intensity": intensity,
            "spot": { "innerConeAngle": 0.125, "outerConeAngle": 0.25 } })
    };
    let paint = r#"<bsdf type="principled"><rgb name="base_color" value="0.25 0.5 0.75"/><float name="roughness" value="0.75"/><float name="eta" value="1.5"/></bsdf>"#;
    let metal = r#"<bsdf type="principled"><rgb name="base_color" value="0.25 0.5 0.75"/><float name="roughness" value="0.5"/><float name="metallic" value="1"/><float name="eta" value="1.5"/></bsdf>"#;
    let of = |metallic: f64, roughness: f64| {
        json!({ "pbrMetallicRoughness": {
            "baseColorFactor": [0.25, 0.5, 0.75, 1], "metallicFactor": metallic, "roughnessFactor": roughness,
        }})
    };
    let film = r#"<film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="24"/></film></sensor>"#;
    for (sensor, view, emitter, light, bsdf, material) in [
        (&perspective, camera(), point, shine("point", 20.0), paint, of(0.0, 0.75)),
        (&perspective, camera(), spot.as_str(), shine("spot", 20.0), paint, of(0.0, 0.75)),
        (&perspective, camera(), sun, shine("directional", 4.0), metal, of(1.0, 0.5)),
        (&orthographic, parallel, sun, shine("directional", 4.0), paint, of(0.0, 0.75)),
    ] {
        let folder = Folder::new();
        folder.write("square.obj", obj);
        let shape = r#"<shape type="obj"><string name="filename" value="square.obj"/><boolean name="face_normals" value="true"/>"#;
        let xml = format!(
            r#"<scene version="3.0.0">{sensor}{film}{emitter}{shape}<bsdf type="twosided">{bsdf}</bsdf></shape></scene>"#
        );
        folder.write("square.xml", xml);
        let arguments = ["--spp", "16", "--size", "24x24"];
        let expected = folder.render(Path::new("square.xml"), &arguments);
        let found = render(&squares(&[material], &with_light(view, &light)), &arguments);
        let brightest = expected.samples().fold(0.0, f32::max);
        assert!(brightest > 0.05, "{emitter} lights the square: {brightest}");
        for (found, expected) in found.samples().zip(expected.samples()) {
            // The same paths: the angle of view goes through degrees once, directions through a quaternion, which
            // moves points by 1e-6; a rough lobe and the rim of the spot change by less than 100 times as much.
            assert!((found - expected).abs() <= 1e-4 * brightest, "{emitter}: {found} {expected}");
        }
    }
}

#[test]
fn a_polished_metal_mirrors_the_white_sky_in_its_colour() {
    let metal = json!({ "pbrMetallicRoughness": {
        "baseColorFactor": [0.25, 0.5, 0.75, 1], "metallicFactor": 1, "roughnessFactor": 0,
    }});
    let picture = render(&squares(&[metal], &camera()), &["--size", "8x8", "--spp", "64"]);
    for (channel, expected) in [0.25, 0.5, 0.75].into_iter().enumerate() {
        let values = picture.pixels.iter().map(|pixel| f64::from(pixel[channel]));
        let mean = values.sum::<f64>() / picture.pixels.len() as f64;
        // Schlick's (1 − cos)⁵ is 1e-8 at 10°. Of 4096 samples some two leave in the tail of facets of width 0.001, where the
        // sky itself is as likely to be drawn: ten of them are 0.25 %.
        assert!((mean / expected - 1.0).abs() < 2.5e-3, "{mean} instead of {expected}");
    }
}

#[test]
fn unlit_colours_are_seen_as_they_are_and_blended_by_their_opacity() {
    let unlit = |alpha: f64| {
        json!({
            "extensions": { "KHR_materials_unlit": {} }, "alphaMode": "BLEND",
            "pbrMetallicRoughness": { "baseColorFactor": [0.25, 0.5, 0.75, alpha] },
        })
    };
    let arguments = ["--size", "8x8", "--spp", "1024"];
    let whole = render(&squares(&[unlit(1.0)], &camera()), &arguments);
    let half = render(&squares(&[unlit(0.5)], &camera()), &arguments);
    let two = render(&squares(&[unlit(1.0), unlit(0.5)], &camera()), &arguments);
    let mean = |picture: &Picture| {
        let reds = picture.pixels.iter().map(|pixel| f64::from(pixel[0]));
        reds.sum::<f64>() / picture.pixels.len() as f64
    };
    assert!(whole.pixels.iter().all(|pixel| *pixel == [0.25, 0.5, 0.75]));
    // The radiance of a half there is half of it, and there is no sky where something shines.
    assert!(half.pixels.iter().all(|pixel| *pixel == [0.125, 0.25, 0.375]));
    // Behind it the other half of the time there is the other square, 64 · 1024 samples of ±1/8: six standard errors.
    let error = 6.0 * 0.125 / (64.0 * 1024_f64).sqrt();
    assert!((mean(&two) - 0.25).abs() < error, "{}", mean(&two));
}

#[test]
fn the_sun_shines_through_holes_and_panes() {
    let floor = json!({ "pbrMetallicRoughness": { "metallicFactor": 0 } });
    let hole = json!({
        "alphaMode": "MASK", "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 0.25] },
    });
    let pane = json!({
        "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 0 },
        "extensions": { "KHR_materials_transmission": { "transmissionFactor": 1 } },
    });
    let sun = with_light(camera(), &json!({ "type": "directional", "intensity": 4 }));
    let middle = |materials: &[Value]| {
        let picture = render(
            &squares(materials, &sun),
            &["--size", "9x9", "--crop", "4,4,1,1", "--spp", "256"],
        );
        picture.pixel(0, 0)[0]
    };
    let lit = middle(core::slice::from_ref(&floor));
    // A hole is nothing at all; the crop has one pixel of the same samples.
    assert!((middle(&[floor.clone(), hole]) / lit - 1.0).abs() < 1e-5);
    // A pane of index 1.5 lets 92 % through at normal incidence and 91 % at this angle, each way: 0.84, and the light between
    // floor and pane adds up to 8 % of albedo.
    let through = middle(&[floor, pane]) / lit;
    assert!((0.78..0.93).contains(&through), "{through}");
}

/// Runs a command on a model.
fn run(model: &[u8], arguments: &[&str]) -> Outcome {
    let folder = Folder::new();
    folder.write("model.glb", model);
    folder.run(arguments)
}

#[test]
fn info_and_effects_know_what_a_model_holds() {
    let gold = json!({ "name": "gold" });
    let model = squares(&[gold], &camera());
    let info = run(&model, &["info", "model.glb"]);
    assert_eq!((info.exit, info.stderr.as_str()), (Some(0), ""));
    for line in ["shapes     1 mesh", "triangles  2", "lights     1 constant", "camera"] {
        assert!(info.stdout.contains(line), "{line:?} in\n{}", info.stdout);
    }
    let effects = run(&model, &["effects", "model.glb"]);
    assert_eq!((effects.exit, effects.stderr.as_str()), (Some(0), ""));
    assert!(effects.stdout.contains("materials[0] “gold” at model.glb"), "{}", effects.stdout);
}

#[test]
fn what_is_wrong_with_a_model_is_one_message_with_file_and_place() {
    let model = |rest: Value| squares(&[json!({})], &rest);
    let whole = model(camera());
    let cases: [(Vec<u8>, i32, &str); 4] = [
        (
            model(json!({ "extensionsRequired": ["KHR_draco_mesh_compression"] })),
            3,
            "model.glb: extensionsRequired: the file cannot be read without KHR_draco_mesh_compression",
        ),
        (
            model(json!({ "nodes": [{ "mesh": 4 }] })),
            3,
            "model.glb: nodes[1].mesh: there is no meshes[4], the file has 1",
        ),
        (whole[..whole.len() - 1].to_vec(), 3, "model.glb: the container is cut off"),
        (b"glTF".to_vec(), 3, "model.glb: the container is cut off"),
    ];
    for (bytes, exit, message) in cases {
        let outcome = run(&bytes, &["render", "model.glb", "-o", "out.exr"]);
        assert_eq!(outcome.exit, Some(exit), "{}", outcome.stderr);
        let [error] = &outcome.errors()[..] else { panic!("one error: {}", outcome.stderr) };
        assert!(error.contains(message), "{message} in {error}");
    }
}
