//! Portable float maps.
//!
//! ```text
//! PF (RGB) or Pf (grey), width, height, scale, one white space, f32 samples from the bottom row up
//! ```
//!
//! A negative scale means little endian. Samples are multiplied by its absolute value, as Mitsuba does.

use alloc::format;
use alloc::vec::Vec;
use std::path::Path;

use crate::error::SceneError;

use super::super::lines::{quote, real};
use super::{Image, check_size, malformed};

pub(super) fn parse(bytes: &[u8], path: &Path) -> Result<Image, SceneError> {
    let mut rest = bytes;
    let channels = match take_word(&mut rest) {
        b"PF" => 3usize,
        b"Pf" => 1,
        other => return Err(malformed(path, format!("unknown PFM kind {}", quote(other)))),
    };
    let mut dimension = |what| {
        let word = take_word(&mut rest);
        let number = core::str::from_utf8(word).ok().and_then(|s| s.parse::<u32>().ok());
        number.ok_or_else(|| malformed(path, format!("{} is not a {what}", quote(word))))
    };
    let (width, height) = (dimension("width")?, dimension("height")?);
    check_size(width.into(), height.into(), channels, bytes, path)?;
    let scale = real(take_word(&mut rest)).map_err(|m| malformed(path, format!("scale: {m}")))?;
    if scale == 0.0 {
        return Err(malformed(path, "the scale is 0"));
    }
    let row = width as usize * channels * 4;
    let size = row * height as usize;
    let Some(samples) = rest.get(1..).and_then(|samples| samples.get(..size)) else {
        let found = rest.len().saturating_sub(1);
        return Err(malformed(path, format!("{found} bytes of samples, expected {size}")));
    };
    let convert = if scale < 0.0 { f32::from_le_bytes } else { f32::from_be_bytes };
    let (words, _) = samples.as_chunks::<4>();
    let data: Vec<f32> = words
        .chunks_exact(row / 4)
        .rev()
        .flatten()
        .map(|&word| convert(word) * scale.abs())
        .collect();
    Ok(Image { width, height, channels, data, srgb_decoded: false })
}

/// Takes the next word off the front, the white space after it left in place.
fn take_word<'a>(rest: &mut &'a [u8]) -> &'a [u8] {
    let text = rest.trim_ascii_start();
    let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
    let (word, tail) = text.split_at(end);
    *rest = tail;
    word
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::ToString as _;

    fn file(header: &str, samples: &[f32], encode: fn(f32) -> [u8; 4]) -> Vec<u8> {
        let mut bytes = header.as_bytes().to_vec();
        bytes.extend(samples.iter().flat_map(|&x| encode(x)));
        bytes
    }

    #[test]
    fn both_byte_orders_run_from_the_bottom_up() {
        let samples = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let little = file("Pf\n2 3\n-1\n", &samples, f32::to_le_bytes);
        let big = file("Pf 2 3 0.5\n", &samples.map(|x| 2.0 * x), f32::to_be_bytes);
        for bytes in [little, big] {
            let image = parse(&bytes, Path::new("a.pfm")).expect("a valid file");
            assert_eq!((image.width(), image.height(), image.channels()), (2, 3, 1));
            assert_eq!(image.data(), [5.0, 6.0, 3.0, 4.0, 1.0, 2.0]);
        }
        let color = file("PF 1 2 -1 ", &samples, f32::to_le_bytes);
        let image = parse(&color, Path::new("a.pfm")).expect("a valid file");
        assert_eq!((image.channels(), image.data()[0]), (3, 4.0));
    }

    #[test]
    fn malformed_files_are_named() {
        for (header, expected) in [
            ("PG 1 1 1 ", "unknown PFM kind 'PG'"),
            ("PF -1 1 1 ", "'-1' is not a width"),
            ("PF 1", "'' is not a height"),
            ("PF 0 1 1 ", "the image has 0 × 1 pixels"),
            ("Pf 1 1 0 ", "the scale is 0"),
            ("Pf 1 1 nan ", "scale: 'nan' is not a finite number"),
            ("Pf 2 2 -1\nabc", "3 bytes of samples, expected 16"),
            (
                "Pf 4294967295 4294967295 -1\n",
                "4294967295 × 4294967295 pixels are more than the 268435456 allowed",
            ),
        ] {
            let error = parse(header.as_bytes(), Path::new("a.pfm")).map_err(|e| e.to_string());
            assert_eq!(error, Err(format!("a.pfm: {expected}")));
        }
    }

    #[test]
    fn truncated_files_never_panic() {
        let bytes = file("PF\n1 2\n-1\n", &[1.0; 6], f32::to_le_bytes);
        for end in 0..bytes.len() {
            assert!(parse(&bytes[..end], Path::new("a.pfm")).is_err());
        }
    }
}
