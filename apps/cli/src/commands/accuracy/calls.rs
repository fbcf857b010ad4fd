//! What runs under valgrind: a variant evaluated again and again, or the loop without it.

use etendue_accuracy::functions::{Effort, FAMILIES};

use crate::failure::{Exit, Failure};

/// The name of the subcommand; not part of the command's interface.
pub(super) const NAME: &str = "calls";

/// Evaluates one variant of a family at all points, and again. Prints how many evaluations that were.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[arg(long)]
    family: String,
    /// Its number, 0 for the exact one.
    #[arg(long)]
    variant: usize,
    /// How many evaluations there are at least; all points are evaluated equally often.
    #[arg(long)]
    evaluations: usize,
    /// Words of one length: reading them takes equally many instructions.
    #[arg(long)]
    work: Work,
    #[arg(long)]
    quick: bool,
}

/// What is repeated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Work {
    /// The evaluations.
    Full,
    /// The loop without them.
    Idle,
}

impl Work {
    /// As in the arguments.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::Idle => "idle",
        }
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    let info = FAMILIES.iter().find(|info| info.name == arguments.family);
    let info = info.ok_or_else(|| Failure::usage(format!("no family '{}'", arguments.family)))?;
    let family = info.family(effort);
    let variants = &family.setup.variants;
    let variant = variants
        .get(arguments.variant)
        .ok_or_else(|| Failure::usage(format!("no variant {}", arguments.variant)))?;
    let mut evaluations = 0;
    while evaluations < arguments.evaluations {
        evaluations += match arguments.work {
            Work::Full => variant.pass(),
            Work::Idle => variant.idle(),
        };
    }
    println!("{evaluations}");
    Ok(Exit::Done)
}
