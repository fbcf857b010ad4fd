//! The sums of one pixel.

use etendue_math::{ExactSum, Spectrum};
use etendue_scene::Color;

/// Exact sums of a pixel's weighted samples and of their squares.
///
/// A square is rounded to `f32` before it is added, which changes second moments by less than 2⁻²⁴ and nothing else; those beyond the
/// largest `f32` count as it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PixelMoments {
    pub(super) sums: [ExactSum; 3],
    pub(super) squares: [ExactSum; 3],
    /// Samples that count.
    pub(super) count: u32,
}

impl PixelMoments {
    /// Adds one sample and says whether it counts: a sample with a NaN or infinite channel is
    /// left out, for the caller to report.
    #[inline]
    #[must_use = "a sample that was left out has to be reported"]
    pub(crate) fn add(&mut self, weighted_radiance: Color) -> bool {
        if !weighted_radiance.is_finite() {
            return false;
        }
        for (sum, x) in self.sums.iter_mut().zip(weighted_radiance.to_array()) {
            sum.add(x);
        }
        self.count += 1;
        true
    }

    /// Adds the squares of a sample that counts.
    #[inline]
    pub(crate) fn add_squares(&mut self, weighted_radiance: Color) {
        for (sum, x) in self.squares.iter_mut().zip(weighted_radiance.to_array()) {
            sum.add((x * x).min(f32::MAX));
        }
    }

    /// The sums and then the squares, channel by channel.
    pub(super) fn all(&self) -> [&ExactSum; 6] {
        let ([r, g, b], [rr, gg, bb]) = (&self.sums, &self.squares);
        [r, g, b, rr, gg, bb]
    }

    /// Mean of the samples that count.
    pub(crate) fn mean(&self) -> Color {
        mean(&self.sums, self.count)
    }
}

/// A sum divided by a count and rounded once; black if that is 0.
pub(super) fn mean(sums: &[ExactSum; 3], count: u32) -> Color {
    sums.each_ref().map(|sum| sum.divided_by(count)).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_that_is_not_finite_is_refused_and_leaves_the_mean_alone() {
        let mut pixel = PixelMoments::default();
        assert!(pixel.add([1.0, 2.0, 3.0].into()));
        assert!(!pixel.add([f32::NAN, 0.0, 0.0].into()));
        assert!(!pixel.add([0.0, f32::INFINITY, 0.0].into()));
        assert_eq!(pixel.mean(), [1.0, 2.0, 3.0].into());
    }

    #[test]
    fn the_mean_of_many_equal_samples_is_that_sample() {
        let mut pixel = PixelMoments::default();
        for _ in 0..100_000 {
            assert!(pixel.add([0.1, 0.7, 1e-3].into()));
        }
        assert_eq!(pixel.mean(), [0.1, 0.7, 1e-3].into());
    }

    #[test]
    fn squares_that_are_too_large_count_as_the_largest() {
        let mut pixel = PixelMoments::default();
        for sample in [[1e30, 2.0, 0.5].into(), [-1e30, 4.0, 0.5].into()] {
            assert!(pixel.add(sample));
            pixel.add_squares(sample);
        }
        assert_eq!(pixel.mean(), [0.0, 3.0, 0.5].into());
        assert_eq!(mean(&pixel.squares, pixel.count), [f32::MAX, 10.0, 0.25].into());
    }
}
