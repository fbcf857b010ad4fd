//! How many samples the pixels are worth.

use etendue_math::Real;
use etendue_scene::Color;

use super::pixel::{Pilot, relative};

/// No pixel gets more than this many times the mean, or than this number.
const MOST: u32 = 16;
const MOST_OF_ALL: u32 = 1 << 31;

/// Samples go in proportion to this power of the relative variance per ray. The best one for a known variance would be ½ (Neyman); that
/// of a pilot is a guess with a spread of its own.
const POWER: f32 = 0.4;

/// How many times less error the pilot has to promise at equal cost. It promises too much, by the spread of its guesses: 1.4
/// where the error is the same everywhere, 2 where few paths find most of the light.
const WORTHWHILE: f32 = 2.5;

/// Pixels to either side of a pixel that guide it, and the square of the standard deviation of their weights.
const REACH: i32 = 2;
const SPREAD: f32 = 1.0;

/// Samples that every pixel gets before any is preferred: the power of two at or below a quarter of the mean. All where
/// that would be fewer than 8.
pub(super) fn pilot_samples(mean: u32) -> u32 {
    if mean < 32 { mean } else { 1 << (mean / 4).ilog2() }
}

/// What a sample of every pixel is worth, as the neighbours of the other colour on a chessboard know it: the relative variance
/// of the pixel per ray of a sample.
///
/// ```text
/// v(p) = mean over channels of  Σ w var(q) / (r² + 0.01),   r = Σ w mean(q),   c(p) = Σ w rays(q)
/// ```
///
/// with Gaussian weights over the neighbours q, of sum 1.
pub(super) struct Guide {
    width: usize,
    worth: Vec<Worth>,
}

/// Relative squared error of the pilot, and rays per sample.
#[derive(Clone, Copy, Debug, Default)]
struct Worth {
    error: f32,
    rays: f32,
}

impl Guide {
    /// * `pilots`: row by row.
    pub(super) fn new(size: [u32; 2], pilots: &[Pilot]) -> Self {
        let [width, height] = size.map(|n| n as i32);
        let at = |x: i32, y: i32| {
            let inside = (0..width).contains(&x) && (0..height).contains(&y);
            inside.then(|| &pilots[(y * width + x) as usize])
        };
        let guided = |x: i32, y: i32| {
            let (mut weights, mut rays, mut mean, mut variance) = (0.0, 0.0, [0.0; 3], [0.0; 3]);
            for (dx, dy) in neighbours() {
                let Some(pilot) = at(x + dx, y + dy) else { continue };
                let weight = Real::exp(-((dx * dx + dy * dy) as f32) / (2.0 * SPREAD));
                weights += weight;
                rays += weight * pilot.rays.iter().sum::<f32>();
                for (sum, c) in mean.iter_mut().zip(pilot.mean.to_array()) {
                    *sum += weight * c;
                }
                for (sum, c) in variance.iter_mut().zip(pilot.variance.to_array()) {
                    *sum += weight * c;
                }
            }
            let [variance, mean] =
                [variance, mean].map(|sums| Color::from(sums.map(|sum: f32| sum / weights)));
            let sum = relative(variance, mean);
            // A film of one pixel has no neighbours, and infinite ones say nothing.
            let (error, rays) = (sum / 3.0, (rays / weights).max(1.0));
            if (error * rays).is_finite() { Worth { error, rays } } else { Worth::default() }
        };
        let worth =
            (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| guided(x, y));
        Self { width: width as usize, worth: worth.collect() }
    }

    /// The number of samples of every pixel, at most `mean` of them in the mean over the picture and at least `least`.
    pub(super) fn samples(&self, least: u32, mean: u32) -> Vec<u32> {
        let mut samples = vec![mean; self.worth.len()];
        if least >= mean {
            return samples;
        }
        for colour in [0, 1] {
            let pixels: Vec<usize> =
                (0..samples.len()).filter(|&i| self.colour(i) == colour).collect();
            let worth: Vec<Worth> = pixels.iter().map(|&i| self.worth[i]).collect();
            let counts = counts(&worth, least, mean);
            if gain(&worth, &counts) > WORTHWHILE {
                for (&pixel, count) in pixels.iter().zip(counts) {
                    samples[pixel] = count;
                }
            }
        }
        samples
    }

    fn colour(&self, pixel: usize) -> usize {
        (pixel % self.width + pixel / self.width) % 2
    }
}

/// Offsets of the neighbours of the other colour.
fn neighbours() -> impl Iterator<Item = (i32, i32)> {
    (-REACH..=REACH)
        .flat_map(|dy| (-REACH..=REACH).map(move |dx| (dx, dy)))
        .filter(|(dx, dy)| (dx + dy) % 2 != 0)
}

/// A power of two for each pixel, in proportion to `(error / rays)^`[`POWER`] as nearly as that can be, with the largest factor
/// that stays within the budget.
fn counts(worth: &[Worth], least: u32, mean: u32) -> Vec<u32> {
    let per_ray = |w: &Worth| w.error / w.rays;
    let total: f64 = worth.iter().map(|w| f64::from(per_ray(w))).sum();
    let average = (total / worth.len() as f64) as f32;
    if !(average > 0.0 && average.is_finite()) {
        return vec![mean; worth.len()];
    }
    // Where the pilot saw no difference at all there may be one.
    let level = |w: &Worth| POWER * Real::ln(per_ray(w) / average + 1e-3) / core::f32::consts::LN_2;
    let levels: Vec<f32> = worth.iter().map(level).collect();
    let (lowest, highest) =
        (least.ilog2() as i32, mean.saturating_mul(MOST).min(MOST_OF_ALL).ilog2() as i32);
    let count =
        |level: f32, k: f32| 1_u32 << ((level + k + 0.5).floor() as i32).clamp(lowest, highest);
    let budget = u64::from(mean) * worth.len() as u64;
    let cost = |k: f32| levels.iter().map(|&level| u64::from(count(level, k))).sum::<u64>();
    let (mut affordable, mut excessive) = (-64.0_f32, 64.0);
    // Halving finds the last bits of an f32.
    for _ in 0..32 {
        let middle = 0.5 * (affordable + excessive);
        if cost(middle) <= budget { affordable = middle } else { excessive = middle }
    }
    levels.iter().map(|&level| count(level, affordable)).collect()
}

/// How many times less error times rays there is than with equally many samples everywhere.
///
/// ```text
/// Σ error · Σ rays / (Σ error/n · Σ rays n)
/// ```
fn gain(worth: &[Worth], counts: &[u32]) -> f32 {
    let mut sums = [0.0_f64; 4];
    for (worth, &count) in worth.iter().zip(counts) {
        let (error, rays, count) =
            (f64::from(worth.error), f64::from(worth.rays), f64::from(count));
        for (sum, term) in sums.iter_mut().zip([error, rays, error / count, rays * count]) {
            *sum += term;
        }
    }
    (sums[0] * sums[1] / (sums[2] * sums[3])) as f32
}

#[cfg(test)]
mod tests {
    use etendue_math::Spectrum;

    use super::*;

    const SIZE: [u32; 2] = [40, 30];

    /// A picture of which the four columns on the left vary `ratio` times as much (in σ) as the others.
    fn striped(ratio: f32) -> Vec<Pilot> {
        (0..SIZE[0] * SIZE[1])
            .map(|i| Pilot {
                mean: Color::splat(1.0),
                variance: Color::splat(if i % SIZE[0] < 4 { ratio * ratio } else { 1.0 }),
                rays: [2.0, 2.0, 0.0],
                ..Pilot::default()
            })
            .collect()
    }

    #[test]
    fn samples_go_where_the_variance_is_within_the_budget() {
        let samples = Guide::new(SIZE, &striped(32.0)).samples(16, 64);
        let total: u64 = samples.iter().map(|&n| u64::from(n)).sum();
        // Powers of two of a few kinds of pixels: up to half of the budget may be left.
        assert!((32 * 1200..=64 * 1200).contains(&total), "{total}");
        let (left, right) = (samples[10 * 40 + 1], samples[10 * 40 + 35]);
        // 1024^0.4 = 16, but for the floor under what has no variance and the bounds.
        assert!(left >= 8 * right, "{left} {right}");
        assert!(samples.iter().all(|n| n.is_power_of_two() && (16..=1024).contains(n)));
    }

    #[test]
    fn where_rays_cost_more_there_are_fewer_samples() {
        let mut pilots = striped(32.0);
        for pilot in pilots.iter_mut().filter(|pilot| pilot.variance.r > 1.0) {
            pilot.rays = [100.0, 400.0, 0.0];
        }
        let cheap = Guide::new(SIZE, &striped(32.0)).samples(16, 64);
        let dear = Guide::new(SIZE, &pilots).samples(16, 64);
        assert!(dear[10 * 40 + 1] < cheap[10 * 40 + 1]);
    }

    #[test]
    fn an_even_picture_gets_the_same_everywhere() {
        for ratio in [1.0, 3.0] {
            let samples = Guide::new(SIZE, &striped(ratio)).samples(16, 64);
            assert!(samples.iter().all(|&n| n == 64), "{ratio}");
        }
        let black = vec![Pilot::default(); 1200];
        assert!(Guide::new(SIZE, &black).samples(16, 64).iter().all(|&n| n == 64));
    }

    #[test]
    fn a_pixel_does_not_guide_its_own_colour() {
        let plain = striped(32.0);
        let before = Guide::new(SIZE, &plain);
        let pixel = 12 * 40 + 30;
        let mut pilots = plain;
        pilots[pixel].variance = Color::splat(1e5);
        let after = Guide::new(SIZE, &pilots);
        for (i, (a, b)) in before.worth.iter().zip(&after.worth).enumerate() {
            assert!(before.colour(i) != before.colour(pixel) || a.error == b.error);
        }
        assert!(after.worth[pixel + 1].error > before.worth[pixel + 1].error);
        // Nor does its colour as a whole, by the budget.
        let [before, after] = [before, after].map(|guide| guide.samples(16, 64));
        let same = |i: usize| (i % 40 + i / 40) % 2 == pixel % 2;
        assert!((0..1200).filter(|&i| same(i)).all(|i| before[i] == after[i]));
    }

    #[test]
    fn few_samples_are_all_pilot() {
        assert_eq!([1, 31, 32, 64, 100, 1 << 20].map(pilot_samples), [1, 31, 8, 16, 16, 1 << 18]);
        let samples = Guide::new(SIZE, &striped(32.0)).samples(31, 31);
        assert!(samples.iter().all(|&n| n == 31));
    }

    #[test]
    fn a_single_pixel_and_infinite_variances_do_no_harm() {
        let one =
            [Pilot { mean: Color::splat(1.0), variance: Color::splat(2.0), ..Pilot::default() }];
        assert_eq!(Guide::new([1, 1], &one).samples(16, 64), [64]);
        let mut pilots = striped(32.0);
        pilots[7].variance = Color::splat(f32::INFINITY);
        assert_eq!(Guide::new(SIZE, &pilots).samples(16, 64).len(), 1200);
    }
}
