//! Pictures in memory.

use etendue_math::Spectrum;
use etendue_scene::Color;

/// A picture of linear Rec. 709 radiance, rows from top to bottom.
///
/// # Examples
/// ```
/// use etendue_renderer::Image;
/// let mut image = Image::black([2, 1]);
/// image.set([1, 0], [0.5, 0.25, 0.0].into());
/// assert_eq!(image.pixel([1, 0]).g, 0.25);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    size: [u32; 2],
    pixels: Vec<Color>,
}

impl Image {
    /// A black picture of `size` = [width, height] pixels.
    pub fn black(size: [u32; 2]) -> Self {
        Self { size, pixels: vec![Color::black(); size[0] as usize * size[1] as usize] }
    }

    /// A picture from its pixels, row by row from the top; `None` where their number is not
    /// width times height.
    pub fn from_pixels(size: [u32; 2], pixels: Vec<Color>) -> Option<Self> {
        (pixels.len() as u64 == u64::from(size[0]) * u64::from(size[1]))
            .then_some(Self { size, pixels })
    }

    /// Width in pixels.
    pub fn width(&self) -> u32 {
        self.size[0]
    }

    /// Height in pixels.
    pub fn height(&self) -> u32 {
        self.size[1]
    }

    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// All pixels, row by row from the top.
    pub fn pixels(&self) -> &[Color] {
        &self.pixels
    }

    /// The pixel in column `x` and row `y`; black outside the picture.
    pub fn pixel(&self, position: [u32; 2]) -> Color {
        self.index(position).map_or(Color::black(), |i| self.pixels[i])
    }

    /// Replaces the pixel in column `x` and row `y`; does nothing outside the picture.
    pub fn set(&mut self, position: [u32; 2], color: Color) {
        if let Some(i) = self.index(position) {
            self.pixels[i] = color;
        }
    }

    /// Mean of all pixels, summed in `f64`; black for an empty picture.
    pub fn mean(&self) -> Color {
        let mut sum = [0.0_f64; 3];
        for pixel in &self.pixels {
            for (s, c) in sum.iter_mut().zip(pixel.to_array()) {
                *s += f64::from(c);
            }
        }
        let count = self.pixels.len().max(1) as f64;
        sum.map(|s| (s / count) as f32).into()
    }

    fn index(&self, [x, y]: [u32; 2]) -> Option<usize> {
        (x < self.size[0] && y < self.size[1])
            .then_some(y as usize * self.size[0] as usize + x as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_outside_the_picture_are_black_and_cannot_be_set() {
        let mut image = Image::black([2, 2]);
        image.set([2, 0], Color::white());
        assert_eq!(image, Image::black([2, 2]));
        assert_eq!(image.pixel([0, 2]), Color::black());
    }

    #[test]
    fn a_picture_needs_as_many_pixels_as_its_size_says() {
        assert_eq!(Image::from_pixels([2, 2], vec![Color::black(); 3]), None);
        assert_eq!(Image::from_pixels([u32::MAX, u32::MAX], Vec::new()), None);
    }
}
