//! What can be wrong with a scene, and where.

use alloc::string::{String, ToString as _};
use alloc::vec::Vec;
use core::fmt;
use std::path::{Path, PathBuf};

use crate::printable::printable;

/// A place in a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Location {
    /// The file; empty where nothing came from a file.
    pub file: PathBuf,
    /// Line, counted from 1.
    pub line: Option<u32>,
    /// Column in characters, counted from 1.
    pub column: Option<u32>,
}

impl Location {
    /// A whole file.
    pub fn file(file: impl AsRef<Path>) -> Self {
        Self { file: file.as_ref().to_path_buf(), line: None, column: None }
    }

    /// A line of a file.
    pub fn line(file: impl AsRef<Path>, line: u32) -> Self {
        Self { line: Some(line), ..Self::file(file) }
    }
}

impl fmt::Display for Location {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&printable(self.file.display().to_string()))?;
        if let Some(line) = self.line {
            write!(f, ":{line}")?;
        }
        if let Some(column) = self.column {
            write!(f, ":{column}")?;
        }
        Ok(())
    }
}

/// What kind of failure an error is; the command line turns it into an exit code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ErrorKind {
    /// The content is wrong: malformed, out of range, unsupported.
    Scene,
    /// A file cannot be read.
    Io,
    /// The content asks for more memory or work than is allowed.
    Resource,
    /// What the caller asked for beside the file does not fit it.
    Options,
}

/// Why a scene could not be loaded: what, where, and how to mend it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct SceneError {
    /// What kind of failure.
    pub kind: ErrorKind,
    /// Where.
    pub location: Location,
    /// What is wrong, in one sentence without a full stop.
    pub message: String,
    /// How to mend it, in one sentence without a full stop.
    pub help: Option<String>,
}

impl SceneError {
    /// The content of a file is wrong.
    pub fn scene(location: Location, message: impl Into<String>) -> Self {
        let message = printable(message.into());
        Self { kind: ErrorKind::Scene, location, message, help: None }
    }

    /// A file cannot be read.
    pub fn io(path: impl AsRef<Path>, error: &std::io::Error) -> Self {
        Self {
            kind: ErrorKind::Io,
            location: Location::file(path),
            message: alloc::format!("cannot read: {error}"),
            help: None,
        }
    }

    /// The content asks for too much.
    pub fn resource(location: Location, message: impl Into<String>) -> Self {
        Self { kind: ErrorKind::Resource, ..Self::scene(location, message) }
    }

    /// What the caller asked for beside the file does not fit it; no file is to blame.
    pub fn options(message: impl Into<String>) -> Self {
        Self { kind: ErrorKind::Options, ..Self::scene(Location::default(), message) }
    }

    /// The same error with advice on how to mend it.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(printable(help.into()));
        self
    }
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        describe(f, &self.location, &self.message)?;
        if let Some(help) = &self.help {
            write!(f, "; {help}")?;
        }
        Ok(())
    }
}

/// Something suspicious that does not stop a scene from loading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Where.
    pub location: Location,
    /// What, in one sentence without a full stop.
    pub message: String,
}

impl Warning {
    /// A warning about a place.
    pub fn new(location: Location, message: impl Into<String>) -> Self {
        Self { location, message: printable(message.into()) }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        describe(f, &self.location, &self.message)
    }
}

fn describe(f: &mut fmt::Formatter<'_>, location: &Location, message: &str) -> fmt::Result {
    if location.file.as_os_str().is_empty() {
        write!(f, "{message}")
    } else {
        write!(f, "{location}: {message}")
    }
}

/// Warnings in the order they were found.
pub(crate) type Warnings = Vec<Warning>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_files_hold_is_shown_without_its_effect_on_a_terminal() {
        let error =
            SceneError::scene(Location::line("a\u{1b}[2J", 3), "“x\ny\u{202e}é”").help("\r");
        assert_eq!(error.to_string(), r"a\u{1b}[2J:3: “x\u{a}y\u{202e}é”; \u{d}");
        let warning = Warning::new(Location::default(), "\u{7}");
        assert_eq!(warning.to_string(), r"\u{7}");
    }
}
