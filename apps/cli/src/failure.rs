//! How the command fails, and the exit code that says so.

use std::fmt;
use std::path::Path;
use std::process::ExitCode;

use etendue_renderer::RendererError;
use etendue_scene::{ErrorKind, SceneError, printable};

use crate::excerpt::Excerpt;

/// The exit codes of every étendue command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Exit {
    /// Done.
    Done = 0,
    /// A defect of the program itself.
    Internal = 1,
    /// The command line is wrong.
    Usage = 2,
    /// The scene is wrong.
    Scene = 3,
    /// A file cannot be read or written.
    InputOutput = 4,
    /// More memory or work than is allowed.
    Resource = 5,
    /// Finished, but with samples that are not finite, under `--strict`.
    Unhealthy = 6,
    /// Interrupted by SIGINT after saving.
    Interrupted = 130,
    /// Terminated by SIGTERM after saving.
    Terminated = 143,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

/// One clear message and an exit code.
#[derive(Debug)]
pub(crate) struct Failure {
    /// What the process exits with.
    pub(crate) exit: Exit,
    message: String,
}

impl Failure {
    pub(crate) fn new(exit: Exit, message: impl Into<String>) -> Self {
        Self { exit, message: message.into() }
    }

    pub(crate) fn usage(message: impl Into<String>) -> Self {
        Self::new(Exit::Usage, message)
    }

    /// The same with more to say.
    pub(crate) fn adding(self, more: &str) -> Self {
        Self { message: self.message + more, ..self }
    }

    /// A file that cannot be written.
    pub(crate) fn write(path: &Path, error: impl fmt::Display) -> Self {
        Self::new(Exit::InputOutput, format!("{}: cannot write: {error}", path.display()))
    }
}

/// Lines that a message has at most.
const MOST_LINES: usize = 40;

impl fmt::Display for Failure {
    /// As text for a terminal. Lines after the first are indented: what a file says cannot pass for another message.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, line) in self.message.lines().take(MOST_LINES).enumerate() {
            let is_indented = number == 0 || line.is_empty() || line.starts_with(' ');
            let margin = if is_indented { "" } else { "  " };
            let end_before = if number == 0 { "" } else { "\n" };
            write!(f, "{end_before}{margin}{}", printable(line.to_owned()))?;
        }
        Ok(())
    }
}

impl From<RendererError> for Failure {
    fn from(error: RendererError) -> Self {
        Self::new(Exit::Resource, error.to_string())
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        let exit = match error.kind {
            ErrorKind::Scene => Exit::Scene,
            ErrorKind::Io => Exit::InputOutput,
            ErrorKind::Resource => Exit::Resource,
            ErrorKind::Options => Exit::Usage,
        };
        // The place first, as compilers write it, then the line, then how to mend it.
        let SceneError { location, help, .. } = &error;
        let mut message = SceneError { help: None, ..error.clone() }.to_string();
        if let Some(excerpt) = Excerpt::at(location) {
            message += &format!("\n{excerpt}");
        }
        if let Some(help) = help {
            message += &format!("\n  help: {help}");
        }
        Self::new(exit, message)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_file_says_is_text_of_the_message_and_no_other() {
        let failure = Failure::usage("a\u{1b}[2J\netendue: error: b\n  help: c");
        assert_eq!(failure.to_string(), "a\\u{1b}[2J\n  etendue: error: b\n  help: c");
        let flood = Failure::usage("x\n".repeat(100_000)).to_string();
        assert_eq!(flood.lines().count(), MOST_LINES);
    }
}
