//! Messages as text for a terminal.

use alloc::string::String;

/// Characters of a message, beyond which it is shown without its middle, and how many of each end are.
const LONGEST: usize = 1000;
const ENDS: usize = 450;

/// A message, which quotes what files hold, as text for a terminal: on one line, without codes that would do something there, of
/// bounded length (of more than 1000 characters the first and the last 450).
///
/// Codes are control characters and the marks that turn the direction of writing; they are shown by their numbers.
///
/// # Examples
/// ```
/// use etendue_scene::printable;
/// assert_eq!(printable("“\u{1b}[2J”\n".to_owned()), r"“\u{1b}[2J”\u{a}");
/// ```
pub fn printable(text: String) -> String {
    // Line breaks, escape codes, and marks that turn the direction of writing.
    let acts =
        |c: char| c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    if text.len() <= LONGEST && !text.contains(acts) {
        return text;
    }
    let shown = |c: char| if acts(c) { c.escape_unicode().collect() } else { String::from(c) };
    let count = text.chars().count();
    if count <= LONGEST {
        return text.chars().map(shown).collect();
    }
    let ends = [
        text.chars().take(ENDS).map(shown).collect(),
        text.chars().skip(count - ENDS).map(shown).collect(),
    ];
    let [begin, end]: [String; 2] = ends;
    alloc::format!("{begin} … {end}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_message_is_shown_without_its_middle() {
        let whole = "é".repeat(LONGEST);
        assert_eq!(printable(whole.clone()), whole);
        let shown = printable(alloc::format!("begin {whole} end"));
        assert!(shown.starts_with("begin é") && shown.ends_with("é end"), "{shown}");
        assert_eq!(shown.chars().count(), 2 * ENDS + 3);
    }
}
