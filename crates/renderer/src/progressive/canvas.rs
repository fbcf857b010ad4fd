//! All pixels of a progressive render.

use alloc::sync::Arc;

use etendue_math::Spectrum;
use etendue_scene::Color;
use etendue_scene::film::Crop;

use super::half::Half;
use crate::codec::{Reader, StateError};
use crate::film::Image;
use crate::statistics::Statistics;
use crate::tile::Tile;

/// The two halves of every pixel, tile by tile. Tiles do not change but are replaced, so that a copy is cheap and whole at any time.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Canvas {
    crop: Crop,
    /// In the order of [`Tile::cover`].
    tiles: Vec<Arc<CanvasTile>>,
}

/// The pixels of one tile, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CanvasTile {
    pub(super) pixels: Vec<[Half; 2]>,
    pub(super) statistics: Statistics,
}

impl Canvas {
    /// Pixels without samples.
    pub(super) fn new(crop: Crop) -> Self {
        let tile = |tile: Tile| {
            let pixels = vec![[Half::default(); 2]; tile.area()];
            Arc::new(CanvasTile { pixels, statistics: Statistics::default() })
        };
        Self { crop, tiles: Tile::cover(&crop).into_iter().map(tile).collect() }
    }

    pub(super) fn crop(&self) -> Crop {
        self.crop
    }

    pub(super) fn tile(&self, index: usize) -> Arc<CanvasTile> {
        Arc::clone(&self.tiles[index])
    }

    pub(super) fn replace(&mut self, index: usize, tile: CanvasTile) {
        self.tiles[index] = Arc::new(tile);
    }

    /// What was done.
    pub(super) fn statistics(&self) -> Statistics {
        let mut all = Statistics::default();
        for tile in &self.tiles {
            all.merge(&tile.statistics);
        }
        all
    }

    /// What a function says of every pixel, row by row.
    pub(super) fn map<T: Clone + Default>(&self, f: impl Fn(&[Half; 2]) -> T) -> Vec<T> {
        let mut plane = vec![T::default(); self.crop.size.map(|n| n as usize).iter().product()];
        for (tile, canvas) in Tile::cover(&self.crop).into_iter().zip(&self.tiles) {
            for (pixel, halves) in tile.pixels().zip(&canvas.pixels) {
                plane[index(&self.crop, pixel)] = f(halves);
            }
        }
        plane
    }

    /// The pictures of the two halves.
    pub(super) fn halves(&self) -> [Image; 2] {
        [0, 1].map(|half| {
            let pixels = self.map(|halves| halves[half].mean());
            Image::from_pixels(self.crop.size, pixels)
                .unwrap_or_else(|| Image::black(self.crop.size))
        })
    }

    /// Number of samples of each pixel, row by row.
    pub(super) fn samples(&self) -> Vec<u32> {
        self.map(|halves| halves.iter().map(Half::drawn).sum())
    }

    pub(super) fn write(&self, bytes: &mut Vec<u8>) {
        for tile in &self.tiles {
            tile.statistics.write(bytes);
            for half in tile.pixels.iter().flatten() {
                half.write(bytes);
            }
        }
    }

    /// Reads what [`write`](Self::write) has written of a crop whose pixels are known not to be more than there are bytes.
    pub(super) fn read(crop: Crop, reader: &mut Reader<'_>) -> Result<Self, StateError> {
        let mut tiles = Vec::new();
        for tile in Tile::cover(&crop) {
            let part = Crop { offset: tile.offset, size: tile.size };
            let statistics = Statistics::read(reader, &part)?;
            let mut pixels = Vec::new();
            for _ in tile.pixels() {
                pixels.push([Half::read(reader)?, Half::read(reader)?]);
            }
            tiles.push(Arc::new(CanvasTile { pixels, statistics }));
        }
        Ok(Self { crop, tiles })
    }
}

/// The place of a pixel of the film among those of a crop, row by row.
pub(super) fn index(crop: &Crop, pixel: [u32; 2]) -> usize {
    let [x, y] = [0, 1].map(|axis| (pixel[axis] - crop.offset[axis]) as usize);
    y * crop.size[0] as usize + x
}

/// The mean of two pictures of one size.
pub(super) fn mean(halves: &[Image; 2]) -> Image {
    combine(halves, |a, b| (a + b).scale(0.5))
}

/// An estimate, for every channel of every pixel, of the variance of the mean of two independent
/// pictures: `((a − b) / 2)²`.
pub(super) fn variance(halves: &[Image; 2]) -> Image {
    combine(halves, |a, b| {
        let half = (a + b.scale(-1.0)).scale(0.5);
        half * half
    })
}
fn combine([a, b]: &[Image; 2], f: impl Fn(Color, Color) -> Color) -> Image {
    let pixels = a.pixels().iter().zip(b.pixels()).map(|(&a, &b)| f(a, b)).collect();
    Image::from_pixels(a.size(), pixels).unwrap_or_else(|| Image::black(a.size()))
}
