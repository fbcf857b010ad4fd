//! What all pictures of a variant say together.

use etendue_math::Real;

use super::errors::GROUPS;
use super::job::Record;

/// Pictures of one variant with one number of samples.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Samples per pixel.
    pub samples_per_pixel: u32,
    /// Median seconds of a picture.
    pub seconds: f64,
    /// Variance, as a share of relMSE.
    pub noise: f64,
    /// Squared bias and its standard error.
    pub bias: [f64; 2],
    /// Mean HDR-FLIP of a picture.
    pub flip: f64,
}

/// A variant.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Its levels, fewest samples first.
    pub levels: Vec<Level>,
    /// Squared bias and its standard error, of all levels together.
    pub bias: [f64; 2],
}

/// A bias counts from this many standard errors on: with some ten variants, none by chance.
const SIGNIFICANT: f64 = 4.0;
/// Squared relative bias that single precision leaves in a picture without noise: an ulp or two.
const ROUNDING: f64 = 1e-12;

impl Estimate {
    /// The estimate of the records of a variant, in any order; `None` for none.
    pub fn of<'a>(records: impl Iterator<Item = &'a Record>) -> Option<Self> {
        let mut records: Vec<&Record> = records.collect();
        records.sort_by_key(|record| (record.samples_per_pixel, record.pair));
        let levels: Vec<Level> = records
            .chunk_by(|a, b| a.samples_per_pixel == b.samples_per_pixel)
            .map(level)
            .collect();
        let bias = pooled(&levels)?;
        Some(Self { levels, bias })
    }

    /// What time does not pay back: the squared bias where it is significant, 0 elsewhere.
    pub fn floor(&self) -> f64 {
        let [bias, error] = self.bias;
        if bias > SIGNIFICANT * error && bias > ROUNDING { bias } else { 0.0 }
    }

    /// Seconds and relMSE of every level: its noise above the floor.
    pub fn errors(&self) -> Vec<[f64; 2]> {
        let floor = self.floor();
        self.levels.iter().map(|level| [level.seconds, level.noise + floor]).collect()
    }

    /// Seconds until relMSE is `error`.
    pub fn time_to(&self, error: f64) -> Reach {
        let errors = self.errors();
        let (Some(&[first, first_error]), Some(&[last, last_error])) =
            (errors.first(), errors.last())
        else {
            return Reach::Never;
        };
        if first_error <= error {
            return Reach::AtMost(first);
        }
        if let Some(pair) = errors.windows(2).find(|pair| pair[1][1] <= error) {
            let [[t0, e0], [t1, e1]] = [pair[0], pair[1]];
            let share = Real::ln(e0 / error) / Real::ln(e0 / e1);
            return Reach::Interpolated(t0 * Real::powf(t1 / t0, share));
        }
        let (noise, left) = (last_error - self.floor(), error - self.floor());
        if left > 0.0 { Reach::Extrapolated(last * noise / left) } else { Reach::Never }
    }
}

/// When an error is reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// Seconds, between two levels, on a line over logarithmic axes.
    Interpolated(f64),
    /// Seconds of the first level, which is better already.
    AtMost(f64),
    /// Seconds beyond the last level, noise falling as 1/t from there.
    Extrapolated(f64),
    /// The bias is larger.
    Never,
}

fn level(records: &[&Record]) -> Level {
    let n = records.len() as f64;
    let mut seconds: Vec<f64> = records.iter().flat_map(|r| r.seconds).collect();
    seconds.sort_by(f64::total_cmp);
    let middle = seconds.len() / 2;
    let median = if seconds.len() % 2 == 1 {
        seconds[middle]
    } else {
        f64::midpoint(seconds[middle - 1], seconds[middle])
    };
    // Groups differ in bias, but the scatter of one over the pairs is noise alone.
    let (mut bias, mut variance) = (0.0, 0.0);
    for group in 0..GROUPS {
        let values = || records.iter().map(|r| r.errors.bias[group]);
        let mean = values().sum::<f64>() / n;
        bias += mean;
        variance += values().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1.0) / n;
    }
    Level {
        samples_per_pixel: records[0].samples_per_pixel,
        seconds: median,
        noise: records.iter().map(|r| r.errors.noise).sum::<f64>() / n,
        bias: [bias, variance.sqrt()],
        flip: records.iter().map(|r| r.errors.flip).sum::<f64>() / n,
    }
}

/// Mean of the levels' biases by the inverse of their variances, and its standard error. Levels without any scatter are exact.
fn pooled(levels: &[Level]) -> Option<[f64; 2]> {
    let exact: Vec<f64> = levels.iter().filter(|l| l.bias[1] == 0.0).map(|l| l.bias[0]).collect();
    if !exact.is_empty() {
        return Some([exact.iter().sum::<f64>() / exact.len() as f64, 0.0]);
    }
    let weight = |level: &Level| 1.0 / (level.bias[1] * level.bias[1]);
    let total: f64 = levels.iter().map(weight).sum();
    let sum: f64 = levels.iter().map(|level| weight(level) * level.bias[0]).sum();
    (total > 0.0).then(|| [sum / total, 1.0 / total.sqrt()])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::errors::PairErrors;

    /// Records of a variant whose noise is 1/n and whose time is n, with the given bias in group 0.
    fn records(bias: f64, scatter: f64) -> Vec<Record> {
        let pair = |spp: u32, pair: u32| {
            let mut errors = PairErrors { noise: 1.0 / f64::from(spp), ..PairErrors::default() };
            let sign = if pair.is_multiple_of(2) { 1.0 } else { -1.0 };
            errors.bias[0] = bias + sign * scatter / f64::from(spp);
            let seconds = [f64::from(spp), f64::from(spp)];
            Record { variant: "v".to_owned(), samples_per_pixel: spp, pair, seconds, errors }
        };
        [1, 2, 4, 8].iter().flat_map(|&spp| (0..2).map(move |p| pair(spp, p))).collect()
    }

    #[test]
    fn times_are_interpolated_on_a_line_of_slope_minus_one_and_extrapolated_along_it() {
        let records = records(0.0, 0.1);
        let estimate = Estimate::of(records.iter()).expect("records");
        assert_eq!(estimate.floor(), 0.0);
        let Reach::Interpolated(t) = estimate.time_to(0.4) else { panic!("{estimate:?}") };
        // error · time = 1 exactly; two logarithms and a power.
        assert!((t - 2.5).abs() < 1e-12, "{t}");
        assert_eq!(estimate.time_to(1.0), Reach::AtMost(1.0));
        let Reach::Extrapolated(t) = estimate.time_to(0.01) else { panic!("{estimate:?}") };
        assert!((t - 100.0).abs() < 1e-10, "{t}");
    }

    #[test]
    fn a_bias_is_a_floor_that_time_does_not_get_below() {
        let records = records(0.05, 1e-3);
        let estimate = Estimate::of(records.iter()).expect("records");
        // Scatter of ±1e-3/n about the bias, which is the mean of every level.
        assert!((estimate.floor() - 0.05).abs() < 1e-15, "{estimate:?}");
        assert_eq!(estimate.time_to(0.05), Reach::Never);
        let Reach::Extrapolated(t) = estimate.time_to(0.06) else { panic!("{estimate:?}") };
        assert!((t - 100.0).abs() < 1e-9, "noise must be 0.01: {t}");
    }

    #[test]
    fn bias_within_its_error_is_none() {
        // Level n: mean b, standard error s/n of two values ±s/n. Pooled: 1/√Σ(n/s)² = s/√85.
        let estimate = Estimate::of(records(0.01, 0.1).iter()).expect("records");
        let [bias, error] = estimate.bias;
        assert!((bias - 0.01).abs() < 1e-15 && (error - 0.1 / 85_f64.sqrt()).abs() < 1e-15);
        assert_eq!(estimate.floor(), 0.0);
        assert!(Estimate::of([].iter()).is_none());
    }
}
