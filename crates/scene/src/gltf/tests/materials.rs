//! Materials and their extensions.

use alloc::vec::Vec;

use etendue_math::Real;
use serde_json::{Value, json};

use super::{Draft, warnings};
use crate::Color;
use crate::gltf::Model;
use crate::light::Light;
use crate::material::{Material, MaterialId, PrincipledTextures, PrincipledThinTextures};
use crate::medium::Extinction;
use crate::texture::TextureId;

/// The model of a square of a material, which gives no warning.
fn model(material: Value) -> Model {
    let model = Draft::of_material(material).model();
    assert_eq!(warnings(&model), [""; 0]);
    model
}

fn material(model: &Model, id: MaterialId) -> &Material {
    model.materials.get(id).expect("a material")
}

/// The material of the square, without what makes it two-sided.
fn worn(model: &Model) -> &Material {
    match material(model, model.surfaces[0].material) {
        &Material::TwoSided { front, back } => {
            assert_eq!(front, back);
            material(model, front)
        }
        other => other,
    }
}

fn principled(model: &Model) -> &PrincipledTextures {
    match worn(model) {
        Material::Principled(textures) => textures,
        other => panic!("{other:?} is not principled"),
    }
}

fn thin(model: &Model) -> &PrincipledThinTextures {
    match worn(model) {
        Material::PrincipledThin(textures) => textures,
        other => panic!("{other:?} is no principled sheet"),
    }
}

fn value(model: &Model, id: TextureId) -> f32 {
    model.textures.value(id, [0.5; 2])
}

fn color(model: &Model, id: TextureId) -> [f32; 3] {
    model.textures.color(id, [0.5; 2]).to_array()
}

fn extended(name: &str, extension: Value) -> Value {
    let mut material = json!({ "extensions": {} });
    material["extensions"][name] = extension;
    material
}

#[test]
fn metal_and_roughness_are_those_of_principled() {
    let default = model(json!({}));
    let p = principled(&default);
    assert_eq!(color(&default, p.base_color), [1.0; 3]);
    assert_eq!(
        [p.metallic, p.roughness, p.sheen, p.clearcoat].map(|id| value(&default, id)),
        [1.0, 1.0, 0.0, 0.0]
    );
    assert_eq!((p.eta.value(), p.spec_trans), (1.5, None));
    let given = model(json!({ "doubleSided": true, "pbrMetallicRoughness": {
        "baseColorFactor": [0.25, 0.5, 0.75, 0.5], "metallicFactor": 0.125, "roughnessFactor": 0.25,
    }}));
    let p = principled(&given);
    assert_eq!(color(&given, p.base_color), [0.25, 0.5, 0.75]);
    assert_eq!([p.metallic, p.roughness].map(|id| value(&given, id)), [0.125, 0.25]);
    // A primitive without a material is of the default one.
    let mut draft = Draft::new();
    let square = draft.square();
    draft.node(&[square]);
    let bare = draft.model();
    assert_eq!(value(&bare, principled(&bare).metallic), 1.0);
}

#[test]
fn the_index_and_what_is_reflected_become_the_index_of_principled() {
    let eta = |material: Value| {
        let model = model(material);
        principled(&model).eta.value()
    };
    assert_eq!(eta(extended("KHR_materials_ior", json!({ "ior": 1.25 }))), 1.25);
    assert_eq!(eta(extended("KHR_materials_ior", json!({ "ior": 0 }))), 1e4);
    assert_eq!(eta(extended("KHR_materials_specular", json!({}))), 1.5);
    assert_eq!(eta(extended("KHR_materials_specular", json!({ "specularFactor": 0 }))), 1.0);
    // 1 % instead of 4 %: 1.1/0.9.
    let dim = eta(extended("KHR_materials_specular", json!({ "specularFactor": 0.25 })));
    assert!((dim - 1.1 / 0.9).abs() < 1e-6, "{dim}");
    let bright = json!({ "specularColorFactor": [4, 4, 4] });
    let bright = eta(extended("KHR_materials_specular", bright));
    assert!((bright - 1.4 / 0.6).abs() < 1e-6, "{bright}");
    let coloured = json!({ "specularColorFactor": [1, 0, 0] });
    let model = Draft::of_material(extended("KHR_materials_specular", coloured)).model();
    assert!(warnings(&model)[0].contains("materials[0]: the colour of the specular"));
}

#[test]
fn emission_is_radiance_with_its_strength() {
    let mut shining = extended("KHR_materials_emissive_strength", json!({ "emissiveStrength": 8 }));
    shining["emissiveFactor"] = json!([1, 0.5, 0]);
    let lit = model(shining);
    let [Light::Area(light)] = lit.lights[..] else { panic!("{:?}", lit.lights) };
    assert_eq!(color(&lit, light.radiance), [8.0, 4.0, 0.0]);
    assert_eq!(lit.surfaces[0].light.map(|id| id.0), Some(0));
    assert_eq!(model(json!({ "emissiveFactor": [0, 0, 0] })).lights.len(), 0);
}

#[test]
fn what_is_unlit_shines_in_its_colour_and_reflects_nothing() {
    let mut plain = extended("KHR_materials_unlit", json!({}));
    plain["pbrMetallicRoughness"] = json!({ "baseColorFactor": [0.25, 0.5, 0.75, 1] });
    let model = model(plain);
    let [Light::Area(light)] = model.lights[..] else { panic!("{:?}", model.lights) };
    assert_eq!(color(&model, light.radiance), [0.25, 0.5, 0.75]);
    let &Material::Diffuse { reflectance } = worn(&model) else { panic!("{:?}", worn(&model)) };
    assert_eq!(color(&model, reflectance), [0.0; 3]);
}

#[test]
fn holes_are_masks_and_what_is_whole_has_none() {
    let opacity = |mode: &str, alpha: f64, cutoff: f64| {
        let described = json!({
            "alphaMode": mode, "alphaCutoff": cutoff, "emissiveFactor": [1, 1, 1],
            "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, alpha] },
        });
        let model = model(described);
        let radiance = match model.lights[..] {
            [Light::Area(light)] => value(&model, light.radiance),
            _ => 0.0,
        };
        match *worn(&model) {
            Material::Mask { opacity, nested } => {
                assert!(matches!(material(&model, nested), Material::TwoSided { .. }));
                (Some(value(&model, opacity)), radiance)
            }
            _ => (None, radiance),
        }
    };
    assert_eq!(opacity("OPAQUE", 0.25, 0.5), (None, 1.0));
    assert_eq!(opacity("BLEND", 0.25, 0.5), (Some(0.25), 0.25));
    assert_eq!(opacity("BLEND", 1.0, 0.5), (None, 1.0));
    assert_eq!(opacity("MASK", 0.25, 0.25), (None, 1.0));
    assert_eq!(opacity("MASK", 0.25, 0.26), (Some(0.0), 0.0));
}

fn transmitting(factor: f64, roughness: f64, extensions: Value) -> Value {
    let mut material = json!({
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.25, 0.5, 1, 1], "metallicFactor": 0, "roughnessFactor": roughness,
        },
    });
    material["extensions"] = extensions;
    material["extensions"]["KHR_materials_transmission"] = json!({ "transmissionFactor": factor });
    material
}

#[test]
fn a_smooth_sheet_is_a_pane_and_a_rough_one_thin_principled() {
    let pane = model(transmitting(1.0, 0.0, json!({ "KHR_materials_ior": { "ior": 1.25 } })));
    let &Material::ThinDielectric { eta, specular_reflectance, specular_transmittance } =
        worn(&pane)
    else {
        panic!("{:?}", worn(&pane));
    };
    assert_eq!(eta.value(), 1.25);
    assert_eq!(color(&pane, specular_reflectance), [1.0; 3]);
    assert_eq!(color(&pane, specular_transmittance), [0.25, 0.5, 1.0]);
    let frosted = model(transmitting(0.75, 0.5, json!({})));
    let t = thin(&frosted);
    assert_eq!(t.spec_trans.map(|id| value(&frosted, id)), Some(0.75));
    assert_eq!([t.roughness, t.eta, t.diff_trans].map(|id| value(&frosted, id)), [0.5, 1.5, 0.0]);
    // Metal transmits nothing.
    let mut metal = transmitting(1.0, 0.0, json!({}));
    metal["pbrMetallicRoughness"]["metallicFactor"] = json!(1);
    assert_eq!(principled(&model(metal)).spec_trans, None);
    assert_eq!(principled(&model(transmitting(0.0, 0.0, json!({})))).spec_trans, None);
}

#[test]
fn a_body_is_glass_with_an_absorbing_medium_inside() {
    let volume = json!({
        "thicknessFactor": 0.1, "attenuationDistance": 2, "attenuationColor": [1, 0.5, 0],
    });
    let glass = model(transmitting(1.0, 0.5, json!({ "KHR_materials_volume": volume })));
    let Material::Dielectric { eta, dispersion: None, roughness: Some(roughness), .. } =
        worn(&glass)
    else {
        panic!("{:?}", worn(&glass));
    };
    assert_eq!(eta.value(), 1.5);
    // GGX of width roughness².
    assert_eq!([roughness.alpha_u, roughness.alpha_v].map(|id| value(&glass, id)), [0.25; 2]);
    let boundary = glass.surfaces[0].boundary.expect("media");
    assert_eq!(boundary.exterior, None);
    let medium = glass.media.get(boundary.interior.expect("a medium inside")).expect("a medium");
    let Extinction::Homogeneous(sigma) = medium.extinction else { panic!("it is homogeneous") };
    // −ln c / 2; black is as dark as 1e-6.
    let expected = [0.0, core::f32::consts::LN_2 / 2.0, -Real::ln(1e-6_f32) / 2.0];
    for (found, expected) in sigma.to_array().into_iter().zip(expected) {
        assert!((found - expected).abs() <= 1e-6 * expected, "{found} {expected}");
    }
    let smooth = json!({ "KHR_materials_volume": { "thicknessFactor": 0.1 } });
    let smooth = model(transmitting(1.0, 0.0, smooth));
    assert!(matches!(worn(&smooth), Material::Dielectric { roughness: None, .. }));
    assert_eq!((smooth.surfaces[0].boundary, smooth.media.list.len()), (None, 0));
    // Without thickness it is a sheet, and in part it is principled.
    let sheet = json!({ "KHR_materials_volume": { "attenuationDistance": 1 } });
    assert!(matches!(worn(&model(transmitting(1.0, 0.0, sheet))), Material::ThinDielectric { .. }));
    let part = json!({ "KHR_materials_volume": { "thicknessFactor": 1 } });
    let part = model(transmitting(0.5, 0.0, part));
    assert_eq!(principled(&part).spec_trans.map(|id| value(&part, id)), Some(0.5));
}

#[test]
fn dispersion_is_twenty_over_abbe_s_number() {
    let volume = json!({ "thicknessFactor": 1 });
    let dispersive = |amount: f64| {
        let dispersion = json!({ "dispersion": amount });
        transmitting(
            1.0,
            0.0,
            json!({ "KHR_materials_volume": volume, "KHR_materials_dispersion": dispersion }),
        )
    };
    let glass = model(dispersive(0.5));
    let Material::Dielectric { dispersion: Some(relative), .. } = worn(&glass) else {
        panic!("{:?}", worn(&glass));
    };
    // A few roundings, divided by nF − nC = 0.0125.
    assert!((relative.interior.abbe_number() - 40.0).abs() < 1e-10);
    assert!(matches!(worn(&model(dispersive(0.0))), Material::Dielectric { dispersion: None, .. }));
    let error = Draft::of_material(dispersive(1e9)).error();
    assert!(
        error.contains("materials[0].extensions.KHR_materials_dispersion: the index at"),
        "{error}"
    );
    let sheet = json!({ "KHR_materials_dispersion": { "dispersion": 1 } });
    let sheet = Draft::of_material(transmitting(1.0, 0.0, sheet)).model();
    assert!(warnings(&sheet)[0].contains("disperse"), "{:?}", warnings(&sheet));
}

#[test]
fn coats_are_as_wide_as_they_say() {
    let coat = |roughness: f64| {
        let coat = json!({ "clearcoatFactor": 0.5, "clearcoatRoughnessFactor": roughness });
        let model = model(extended("KHR_materials_clearcoat", coat));
        let p = principled(&model);
        assert_eq!(value(&model, p.clearcoat), 0.5);
        value(&model, p.clearcoat_gloss)
    };
    assert_eq!((coat(0.0), coat(0.5)), (1.0, 0.0));
    // α = 0.04 = 0.1 − 0.099 gloss.
    assert!((coat(0.2) - 0.06 / 0.099).abs() < 1e-6);
}

#[test]
fn sheen_is_its_luminance() {
    let sheen = json!({ "sheenColorFactor": [0.5, 0.5, 0.5], "sheenRoughnessFactor": 0.3 });
    let grey = model(extended("KHR_materials_sheen", sheen));
    assert_eq!(value(&grey, principled(&grey).sheen), 0.5);
    let blue = json!({ "sheenColorFactor": [0, 0, 1] });
    let blue = Draft::of_material(extended("KHR_materials_sheen", blue)).model();
    let luminance = etendue_math::Spectrum::luminance(Color::new(0.0, 0.0, 1.0));
    assert_eq!(value(&blue, principled(&blue).sheen), luminance);
    assert!(warnings(&blue)[0].contains("colour of the sheen"));
}

#[test]
fn anisotropic_facets_have_the_widths_of_the_extension() {
    let with = |strength: f64, roughness: f64| {
        let mut material =
            extended("KHR_materials_anisotropy", json!({ "anisotropyStrength": strength }));
        material["pbrMetallicRoughness"] = json!({ "roughnessFactor": roughness });
        let model = model(material);
        let p = principled(&model);
        let [roughness, anisotropic] = [p.roughness, p.anisotropic].map(|id| value(&model, id));
        let aspect = (1.0 - 0.9 * anisotropic).sqrt();
        [roughness * roughness / aspect, roughness * roughness * aspect]
    };
    for (strength, roughness) in [(0.0, 0.5), (0.3, 0.5), (0.5, 0.7), (1.0, 0.6)] {
        let across = roughness * roughness;
        let along = across + (1.0 - across) * strength * strength;
        let found = with(strength, roughness);
        for (found, expected) in found.into_iter().zip([along, across]) {
            // Two square roots in f32 and their inverses.
            assert!(
                (f64::from(found) - expected).abs() < 1e-6,
                "{strength} {roughness}: {found} {expected}"
            );
        }
    }
    // Ten times is as far as they go.
    let [along, across] = with(1.0, 0.1);
    assert!((along / across - 10.0).abs() < 1e-3, "{along} {across}");
    let turned = json!({ "anisotropyStrength": 1, "anisotropyRotation": 1 });
    let turned = Draft::of_material(extended("KHR_materials_anisotropy", turned)).model();
    assert!(warnings(&turned)[0].contains("rotation of the anisotropy"));
}

#[test]
fn parameters_outside_their_domain_are_refused_where_they_stand() {
    for (material, fragment) in [
        (json!(5), "materials[0]: must be an object, not 5"),
        (json!({ "alphaMode": "ADD" }), "materials[0].alphaMode: “ADD” is none of"),
        (
            json!({ "pbrMetallicRoughness": { "metallicFactor": 2 } }),
            "materials[0].pbrMetallicRoughness.metallicFactor: must be from 0 to 1, not 2",
        ),
        (
            json!({ "pbrMetallicRoughness": { "roughnessFactor": "1" } }),
            "roughnessFactor: must be a number, not a string",
        ),
        (
            json!({ "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1] } }),
            "baseColorFactor: must be a list of 4 numbers, not a list of 3",
        ),
        (
            json!({ "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 2] } }),
            "“baseColorFactor” must be four numbers from 0 to 1",
        ),
        (json!({ "emissiveFactor": [-1, 0, 0] }), "materials[0]: “emissiveFactor” must be three"),
        (json!({ "emissiveFactor": [1e300, 0, 0] }), "emissiveFactor[0]: "),
        (extended("KHR_materials_ior", json!({ "ior": 0.5 })), "“ior” must be 0 or from 1"),
        (
            extended("KHR_materials_ior", json!([])),
            "KHR_materials_ior: must be an object, not a list",
        ),
        (
            transmitting(
                1.0,
                0.0,
                json!({ "KHR_materials_volume": { "thicknessFactor": 1, "attenuationDistance": 0 } }),
            ),
            "“attenuationDistance” must be positive, not 0",
        ),
    ] {
        let error = Draft::of_material(material).error();
        assert!(error.contains(fragment), "{fragment} in {error}");
    }
}

#[test]
fn colours_of_vertices_multiply_the_base_colour_and_the_opacity() {
    let mut draft = Draft::of_material(json!({
        "alphaMode": "BLEND", "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.5, 0.5, 0.5] },
    }));
    let bytes: Vec<u8> =
        [[255, 0, 0, 255], [255, 0, 0, 255], [255, 0, 0, 0], [255, 0, 0, 0]].concat();
    let colors = draft.accessor(5121, "VEC4", 4, &bytes);
    draft.root["accessors"][colors]["normalized"] = json!(true);
    draft.root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
    let model = draft.model();
    let Material::Mask { opacity, nested } = *worn(&model) else { panic!("{:?}", worn(&model)) };
    let Material::TwoSided { front, .. } = *material(&model, nested) else { panic!("two sides") };
    let Material::Principled(ref textures) = *material(&model, front) else { panic!("principled") };
    let base = textures.base_color;
    let geometry = model.geometry.build();
    for (y, color, alpha) in [(-0.5, 0.5, 0.375), (0.5, 0.5, 0.125)] {
        let ray = crate::geometry::Ray::new([0.3, y, 1.0].into(), -etendue_math::glam::Vec3::Z);
        let hit = geometry.intersect(&ray).expect("the square");
        let point = geometry.surface_point(&ray, &hit);
        let located = crate::geometry::Located::new(&geometry, point);
        let found = model.textures.color(base, &located);
        // Weights that add up to 1 after rounding.
        assert!((found.r - color).abs() < 1e-6 && found.g == 0.0, "{found:?}");
        assert!((model.textures.value(opacity, &located) - alpha).abs() < 1e-6);
    }
}
