//! Bytes as text.

use alloc::vec::Vec;

/// The bytes that base64 stands for, with or without padding at its end.
///
/// # Errors
/// The index of the first character that does not belong there.
///
/// # Source
/// RFC 4648, section 4.
pub(super) fn decode(text: &[u8]) -> Result<Vec<u8>, usize> {
    let padding = text.iter().rev().take(2).take_while(|&&c| c == b'=').count();
    let digits = &text[..text.len() - padding];
    // A digit by itself has six bits, which are no byte; padding fills up to four.
    if digits.len() % 4 == 1 || (padding > 0 && !text.len().is_multiple_of(4)) {
        return Err(text.len());
    }
    let mut bytes = Vec::with_capacity(digits.len() / 4 * 3 + 2);
    for (index, group) in digits.chunks(4).enumerate() {
        let mut bits = 0_u32;
        for (place, &digit) in group.iter().enumerate() {
            let value = value(digit).ok_or(4 * index + place)?;
            bits |= value << (18 - 6 * place);
        }
        let [_, decoded @ ..] = bits.to_be_bytes();
        bytes.extend_from_slice(&decoded[..group.len() - 1]);
    }
    Ok(bytes)
}

fn value(digit: u8) -> Option<u32> {
    let value = match digit {
        b'A'..=b'Z' => digit - b'A',
        b'a'..=b'z' => digit - b'a' + 26,
        b'0'..=b'9' => digit - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => return None,
    };
    Some(u32::from(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_vectors_of_the_rfc_are_decoded() {
        let vectors = [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9v", "foo"),
            ("Zm9vYg==", "foob"),
            ("Zm9vYmE=", "fooba"),
            ("Zm9vYmFy", "foobar"),
        ];
        for (text, bytes) in vectors {
            assert_eq!(decode(text.as_bytes()), Ok(bytes.into()), "{text}");
            let bare = text.trim_end_matches('=');
            assert_eq!(decode(bare.as_bytes()), Ok(bytes.into()), "{bare}");
        }
        assert_eq!(decode(b"+/+/"), Ok([0xfb, 0xff, 0xbf].into()));
    }

    #[test]
    fn what_is_no_base64_is_refused_where_it_stands() {
        for (text, at) in
            [("Zm9v!mFy", 4), ("A", 1), ("AAAAA", 5), ("A===", 1), ("Zg=", 3), ("====", 0)]
        {
            assert_eq!(decode(text.as_bytes()), Err(at), "{text}");
        }
    }
}
