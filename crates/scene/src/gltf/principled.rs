//! Metal, roughness and what lies on top.

use etendue_brdf::Ior;
use etendue_math::{Real, Spectrum};

use super::json::Json;
use super::material::Reading;
use super::texture::{Part, gloss};
use crate::material::PrincipledTextures;
use crate::texture::TextureId;
use crate::{Color, SceneError};

/// The index of refraction of a material that says nothing about it: it reflects 4 %.
const INDEX: f64 = 1.5;

/// The largest index that there is, for those that are infinite.
const LARGEST_INDEX: f64 = 1e4;

/// The material as Disney's, `spec_trans` of it transmitting.
///
/// ```text
/// base_color, metallic, roughness   as they are: both have GGX facets of width roughness²
/// eta                               1.5, ior, or what reflects the F0 of KHR_materials_specular
/// clearcoat                         clearcoatFactor; the gloss of facets that are as wide
/// sheen                             luminance of sheenColorFactor
/// anisotropic                       of facets whose widths are in the same ratio, up to 10
/// ```
pub(super) fn of(
    reading: &mut Reading<'_, '_>,
    spec_trans: Option<TextureId>,
) -> Result<PrincipledTextures, SceneError> {
    let object = reading.metallic_roughness()?;
    let nothing = reading.builder.constant(0.0);
    let eta = if spec_trans.is_some() { index(&reading.json)? } else { specular_index(reading)? };
    let base_color = reading.base_color()?;
    let metallic = metallic(reading, &object)?;
    let (roughness, anisotropic) = facets(reading)?;
    let (clearcoat, clearcoat_gloss) = match reading.json.extension("KHR_materials_clearcoat")? {
        Some(coat) => clearcoat(reading, &coat)?,
        None => (nothing, nothing),
    };
    let sheen = match reading.json.extension("KHR_materials_sheen")? {
        Some(sheen) => {
            let color = super::color(&sheen, "sheenColorFactor", [0.0; 3])?;
            if color != Color::splat(color.r) {
                reading.warn("the colour of the sheen is taken as grey");
            }
            reading.textured(&sheen, "sheenColorTexture", Part::Color, color)?
        }
        None => nothing,
    };
    let eta = Ior::new(eta as f32).map_err(|error| reading.json.error(error))?;
    Ok(PrincipledTextures {
        base_color,
        roughness,
        anisotropic,
        metallic,
        spec_trans,
        eta,
        spec_tint: nothing,
        sheen,
        sheen_tint: nothing,
        flatness: nothing,
        clearcoat,
        clearcoat_gloss,
        sampling_rates: [1.0; 3],
    })
}

/// The share of metal.
pub(super) fn metallic(
    reading: &mut Reading<'_, '_>,
    object: &Json<'_>,
) -> Result<TextureId, SceneError> {
    reading.share(object, ["metallicFactor", "metallicRoughnessTexture"], 2, 1.0)
}

/// The index of refraction.
pub(super) fn index(material: &Json<'_>) -> Result<f64, SceneError> {
    let Some(extension) = material.extension("KHR_materials_ior")? else { return Ok(INDEX) };
    match extension.number("ior")?.unwrap_or(INDEX) {
        // Everything is reflected, as of an older extension.
        0.0 => Ok(LARGEST_INDEX),
        ior if (1.0..=LARGEST_INDEX).contains(&ior) => Ok(ior),
        ior => Err(extension
            .error(alloc::format!("“ior” must be 0 or from 1 to {LARGEST_INDEX}, not {ior}"))),
    }
}

/// The index of what reflects as much at normal incidence as `KHR_materials_specular` asks for.
///
/// ```text
/// F0 = ((ior − 1)/(ior + 1))² specularFactor · luminance of specularColorFactor,   η = (1 + √F0)/(1 − √F0)
/// ```
fn specular_index(reading: &mut Reading<'_, '_>) -> Result<f64, SceneError> {
    let index = index(&reading.json)?;
    let Some(specular) = reading.json.extension("KHR_materials_specular")? else {
        return Ok(index);
    };
    let factor = specular.number_in("specularFactor", 1.0, 0.0..=1.0)?;
    let color = super::color(&specular, "specularColorFactor", [1.0; 3])?;
    if color != Color::splat(color.r) {
        reading.warn("the colour of the specular reflection is taken as grey");
    }
    for name in ["specularTexture", "specularColorTexture"] {
        if let Some(texture) = specular.get(name)? {
            let message = "the specular reflection is the same everywhere: its texture is not read";
            reading.builder.warn(&texture.warning(message));
        }
    }
    // The weights of the luminance add up to 1 only after rounding.
    let luminance = if color == Color::splat(color.r) { color.r } else { color.luminance() };
    let root = (index - 1.0) / (index + 1.0) * Real::sqrt(factor * f64::from(luminance));
    Ok(if factor == 1.0 && luminance == 1.0 {
        index
    } else {
        ((1.0 + root) / (1.0 - root).max(f64::MIN_POSITIVE)).min(LARGEST_INDEX)
    })
}

/// Roughness and how much wider facets are along u.
///
/// `KHR_materials_anisotropy` has facets of width `α + (1 − α) s²` along the tangent and `α = roughness²` across it; here they are
/// `α'/a` and `α' a` with `a² = 1 − 0.9 anisotropic`.
pub(super) fn facets(reading: &mut Reading<'_, '_>) -> Result<(TextureId, TextureId), SceneError> {
    let object = reading.metallic_roughness()?;
    let roughness = roughness(reading, &object)?;
    let isotropic = reading.builder.constant(0.0);
    let Some(extension) = reading.json.extension("KHR_materials_anisotropy")? else {
        return Ok((roughness, isotropic));
    };
    let strength = extension.number_in("anisotropyStrength", 0.0, 0.0..=1.0)?;
    if strength == 0.0 {
        return Ok((roughness, isotropic));
    }
    if extension.number("anisotropyRotation")?.unwrap_or(0.0) != 0.0 {
        reading.warn("facets are wider along u: the rotation of the anisotropy is not read");
    }
    if let Some(texture) = extension.get("anisotropyTexture")? {
        let message = "the anisotropy is the same everywhere: its texture is not read";
        reading.builder.warn(&texture.warning(message));
    }
    let known = reading.known(roughness);
    let mean = || f64::from(reading.builder.model.textures.mean(roughness).luminance());
    let across = Real::sqr(known.map_or_else(mean, f64::from).clamp(1e-2, 1.0));
    let along = across + (1.0 - across) * Real::sqr(strength);
    let anisotropic = ((1.0 - across / along) / 0.9).min(1.0);
    let anisotropic = reading.builder.constant(anisotropic as f32);
    match known {
        Some(_) => {
            // α'² is the product of the widths, and the roughness the root of α'.
            let roughness =
                Real::sqrt(Real::sqrt(Real::sqrt(across * along) * Real::sqrt(across * along)));
            Ok((reading.builder.constant(roughness as f32), anisotropic))
        }
        None => {
            reading
                .warn("facets have the ratio of widths that belongs to the mean of the roughness");
            Ok((roughness, anisotropic))
        }
    }
}

/// Root of the facets' width.
pub(super) fn roughness(
    reading: &mut Reading<'_, '_>,
    object: &Json<'_>,
) -> Result<TextureId, SceneError> {
    reading.share(object, ["roughnessFactor", "metallicRoughnessTexture"], 1, 1.0)
}

/// Weight and gloss of the clear coat.
fn clearcoat(
    reading: &mut Reading<'_, '_>,
    coat: &Json<'_>,
) -> Result<(TextureId, TextureId), SceneError> {
    let weight = reading.share(coat, ["clearcoatFactor", "clearcoatTexture"], 0, 0.0)?;
    if reading.known(weight) == Some(0.0) {
        return Ok((weight, weight));
    }
    if let Some(normals) = coat.get("clearcoatNormalTexture")? {
        reading.builder.warn(&normals.warning("the coat has the normals of what it covers"));
    }
    let factor = coat.number_in("clearcoatRoughnessFactor", 0.0, 0.0..=1.0)? as f32;
    let part = Part::Gloss(factor.into());
    let gloss = match reading.texture(coat, "clearcoatRoughnessTexture", part)? {
        Some(texture) => texture,
        None => reading.builder.constant(gloss(factor)),
    };
    Ok((weight, gloss))
}
