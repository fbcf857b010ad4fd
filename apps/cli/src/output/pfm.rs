//! Portable float map: 32-bit samples without loss, rows from the bottom.

use std::io::Write;

use etendue_renderer::Image;

use super::EncodeResult;

pub(super) fn encode(bytes: &mut Vec<u8>, picture: &Image) -> EncodeResult {
    // A negative scale says that the samples are little-endian.
    write!(bytes, "PF\n{} {}\n-1.0\n", picture.width(), picture.height())?;
    for row in picture.pixels().chunks_exact(picture.width() as usize).rev() {
        for sample in row.iter().flat_map(|p| p.to_array()) {
            bytes.extend_from_slice(&sample.to_le_bytes());
        }
    }
    Ok(())
}
