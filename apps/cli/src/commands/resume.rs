//! `etendue resume`: goes on with a render from its checkpoint.

use std::path::{Path, PathBuf};

use super::render;
use crate::checkpoint::{Changes, Keeper, Recipe};
use crate::failure::{Exit, Failure};
use crate::progress::Quiet;

/// Goes on with a render from its checkpoint, to the picture that it would have become without a stop.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The checkpoint that `etendue render --checkpoint` wrote.
    checkpoint: PathBuf,
    #[command(flatten)]
    changes: Changes,
    /// Threads; as many as before if not given. The picture does not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    threads: Option<u16>,
    #[command(flatten)]
    quiet: Quiet,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let path = &arguments.checkpoint;
    let Some(stored) = Keeper::read(path)? else {
        return Err(Failure::new(
            Exit::InputOutput,
            format!("{}: there is no such checkpoint", path.display()),
        ));
    };
    let mut changes = arguments.changes.clone();
    changes.output = changes.output.as_deref().map(absolute).transpose()?;
    // Times are stored from the beginning of the render on, and asked for from now on.
    let so_far = stored.header.rendered_for();
    changes.time = changes.time.map(|time| so_far.saturating_add(time));
    let before = stored.header.recipe;
    let recipe = Recipe { changes: changes.over(before.changes.clone()), ..before };
    render::resume(path, &recipe, arguments.quiet, arguments.threads)
}

/// A name as seen from anywhere: those of a checkpoint are seen from where the render was begun.
fn absolute(path: &Path) -> Result<PathBuf, Failure> {
    std::path::absolute(path).map_err(|error| Failure::write(path, error))
}
