//! Names of what others refer to.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::String;

/// Names that are taken, without regard to letter case: some file systems know none.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    taken: BTreeSet<String>,
    /// The number to try next after a wish that was met before.
    next: BTreeMap<String, u32>,
}

impl Names {
    /// A name that nobody has yet, after a wish: the wish itself with hyphens in place of all that is no letter, digit, `-` or
    /// `_`, numbered if it is taken. Such a name is the same in XML, in the names of files and behind the `$` of neither.
    pub(super) fn unique(&mut self, wish: &str) -> String {
        // Longer ones are no names of files.
        let kept = wish.chars().take(80).map(|c| match c {
            '-' | '_' => c,
            c if c.is_alphanumeric() => c,
            _ => '-',
        });
        let kept: String = kept.collect();
        // Mitsuba keeps leading underscores for itself.
        let stem = match kept.trim_matches(['-', '_']) {
            "" => "unnamed",
            stem => stem,
        };
        let next = self.next.entry(stem.to_lowercase()).or_insert(1);
        loop {
            let number = *next;
            *next += 1;
            let name = if number == 1 { stem.into() } else { format!("{stem}-{number}") };
            if self.taken.insert(name.to_lowercase()) {
                return name;
            }
        }
    }
}
