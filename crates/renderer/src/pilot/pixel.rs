//! One pixel of a render with a pilot.

use etendue_math::Spectrum;
use etendue_scene::Color;

use crate::canvas::CanvasPixel;
use crate::codec::{Reader, StateError, Write as _};
use crate::film::PixelSum;

/// Runs of consecutive samples whose means are compared.
const RUNS: u32 = 4;

/// Square of a tenth of white: what is darker counts as if it were not.
const DARK: f32 = 0.01;

/// A variance relative to its mean, summed over the channels:
///
/// ```text
/// variance / (mean² + 0.01)
/// ```
pub(super) fn relative(variance: Color, mean: Color) -> f32 {
    let channels = variance.to_array().into_iter().zip(mean.to_array());
    channels.map(|(v, m)| v / (m * m + DARK)).sum()
}

/// What the first samples of a pixel say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Pilot {
    /// Their mean.
    pub(super) mean: Color,
    /// The variance of the mean.
    pub(super) variance: Color,
    /// Of what paths find up to their first vertex that scatters, light samples there included.
    pub(super) first: Spread,
    /// Of all that paths have found themselves and do not share.
    pub(super) own: Spread,
    /// Of what they were lent, and of what they would have without sharing.
    pub(super) lent: Spread,
    pub(super) alone: Spread,
    /// Rays per sample: up to the first vertex that scatters, from there on, and to share.
    pub(super) rays: [f32; 3],
}

/// How much a part of a pixel varies, [relative](relative) to the whole.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spread {
    /// Of the mean of all samples, from four runs of them.
    pub(super) of_all: f32,
    /// Of the mean of half of them, from the two halves.
    pub(super) of_half: f32,
}

/// What a sample has found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Find {
    /// By itself.
    pub(super) own: Color,
    /// By sharing.
    pub(super) lent: Color,
    /// Instead of that without sharing.
    pub(super) alone: Color,
    /// At the first vertex that scatters.
    pub(super) first: Color,
}

/// The sum of a pixel's samples so far, and what the first ones say.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

impl Pilot {
    /// Its numbers, in the order in which they are stored.
    fn numbers(&mut self) -> impl Iterator<Item = &mut f32> {
        let Self { mean, variance, first, own, lent, alone, rays } = self;
        let colors = [mean, variance].into_iter().flat_map(|c| [&mut c.r, &mut c.g, &mut c.b]);
        let spreads =
            [first, own, lent, alone].into_iter().flat_map(|s| [&mut s.of_all, &mut s.of_half]);
        colors.chain(spreads).chain(rays)
    }
}

impl CanvasPixel for PilotPixel {
    const BYTES: u64 = PixelSum::BYTES + 4 + 4 * (2 * 3 + 4 * 2 + 3);

    fn write(&self, bytes: &mut Vec<u8>) {
        self.sum.write(bytes);
        bytes.u32(self.drawn);
        let mut pilot = self.pilot;
        pilot.numbers().for_each(|number| bytes.f32(*number));
    }

    fn read(reader: &mut Reader<'_>) -> Result<Self, StateError> {
        let (sum, drawn) = (PixelSum::read(reader)?, reader.u32()?);
        if sum.count() > u64::from(drawn) {
            return Err(StateError::new("a pixel has more samples than were drawn"));
        }
        let mut pilot = Pilot::default();
        for number in pilot.numbers() {
            *number = reader.f32()?;
        }
        Ok(Self { sum, drawn, pilot })
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
    own: Moments,
    lent: Moments,
    alone: Moments,
    first: Moments,
    rays: [u64; 3],
}

/// Of one kind of light.
#[derive(Default)]
struct Moments {
    present: PixelSum,
    sum: Color,
    squares: Color,
    /// Of the first half of the runs.
    half: Color,
}

impl Moments {
    fn end_run(&mut self, run: u32) {
        let mean = core::mem::take(&mut self.present).mean();
        self.sum += mean;
        self.squares += mean * mean;
        if run == RUNS / 2 {
            self.half = self.sum;
        }
    }

    /// The mean of so many runs.
    fn mean(&self, runs: f32) -> Color {
        self.sum.scale(1.0 / runs.max(1.0))
    }

    /// Its variance.
    fn variance(&self, runs: f32) -> Color {
        if runs < 2.0 {
            return Color::black();
        }
        let (squares, means) = (self.squares.to_array(), self.mean(runs).to_array());
        // Cancellation may leave less than nothing.
        let variance =
            |i: usize| ((squares[i] / runs - means[i] * means[i]) / (runs - 1.0)).max(0.0);
        core::array::from_fn::<f32, 3, _>(variance).into()
    }

    /// How much it varies in a pixel whose mean is `pixel`.
    fn spread(&self, runs: f32, pixel: Color) -> Spread {
        // The halves have the means h and 2 m − h, and differ by 2 (h − m).
        let difference = self.half.scale(2.0 / runs.max(1.0)) + self.mean(runs).scale(-1.0);
        let of_half = (difference * difference).scale(if runs < 2.0 { 0.0 } else { 2.0 });
        Spread { of_all: relative(self.variance(runs), pixel), of_half: relative(of_half, pixel) }
    }
}

impl Runs {
    fn of(samples: u32) -> Self {
        let length = (samples / RUNS).max(1);
        let [all, own, lent, alone, first] = core::array::from_fn(|_| Moments::default());
        Self { length, left: length, count: 0, all, own, lent, alone, first, rays: [0; 3] }
    }

    fn add(&mut self, find: Find) {
        // What is not finite is reported by who adds it to the pixel.
        let _ = self.all.present.add(find.own + find.lent);
        let _ = self.own.present.add(find.own);
        let _ = self.lent.present.add(find.lent);
        let _ = self.alone.present.add(find.alone);
        let _ = self.first.present.add(find.first);
        self.left -= 1;
        if self.left == 0 {
            (self.count, self.left) = (self.count + 1, self.length);
            let Self { all, own, lent, alone, first, .. } = self;
            for moments in [all, own, lent, alone, first] {
                moments.end_run(self.count);
            }
        }
    }

    fn pilot(&self) -> Pilot {
        let runs = self.count as f32;
        let (mean, variance) = (self.all.mean(runs), self.all.variance(runs));
        let [first, own, lent, alone] = [&self.first, &self.own, &self.lent, &self.alone]
            .map(|moments| moments.spread(runs, mean));
        let samples = (self.count * self.length).max(1) as f32;
        let rays = self.rays.map(|rays| rays as f32 / samples);
        Pilot { mean, variance, first, own, lent, alone, rays }
    }
}

impl Extension {
    /// Samples drawn once all have been added.
    pub(super) fn end(&self) -> u32 {
        self.end
    }

    /// Takes account of the rays that a sample cost: up to its first vertex that scatters, from there on, and to share.
    #[inline]
    pub(super) fn spend(&mut self, rays: [u64; 3]) {
        if let Some(runs) = &mut self.runs {
            for (sum, rays) in runs.rays.iter_mut().zip(rays) {
                *sum += rays;
            }
        }
    }

    /// Adds one sample, and says whether it counts.
    #[inline]
    #[must_use = "a sample that was left out has to be reported"]
    pub(super) fn add(&mut self, find: Find) -> bool {
        if let Some(runs) = &mut self.runs {
            runs.add(find);
        }
        self.pixel.sum.add(find.own + find.lent)
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
            let own = Color::splat(value);
            let [lent, alone, first] = [Color::black(); 3];
            let find = Find { own, lent, alone, first };
            assert_eq!(extension.add(find), value.is_finite());
            extension.spend([1, 2, 3]);
        }
        *pixel = extension.finish();
    }

    #[test]
    fn the_first_samples_are_the_pilot_and_all_are_the_mean() {
        let mut pixel = PilotPixel::default();
        extended(&mut pixel, &[1.0, 3.0, 2.0, 4.0, 3.0, 5.0, 4.0, 6.0]);
        // Runs of 2, 3, 4 and 5:
        // (1.5² + 0.5² + 0.5² + 1.5²) / (4 · 3); halves of 2.5 and 4.5: 2² / 2.
        let pilot = pixel.pilot();
        let near = |a: f32, b: f32| (a / b - 1.0).abs() < 1e-6; // A few roundings.
        assert!(near(pilot.variance.r, 5.0 / 12.0));
        let white = 3.0 / (3.5 * 3.5 + DARK);
        assert!(near(pilot.own.of_all, 5.0 / 12.0 * white) && near(pilot.own.of_half, 2.0 * white));
        assert_eq!(pilot.lent, Spread::default());
        assert_eq!((pilot.mean, pilot.rays), (Color::splat(3.5), [1.0, 2.0, 3.0]));
        extended(&mut pixel, &[8.0, f32::NAN]);
        assert_eq!((pixel.drawn(), pixel.mean()), (10, Color::splat(4.0)));
        assert_eq!(pixel.pilot().mean, pilot.mean);
    }

    #[test]
    fn a_stored_pixel_comes_back_and_takes_as_many_bytes_as_is_said() {
        let mut pixel = PilotPixel::default();
        extended(&mut pixel, &[1.0, 3.0, 2.0, 4.0, 3.0, 5.0, 0.1, 6.0]);
        let mut bytes = Vec::new();
        pixel.write(&mut bytes);
        assert_eq!(bytes.len() as u64, PilotPixel::BYTES);
        assert_eq!(PilotPixel::read(&mut Reader::new(&bytes)), Ok(pixel));
        bytes[24] = 9; // samples that count, of 8
        assert!(PilotPixel::read(&mut Reader::new(&bytes)).is_err());
    }

    #[test]
    fn less_than_two_runs_have_no_variance() {
        let mut pixel = PilotPixel::default();
        extended(&mut pixel, &[7.0]);
        assert_eq!(pixel.pilot().mean, Color::splat(7.0));
        assert_eq!(
            (pixel.pilot().variance, pixel.pilot().own),
            (Color::black(), Spread::default())
        );
    }
}
