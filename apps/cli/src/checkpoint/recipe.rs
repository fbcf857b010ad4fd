//! The command line of a stored render: what it takes to go on with it.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::failure::Failure;

/// A command line, the folder that its names are seen from, and what was asked for later.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Recipe {
    /// The arguments after `render`.
    pub(crate) arguments: Vec<String>,
    pub(crate) folder: PathBuf,
    pub(crate) changes: Changes,
}

/// What another render of the same samples may be asked for.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, clap::Args)]
pub(crate) struct Changes {
    /// More samples per pixel than were asked for.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) spp: Option<u32>,
    /// Another relative error to end at; of a render with --error, --time or --allocation.
    #[arg(long, value_name = "ERROR", value_parser = crate::commands::values::relative_error)]
    pub(crate) error: Option<f64>,
    /// Go on for this long from now; of a render with --error, --time or --allocation.
    #[arg(long, value_name = "TIME", value_parser = crate::commands::values::duration)]
    pub(crate) time: Option<std::time::Duration>,
    /// Another picture to write.
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
}

impl Recipe {
    /// Of this process, whose first argument is `render`.
    ///
    /// # Errors
    /// A name that is not Unicode cannot be stored.
    pub(crate) fn of_process() -> Result<Self, Failure> {
        let arguments = std::env::args_os().skip(2).map(OsString::into_string);
        let arguments = arguments.collect::<Result<_, _>>().map_err(|argument| {
            Failure::usage(format!(
                "“{}” is not Unicode and cannot be stored in a checkpoint",
                argument.display()
            ))
        })?;
        let folder = std::env::current_dir().map_err(|error| {
            Failure::new(crate::failure::Exit::InputOutput, format!("the current folder: {error}"))
        })?;
        Ok(Self { arguments, folder, changes: Changes::default() })
    }

    /// A name of the command line as seen from anywhere.
    pub(crate) fn resolve(&self, path: &Path) -> PathBuf {
        self.folder.join(path)
    }
}

impl Changes {
    /// These, and where they say nothing what was asked for before.
    pub(crate) fn over(self, before: Self) -> Self {
        Self {
            spp: self.spp.or(before.spp),
            error: self.error.or(before.error),
            time: self.time.or(before.time),
            output: self.output.or(before.output),
        }
    }
}
