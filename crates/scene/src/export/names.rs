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
    /// `_`, numbered if it is taken: no such character means anything in XML, to Mitsuba or in the name of a file.
    pub(super) fn unique(&mut self, wish: &str) -> String {
        // File systems have room for 255 bytes, of which a character takes up to four.
        let kept = wish.chars().take(50).map(|c| match c {
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
