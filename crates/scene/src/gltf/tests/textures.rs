//! Images and how materials look at them.

use ::image::ExtendedColorType;
use etendue_brdf::Bsdf;
use etendue_math::glam::Vec3;
use serde_json::{Value, json};

use super::{Draft, meshes, warnings};
use crate::color::Primaries;
use crate::geometry::{Located, Ray};
use crate::gltf::Model;
use crate::light::Light;
use crate::material::{Material, PrincipledTextures, Side};
use crate::texture::{Texture, TextureId};

/// Two columns and two rows of colours with opacity.
const RGBA: [u8; 16] = [
    255, 0, 51, 255, 0, 255, 102, 128, // the upper row
    51, 102, 153, 0, 204, 153, 255, 255,
];

/// A square of a material that may refer to the image, which is nearest texels.
fn draft(material: Value) -> Draft {
    let mut draft = Draft::of_material(material);
    draft.image([2, 2], ExtendedColorType::Rgba8, &RGBA);
    draft.root["samplers"] = json!([{ "magFilter": 9728 }]);
    draft.root["textures"][0]["sampler"] = json!(0);
    draft
}

fn principled(model: &Model) -> &PrincipledTextures {
    model
        .materials
        .iter()
        .find_map(|material| match material {
            Material::Principled(textures) => Some(&**textures),
            _ => None,
        })
        .expect("a principled material")
}

/// Values at the middles of the four texels, row by row.
fn values(model: &Model, id: TextureId) -> [f32; 4] {
    [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]].map(|uv| model.textures.value(id, uv))
}

#[test]
fn channels_are_what_they_mean_and_factors_multiply_them() {
    let model = draft(json!({ "pbrMetallicRoughness": {
        "baseColorTexture": { "index": 0 }, "baseColorFactor": [0.5, 1, 1, 1],
        "metallicRoughnessTexture": { "index": 0 }, "metallicFactor": 0.5,
    }}))
    .model();
    let p = principled(&model);
    assert_eq!(values(&model, p.roughness), [0.0, 1.0, 0.4, 0.6]);
    assert_eq!(values(&model, p.metallic), [0.1, 0.2, 0.3, 0.5]);
    let color = model.textures.color(p.base_color, [0.25, 0.25]);
    // 51 is 0.0331 in linear light (IEC 61966-2-1).
    assert!(color.r == 0.5 && color.g == 0.0 && (color.b - 0.033_104_77).abs() < 1e-7, "{color:?}");
    // One image, looked at three times.
    let bitmaps = model.textures.iter().filter(|texture| matches!(texture, Texture::Bitmap(_)));
    assert_eq!(bitmaps.count(), 3);
}

#[test]
fn the_opacity_of_an_image_is_blended_or_compared() {
    for (mode, expected) in [
        ("BLEND", [1.0, 128.0 / 255.0, 0.0, 1.0].map(|alpha: f32| alpha * 0.75)),
        ("MASK", [1.0, 0.0, 0.0, 1.0]),
    ] {
        let draft = draft(json!({
            "alphaMode": mode,
            "pbrMetallicRoughness": {
                "baseColorTexture": { "index": 0 }, "baseColorFactor": [1, 1, 1, 0.75],
            },
            "emissiveFactor": [2, 2, 2],
        }));
        let model = draft.model();
        let Some(&Material::Mask { opacity, .. }) = model.materials.get(model.surfaces[0].material)
        else {
            panic!("a mask");
        };
        assert_eq!(values(&model, opacity), expected, "{mode}");
        // Where it is not there it does not shine.
        let [Light::Area(light)] = model.lights[..] else { panic!("{:?}", model.lights) };
        assert_eq!(values(&model, light.radiance), expected.map(|alpha| 2.0 * alpha), "{mode}");
        assert!(model.textures.mean(light.radiance).r > 0.0);
    }
}

#[test]
fn an_image_without_opacity_is_whole() {
    let mut draft = Draft::of_material(json!({
        "alphaMode": "BLEND", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } },
    }));
    draft.image([1, 1], ExtendedColorType::Rgb8, &[255, 0, 0]);
    let model = draft.model();
    assert!(matches!(
        model.materials.get(model.surfaces[0].material),
        Some(Material::TwoSided { .. })
    ));
}

#[test]
fn grey_images_of_16_bits_keep_them() {
    let mut draft = Draft::of_material(json!({ "pbrMetallicRoughness": {
        "metallicRoughnessTexture": { "index": 0 }, "baseColorTexture": { "index": 0 },
    }}));
    draft.image([1, 1], ExtendedColorType::L16, &12345_u16.to_ne_bytes());
    let model = draft.model();
    let p = principled(&model);
    let raw = 12345.0 / 65535.0;
    assert_eq!([p.roughness, p.metallic].map(|id| model.textures.value(id, [0.5; 2])), [raw; 2]);
    assert_eq!(model.textures.value(p.base_color, [0.5; 2]), crate::load::srgb::decode(raw));
}

#[test]
fn samplers_decide_about_borders_and_filters() {
    let look = |sampler: Value, uv: [f32; 2]| {
        let mut draft = draft(json!({ "pbrMetallicRoughness": {
            "metallicRoughnessTexture": { "index": 0 },
        }}));
        draft.root["samplers"] = json!([sampler]);
        let model = draft.model();
        model.textures.value(principled(&model).roughness, uv)
    };
    // Roughness is 0, 1 in the upper row and 0.4, 0.6 in the lower one.
    let nearest =
        |s: u32, t: u32, uv| look(json!({ "magFilter": 9728, "wrapS": s, "wrapT": t }), uv);
    assert_eq!(nearest(10497, 10497, [1.25, 1.25]), 0.0);
    assert_eq!(nearest(33071, 10497, [1.25, 0.25]), 1.0);
    assert_eq!(nearest(33648, 33071, [1.25, 1.25]), 0.6);
    assert_eq!(nearest(10497, 33648, [0.25, 1.25]), 0.4);
    // The mean of all four.
    assert!((look(json!({}), [0.5, 0.5]) - 0.5).abs() < 1e-6);
    let mut draft = draft(json!({ "normalTexture": { "index": 0 } }));
    for (name, fragment) in
        [("wrapS", "samplers[0].wrapS: 7 is none"), ("magFilter", "samplers[0].magFilter: 7")]
    {
        draft.root["samplers"] = json!([{ name: 7 }]);
        assert!(draft.error().contains(fragment), "{}", draft.error());
    }
}

#[test]
fn coordinates_are_transformed_as_the_extension_says() {
    let quarter = core::f64::consts::FRAC_PI_2;
    let transform = json!({ "offset": [0.5, 0], "rotation": quarter, "scale": [1, 2] });
    let model = draft(json!({ "pbrMetallicRoughness": { "metallicRoughnessTexture": {
        "index": 0, "extensions": { "KHR_texture_transform": transform },
    }}}))
    .model();
    let roughness = principled(&model).roughness;
    // (u, v) is looked up at (½ + 2v, −u).
    for (uv, expected) in
        [([0.25, 0.125], 0.6), ([0.75, 0.125], 1.0), ([0.25, 0.375], 0.4), ([0.75, 0.4], 0.0)]
    {
        assert_eq!(model.textures.value(roughness, uv), expected, "{uv:?}");
    }
}

#[test]
fn a_material_looks_at_one_set_of_coordinates() {
    let reference = json!({ "index": 0, "texCoord": 1 });
    let mut draft = draft(json!({ "pbrMetallicRoughness": { "baseColorTexture": reference } }));
    let missing = draft.model();
    assert!(warnings(&missing)[0].contains("baseColorTexture: a primitive without"));
    let uv = draft.floats(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
    draft.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = json!(uv);
    let model = draft.model();
    assert!(warnings(&model).is_empty());
    assert_eq!(meshes(&model)[0].uvs()[2].to_array(), [2.0, 2.0]);
    draft.root["materials"][0]["normalTexture"] = json!({ "index": 0 });
    let warned = draft.model();
    assert!(
        warnings(&warned)[0].contains("normalTexture: only one set"),
        "{:?}",
        warnings(&warned)
    );
}

/// The normals that a texture of one texel stands for, of the material of each shape.
fn normals(draft: &Draft) -> alloc::vec::Vec<[f32; 3]> {
    let model = draft.model();
    let normal = |surface: &crate::SurfaceInfo| {
        let Some(&Material::TwoSided { front, .. }) = model.materials.get(surface.material) else {
            panic!("two sides");
        };
        let Some(&Material::NormalMap { normal, .. }) = model.materials.get(front) else {
            panic!("a normal map");
        };
        model.textures.color(normal, [0.5; 2]).to_array().map(|c| 2.0 * c - 1.0)
    };
    model.surfaces.iter().map(normal).collect()
}

#[test]
fn normals_are_scaled_along_the_surface() {
    let with = |scale: f64| {
        let mut draft =
            Draft::of_material(json!({ "normalTexture": { "index": 0, "scale": scale } }));
        draft.image([1, 1], ExtendedColorType::Rgb8, &[204, 51, 255]);
        normals(&draft)[0]
    };
    for (scale, expected) in
        [(1.0, [0.6, -0.6, 1.0]), (0.5, [0.3, -0.3, 1.0]), (2.0, [0.6, -0.6, 0.5])]
    {
        for (found, expected) in with(scale).into_iter().zip(expected) {
            // Bytes as floats, doubled.
            assert!((found - expected).abs() < 1e-6, "{scale}: {found} {expected}");
        }
    }
}

#[test]
fn where_a_texture_is_mirrored_its_normals_are() {
    let mut draft = Draft::of_material(json!({ "normalTexture": { "index": 0 } }));
    draft.image([1, 1], ExtendedColorType::Rgb8, &[204, 51, 255]);
    let upright = normals(&draft);
    // The second triangle sees the texture from behind.
    let position = draft.floats(&[
        [-1., -1., 0.],
        [1., -1., 0.],
        [1., 1., 0.],
        [-1., -1., 0.],
        [1., 1., 0.],
        [-1., 1., 0.],
    ]);
    let uv =
        draft.floats(&[[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0], [1.0, 0.0]]);
    draft.root["meshes"][0]["primitives"][0] = json!({
        "attributes": { "POSITION": position, "TEXCOORD_0": uv }, "material": 0,
    });
    let both = normals(&draft);
    assert_eq!(both[0], upright[0]);
    assert_eq!(both[1].map(|c| (c * 10.0).round()), [6.0, 6.0, 10.0]);
    let parts = meshes(&draft.model());
    assert_eq!([parts[0].triangles().len(), parts[1].triangles().len()], [1, 1]);
}

/// How much more of light along the normal a square reflects towards +x than towards −x, and towards +y than towards −y, with a
/// normal map of one texel; `u` are the coordinates of its left and right side.
fn leaning(texel: [u8; 3], u: [f32; 2]) -> [f32; 2] {
    let mut draft = Draft::of_material(json!({
        "normalTexture": { "index": 0 }, "pbrMetallicRoughness": { "metallicFactor": 0 },
    }));
    draft.image([1, 1], ExtendedColorType::Rgb8, &texel);
    let [left, right] = u;
    let uv = draft.floats(&[[left, 1.0], [right, 1.0], [right, 0.0], [left, 0.0]]);
    draft.root["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uv);
    let model = draft.model();
    let geometry = model.geometry.build();
    let ray = Ray::new(Vec3::new(0.3, 0.2, 1.0), -Vec3::Z);
    let hit = geometry.intersect(&ray).expect("the square");
    let located = Located::new(&geometry, geometry.surface_point(&ray, &hit));
    let (id, frame) = (model.surfaces[0].material, located.point().shading);
    let at = (&located).into();
    let bsdf = model.materials.prepare(id, &model.textures, at, Side::Front, Primaries);
    let towards = |x: f32, y: f32| {
        let wi = frame.to_local(Vec3::new(x, y, 0.8));
        bsdf.eval(Vec3::Z, wi).r
    };
    [towards(0.6, 0.0) - towards(-0.6, 0.0), towards(0.0, 0.6) - towards(0.0, -0.6)]
}

#[test]
fn red_leans_to_the_right_of_the_image_and_green_to_its_top() {
    let (red, green) = ([220, 128, 230], [128, 220, 230]);
    for (texel, u, expected) in [
        (red, [0.0, 1.0], [1, 0]),
        (green, [0.0, 1.0], [0, 1]),
        // The image seen from behind.
        (red, [1.0, 0.0], [-1, 0]),
        (green, [1.0, 0.0], [0, 1]),
    ] {
        let found = leaning(texel, u);
        for (found, expected) in found.into_iter().zip(expected) {
            match expected {
                // 128 leans by 0.004, of which a hundredth is left where the other leans by a half.
                0 => assert!(found.abs() < 0.01, "{texel:?} {u:?}: {found}"),
                sign => assert!(found * sign as f32 > 0.05, "{texel:?} {u:?}: {found}"),
            }
        }
    }
}

#[test]
fn images_that_are_none_are_refused_where_they_stand() {
    let with = |change: fn(&mut Draft)| {
        let mut draft = draft(json!({ "normalTexture": { "index": 0 } }));
        change(&mut draft);
        draft.error()
    };
    for (change, fragment) in [
        (
            (|d| d.root["textures"][0]["source"] = json!(9)) as fn(&mut Draft),
            "textures[0].source: there is no images[9], the file has 1",
        ),
        (|d| d.root["textures"][0] = json!({}), "textures[0]: has no “source”"),
        (
            |d| d.root["textures"][0]["sampler"] = json!(1),
            "textures[0].sampler: there is no samplers[1]",
        ),
        (|d| d.root["images"][0] = json!({}), "images[0]: has neither “uri” nor “bufferView”"),
        (
            |d| d.root["materials"][0]["normalTexture"] = json!({}),
            "materials[0].normalTexture: has no “index”",
        ),
        (|d| d.root["images"][0]["bufferView"] = json!(0), "images[0]: is neither PNG nor JPEG"),
        (
            |d| {
                let view = d.root["images"][0]["bufferView"].as_u64().expect("an index") as usize;
                d.root["bufferViews"][view]["byteLength"] = json!(40);
            },
            "(images[0])",
        ),
    ] {
        let error = with(change);
        assert!(error.contains(fragment), "{fragment} in {error}");
    }
}
