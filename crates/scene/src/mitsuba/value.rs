//! Colours and numbers that may vary over a surface.

use alloc::format;

use etendue_math::Rgb;

use super::reader::PluginReader;
use super::{Context, spectrum, texture};
use crate::color::{Curve, SpectrumRole, equal_energy_white, spectrum_to_rgb};
use crate::texture::{Texture, TextureId};
use crate::xml::{SpectrumValue, Value};
use crate::{Color, Location, SceneError};

/// What a colour stands for: which values it may have, and how spectra become colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// A share of light, in [0, 1].
    Reflectance,
    /// A property of matter, not negative.
    Material,
    /// Emitted light, not negative.
    Emission,
}

/// The parameter `name` as a texture; grey `default` where it is missing.
///
/// # Errors
/// A value that is neither a number nor a colour, a spectrum or a texture.
pub(super) fn texture_or<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    name: &'static str,
    role: Role,
    default: f32,
) -> Result<TextureId, SceneError> {
    let given = texture_if_given(reader, context, name, role)?;
    Ok(given.unwrap_or_else(|| context.textures.constant(Rgb::new(default, default, default))))
}

/// The parameter `name` as a texture, if it is there.
///
/// # Errors
/// As [`texture_or`].
pub(super) fn texture_if_given<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    name: &'static str,
    role: Role,
) -> Result<Option<TextureId>, SceneError> {
    if let Some(child) = reader.named_child(name) {
        return match spectrum::curve(context, context.description.node(child.node))? {
            Some(value) => constant(context, name, role, &value, &child.location),
            None => texture::translate(context, child.node),
        }
        .map(Some);
    }
    let Some(property) = reader.property(name) else { return Ok(None) };
    constant(context, name, role, &property.value, &property.location).map(Some)
}

/// The texture that is the value of the parameter `name` everywhere.
///
/// # Errors
/// A value that is neither a number nor a colour or a spectrum.
pub(super) fn constant(
    context: &mut Context<'_>,
    name: &str,
    role: Role,
    value: &Value,
    location: &Location,
) -> Result<TextureId, SceneError> {
    let Some(color) = color(value, role) else {
        let found = value.noun();
        let message = format!("“{name}” must be a number, a colour or a texture, not a {found}");
        return Err(SceneError::scene(location.clone(), message));
    };
    let color = checked(color, role, name, location, context)?;
    Ok(match curve(value, role) {
        Some(curve) => context.textures.constant_curve(color, curve),
        None => context.textures.constant(color),
    })
}

/// The parameter `name` as a colour that is the same everywhere; grey `default` where it is missing.
///
/// # Errors
/// As [`texture_or`], and a texture that varies.
pub(super) fn color_or<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    name: &'static str,
    role: Role,
    default: f32,
) -> Result<Color, SceneError> {
    color_and_curve_or(reader, context, name, role, default).map(|(color, _)| color)
}

/// The same with the curve that the colour was given as, if it was.
///
/// # Errors
/// As [`color_or`].
pub(super) fn color_and_curve_or<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
    name: &'static str,
    role: Role,
    default: f32,
) -> Result<(Color, Option<Curve>), SceneError> {
    let texture = texture_or(reader, context, name, role, default)?;
    match context.textures.get(texture) {
        Some(Texture::Constant(color)) => Ok((*color, context.textures.curve(texture).cloned())),
        _ => Err(reader.error(name, format!("“{name}” cannot vary over a surface"))),
    }
}

/// Linear RGB of a value; `None` for values that are no colour.
fn color(value: &Value, role: Role) -> Option<Rgb<f64>> {
    let grey = |x: f64| Rgb::new(x, x, x);
    Some(match value {
        Value::Float(x) => grey(*x),
        Value::Integer(n) => grey(*n as f64),
        Value::Rgb([r, g, b]) => Rgb::new(*r, *g, *b),
        // As Mitsuba does it: a constant reflectance is grey, constant emission is not.
        Value::Spectrum(SpectrumValue::Uniform(x)) if role == Role::Emission => {
            equal_energy_white() * *x
        }
        Value::Spectrum(SpectrumValue::Uniform(x)) => grey(*x),
        Value::Spectrum(SpectrumValue::Samples(samples)) => {
            let role = match role {
                Role::Reflectance => SpectrumRole::Reflectance,
                Role::Material => SpectrumRole::Material,
                Role::Emission => SpectrumRole::Emission,
            };
            spectrum_to_rgb(samples, role)
        }
        _ => return None,
    })
}

/// What a colour is an integral over, where that is given and is not the same for all wavelengths; moved into its domain.
fn curve(value: &Value, role: Role) -> Option<Curve> {
    match value {
        // White of equal energy is not that of daylight, which a colour of light is.
        Value::Spectrum(SpectrumValue::Uniform(x)) if role == Role::Emission => {
            Some(Curve::constant(x.max(0.0)))
        }
        Value::Spectrum(SpectrumValue::Samples(samples)) => {
            Some(Curve::new(samples.clone()).map(|x| x.clamp(0.0, highest(role))))
        }
        _ => None,
    }
}

/// The largest value of what plays a role.
fn highest(role: Role) -> f64 {
    match role {
        Role::Reflectance => 1.0,
        Role::Material | Role::Emission => f64::from(f32::MAX),
    }
}

/// The colour moved into its domain, with a warning where that changes it.
fn checked(
    color: Rgb<f64>,
    role: Role,
    name: &str,
    location: &Location,
    context: &mut Context<'_>,
) -> Result<Color, SceneError> {
    let domain = match role {
        Role::Reflectance => "[0, 1]",
        Role::Material | Role::Emission => "[0, ∞)",
    };
    let channels = color.to_array();
    let clamped = channels.map(|c| c.clamp(0.0, highest(role)));
    if clamped != channels {
        if channels.iter().any(|&c| c > f64::from(f32::MAX)) {
            return Err(SceneError::scene(location.clone(), format!("“{name}” is too large")));
        }
        let [r, g, b] = channels;
        let message = format!("“{name}” ({r}, {g}, {b}) is clamped to {domain}");
        context.warn(location.clone(), message);
    }
    Ok(clamped.map(|c| c as f32).into())
}
