//! A tile at rest.

use etendue_math::ExactSum;
use etendue_scene::Color;

use super::column::{Column, Integer};
use super::pixel::{PixelMoments, mean};
use crate::codec::{Reader, StateError, Write as _};
use crate::statistics::Statistics;
use crate::tile::Tile;

/// The sums of the pixels of a tile, without the bytes that say nothing, as they are stored too.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct PackedTile {
    /// Samples drawn of every pixel, from the beginning of the range on.
    drawn: u32,
    statistics: Statistics,
    /// Of each pixel the samples drawn that do not count; none but for samples that are not finite.
    left_out: Column,
    /// Three channels of sums and three of squares.
    sums: [Column; 6],
}

/// Fewest bytes of a stored tile.
pub(super) const LEAST: usize = 4 + Statistics::LEAST_BYTES + 7 * Column::LEAST_BYTES;

impl PackedTile {
    /// * `pixels`: in the order of [`Tile::pixels`], of each of which `drawn` samples have been drawn.
    pub(crate) fn new(drawn: u32, pixels: &[PixelMoments], statistics: Statistics) -> Self {
        let column = |integer: &dyn Fn(&PixelMoments) -> Integer| {
            Column::new(&pixels.iter().map(integer).collect::<Vec<_>>())
        };
        let left_out = column(&|pixel| widened(drawn - pixel.count));
        let sums = core::array::from_fn(|i| column(&|pixel| pixel.all()[i].to_bytes()));
        Self { drawn, statistics, left_out, sums }
    }

    /// Samples drawn of every pixel.
    pub(crate) fn drawn(&self) -> u32 {
        self.drawn
    }

    /// What was done for it.
    pub(crate) fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// The pixels of the tile that is packed here, in the order of [`Tile::pixels`]; empty ones where nothing has been drawn.
    pub(crate) fn unpack(&self, tile: Tile) -> impl Iterator<Item = PixelMoments> + '_ {
        let pixels = tile.area();
        (0..pixels).map(move |pixel| {
            let sums = |first: usize| [0, 1, 2].map(|i| self.sum(first + i, pixel, pixels));
            let count = self.count(pixel, pixels);
            PixelMoments { sums: sums(0), squares: sums(3), count }
        })
    }

    fn sum(&self, index: usize, pixel: usize, pixels: usize) -> ExactSum {
        ExactSum::from_bytes(&self.sums[index].get(pixel, pixels))
    }

    /// Number of samples of one of `pixels` pixels that count.
    pub(super) fn count(&self, pixel: usize, pixels: usize) -> u32 {
        self.drawn - narrowed(&self.left_out.get(pixel, pixels))
    }

    /// Mean of the samples that count of one of `pixels` pixels, rounded once; black if there are none.
    pub(super) fn mean(&self, pixel: usize, pixels: usize) -> Color {
        self.quotients(0, pixel, pixels)
    }

    /// Mean of their squares.
    pub(super) fn mean_square(&self, pixel: usize, pixels: usize) -> Color {
        self.quotients(3, pixel, pixels)
    }

    fn quotients(&self, first: usize, pixel: usize, pixels: usize) -> Color {
        let sums = [0, 1, 2].map(|i| self.sum(first + i, pixel, pixels));
        mean(&sums, self.count(pixel, pixels))
    }

    /// The samples of two parts of the same tile.
    pub(super) fn joined(&self, other: &Self, tile: Tile) -> Self {
        let pixels = tile.area();
        let mut statistics = self.statistics.clone();
        statistics.merge(&other.statistics);
        Self {
            drawn: self.drawn + other.drawn,
            statistics,
            left_out: self.left_out.sum(&other.left_out, pixels),
            sums: core::array::from_fn(|i| self.sums[i].sum(&other.sums[i], pixels)),
        }
    }

    pub(super) fn write(&self, tile: Tile, bytes: &mut Vec<u8>) {
        bytes.u32(self.drawn);
        self.statistics.write(bytes);
        self.left_out.write(tile.area(), bytes);
        for column in &self.sums {
            column.write(tile.area(), bytes);
        }
    }

    /// Reads what [`write`](Self::write) has written for a tile of which at most `limit` samples are drawn.
    pub(super) fn read(
        reader: &mut Reader<'_>,
        tile: Tile,
        limit: u32,
    ) -> Result<Self, StateError> {
        let pixels = tile.area();
        let drawn = reader.u32()?;
        if drawn > limit {
            return Err(StateError::new("a tile has more samples than there are"));
        }
        let statistics = Statistics::read(reader, &tile.into())?;
        let left_out = Column::read(reader, pixels)?;
        for pixel in 0..pixels {
            let integer = left_out.get(pixel, pixels);
            if widened(narrowed(&integer)) != integer || narrowed(&integer) > drawn {
                return Err(StateError::new("a pixel has more samples than there are"));
            }
        }
        let mut sums: [Column; 6] = Default::default();
        for column in &mut sums {
            *column = Column::read(reader, pixels)?;
        }
        if drawn == 0 && sums.iter().any(|column| *column != Column::default()) {
            return Err(StateError::new("a tile without samples has sums"));
        }
        Ok(Self { drawn, statistics, left_out, sums })
    }
}

/// A count as an integer of a column.
fn widened(count: u32) -> Integer {
    let mut integer = [0; ExactSum::BYTES];
    integer[..4].copy_from_slice(&count.to_le_bytes());
    integer
}

/// The count in an integer of a column.
fn narrowed(integer: &Integer) -> u32 {
    let mut count = [0; 4];
    count.copy_from_slice(&integer[..4]);
    u32::from_le_bytes(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixel(values: [f32; 3], count: u32) -> PixelMoments {
        let mut pixel = PixelMoments::default();
        for _ in 0..count {
            assert!(pixel.add(values.into()));
            pixel.add_squares(values.into());
        }
        pixel
    }

    const ROW: Tile = Tile { offset: [3, 5], size: [4, 1] };

    fn pixels() -> [PixelMoments; 4] {
        [
            PixelMoments::default(),
            pixel([0.3, 1e-3, 20.0], 100),
            pixel([-0.25, f32::MAX, -f32::MAX], 3),
            pixel([f32::from_bits(1), -f32::from_bits(1), -1.0], 1),
        ]
    }

    #[test]
    fn pixels_come_back_and_usual_ones_are_small() {
        let tile = PackedTile::new(100, &pixels(), Statistics::default());
        assert!(tile.unpack(ROW).eq(pixels()));
        let usual = [0.3, 0.1, 0.7, 2.0].map(|x| pixel([x, 0.5 * x, 1e-3 * x], 100));
        let mut bytes = Vec::new();
        PackedTile::new(100, &usual, Statistics::default()).write(ROW, &mut bytes);
        let of_pixels = bytes.len() - LEAST;
        assert!(of_pixels <= 4 * 50, "{of_pixels}");
    }

    #[test]
    fn a_tile_that_is_read_has_as_many_samples_as_it_may() {
        let tile = PackedTile::new(100, &pixels(), Statistics::default());
        let mut bytes = Vec::new();
        tile.write(ROW, &mut bytes);
        assert_eq!(PackedTile::read(&mut Reader::new(&bytes), ROW, 100), Ok(tile.clone()));
        assert!(PackedTile::read(&mut Reader::new(&bytes), ROW, 99).is_err());
        for drawn in [0_u32, 99] {
            bytes[..4].copy_from_slice(&drawn.to_le_bytes());
            assert!(PackedTile::read(&mut Reader::new(&bytes), ROW, 100).is_err(), "{drawn}");
        }
    }

    #[test]
    fn parts_of_a_tile_add_up() {
        let mut all = pixels();
        for pixel in &mut all {
            pixel.count *= 2;
            for sum in pixel.sums.iter_mut().chain(&mut pixel.squares) {
                sum.merge(&sum.clone());
            }
        }
        let half = PackedTile::new(100, &pixels(), Statistics::default());
        assert_eq!(half.joined(&half, ROW), PackedTile::new(200, &all, Statistics::default()));
    }
}
