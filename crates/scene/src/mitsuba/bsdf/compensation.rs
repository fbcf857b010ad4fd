//! What becomes of light that facets scatter more than once.

use alloc::format;
use alloc::sync::Arc;

use etendue_brdf::microfacet::FacetLoss;
use etendue_brdf::{Alpha, Ior, KullaContyDielectric, Microfacets};

use super::super::Context;
use super::super::reader::PluginReader;
use crate::SceneError;
use crate::material::{Compensation, Material, MaterialId, Roughness};

const NAME: &str = "multiple_scattering";

/// The compensation of metal: `multiple_scattering` is `lost` (default, as in Mitsuba), `kulla-conty` or `turquin`.
///
/// # Errors
/// Facets for which there are no tables.
pub(super) fn of_metal(
    reader: &mut PluginReader<'_>,
    roughness: &Roughness,
) -> Result<Option<Compensation>, SceneError> {
    let choices = [("lost", None), ("kulla-conty", Some(false)), ("turquin", Some(true))];
    let Some(is_turquin) = reader.choice(NAME, &choices)? else { return Ok(None) };
    // Of any width: which tables there are depends on the rest.
    let [u, v] = [Alpha::clamped(0.5); 2];
    let facets = Microfacets::new(roughness.distribution, u, v, roughness.masking);
    if FacetLoss::new(&facets).is_err() || roughness.alpha_u != roughness.alpha_v {
        let message = format!(
            "there are tables of “{NAME}” for isotropic facets only, “ggx” ones or “beckmann” ones with “smith_lambda” \
             “exact” and “masking” “correlated”"
        );
        return Err(reader.error(NAME, message));
    }
    Ok(Some(if is_turquin { Compensation::TurquinMetal } else { Compensation::KullaContyMetal }))
}

/// The compensation of glass: `multiple_scattering` is `lost` (default, as in Mitsuba) or `kulla-conty`, whose tables are made
/// here.
///
/// # Errors
/// Facets for which none can be made: widths that differ, vary or exceed 1, Walter's fit of Beckmann's Λ; equal indices.
pub(super) fn of_glass(
    reader: &mut PluginReader<'_>,
    context: &Context<'_>,
    eta: Ior<f32>,
    roughness: &Roughness,
) -> Result<Option<Compensation>, SceneError> {
    if !reader.choice(NAME, &[("lost", false), ("kulla-conty", true)])? {
        return Ok(None);
    }
    let widths = [roughness.alpha_u, roughness.alpha_v];
    if !widths.iter().all(|&width| context.textures.is_constant(width)) {
        return Err(
            reader.error(NAME, format!("“{NAME}” of glass needs a width that does not vary"))
        );
    }
    let [u, v] = widths.map(|width| Alpha::clamped(context.textures.mean(width).r));
    let facets = Microfacets::new(roughness.distribution, u, v, roughness.masking);
    let model = KullaContyDielectric::new(eta, facets)
        .map_err(|error| reader.error(NAME, format!("“{NAME}” cannot be computed: {error}")))?;
    Ok(Some(Compensation::KullaContyGlass(Arc::new(model))))
}

/// A material, with its compensation around it if it has one.
pub(super) fn add(
    reader: &PluginReader<'_>,
    context: &mut Context<'_>,
    material: Material,
    how: Option<Compensation>,
) -> Result<MaterialId, SceneError> {
    let location = &reader.node().location;
    let nested = context.add_material(material, location)?;
    match how {
        Some(how) => context.add_material(Material::Compensated { nested, how }, location),
        None => Ok(nested),
    }
}
