//! The texels of a bitmap.

use alloc::boxed::Box;
use alloc::vec::Vec;

use etendue_math::{Real, Rgb, Spectrum};

use super::Wrap;
use crate::Color;

/// Why texels are refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BitmapError {
    /// There is no texel, or there are more than can be numbered.
    #[error("an image of {0} × {1} texels cannot be used")]
    Size(u32, u32),
    /// Only 1 (grey), 2 (grey, opacity), 3 (RGB) and 4 (RGB, opacity) channels have a meaning.
    #[error("an image of {0} channels cannot be used, only one of 1 to 4")]
    Channels(u32),
    /// Size and data disagree.
    #[error("{found} values instead of {expected}")]
    Length {
        /// Width × height × channels.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A value is NaN or infinite.
    #[error("the texel in column {column}, row {row} is not finite")]
    NotFinite {
        /// Counted from 0, from the left.
        column: u32,
        /// Counted from 0, from the top.
        row: u32,
    },
}

/// A grid of linear colours, rows from top to bottom: finite and not negative.
///
/// Images of 8 bits keep their bytes, with a table from byte to linear value, so that a texture
/// takes as much memory as its file's pixels.
#[derive(Clone, Debug)]
pub struct BitmapImage {
    width: u32,
    height: u32,
    texels: Texels,
}

#[derive(Clone, Debug)]
enum Texels {
    Grey8 { texels: Vec<u8>, decode: Box<[f32; 256]> },
    Rgb8 { texels: Vec<[u8; 3]>, decode: Box<[f32; 256]> },
    Grey(Vec<f32>),
    Rgb(Vec<[f32; 3]>),
}

impl BitmapImage {
    /// An image of sRGB-encoded bytes, 1 to 4 channels interleaved; the second or fourth, opacity,
    /// is dropped.
    ///
    /// ```text
    /// linear = s / 12.92 for s ≤ 0.04045, else ((s + 0.055) / 1.055)^2.4,  s = byte / 255
    /// ```
    ///
    /// # Errors
    /// A size of 0, another number of channels, another number of bytes than these make.
    ///
    /// # Source
    /// IEC 61966-2-1.
    pub fn from_srgb8(
        width: u32,
        height: u32,
        channels: u32,
        data: &[u8],
    ) -> Result<Self, BitmapError> {
        Self::from_bytes(width, height, channels, data, |s| {
            if s <= 0.04045 { s / 12.92 } else { Real::powf((s + 0.055) / 1.055, 2.4) }
        })
    }

    /// An image of bytes that are linear already, as `byte / 255`; otherwise [`Self::from_srgb8`].
    ///
    /// # Errors
    /// As [`Self::from_srgb8`].
    pub fn from_linear8(
        width: u32,
        height: u32,
        channels: u32,
        data: &[u8],
    ) -> Result<Self, BitmapError> {
        Self::from_bytes(width, height, channels, data, |s| s)
    }

    fn from_bytes(
        width: u32,
        height: u32,
        channels: u32,
        data: &[u8],
        decode: impl Fn(f64) -> f64,
    ) -> Result<Self, BitmapError> {
        check(width, height, channels, data.len())?;
        let stride = channels as usize;
        let decode = Box::new(core::array::from_fn(|byte| decode(byte as f64 / 255.0) as f32));
        let texels = if channels < 3 {
            Texels::Grey8 { texels: data.iter().step_by(stride).copied().collect(), decode }
        } else {
            Texels::Rgb8 {
                texels: data.chunks_exact(stride).map(|t| [t[0], t[1], t[2]]).collect(),
                decode,
            }
        };
        Ok(Self { width, height, texels })
    }

    /// An image of linear values, 1 to 4 channels interleaved; the second or fourth, opacity, is
    /// dropped. Negative values, which resampling leaves in real files, are stored as 0.
    ///
    /// # Errors
    /// As [`Self::from_srgb8`], and a value that is NaN or infinite.
    pub fn from_f32(
        width: u32,
        height: u32,
        channels: u32,
        data: &[f32],
    ) -> Result<Self, BitmapError> {
        check(width, height, channels, data.len())?;
        let stride = channels as usize;
        let colors = if channels < 3 { 1 } else { 3 };
        let bad = |texel: &[f32]| texel[..colors].iter().any(|x| !x.is_finite());
        if let Some(index) = data.chunks_exact(stride).position(bad) {
            let (column, row) = (index as u32 % width, index as u32 / width);
            return Err(BitmapError::NotFinite { column, row });
        }
        let texels = if colors == 1 {
            Texels::Grey(data.iter().step_by(stride).map(|x| x.max(0.0)).collect())
        } else {
            let rgb = |t: &[f32]| [t[0].max(0.0), t[1].max(0.0), t[2].max(0.0)];
            Texels::Rgb(data.chunks_exact(stride).map(rgb).collect())
        };
        Ok(Self { width, height, texels })
    }

    /// Memory of the texels.
    #[cfg(feature = "std")]
    pub(crate) fn bytes(&self) -> usize {
        match &self.texels {
            Texels::Grey8 { texels, .. } => size_of_val(&**texels),
            Texels::Rgb8 { texels, .. } => size_of_val(&**texels),
            Texels::Grey(texels) => size_of_val(&**texels),
            Texels::Rgb(texels) => size_of_val(&**texels),
        }
    }

    /// Number of columns.
    #[inline]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Number of rows.
    #[inline]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Whether it has no colours.
    pub fn is_grey(&self) -> bool {
        matches!(self.texels, Texels::Grey8 { .. } | Texels::Grey(_))
    }

    /// The linear colour of a texel; the last column or row for larger indices.
    #[inline]
    pub fn texel(&self, column: u32, row: u32) -> Color {
        let column = column.min(self.width - 1) as usize;
        let index = row.min(self.height - 1) as usize * self.width as usize + column;
        match &self.texels {
            Texels::Grey8 { texels, decode } => Color::splat(decode[texels[index] as usize]),
            Texels::Rgb8 { texels, decode } => {
                Color::from(texels[index].map(|byte| decode[byte as usize]))
            }
            Texels::Grey(texels) => Color::splat(texels[index]),
            Texels::Rgb(texels) => Color::from(texels[index]),
        }
    }

    /// A texel of the image continued beyond its borders, in columns and in rows.
    #[inline]
    pub(crate) fn wrapped(&self, column: i32, row: i32, [x, y]: [Wrap; 2]) -> Color {
        self.texel(x.apply(column, self.width), y.apply(row, self.height))
    }

    /// The colour between texels: at integer `x` and `y` it is that of column x and row y.
    #[inline]
    pub(crate) fn bilinear(&self, [x, y]: [f32; 2], wrap: [Wrap; 2]) -> Color {
        let (column, fx) = split(x);
        let (row, fy) = split(y);
        let beside = |i: i32| [i, i.saturating_add(1)];
        let [left, right] = beside(column).map(|column| wrap[0].apply(column, self.width));
        let [above, below] = beside(row).map(|row| wrap[1].apply(row, self.height));
        let [above, below] = [above, below].map(|row| row as usize * self.width as usize);
        let [left, right] = [left as usize, right as usize];
        let mix = |texel: &dyn Fn(usize) -> Color| {
            let between = |row| texel(row + left) * (1.0 - fx) + texel(row + right) * fx;
            between(above) * (1.0 - fy) + between(below) * fy
        };
        // One choice of the format for all four.
        match &self.texels {
            Texels::Grey8 { texels, decode } => mix(&|i| Color::splat(decode[texels[i] as usize])),
            Texels::Rgb8 { texels, decode } => {
                mix(&|i| Color::from(texels[i].map(|byte| decode[byte as usize])))
            }
            Texels::Grey(texels) => mix(&|i| Color::splat(texels[i])),
            Texels::Rgb(texels) => mix(&|i| Color::from(texels[i])),
        }
    }

    /// How [`bilinear`](Self::bilinear) changes with `x` and with `y`, per texel.
    pub(crate) fn bilinear_gradient(&self, [x, y]: [f32; 2], wrap: [Wrap; 2]) -> [Color; 2] {
        let (column, fx) = split(x);
        let (row, fy) = split(y);
        let (right, below) = (column.saturating_add(1), row.saturating_add(1));
        let [a, b] = [column, right].map(|column| self.wrapped(column, row, wrap));
        let [c, d] = [column, right].map(|column| self.wrapped(column, below, wrap));
        [(b - a) * (1.0 - fy) + (d - c) * fy, (c - a) * (1.0 - fx) + (d - b) * fx]
    }

    fn colors(&self) -> impl Iterator<Item = Color> {
        (0..self.height)
            .flat_map(move |row| (0..self.width).map(move |column| self.texel(column, row)))
    }

    /// The mean over all texels.
    pub fn mean(&self) -> Color {
        let widen = |c: Color| Rgb::new(f64::from(c.r), f64::from(c.g), f64::from(c.b));
        let sum = self.colors().fold(Rgb::<f64>::black(), |sum, c| sum + widen(c));
        let mean = sum * (1.0 / (f64::from(self.width) * f64::from(self.height)));
        Color::new(mean.r as f32, mean.g as f32, mean.b as f32)
    }

    /// The largest value of each channel.
    pub fn max(&self) -> Color {
        self.colors().fold(Color::black(), |max, c| max.zip(c, f32::max))
    }
}

/// The integer below and the fraction above it, which is 0 for what is not finite.
#[inline]
pub(crate) fn split(x: f32) -> (i32, f32) {
    let below = Real::floor(x);
    (below as i32, Real::clamp_to(x - below, 0.0, 1.0))
}

fn check(width: u32, height: u32, channels: u32, found: usize) -> Result<(), BitmapError> {
    // Texels are numbered with 31 bits, so that look-ups can count below 0.
    let countable = 1..=i32::MAX as u32;
    let texels = width.checked_mul(height).filter(|n| countable.contains(n));
    let texels = texels.ok_or(BitmapError::Size(width, height))?;
    if !(1..=4).contains(&channels) {
        return Err(BitmapError::Channels(channels));
    }
    let expected = texels as usize * channels as usize;
    if found == expected { Ok(()) } else { Err(BitmapError::Length { expected, found }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_decoded_and_opacity_is_dropped() {
        let image = BitmapImage::from_srgb8(1, 2, 4, &[255, 0, 188, 7, 10, 20, 30, 9]);
        let top = image.as_ref().map(|i| i.texel(0, 0).to_array());
        // sRGB 188 is 0.5029 linear (IEC 61966-2-1), rounded to f32.
        assert_eq!(top, Ok([1.0, 0.0, 0.502_886_5]));
        let grey = BitmapImage::from_linear8(1, 1, 2, &[51, 255]).map(|i| i.texel(0, 0));
        assert_eq!(grey, Ok(Color::splat(0.2)));
    }

    #[test]
    fn wrong_sizes_and_values_are_refused() {
        let refused = |w, h, c, data: &[f32]| BitmapImage::from_f32(w, h, c, data).err();
        assert_eq!(refused(0, 1, 3, &[]), Some(BitmapError::Size(0, 1)));
        assert_eq!(refused(u32::MAX, 2, 1, &[]), Some(BitmapError::Size(u32::MAX, 2)));
        assert_eq!(refused(1, 1, 5, &[0.0; 5]), Some(BitmapError::Channels(5)));
        let short = BitmapError::Length { expected: 3, found: 2 };
        assert_eq!(refused(1, 1, 3, &[0.0; 2]), Some(short));
        let nan = BitmapError::NotFinite { column: 1, row: 0 };
        assert_eq!(refused(2, 1, 1, &[0.0, f32::NAN]), Some(nan));
        // An opacity nobody reads may be anything.
        assert_eq!(refused(1, 1, 2, &[0.5, f32::NAN]), None);
    }

    #[test]
    fn mean_and_maximum_are_per_channel_and_negative_values_are_zero() {
        let image = BitmapImage::from_f32(2, 1, 3, &[1.0, 0.5, -3.0, 0.0, 1.5, 0.25]);
        assert_eq!(image.as_ref().map(BitmapImage::mean), Ok(Color::new(0.5, 1.0, 0.125)));
        assert_eq!(image.as_ref().map(BitmapImage::max), Ok(Color::new(1.0, 1.5, 0.25)));
    }
}
