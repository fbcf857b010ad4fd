//! Parameters of microfacet models.

use alloc::format;

use etendue_brdf::{BeckmannLambda, Distribution, Masking};

use super::super::Context;
use super::super::reader::PluginReader;
use super::super::value::{Role, texture_if_given, texture_or};
use crate::SceneError;
use crate::material::Roughness;
use crate::xml::Value;

/// The distribution of facets, and how they hide each other.
///
/// * `distribution`: `beckmann` (default) or `ggx`;
/// * `masking`: `separable` (default, as in Mitsuba) or `correlated`, the exact form;
/// * `smith_lambda`: `walter` (default, the rational fit Mitsuba uses) or `exact`, for `beckmann`.
pub(super) fn facets(reader: &mut PluginReader<'_>) -> Result<(Distribution, Masking), SceneError> {
    let is_ggx = reader.choice("distribution", &[("beckmann", false), ("ggx", true)])?;
    let masking = reader.choice(
        "masking",
        &[("separable", Masking::Separable), ("correlated", Masking::HeightCorrelated)],
    )?;
    let lambda = reader.choice(
        "smith_lambda",
        &[("walter", BeckmannLambda::Walter), ("exact", BeckmannLambda::Exact)],
    )?;
    // Visible normals are always sampled: the other way of Mitsuba only adds noise.
    reader.boolean("sample_visible", true)?;
    let distribution = if is_ggx { Distribution::Ggx } else { Distribution::Beckmann { lambda } };
    Ok((distribution, masking))
}

/// The facets with their widths: `alpha` (0.1), or `alpha_u` and `alpha_v`.
pub(super) fn roughness<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<Roughness, SceneError> {
    let (distribution, masking) = facets(reader)?;
    for name in ["alpha", "alpha_u", "alpha_v"] {
        check_alpha(reader, name)?;
    }
    let alpha_u = texture_if_given(reader, context, "alpha_u", Role::Material)?;
    let alpha_v = texture_if_given(reader, context, "alpha_v", Role::Material)?;
    let (alpha_u, alpha_v) = match (alpha_u, alpha_v) {
        (Some(u), Some(v)) if !reader.has("alpha") => (u, v),
        (None, None) => {
            let alpha = texture_or(reader, context, "alpha", Role::Material, 0.1)?;
            (alpha, alpha)
        }
        _ => {
            let message = "give either “alpha”, or both “alpha_u” and “alpha_v”";
            return Err(reader.error("alpha_u", message));
        }
    };
    Ok(Roughness { distribution, masking, alpha_u, alpha_v })
}

/// Refuses a negative width.
fn check_alpha(reader: &PluginReader<'_>, name: &str) -> Result<(), SceneError> {
    let property = reader.node().properties.iter().find(|p| p.name == name);
    let value = match property.map(|p| &p.value) {
        Some(Value::Float(x)) => *x,
        Some(Value::Integer(n)) => *n as f64,
        _ => return Ok(()),
    };
    if value >= 0.0 {
        Ok(())
    } else {
        Err(reader.error(name, format!("“{name}” must not be negative, but is {value}")))
    }
}
