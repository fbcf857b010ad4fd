//! The running sum of one pixel.

use etendue_math::{CompensatedSum, Spectrum};
use etendue_scene::Color;

use crate::codec::{Reader, StateError, Write as _};

/// Compensated sum of a pixel's weighted samples.
///
/// Compensation makes the mean of any number of samples correct to the last bit or so, where a
/// plain `f32` sum stops growing after 2²⁴ equal terms.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelSum {
    channels: [CompensatedSum<f32>; 3],
    count: u64,
}

impl PixelSum {
    /// Adds one sample and says whether it counts: a sample with a NaN or infinite channel is
    /// left out, for the caller to report.
    #[inline]
    #[must_use = "a sample that was left out has to be reported"]
    pub fn add(&mut self, weighted_radiance: Color) -> bool {
        if !weighted_radiance.is_finite() {
            return false;
        }
        for (sum, x) in self.channels.iter_mut().zip(weighted_radiance.to_array()) {
            sum.add(x);
        }
        self.count += 1;
        true
    }

    /// Number of samples that count.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Mean of the samples that count; black if there are none.
    pub fn mean(&self) -> Color {
        let scale = 1.0 / self.count.max(1) as f64;
        // The pair is joined in f64, so that the mean is rounded only once.
        let mean = |s: CompensatedSum<f32>| {
            ((f64::from(s.total()) + f64::from(s.remainder())) * scale) as f32
        };
        self.channels.map(mean).into()
    }
}

/// How a sum is stored.
impl PixelSum {
    /// Bytes of a sum.
    pub(crate) const BYTES: u64 = 3 * 2 * 4 + 8;

    pub(crate) fn write(&self, bytes: &mut Vec<u8>) {
        for sum in self.channels {
            bytes.f32(sum.total());
            bytes.f32(sum.remainder());
        }
        bytes.u64(self.count);
    }

    pub(crate) fn read(reader: &mut Reader<'_>) -> Result<Self, StateError> {
        let mut channels = [CompensatedSum::default(); 3];
        for sum in &mut channels {
            *sum = CompensatedSum::from_parts(reader.f32()?, reader.f32()?);
        }
        Ok(Self { channels, count: reader.u64()? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_that_is_not_finite_is_refused_and_leaves_the_mean_alone() {
        let mut pixel = PixelSum::default();
        assert!(pixel.add([1.0, 2.0, 3.0].into()));
        assert!(!pixel.add([f32::NAN, 0.0, 0.0].into()));
        assert!(!pixel.add([0.0, f32::INFINITY, 0.0].into()));
        assert_eq!(pixel.mean(), [1.0, 2.0, 3.0].into());
    }

    #[test]
    fn the_mean_of_many_equal_samples_is_that_sample() {
        let mut pixel = PixelSum::default();
        for _ in 0..100_000 {
            assert!(pixel.add([0.1, 0.7, 1e-3].into()));
        }
        assert_eq!(pixel.mean(), [0.1, 0.7, 1e-3].into());
    }
}
