//! A tile at rest.

use etendue_math::ExactSum;

use super::pixel::PixelMoments;
use crate::codec::{Reader, StateError, Write as _};
use crate::statistics::Statistics;
use crate::tile::Tile;

/// The sums of the pixels of a tile, without the bytes that say nothing, as they are stored too.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct PackedTile {
    /// Samples drawn of every pixel, from the beginning of the range on.
    drawn: u32,
    statistics: Statistics,
    /// Pixel after pixel; nothing where no samples have been drawn.
    pixels: Vec<u8>,
}

/// Fewest bytes of a stored tile.
pub(super) const LEAST: usize = 4 + Statistics::LEAST_BYTES + 8;

/// Fewest bytes of a packed pixel: its count and six empty sums.
const LEAST_OF_PIXEL: usize = 4 + 6 * 2;

impl PackedTile {
    /// * `pixels`: in the order of [`Tile::pixels`].
    pub(crate) fn new(drawn: u32, pixels: &[PixelMoments], statistics: Statistics) -> Self {
        let mut packed = Vec::with_capacity(pixels.len() * 4 * LEAST_OF_PIXEL);
        for pixel in pixels {
            packed.u32(pixel.count);
            for sum in pixel.sums.iter().chain(&pixel.squares) {
                pack(sum, &mut packed);
            }
        }
        packed.shrink_to_fit();
        Self { drawn, statistics, pixels: packed }
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
        let mut reader = Reader::new(&self.pixels);
        // What is packed here or was checked when it was read has all its pixels.
        tile.pixels().map(move |_| read_pixel(&mut reader).unwrap_or_default())
    }

    pub(super) fn write(&self, bytes: &mut Vec<u8>) {
        bytes.u32(self.drawn);
        self.statistics.write(bytes);
        bytes.u64(self.pixels.len() as u64);
        bytes.extend_from_slice(&self.pixels);
    }

    /// Reads what [`write`](Self::write) has written for a tile of which at most `limit` samples are drawn.
    pub(super) fn read(
        reader: &mut Reader<'_>,
        tile: Tile,
        limit: u32,
    ) -> Result<Self, StateError> {
        let drawn = reader.u32()?;
        if drawn > limit {
            return Err(StateError::new("a tile has more samples than there are"));
        }
        let statistics = Statistics::read(reader)?;
        let length = reader.u64()?;
        let length = usize::try_from(length).map_err(|_| StateError::new("a tile is too long"))?;
        let pixels = reader.bytes(length)?;
        if drawn > 0 {
            let mut packed = Reader::new(pixels);
            for _ in tile.pixels() {
                if read_pixel(&mut packed)?.count > drawn {
                    return Err(StateError::new("a pixel has more samples than there are"));
                }
            }
            packed.end()?;
        } else if length > 0 {
            return Err(StateError::new("a tile without samples has sums"));
        }
        Ok(Self { drawn, statistics, pixels: pixels.to_vec() })
    }
}

fn read_pixel(reader: &mut Reader<'_>) -> Result<PixelMoments, StateError> {
    let mut pixel = PixelMoments { count: reader.u32()?, ..PixelMoments::default() };
    for sum in pixel.sums.iter_mut().chain(&mut pixel.squares) {
        *sum = unpack(reader)?;
    }
    Ok(pixel)
}

/// Marks a negative sum in the byte of its length.
const NEGATIVE: u8 = 0x80;

/// The bytes between the zeros below and the copies of the sign above, their place and their number.
fn pack(sum: &ExactSum, packed: &mut Vec<u8>) {
    let bytes = sum.to_bytes();
    let negative = bytes[ExactSum::BYTES - 1] & 0x80 != 0;
    let sign = if negative { 0xff } else { 0 };
    let end = bytes.iter().rposition(|&byte| byte != sign).map_or(0, |last| last + 1);
    let begin = bytes[..end].iter().position(|&byte| byte != 0).unwrap_or(end);
    packed.u8(begin as u8);
    packed.u8((end - begin) as u8 | if negative { NEGATIVE } else { 0 });
    packed.extend_from_slice(&bytes[begin..end]);
}

fn unpack(reader: &mut Reader<'_>) -> Result<ExactSum, StateError> {
    let begin = usize::from(reader.u8()?);
    let length = reader.u8()?;
    let sign = if length & NEGATIVE != 0 { 0xff } else { 0 };
    let content = reader.bytes(usize::from(length & !NEGATIVE))?;
    let end = begin + content.len();
    let mut bytes = [sign; ExactSum::BYTES];
    let (Some(below), true) = (bytes.get_mut(..begin), end <= ExactSum::BYTES) else {
        return Err(StateError::new("a sum is too long"));
    };
    below.fill(0);
    bytes[begin..end].copy_from_slice(content);
    Ok(ExactSum::from_bytes(&bytes))
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

    #[test]
    fn pixels_come_back_and_usual_ones_are_small() {
        let pixels = [
            PixelMoments::default(),
            pixel([0.3, 1e-3, 20.0], 100),
            pixel([-0.25, f32::MAX, -f32::MAX], 3),
            pixel([f32::from_bits(1), -f32::from_bits(1), -1.0], 1),
        ];
        let tile = PackedTile::new(100, &pixels, Statistics::default());
        let row = Tile { offset: [3, 5], size: [4, 1] };
        let unpacked: Vec<PixelMoments> = tile.unpack(row).collect();
        assert_eq!(unpacked, pixels);
        let usual = PackedTile::new(100, &pixels[1..2], Statistics::default()).pixels.len();
        assert!(usual < 64, "{usual}");
    }
}
