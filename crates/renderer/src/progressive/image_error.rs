//! How far a picture is from what it converges to, judged by its two halves.

use etendue_math::Real;

use crate::film::Image;

/// Confidence of the interval of an [`ImageError`].
pub const CONFIDENCE: f64 = 0.95;

/// The quantile of the normal distribution that leaves half of `1 − CONFIDENCE` above it.
const QUANTILE: f64 = 1.959_963_984_540_054;

/// The relative error of a picture that is the mean of two independent ones of the same expectation,
/// estimated from how far these are apart.
///
/// With the true picture μ, and means over all channels of all pixels, the *true* error of a picture
/// and its estimate are
///
/// ```text
/// ε = √mean(((a + b)/2 − μ)²) / mean(μ)          ε̂ = √mean(((a − b)/2)²) / mean((a + b)/2)
/// ```
///
/// With `a = μ + α`, `b = μ + β` the squares differ, pixel by pixel, by `αβ`: they have the same mean, and
/// the difference has the variance `E[α²] E[β²]`, which is at most `2 E[((α − β)/2)⁴]`, whatever the
/// distribution. With `q` the sum of `((a − b)/2)²` over the channels of a pixel this gives
///
/// ```text
/// ν = 2 (Σq)² / Σq²                               degrees of freedom
/// ε̂ e^±w,   w = z √(ν − 1 + λ) / (ν − 1),   λ = (z² − 3)/6
/// ```
///
/// the interval in which ε lies with a probability of at least [`CONFIDENCE`]: w is the quantile of
/// Fisher's z distribution with ν and ν degrees of freedom, that of ½ ln(ε²/ε̂²) for normal errors.
///
/// What the samples of neither half have found is not in the estimate: as every error bar, it supposes
/// that the samples have seen what the picture consists of.
///
/// # Edge cases
/// Equal halves have an error of 0, black pictures among them. A picture that differs from its other
/// half and whose mean is not positive has an infinite error. Channels that are not finite make it NaN;
/// the sums of a render are finite.
///
/// # Precision
/// The error of the mean in the denominator, `ε/√pixels`, is left out. Validated on pictures of
/// 360 pixels and more.
///
/// # Source
/// Two half buffers: Rousselle, Knaus, Zwicker, "Adaptive Rendering with Non-Local Means Filtering",
/// ACM TOG 31(6), 2012. The quantile: Abramowitz, Stegun, Handbook of Mathematical Functions, 26.5.22
/// and 26.6.16, for equal degrees of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImageError {
    /// ε̂, relative: 0.01 is 1 %.
    pub estimate: f64,
    /// Lower end of the interval.
    pub lower: f64,
    /// Upper end of the interval.
    pub upper: f64,
    /// ν, between 2 and twice the number of pixels; infinite where the halves are equal.
    pub degrees_of_freedom: f64,
}

impl ImageError {
    /// The error of the mean of two pictures, of which the smaller size counts.
    ///
    /// # Examples
    /// ```
    /// use etendue_renderer::{Image, progressive::ImageError};
    /// let half = |values: [f32; 2]| {
    ///     let pixels = values.map(|v| [v, v, v].into()).to_vec();
    ///     Image::from_pixels([2, 1], pixels).expect("two pixels")
    /// };
    /// let error = ImageError::between(&half([1.5, 1.0]), &half([0.5, 1.0]));
    /// // √((0.5² + 0²)/2) around a mean of 1.
    /// assert!((error.estimate - 0.125_f64.sqrt()).abs() < 1e-15);
    /// assert_eq!(error.degrees_of_freedom, 2.0);
    /// ```
    pub fn between(a: &Image, b: &Image) -> Self {
        let (mut squares, mut fourths, mut sum, mut channels) = (0.0, 0.0, 0.0, 0_u64);
        for (a, b) in a.pixels().iter().zip(b.pixels()) {
            let mut square = 0.0;
            for (a, b) in a.to_array().into_iter().zip(b.to_array()) {
                let (a, b) = (f64::from(a), f64::from(b));
                square += (0.5 * (a - b)).sqr();
                sum += 0.5 * (a + b);
                channels += 1;
            }
            squares += square;
            fourths += square.sqr();
        }
        if squares == 0.0 {
            return Self {
                estimate: 0.0,
                lower: 0.0,
                upper: 0.0,
                degrees_of_freedom: f64::INFINITY,
            };
        }
        let count = channels as f64;
        let estimate =
            if sum > 0.0 { (squares / count).sqrt() / (sum / count) } else { f64::INFINITY };
        let degrees_of_freedom = 2.0 * squares.sqr() / fourths;
        let factor = Real::exp(half_width(degrees_of_freedom));
        Self { estimate, lower: estimate / factor, upper: estimate * factor, degrees_of_freedom }
    }
}

/// w: half the width of the interval of a logarithm.
fn half_width(degrees_of_freedom: f64) -> f64 {
    const LAMBDA: f64 = (QUANTILE * QUANTILE - 3.0) / 6.0;
    let h = degrees_of_freedom - 1.0;
    QUANTILE * (h + LAMBDA).sqrt() / h
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(values: &[f32]) -> Image {
        let pixels = values.iter().map(|&v| [v; 3].into()).collect();
        Image::from_pixels([values.len() as u32, 1], pixels).expect("one row")
    }

    #[test]
    fn half_widths_are_those_of_the_tabulated_f_distribution() {
        // 97.5 % quantiles of F(ν, ν) from tables, printed to three digits; the approximation is
        // good to 3 % from 5 degrees of freedom on.
        for (degrees, f) in [(5.0, 7.15), (10.0, 3.72), (30.0, 2.07), (120.0, 1.43)] {
            let exact = 0.5 * Real::ln(f);
            let w = half_width(degrees);
            assert!((w / exact - 1.0).abs() < 0.03, "{degrees}: {w} {exact}");
        }
    }

    #[test]
    fn equal_halves_have_no_error_even_black_ones() {
        for values in [[0.0, 0.0], [1.0, 2.0]] {
            let error = ImageError::between(&grey(&values), &grey(&values));
            assert_eq!((error.estimate, error.lower, error.upper), (0.0, 0.0, 0.0));
        }
    }

    #[test]
    fn a_picture_of_no_positive_mean_has_an_infinite_error() {
        let error = ImageError::between(&grey(&[1.0, 0.0]), &grey(&[-1.0, 0.0]));
        assert_eq!((error.estimate, error.upper), (f64::INFINITY, f64::INFINITY));
    }

    #[test]
    fn many_equal_differences_count_as_many_degrees_of_freedom_and_one_large_one_as_two() {
        let pixels = 1000;
        let (mut a, b) = (vec![1.1; pixels], vec![0.9; pixels]);
        let even = ImageError::between(&grey(&a), &grey(&b));
        // 0.1 in f32 is 0.1 to 1e-7.
        assert!(
            (even.estimate - 0.1).abs() < 1e-6 && (even.degrees_of_freedom - 2000.0).abs() < 1e-6
        );
        assert!(even.upper / even.estimate < 1.05 && even.lower < even.estimate);
        a[500] = 1e6;
        let lone = ImageError::between(&grey(&a), &grey(&b));
        assert!((lone.degrees_of_freedom - 2.0).abs() < 1e-6);
        assert!(lone.upper / lone.estimate > 5.0);
    }
}
