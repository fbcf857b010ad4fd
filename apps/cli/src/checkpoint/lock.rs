//! One render per checkpoint.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::path::{Path, PathBuf};

use crate::failure::{Exit, Failure};

/// That no other process writes a checkpoint, as long as it lives. The system ends it with the process, however that ends.
#[derive(Debug)]
pub(super) struct Lock {
    path: PathBuf,
    _file: File,
}

impl Lock {
    /// Of the checkpoint at a path.
    pub(super) fn of(checkpoint: &Path) -> Result<Self, Failure> {
        let mut name = std::ffi::OsString::from(".");
        name.push(checkpoint.file_name().unwrap_or_default());
        name.push(".lock");
        let path = checkpoint.with_file_name(name);
        // A pipe would wait for somebody to read it, and what a link leads to is not ours.
        if fs::symlink_metadata(&path).is_ok_and(|there| !there.is_file()) {
            return Err(Failure::write(&path, "not a regular file"));
        }
        let file = OpenOptions::new().write(true).create(true).truncate(false).open(&path);
        let file = file.map_err(|error| Failure::write(&path, error))?;
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => Err(Failure::new(
                Exit::InputOutput,
                format!("{}: another render is writing this checkpoint", checkpoint.display()),
            )),
            // Some network file systems have no locks.
            Ok(()) | Err(TryLockError::Error(_)) => Ok(Self { path, _file: file }),
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // An empty file that stays does no harm.
        let _ = fs::remove_file(&self.path);
    }
}
