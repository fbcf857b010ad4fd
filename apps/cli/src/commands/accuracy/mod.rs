//! `etendue accuracy`: what accuracy costs in time.

use clap::Subcommand;

use crate::failure::{Exit, Failure};

mod facts;
mod report_files;
mod samplers;
mod scene;

/// Measures error against time of every variant of a computation.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Samplers(samplers::Arguments),
    Scene(scene::Arguments),
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    match &arguments.command {
        Command::Samplers(arguments) => samplers::run(arguments),
        Command::Scene(arguments) => scene::run(arguments),
    }
}
