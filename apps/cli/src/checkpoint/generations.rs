//! A file of which the newest complete content is never lost: it is written anew beside itself, and the content before is kept.

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};

use super::store::Store;

/// A file in two generations: `NAME` and, older, `NAME.previous`.
///
/// # Protocol
/// 1. `.NAME.tmp` is written and synced: from here on its content survives a loss of power.
/// 2. `NAME` becomes `NAME.previous`, if `NAME` is known to be complete.
/// 3. `.NAME.tmp` becomes `NAME`.
/// 4. The folder is synced: from here on the names survive as well.
///
/// A crash between two steps, or a loss of power that undoes any of the unsynced ones, leaves a complete generation under one of the two
/// names, and it is the one of the last [`save`](Self::save) that succeeded, or a newer one.
#[derive(Debug)]
pub(crate) struct Generations<S> {
    store: S,
    path: PathBuf,
    /// Whether `NAME` is there and complete.
    good: bool,
}

/// What was found under the two names.
#[derive(Debug)]
pub(crate) enum Found<T> {
    /// Neither is there.
    Nothing,
    /// The newest complete content, and what is wrong with the newer one if it is the older.
    Content(T, Option<String>),
    /// Something is there, but nothing complete; what is wrong with it.
    Damage(String),
}

impl<S: Store> Generations<S> {
    /// The file at a path.
    pub(crate) fn new(store: S, path: &Path) -> Self {
        Self { store, path: path.to_path_buf(), good: false }
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The newest content that `parse` accepts.
    pub(crate) fn load<T>(&mut self, parse: impl Fn(&[u8]) -> Result<T, String>) -> Found<T> {
        let mut wrong = Vec::new();
        for (path, newest) in [(self.path.clone(), true), (self.previous(), false)] {
            let complaint = match self.store.read(&path) {
                Ok(bytes) => match parse(&bytes) {
                    Ok(content) => {
                        self.good = newest;
                        return Found::Content(content, wrong.into_iter().next());
                    }
                    Err(complaint) => complaint,
                },
                Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                Err(error) => format!("cannot read: {error}"),
            };
            wrong.push(format!("{}: {complaint}", path.display()));
        }
        if wrong.is_empty() { Found::Nothing } else { Found::Damage(wrong.join("; ")) }
    }

    /// Removes what a crash has left of a generation that was being written.
    pub(crate) fn clean(&self) {
        // What cannot be removed is overwritten, or else that fails with a message.
        let _ = self.store.remove(&self.temporary());
    }

    /// Replaces the content.
    pub(crate) fn save(&mut self, bytes: &[u8]) -> io::Result<()> {
        let temporary = self.temporary();
        let written = self.write(&temporary, bytes);
        if written.is_err() {
            // The room is needed for the next attempt.
            self.clean();
        }
        written?;
        if self.good {
            self.store.rename(&self.path, &self.previous())?;
            self.good = false;
        }
        self.store.rename(&temporary, &self.path)?;
        self.good = true;
        self.store.sync_folder(folder(&self.path))
    }

    fn write(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let mut file = self.store.create(path)?;
        self.store.write(&mut file, bytes)?;
        self.store.sync(&file)
    }

    fn previous(&self) -> PathBuf {
        self.beside("", ".previous")
    }

    fn temporary(&self) -> PathBuf {
        self.beside(".", ".tmp")
    }

    fn beside(&self, prefix: &str, suffix: &str) -> PathBuf {
        let mut name = OsString::from(prefix);
        name.push(self.path.file_name().unwrap_or_default());
        name.push(suffix);
        self.path.with_file_name(name)
    }
}

/// The folder that a file is in.
pub(crate) fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests;
