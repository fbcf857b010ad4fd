//! One of the two halves of a pixel's samples.

use core::ops::Range;

use etendue_math::Spectrum;
use etendue_scene::Color;

use super::schedule::HIGHEST;
use crate::codec::{Reader, StateError, Write as _};
use crate::film::PixelSum;

/// Number of levels whose differences are remembered.
const KEPT: usize = 8;

/// How far above the level that every pixel has reached a pixel may be, so that its difference at
/// that level is still remembered: 2⁶ times the samples.
pub(super) const REACH: u32 = KEPT as u32 - 2;

/// Mean of the first `2^level` samples of one sequence of one pixel.
///
/// Samples are added by doubling: aligned powers of two are what Sobol' points are stratified in. Each
/// doubling compares the mean so far with that of as many further samples,
///
/// ```text
/// d(level) = Σ_channels ((m₁ − m₂) / 2)²
/// ```
///
/// which for independent samples estimates the variance of their common mean without bias.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Half {
    mean: Color,
    /// Samples that count: those drawn but for the non-finite ones.
    count: u32,
    /// Samples drawn: none or a power of two.
    drawn: u32,
    differences: [f32; KEPT],
}

impl Half {
    /// Samples drawn, non-finite ones included.
    pub(super) fn drawn(&self) -> u32 {
        self.drawn
    }

    /// Mean of the samples that count; black if there are none.
    pub(super) fn mean(&self) -> Color {
        self.mean
    }

    /// `d(level)`: of a level that has been reached, and at most [`REACH`] below the present one.
    pub(super) fn difference(&self, level: u32) -> f32 {
        self.differences[level as usize % KEPT]
    }

    /// The samples that double the number of samples.
    #[inline]
    pub(super) fn next_block(&self) -> Range<u32> {
        self.drawn..self.drawn + self.drawn.max(1)
    }

    /// Adds the samples of [`next_block`](Self::next_block).
    #[inline]
    pub(super) fn add(&mut self, block: &PixelSum) {
        let mean = block.mean();
        let drawn = self.next_block().end;
        if self.drawn > 0 {
            let squared = (self.mean + mean.scale(-1.0)).scale(0.5).to_array().map(|d| d * d);
            self.differences[drawn.trailing_zeros() as usize % KEPT] = squared.iter().sum();
        }
        let count = self.count + block.count() as u32;
        // Of two means of equally many samples this is exactly their mean, rounded once.
        let share = (block.count() as f64 / f64::from(count.max(1))) as f32;
        self.mean = self.mean.scale(1.0 - share) + mean.scale(share);
        (self.count, self.drawn) = (count, drawn);
    }
}

/// How halves are stored.
impl Half {
    /// Bytes of a half.
    pub(super) const BYTES: u64 = 4 * (3 + 1 + 1 + KEPT as u64);

    pub(super) fn write(&self, bytes: &mut Vec<u8>) {
        for channel in self.mean.to_array() {
            bytes.f32(channel);
        }
        bytes.u32(self.count);
        bytes.u32(self.drawn);
        for difference in self.differences {
            bytes.f32(difference);
        }
    }

    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Self, StateError> {
        let mut mean = [0.0; 3];
        for channel in &mut mean {
            *channel = reader.f32()?;
        }
        let (count, drawn) = (reader.u32()?, reader.u32()?);
        if count > drawn || drawn > 1 << HIGHEST || drawn.count_ones() > 1 {
            return Err(StateError::new("a pixel has a number of samples that cannot be"));
        }
        let mut differences = [0.0; KEPT];
        for difference in &mut differences {
            *difference = reader.f32()?;
        }
        Ok(Self { mean: mean.into(), count, drawn, differences })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(values: &[f32]) -> PixelSum {
        let mut sum = PixelSum::default();
        for &value in values {
            // A value that is not finite is left out, as in a render.
            let _ = sum.add(Color::splat(value));
        }
        sum
    }

    #[test]
    fn doubling_keeps_the_mean_and_remembers_half_the_difference_squared() {
        let mut half = Half::default();
        assert_eq!(half.next_block(), 0..1);
        half.add(&block(&[1.0]));
        assert_eq!(half.next_block(), 1..2);
        half.add(&block(&[3.0]));
        assert_eq!((half.drawn(), half.mean()), (2, Color::splat(2.0)));
        assert_eq!(half.difference(1), 3.0);
        half.add(&block(&[0.0, 2.0]));
        assert_eq!((half.drawn(), half.mean()), (4, Color::splat(1.5)));
        assert_eq!((half.difference(1), half.difference(2)), (3.0, 0.75));
    }

    #[test]
    fn a_sample_that_is_not_finite_has_no_weight() {
        let mut half = Half::default();
        half.add(&block(&[f32::NAN]));
        assert_eq!((half.drawn(), half.mean()), (1, Color::black()));
        half.add(&block(&[4.0]));
        assert_eq!((half.drawn(), half.mean()), (2, Color::splat(4.0)));
        half.add(&block(&[1.0, 1.0]));
        assert_eq!(half.mean(), Color::splat(2.0));
    }
}
