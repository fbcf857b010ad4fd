//! Samplers.

use alloc::format;

use super::reader::PluginReader;
use super::{Context, Family};
use crate::SceneError;
use crate::scene::{SamplerKind, SamplingSettings};
use crate::xml::Kind;

/// The samplers there are. All those whose points are spread evenly are our Sobol' points.
const SAMPLERS: &Family<SamplingSettings> = &[
    ("halton", even),
    ("hammersley", even),
    ("independent", independent),
    ("ldsampler", even),
    ("multijitter", even),
    ("orthogonal", even),
    ("sobol", even),
    ("stratified", even),
];

/// The sampler of a sensor: the one inside its plugin, or Mitsuba's default.
pub(super) fn of<'a>(
    reader: &mut PluginReader<'a>,
    context: &mut Context<'a>,
) -> Result<SamplingSettings, SceneError> {
    let settings = match reader.child(Kind::Sampler, context)? {
        Some(child) => context.translate(SAMPLERS, context.description.node(child.node))?,
        None => SamplingSettings { samples_per_pixel: 4, ..SamplingSettings::default() },
    };
    Ok(with_overrides(settings, context))
}

/// The settings with what the caller asks for instead.
pub(super) fn with_overrides(
    settings: SamplingSettings,
    context: &Context<'_>,
) -> SamplingSettings {
    let options = context.options;
    SamplingSettings {
        sampler: options.sampler.unwrap_or(settings.sampler),
        samples_per_pixel: options.samples_per_pixel.unwrap_or(settings.samples_per_pixel),
        seed: options.seed.unwrap_or(settings.seed),
    }
}

fn independent<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<SamplingSettings, SceneError> {
    settings(reader, SamplerKind::Independent)
}

fn even<'a>(
    reader: &mut PluginReader<'a>,
    _: &mut Context<'a>,
) -> Result<SamplingSettings, SceneError> {
    // How other point sets are made.
    reader.ignore(&["dimension", "jitter", "scramble", "strength"]);
    settings(reader, SamplerKind::Sobol)
}

/// `sample_count` (4), `seed` (0).
fn settings(
    reader: &mut PluginReader<'_>,
    sampler: SamplerKind,
) -> Result<SamplingSettings, SceneError> {
    let count = reader.integer("sample_count")?.unwrap_or(4);
    let samples_per_pixel = match u32::try_from(count) {
        Ok(n) if n > 0 => n,
        _ => {
            let message = format!("“sample_count” must be from 1 to {}, not {count}", u32::MAX);
            return Err(reader.error("sample_count", message));
        }
    };
    let seed = reader.integer("seed")?.unwrap_or(0) as u64;
    Ok(SamplingSettings { sampler, samples_per_pixel, seed })
}
