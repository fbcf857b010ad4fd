//! What a plain render knows.

use alloc::sync::Arc;
use core::ops::Range;

use etendue_scene::Color;
use etendue_scene::film::Crop;

use super::packed::{LEAST, PackedTile};
use crate::codec::{Reader, StateError, Write as _};
use crate::film::Image;
use crate::statistics::Statistics;
use crate::tile::Tile;

/// The sums of all pixels of a crop over a range of the samples, as far as they have been drawn.
///
/// To clone it is cheap: the tiles are shared.
///
/// # Examples
/// ```
/// use etendue_renderer::Accumulation;
/// use etendue_scene::film::Crop;
///
/// let crop = Crop { offset: [0, 0], size: [20, 10] };
/// let nothing = Accumulation::new(crop, 0..64);
/// assert_eq!((nothing.is_whole(), nothing.fraction()), (false, 0.0));
/// let mut bytes = Vec::new();
/// nothing.encode(&mut bytes);
/// assert_eq!(Accumulation::decode(&bytes)?, nothing);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Accumulation {
    crop: Crop,
    samples: Range<u32>,
    /// In the order of [`Tile::cover`].
    tiles: Vec<Arc<PackedTile>>,
    /// Samples per pixel of all tiles together.
    drawn: u64,
}

impl Accumulation {
    /// No samples yet of the range that is to be drawn.
    pub fn new(crop: Crop, samples: Range<u32>) -> Self {
        let nothing = Arc::new(PackedTile::default());
        let tiles = vec![nothing; Tile::count(&crop) as usize];
        Self { crop, samples, tiles, drawn: 0 }
    }

    /// The part of the film.
    pub fn crop(&self) -> Crop {
        self.crop
    }

    /// The samples of every pixel that are to be drawn: indices of the one sequence that the seed determines.
    pub fn samples(&self) -> Range<u32> {
        self.samples.clone()
    }

    /// Has more samples drawn: up to `end`, but no fewer than were to be.
    pub fn extend_to(&mut self, end: u32) {
        self.samples.end = self.samples.end.max(end);
    }

    /// Whether all samples of the range have been drawn.
    pub fn is_whole(&self) -> bool {
        self.least() == self.wanted()
    }

    /// Samples that every pixel has.
    pub fn least(&self) -> u32 {
        self.tiles.iter().map(|tile| tile.drawn()).min().unwrap_or(self.wanted())
    }

    /// The part of the samples that has been drawn, from 0 to 1.
    pub fn fraction(&self) -> f64 {
        let all = self.tiles.len() as u64 * u64::from(self.wanted());
        if all == 0 { 1.0 } else { self.drawn as f64 / all as f64 }
    }

    /// Samples per pixel of the range.
    pub(super) fn wanted(&self) -> u32 {
        self.samples.end.saturating_sub(self.samples.start)
    }

    pub(super) fn tile(&self, index: usize) -> Arc<PackedTile> {
        Arc::clone(&self.tiles[index])
    }

    pub(super) fn replace(&mut self, index: usize, tile: PackedTile) {
        self.drawn += u64::from(tile.drawn());
        let before = core::mem::replace(&mut self.tiles[index], Arc::new(tile));
        self.drawn -= u64::from(before.drawn());
    }

    /// The means of the pixels; those without samples are black.
    pub fn image(&self) -> Image {
        self.map(PackedTile::mean)
    }

    /// The means of the squares of the samples, channel by channel.
    pub fn second_moments(&self) -> Image {
        self.map(PackedTile::mean_square)
    }

    /// Number of samples of each pixel that count, row by row.
    pub fn counts(&self) -> Vec<u32> {
        let mut counts = vec![0; self.crop.size.map(|n| n as usize).iter().product()];
        self.visit(|[x, y], tile, pixel, pixels| {
            let place = y as usize * self.crop.size[0] as usize + x as usize;
            counts[place] = tile.count(pixel, pixels);
        });
        counts
    }

    /// What was done.
    pub fn statistics(&self) -> Statistics {
        let mut all = Statistics::default();
        for tile in &self.tiles {
            all.merge(tile.statistics());
        }
        all
    }

    fn map(&self, f: impl Fn(&PackedTile, usize, usize) -> Color) -> Image {
        let mut image = Image::black(self.crop.size);
        self.visit(|position, tile, pixel, pixels| image.set(position, f(tile, pixel, pixels)));
        image
    }

    /// Calls a function with the place in the crop of every pixel, its tile, its index there, and the number of pixels of the tile.
    fn visit(&self, mut f: impl FnMut([u32; 2], &PackedTile, usize, usize)) {
        for (tile, packed) in Tile::cover(&self.crop).into_iter().zip(&self.tiles) {
            for (index, pixel) in tile.pixels().enumerate() {
                let place = [0, 1].map(|axis| pixel[axis] - self.crop.offset[axis]);
                f(place, packed, index, tile.area());
            }
        }
    }

    /// The samples of two neighbouring ranges together; `None` where the crops differ, a range is not whole, or one does not end where the
    /// other begins. The result does not depend on which is which.
    pub fn joined(self, other: Self) -> Option<Self> {
        let (first, last) =
            if self.samples.start <= other.samples.start { (self, other) } else { (other, self) };
        let fits = first.crop == last.crop
            && first.samples.end == last.samples.start
            && first.is_whole()
            && last.is_whole();
        fits.then(|| {
            // Tiles of the parts are given back one by one, as those of both are made.
            let tiles = Tile::cover(&first.crop).into_iter().zip(first.tiles).zip(last.tiles);
            let tiles = tiles.map(|((tile, a), b)| Arc::new(a.joined(&b, tile)));
            Self {
                crop: first.crop,
                samples: first.samples.start..last.samples.end,
                tiles: tiles.collect(),
                drawn: first.drawn + last.drawn,
            }
        })
    }

    /// Adds the bytes that [`decode`](Self::decode) reads. They carry no checksum and no version; whoever stores them adds both.
    pub fn encode(&self, bytes: &mut Vec<u8>) {
        bytes.crop(&self.crop);
        bytes.u32(self.samples.start);
        bytes.u32(self.samples.end);
        for (tile, packed) in Tile::cover(&self.crop).into_iter().zip(&self.tiles) {
            packed.write(tile, bytes);
        }
    }

    /// Reads what [`encode`](Self::encode) has written.
    ///
    /// # Errors
    /// Any other bytes that do not happen to be a render. Memory is in proportion to their number, whatever they declare.
    pub fn decode(bytes: &[u8]) -> Result<Self, StateError> {
        let mut reader = Reader::new(bytes);
        let crop = reader.crop()?;
        let samples = reader.u32()?..reader.u32()?;
        if samples.start > samples.end {
            return Err(StateError::new("its samples cannot be"));
        }
        reader.has(Tile::count(&crop), LEAST as u64)?;
        let limit = samples.end - samples.start;
        let tiles = Tile::cover(&crop)
            .into_iter()
            .map(|tile| PackedTile::read(&mut reader, tile, limit).map(Arc::new));
        let tiles = tiles.collect::<Result<Vec<_>, _>>()?;
        reader.end()?;
        let drawn = tiles.iter().map(|tile| u64::from(tile.drawn())).sum();
        Ok(Self { crop, samples, tiles, drawn })
    }
}
