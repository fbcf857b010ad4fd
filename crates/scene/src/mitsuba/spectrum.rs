//! Spectra given by a plugin: `regular`, `irregular` and `blackbody`.

use alloc::format;
use alloc::vec::Vec;

use etendue_math::Real;

use super::Context;
use super::reader::PluginReader;
use super::value::{Role, constant};
use crate::SceneError;
use crate::texture::TextureId;
use crate::xml::{Node, SpectrumValue, Value, increasing};

/// The ends of what is visible, in nm.
const VISIBLE: [f64; 2] = [360.0, 830.0];

/// Nanometres between the samples of a black body's radiance: linear interpolation is off by less than 1e-6 of the
/// largest value.
const STEP: f64 = 1.0;

/// The curve that a node describes; `None` for another kind of texture.
pub(super) fn curve<'a>(
    context: &mut Context<'a>,
    node: &'a Node,
) -> Result<Option<Value>, SceneError> {
    if !["blackbody", "irregular", "regular"].contains(&node.plugin.as_str()) {
        return Ok(None);
    }
    let mut reader = PluginReader::new(node);
    let samples = samples(&mut reader)?;
    reader.finish(context)?;
    Ok(Some(Value::Spectrum(samples)))
}

/// The curve where no parameter says what it stands for: that of matter.
pub(super) fn of_matter<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<TextureId, SceneError> {
    let value = Value::Spectrum(samples(reader)?);
    let plugin = reader.node().plugin.as_str();
    constant(context, plugin, Role::Material, &value, &reader.node().location)
}

fn samples(reader: &mut PluginReader<'_>) -> Result<SpectrumValue, SceneError> {
    match reader.node().plugin.as_str() {
        "blackbody" => black_body(reader),
        "irregular" => irregular(reader),
        _ => regular(reader),
    }
}

/// `values` at wavelengths evenly spaced from `wavelength_min` to `wavelength_max`.
fn regular(reader: &mut PluginReader<'_>) -> Result<SpectrumValue, SceneError> {
    let [first, last] = range(reader, None)?;
    let values = list(reader, "values")?;
    let step = (last - first) / (values.len().max(2) - 1) as f64;
    let samples = (0..).zip(values).map(|(i, value)| (first + f64::from(i) * step, value));
    increasing(samples.collect()).map_err(|message| reader.error("values", message))
}

/// `values` at `wavelengths`.
fn irregular(reader: &mut PluginReader<'_>) -> Result<SpectrumValue, SceneError> {
    let wavelengths = list(reader, "wavelengths")?;
    let values = list(reader, "values")?;
    if wavelengths.len() != values.len() {
        let message = format!("{} wavelengths have {} values", wavelengths.len(), values.len());
        return Err(reader.error("values", message));
    }
    let samples = wavelengths.into_iter().zip(values).collect();
    increasing(samples).map_err(|message| reader.error("wavelengths", message))
}

/// Planck's law in W m⁻² sr⁻¹ nm⁻¹ at `temperature` in K, from `wavelength_min` (360) to `wavelength_max` (830).
///
/// ```text
/// B = 2 h c² / λ⁵ / (exp(h c / (λ k T)) − 1)
/// ```
///
/// # Source
/// Constants of CODATA 2018, which are exact.
fn black_body(reader: &mut PluginReader<'_>) -> Result<SpectrumValue, SceneError> {
    const PLANCK: f64 = 6.62607015e-34;
    const LIGHT: f64 = 2.99792458e8;
    const BOLTZMANN: f64 = 1.380649e-23;
    let Some(temperature) = reader.float("temperature")? else {
        return Err(reader.error("temperature", "the black body has no “temperature”"));
    };
    if temperature <= 0.0 {
        let message = format!("a temperature of {temperature} K is not above absolute zero");
        return Err(reader.error("temperature", message));
    }
    let [first, last] = range(reader, Some(VISIBLE))?;
    let (first, last) = (first.max(VISIBLE[0]), last.min(VISIBLE[1]));
    let radiance = |nanometres: f64| {
        let wavelength = nanometres * 1e-9;
        let exponent = PLANCK * LIGHT / (wavelength * BOLTZMANN * temperature);
        1e-9 * 2.0 * PLANCK * LIGHT * LIGHT / Real::powi(wavelength, 5) / Real::exp_m1(exponent)
    };
    let count = ((last - first) / STEP).ceil().max(1.0) as u32;
    let wavelength = |i| first + (last - first) * f64::from(i) / f64::from(count);
    let samples = (0..=count).map(|i| (wavelength(i), radiance(wavelength(i))));
    increasing(samples.collect()).map_err(|message| reader.error("wavelength_min", message))
}

/// `wavelength_min` and `wavelength_max` in nm, the first below the second; `lambda_min` and `lambda_max` in older files.
fn range(reader: &mut PluginReader<'_>, default: Option<[f64; 2]>) -> Result<[f64; 2], SceneError> {
    let mut ends = [0.0; 2];
    let names = [("wavelength_min", "lambda_min"), ("wavelength_max", "lambda_max")];
    for (axis, (name, old)) in names.into_iter().enumerate() {
        let given = reader.float(name)?.or(reader.float(old)?);
        ends[axis] = match (given, default) {
            (Some(wavelength), _) => wavelength,
            (None, Some(default)) => default[axis],
            (None, None) => {
                return Err(reader.error(name, format!("{} has no “{name}”", reader.title())));
            }
        };
    }
    if ends[0] < ends[1] {
        Ok(ends)
    } else {
        let message = format!("no wavelength is above {} and below {}", ends[0], ends[1]);
        Err(reader.error("wavelength_max", message))
    }
}

/// The numbers of a string.
fn list(reader: &mut PluginReader<'_>, name: &'static str) -> Result<Vec<f64>, SceneError> {
    match reader.numbers(name)? {
        Some(numbers) => Ok(numbers),
        None => Err(reader.error(name, format!("{} has no “{name}”", reader.title()))),
    }
}
