//! What a file contains, in 64 bits.

use etendue_math::mix_u64;

/// A hash of bytes and their number, for telling whether a file has changed: two contents that differ by accident have equal
/// hashes once in 2⁶⁴ times. Nothing against intent.
pub(crate) fn content_hash(bytes: &[u8]) -> u64 {
    let (words, rest) = bytes.as_chunks::<8>();
    let hash = words
        .iter()
        .fold(bytes.len() as u64, |hash, &word| mix_u64(hash, u64::from_le_bytes(word)));
    let mut last = [0; 8];
    last[..rest.len()].copy_from_slice(rest);
    mix_u64(hash, u64::from_le_bytes(last))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_byte_its_place_and_the_length_count() {
        let mut hashes = HashSet::new();
        for length in 0..40 {
            assert!(hashes.insert(content_hash(&vec![0; length])), "{length}");
            for place in 0..length {
                let mut bytes = vec![0; length];
                bytes[place] = 1;
                assert!(hashes.insert(content_hash(&bytes)), "{place} of {length}");
            }
        }
    }
}
