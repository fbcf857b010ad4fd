//! The lines and fields of OBJ and MTL text.

use alloc::borrow::Cow;
use alloc::format;
use alloc::string::String;

/// A logical line, without its terminator.
pub(super) struct Line<'a> {
    /// Number of its first physical line, counted from 1.
    pub(super) number: u32,
    pub(super) text: Cow<'a, [u8]>,
}

/// The logical lines of a text: a byte-order mark is dropped, lines end with LF, CRLF or CR, and
/// one that ends with a backslash goes on in the next. Comment lines do not go on: there a final
/// backslash is the end of a Windows path.
pub(super) struct Lines<'a> {
    rest: Option<&'a [u8]>,
    number: u32,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Self::after(0, text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text))
    }

    /// The lines of what follows the first `number` physical lines of a text.
    pub(super) fn after(number: u32, rest: &'a [u8]) -> Self {
        Self { rest: Some(rest), number }
    }

    /// The number of the last physical line that was read.
    pub(super) fn number(&self) -> u32 {
        self.number
    }

    fn physical(&mut self) -> Option<&'a [u8]> {
        let rest = self.rest?;
        self.number = self.number.saturating_add(1);
        let Some(end) = line_end(rest) else {
            self.rest = None;
            return Some(rest);
        };
        let (line, tail) = rest.split_at(end);
        self.rest = Some(tail.strip_prefix(b"\r\n").unwrap_or(&tail[1..]));
        Some(line)
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        let first = self.physical()?;
        let number = self.number;
        let mut text = Cow::Borrowed(first);
        if !first.trim_ascii_start().starts_with(b"#") {
            while let Some(b'\\') = text.last() {
                let joined = text.to_mut();
                joined.pop();
                joined.push(b' ');
                joined.extend_from_slice(self.physical().unwrap_or_default());
            }
        }
        Some(Line { number, text })
    }
}

/// The place of the first LF or CR, looked for in eight bytes at a time.
fn line_end(text: &[u8]) -> Option<usize> {
    const EACH: u64 = 0x0101_0101_0101_0101;
    const LINE_FEEDS: u64 = EACH * b'\n' as u64;
    const CARRIAGE_RETURNS: u64 = EACH * b'\r' as u64;
    // The top bit of the lowest byte that is 0, and perhaps of others above it.
    let zeros = |x: u64| x.wrapping_sub(EACH) & !x & (EACH << 7);
    let (words, rest) = text.as_chunks::<8>();
    for (number, &word) in words.iter().enumerate() {
        let word = u64::from_le_bytes(word);
        let found = zeros(word ^ LINE_FEEDS) | zeros(word ^ CARRIAGE_RETURNS);
        if found != 0 {
            return Some(8 * number + found.trailing_zeros() as usize / 8);
        }
    }
    let end = rest.iter().position(|&b| b == b'\n' || b == b'\r')?;
    Some(text.len() - rest.len() + end)
}

/// The place after the last LF at which a logical line ends. It may miss some, after comments that end with a backslash.
pub(super) fn last_end(text: &[u8]) -> Option<usize> {
    (0..text.len()).rev().find(|&at| ends_line(text, at)).map(|at| at + 1)
}

/// The place after the first LF at or after a byte at which a logical line ends, or the end of the text.
pub(super) fn end_after(text: &[u8], start: usize) -> usize {
    (start..text.len()).find(|&at| ends_line(text, at)).map_or(text.len(), |at| at + 1)
}

/// Whether a byte is an LF that no backslash precedes.
fn ends_line(text: &[u8], at: usize) -> bool {
    let before = || {
        let line = &text[..at];
        line.strip_suffix(b"\r").unwrap_or(line)
    };
    text[at] == b'\n' && !before().ends_with(b"\\")
}

/// The fields of a line up to a comment.
pub(super) fn fields(text: &[u8]) -> Fields<'_> {
    Fields(text)
}

/// The fields that are left of a line.
pub(super) struct Fields<'a>(&'a [u8]);

impl<'a> Iterator for Fields<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let text = self.0.trim_ascii_start();
        if text.first().is_none_or(|&b| b == b'#') {
            self.0 = &[];
            return None;
        }
        let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
        let (field, rest) = text.split_at(end);
        self.0 = rest;
        Some(field)
    }
}

/// The keyword of a line and the rest of it, trimmed.
pub(super) fn statement(text: &[u8]) -> (&[u8], &[u8]) {
    let text = text.trim_ascii();
    let end = text.iter().position(u8::is_ascii_whitespace).unwrap_or(text.len());
    let (keyword, rest) = text.split_at(end);
    (keyword, rest.trim_ascii_start())
}

/// A finite number; otherwise what is wrong with the field.
pub(super) fn real(field: &[u8]) -> Result<f32, String> {
    if let Some(number) = decimal(field) {
        return Ok(number);
    }
    match core::str::from_utf8(field).ok().and_then(|s| s.parse::<f32>().ok()) {
        Some(x) if x.is_finite() => Ok(x),
        Some(_) => Err(format!("{} is not a finite number", quote(field))),
        None => Err(format!("{} is not a number", quote(field))),
    }
}

/// The `f32` nearest to a number with a sign, digits and a point, which most numbers of meshes are; `None` for any other, and for the few
/// whose nearest `f64` does not decide it.
///
/// # Source
/// Clinger, "How to Read Floating Point Numbers Accurately", PLDI 1990: a quotient of two integers that `f64` holds exactly is rounded once.
fn decimal(field: &[u8]) -> Option<f32> {
    const POWERS: [f64; 16] =
        [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];
    let digits = field.strip_prefix(b"-").unwrap_or(field);
    // Fifteen digits are below 2⁵³; with the point there is one more byte.
    if digits.len() > POWERS.len() {
        return None;
    }
    let (mut number, mut places, mut count) = (0u64, None, 0);
    for &byte in digits {
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            (number, count) = (10 * number + u64::from(digit), count + 1);
            places = places.map(|n| n + 1);
        } else if byte == b'.' && places.is_none() {
            places = Some(0);
        } else {
            return None;
        }
    }
    if count == 0 || count == POWERS.len() {
        return None;
    }
    let exact = number as f64 / POWERS[places.unwrap_or(0)];
    // Beside the middle of two neighbours in f32 the second rounding may go the wrong way.
    let below = exact.to_bits() & ((1 << 29) - 1);
    if below.abs_diff(1 << 28) <= 1 {
        return None;
    }
    let number = exact as f32;
    Some(if digits.len() < field.len() { -number } else { number })
}

/// A field for a message: quoted, and cut where it is long.
pub(super) fn quote(field: &[u8]) -> String {
    const LONGEST: usize = 40;
    let shown = String::from_utf8_lossy(&field[..field.len().min(LONGEST)]);
    let more = if field.len() > LONGEST { "…" } else { "" };
    format!("'{}{more}'", shown.escape_debug())
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;
    use alloc::vec::Vec;

    fn lines(text: &[u8]) -> Vec<(u32, Vec<u8>)> {
        Lines::new(text).map(|l| (l.number, l.text.into_owned())).collect()
    }

    #[test]
    fn every_kind_of_line_end_counts_once() {
        let expected =
            vec![(1, b"a".to_vec()), (2, b"b".to_vec()), (3, b"c".to_vec()), (4, b"d".to_vec())];
        assert_eq!(lines(b"a\nb\r\nc\rd"), expected);
    }

    #[test]
    fn line_ends_are_found_at_every_place() {
        for at in 0..20 {
            for end in *b"\n\r" {
                // Neighbours of the ends, and bytes whose differences from them borrow.
                let mut text = [b'\x0b', b'\x0c', b'\x09', 0, 0x8a, 0x8d].repeat(5);
                assert_eq!(line_end(&text), None);
                text[at] = end;
                text[at + 3] = b'\n';
                assert_eq!(line_end(&text), Some(at));
            }
        }
    }

    #[test]
    fn a_byte_order_mark_is_dropped() {
        assert_eq!(lines(b"\xef\xbb\xbfv 1"), vec![(1, b"v 1".to_vec())]);
    }

    #[test]
    fn continuations_are_joined_and_keep_line_numbers() {
        assert_eq!(
            lines(b"f 1\\\r\n2\\\n3\nx"),
            vec![(1, b"f 1 2 3".to_vec()), (4, b"x".to_vec())]
        );
        assert_eq!(lines(b"f 1\\"), vec![(1, b"f 1 ".to_vec())]);
        assert_eq!(lines(b"# C:\\\nv").len(), 2);
    }

    #[test]
    fn fields_end_at_a_comment() {
        assert_eq!(fields(b" v\t1 # 2").collect::<Vec<_>>(), [b"v".as_slice(), b"1"]);
        assert_eq!(statement(b"  o  my mesh \r"), (b"o".as_slice(), b"my mesh".as_slice()));
        assert_eq!(statement(b""), (b"".as_slice(), b"".as_slice()));
    }

    #[test]
    fn decimals_are_rounded_as_the_standard_library_rounds_them() {
        let check = |text: &str| {
            if let Some(number) = decimal(text.as_bytes()) {
                let expected: f32 = text.parse().expect(text);
                assert_eq!(number.to_bits(), expected.to_bits(), "{text}");
            }
        };
        let others = ["", "-", ".", "-.", "+1", "1e5", "1..2", "1.2.3", "--1", "0x1", "1_0", "nan"];
        for text in others.into_iter().chain(["1234567890123456", "0.1234567890123456"]) {
            assert_eq!(decimal(text.as_bytes()), None, "{text}");
        }
        for text in ["0", "-0", "0.000", "1.", ".5", "-.25", "123456789012345", "0.00000000000001"]
        {
            assert!(decimal(text.as_bytes()).is_some(), "{text}");
            check(text);
        }
        let mut bits = 1u64;
        for _ in 0..200_000 {
            bits = bits.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let digits = format!("{:015}", (bits >> 11) % 1_000_000_000_000_000);
            let (whole, rest) = digits.split_at((bits >> 60) as usize % 15);
            check(&format!("{whole}.{rest}"));
            // Middles of two neighbours, which are the hardest, as far as they have so few digits.
            let middle = f64::from((bits >> 40) as u32 | 1 << 24) + 0.5;
            check(&format!("-{}", middle / 2.0));
            check(&format!("{}", middle / 32.0));
        }
        // 2²⁴ + 1 lies between two neighbours.
        assert_eq!((decimal(b"16777217"), real(b"16777217")), (None, Ok(16777216.0)));
    }

    #[test]
    fn numbers_are_decimal_and_finite() {
        assert_eq!(real(b"-1.5E+2"), Ok(-150.0));
        assert_eq!(real(b".5"), Ok(0.5));
        assert_eq!(real(b"nan"), Err("'nan' is not a finite number".into()));
        assert_eq!(real(b"1e99"), Err("'1e99' is not a finite number".into()));
        assert_eq!(real(b"0x1"), Err("'0x1' is not a number".into()));
        assert_eq!(real(b"\xff"), Err("'\u{fffd}' is not a number".into()));
    }
}
