//! Images: PNG, JPEG, BMP, TGA, HDR, EXR and PFM.
//!
//! The format is told by the content; TGA, which has no signature, by the extension. Colour
//! profiles, gamma chunks, chromaticities and orientation tags are ignored: encoded formats are
//! taken as sRGB, float formats as linear Rec. 709.

mod exr;
mod pfm;
mod raster;

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::panic::AssertUnwindSafe;
use std::panic::catch_unwind;
use std::path::Path;

use crate::error::{Location, SceneError};

use super::file::read_asset;

/// An image of one to four channels: grey, grey and alpha, RGB, RGB and alpha.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    width: u32,
    height: u32,
    channels: usize,
    data: Vec<f32>,
    srgb_decoded: bool,
}

impl Image {
    /// Pixels per row.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Channels per pixel, 1 to 4. Where there are 2 or 4 the last is alpha.
    pub fn channels(&self) -> usize {
        self.channels
    }

    /// The samples, `width · height · channels` of them: top row first, left pixel first, channels
    /// of a pixel together. Integer formats are in [0, 1]; float formats hold what the file holds,
    /// NaN and infinities included.
    pub fn data(&self) -> &[f32] {
        &self.data
    }

    /// The samples, as [`data`](Self::data).
    pub fn into_data(self) -> Vec<f32> {
        self.data
    }

    /// Whether colours were decoded from sRGB to linear light.
    pub fn srgb_decoded(&self) -> bool {
        self.srgb_decoded
    }

    /// How many samples are NaN or infinite.
    pub fn non_finite(&self) -> usize {
        self.data.iter().filter(|x| !x.is_finite()).count()
    }
}

/// What the samples of 8- and 16-bit formats mean. Float formats are linear either way, and so is
/// alpha.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Colours in sRGB encoding, decoded to linear light.
    Srgb,
    /// Plain numbers, such as normals and roughnesses, only scaled to [0, 1].
    Raw,
}

/// An image file.
///
/// # Errors
/// A file that cannot be read, and everything [`parse_image`] refuses.
pub fn load_image(path: &Path, encoding: Encoding) -> Result<Image, SceneError> {
    parse_image(&read_asset(path)?, path, encoding)
}

/// The content of an image file. `path` stands in messages; its extension counts for TGA only.
///
/// Of an EXR file the first flat layer is read, in its data window: the channels `R G B A`, `Y A`,
/// those of the first named group that has them, or the only one.
///
/// # Errors
/// An unknown format; malformed or truncated content; EXR files with subsampled or deep data only,
/// or whose channels are no colour; [`ErrorKind::Resource`](crate::ErrorKind::Resource) for more
/// than 2²⁸ pixels, or samples that are out of all proportion to the file.
///
/// # Examples
/// ```
/// use std::path::Path;
/// use etendue_scene::load::{Encoding, parse_image};
/// let file = b"Pf 2 1 -1.0\n\0\0\x80\x3f\0\0\0\x40";
/// let image = parse_image(file, Path::new("ramp.pfm"), Encoding::Srgb)?;
/// assert_eq!(image.data(), [1.0, 2.0]);
/// # Ok::<(), etendue_scene::SceneError>(())
/// ```
pub fn parse_image(bytes: &[u8], path: &Path, encoding: Encoding) -> Result<Image, SceneError> {
    match bytes {
        [b'P', b'F' | b'f', ..] => pfm::parse(bytes, path),
        [0x76, 0x2f, 0x31, 0x01, ..] => guarded(path, || exr::parse(bytes, path)),
        _ => guarded(path, || raster::parse(bytes, path, encoding)),
    }
}

/// Runs a third-party decoder. Those in use aim at returning errors, and are given only content
/// whose declared size is checked; but they are large, index unchecked in places, and a panic in
/// one must not take a render down. They only read `bytes`, so that nothing half-changed survives.
fn guarded(
    path: &Path,
    decode: impl FnOnce() -> Result<Image, SceneError>,
) -> Result<Image, SceneError> {
    catch_unwind(AssertUnwindSafe(decode))
        .unwrap_or_else(|_| Err(malformed(path, "the decoder failed on malformed content")))
}

fn malformed(path: &Path, message: impl Into<String>) -> SceneError {
    SceneError::scene(Location::file(path), message)
}

/// The most pixels of an image.
const MOST_PIXELS: u64 = 1 << 28;

/// A file of N bytes may unfold to `FREE + RATIO · N` samples: a 4096² RGBA image of one colour is
/// allowed, while a kilobyte cannot ask for gigabytes.
const FREE: u64 = 1 << 26;
const RATIO: u64 = 64;

/// No file holds more samples per byte: deflate yields at most 1032 bytes for one, each of eight samples of a bit; JPEG a block of 64
/// for a bit, run lengths fewer.
const MOST_PER_BYTE: u64 = 8 * 1032;

/// How many samples a file of so many bytes may hold.
fn most_samples(bytes: &[u8]) -> u64 {
    let length = bytes.len() as u64;
    (FREE + RATIO * length).min(MOST_PER_BYTE * length)
}

/// Checks declared dimensions before anything is allocated for them.
fn check_size(
    width: u64,
    height: u64,
    channels: usize,
    bytes: &[u8],
    path: &Path,
) -> Result<(), SceneError> {
    if width == 0 || height == 0 {
        return Err(malformed(path, format!("the image has {width} × {height} pixels")));
    }
    let pixels = width.saturating_mul(height);
    let samples = pixels.saturating_mul(channels as u64);
    let allowed = most_samples(bytes);
    let message = if pixels > MOST_PIXELS {
        format!("{width} × {height} pixels are more than the {MOST_PIXELS} allowed")
    } else if samples > allowed {
        format!("{samples} samples are more than the {allowed} allowed for a file of this size")
    } else {
        return Ok(());
    };
    Err(SceneError::resource(Location::file(path), message))
}

#[cfg(test)]
mod tests;
