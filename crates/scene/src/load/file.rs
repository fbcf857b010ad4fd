//! Asset files: regular files only.

use alloc::format;
use alloc::vec::Vec;
use std::fs::{self, File};
use std::io::{self, Read as _};
use std::path::Path;

use crate::error::{Location, SceneError};

/// The bytes of a regular file.
///
/// Devices, pipes and directories are refused before they are opened, since opening a pipe blocks
/// and a device never ends. No more is read than the size the file system states.
///
/// # Errors
/// [`ErrorKind::Io`](crate::ErrorKind::Io) for a file that is missing, unreadable or not regular;
/// [`ErrorKind::Resource`](crate::ErrorKind::Resource) for one that does not fit in memory.
pub fn read_asset(path: &Path) -> Result<Vec<u8>, SceneError> {
    let (file, size) = open_asset(path)?;
    let mut bytes = Vec::new();
    usize::try_from(size).ok().and_then(|n| bytes.try_reserve_exact(n).ok()).ok_or_else(|| {
        SceneError::resource(Location::file(path), format!("{size} bytes do not fit in memory"))
    })?;
    file.take(size).read_to_end(&mut bytes).map_err(|error| SceneError::io(path, &error))?;
    Ok(bytes)
}

/// A regular file and its size, of which no more should be read.
///
/// # Errors
/// As [`read_asset`].
pub(super) fn open_asset(path: &Path) -> Result<(File, u64), SceneError> {
    let io = |error: io::Error| SceneError::io(path, &error);
    let metadata = fs::metadata(path).map_err(io)?;
    if !metadata.is_file() {
        return Err(io(io::Error::new(io::ErrorKind::InvalidInput, "not a regular file")));
    }
    Ok((File::open(path).map_err(io)?, metadata.len()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;

    #[test]
    fn directories_devices_and_missing_files_are_input_errors() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let missing = folder.path().join("missing.obj");
        for path in [folder.path(), Path::new("/dev/zero"), &missing] {
            let error = read_asset(path).expect_err("no regular file");
            assert_eq!(error.kind, ErrorKind::Io);
            assert_eq!(error.location.file, path);
        }
    }

    #[test]
    fn a_regular_file_is_read_whole() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("a");
        fs::write(&path, b"abc").expect("a writable folder");
        assert_eq!(read_asset(&path), Ok(b"abc".to_vec()));
    }
}
