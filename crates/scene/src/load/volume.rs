//! Mitsuba's volume files, format version 3.
//!
//! ```text
//! "VOL", u8 version 3, i32 encoding 1 (f32), i32 cells along x, y, z, i32 channels,
//! f32 box: x, y, z at least, x, y, z at most, then f32 values: channels, then x, then y, then z
//! ```
//!
//! All numbers are little endian. What follows the values is read over.
//!
//! # Source
//! Mitsuba 3, `src/render/volumegrid.cpp`.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use std::path::Path;

use etendue_math::glam::Vec3;

use super::file::read_asset;
use crate::error::{Location, SceneError};
use crate::geometry::{Aabb, SdfSamples};
use crate::medium::VolumeGrid;

/// A volume file.
#[derive(Clone, Debug)]
pub struct VolumeFile {
    /// Its values.
    pub grid: VolumeGrid,
    /// Where the file says that they are; not checked.
    pub bounds: Aabb,
}

const HEADER: usize = 48;

/// The grid of a volume file, as the density of a medium or a texture.
///
/// # Errors
/// A file that cannot be read, and everything [`parse_volume`] refuses.
pub fn load_volume(path: &Path) -> Result<VolumeFile, SceneError> {
    parse_volume(&read_asset(path)?, path)
}

/// The grid of the bytes of a volume file. `path` stands in messages.
///
/// # Errors
/// Another format, version or encoding; other numbers of channels than 1 and 3; no cells; fewer
/// values than the header declares; a value that is NaN, infinite or negative.
pub fn parse_volume(bytes: &[u8], path: &Path) -> Result<VolumeFile, SceneError> {
    let parse = || {
        let Content { size, channels, values, bounds } = content(bytes)?;
        let grid = VolumeGrid::new(size, channels, values).map_err(|e| format!("{e}"))?;
        Ok(VolumeFile { grid, bounds })
    };
    parse().map_err(|message: String| SceneError::scene(Location::file(path), message))
}

/// The samples of a distance field in a volume file.
///
/// # Errors
/// A file that cannot be read, and everything [`parse_sdf`] refuses.
pub fn load_sdf(path: &Path) -> Result<SdfSamples, SceneError> {
    parse_sdf(&read_asset(path)?, path)
}

/// The samples of a distance field in the bytes of a volume file, whose box does not count: they fill the unit cube.
/// `path` stands in messages.
///
/// # Errors
/// Another format, version or encoding; another number of channels than 1; fewer than 2 samples along an axis; fewer
/// values than the header declares; a value that is NaN or infinite.
pub fn parse_sdf(bytes: &[u8], path: &Path) -> Result<SdfSamples, SceneError> {
    let parse = || {
        let Content { size, channels, values, .. } = content(bytes)?;
        if channels != 1 {
            return Err(format!("a distance field has 1 channel, this file has {channels}"));
        }
        SdfSamples::new(size, values).map_err(|e| format!("{e}"))
    };
    parse().map_err(|message: String| SceneError::scene(Location::file(path), message))
}

/// What is in a volume file, before it means something.
struct Content {
    size: [u32; 3],
    channels: u32,
    values: Vec<f32>,
    bounds: Aabb,
}

fn content(bytes: &[u8]) -> Result<Content, String> {
    if !bytes.starts_with(b"VOL") {
        return Err("this is no volume file: it does not begin with “VOL”".into());
    }
    let Some((header, data)) = bytes.split_first_chunk::<HEADER>() else {
        return Err(format!("the file ends in its header of {HEADER} bytes"));
    };
    if header[3] != 3 {
        return Err(format!("unknown version {}, expected 3", header[3]));
    }
    let word = |index: usize| {
        let at = 4 + 4 * index;
        [header[at], header[at + 1], header[at + 2], header[at + 3]]
    };
    let encoding = i32::from_le_bytes(word(0));
    if encoding != 1 {
        return Err(format!("unknown encoding {encoding}, expected 1 (single precision)"));
    }
    let [x, y, z, channels] = [1, 2, 3, 4].map(|index| u32::from_le_bytes(word(index)));
    let values = [x, y, z, channels].iter().try_fold(1_usize, |n, &m| n.checked_mul(m as usize));
    let length = values.and_then(|n| n.checked_mul(4)).filter(|&length| length <= data.len());
    let Some(length) = length else {
        return Err(format!(
            "{x} × {y} × {z} cells of {channels} channels do not fit in the {} bytes after the header",
            data.len()
        ));
    };
    let number = |c: &[u8]| f32::from_le_bytes([c[0], c[1], c[2], c[3]]);
    let values: Vec<f32> = data[..length].chunks_exact(4).map(number).collect();
    let corner = |first: usize| {
        Vec3::from_array([0, 1, 2].map(|axis| f32::from_le_bytes(word(first + axis))))
    };
    let bounds = Aabb { min: corner(5), max: corner(8) };
    Ok(Content { size: [x, y, z], channels, values, bounds })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Color;
    use alloc::string::ToString;

    /// A file of 2 × 1 × 1 cells with the given header words and values.
    fn file(version: u8, words: [i32; 5], values: &[f32]) -> Vec<u8> {
        let mut bytes = Vec::from(*b"VOL");
        bytes.push(version);
        bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        let corners = [-1.0_f32, 0.0, 0.0, 1.0, 2.0, 3.0];
        bytes.extend(corners.iter().chain(values).flat_map(|number| number.to_le_bytes()));
        bytes
    }

    #[test]
    fn values_and_box_are_read() {
        let read = |bytes: &[u8]| parse_volume(bytes, Path::new("a.vol")).expect("a volume");
        let grey = read(&file(3, [1, 2, 1, 1, 1], &[0.5, 2.0]));
        assert_eq!(grey.grid.size(), [2, 1, 1]);
        assert_eq!(grey.grid.cell([1, 0, 0]), Color::new(2.0, 2.0, 2.0));
        assert_eq!(grey.bounds.min, Vec3::new(-1.0, 0.0, 0.0));
        assert_eq!(grey.bounds.max, Vec3::new(1.0, 2.0, 3.0));
        let rgb = read(&file(3, [1, 1, 1, 1, 3], &[1.0, 2.0, 3.0, 9.0]));
        assert_eq!(rgb.grid.cell([0, 0, 0]), Color::new(1.0, 2.0, 3.0));
    }

    #[test]
    fn what_is_no_volume_is_refused_with_the_reason() {
        let refused = |bytes: &[u8], fragment: &str| {
            let error = parse_volume(bytes, Path::new("a.vol")).expect_err(fragment).to_string();
            assert!(error.starts_with("a.vol: ") && error.contains(fragment), "{error}");
        };
        refused(b"PFM", "no volume file");
        refused(b"VOL\x03", "ends in its header");
        refused(&file(2, [1, 1, 1, 1, 1], &[1.0]), "unknown version 2");
        refused(&file(3, [2, 1, 1, 1, 1], &[1.0]), "unknown encoding 2");
        refused(&file(3, [1, 2, 1, 1, 1], &[1.0]), "2 × 1 × 1 cells of 1 channels do not fit");
        refused(&file(3, [1, -1, -1, -1, -1], &[1.0]), "do not fit");
        refused(&file(3, [1, 0, 1, 1, 1], &[]), "0 × 1 × 1 cells cannot be used");
        refused(&file(3, [1, 1, 1, 1, 6], &[1.0; 6]), "6 channels");
        refused(&file(3, [1, 1, 1, 1, 1], &[f32::NAN]), "cell (0, 0, 0)");
        refused(&file(3, [1, 2, 1, 1, 1], &[1.0, -2.0]), "-2 in cell (1, 0, 0)");
    }

    #[test]
    fn distances_may_be_negative_and_fill_the_unit_cube() {
        let values = [-1.0, 1.0, -2.0, 2.0, -3.0, 3.0, -4.0, 4.0];
        let bytes = file(3, [1, 2, 2, 2, 1], &values);
        let samples = parse_sdf(&bytes, Path::new("a.vol")).expect("a distance field");
        assert_eq!((samples.size(), samples.values()), ([2; 3], values.as_slice()));
        let refused = |bytes: &[u8], fragment: &str| {
            let error = parse_sdf(bytes, Path::new("a.vol")).expect_err(fragment).to_string();
            assert!(error.starts_with("a.vol: ") && error.contains(fragment), "{error}");
        };
        refused(b"VOL", "ends in its header");
        refused(&file(3, [1, 2, 2, 2, 3], &[1.0; 24]), "has 1 channel, this file has 3");
        refused(&file(3, [1, 2, 2, 2, 1], &[1.0; 7]), "do not fit in the 28 bytes");
        refused(&file(3, [1, 2, 2, 1, 1], &[1.0; 4]), "2 × 2 × 1 samples cannot be used");
        refused(&file(3, [1, 2, 2, 2, 1], &[f32::NAN; 8]), "sample (0, 0, 0) is not finite");
    }
}
