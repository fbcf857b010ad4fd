//! An image in halved sizes.

use alloc::vec::Vec;

use etendue_math::{Real, Spectrum};

use super::{BitmapImage, Wrap};
use crate::Color;

/// The images that are made of another by halving it again and again, down to a single texel.
///
/// # Source
/// L. Williams, "Pyramidal Parametrics", SIGGRAPH 1983.
#[derive(Clone, Debug)]
pub(super) struct Pyramid {
    /// From half the size on.
    levels: Vec<BitmapImage>,
}

impl Pyramid {
    pub(super) fn new(image: &BitmapImage) -> Self {
        let mut levels = Vec::new();
        let mut last = image;
        while last.width() > 1 || last.height() > 1 {
            let Some(half) = halved(last) else { break };
            levels.push(half);
            last = &levels[levels.len() - 1];
        }
        Self { levels }
    }

    /// The colour at coordinates of the unit square, of an image whose texels are as large as what is looked at, which covers
    /// `texels` of the original in its larger extent: linear in place and between two levels.
    ///
    /// At most one texel, or NaN, is the original.
    pub(super) fn color(
        &self,
        original: &BitmapImage,
        [u, v]: [f32; 2],
        texels: f32,
        wrap: [Wrap; 2],
    ) -> Color {
        let at = |level: usize| {
            let image = level.checked_sub(1).map_or(original, |i| &self.levels[i]);
            let place = [u * image.width() as f32 - 0.5, v * image.height() as f32 - 0.5];
            image.bilinear(place, wrap)
        };
        // NaN is no maximum.
        let level = Real::ln(texels.max(1.0)) / core::f32::consts::LN_2;
        let level = level.min(self.levels.len() as f32);
        if level == 0.0 {
            return at(0);
        }
        let (below, fraction) = (level as usize, level - Real::floor(level));
        let above = (below + 1).min(self.levels.len());
        at(below).scale(1.0 - fraction) + at(above).scale(fraction)
    }
}

/// An image of half the size, rounded up: means of two by two texels, of which the last stands for one that is missing.
fn halved(image: &BitmapImage) -> Option<BitmapImage> {
    let [width, height] = [image.width(), image.height()].map(|size| size.div_ceil(2));
    let mut texels = Vec::new();
    for row in 0..height {
        for column in 0..width {
            let mut sum = Color::black();
            for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let x = (2 * column + x).min(image.width() - 1);
                let y = (2 * row + y).min(image.height() - 1);
                sum += image.texel(x, y);
            }
            texels.extend(sum.scale(0.25).to_array());
        }
    }
    BitmapImage::from_f32(width, height, 3, &texels).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wide_look_sees_the_mean_and_a_narrow_one_the_texel() {
        let texels: Vec<f32> = (0..64).map(|i| f32::from((i + i / 8) % 2 == 0)).collect();
        let image = BitmapImage::from_f32(8, 8, 1, &texels).expect("64 texels");
        let pyramid = Pyramid::new(&image);
        assert_eq!(pyramid.levels.len(), 3);
        let at = |texels| pyramid.color(&image, [0.3125, 0.4375], texels, [Wrap::Repeat; 2]).r;
        // The middle of a texel of the pattern; means of two by two of it are all the same.
        assert!(at(1.0) == 0.0 || at(1.0) == 1.0);
        assert_eq!(at(f32::NAN), at(0.5));
        for wide in [2.0, 3.0, 8.0, 1e9] {
            assert_eq!(at(wide), 0.5);
        }
        // Halfway between two levels, in the logarithm.
        let halfway = at(core::f32::consts::SQRT_2);
        assert!((halfway - 0.5 * (at(1.0) + 0.5)).abs() < 1e-6, "{halfway}");
    }

    #[test]
    fn odd_sizes_are_halved_to_the_end() {
        let image = BitmapImage::from_f32(5, 1, 1, &[1.0, 1.0, 1.0, 1.0, 3.0]).expect("5 texels");
        let pyramid = Pyramid::new(&image);
        let sizes: Vec<u32> = pyramid.levels.iter().map(BitmapImage::width).collect();
        assert_eq!(sizes, [3, 2, 1]);
        assert_eq!(pyramid.levels[0].texel(2, 0).r, 3.0);
    }
}
