//! What a stored render is a render of.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use etendue_scene::load::read_asset;
use serde::{Deserialize, Serialize};

use super::content::content_hash;
use crate::failure::Failure;

/// Everything that the samples of a render depend on.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Identity {
    /// Of the program.
    version: String,
    /// Name and value of each setting, as on the command line, those of the scene file included.
    settings: Vec<(String, String)>,
    /// Every file that was read, as seen from the folder of the first, and a hash of its content.
    files: Vec<(String, String)>,
}

impl Identity {
    /// * `files`: the scene's own first.
    ///
    /// # Errors
    /// A file that was just read cannot be read again.
    pub(crate) fn new(settings: Vec<(String, String)>, files: &[PathBuf]) -> Result<Self, Failure> {
        let folder = files.first().and_then(|scene| scene.parent()).unwrap_or(Path::new(""));
        let mut hashes = Vec::with_capacity(files.len());
        for path in files {
            let name = path.strip_prefix(folder).unwrap_or(path).display().to_string();
            hashes.push((name, format!("{:016x}", content_hash(&read_asset(path)?))));
        }
        // Files that are read in parallel have no order of their own.
        hashes[1.min(files.len())..].sort_unstable();
        hashes.dedup();
        Ok(Self { version: env!("CARGO_PKG_VERSION").to_owned(), settings, files: hashes })
    }

    /// The value of a setting.
    pub(crate) fn setting(&self, name: &str) -> Option<&str> {
        value(&self.settings, name)
    }

    /// In what a stored render, `self`, differs from another one; `None` if in nothing.
    pub(crate) fn difference(&self, other: &Self) -> Option<String> {
        let mut differences = Vec::new();
        if self.version != other.version {
            differences.push(format!(
                "it was made by version {}, this is version {}",
                self.version, other.version
            ));
        }
        for (name, [then, now]) in changes(&self.settings, &other.settings) {
            differences.push(match (then, now) {
                (Some(then), Some(now)) => {
                    format!("it was made with {name} {then}, now it is {now}")
                }
                (Some(then), None) => format!("it was made with {name} {then}, now without"),
                (None, now) => {
                    format!("it was made without {name}, now it is {}", now.unwrap_or_default())
                }
            });
        }
        // The scene itself may have moved: its name is that of its folder's content.
        for (name, [then, now]) in changes(&self.files, &other.files) {
            differences.push(match (then, now) {
                (Some(_), Some(_)) => format!("the file {name} has changed"),
                (Some(_), None) => format!("the file {name} is no longer read"),
                (None, _) => format!("the file {name} was not read then"),
            });
        }
        (!differences.is_empty()).then(|| differences.join("; "))
    }
}

fn value<'p>(pairs: &'p [(String, String)], name: &str) -> Option<&'p str> {
    pairs.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
}

/// The names whose values differ, with what they were and what they are.
fn changes<'p>(
    then: &'p [(String, String)],
    now: &'p [(String, String)],
) -> impl Iterator<Item = (&'p str, [Option<&'p str>; 2])> {
    // Whoever makes a checkpoint may put any number of them there. Of equal names the first counts.
    let values = |pairs: &'p [(String, String)]| -> HashMap<&'p str, &'p str> {
        pairs.iter().rev().map(|(name, value)| (name.as_str(), value.as_str())).collect()
    };
    let [before, after] = [then, now].map(values);
    let new = now.iter().filter(|(name, _)| !before.contains_key(name.as_str()));
    let names: Vec<&str> = then.iter().chain(new).map(|(name, _)| name.as_str()).collect();
    names
        .into_iter()
        .map(move |name| (name, [&before, &after].map(|values| values.get(name).copied())))
        .filter(|(_, [then, now])| then != now)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn identity(settings: &[(&str, &str)], files: &[(&str, &str)]) -> Identity {
        let owned = |pairs: &[(&str, &str)]| {
            pairs.iter().map(|&(name, value)| (name.to_owned(), value.to_owned())).collect()
        };
        Identity { version: "1".to_owned(), settings: owned(settings), files: owned(files) }
    }

    #[test]
    fn differences_are_named() {
        let stored =
            identity(&[("--max-depth", "8"), ("--seed", "0")], &[("a.xml", "0"), ("b.ply", "1")]);
        assert_eq!(stored.difference(&stored), None);
        let cases = [
            (
                identity(
                    &[("--max-depth", "4"), ("--seed", "0")],
                    &[("a.xml", "0"), ("b.ply", "1")],
                ),
                "it was made with --max-depth 8, now it is 4",
            ),
            (
                identity(
                    &[("--max-depth", "8"), ("--spectral", "yes")],
                    &[("a.xml", "0"), ("b.ply", "2")],
                ),
                "it was made with --seed 0, now without; it was made without --spectral, now it is yes; \
                 the file b.ply has changed",
            ),
            (
                identity(
                    &[("--max-depth", "8"), ("--seed", "0")],
                    &[("a.xml", "0"), ("c.ply", "1")],
                ),
                "the file b.ply is no longer read; the file c.ply was not read then",
            ),
            (
                Identity { version: "2".to_owned(), ..stored.clone() },
                "it was made by version 1, this is version 2",
            ),
        ];
        for (now, expected) in cases {
            assert_eq!(stored.difference(&now).as_deref(), Some(expected));
        }
    }
}
