//! How many samples the pixels are worth.

use etendue_math::Real;

use super::pixel::Pilot;

/// No pixel gets more than this many times the mean.
const MOST: f32 = 16.0;

/// Square of a tenth of white: what is darker counts as if it were not.
const DARK: f32 = 0.01;

/// Samples go in proportion to this power of the relative variance per ray. The best one for a known variance would be ½ (Neyman); that
/// of a pilot is a guess with a spread of its own.
const POWER: f32 = 0.4;

/// How many times less error the pilot has to promise. It promises too much, by the spread of its guesses: 1.4 where the
/// error is the same everywhere.
const WORTHWHILE: f32 = 1.6;

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
    worth: Vec<f32>,
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
                rays += weight * pilot.rays;
                for (sum, c) in mean.iter_mut().zip(pilot.mean.to_array()) {
                    *sum += weight * c;
                }
                for (sum, c) in variance.iter_mut().zip(pilot.variance.to_array()) {
                    *sum += weight * c;
                }
            }
            let relative = |(variance, mean): (f32, f32)| {
                let (variance, mean) = (variance / weights, mean / weights);
                variance / (mean * mean + DARK)
            };
            let sum: f32 = variance.into_iter().zip(mean).map(relative).sum();
            // A film of one pixel has no neighbours.
            let worth = sum / 3.0 / (rays / weights).max(1.0);
            if worth.is_finite() { worth } else { 0.0 }
        };
        let worth =
            (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| guided(x, y));
        Self { width: width as usize, worth: worth.collect() }
    }

    /// The number of samples of every pixel, `mean` of them in the mean over the picture and at least `least`.
    pub(super) fn samples(&self, least: u32, mean: u32) -> Vec<u32> {
        let mut samples = vec![mean; self.worth.len()];
        if least >= mean {
            return samples;
        }
        for colour in [0, 1] {
            let pixels: Vec<usize> =
                (0..samples.len()).filter(|&i| self.colour(i) == colour).collect();
            let worth: Vec<f32> = pixels.iter().map(|&i| self.worth[i]).collect();
            if let Some(shares) = shares(&worth) {
                let counts = counts(&shares, least, mean);
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

/// What the pixels are worth, with a mean of 1; `None` where all may as well get the same.
fn shares(variances: &[f32]) -> Option<Vec<f32>> {
    let mean = |values: &mut dyn Iterator<Item = f32>| {
        values.map(f64::from).sum::<f64>() as f32 / variances.len() as f32
    };
    let variance = mean(&mut variances.iter().copied());
    if !(variance > 0.0 && variance.is_finite()) {
        return None;
    }
    let root = mean(&mut variances.iter().map(|v| v.safe_sqrt()));
    if variance / (root * root) < WORTHWHILE {
        return None;
    }
    // Where the pilot saw no difference at all there may be one.
    let worth = |v: f32| Real::powf(v / variance + 1e-3, POWER);
    let total = mean(&mut variances.iter().map(|&v| worth(v)));
    Some(variances.iter().map(|&v| worth(v) / total).collect())
}

/// `k · share` of each, within bounds, with the `k` that spends the budget.
fn counts(shares: &[f32], least: u32, mean: u32) -> Vec<u32> {
    let most = (mean as f32 * MOST).min(u32::MAX as f32 / 2.0);
    let count = |share: f32, k: f32| (share * k).clamp(least as f32, most) as u32;
    let budget = u64::from(mean) * shares.len() as u64;
    let cost = |k: f32| shares.iter().map(|&share| u64::from(count(share, k))).sum::<u64>();
    let (mut affordable, mut excessive) = (0.0_f32, most / 1e-3);
    // Halving finds the last bit of an f32 between two numbers of about one size.
    for _ in 0..48 {
        let middle = 0.5 * (affordable + excessive);
        if cost(middle) <= budget { affordable = middle } else { excessive = middle }
    }
    shares.iter().map(|&share| count(share, affordable)).collect()
}

#[cfg(test)]
mod tests {
    use etendue_scene::Color;

    use super::*;

    const SIZE: [u32; 2] = [40, 30];

    /// A picture whose left half varies `ratio` times as much (in σ) as the right one.
    fn halves(ratio: f32) -> Vec<Pilot> {
        (0..SIZE[0] * SIZE[1])
            .map(|i| Pilot {
                mean: Color::splat(1.0),
                variance: Color::splat(if i % SIZE[0] < 20 { ratio * ratio } else { 1.0 }),
                rays: 4.0,
            })
            .collect()
    }

    #[test]
    fn samples_go_where_the_variance_is_and_spend_the_budget() {
        let samples = Guide::new(SIZE, &halves(8.0)).samples(16, 64);
        let total: u64 = samples.iter().map(|&n| u64::from(n)).sum();
        // Each count is rounded down.
        assert!((total as f64 / (64.0 * 1200.0) - 1.0).abs() < 1.0 / 64.0, "{total}");
        let (left, right) = (samples[10 * 40 + 5], samples[10 * 40 + 35]);
        // 64^0.4 = 5.3, but for the floor under what has no variance.
        let ratio = left as f32 / right as f32;
        assert!((4.8..5.5).contains(&ratio), "{left} {right}");
    }

    #[test]
    fn an_even_picture_gets_the_same_everywhere() {
        for ratio in [1.0, 2.0] {
            let samples = Guide::new(SIZE, &halves(ratio)).samples(16, 64);
            assert!(samples.iter().all(|&n| n == 64), "{ratio}");
        }
        let black = vec![Pilot::default(); 1200];
        assert!(Guide::new(SIZE, &black).samples(16, 64).iter().all(|&n| n == 64));
    }

    #[test]
    fn a_pixel_does_not_guide_its_own_colour() {
        let plain = halves(8.0);
        let changed = |pixel: usize| {
            let mut pilots = plain.clone();
            pilots[pixel].variance = Color::splat(1e4);
            Guide::new(SIZE, &pilots).samples(16, 64)
        };
        let before = Guide::new(SIZE, &plain).samples(16, 64);
        let pixel = 12 * 40 + 30;
        let after = changed(pixel);
        assert_eq!(after[pixel], before[pixel]);
        assert_eq!(after[pixel + 2], before[pixel + 2]);
        assert!(after[pixel + 1] > before[pixel + 1]);
    }

    #[test]
    fn few_samples_are_all_pilot() {
        assert_eq!([1, 31, 32, 64, 100, 1 << 20].map(pilot_samples), [1, 31, 8, 16, 16, 1 << 18]);
        let samples = Guide::new(SIZE, &halves(8.0)).samples(31, 31);
        assert!(samples.iter().all(|&n| n == 31));
    }

    #[test]
    fn a_single_pixel_and_infinite_variances_do_no_harm() {
        let one = [Pilot { mean: Color::splat(1.0), variance: Color::splat(2.0), rays: 1.0 }];
        assert_eq!(Guide::new([1, 1], &one).samples(16, 64), [64]);
        let mut pilots = halves(8.0);
        pilots[7].variance = Color::splat(f32::INFINITY);
        assert_eq!(Guide::new(SIZE, &pilots).samples(16, 64).len(), 1200);
    }
}
