//! What an experiment has done so far, in a folder.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use etendue_renderer::Image;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use super::job::Record;

/// A folder with the records of an experiment and its references.
///
/// `experiment.json` is replaced as a whole after every record, so that it is complete at any moment;
/// `reference-0.bin` and `reference-1.bin` hold width, height and pixels as little-endian 32-bit numbers.
#[derive(Debug)]
pub struct Checkpoint {
    folder: PathBuf,
    state: State,
}

#[derive(Debug, Serialize, Deserialize)]
struct State {
    /// What the records depend on.
    circumstances: Map<String, Value>,
    records: Vec<Record>,
}

/// Why a checkpoint cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// A file cannot be read or written.
    #[error("{}: {error}", path.display())]
    Io {
        /// Which one.
        path: PathBuf,
        /// Why.
        error: io::Error,
    },
    /// A file is not what a checkpoint writes.
    #[error("{}: not a checkpoint of this command ({reason}); remove it or name another folder", path.display())]
    Content {
        /// Which one.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// It belongs to another experiment.
    #[error("{}: a checkpoint of another experiment: {differences}; remove it or name another folder", path.display())]
    Mismatch {
        /// The file.
        path: PathBuf,
        /// What differs, and how.
        differences: String,
    },
}

const EXPERIMENT: &str = "experiment.json";

impl Checkpoint {
    /// Opens the folder, or makes it.
    ///
    /// # Errors
    /// Files that cannot be read or written, or hold the records of another experiment: one under other
    /// `circumstances`.
    pub fn open(folder: &Path, circumstances: Map<String, Value>) -> Result<Self, CheckpointError> {
        if folder.exists() && !folder.is_dir() {
            return Err(io_error(folder, io::ErrorKind::NotADirectory.into()));
        }
        fs::create_dir_all(folder).map_err(|error| io_error(folder, error))?;
        let path = folder.join(EXPERIMENT);
        let state = match fs::read_to_string(&path) {
            Ok(text) => {
                let state: State = serde_json::from_str(&text).map_err(|error| {
                    CheckpointError::Content { path: path.clone(), reason: error.to_string() }
                })?;
                let differences = differences(&state.circumstances, &circumstances);
                if !differences.is_empty() {
                    return Err(CheckpointError::Mismatch { path, differences });
                }
                state
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                State { circumstances, records: Vec::new() }
            }
            Err(error) => return Err(io_error(&path, error)),
        };
        let checkpoint = Self { folder: folder.to_path_buf(), state };
        // Found out now rather than after the first hour.
        checkpoint.save()?;
        Ok(checkpoint)
    }

    /// What is done.
    pub fn records(&self) -> &[Record] {
        &self.state.records
    }

    /// Keeps another record.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn push(&mut self, record: Record) -> Result<(), CheckpointError> {
        self.state.records.push(record);
        self.save()
    }

    /// A reference that was kept.
    ///
    /// # Errors
    /// The file cannot be read or holds something else.
    pub fn reference(&self, number: usize) -> Result<Option<Image>, CheckpointError> {
        let path = self.reference_path(number);
        match fs::read(&path) {
            Ok(bytes) => decode(&bytes).map(Some).ok_or_else(|| CheckpointError::Content {
                path,
                reason: "its length is wrong".to_owned(),
            }),
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(io_error(&path, error)),
        }
    }

    /// Keeps a reference.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn keep_reference(&self, number: usize, image: &Image) -> Result<(), CheckpointError> {
        replace(&self.reference_path(number), &encode(image))
    }

    fn reference_path(&self, number: usize) -> PathBuf {
        self.folder.join(format!("reference-{number}.bin"))
    }

    fn save(&self) -> Result<(), CheckpointError> {
        let path = self.folder.join(EXPERIMENT);
        let text = serde_json::to_vec_pretty(&self.state).map_err(|error| {
            CheckpointError::Content { path: path.clone(), reason: error.to_string() }
        })?;
        replace(&path, &text)
    }
}

/// Writes beside the file and renames: it is the old one or the new one, whatever happens.
fn replace(path: &Path, bytes: &[u8]) -> Result<(), CheckpointError> {
    let beside = path.with_extension("tmp");
    fs::write(&beside, bytes).map_err(|error| io_error(&beside, error))?;
    fs::rename(&beside, path).map_err(|error| io_error(path, error))
}

fn io_error(path: &Path, error: io::Error) -> CheckpointError {
    CheckpointError::Io { path: path.to_path_buf(), error }
}

/// Every entry of the one or the other that is not the same in both.
fn differences(there: &Map<String, Value>, here: &Map<String, Value>) -> String {
    let all = here.keys().chain(there.keys().filter(|key| !here.contains_key(*key)));
    let shown = |value: Option<&Value>| value.map_or("nothing".to_owned(), Value::to_string);
    all.filter(|key| there.get(*key) != here.get(*key))
        .map(|key| {
            format!("{key} is {} there and {} now", shown(there.get(key)), shown(here.get(key)))
        })
        .collect::<Vec<_>>()
        .join(", ")
}

fn encode(image: &Image) -> Vec<u8> {
    let size = image.size().into_iter().flat_map(u32::to_le_bytes);
    let pixels = image.pixels().iter().flat_map(|p| p.to_array()).flat_map(f32::to_le_bytes);
    size.chain(pixels).collect()
}

fn decode(bytes: &[u8]) -> Option<Image> {
    let (words, rest) = bytes.as_chunks::<4>();
    let (size, pixels) = words.split_at_checked(2)?;
    let size = [u32::from_le_bytes(size[0]), u32::from_le_bytes(size[1])];
    let pixels = pixels.as_chunks::<3>().0.iter().map(|p| p.map(f32::from_le_bytes).into());
    Image::from_pixels(size, pixels.collect()).filter(|_| rest.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::errors::PairErrors;

    fn circumstances(seed: u64) -> Map<String, Value> {
        Map::from_iter([("seed".to_owned(), seed.into())])
    }

    fn record(pair: u32) -> Record {
        let errors =
            PairErrors { noise: 0.1, bias: [1.0 / 3.0; super::super::errors::GROUPS], flip: 0.2 };
        Record { variant: "v".to_owned(), samples_per_pixel: 4, pair, seconds: [0.1, 0.2], errors }
    }

    #[test]
    fn what_was_kept_is_there_again_to_the_last_bit() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = folder.path().join("new");
        let mut first = Checkpoint::open(&place, circumstances(1)).expect("a new one");
        first.push(record(0)).expect("writable");
        first.push(record(1)).expect("writable");
        assert_eq!(first.reference(0).expect("none yet"), None);
        let image =
            Image::from_pixels([1, 2], vec![[0.1, 0.2, 0.3].into(), [1e-9, 4.0, 5.0].into()]);
        let image = image.expect("two pixels");
        first.keep_reference(0, &image).expect("writable");
        let second = Checkpoint::open(&place, circumstances(1)).expect("the same");
        assert_eq!(second.records(), [record(0), record(1)]);
        assert_eq!(second.reference(0).expect("readable"), Some(image));
    }

    #[test]
    fn another_experiment_and_other_files_are_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        Checkpoint::open(folder.path(), circumstances(1)).expect("a new one");
        let error = Checkpoint::open(folder.path(), circumstances(2)).expect_err("another seed");
        assert!(error.to_string().contains("seed is 1 there and 2 now"), "{error}");
        fs::write(folder.path().join(EXPERIMENT), "{").expect("writable");
        let error = Checkpoint::open(folder.path(), circumstances(1)).expect_err("not JSON");
        assert!(matches!(error, CheckpointError::Content { .. }), "{error}");
        assert_eq!(decode(&[0; 7]), None);
        assert_eq!(decode(&[1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0]), None);
    }
}
