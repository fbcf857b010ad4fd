//! How much the files of a scene may unfold to.

use alloc::collections::BTreeMap;
use alloc::format;
use std::fs;
use std::path::{Path, PathBuf};

use crate::error::{Location, SceneError};

/// Files of N bytes together may unfold to `FREE + RATIO · N` bytes of meshes, texels and values.
///
/// Each loader bounds what one file may unfold to. This bounds what a scene may make of them by naming the same file over and over,
/// or many small ones that are a long run of one colour: a hundred JPEG files of 4096², which are about 100 times as large in
/// memory, are allowed.
const FREE: u64 = 1 << 32;
const RATIO: u64 = 256;

/// What the files of a scene have unfolded to so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Allowance {
    /// The size of each file that was read, however often.
    files: BTreeMap<PathBuf, u64>,
    bytes: u64,
}

impl Allowance {
    /// Accounts for what was just made of a file.
    ///
    /// # Errors
    /// More in all than there is reason for in files of this size.
    pub(crate) fn spend(&mut self, path: &Path, unfolded: usize) -> Result<(), SceneError> {
        if !self.files.contains_key(path) {
            let size = fs::metadata(path).map_or(0, |metadata| metadata.len());
            self.files.insert(path.to_path_buf(), size);
        }
        self.bytes = self.bytes.saturating_add(unfolded as u64);
        let size: u64 = self.files.values().sum();
        if self.bytes <= FREE.saturating_add(RATIO.saturating_mul(size)) {
            return Ok(());
        }
        let message = format!(
            "with this file, what the scene reads unfolds to {} bytes, out of all proportion to its {} files of {size} bytes",
            self.bytes,
            self.files.len()
        );
        Err(SceneError::resource(Location::file(path), message)
            .help("refer to a texture or make instances of a mesh instead of reading a file again"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ErrorKind;

    #[test]
    fn a_file_that_is_read_again_counts_once_and_what_is_made_of_it_every_time() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
        fs::write(&a, [0; 100]).expect("writable");
        fs::write(&b, [0; 10]).expect("writable");
        let mut allowance = Allowance::default();
        assert_eq!(allowance.spend(&a, FREE as usize), Ok(()));
        assert_eq!(allowance.spend(&a, 100 * RATIO as usize), Ok(()));
        assert_eq!(allowance.spend(&b, 10 * RATIO as usize), Ok(()));
        let error = allowance.spend(&a, 1).expect_err("one byte too many");
        assert_eq!(error.kind, ErrorKind::Resource);
        assert!(error.message.contains("its 2 files of 110 bytes"), "{error}");
    }
}
