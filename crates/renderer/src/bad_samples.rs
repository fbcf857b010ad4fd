//! Samples that are no light.

use alloc::collections::{BTreeMap, BTreeSet};

use etendue_math::mix_u64;
use etendue_scene::Color;
use etendue_scene::film::Crop;

use crate::codec::{Reader, StateError, Write as _};

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

impl SampleAddress {
    fn hash(self) -> u64 {
        mix_u64(u64::from(self.row) << 32 | u64::from(self.column), self.sample)
    }
}

/// Whether light in RGB is less than none in some channel.
#[inline]
pub(crate) fn is_negative(radiance: Color) -> bool {
    radiance.to_array().iter().any(|&channel| channel < 0.0)
}

/// The samples of a render that have one defect: how many there are, in which pixels, and the addresses of some.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BadSamples {
    /// By row and column on the full film, how many there are.
    pixels: BTreeMap<[u32; 2], u32>,
    /// Those of the smallest hashes.
    kept: BTreeSet<(u64, SampleAddress)>,
}

impl BadSamples {
    /// How many addresses are kept.
    pub const KEPT: usize = 256;

    /// How many samples have the defect.
    pub fn count(&self) -> u64 {
        self.pixels.values().copied().map(u64::from).sum()
    }

    /// The pixels that have such samples: row and column on the full film, and how many.
    pub fn pixels(&self) -> impl Iterator<Item = ([u32; 2], u32)> + '_ {
        self.pixels.iter().map(|(&pixel, &count)| (pixel, count))
    }

    /// Addresses in reading order: of all samples if there are at most [`Self::KEPT`], otherwise of as many that hashes choose, each
    /// with the same chance.
    pub fn some(&self) -> Vec<SampleAddress> {
        let mut addresses: Vec<SampleAddress> =
            self.kept.iter().map(|&(_, address)| address).collect();
        addresses.sort_unstable();
        addresses
    }

    /// Counts one sample.
    #[cold]
    pub fn record(&mut self, address: SampleAddress) {
        self.count_in([address.row, address.column], 1);
        self.keep(address.hash(), address);
    }

    fn count_in(&mut self, pixel: [u32; 2], more: u32) {
        let count = self.pixels.entry(pixel).or_default();
        *count = count.saturating_add(more);
    }

    fn keep(&mut self, hash: u64, address: SampleAddress) {
        self.kept.insert((hash, address));
        if self.kept.len() > Self::KEPT {
            self.kept.pop_last();
        }
    }

    /// Adds other samples of the same render. The result does not depend on the order.
    pub(crate) fn merge(&mut self, other: &Self) {
        for (pixel, count) in other.pixels() {
            self.count_in(pixel, count);
        }
        for &(hash, address) in &other.kept {
            self.keep(hash, address);
        }
    }
}

/// How they are stored.
impl BadSamples {
    /// Fewest bytes: of none.
    pub(crate) const LEAST_BYTES: usize = 4 + 4;

    pub(crate) fn write(&self, bytes: &mut Vec<u8>) {
        bytes.u32(self.pixels.len() as u32);
        for ([row, column], count) in self.pixels() {
            for number in [row, column, count] {
                bytes.u32(number);
            }
        }
        bytes.u32(self.kept.len() as u32);
        for address in self.some() {
            bytes.u32(address.row);
            bytes.u32(address.column);
            bytes.u64(address.sample);
        }
    }

    /// Reads what [`write`](Self::write) has written of samples within a part of the film.
    pub(crate) fn read(reader: &mut Reader<'_>, part: &Crop) -> Result<Self, StateError> {
        let pixel = |reader: &mut Reader<'_>| {
            let (row, column) = (reader.u32()?, reader.u32()?);
            let within = |(axis, n): (usize, u32)| {
                n.checked_sub(part.offset[axis]).is_some_and(|n| n < part.size[axis])
            };
            let is_there = [(0, column), (1, row)].into_iter().all(within);
            is_there
                .then_some([row, column])
                .ok_or(StateError::new("a sample lies outside of the picture"))
        };
        let mut samples = Self::default();
        let pixels = reader.u32()?;
        for _ in 0..pixels {
            samples.count_in(pixel(reader)?, reader.u32()?);
        }
        let kept = reader.u32()?;
        for _ in 0..kept {
            let ([row, column], sample) = (pixel(reader)?, reader.u64()?);
            let address = SampleAddress { row, column, sample };
            samples.keep(address.hash(), address);
        }
        let fits = samples.pixels.len() as u64 == u64::from(pixels)
            && samples.kept.len() as u64 == u64::from(kept)
            && u64::from(kept) == samples.count().min(Self::KEPT as u64);
        if fits { Ok(samples) } else { Err(StateError::new("addresses of samples are missing")) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(samples: impl IntoIterator<Item = u64>) -> BadSamples {
        let mut part = BadSamples::default();
        for sample in samples {
            part.record(SampleAddress { row: sample as u32 / 40, column: 3, sample });
        }
        part
    }

    #[test]
    fn less_than_no_light_is_found_and_nothing_else() {
        let radiances = [[0.0, 1.0, 2.0], [0.5, -1e-9, 2.0], [-0.0; 3], [f32::NAN, 0.0, 1.0]];
        assert_eq!(radiances.map(|x| is_negative(x.into())), [false, true, false, false]);
    }

    #[test]
    fn merging_in_any_order_keeps_the_same_addresses() {
        let parts = [part((0..300).rev()), part(1000..1003), part(300..350)];
        let (mut forward, mut backward) = (BadSamples::default(), BadSamples::default());
        for (first, last) in parts.iter().zip(parts.iter().rev()) {
            forward.merge(first);
            backward.merge(last);
        }
        assert_eq!(forward, backward);
        assert_eq!(forward, part((1000..1003).chain(0..350)));
        assert_eq!((forward.count(), forward.some().len()), (353, BadSamples::KEPT));
        assert!(forward.pixels().take(8).all(|(_, count)| count == 40));
        let all = part(5..100);
        assert!(all.some().iter().map(|address| address.sample).eq(5..100), "all of few");
    }

    #[test]
    fn of_many_any_is_kept_with_the_same_chance() {
        let many = part(0..100_000);
        let early = many.some().iter().filter(|address| address.sample < 50_000).count();
        // Half of 256, within four standard deviations of 8.
        assert!(early.abs_diff(128) < 32, "{early}");
    }

    #[test]
    fn they_come_back_and_a_count_without_its_addresses_is_refused() {
        for count in [0, 3, 400] {
            let samples = part(0..count);
            let mut bytes = Vec::new();
            samples.write(&mut bytes);
            let part = Crop { offset: [3, 0], size: [1, 10] };
            let read = |bytes: &[u8], part| BadSamples::read(&mut Reader::new(bytes), &part);
            assert_eq!(read(&bytes, part).as_ref(), Ok(&samples));
            for elsewhere in [Crop { offset: [2, 0], ..part }, Crop { size: [1, 0], ..part }] {
                assert_eq!(read(&bytes, elsewhere).is_err(), count > 0);
            }
            assert!(read(&bytes[..bytes.len() - 1], part).is_err());
            if count == 3 {
                // The count of the one pixel.
                bytes[4 + 8] ^= 1;
                assert!(read(&bytes, part).is_err());
            }
        }
    }
}
