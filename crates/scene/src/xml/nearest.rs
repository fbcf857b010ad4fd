//! Suggestions for misspelt names.

use alloc::vec::Vec;

/// Names that are longer, in bytes, are not compared, which takes the product of their lengths.
const LONGEST: usize = 100;

/// The candidate nearest to `name`, when it is near enough to be what was meant: at most one edit
/// for every three characters, letter case aside.
pub(crate) fn nearest<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    let limit = (name.chars().count() / 3).clamp(1, 3);
    candidates
        .into_iter()
        .filter(|candidate| name.len().max(candidate.len()) <= LONGEST)
        .map(|candidate| (edit_distance(name, candidate), candidate))
        .filter(|&(distance, _)| distance <= limit)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// Insertions, deletions, replacements and exchanges of neighbours, letter case aside (the
/// Damerau–Levenshtein distance restricted to one edit per character).
fn edit_distance(a: &str, b: &str) -> usize {
    let letters = |s: &str| s.chars().map(|c| c.to_ascii_lowercase()).collect::<Vec<_>>();
    let (a, b) = (letters(a), letters(b));
    // Distances of the prefixes of `a` that end before the last letter, here, and one further.
    let mut before = Vec::new();
    let mut here: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut next = Vec::with_capacity(here.len());
        next.push(i);
        for j in 1..=b.len() {
            let replaced = here[j - 1] + usize::from(a[i - 1] != b[j - 1]);
            let mut least = replaced.min(here[j] + 1).min(next[j - 1] + 1);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                let exchanged: usize = before[j - 2];
                least = least.min(exchanged + 1);
            }
            next.push(least);
        }
        before = core::mem::replace(&mut here, next);
    }
    here[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_counts_edits() {
        for (a, b, distance) in
            [("", "abc", 3), ("kitten", "sitting", 3), ("alpha", "ALPHA", 0), ("flaot", "float", 1)]
        {
            assert_eq!(edit_distance(a, b), distance, "{a} {b}");
        }
    }

    #[test]
    fn only_near_names_are_suggested() {
        let names = ["reflectance", "alpha", "sample_count"];
        assert_eq!(nearest("reflectence", names), Some("reflectance"));
        assert_eq!(nearest("samplecount", names), Some("sample_count"));
        assert_eq!(
            nearest("alphabet", names),
            None,
            "three edits of eight characters are too many"
        );
        assert_eq!(nearest("radius", names), None);
    }
}
