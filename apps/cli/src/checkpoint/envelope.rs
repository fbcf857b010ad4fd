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

use std::io::Read;
use std::time::Duration;

use etendue_renderer::progressive::ProgressiveState;
use etendue_renderer::{Accumulation, ReuseState};
use serde::{Deserialize, Serialize};

use super::identity::Identity;
use super::recipe::Recipe;
use super::shard::Shard;

/// What files of stored renders begin with.
const MAGIC: [u8; 8] = *b"etendue\x1a";

/// Version of the format.
const FORMAT: u32 = 2;

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
    /// Whether nothing is left to draw; rounds may always go on.
    pub(crate) whole: bool,
}

impl Header {
    /// The time of rendering so far.
    pub(crate) fn rendered_for(&self) -> Duration {
        Duration::try_from_secs_f64(self.seconds).unwrap_or_default()
    }

    /// Reads no more of a stored render than its header, whose checksum remains to be tested.
    ///
    /// # Errors
    /// What is wrong with it.
    pub(crate) fn read(mut file: impl Read) -> Result<Self, String> {
        let mut read = |count: u64| {
            let mut bytes = Vec::new();
            let read = file.by_ref().take(count).read_to_end(&mut bytes);
            read.map(|_| bytes).map_err(|error| error.to_string())
        };
        let prefix = Prefix::parse(&read(PREFIX as u64)?)?;
        Self::parse(&read(prefix.header.into())?)
    }

    fn parse(bytes: &[u8]) -> Result<Self, String> {
        let header: Self =
            serde_json::from_slice(bytes).map_err(|error| format!("its header: {error}"))?;
        match header.shard.filter(|shard| !shard.exists()) {
            Some(shard) => Err(format!("its header: there is no part {shard}")),
            None => Ok(header),
        }
    }
}

/// How far a render is.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum State {
    /// A plain render, or a part of one.
    Plain(Accumulation),
    /// A progressive render.
    Progressive(ProgressiveState),
    /// A render with reuse.
    Reuse(ReuseState),
}

/// A stored render.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Stored {
    pub(crate) header: Header,
    pub(crate) state: State,
}

impl State {
    /// Adds a byte that says what it is, and what [`decode`](Self::decode) reads.
    fn encode(&self, bytes: &mut Vec<u8>) {
        match self {
            Self::Plain(accumulation) => {
                bytes.push(0);
                accumulation.encode(bytes);
            }
            Self::Progressive(state) => {
                bytes.push(1);
                state.encode(bytes);
            }
            Self::Reuse(state) => {
                bytes.push(2);
                state.encode(bytes);
            }
        }
    }

    fn decode(kind: u8, body: &[u8]) -> Result<Self, String> {
        let state = match kind {
            0 => Accumulation::decode(body).map(Self::Plain),
            1 => ProgressiveState::decode(body).map(Self::Progressive),
            2 => ReuseState::decode(body).map(Self::Reuse),
            _ => return Err("it holds a kind of render that this version does not know".to_owned()),
        };
        state.map_err(|error| error.to_string())
    }
}

/// The numbers before the header.
struct Prefix {
    /// Bytes of the header.
    header: u32,
    /// Bytes of the body.
    body: u64,
}

impl Prefix {
    /// Reads what `bytes` begin with.
    fn parse(bytes: &[u8]) -> Result<Self, String> {
        let Some(numbers) = bytes.strip_prefix(&MAGIC) else {
            return Err(if MAGIC.starts_with(bytes) {
                CUT_SHORT.to_owned()
            } else {
                "it is no checkpoint of a render".to_owned()
            });
        };
        if bytes.len() < PREFIX {
            return Err(CUT_SHORT.to_owned());
        }
        let number = |range: core::ops::Range<usize>| {
            numbers[range].iter().rev().fold(0_u64, |sum, &byte| sum << 8 | u64::from(byte))
        };
        let format = number(0..4);
        if format != u64::from(FORMAT) {
            return Err(format!("its format is {format}, and this version reads format {FORMAT}"));
        }
        Ok(Self { header: number(4..8) as u32, body: number(8..16) })
    }

    fn write(&self, bytes: &mut [u8]) {
        let numbers = MAGIC.into_iter().chain(FORMAT.to_le_bytes());
        let numbers = numbers.chain(self.header.to_le_bytes()).chain(self.body.to_le_bytes());
        for (byte, number) in bytes.iter_mut().zip(numbers) {
            *byte = number;
        }
    }
}

const CUT_SHORT: &str = "it is cut short";

impl Stored {
    /// * `header`: of the render; its time and whether it is whole are set here.
    pub(crate) fn new(header: &Header, seconds: f64, state: State) -> Self {
        let whole = matches!(&state, State::Plain(sums) if sums.is_whole());
        Self { header: Header { seconds, whole, ..header.clone() }, state }
    }

    /// The bytes of a file.
    pub(crate) fn to_bytes(&self) -> Result<Vec<u8>, String> {
        let mut bytes = vec![0; PREFIX];
        serde_json::to_writer(&mut bytes, &self.header).map_err(|error| error.to_string())?;
        let begin = bytes.len();
        let header = u32::try_from(begin - PREFIX).map_err(|error| error.to_string())?;
        self.state.encode(&mut bytes);
        let body = (bytes.len() - begin) as u64;
        Prefix { header, body }.write(&mut bytes);
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        Ok(bytes)
    }

    /// Reads the bytes of a file.
    ///
    /// # Errors
    /// What is wrong with them.
    pub(crate) fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        let prefix = Prefix::parse(bytes)?;
        let length = u64::from(prefix.header).saturating_add(prefix.body).saturating_add(4);
        let rest = (bytes.len() - PREFIX) as u64;
        if length > rest {
            return Err(CUT_SHORT.to_owned());
        }
        if length < rest || prefix.body == 0 {
            return Err("it is damaged: its length is not what it says".to_owned());
        }
        let (content, checksum) = bytes.split_at(bytes.len() - 4);
        if crc32fast::hash(content).to_le_bytes() != checksum {
            return Err("it is damaged: its checksum is not that of its content".to_owned());
        }
        let (header, body) = content[PREFIX..].split_at(prefix.header as usize);
        Ok(Self { header: Header::parse(header)?, state: State::decode(body[0], &body[1..])? })
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
            whole: false,
        };
        Stored { header, state: State::Plain(Accumulation::new(crop, 1..3)) }
    }

    #[test]
    fn it_comes_back() {
        let bytes = stored().to_bytes().expect("small");
        assert_eq!(Stored::from_bytes(&bytes), Ok(stored()));
        assert_eq!(Header::read(&bytes[..]), Ok(stored().header));
        assert!(Header::read(&bytes[..PREFIX + 9]).is_err());
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
