//! One pixel of a render with a pilot.

use etendue_math::Spectrum;
use etendue_scene::Color;

use crate::film::PixelSum;

/// Runs of consecutive samples whose means are compared.
const RUNS: u32 = 4;

/// What the first samples of a pixel say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Pilot {
    /// Their mean.
    pub(super) mean: Color,
    /// The variance of the mean.
    pub(super) variance: Color,
    /// That of what paths find up to their first vertex that scatters, light samples there included.
    pub(super) first_variance: Color,
    /// Rays per sample, up to there and from there on.
    pub(super) rays: [f32; 2],
}

/// The sum of a pixel's samples so far, and what the first ones say.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PilotPixel {
    sum: PixelSum,
    drawn: u32,
    pilot: Pilot,
}

impl PilotPixel {
    /// Samples drawn, non-finite ones included.
    pub(super) fn drawn(&self) -> u32 {
        self.drawn
    }

    /// Mean of the samples that count.
    pub(super) fn mean(&self) -> Color {
        self.sum.mean()
    }

    pub(super) fn pilot(&self) -> Pilot {
        self.pilot
    }

    /// Begins to add the samples that are missing to `end`. The first that are ever added are the pilot.
    pub(super) fn extend(self, end: u32) -> Extension {
        let runs = (self.drawn == 0).then(|| Runs::of(end));
        Extension { end: end.max(self.drawn), pixel: self, runs }
    }
}

/// A pixel to which samples are being added.
pub(super) struct Extension {
    pixel: PilotPixel,
    end: u32,
    runs: Option<Runs>,
}

/// Means of runs of equally many samples:
///
/// ```text
/// variance of the mean of all ≈ Σ (mᵣ − m)² / (R (R − 1))
/// ```
///
/// Unlike single samples, runs know that Sobol' points are even.
struct Runs {
    length: u32,
    left: u32,
    count: u32,
    all: Moments,
    first: Moments,
    rays: [u64; 2],
}

/// Of one kind of light.
#[derive(Default)]
struct Moments {
    present: PixelSum,
    sum: Color,
    squares: Color,
}

impl Moments {
    fn end_run(&mut self) {
        let mean = core::mem::take(&mut self.present).mean();
        self.sum += mean;
        self.squares += mean * mean;
    }

    /// Mean, and variance of the mean.
    fn of(&self, runs: f32) -> [Color; 2] {
        let mean = self.sum.scale(1.0 / runs.max(1.0));
        if runs < 2.0 {
            return [mean, Color::black()];
        }
        let (squares, means) = (self.squares.to_array(), mean.to_array());
        // Cancellation may leave less than nothing.
        let variance = core::array::from_fn::<f32, 3, _>(|i| {
            ((squares[i] / runs - means[i] * means[i]) / (runs - 1.0)).max(0.0)
        });
        [mean, variance.into()]
    }
}

impl Runs {
    fn of(samples: u32) -> Self {
        let length = (samples / RUNS).max(1);
        let (all, first) = (Moments::default(), Moments::default());
        Self { length, left: length, count: 0, all, first, rays: [0; 2] }
    }

    fn add(&mut self, all: Color, first: Color) {
        // What is not finite is reported by who adds it to the pixel.
        let _ = self.all.present.add(all);
        let _ = self.first.present.add(first);
        self.left -= 1;
        if self.left == 0 {
            self.all.end_run();
            self.first.end_run();
            (self.count, self.left) = (self.count + 1, self.length);
        }
    }

    fn pilot(&self) -> Pilot {
        let runs = self.count as f32;
        let [mean, variance] = self.all.of(runs);
        let [_, first_variance] = self.first.of(runs);
        let samples = (self.count * self.length).max(1) as f32;
        Pilot { mean, variance, first_variance, rays: self.rays.map(|rays| rays as f32 / samples) }
    }
}

impl Extension {
    /// Samples drawn once all have been added.
    pub(super) fn end(&self) -> u32 {
        self.end
    }

    /// Takes account of the rays that a sample cost, up to its first vertex that scatters and from there on.
    #[inline]
    pub(super) fn spend(&mut self, rays: [u64; 2]) {
        if let Some(runs) = &mut self.runs {
            for (sum, rays) in runs.rays.iter_mut().zip(rays) {
                *sum += rays;
            }
        }
    }

    /// Adds one sample, of which the path had found `first` at its first vertex that scatters, and says whether it counts.
    #[inline]
    #[must_use = "a sample that was left out has to be reported"]
    pub(super) fn add(&mut self, all: Color, first: Color) -> bool {
        if let Some(runs) = &mut self.runs {
            runs.add(all, first);
        }
        self.pixel.sum.add(all)
    }

    /// The pixel with all samples.
    pub(super) fn finish(mut self) -> PilotPixel {
        self.pixel.drawn = self.end;
        if let Some(runs) = self.runs {
            self.pixel.pilot = runs.pilot();
        }
        self.pixel
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn extended(pixel: &mut PilotPixel, values: &[f32]) {
        let end = pixel.drawn() + values.len() as u32;
        let mut extension = pixel.extend(end);
        for &value in values {
            let counts = extension.add(Color::splat(value), Color::black());
            assert_eq!(counts, value.is_finite());
            extension.spend([1, 2]);
        }
        *pixel = extension.finish();
    }

    #[test]
    fn the_first_samples_are_the_pilot_and_all_are_the_mean() {
        let mut pixel = PilotPixel::default();
        extended(&mut pixel, &[1.0, 3.0, 2.0, 4.0, 3.0, 5.0, 4.0, 6.0]);
        // Runs of 2, 3, 4 and 5: their mean has the variance (1.5² + 0.5² + 0.5² + 1.5²) / (4 · 3).
        let pilot = Pilot {
            mean: Color::splat(3.5),
            variance: Color::splat(5.0 / 12.0),
            ..Pilot::default()
        };
        assert!((pixel.pilot().variance.r - pilot.variance.r).abs() < 1e-6, "a few roundings");
        assert_eq!((pixel.pilot().mean, pixel.pilot().rays), (pilot.mean, [1.0, 2.0]));
        extended(&mut pixel, &[8.0, f32::NAN]);
        assert_eq!((pixel.drawn(), pixel.mean()), (10, Color::splat(4.0)));
        assert_eq!(pixel.pilot().mean, pilot.mean);
    }

    #[test]
    fn less_than_two_runs_have_no_variance() {
        let mut pixel = PilotPixel::default();
        extended(&mut pixel, &[7.0]);
        assert_eq!(
            (pixel.pilot().mean, pixel.pilot().variance),
            (Color::splat(7.0), Color::black())
        );
    }
}
