//! Materials of MTL files.

use alloc::boxed::Box;
use alloc::format;
use std::path::Path;

use etendue_brdf::Ior;
use etendue_math::Spectrum;
use etendue_math::glam::{DMat4, DVec3};

use super::Context;
use super::image::texels;
use crate::load::{Encoding, MtlMap, MtlMaterial, load_image};
use crate::material::{Material, MaterialId, Perturbation, PrincipledTextures};
use crate::texture::{Bitmap, Filter, Texture, TextureId, UvTransform, Wrap};
use crate::{Color, Location, SceneError};

/// What a material without colours reflects.
pub(super) const DEFAULT_ALBEDO: Color = Color::new(0.5, 0.5, 0.5);

/// The index of a material that states none.
const DEFAULT_INDEX: f32 = 1.5;

/// What a surface is made of and what it emits.
#[derive(Clone, Copy)]
pub(super) struct Look {
    pub(super) material: MaterialId,
    pub(super) radiance: Option<TextureId>,
}

/// What a material of an MTL file looks like. `path` is the mesh, for messages.
///
/// * With any value or map of the PBR extension: Disney's material of that colour, roughness, metalness, sheen, coat, anisotropy
///   and index;
/// * otherwise with an illumination model that refracts (4, 6, 7, 9): glass of that index, its transmission coloured by `Tf`;
/// * otherwise with a specular colour and exponent, unless the illumination model (0, 1) has no highlights: Phong's model;
/// * otherwise diffuse.
///
/// On both sides, with its normal map or bumps and, but for glass, opacity. What it emits is the light of its front. Images
/// that cannot be read are warnings, since meshes often travel without theirs.
pub(super) fn look(
    context: &mut Context<'_>,
    material: &MtlMaterial,
    path: &Path,
) -> Result<Look, SceneError> {
    let base = Base::of(material);
    let mut id = surface(context, material, base, path)?;
    let options = Perturbation { flip_invalid_normals: true, use_shadowing_function: true };
    if let Some(normal) = image(context, material.normal_map.as_ref(), Encoding::Raw) {
        id = add(context, Material::NormalMap { normal, options, nested: id }, path)?;
    } else if let Some(map) = &material.bump_map
        && let Some(height) = image(context, Some(map), Encoding::Raw)
    {
        id =
            add(context, Material::BumpMap { height, scale: map.bump, options, nested: id }, path)?;
    }
    id = on_both_sides(context, id);
    if base != Base::Glass {
        let opacity = image(context, material.opacity_map.as_ref(), Encoding::Raw)
            .or_else(|| Some(number(context, material.opacity.filter(|d| *d < 1.0)?)));
        if let Some(opacity) = opacity {
            id = add(context, Material::Mask { opacity, nested: id }, path)?;
        }
    }
    let radiance = image(context, material.emission_map.as_ref(), Encoding::Srgb).or_else(|| {
        let emission = nonnegative(material.emission?);
        (!emission.is_black()).then(|| context.textures.constant(emission))
    });
    Ok(Look { material: id, radiance })
}

/// What kind of material it is below maps and masks.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Base {
    Principled,
    Glass,
    Phong,
    Diffuse,
}

impl Base {
    fn of(m: &MtlMaterial) -> Self {
        let values = [m.roughness, m.metallic, m.sheen, m.clearcoat, m.anisotropy];
        let maps = [&m.roughness_map, &m.metallic_map];
        if values.iter().any(Option::is_some) || maps.iter().any(|map| map.is_some()) {
            return Self::Principled;
        }
        if m.illumination.is_some_and(|model| [4.0, 6.0, 7.0, 9.0].contains(&model)) {
            return Self::Glass;
        }
        let shines = m.specular_map.is_some() || m.specular.is_some_and(|ks| !ks.is_black());
        let is_matte = m.illumination.is_some_and(|model| model < 2.0);
        if shines && !is_matte && m.shininess.is_some() { Self::Phong } else { Self::Diffuse }
    }
}

fn surface(
    context: &mut Context<'_>,
    m: &MtlMaterial,
    base: Base,
    path: &Path,
) -> Result<MaterialId, SceneError> {
    let eta = index(context, m, path)?;
    let mut color = |map: &Option<MtlMap>, color: Option<Color>, default: Color| {
        image(context, map.as_ref(), Encoding::Srgb)
            .unwrap_or_else(|| context.textures.constant(share(color.unwrap_or(default))))
    };
    let material = match base {
        Base::Diffuse => {
            Material::Diffuse { reflectance: color(&m.diffuse_map, m.diffuse, DEFAULT_ALBEDO) }
        }
        Base::Phong => Material::Phong {
            diffuse_reflectance: color(&m.diffuse_map, m.diffuse, DEFAULT_ALBEDO),
            specular_reflectance: color(&m.specular_map, m.specular, Color::black()),
            exponent: number(context, m.shininess.unwrap_or_default()),
        },
        Base::Glass => Material::Dielectric {
            eta,
            dispersion: None,
            nesting: None,
            roughness: None,
            specular_reflectance: color(&None, None, Color::white()),
            specular_transmittance: color(&None, m.transmission, Color::white()),
        },
        Base::Principled => {
            let base_color = color(&m.diffuse_map, m.diffuse, DEFAULT_ALBEDO);
            let mut value = |map: &Option<MtlMap>, value: Option<f32>, default: f32| {
                image(context, map.as_ref(), Encoding::Raw)
                    .unwrap_or_else(|| number(context, value.unwrap_or(default).clamp(0.0, 1.0)))
            };
            Material::Principled(Box::new(PrincipledTextures {
                base_color,
                roughness: value(&m.roughness_map, m.roughness, 0.5),
                anisotropic: value(&None, m.anisotropy, 0.0),
                metallic: value(&m.metallic_map, m.metallic, 0.0),
                spec_trans: None,
                eta,
                spec_tint: value(&None, None, 0.0),
                sheen: value(&None, m.sheen, 0.0),
                sheen_tint: value(&None, None, 0.0),
                flatness: value(&None, None, 0.0),
                clearcoat: value(&None, m.clearcoat, 0.0),
                clearcoat_gloss: value(&None, m.clearcoat_roughness.map(|r| 1.0 - r), 1.0),
                sampling_rates: [1.0; 3],
            }))
        }
    };
    add(context, material, path)
}

/// The index of refraction, or the usual one with a warning where it is none.
fn index(context: &mut Context<'_>, m: &MtlMaterial, path: &Path) -> Result<Ior<f32>, SceneError> {
    let given = m.ior.unwrap_or(DEFAULT_INDEX);
    let index = Ior::new(given).or_else(|error| {
        let message = format!("material “{}”: {error}; {DEFAULT_INDEX} instead", m.name);
        context.warn(Location::file(path), message);
        Ior::new(DEFAULT_INDEX)
    });
    index.map_err(|error| SceneError::scene(Location::file(path), format!("{error}")))
}

/// The image of a map; `None` without one, and with a warning where it cannot be read.
fn image(context: &mut Context<'_>, map: Option<&MtlMap>, encoding: Encoding) -> Option<TextureId> {
    let map = map?;
    match bitmap(context, map, encoding) {
        Ok(bitmap) => Some(context.textures.add(Texture::Bitmap(bitmap))),
        Err(error) => {
            context.warn(error.location, error.message);
            None
        }
    }
}

fn bitmap(
    context: &mut Context<'_>,
    map: &MtlMap,
    encoding: Encoding,
) -> Result<Bitmap, SceneError> {
    let refused = |message| SceneError::scene(Location::file(&map.path), message);
    context.sandbox.check(&map.path)?;
    let image = load_image(&map.path, encoding)?;
    context.read(&map.path, size_of_val(image.data()))?;
    let image = texels(&image).map_err(|e| refused(format!("{e}")))?;
    let wrap = if map.clamp { Wrap::Clamp } else { Wrap::Repeat };
    // The file counts v from the bottom, textures from the top: v' = s v + o becomes s v + 1 − s − o.
    let ([s, t], [u, v]) = (map.scale.map(f64::from), map.offset.map(f64::from));
    let uv = DMat4::from_translation(DVec3::new(u, 1.0 - t - v, 0.0))
        * DMat4::from_scale(DVec3::new(s, t, 1.0));
    let uv = UvTransform::from_matrix4(uv)
        .ok_or_else(|| refused("its scale or offset is out of range".into()))?;
    Ok(Bitmap::new(image, Filter::Bilinear, wrap, uv))
}

fn add(
    context: &mut Context<'_>,
    material: Material,
    path: &Path,
) -> Result<MaterialId, SceneError> {
    context.add_material(material, &Location::file(path))
}

/// The material on both sides where it has only one: which side of a bare mesh is its outside is
/// anybody's guess.
pub(super) fn on_both_sides(context: &mut Context<'_>, material: MaterialId) -> MaterialId {
    let both = Material::TwoSided { front: material, back: material };
    context.materials.add(both).unwrap_or(material)
}

fn number(context: &mut Context<'_>, x: f32) -> TextureId {
    context.textures.constant(Color::splat(x.max(0.0)))
}

fn share(color: Color) -> Color {
    color.map(|c| c.clamp(0.0, 1.0))
}

fn nonnegative(color: Color) -> Color {
    color.map(|c| c.max(0.0))
}
