//! What runs under valgrind: a variant evaluated again and again, or the loop without it.

use etendue_accuracy::functions::{Effort, FAMILIES};

use crate::failure::{Exit, Failure};

/// The name of the subcommand; not part of the command's interface.
pub(super) const NAME: &str = "calls";

/// Evaluates one variant of a family at all points, and again. Prints the number of points.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[arg(long)]
    family: String,
    /// Its number, 0 for the exact one.
    #[arg(long)]
    variant: usize,
    #[arg(long)]
    passes: usize,
    #[arg(long)]
    idle: bool,
    #[arg(long)]
    quick: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    let info = FAMILIES.iter().find(|info| info.name == arguments.family);
    let info = info.ok_or_else(|| Failure::usage(format!("no family '{}'", arguments.family)))?;
    let family = info.family(effort);
    let mut variants = family.variants();
    let variant = variants
        .nth(arguments.variant)
        .ok_or_else(|| Failure::usage(format!("no variant {}", arguments.variant)))?;
    let evaluations: usize = (0..arguments.passes)
        .map(|_| if arguments.idle { variant.idle() } else { variant.pass() })
        .sum();
    println!("{evaluations}");
    Ok(Exit::Done)
}
