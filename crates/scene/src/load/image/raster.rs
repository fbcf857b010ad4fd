//! PNG, JPEG, BMP, TGA and HDR images.

use alloc::format;
use alloc::vec::Vec;
use std::io::Cursor;
use std::path::Path;

use ::image::{DynamicImage, ImageDecoder as _, ImageError, ImageFormat, ImageReader, Limits};

use crate::error::{Location, SceneError};

use super::super::srgb;
use super::{Encoding, Image, check_size, malformed, most_samples};

pub(super) fn parse(bytes: &[u8], path: &Path, encoding: Encoding) -> Result<Image, SceneError> {
    let fail = |error: ImageError| match error {
        ImageError::Limits(error) => SceneError::resource(Location::file(path), format!("{error}")),
        // Some end with a line break.
        error => malformed(path, format!("{error}").trim_end()),
    };
    let Some(format) = format_of(bytes, path) else {
        let message = "not an image of a known format";
        return Err(
            malformed(path, message).help("known are PNG, JPEG, BMP, TGA, HDR, EXR and PFM")
        );
    };
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::default();
    limits.max_alloc = Some(4 * most_samples(bytes));
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(fail)?;
    let (width, height) = decoder.dimensions();
    let channels = usize::from(decoder.color_type().channel_count());
    check_size(width.into(), height.into(), channels, bytes, path)?;
    let (data, srgb_decoded) = match DynamicImage::from_decoder(decoder).map_err(fail)? {
        DynamicImage::ImageLuma8(i) => integers(&i, channels, encoding),
        DynamicImage::ImageLumaA8(i) => integers(&i, channels, encoding),
        DynamicImage::ImageRgb8(i) => integers(&i, channels, encoding),
        DynamicImage::ImageRgba8(i) => integers(&i, channels, encoding),
        DynamicImage::ImageLuma16(i) => integers(&i, channels, encoding),
        DynamicImage::ImageLumaA16(i) => integers(&i, channels, encoding),
        DynamicImage::ImageRgb16(i) => integers(&i, channels, encoding),
        DynamicImage::ImageRgba16(i) => integers(&i, channels, encoding),
        DynamicImage::ImageRgb32F(i) => (i.into_raw(), false),
        DynamicImage::ImageRgba32F(i) => (i.into_raw(), false),
        _ => return Err(malformed(path, "the type of its samples is not supported")),
    };
    Ok(Image { width, height, channels, data, srgb_decoded })
}

fn format_of(bytes: &[u8], path: &Path) -> Option<ImageFormat> {
    ::image::guess_format(bytes).ok().or_else(|| {
        let extension = path.extension()?;
        extension.eq_ignore_ascii_case("tga").then_some(ImageFormat::Tga)
    })
}

/// An unsigned integer sample.
trait Sample: Copy + Into<u32> {
    const LARGEST: u32;
}

impl Sample for u8 {
    const LARGEST: u32 = 255;
}

impl Sample for u16 {
    const LARGEST: u32 = 65535;
}

/// Samples as floats, through a table of all their values; alpha is never decoded.
fn integers<S: Sample>(samples: &[S], channels: usize, encoding: Encoding) -> (Vec<f32>, bool) {
    let linear: Vec<f32> = (0..=S::LARGEST).map(|i| i as f32 / S::LARGEST as f32).collect();
    let at = |table: &[f32], sample: S| table[sample.into() as usize];
    if encoding == Encoding::Raw {
        return (samples.iter().map(|&s| at(&linear, s)).collect(), false);
    }
    let decoded: Vec<f32> = linear.iter().map(|&x| srgb::decode(x)).collect();
    let colors = if channels.is_multiple_of(2) { channels - 1 } else { channels };
    let data = samples.chunks_exact(channels).flat_map(|pixel| {
        let value = |(c, &s)| if c < colors { at(&decoded, s) } else { at(&linear, s) };
        pixel.iter().enumerate().map(value)
    });
    (data.collect(), true)
}
