//! A part of a render, which follows the picture of its file.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use super::envelope::{Header, Stored};
use crate::failure::{Exit, Failure};
use crate::output::part_length;

/// A part of a render of which no more than the header has been read.
#[derive(Debug)]
pub(crate) struct Part {
    path: PathBuf,
    length: u64,
    pub(crate) header: Header,
}

impl Part {
    /// Finds the part in an EXR picture.
    ///
    /// # Errors
    /// A file that is none, or a damaged one.
    pub(crate) fn open(path: &Path) -> Result<Self, Failure> {
        let length = part_length(path).ok_or_else(|| {
            let message =
                "not a part of a render, which `etendue render --shard` writes, or damaged";
            failure(path, message)
        })?;
        let header = Header::read(end_of(path, length)?);
        let header = header.map_err(|complaint| failure(path, complaint))?;
        Ok(Self { path: path.to_path_buf(), length, header })
    }

    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Reads all of it.
    ///
    /// # Errors
    /// It is damaged.
    pub(crate) fn read(&self) -> Result<Stored, Failure> {
        let mut bytes = Vec::new();
        let read = end_of(&self.path, self.length)?.read_to_end(&mut bytes);
        read.map_err(|error| failure(&self.path, error))?;
        Stored::from_bytes(&bytes).map_err(|complaint| failure(&self.path, complaint))
    }
}

/// So many bytes at the end of a file.
fn end_of(path: &Path, length: u64) -> Result<File, Failure> {
    let open = || {
        let mut file = File::open(path)?;
        let begin = file.metadata()?.len().saturating_sub(length);
        file.seek(SeekFrom::Start(begin))?;
        Ok(file)
    };
    open().map_err(|error: std::io::Error| failure(path, error))
}

fn failure(path: &Path, message: impl core::fmt::Display) -> Failure {
    Failure::new(Exit::InputOutput, format!("{}: {message}", path.display()))
}
