//! Where the files a scene names are looked for.

use alloc::sync::Arc;
use std::path::{Path, PathBuf};

use crate::load::Sandbox;
use crate::{Location, SceneError};

/// Folders in the order in which they are searched.
///
/// The folder of the scene file comes first; each `<path>` goes before it, and so does the folder of
/// an included file while that file is read. Every plugin has a copy, so that the folders are shared.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SearchPath {
    folders: Arc<[PathBuf]>,
    sandbox: Sandbox,
}

impl SearchPath {
    /// No folder yet; what is found in those that follow must lie in a sandbox.
    pub(crate) fn within(sandbox: &Sandbox) -> Self {
        Self { folders: Arc::default(), sandbox: sandbox.clone() }
    }

    /// The folder that holds `file`.
    pub fn beside(file: &Path) -> Self {
        let mut path = Self::default();
        path.prepend_folder_of(file);
        path
    }

    /// Searches the folder that holds `file` first.
    pub(crate) fn prepend_folder_of(&mut self, file: &Path) {
        self.prepend(file.parent().unwrap_or(Path::new("")).to_path_buf());
    }

    /// Searches `folder` first.
    pub(crate) fn prepend(&mut self, folder: PathBuf) {
        self.folders = core::iter::once(folder).chain(self.folders.iter().cloned()).collect();
    }

    /// How many folders are searched.
    pub(crate) fn len(&self) -> usize {
        self.folders.len()
    }

    /// The first existing file or folder of that name. Where there is none, the place looked at
    /// first, so that an error can name it. Backslashes count as slashes when nothing has them.
    ///
    /// # Errors
    /// No name; a file or folder outside of the sandbox, if there is one.
    pub fn resolve(&self, name: &str) -> Result<PathBuf, SceneError> {
        if name.is_empty() {
            return Err(SceneError::scene(Location::default(), "a file name is empty"));
        }
        let find = |name: &str| self.folders.iter().map(|f| f.join(name)).find(|p| p.exists());
        let found = find(name)
            .or_else(|| name.contains('\\').then(|| find(&name.replace('\\', "/"))).flatten())
            .unwrap_or_else(|| self.folders.first().map_or_else(|| name.into(), |f| f.join(name)));
        self.sandbox.check(&found)?;
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_are_searched_in_order_and_the_first_is_named_in_vain() {
        let folder = tempfile::tempdir().unwrap();
        let inner = folder.path().join("inner");
        std::fs::create_dir(&inner).unwrap();
        std::fs::write(folder.path().join("a.txt"), "").unwrap();
        std::fs::write(folder.path().join("b.txt"), "").unwrap();
        std::fs::write(inner.join("a.txt"), "").unwrap();
        let mut path = SearchPath::beside(&folder.path().join("scene.xml"));
        path.prepend(inner.clone());
        assert_eq!(path.resolve("a.txt"), Ok(inner.join("a.txt")));
        assert_eq!(path.resolve("b.txt"), Ok(folder.path().join("b.txt")));
        assert_eq!(path.resolve("inner\\a.txt"), Ok(inner.join("a.txt")));
        assert_eq!(path.resolve("c.txt"), Ok(inner.join("c.txt")));
        let absolute = folder.path().join("b.txt");
        assert_eq!(path.resolve(&absolute.to_string_lossy()), Ok(absolute));
    }
}
