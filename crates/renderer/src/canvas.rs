//! All pixels of a render that is more than sums.

use alloc::sync::Arc;

use etendue_scene::film::Crop;

use crate::codec::{Reader, StateError};
use crate::statistics::Statistics;
use crate::tile::Tile;

/// What is known of one pixel, and how it is stored.
pub(crate) trait CanvasPixel: Copy + Default {
    /// Bytes of a pixel.
    const BYTES: u64;

    fn write(&self, bytes: &mut Vec<u8>);

    /// Reads what [`write`](Self::write) has written.
    fn read(reader: &mut Reader<'_>) -> Result<Self, StateError>;
}

/// Every pixel of a crop, tile by tile. Tiles do not change but are replaced, so that a copy is cheap and whole at any time.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Canvas<P> {
    crop: Crop,
    /// In the order of [`Tile::cover`].
    tiles: Vec<Arc<CanvasTile<P>>>,
}

/// The pixels of one tile, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CanvasTile<P> {
    pub(crate) pixels: Vec<P>,
    pub(crate) statistics: Statistics,
}

impl<P: CanvasPixel> Canvas<P> {
    /// Pixels without samples.
    pub(crate) fn new(crop: Crop) -> Self {
        let tile = |tile: Tile| {
            let pixels = vec![P::default(); tile.area()];
            Arc::new(CanvasTile { pixels, statistics: Statistics::default() })
        };
        Self { crop, tiles: Tile::cover(&crop).into_iter().map(tile).collect() }
    }

    pub(crate) fn crop(&self) -> Crop {
        self.crop
    }

    pub(crate) fn tile(&self, index: usize) -> Arc<CanvasTile<P>> {
        Arc::clone(&self.tiles[index])
    }

    pub(crate) fn replace(&mut self, index: usize, tile: CanvasTile<P>) {
        self.tiles[index] = Arc::new(tile);
    }

    /// What was done.
    pub(crate) fn statistics(&self) -> Statistics {
        let mut all = Statistics::default();
        for tile in &self.tiles {
            all.merge(&tile.statistics);
        }
        all
    }

    /// What a function says of every pixel, row by row.
    pub(crate) fn map<T: Clone + Default>(&self, f: impl Fn(&P) -> T) -> Vec<T> {
        let mut plane = vec![T::default(); self.crop.size.map(|n| n as usize).iter().product()];
        for (tile, canvas) in Tile::cover(&self.crop).into_iter().zip(&self.tiles) {
            for (place, pixel) in tile.pixels().zip(&canvas.pixels) {
                plane[index(&self.crop, place)] = f(pixel);
            }
        }
        plane
    }

    pub(crate) fn write(&self, bytes: &mut Vec<u8>) {
        for tile in &self.tiles {
            tile.statistics.write(bytes);
            for pixel in &tile.pixels {
                pixel.write(bytes);
            }
        }
    }

    /// Reads what [`write`](Self::write) has written of a crop whose pixels are known not to be more than there are bytes.
    pub(crate) fn read(crop: Crop, reader: &mut Reader<'_>) -> Result<Self, StateError> {
        let mut tiles = Vec::new();
        for tile in Tile::cover(&crop) {
            let statistics = Statistics::read(reader, &tile.into())?;
            let mut pixels = Vec::new();
            for _ in tile.pixels() {
                pixels.push(P::read(reader)?);
            }
            tiles.push(Arc::new(CanvasTile { pixels, statistics }));
        }
        Ok(Self { crop, tiles })
    }
}

/// The place of a pixel of the film among those of a crop, row by row.
pub(crate) fn index(crop: &Crop, pixel: [u32; 2]) -> usize {
    let [x, y] = [0, 1].map(|axis| (pixel[axis] - crop.offset[axis]) as usize);
    y * crop.size[0] as usize + x
}
