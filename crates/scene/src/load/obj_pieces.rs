//! The text of an OBJ file in pieces that end where lines do.

use alloc::vec::Vec;
use std::io::{self, Read};

use super::lines::{end_after, last_end};

/// How a text is cut: how much is read at a time, and how much of it is a task.
#[derive(Clone, Copy)]
pub(super) struct Sizes {
    pub(super) piece: usize,
    pub(super) task: usize,
}

impl Sizes {
    /// Enough tasks for many cores; so few bytes that they stay in a processor's cache.
    pub(super) const USUAL: Self = Self { piece: 1 << 22, task: 1 << 17 };
}

/// The pieces of a text, read one after the other: of a large file only one is in memory.
pub(super) struct Pieces<R> {
    source: R,
    /// How many bytes are left in the source.
    left: u64,
    size: usize,
    /// What was read beyond the last line of the last piece.
    rest: Vec<u8>,
}

impl<R: Read> Pieces<R> {
    /// The pieces, of about `size` bytes, of the first `length` bytes of a source.
    pub(super) fn new(source: R, length: u64, size: usize) -> Self {
        Self { source, left: length, size, rest: Vec::new() }
    }

    /// The next piece, empty at the end of the text. It is as long as its longest line at least.
    pub(super) fn next(&mut self) -> io::Result<Vec<u8>> {
        let mut piece = core::mem::take(&mut self.rest);
        loop {
            // Twice as much each time, so that very long lines take linear time.
            let wanted = self.left.min(self.size.max(piece.len()) as u64);
            piece.reserve(wanted as usize);
            let found = self.source.by_ref().take(wanted).read_to_end(&mut piece)?;
            if found == 0 {
                return Ok(piece);
            }
            self.left -= found as u64;
            if let Some(end) = last_end(&piece) {
                self.rest = piece[end..].into();
                piece.truncate(end);
                return Ok(piece);
            }
        }
    }
}

/// A piece in parts of about `size` bytes that end where lines do, without the last end of a line.
pub(super) fn tasks(piece: &[u8], size: usize) -> Vec<&[u8]> {
    let mut rest = piece;
    let mut tasks = Vec::new();
    while !rest.is_empty() {
        let (task, tail) = rest.split_at(end_after(rest, size.min(rest.len()) - 1));
        let task = task.strip_suffix(b"\n").unwrap_or(task);
        tasks.push(task.strip_suffix(b"\r").unwrap_or(task));
        rest = tail;
    }
    tasks
}

#[cfg(test)]
mod tests {
    use super::super::lines::Lines;
    use super::*;
    use alloc::vec;

    fn pieces(text: &[u8], size: usize) -> Vec<Vec<u8>> {
        let mut pieces = Pieces::new(text, text.len() as u64, size);
        core::iter::from_fn(|| Some(pieces.next().expect("memory")).filter(|p| !p.is_empty()))
            .collect()
    }

    #[test]
    fn pieces_end_where_lines_do() {
        assert_eq!(pieces(b"a\nb\nc", 1), [b"a\n", b"b\n", b"c".as_slice()]);
        assert_eq!(pieces(b"a\\\nb\\\r\nc\r\nd", 3), [b"a\\\nb\\\r\nc\r\n", b"d".as_slice()]);
        assert_eq!(pieces(b"a\rb\rc", 1), [b"a\rb\rc"]);
        assert_eq!(pieces(b"", 1), Vec::<Vec<u8>>::new());
    }

    #[test]
    fn the_lines_of_all_tasks_are_those_of_the_text() {
        let text = b"a\n\nb\\\n c\r\n\r\n\rd\\\r\ne\n# f\\\ng\n\\\nh";
        let whole: Vec<_> = Lines::new(text).map(|l| (l.number, l.text.into_owned())).collect();
        for size in 1..text.len() {
            let mut number = 0;
            let mut parts = vec![];
            for piece in pieces(text, size) {
                for task in tasks(&piece, size) {
                    let mut lines = Lines::after(number, task);
                    parts.extend(lines.by_ref().map(|l| (l.number, l.text.into_owned())));
                    number = lines.number();
                }
            }
            assert_eq!(parts, whole, "{size}");
        }
    }
}
