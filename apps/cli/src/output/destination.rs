//! A file that is replaced as a whole or not at all.

use std::io::Write;
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::failure::Failure;

/// A destination that has been found writable.
#[derive(Debug)]
pub(crate) struct Destination {
    path: PathBuf,
}

impl Destination {
    /// Checks that a file can be created beside the destination.
    pub(crate) fn check(path: &Path) -> Result<Self, Failure> {
        if path.is_dir() {
            return Err(Failure::write(path, "it is a directory"));
        }
        if path.metadata().is_ok_and(|m| m.permissions().readonly()) {
            return Err(Failure::write(path, "the file is read-only"));
        }
        let destination = Self { path: path.to_path_buf() };
        let folder = destination.folder();
        if !folder.is_dir() {
            let message = format!("{} is not a folder; create it first", folder.display());
            return Err(Failure::write(path, message));
        }
        destination.temporary()?;
        Ok(destination)
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes a temporary file in the same directory and renames it: the destination is either
    /// untouched or complete.
    pub(crate) fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        let mut file = self.temporary()?;
        let fail = |error| Failure::write(&self.path, error);
        file.write_all(bytes).map_err(fail)?;
        file.as_file().sync_all().map_err(fail)?;
        file.persist(&self.path).map_err(|e| fail(e.error))?;
        Ok(())
    }

    fn folder(&self) -> &Path {
        match self.path.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        }
    }

    fn temporary(&self) -> Result<NamedTempFile, Failure> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".etendue-").suffix(".tmp");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // Temporary files are private by default; a picture is an ordinary file. The umask still applies.
            builder.permissions(std::fs::Permissions::from_mode(0o666));
        }
        builder.tempfile_in(self.folder()).map_err(|error| Failure::write(&self.path, error))
    }
}
