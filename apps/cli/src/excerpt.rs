//! The line of a file that a message is about.

use std::fmt;
use std::fs::File;
use std::io::{BufRead, BufReader, Read};
use std::path::Path;

use etendue_scene::Location;

/// The most that is read to find a line; beyond it the message has none.
const MOST_BYTES: u64 = 1 << 26;

/// Characters of a line that are shown.
const WIDTH: usize = 100;

/// A line of a file with the place in it.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Excerpt {
    number: u32,
    text: String,
    /// What is pointed at: characters of `text`, from the first on; none where the whole line is meant.
    marked: Option<[usize; 2]>,
}

impl Excerpt {
    /// The line at a location; `None` where the file has no such line of text.
    pub(crate) fn at(location: &Location) -> Option<Self> {
        let number = location.line?;
        let line = line(&location.file, number)?;
        Some(Self::of(&line, number, location.column))
    }

    fn of(line: &str, number: u32, column: Option<u32>) -> Self {
        let line: Vec<char> = line.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
        let indent = line.iter().take_while(|c| c.is_whitespace()).count();
        let at = column.map(|column| (column as usize).max(1) - 1).filter(|&at| at < line.len());
        // A long line is shown around the place.
        let first = if line.len() - indent > WIDTH {
            at.map_or(indent, |at| at.saturating_sub(WIDTH / 2)).max(indent)
        } else {
            indent
        };
        let shown = &line[first..line.len().min(first + WIDTH)];
        let marked = at.filter(|&at| at >= first && at < first + shown.len()).map(|at| {
            let rest = &line[at..first + shown.len()];
            // To the end of the element, if one begins here.
            let end = match rest.iter().position(|&c| c == '>') {
                Some(end) if rest[0] == '<' => end + 1,
                _ => 1,
            };
            [at - first, end]
        });
        let text: String = shown.iter().collect();
        Self { number, text: text.trim_end().to_owned(), marked }
    }
}

impl fmt::Display for Excerpt {
    /// Lines that begin with blanks, the last without its end.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = self.number.to_string();
        let margin = " ".repeat(number.len());
        write!(f, "  {margin} |\n  {number} | {}", self.text)?;
        if let Some([first, length]) = self.marked {
            write!(f, "\n  {margin} | {}{}", " ".repeat(first), "^".repeat(length))?;
        }
        Ok(())
    }
}

/// A line of a text file, counted from 1 and without its end.
fn line(path: &Path, number: u32) -> Option<String> {
    // Pipes and devices are not read twice.
    if !std::fs::metadata(path).ok()?.is_file() {
        return None;
    }
    let mut file = BufReader::new(File::open(path).ok()?.take(MOST_BYTES));
    let mut bytes = Vec::new();
    for _ in 0..number {
        bytes.clear();
        if file.read_until(b'\n', &mut bytes).ok()? == 0 {
            return None;
        }
    }
    let text = String::from_utf8(bytes).ok()?;
    Some(text.trim_end_matches(['\n', '\r']).trim_start_matches('\u{feff}').to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_element_is_underlined() {
        let excerpt = Excerpt::of("    <float name=\"x\"/> <b/>", 12, Some(5));
        let expected = "     |\n  12 | <float name=\"x\"/> <b/>\n     | ^^^^^^^^^^^^^^^^^";
        assert_eq!(excerpt.to_string(), expected);
    }

    #[test]
    fn a_line_without_a_column_is_shown_alone() {
        assert_eq!(Excerpt::of("f 1 2 9\t", 3, None).to_string(), "    |\n  3 | f 1 2 9");
        assert_eq!(Excerpt::of("", 3, Some(7)).to_string(), "    |\n  3 | ");
    }

    #[test]
    fn a_long_line_is_shown_around_the_place() {
        let line = format!("{}<here/>{}", "x".repeat(500), "y".repeat(500));
        let shown = Excerpt::of(&line, 1, Some(501)).to_string();
        assert!(shown.contains("<here/>") && shown.contains("^^^^^^^"), "{shown}");
        assert!(shown.lines().all(|line| line.chars().count() < WIDTH + 10), "{shown}");
    }

    #[test]
    fn what_is_no_line_of_text_is_not_shown() {
        let folder = tempfile::tempdir().expect("a writable folder");
        let path = folder.path().join("a");
        std::fs::write(&path, b"one\r\ntwo\n\xff\n").expect("a writable folder");
        assert_eq!(line(&path, 1).as_deref(), Some("one"));
        assert_eq!(line(&path, 2).as_deref(), Some("two"));
        assert_eq!(line(&path, 3), None);
        assert_eq!(line(&path, 4), None);
        assert_eq!(line(folder.path(), 1), None);
    }
}
