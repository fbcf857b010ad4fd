//! How fast a picture converges, judged by its rounds.

use etendue_math::Real;

use super::image_error::ImageError;
use super::schedule::UNIFORM;

/// The picture after a round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    /// Samples per pixel so far, in the mean over the picture.
    pub samples_per_pixel: f64,
    /// The error of the picture.
    pub error: ImageError,
}

/// The power of the number of samples with which the error of independent samples falls.
const INDEPENDENT: f64 = 0.5;

/// Over how many times the samples an exponent is measured.
const SPAN: f64 = 8.0;

/// Standard error of an exponent with which it still says more than the one of independent samples:
/// a tenth of it, which is 15 % of the factor it predicts.
const RESOLUTION: f64 = 0.05;

/// `s` in ε ∝ samples⁻ˢ: measured where the rounds allow it, ½ otherwise.
///
/// The exponent is the slope of ln ε̂ over the logarithm of the samples, by least squares over the rounds
/// since an eighth of the samples, after those in which all pixels got the same. It is ½ at least, as
/// of independent samples, and measured where its standard error is below 0.05,
///
/// ```text
/// √(2/ν) / ln 8
/// ```
///
/// with the degrees of freedom ν of the last error: the slope between two independent ends. (Errors of
/// different rounds are correlated, which only makes it better.)
pub fn exponent(rounds: &[Round]) -> f64 {
    let Some(last) = rounds.last() else { return INDEPENDENT };
    let begin = last.samples_per_pixel / SPAN;
    // Where the first rounds do not reach back far enough nothing can be measured; rounds hit the
    // budget to a 64th of a level.
    let resolution = Real::sqrt(2.0 / last.error.degrees_of_freedom) / Real::ln(SPAN);
    if begin < UNIFORM * 0.99 || resolution > RESOLUTION {
        return INDEPENDENT;
    }
    let points: Vec<[f64; 2]> = rounds
        .iter()
        .filter(|round| round.samples_per_pixel >= begin * 0.99 && round.error.estimate > 0.0)
        .map(|round| [round.samples_per_pixel, round.error.estimate].map(Real::ln))
        .collect();
    let slope = slope(&points);
    if slope.is_finite() { (-slope).max(INDEPENDENT) } else { INDEPENDENT }
}

/// The factor by which the samples, and so the time, have to grow for the error to be halved: `2^(1/s)`,
/// 4 for independent samples.
pub fn factor_for_half(rounds: &[Round]) -> f64 {
    Real::powf(2.0, 1.0 / exponent(rounds))
}

/// Slope of the line of least squares; not finite for less than two different abscissae.
fn slope(points: &[[f64; 2]]) -> f64 {
    let mean = |axis: usize| points.iter().map(|p| p[axis]).sum::<f64>() / points.len() as f64;
    let [mean_x, mean_y] = [mean(0), mean(1)];
    let (mut products, mut squares) = (0.0, 0.0);
    for [x, y] in points {
        products += (x - mean_x) * (y - mean_y);
        squares += (x - mean_x) * (x - mean_x);
    }
    products / squares
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounds of twice the samples each whose error falls with a power.
    fn rounds(count: i32, exponent: f64, degrees_of_freedom: f64) -> Vec<Round> {
        (1..=count)
            .map(|i| {
                let samples_per_pixel = Real::powf(2.0, f64::from(i));
                let estimate = Real::powf(samples_per_pixel, -exponent);
                let error = ImageError { estimate, lower: 0.0, upper: 1.0, degrees_of_freedom };
                Round { samples_per_pixel, error }
            })
            .collect()
    }

    #[test]
    fn the_exponent_of_a_power_is_found() {
        let sobol = rounds(9, 0.75, 2000.0);
        // Logarithms of a handful of numbers, rounded.
        assert!((exponent(&sobol) - 0.75).abs() < 1e-12);
        assert!((factor_for_half(&sobol) - Real::powf(2.0, 4.0 / 3.0)).abs() < 1e-11);
    }

    #[test]
    fn without_evidence_samples_count_as_independent() {
        for unsure in [rounds(0, 1.0, 1e4), rounds(6, 1.0, 1e4), rounds(9, 1.0, 100.0)] {
            assert_eq!((exponent(&unsure), factor_for_half(&unsure)), (0.5, 4.0));
        }
        assert_eq!(exponent(&rounds(9, 0.3, 1e4)), 0.5);
    }

    #[test]
    fn a_picture_without_error_needs_no_slope() {
        let mut exact = rounds(9, 0.75, f64::INFINITY);
        for round in &mut exact {
            round.error.estimate = 0.0;
        }
        assert_eq!(exponent(&exact), 0.5);
    }
}
