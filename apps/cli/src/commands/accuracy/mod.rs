//! `etendue accuracy`: what accuracy costs in time.

use clap::Subcommand;

use crate::failure::{Exit, Failure};

mod calls;
mod facts;
mod functions;
mod instructions;
mod report_files;
mod samplers;
mod scene;

/// Measures error against cost of everything that can be done in more than one way.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Functions(functions::Arguments),
    #[command(name = calls::NAME, hide = true)]
    Calls(calls::Arguments),
    Samplers(samplers::Arguments),
    Scene(scene::Arguments),
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    match &arguments.command {
        Command::Functions(arguments) => functions::run(arguments),
        Command::Calls(arguments) => calls::run(arguments),
        Command::Samplers(arguments) => samplers::run(arguments),
        Command::Scene(arguments) => scene::run(arguments),
    }
}
