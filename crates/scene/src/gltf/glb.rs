//! The binary container of a document and one of its buffers.

use alloc::format;
use std::path::Path;

use crate::{Location, SceneError};

/// What a container begins with.
pub(super) const MAGIC: [u8; 4] = *b"glTF";

const JSON: [u8; 4] = *b"JSON";
const BINARY: [u8; 4] = *b"BIN\0";

/// Length of the container's header and of that of a chunk.
const HEADER: usize = 12;
const CHUNK_HEADER: usize = 8;

/// The JSON of a container and its buffer, if there is one. Chunks of other kinds are read over.
///
/// # Errors
/// Another version than 2, content that ends too early, a first chunk that is not JSON.
///
/// # Source
/// glTF 2.0, section 4, "GLB File Format Specification".
pub(super) fn chunks<'a>(
    bytes: &'a [u8],
    path: &Path,
) -> Result<(&'a [u8], Option<&'a [u8]>), SceneError> {
    let refused = |message| SceneError::scene(Location::file(path), message);
    let cut_off = |at: usize, length: usize| {
        refused(format!(
            "the container is cut off: it ends at byte {} of {}",
            bytes.len(),
            at + length
        ))
        .help("copy or export the file again")
    };
    let word = |at: usize| -> Result<[u8; 4], SceneError> {
        let word = bytes.get(at..).and_then(<[u8]>::first_chunk);
        word.copied().ok_or_else(|| cut_off(at, 4))
    };
    let number = |at: usize| word(at).map(|word| u32::from_le_bytes(word) as usize);
    let version = number(4)?;
    if version != 2 {
        let message = format!("a binary container of version {version} is not supported");
        return Err(refused(message).help("export the model as glTF 2.0"));
    }
    let length = number(8)?;
    let Some(content) = bytes.get(..length) else { return Err(cut_off(0, length)) };
    let (mut text, mut binary) = (None, None);
    let mut at = HEADER;
    while at < content.len() {
        let (size, kind) = (number(at)?, word(at + 4)?);
        let start = at + CHUNK_HEADER;
        let end = start.checked_add(size);
        let Some(chunk) = end.and_then(|end| content.get(start..end)) else {
            let message =
                format!("the chunk of {size} bytes at byte {at} reaches beyond the container");
            return Err(refused(message).help("copy or export the file again"));
        };
        match (kind, text) {
            (JSON, None) => text = Some(chunk),
            (_, None) => {
                return Err(refused(format!("the first chunk, at byte {at}, is not JSON")));
            }
            (BINARY, Some(_)) if binary.is_none() => binary = Some(chunk),
            _ => {}
        }
        at = start + size;
    }
    match text {
        Some(text) => Ok((text, binary)),
        None => Err(refused("the container is empty".into())),
    }
}
