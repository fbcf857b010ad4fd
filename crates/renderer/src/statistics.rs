//! What a render did: samples, rays, and samples that were no light.

use etendue_scene::film::Crop;

use crate::bad_samples::{BadSamples, SampleAddress};
use crate::codec::{Reader, StateError, Write as _};

/// Counts of one tile, or of a whole render.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Paths started, non-finite ones included.
    pub samples: u64,
    /// Rays traced.
    pub rays: RayCounts,
    /// Samples that were NaN or infinite and were left out of their pixels.
    pub non_finite: BadSamples,
    /// Samples in RGB that found less than no light in some channel: a defect of étendue. Colours of wavelengths may lie outside of RGB and
    /// do not count.
    pub negative: BadSamples,
}

/// Rays by purpose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RayCounts {
    /// From the camera, one per sample and one more for each hidden emitter crossed.
    pub camera: u64,
    /// To a light, any hit.
    pub shadow: u64,
    /// From a surface in a direction sampled from its reflection model.
    pub indirect: u64,
    /// Not traced: paths that had the largest number of edges where they might have gone on.
    pub cut: u64,
    /// What these paths still carried, in units of 2⁻²⁰ of what the camera's rays do: the largest channel of the throughput, summed as integers.
    pub cut_throughput: u64,
}

impl RayCounts {
    /// Counts a path that is cut, and what it carried.
    #[inline]
    pub(crate) fn cut(&mut self, throughput: f32) {
        self.cut += 1;
        // A conversion that limits, and takes NaN for 0: such a sample is counted elsewhere.
        self.cut_throughput = self.cut_throughput.saturating_add((throughput * CUT_UNITS) as u64);
    }

    /// The share of the camera's throughput that was cut: a bound on the share of the light that is missing, where nothing that was left out
    /// is brighter than what was found.
    ///
    /// * `samples`: from the camera.
    pub fn cut_share(&self, samples: u64) -> f64 {
        self.cut_throughput as f64 / f64::from(CUT_UNITS) / samples.max(1) as f64
    }

    /// All rays together.
    pub fn total(&self) -> u64 {
        self.camera + self.shadow + self.indirect
    }
}

/// Throughputs of cut paths are summed in this fraction of 1.
const CUT_UNITS: f32 = (1 << 20) as f32;

impl Statistics {
    /// Counts a sample if it is no light.
    ///
    /// * `pixel`: column and row on the full film.
    /// * `counts`: whether it is finite, and so counts.
    #[inline]
    pub(crate) fn check(
        &mut self,
        [column, row]: [u32; 2],
        sample: u64,
        counts: bool,
        negative: bool,
    ) {
        let address = SampleAddress { row, column, sample };
        if !counts {
            self.non_finite.record(address);
        }
        if negative {
            self.negative.record(address);
        }
    }

    /// Adds the counts of another part of the same render. The result does not depend on the
    /// order in which parts are merged.
    pub fn merge(&mut self, other: &Self) {
        self.samples += other.samples;
        self.rays.camera += other.rays.camera;
        self.rays.shadow += other.rays.shadow;
        self.rays.indirect += other.rays.indirect;
        self.rays.cut += other.rays.cut;
        self.rays.cut_throughput =
            self.rays.cut_throughput.saturating_add(other.rays.cut_throughput);
        self.non_finite.merge(&other.non_finite);
        self.negative.merge(&other.negative);
    }
}

/// How statistics are stored.
impl Statistics {
    /// Fewest bytes: of good samples.
    pub(crate) const LEAST_BYTES: usize = 6 * 8 + 2 * BadSamples::LEAST_BYTES;

    pub(crate) fn write(&self, bytes: &mut Vec<u8>) {
        let RayCounts { camera, shadow, indirect, cut, cut_throughput } = self.rays;
        for count in [self.samples, camera, shadow, indirect, cut, cut_throughput] {
            bytes.u64(count);
        }
        self.non_finite.write(bytes);
        self.negative.write(bytes);
    }

    /// Reads what [`write`](Self::write) has written of samples within a part of the film.
    pub(crate) fn read(reader: &mut Reader<'_>, part: &Crop) -> Result<Self, StateError> {
        let mut counts = [0; 5];
        for count in &mut counts {
            *count = reader.u64()?;
            // Counts of many tiles are added.
            if *count > u64::from(u32::MAX) << 16 {
                return Err(StateError::new("a count is too large"));
            }
        }
        let [samples, camera, shadow, indirect, cut] = counts;
        let rays = RayCounts { camera, shadow, indirect, cut, cut_throughput: reader.u64()? };
        let [non_finite, negative] =
            [BadSamples::read(reader, part)?, BadSamples::read(reader, part)?];
        Ok(Self { samples, rays, non_finite, negative })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_come_back() {
        let rays =
            RayCounts { camera: 7, shadow: 1 << 40, indirect: 3, cut: 2, cut_throughput: u64::MAX };
        let mut statistics = Statistics { samples: 5, rays, ..Statistics::default() };
        statistics.check([4, 2], 0, false, false);
        statistics.check([4, 3], 1, false, true);
        let mut bytes = Vec::new();
        statistics.write(&mut bytes);
        let part = Crop { offset: [4, 2], size: [1, 2] };
        assert_eq!(Statistics::read(&mut Reader::new(&bytes), &part).as_ref(), Ok(&statistics));
    }
}
