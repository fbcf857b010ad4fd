//! `plastic` and `roughplastic`.

use alloc::format;

use etendue_brdf::{Alpha, InternalReflectance, InternalScattering};

use super::super::reader::PluginReader;
use super::super::value::{Role, texture_or};
use super::super::{Context, ior};
use super::roughness::facets;
use crate::SceneError;
use crate::material::{Material, MaterialId, PlasticSurface};

/// A diffuse base under a smooth interface: `diffuse_reflectance` (0.5), `specular_reflectance` (1),
/// `int_ior` (polypropylene), `ext_ior` (air), `nonlinear` (false) and `internal_reflectance`:
/// `mitsuba` (default, its fit) or `exact`.
pub(super) fn smooth<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let eta = ior::relative(reader, "polypropylene", "air")?;
    let internal = internal_reflectance(reader)?;
    plastic(reader, context, PlasticSurface::smooth(eta, internal))
}

/// The same with microfacets of one width `alpha` (0.1), which cannot vary.
pub(super) fn rough<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let eta = ior::relative(reader, "polypropylene", "air")?;
    let internal = internal_reflectance(reader)?;
    let (distribution, masking) = facets(reader)?;
    let alpha = reader.float("alpha")?.unwrap_or(0.1);
    let alpha =
        Alpha::new(alpha as f32).map_err(|e| reader.error("alpha", format!("“alpha”: {e}")))?;
    plastic(reader, context, PlasticSurface::rough(eta, distribution, alpha, masking, internal))
}

fn internal_reflectance(reader: &mut PluginReader<'_>) -> Result<InternalReflectance, SceneError> {
    reader.choice(
        "internal_reflectance",
        &[("mitsuba", InternalReflectance::Mitsuba), ("exact", InternalReflectance::Exact)],
    )
}

fn plastic<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    surface: PlasticSurface,
) -> Result<MaterialId, SceneError> {
    let diffuse_reflectance =
        texture_or(reader, context, "diffuse_reflectance", Role::Reflectance, 0.5)?;
    let specular_reflectance =
        texture_or(reader, context, "specular_reflectance", Role::Reflectance, 1.0)?;
    let scattering = if reader.boolean("nonlinear", false)? {
        InternalScattering::NonLinear
    } else {
        InternalScattering::Linear
    };
    let material =
        Material::Plastic { surface, diffuse_reflectance, specular_reflectance, scattering };
    context.add_material(material, &reader.node().location)
}
