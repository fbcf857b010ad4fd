//! All pixels of a progressive render.

use std::sync::{Mutex, PoisonError};

use etendue_math::Spectrum;
use etendue_scene::Color;
use etendue_scene::film::Crop;

use super::half::Half;
use crate::film::Image;
use crate::tile::Tile;

/// The two halves of every pixel, tile by tile, so that threads can work on different tiles.
pub(super) struct Canvas {
    crop: Crop,
    pub(super) tiles: Vec<CanvasTile>,
}

/// The pixels of one tile, row by row.
pub(super) struct CanvasTile {
    pub(super) tile: Tile,
    pub(super) pixels: Mutex<Vec<[Half; 2]>>,
}

impl Canvas {
    /// Pixels without samples.
    pub(super) fn new(crop: Crop) -> Self {
        let tile = |tile: Tile| {
            let count = tile.size[0] as usize * tile.size[1] as usize;
            CanvasTile { tile, pixels: Mutex::new(vec![[Half::default(); 2]; count]) }
        };
        Self { crop, tiles: Tile::cover(&crop).into_iter().map(tile).collect() }
    }

    /// The place of a pixel of the film among those of the crop, row by row.
    pub(super) fn index(&self, pixel: [u32; 2]) -> usize {
        let [x, y] = [0, 1].map(|axis| (pixel[axis] - self.crop.offset[axis]) as usize);
        y * self.crop.size[0] as usize + x
    }

    /// What a function says of every pixel, row by row.
    pub(super) fn map<T: Clone + Default>(&self, f: impl Fn(&[Half; 2]) -> T) -> Vec<T> {
        let mut plane = vec![T::default(); self.crop.size.map(|n| n as usize).iter().product()];
        for tile in &self.tiles {
            // A lock is poisoned by a panic outside of it, such as of a report.
            let pixels = tile.pixels.lock().unwrap_or_else(PoisonError::into_inner);
            for (pixel, halves) in tile.tile.pixels().zip(pixels.iter()) {
                plane[self.index(pixel)] = f(halves);
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
