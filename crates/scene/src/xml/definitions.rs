//! `$name` in attribute values.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

/// One name that `$name` stands for.
#[derive(Clone, Debug)]
struct Definition {
    name: String,
    value: String,
    used: bool,
}

/// The names that are defined so far, by the caller or by `<default>`.
///
/// The caller's come first and win: a `<default>` of the same name changes nothing. As in Mitsuba
/// the longest defined name that fits is replaced, so `$size2` is `$size` followed by `2` when only
/// `size` is defined.
#[derive(Clone, Debug)]
pub(crate) struct Definitions(Vec<Definition>);

impl Definitions {
    /// The caller's definitions; of two with the same name the later wins.
    pub(crate) fn new(definitions: &[(String, String)]) -> Self {
        let mut result = Self(Vec::new());
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
        if !self.0.iter().any(|d| d.name == name) {
            let at = self.0.partition_point(|d| d.name.len() >= name.len());
            self.0.insert(at, Definition { name: name.into(), value: value.into(), used });
        }
    }

    /// Replaces every `$name`; `\$` is a dollar sign.
    ///
    /// # Errors
    /// The name that is not defined.
    pub(crate) fn substitute(&mut self, text: &str) -> Result<String, String> {
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
            let found = self.0.iter_mut().find(|d| after.starts_with(d.name.as_str()));
            let Some(definition) = found else {
                let end = after.find(|c: char| !c.is_alphanumeric() && c != '_');
                return Err(after[..end.unwrap_or(after.len())].into());
            };
            definition.used = true;
            result.push_str(&definition.value);
            rest = &after[definition.name.len()..];
        }
        result.push_str(rest);
        Ok(result)
    }

    /// The caller's definitions that nothing used, as `name=value`.
    pub(crate) fn unused(&self) -> Vec<String> {
        self.0.iter().filter(|d| !d.used).map(|d| format!("{}={}", d.name, d.value)).collect()
    }

    /// All names.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|d| d.name.as_str())
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
        assert_eq!(d.substitute("$x ${y}"), Err(String::new()));
        assert_eq!(d.substitute("$x $what_1-2"), Err("what_1".into()));
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
    fn a_replacement_is_not_replaced_again() {
        let mut d = given(&[("x", "$x$x")]);
        assert_eq!(d.substitute("$x"), Ok("$x$x".into()));
    }
}
