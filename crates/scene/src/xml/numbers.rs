//! Numbers as scene files write them.

use alloc::vec::Vec;

/// A finite number; surrounding blanks are allowed, anything else is not.
pub(crate) fn parse_float(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|x: &f64| x.is_finite())
}

/// A whole number; surrounding blanks are allowed.
pub(crate) fn parse_integer(text: &str) -> Option<i64> {
    text.trim().parse().ok()
}

/// The items of a list separated by commas, blanks, or both.
pub(crate) fn items(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| c == ',' || c.is_whitespace()).filter(|item| !item.is_empty())
}

/// Numbers separated by commas, blanks, or both; the first item that is none is the error.
pub(crate) fn parse_list(text: &str) -> Result<Vec<f64>, &str> {
    items(text).map(|item| parse_float(item).ok_or(item)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    #[test]
    fn only_finite_numbers_are_numbers() {
        assert_eq!(parse_float(" -1.5e2 "), Some(-150.0));
        for text in ["", "nan", "inf", "-infinity", "1e999", "1,5", "1 2", "0x10", "1.0f"] {
            assert_eq!(parse_float(text), None, "{text:?}");
        }
    }

    #[test]
    fn whole_numbers_have_no_fraction() {
        assert_eq!(parse_integer(" 12\n"), Some(12));
        for text in ["", "1.0", "1e3", "9223372036854775808", "3 4"] {
            assert_eq!(parse_integer(text), None, "{text:?}");
        }
    }

    #[test]
    fn lists_are_separated_by_commas_or_blanks_or_both() {
        assert_eq!(parse_list(" 1, 2 3,4\t5 "), Ok(vec![1.0, 2.0, 3.0, 4.0, 5.0]));
        assert_eq!(parse_list("1, two, 3"), Err("two"));
        assert_eq!(parse_list(""), Ok(vec![]));
    }
}
