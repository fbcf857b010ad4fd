//! One warning per kind of ignored content.

use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::String;

use crate::error::{Location, Warning, Warnings};

/// How many kinds are reported: binary data read as text has thousands.
pub(super) const MOST_KINDS: usize = 20;

/// Warnings about ignored content, the first of each kind.
#[derive(Default)]
pub(super) struct KindWarnings {
    seen: BTreeSet<String>,
    warnings: Warnings,
}

impl KindWarnings {
    /// Reports that a kind of content is ignored, unless that is known.
    pub(super) fn add(&mut self, location: impl FnOnce() -> Location, kind: &str) {
        if self.seen.len() < MOST_KINDS && !self.seen.contains(kind) {
            self.seen.insert(kind.into());
            self.warnings.push(Warning::new(location(), format!("{kind} is ignored")));
        }
    }

    /// Passes on any other warning.
    pub(super) fn push(&mut self, warning: Warning) {
        self.warnings.push(warning);
    }

    /// Passes on the warnings of another file.
    pub(super) fn extend(&mut self, warnings: Warnings) {
        self.warnings.extend(warnings);
    }

    /// All warnings in the order they were found.
    pub(super) fn into_vec(self) -> Warnings {
        self.warnings
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_reported_once_and_not_without_end() {
        let mut warnings = KindWarnings::default();
        for i in 0..100 {
            warnings.add(Location::default, "'l'");
            warnings.add(Location::default, &format!("'{i}'"));
        }
        let warnings = warnings.into_vec();
        assert_eq!(warnings.len(), MOST_KINDS);
        assert_eq!(warnings[0].message, "'l' is ignored");
    }
}
