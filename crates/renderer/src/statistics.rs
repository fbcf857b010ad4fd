//! What a render did: samples, rays, and samples that were not numbers.

use etendue_scene::Color;

use crate::codec::{Reader, StateError, Write as _};

/// Counts of one tile, or of a whole render.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Paths started, non-finite ones included.
    pub samples: u64,
    /// Rays traced.
    pub rays: RayCounts,
    /// Samples that were NaN or infinite and were left out of their pixels.
    pub non_finite: NonFiniteSamples,
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
    /// Paths in RGB that found less than no light in some channel: a defect of étendue. Colours of wavelengths may lie outside of RGB and do not
    /// count.
    pub negative: u64,
}

impl RayCounts {
    /// Counts a path that is cut, and what it carried.
    #[inline]
    pub(crate) fn cut(&mut self, throughput: f32) {
        self.cut += 1;
        // A conversion that limits, and takes NaN for 0: such a sample is counted elsewhere.
        self.cut_throughput = self.cut_throughput.saturating_add((throughput * CUT_UNITS) as u64);
    }

    /// Counts what a path has found if it is negative.
    #[inline]
    pub(crate) fn check(&mut self, radiance: Color) {
        self.negative += u64::from(radiance.to_array().iter().any(|&channel| channel < 0.0));
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

/// How many samples were not finite, and the first of them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NonFiniteSamples {
    count: u64,
    first: Vec<SampleAddress>,
}

/// The address of a sample: with the seed of the render it determines every random number of its
/// path, so that the path can be computed again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SampleAddress {
    /// Row and column of the pixel on the full film: rows first, so that addresses sort in
    /// reading order.
    pub row: u32,
    /// Column of the pixel on the full film.
    pub column: u32,
    /// Index of the sample within the pixel.
    pub sample: u64,
}

impl NonFiniteSamples {
    /// How many addresses are kept.
    pub const KEPT: usize = 16;

    /// How many samples were not finite.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The first of them in reading order, at most [`Self::KEPT`].
    pub fn first(&self) -> &[SampleAddress] {
        &self.first
    }

    /// Counts one sample.
    #[cold]
    pub fn record(&mut self, address: SampleAddress) {
        self.count += 1;
        self.keep(address);
    }

    fn keep(&mut self, address: SampleAddress) {
        let place = self.first.partition_point(|kept| *kept < address);
        if place < Self::KEPT {
            self.first.insert(place, address);
            self.first.truncate(Self::KEPT);
        }
    }
}

impl Statistics {
    /// Adds the counts of another part of the same render. The result does not depend on the
    /// order in which parts are merged.
    pub fn merge(&mut self, other: &Self) {
        self.samples += other.samples;
        self.rays.camera += other.rays.camera;
        self.rays.shadow += other.rays.shadow;
        self.rays.indirect += other.rays.indirect;
        self.rays.negative += other.rays.negative;
        self.rays.cut += other.rays.cut;
        self.rays.cut_throughput =
            self.rays.cut_throughput.saturating_add(other.rays.cut_throughput);
        self.non_finite.count += other.non_finite.count;
        for &address in &other.non_finite.first {
            self.non_finite.keep(address);
        }
    }
}

/// How statistics are stored.
impl Statistics {
    /// Fewest bytes: without addresses.
    pub(crate) const LEAST_BYTES: usize = 8 * 8 + 1;

    pub(crate) fn write(&self, bytes: &mut Vec<u8>) {
        let RayCounts { camera, shadow, indirect, cut, cut_throughput, negative } = self.rays;
        let counts = [self.samples, camera, shadow, indirect, self.non_finite.count, cut, negative];
        for count in counts {
            bytes.u64(count);
        }
        bytes.u64(cut_throughput);
        bytes.u8(self.non_finite.first.len() as u8);
        for address in &self.non_finite.first {
            bytes.u32(address.row);
            bytes.u32(address.column);
            bytes.u64(address.sample);
        }
    }

    pub(crate) fn read(reader: &mut Reader<'_>) -> Result<Self, StateError> {
        let mut counts = [0; 7];
        for count in &mut counts {
            *count = reader.u64()?;
            // Counts of many tiles are added.
            if *count > u64::from(u32::MAX) << 16 {
                return Err(StateError::new("a count is too large"));
            }
        }
        let [samples, camera, shadow, indirect, count, cut, negative] = counts;
        let cut_throughput = reader.u64()?;
        let kept = usize::from(reader.u8()?);
        if kept as u64 != count.min(NonFiniteSamples::KEPT as u64) {
            return Err(StateError::new("addresses of samples are missing"));
        }
        let mut non_finite = NonFiniteSamples { count, first: Vec::with_capacity(kept) };
        for _ in 0..kept {
            let (row, column, sample) = (reader.u32()?, reader.u32()?, reader.u64()?);
            non_finite.keep(SampleAddress { row, column, sample });
        }
        Ok(Self {
            samples,
            rays: RayCounts { camera, shadow, indirect, cut, cut_throughput, negative },
            non_finite,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(rows: impl Iterator<Item = u32>) -> Statistics {
        let mut part = Statistics { samples: 5, ..Statistics::default() };
        for row in rows {
            part.non_finite.record(SampleAddress { row, column: 0, sample: 0 });
        }
        part
    }

    #[test]
    fn merging_in_any_order_keeps_the_same_first_addresses() {
        let parts = [part((0..30).rev()), part(100..103), part(7..50)];
        let (mut forward, mut backward) = (Statistics::default(), Statistics::default());
        for (first, last) in parts.iter().zip(parts.iter().rev()) {
            forward.merge(first);
            backward.merge(last);
        }
        assert_eq!(forward, backward);
        assert_eq!(forward.non_finite.count(), 30 + 3 + 43);
        assert_eq!(forward.samples, 15);
        let rows: Vec<u32> = forward.non_finite.first().iter().map(|a| a.row).collect();
        // Rows 7 and up occur in two parts.
        assert_eq!(rows, [0, 1, 2, 3, 4, 5, 6, 7, 7, 8, 8, 9, 9, 10, 10, 11]);
    }

    #[test]
    fn light_that_is_negative_is_counted() {
        let mut rays = RayCounts::default();
        for radiance in [[0.0, 1.0, 2.0], [0.5, -1e-9, 2.0], [-0.0, 0.0, 0.0], [f32::NAN, 0.0, 1.0]]
        {
            rays.check(radiance.into());
        }
        assert_eq!(rays.negative, 1);
    }

    #[test]
    fn statistics_come_back_and_a_count_without_its_addresses_is_refused() {
        for rows in [0..0, 0..3, 0..40] {
            let rays = RayCounts {
                camera: 7,
                shadow: 1 << 40,
                indirect: 3,
                cut: 2,
                cut_throughput: u64::MAX,
                negative: 4,
            };
            let statistics = Statistics { rays, ..part(rows) };
            let mut bytes = Vec::new();
            statistics.write(&mut bytes);
            assert_eq!(Statistics::read(&mut Reader::new(&bytes)).as_ref(), Ok(&statistics));
            bytes[4 * 8] ^= 1;
            let changed = Statistics::read(&mut Reader::new(&bytes));
            assert!(changed.is_err() || statistics.non_finite.count > 16);
        }
    }
}
