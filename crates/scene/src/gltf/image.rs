//! Images, decoded once however many textures look at them.

use alloc::borrow::Cow;
use alloc::format;
use alloc::vec::Vec;
use std::path::{Path, PathBuf};

use super::buffers::Buffers;
use super::json::Json;
use super::uri::{Resource, fetch};
use crate::SceneError;
use crate::load::{Encoding, parse_image, srgb};
use crate::texture::{BitmapError, BitmapImage};

/// An image as it is encoded.
#[derive(Debug)]
pub(super) struct Pixels {
    width: u32,
    height: u32,
    /// 1 to 4; where there are 2 or 4 the last is opacity.
    channels: usize,
    samples: Samples,
}

/// Samples, `width · height · channels` of them.
#[derive(Debug)]
enum Samples {
    Bytes(Vec<u8>),
    /// In [0, 1], of images of 16 bits.
    Floats(Vec<f32>),
}

/// Reads an image of the document; `files` gets its path if it is a file of its own.
///
/// # Errors
/// What cannot be fetched, or is neither PNG nor JPEG.
pub(super) fn read(
    buffers: &Buffers<'_>,
    json: &Json<'_>,
    files: &mut Vec<PathBuf>,
) -> Result<Pixels, SceneError> {
    let resource = match json.get("uri")? {
        Some(uri) => Some(fetch(&uri, buffers.document())?),
        None => None,
    };
    let document = buffers.document().file();
    let (path, bytes): (Cow<'_, Path>, Cow<'_, [u8]>) = match resource {
        Some(Resource::File(path, bytes)) => {
            files.push(path.clone());
            (path.into(), bytes.into())
        }
        Some(Resource::Data(bytes)) => (document.into(), bytes.into()),
        None => match buffers.view(json, "bufferView")? {
            Some(view) => (document.into(), view.bytes.into()),
            None => return Err(json.error("has neither “uri” nor “bufferView”")),
        },
    };
    if !matches!(*bytes, [0x89, b'P', b'N', b'G', ..] | [0xff, 0xd8, 0xff, ..]) {
        let error = json.error("is neither PNG nor JPEG");
        return Err(error.help("convert it; glTF knows no other images"));
    }
    let image = parse_image(&bytes, &path, Encoding::Raw).map_err(|mut error| {
        error.message = format!("{} ({})", error.message, json.place());
        error
    })?;
    buffers.unfold(&path, size_of_val(image.data()), json)?;
    let (width, height, channels) = (image.width(), image.height(), image.channels());
    Ok(Pixels { width, height, channels, samples: Samples::of(image.into_data()) })
}

impl Samples {
    /// Samples that are bytes are kept as such: a quarter of the memory, and the same numbers.
    fn of(data: Vec<f32>) -> Self {
        let byte = |&x: &f32| {
            let byte = (x * 255.0).round();
            ((0.0..=255.0).contains(&byte) && byte / 255.0 == x).then_some(byte as u8)
        };
        match data.iter().map(byte).collect() {
            Some(bytes) => Self::Bytes(bytes),
            None => Self::Floats(data),
        }
    }

    fn get(&self, index: usize) -> f32 {
        match self {
            Self::Bytes(bytes) => f32::from(bytes[index]) / 255.0,
            Self::Floats(floats) => floats[index],
        }
    }
}

impl Pixels {
    /// Whether there is an opacity.
    pub(super) fn has_alpha(&self) -> bool {
        self.channels.is_multiple_of(2)
    }

    /// Colours in sRGB encoding.
    pub(super) fn color(&self) -> Result<BitmapImage, BitmapError> {
        let Self { width, height, channels, .. } = *self;
        match &self.samples {
            Samples::Bytes(bytes) => BitmapImage::from_srgb8(width, height, channels as u32, bytes),
            Samples::Floats(floats) => {
                let linear: Vec<f32> = floats.iter().map(|&x| srgb::decode(x)).collect();
                BitmapImage::from_f32(width, height, channels as u32, &linear)
            }
        }
    }

    /// One channel as plain numbers: 0 to 2 of the colour, 3 for the opacity.
    pub(super) fn channel(&self, channel: usize) -> Result<BitmapImage, BitmapError> {
        let place = self.place(channel);
        let stride = self.channels;
        match &self.samples {
            Samples::Bytes(bytes) => {
                let values: Vec<u8> = bytes.iter().skip(place).step_by(stride).copied().collect();
                BitmapImage::from_linear8(self.width, self.height, 1, &values)
            }
            Samples::Floats(_) => self.mapped(channel, |x| x),
        }
    }

    /// A function of one channel.
    pub(super) fn mapped(
        &self,
        channel: usize,
        map: impl Fn(f32) -> f32,
    ) -> Result<BitmapImage, BitmapError> {
        let place = self.place(channel);
        let pixels = 0..self.width as usize * self.height as usize;
        let value = |pixel| map(self.samples.get(pixel * self.channels + place));
        let values: Vec<f32> = pixels.map(value).collect();
        BitmapImage::from_f32(self.width, self.height, 1, &values)
    }

    /// Directions `(n + 1)/2`, flattened by `scale` along x and y.
    ///
    /// ```text
    /// n' ∝ (s x, ± s y, z),   in [−1, 1]³ for any s: where s > 1, z is divided by it instead
    /// ```
    pub(super) fn normals(
        &self,
        scale: f32,
        is_mirrored: bool,
    ) -> Result<BitmapImage, BitmapError> {
        let sign = if is_mirrored { -1.0 } else { 1.0 };
        let flat = scale.abs().min(1.0) * scale.signum();
        let factors = [flat, sign * flat, 1.0 / scale.abs().max(1.0)];
        let Self { width, height, channels, ref samples } = *self;
        if let (Samples::Bytes(bytes), true) = (samples, factors == [1.0; 3]) {
            return BitmapImage::from_linear8(width, height, channels as u32, bytes);
        }
        let texels = (0..width as usize * height as usize).flat_map(|pixel| {
            [0, 1, 2].map(|c| {
                let encoded = samples.get(pixel * channels + self.place(c));
                0.5 + factors[c] * (encoded - 0.5)
            })
        });
        BitmapImage::from_f32(width, height, 3, &texels.collect::<Vec<f32>>())
    }

    /// Where a channel lies in a pixel; grey is every colour.
    fn place(&self, channel: usize) -> usize {
        match (channel, self.channels) {
            (3, channels) => channels - 1,
            (_, 1 | 2) => 0,
            (channel, _) => channel,
        }
    }
}
