//! Lines and columns of a text.

use alloc::vec::Vec;

/// Bytes from one counted place to the next.
const STEP: usize = 1024;

/// A text with what is needed to tell the line and the column of any byte, in a time that does not depend on how long lines are:
/// files that programs write are often one line.
pub(super) struct Places<'a> {
    text: &'a [u8],
    /// Where each line starts.
    lines: Vec<usize>,
    /// Characters before every [`STEP`]th byte.
    characters: Vec<usize>,
}

impl<'a> Places<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        let lines = core::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1));
        let mut before = 0;
        let characters = text.as_bytes().chunks(STEP).map(|chunk| {
            let here = before;
            before += characters(chunk);
            here
        });
        Self { text: text.as_bytes(), lines: lines.collect(), characters: characters.collect() }
    }

    /// Line and column of a byte, each counted from 1.
    pub(super) fn of_byte(&self, byte: usize) -> (u32, u32) {
        let line = self.lines.partition_point(|&start| start <= byte);
        let column = 1 + self.before(byte) - self.before(self.lines[line - 1]);
        (line as u32, column as u32)
    }

    /// How many characters begin before a byte.
    fn before(&self, byte: usize) -> usize {
        let byte = byte.min(self.text.len());
        let step = (byte / STEP).min(self.characters.len().saturating_sub(1));
        let counted = self.characters.get(step).copied().unwrap_or(0);
        counted + characters(&self.text[step * STEP..byte])
    }
}

/// How many characters begin in a part of a text in UTF-8.
fn characters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&byte| byte & 0xc0 != 0x80).count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::string::String;

    #[test]
    fn places_are_those_of_a_count_from_the_beginning() {
        let line: String = ["é", "x", "→", "\u{1f600}"].into_iter().cycle().take(1500).collect();
        let text = alloc::format!("{line}\n\nab\n{line}{line}\n");
        let places = Places::of(&text);
        let (mut line, mut column) = (1, 1);
        for (byte, c) in text.char_indices() {
            assert_eq!(places.of_byte(byte), (line, column), "{byte}");
            (line, column) = if c == '\n' { (line + 1, 1) } else { (line, column + 1) };
        }
        assert_eq!(places.of_byte(text.len()), (line, 1));
        assert_eq!(Places::of("").of_byte(0), (1, 1));
    }
}
