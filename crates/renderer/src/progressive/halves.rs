//! The pictures of the two halves of a render's samples.

use etendue_math::Spectrum;
use etendue_scene::Color;

use super::half::Half;
use crate::canvas::{Canvas, CanvasPixel};
use crate::codec::{Reader, StateError};
use crate::film::Image;

impl CanvasPixel for [Half; 2] {
    const BYTES: u64 = 2 * Half::BYTES;

    fn write(&self, bytes: &mut Vec<u8>) {
        for half in self {
            half.write(bytes);
        }
    }

    fn read(reader: &mut Reader<'_>) -> Result<Self, StateError> {
        Ok([Half::read(reader)?, Half::read(reader)?])
    }
}

/// The pictures of the two halves.
pub(super) fn halves(canvas: &Canvas<[Half; 2]>) -> [Image; 2] {
    let size = canvas.crop().size;
    [0, 1].map(|half| {
        let pixels = canvas.map(|halves| halves[half].mean());
        Image::from_pixels(size, pixels).unwrap_or_else(|| Image::black(size))
    })
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
