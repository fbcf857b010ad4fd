//! The bytes of a stored render: a header that can be read, sums that cannot, and a checksum over all of it.
//!
//! ```text
//! etendue␚              8 bytes
//! version of the format  u32, little-endian like all that follows
//! length of the header   u32
//! length of the body     u64
//! header                 JSON: what it is a render of, and the command line that made it
//! body                   the state of the renderer
//! CRC-32                 u32, of everything before it
//! ```

use std::time::Duration;

use etendue_renderer::Accumulation;
use etendue_renderer::progressive::ProgressiveState;
use serde::{Deserialize, Serialize};

use super::identity::Identity;
use super::recipe::Recipe;
use super::shard::Shard;
use crate::failure::{Exit, Failure};

/// What files of stored renders begin with.
const MAGIC: [u8; 8] = *b"etendue\x1a";

/// Version of the format.
const FORMAT: u32 = 1;

/// Bytes before the header.
const PREFIX: usize = 8 + 4 + 4 + 8;

/// What a stored render is, in words.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Header {
    pub(crate) identity: Identity,
    /// The command line.
    pub(crate) recipe: Recipe,
    /// The scene file as given on the command line.
    pub(crate) scene: String,
    /// Of a part of a picture.
    pub(crate) shard: Option<Shard>,
    /// Samples per pixel of the whole of which this may be a part.
    pub(crate) samples_per_pixel: u32,
    /// Seconds of rendering so far.
    pub(crate) seconds: f64,
    /// What was compiled in.
    pub(crate) configuration: String,
}

impl Header {
    /// The time of rendering so far.
    pub(crate) fn rendered_for(&self) -> Duration {
        Duration::try_from_secs_f64(self.seconds).unwrap_or_default()
    }
}

/// How far a render is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum State {
    /// A plain render, or a part of one.
    Plain(Accumulation),
    /// A progressive render.
    Progressive(ProgressiveState),
}

/// A stored render.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stored {
    pub(crate) header: Header,
    pub(crate) state: State,
}

impl State {
    fn encode(&self) -> (u8, Vec<u8>) {
        let mut body = Vec::new();
        match self {
            Self::Plain(accumulation) => {
                accumulation.encode(&mut body);
                (0, body)
            }
            Self::Progressive(state) => {
                state.encode(&mut body);
                (1, body)
            }
        }
    }

    fn decode(kind: u8, body: &[u8]) -> Result<Self, String> {
        match kind {
            0 => Accumulation::decode(body).map(Self::Plain).map_err(|error| error.to_string()),
            1 => ProgressiveState::decode(body)
                .map(Self::Progressive)
                .map_err(|error| error.to_string()),
            _ => Err("it holds a kind of render that this version does not know".to_owned()),
        }
    }
}

/// Most bytes of an attribute of an EXR picture.
const MOST_OF_PART: usize = i32::MAX as usize;

impl Stored {
    /// The bytes of a part of a picture, which it is written into.
    ///
    /// # Errors
    /// They are too many.
    pub(crate) fn to_part(&self) -> Result<Vec<u8>, Failure> {
        let bytes = self.to_bytes().map_err(|error| Failure::new(Exit::Internal, error))?;
        if bytes.len() > MOST_OF_PART {
            return Err(Failure::new(
                Exit::Resource,
                "the part of the render is larger than the 2 GiB that a picture has room for; render crops",
            ));
        }
        Ok(bytes)
    }

    /// The bytes of a file.
    pub(crate) fn to_bytes(&self) -> Result<Vec<u8>, String> {
        let header = serde_json::to_vec(&self.header).map_err(|error| error.to_string())?;
        let (kind, body) = self.state.encode();
        let header_length = u32::try_from(header.len()).map_err(|error| error.to_string())?;
        let mut bytes = Vec::with_capacity(PREFIX + header.len() + 1 + body.len() + 4);
        bytes.extend(MAGIC);
        bytes.extend(FORMAT.to_le_bytes());
        bytes.extend(header_length.to_le_bytes());
        bytes.extend((1 + body.len() as u64).to_le_bytes());
        bytes.extend(header);
        bytes.push(kind);
        bytes.extend(body);
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        Ok(bytes)
    }

    /// Reads the bytes of a file.
    ///
    /// # Errors
    /// What is wrong with them.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let cut_short = || "it is cut short".to_owned();
        let Some(rest) = bytes.strip_prefix(&MAGIC) else {
            return Err(if MAGIC.starts_with(bytes) {
                cut_short()
            } else {
                "it is no checkpoint of a render".to_owned()
            });
        };
        let (numbers, rest) = rest.split_at_checked(PREFIX - MAGIC.len()).ok_or_else(cut_short)?;
        let number = |range: core::ops::Range<usize>| {
            numbers[range].iter().rev().fold(0_u64, |sum, &byte| sum << 8 | u64::from(byte))
        };
        let (format, header_length, body_length) = (number(0..4), number(4..8), number(8..16));
        if format != u64::from(FORMAT) {
            return Err(format!("its format is {format}, and this version reads format {FORMAT}"));
        }
        let length = header_length.saturating_add(body_length).saturating_add(4);
        if length > rest.len() as u64 {
            return Err(cut_short());
        }
        if length < rest.len() as u64 || body_length == 0 {
            return Err("it is damaged: its length is not what it says".to_owned());
        }
        let (content, checksum) = bytes.split_at(bytes.len() - 4);
        if crc32fast::hash(content).to_le_bytes() != checksum {
            return Err("it is damaged: its checksum is not that of its content".to_owned());
        }
        let (header, body) = content[PREFIX..].split_at(header_length as usize);
        let header =
            serde_json::from_slice(header).map_err(|error| format!("its header: {error}"))?;
        Ok(Self { header, state: State::decode(body[0], &body[1..])? })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_scene::film::Crop;

    fn stored() -> Stored {
        let crop = Crop { offset: [1, 2], size: [20, 3] };
        let header = Header {
            identity: Identity::default(),
            recipe: Recipe::default(),
            samples_per_pixel: 4,
            seconds: 1.5,
            configuration: "surfaces".to_owned(),
            scene: "a.xml".to_owned(),
            shard: Some(Shard { index: 1, count: 2 }),
        };
        Stored { header, state: State::Plain(Accumulation::new(crop, 1..3)) }
    }

    #[test]
    fn it_comes_back() {
        let bytes = stored().to_bytes().expect("small");
        assert_eq!(Stored::from_bytes(&bytes), Ok(stored()));
    }

    #[test]
    fn every_cut_and_every_flipped_bit_is_found_out() {
        let mut bytes = stored().to_bytes().expect("small");
        for length in 0..bytes.len() {
            let cut = Stored::from_bytes(&bytes[..length]);
            assert_eq!(cut, Err("it is cut short".to_owned()), "{length}");
        }
        for bit in 0..8 * bytes.len() {
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert!(Stored::from_bytes(&bytes).is_err(), "bit {bit}");
            bytes[bit / 8] ^= 1 << (bit % 8);
        }
        bytes.push(0);
        assert!(Stored::from_bytes(&bytes).is_err(), "a byte too many");
    }

    #[test]
    fn lengths_beyond_the_file_and_other_files_are_refused() {
        let mut bytes = stored().to_bytes().expect("small");
        bytes[12..24].fill(0xff);
        assert_eq!(Stored::from_bytes(&bytes), Err("it is cut short".to_owned()));
        let other = Stored::from_bytes(b"<scene version=\"3.0.0\"/>");
        assert_eq!(other, Err("it is no checkpoint of a render".to_owned()));
    }
}
