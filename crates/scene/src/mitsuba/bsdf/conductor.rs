//! `conductor` and `roughconductor`.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::super::conductors::{self, Conductor};
use super::super::reader::PluginReader;
use super::super::value::{Role, texture_or};
use super::super::{Context, ior};
use super::compensation;
use super::roughness::roughness;
use crate::SceneError;
use crate::material::{ConductorIndex, Material, MaterialId, Roughness};
use crate::texture::{Texture, TextureId};
use crate::xml::nearest;

/// A polished metal: `material` (none), or `eta` and `k`; `ext_eta` (1), `specular_reflectance` (1).
pub(super) fn smooth<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    conductor(reader, context, None)
}

/// The same with microfacets.
pub(super) fn rough<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<MaterialId, SceneError> {
    let roughness = roughness(reader, context)?;
    conductor(reader, context, Some(roughness))
}

fn conductor<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    roughness: Option<Roughness>,
) -> Result<MaterialId, SceneError> {
    let index = index(reader, context)?;
    let specular_reflectance =
        texture_or(reader, context, "specular_reflectance", Role::Reflectance, 1.0)?;
    let how = match &roughness {
        Some(roughness) => compensation::of_metal(reader, roughness)?,
        None => None,
    };
    let material = Material::Conductor { index, roughness, specular_reflectance };
    compensation::add(reader, context, material, how)
}

/// The complex index relative to the outside, of which version 0.6 could state the index.
fn index<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<ConductorIndex, SceneError> {
    let material = reader.string("material")?;
    let exterior = ior::index(reader, "ext_eta", "vacuum")? as f32;
    let (eta, k) = match material {
        Some(_) if reader.has("eta") || reader.has("k") => {
            let message = "give either “material”, or “eta” and “k”";
            return Err(reader.error("material", message));
        }
        Some("none") => return Ok(ConductorIndex::Mirror),
        Some(name) => {
            let Some(conductor) = Conductor::by_name(name) else {
                return Err(unknown_conductor(reader, name));
            };
            let [eta, k] = conductor.textures(&mut context.textures);
            (eta, k)
        }
        None if !reader.has("eta") && !reader.has("k") => return Ok(ConductorIndex::Mirror),
        None => (
            texture_or(reader, context, "eta", Role::Material, 0.0)?,
            texture_or(reader, context, "k", Role::Material, 1.0)?,
        ),
    };
    let relative = |context: &mut Context<'a>, texture: TextureId| {
        let textures = &mut context.textures;
        match textures.get(texture) {
            _ if exterior == 1.0 => Ok(texture),
            Some(&Texture::Constant(value)) => {
                let value = value * exterior.recip();
                Ok(match textures.curve(texture).cloned() {
                    Some(curve) => {
                        textures.constant_curve(value, curve.map(|x| x / f64::from(exterior)))
                    }
                    None => textures.constant(value),
                })
            }
            _ => Err(reader.error("ext_eta", "“ext_eta” needs an index that does not vary")),
        }
    };
    Ok(ConductorIndex::Complex { eta: relative(context, eta)?, k: relative(context, k)? })
}

fn unknown_conductor(reader: &PluginReader<'_>, name: &str) -> SceneError {
    let error = reader.error("material", format!("“{name}” is no known conductor"));
    error.help(match nearest(name, conductors::names()) {
        Some(known) => format!("did you mean “{known}”?"),
        None => {
            let names: Vec<_> = conductors::names().chain(["none"]).collect();
            String::from("known are ") + &names.join(", ")
        }
    })
}
