//! `$name` in attribute values.

use alloc::collections::BTreeMap;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::Bound;

/// The longest value that names may be replaced to, in bytes, and all of them together: names stand for values with names in them,
/// so that a few lines could ask for more than any memory.
const LONGEST: usize = 1 << 20;
const MOST: usize = 1 << 26;

/// What one name stands for.
#[derive(Clone, Debug)]
struct Definition {
    value: String,
    used: bool,
}

/// Why names cannot be replaced.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum SubstitutionError {
    /// Nothing is defined by this name.
    Undefined(String),
    /// More than this many bytes would come of it.
    TooLong(usize),
}

/// The names that are defined so far, by the caller or by `<default>`.
///
/// The caller's come first and win: a `<default>` of the same name changes nothing. As in Mitsuba
/// the longest defined name that fits is replaced, so `$size2` is `$size` followed by `2` when only
/// `size` is defined.
#[derive(Clone, Debug)]
pub(crate) struct Definitions {
    names: BTreeMap<String, Definition>,
    /// Bytes that names were replaced by so far.
    replaced: usize,
}

impl Definitions {
    /// The caller's definitions; of two with the same name the later wins.
    pub(crate) fn new(definitions: &[(String, String)]) -> Self {
        let mut result = Self { names: BTreeMap::new(), replaced: 0 };
        for (name, value) in definitions.iter().rev() {
            result.insert(name, value, false);
        }
        result
    }

    /// Defines a name unless it is defined already. Defaults need not be used.
    pub(crate) fn define_default(&mut self, name: &str, value: &str) {
        self.insert(name, value, true);
    }

    fn insert(&mut self, name: &str, value: &str, used: bool) {
        if !self.names.contains_key(name) {
            self.names.insert(name.into(), Definition { value: value.into(), used });
        }
    }

    /// Replaces every `$name`; `\$` is a dollar sign.
    ///
    /// # Errors
    /// A name that is not defined, a value that grows too long.
    pub(crate) fn substitute(&mut self, text: &str) -> Result<String, SubstitutionError> {
        let mut result = String::with_capacity(text.len());
        let mut rest = text;
        while let Some(at) = rest.find('$') {
            let (before, after) = (&rest[..at], &rest[at + 1..]);
            if let Some(before) = before.strip_suffix('\\') {
                result.push_str(before);
                result.push('$');
                rest = after;
                continue;
            }
            result.push_str(before);
            let Some((name, definition)) = longest_prefix(&self.names, after) else {
                let end = after.find(|c: char| !c.is_alphanumeric() && c != '_');
                let name = &after[..end.unwrap_or(after.len())];
                return Err(SubstitutionError::Undefined(name.into()));
            };
            let length = name.len();
            result.push_str(&definition.value);
            self.replaced += definition.value.len();
            for (length, most) in [(result.len(), LONGEST.max(text.len())), (self.replaced, MOST)] {
                if length > most {
                    return Err(SubstitutionError::TooLong(most));
                }
            }
            if !definition.used {
                let name: String = after[..length].into();
                self.names.entry(name).and_modify(|definition| definition.used = true);
            }
            rest = &after[length..];
        }
        result.push_str(rest);
        Ok(result)
    }

    /// The caller's definitions that nothing used, as `name=value`, the longest names first.
    pub(crate) fn unused(&self) -> Vec<String> {
        let mut unused: Vec<_> = self.names.iter().filter(|(_, d)| !d.used).collect();
        unused.sort_by_key(|(name, _)| core::cmp::Reverse(name.len()));
        unused.into_iter().map(|(name, d)| format!("{name}={}", d.value)).collect()
    }

    /// All names.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.names.keys().map(String::as_str)
    }
}

/// The longest name that a text begins with.
///
/// Whatever lies between a name that fits and the text begins with that name as well. So the last name that is not behind the text
/// either fits, or no longer one fits than what the two have in common.
fn longest_prefix<'a>(
    names: &'a BTreeMap<String, Definition>,
    text: &str,
) -> Option<(&'a str, &'a Definition)> {
    let mut text = text;
    loop {
        let not_behind = (Bound::Unbounded, Bound::Included(text));
        let (name, definition) = names.range::<str, _>(not_behind).next_back()?;
        if text.starts_with(name.as_str()) {
            return Some((name, definition));
        }
        let pairs = text.char_indices().zip(name.chars());
        let common = pairs.take_while(|((_, a), b)| a == b).last();
        text = common.map_or("", |((at, c), _)| &text[..at + c.len_utf8()]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec;

    fn given(definitions: &[(&str, &str)]) -> Definitions {
        let owned: Vec<_> = definitions.iter().map(|&(n, v)| (n.into(), v.into())).collect();
        Definitions::new(&owned)
    }

    #[test]
    fn the_longest_name_that_fits_is_replaced() {
        let mut d = given(&[("s", "1"), ("spp", "2"), ("sp", "3")]);
        assert_eq!(d.substitute("a$spp b$sp c$s $spx$s"), Ok("a2 b3 c1 3x1".into()));
    }

    #[test]
    fn the_caller_wins_over_defaults_and_later_over_earlier() {
        let mut d = given(&[("x", "1"), ("x", "2")]);
        d.define_default("x", "3");
        d.define_default("y", "4");
        d.define_default("y", "5");
        assert_eq!(d.substitute("$x$y"), Ok("24".into()));
    }

    #[test]
    fn an_undefined_name_is_named_and_an_escaped_dollar_is_kept() {
        let mut d = given(&[("x", "1")]);
        assert_eq!(d.substitute("$x ${y}"), Err(SubstitutionError::Undefined(String::new())));
        assert_eq!(
            d.substitute("$x $what_1-2"),
            Err(SubstitutionError::Undefined("what_1".into()))
        );
        assert_eq!(d.substitute(r"\$x $x"), Ok("$x 1".into()));
    }

    #[test]
    fn unused_definitions_are_reported_but_not_unused_defaults() {
        let mut d = given(&[("x", "1"), ("y", "2")]);
        d.define_default("z", "3");
        assert_eq!(d.substitute("$x"), Ok("1".into()));
        assert_eq!(d.unused(), vec![String::from("y=2")]);
    }

    #[test]
    fn the_longest_name_is_found_among_many_that_nearly_fit() {
        let mut d = given(&[("a", "1"), ("ab", "2"), ("abb", "3"), ("abx", "4"), ("b", "5")]);
        for (text, expected) in
            [("$abd", "2d"), ("$abbb", "3b"), ("$ac", "1c"), ("$aé", "1é"), ("$bz", "5z")]
        {
            assert_eq!(d.substitute(text), Ok(expected.into()), "{text}");
        }
        assert_eq!(d.substitute("$Z"), Err(SubstitutionError::Undefined("Z".into())));
        assert_eq!(d.substitute("$é"), Err(SubstitutionError::Undefined("é".into())));
    }

    #[test]
    fn values_do_not_grow_without_end() {
        let value = "x".repeat(1000);
        let mut d = given(&[("x", &value)]);
        assert_eq!(d.substitute(&"$x".repeat(1000)).map(|text| text.len()), Ok(1_000_000));
        let too_long = d.substitute(&"$x".repeat(2000));
        assert_eq!(too_long, Err(SubstitutionError::TooLong(LONGEST)));
        let all = (0..100).try_for_each(|_| d.substitute(&"$x".repeat(1000)).map(drop));
        assert_eq!(all, Err(SubstitutionError::TooLong(MOST)));
    }

    #[test]
    fn a_replacement_is_not_replaced_again() {
        let mut d = given(&[("x", "$x$x")]);
        assert_eq!(d.substitute("$x"), Ok("$x$x".into()));
    }
}
