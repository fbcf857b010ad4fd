//! `phong`.

use super::super::Context;
use super::super::reader::PluginReader;
use super::super::value::{Role, texture_or};
use crate::SceneError;
use crate::material::{Material, MaterialId};

/// Phong's modified model, as in Mitsuba 0.6: `diffuse_reflectance` (0.5), `specular_reflectance` (0.2) and `exponent` (30).
/// Where the reflectances exceed 1 together, both are scaled, at the point; version 0.6 scales by their largest values.
pub(super) fn phong<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let diffuse_reflectance =
        texture_or(reader, context, "diffuse_reflectance", Role::Reflectance, 0.5)?;
    let specular_reflectance =
        texture_or(reader, context, "specular_reflectance", Role::Reflectance, 0.2)?;
    let exponent = texture_or(reader, context, "exponent", Role::Material, 30.0)?;
    let material = Material::Phong { diffuse_reflectance, specular_reflectance, exponent };
    context.add_material(material, &reader.node().location)
}
