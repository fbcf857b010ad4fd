//! Documents of which a program writes a part.
//!
//! A part stands between two lines, `<!-- begin NAME -->` and `<!-- end NAME -->`. What precedes the
//! first marker on its line (`//! ` in documentation comments) precedes every line of the part.

use core::fmt;

/// A document without the markers of a part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MissingPart {
    name: String,
}

impl fmt::Display for MissingPart {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no lines '<!-- begin {0} -->' and '<!-- end {0} -->'", self.name)
    }
}

/// The document with the part `name` replaced.
///
/// # Errors
/// [`MissingPart`] where one of the markers is missing or they stand in the wrong order.
pub fn with_part(document: &str, name: &str, part: &str) -> Result<String, MissingPart> {
    let missing = || MissingPart { name: name.to_owned() };
    let (begin, end) = (format!("<!-- begin {name} -->"), format!("<!-- end {name} -->"));
    let begin_at = document.find(&begin).ok_or_else(missing)?;
    let end_at = document[begin_at..].find(&end).ok_or_else(missing)? + begin_at;
    let line = document[..begin_at].rfind('\n').map_or(0, |i| i + 1);
    let prefix = &document[line..begin_at];
    let mut text = document[..begin_at + begin.len()].to_owned();
    text.push('\n');
    for line in part.trim_end().lines() {
        text.push_str(format!("{prefix}{line}").trim_end());
        text.push('\n');
    }
    text.push_str(prefix);
    text.push_str(&document[end_at..]);
    Ok(text)
}

/// A line of a table; no text ends its cell.
pub fn row<'a>(cells: impl IntoIterator<Item = &'a str>) -> String {
    let mut text = String::new();
    for content in cells {
        text += "| ";
        text += &content.replace('|', "\\|");
        text += " ";
    }
    text + "|\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    const DOCUMENT: &str = "a\n//! <!-- begin x -->\n//! old\n//! <!-- end x -->\nb\n";

    #[test]
    fn a_part_is_replaced_with_its_prefix_and_nothing_else_is_touched() {
        let new = with_part(DOCUMENT, "x", "1\n\n2\n").unwrap();
        assert_eq!(new, "a\n//! <!-- begin x -->\n//! 1\n//!\n//! 2\n//! <!-- end x -->\nb\n");
        assert_eq!(with_part(&new, "x", "1\n\n2\n").unwrap(), new);
    }

    #[test]
    fn a_bar_does_not_end_a_cell() {
        assert_eq!(row(["a|b", "c"]), "| a\\|b | c |\n");
    }

    #[test]
    fn missing_markers_are_named() {
        let error = with_part(DOCUMENT, "y", "").unwrap_err();
        assert!(error.to_string().contains("begin y"));
    }
}
