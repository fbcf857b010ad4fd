//! PNG files of any content.

use std::io::Write as _;

use flate2::write::ZlibEncoder;
use flate2::{Compression, Crc};

/// A chunk of a kind of four letters, with its length and its checksum.
pub(super) fn chunk(kind: &[u8], content: &[u8]) -> Vec<u8> {
    let mut crc = Crc::new();
    crc.update(kind);
    crc.update(content);
    let length = (content.len() as u32).to_be_bytes();
    [&length, kind, content, &crc.sum().to_be_bytes()].concat()
}

/// A stream of zlib that unfolds to so many zeros.
pub(super) fn zeros(count: usize) -> Vec<u8> {
    let mut zlib = ZlibEncoder::new(Vec::new(), Compression::best());
    let block = vec![0; 1 << 16];
    for start in (0..count).step_by(block.len()) {
        zlib.write_all(&block[..block.len().min(count - start)]).expect("memory");
    }
    zlib.finish().expect("memory")
}

/// A file whose header states a size, bits per sample, colour type and interlacing, followed by other chunks.
pub(super) fn file(size: [u32; 2], kind: [u8; 3], chunks: &[Vec<u8>]) -> Vec<u8> {
    let [bits, color, interlaced] = kind;
    let size = size.map(u32::to_be_bytes);
    let header = [size.as_flattened(), &[bits, color, 0, 0, interlaced]].concat();
    let begin = [b"\x89PNG\r\n\x1a\n".as_slice(), &chunk(b"IHDR", &header)].concat();
    let end = chunk(b"IEND", &[]);
    [begin, chunks.concat(), end].concat()
}
