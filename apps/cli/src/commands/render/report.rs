//! What a finished render says about itself.

use etendue_math::Spectrum;
use etendue_renderer::progressive::{CONFIDENCE, ImageError, factor_for_half};
use etendue_scene::Scene;
use serde_json::{Value, json};

use super::Arguments;
use super::defects::Defects;
use super::draw::{Drawing, Whole};
use crate::figures::{error_in_percent, seconds};
use crate::memory::peak_resident_bytes;
use crate::output::{Metadata, Output};

pub(super) struct Report<'a> {
    pub(super) render_seconds: f64,
    pub(super) build_seconds: f64,
    pub(super) drawing: &'a Drawing,
    pub(super) defects: &'a Defects<'a>,
}

impl Report<'_> {
    pub(super) fn non_finite(&self) -> u64 {
        self.drawing.statistics.non_finite.count()
    }

    /// Pixels whose sums of samples went beyond single precision.
    pub(super) fn overflowed(&self) -> usize {
        let pixels = self.drawing.image.pixels().iter();
        pixels.filter(|pixel| !pixel.is_finite()).count()
    }

    /// Whether any sample or pixel is no light.
    pub(super) fn is_unhealthy(&self) -> bool {
        self.non_finite() > 0 || self.negative() > 0 || self.overflowed() > 0
    }

    pub(super) fn warn_of_overflow(&self) {
        let count = self.overflowed();
        if count > 0 {
            eprintln!(
                "etendue: warning: {count} pixels are brighter than single precision can hold; dim all lights alike"
            );
        }
    }

    fn mrays_per_second(&self) -> f64 {
        self.drawing.statistics.rays.total() as f64 / self.render_seconds.max(1e-9) / 1e6
    }

    /// Samples per pixel that were drawn, in the mean over the picture.
    fn samples_per_pixel(&self) -> f64 {
        let pixels = self.drawing.image.pixels().len();
        self.drawing.statistics.samples as f64 / pixels.max(1) as f64
    }

    fn error(&self) -> Option<ImageError> {
        self.drawing.accuracy.as_ref()?.error
    }

    /// By how much longer the render would have to take for half of its error.
    fn factor_for_half(&self) -> Option<f64> {
        let accuracy = self.drawing.accuracy.as_ref()?;
        let error = accuracy.error?;
        (error.estimate > 0.0 && error.estimate.is_finite())
            .then(|| factor_for_half(&accuracy.rounds))
    }

    pub(super) fn metadata(&self, arguments: &Arguments, scene: &Scene) -> Metadata {
        let sampling = scene.sampling;
        let progressive = self.drawing.accuracy.is_some();
        Metadata {
            scene: arguments.scene.scene.display().to_string(),
            samples_per_pixel: if progressive {
                self.samples_per_pixel()
            } else {
                f64::from(sampling.samples_per_pixel)
            },
            statistics: self.drawing.statistics.clone(),
            seed: sampling.seed,
            seconds: self.render_seconds,
            sources: [
                ("etendue.non_finite_from", self.defects.non_finite.shares()),
                ("etendue.negative_from", self.defects.negative.shares()),
                ("etendue.cut_from", self.defects.cut.clone()),
            ]
            .into_iter()
            .filter(|(_, shares)| !shares.is_empty())
            .map(|(name, shares)| (name, shares.to_string()))
            .collect(),
            configuration: self.drawing.configuration.name().to_owned(),
            error: self.error(),
            part: None,
        }
    }

    /// Samples with less than no light.
    fn negative(&self) -> u64 {
        self.drawing.statistics.negative.count()
    }

    pub(super) fn warn_of_bad_samples(&self, seed: u64) {
        let Defects { non_finite, negative, .. } = &self.defects;
        negative.warn(
            "found less than no light, which is a defect of étendue; please report it with the scene",
            seed,
        );
        non_finite.warn("were NaN or infinite and were left out", seed);
    }

    pub(super) fn summary(&self, output: &Output) -> String {
        let statistics = &self.drawing.statistics;
        let memory = peak_resident_bytes()
            .map_or(String::new(), |bytes| format!(", {} MiB at most", bytes >> 20));
        let cut = match self.drawing.whole {
            Whole::Yes => "",
            Whole::WithFewerSamples => " (interrupted)",
            Whole::BlackInParts => " (interrupted: parts are black)",
        };
        let error = self.error().map_or(String::new(), |error| {
            let half = self.factor_for_half().map_or(String::new(), |factor| {
                let longer = seconds(factor * self.render_seconds);
                format!("; half of it would take {factor:.1} × = {longer}")
            });
            format!("\netendue: {}{half}", error_in_percent(&error))
        });
        let rays = statistics.rays;
        let ended = if rays.cut == 0 {
            String::new()
        } else {
            let cut = &self.defects.cut;
            let from = if cut.is_empty() { String::new() } else { format!(" ({cut})") };
            format!(
                "; {:.3} % of the paths had the largest number of edges, with {:.3} % of what the camera's rays carry{from}",
                100.0 * rays.cut as f64 / statistics.samples.max(1) as f64,
                100.0 * rays.cut_share(statistics.samples),
            )
        };
        format!(
            "{} in {:.2} s ({:.2} s to load and build), configuration {}, {} samples, {} rays, {:.1} Mrays/s{memory}{ended}{cut}{error}",
            output.path().display(),
            self.render_seconds,
            self.build_seconds,
            self.drawing.configuration.name(),
            statistics.samples,
            statistics.rays.total(),
            self.mrays_per_second(),
        )
    }

    pub(super) fn json(&self) -> Value {
        let statistics = &self.drawing.statistics;
        let factor = self.factor_for_half();
        json!({
            "configuration": self.drawing.configuration.name(),
            "render_seconds": self.render_seconds,
            "cpu_seconds": self.drawing.processor_seconds,
            "build_seconds": self.build_seconds,
            "load_seconds": self.build_seconds,
            "samples": statistics.samples,
            "samples_per_pixel": self.samples_per_pixel(),
            "rays": statistics.rays.total(),
            "mrays_per_second": self.mrays_per_second(),
            "peak_rss": peak_resident_bytes(),
            "non_finite": self.non_finite(),
            "first_non_finite": self.defects.non_finite.json(),
            "non_finite_from": self.defects.non_finite.shares().json(),
            "negative": self.negative(),
            "first_negative": self.defects.negative.json(),
            "negative_from": self.defects.negative.shares().json(),
            "cut_paths": statistics.rays.cut,
            "cut_throughput": statistics.rays.cut_share(statistics.samples),
            "cut_from": self.defects.cut.json(),
            "complete": self.drawing.whole == Whole::Yes,
            "error": self.error().map(|error| json!({
                "estimate": error.estimate,
                "lower": error.lower,
                "upper": error.upper,
                "confidence": CONFIDENCE,
            })),
            "half_error": factor.map(|factor| json!({
                "factor": factor,
                "render_seconds": factor * self.render_seconds,
            })),
        })
    }
}
