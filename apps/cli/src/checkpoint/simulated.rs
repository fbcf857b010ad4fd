//! A disk in memory that fails or loses power at any operation, and forgets what was not synced.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::store::Store;

/// What goes wrong, at which operation that changes something.
#[derive(Clone, Copy, Debug)]
pub(super) enum Fault {
    None,
    /// Power is lost: neither this operation nor a later one succeeds.
    Crash {
        operation: usize,
    },
    /// This operation fails.
    Error {
        operation: usize,
    },
    /// From this operation on nothing is created or written.
    Full {
        operation: usize,
    },
}

/// A file: what has been written and what would survive.
#[derive(Clone, Debug, Default)]
struct Content {
    live: Vec<u8>,
    durable: Vec<u8>,
    synced: bool,
}

/// A change of names.
#[derive(Clone, Debug)]
enum Change {
    Link(PathBuf, usize),
    Rename(PathBuf, PathBuf, usize),
    Unlink(PathBuf),
}

#[derive(Clone, Debug)]
struct State {
    contents: Vec<Content>,
    names: BTreeMap<PathBuf, usize>,
    durable_names: BTreeMap<PathBuf, usize>,
    /// Since the folder was synced.
    changes: Vec<Change>,
    operations: usize,
    fault: Fault,
    faulted: bool,
}

/// A shared handle of a disk.
#[derive(Clone, Debug)]
pub(super) struct SimulatedDisk(Rc<RefCell<State>>);

fn apply(names: &mut BTreeMap<PathBuf, usize>, change: &Change) {
    match change {
        Change::Link(path, content) => {
            names.insert(path.clone(), *content);
        }
        Change::Rename(from, to, content) => {
            if names.get(from) == Some(content) {
                names.remove(from);
            }
            names.insert(to.clone(), *content);
        }
        Change::Unlink(path) => {
            names.remove(path);
        }
    }
}

impl SimulatedDisk {
    pub(super) fn new(fault: Fault) -> Self {
        let [names, durable_names] = [BTreeMap::new(), BTreeMap::new()];
        let (contents, changes) = (Vec::new(), Vec::new());
        Self(Rc::new(RefCell::new(State {
            contents,
            names,
            durable_names,
            changes,
            operations: 0,
            fault,
            faulted: false,
        })))
    }

    /// Whether something has gone wrong.
    pub(super) fn faulted(&self) -> bool {
        self.0.borrow().faulted
    }

    pub(super) fn names(&self) -> Vec<String> {
        self.0.borrow().names.keys().map(|path| path.display().to_string()).collect()
    }

    /// Everything that the disk may hold after a loss of power: any of the changes of names since the folder was synced,
    /// with the contents that were not synced as they were, halved, blank, or as far as they were written.
    pub(super) fn after_power_loss(&self) -> Vec<Self> {
        let state = self.0.borrow();
        let mut disks = Vec::new();
        for chosen in 0..1_u32 << state.changes.len() {
            let mut names = state.durable_names.clone();
            for (i, change) in state.changes.iter().enumerate() {
                if chosen >> i & 1 == 1 {
                    apply(&mut names, change);
                }
            }
            for tear in 0..4 {
                let survive = |content: &Content| {
                    let live = match (content.synced, tear) {
                        (true, _) | (_, 0) => content.durable.clone(),
                        (_, 1) => content.live[..content.live.len() / 2].to_vec(),
                        (_, 2) => vec![0; content.live.len()],
                        _ => content.live.clone(),
                    };
                    Content { durable: live.clone(), live, synced: true }
                };
                disks.push(Self(Rc::new(RefCell::new(State {
                    contents: state.contents.iter().map(survive).collect(),
                    names: names.clone(),
                    durable_names: names.clone(),
                    changes: Vec::new(),
                    operations: 0,
                    fault: Fault::None,
                    faulted: false,
                }))));
            }
        }
        disks
    }

    /// Counts an operation and fails if it is its turn.
    fn operation(&self, needs_room: bool) -> io::Result<()> {
        let mut state = self.0.borrow_mut();
        let now = state.operations;
        state.operations += 1;
        let kind = match state.fault {
            Fault::Crash { operation } if now >= operation => io::ErrorKind::Other,
            Fault::Error { operation } if now == operation => io::ErrorKind::Other,
            Fault::Full { operation } if now >= operation && needs_room => {
                io::ErrorKind::StorageFull
            }
            _ => return Ok(()),
        };
        state.faulted = true;
        Err(io::Error::from(kind))
    }

    fn change(&self, change: Change) {
        let mut state = self.0.borrow_mut();
        apply(&mut state.names, &change);
        state.changes.push(change);
    }

    fn content_of(&self, path: &Path) -> io::Result<usize> {
        let found = self.0.borrow().names.get(path).copied();
        found.ok_or_else(|| io::Error::from(io::ErrorKind::NotFound))
    }
}

impl Store for SimulatedDisk {
    type File = usize;

    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        let content = self.content_of(path)?;
        Ok(self.0.borrow().contents[content].live.clone())
    }

    fn create(&self, path: &Path) -> io::Result<usize> {
        self.operation(true)?;
        if let Ok(content) = self.content_of(path) {
            let mut state = self.0.borrow_mut();
            state.contents[content].live.clear();
            state.contents[content].synced = false;
            return Ok(content);
        }
        let content = {
            let mut state = self.0.borrow_mut();
            state.contents.push(Content::default());
            state.contents.len() - 1
        };
        self.change(Change::Link(path.to_path_buf(), content));
        Ok(content)
    }

    fn write(&self, file: &mut usize, bytes: &[u8]) -> io::Result<()> {
        let outcome = self.operation(true);
        // What fails is written in part.
        let length = if outcome.is_ok() { bytes.len() } else { bytes.len() / 3 };
        let mut state = self.0.borrow_mut();
        state.contents[*file].live.extend_from_slice(&bytes[..length]);
        state.contents[*file].synced = false;
        outcome
    }

    fn sync(&self, file: &usize) -> io::Result<()> {
        self.operation(false)?;
        let mut state = self.0.borrow_mut();
        let content = &mut state.contents[*file];
        content.durable = content.live.clone();
        content.synced = true;
        Ok(())
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.operation(false)?;
        let content = self.content_of(from)?;
        self.change(Change::Rename(from.to_path_buf(), to.to_path_buf(), content));
        Ok(())
    }

    fn sync_folder(&self, _: &Path) -> io::Result<()> {
        self.operation(false)?;
        let mut state = self.0.borrow_mut();
        state.durable_names = state.names.clone();
        state.changes.clear();
        Ok(())
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        self.operation(false)?;
        self.content_of(path)?;
        self.change(Change::Unlink(path.to_path_buf()));
        Ok(())
    }
}
