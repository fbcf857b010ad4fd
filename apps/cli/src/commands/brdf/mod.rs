//! `etendue brdf`: the reflection models by name, without a scene.

use clap::Subcommand;

use crate::failure::{Exit, Failure};

mod eval;
mod figure;
mod list;
mod lobe;
mod plot;
mod specification;

/// Lists, evaluates and draws reflection models.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    List(list::Arguments),
    Eval(eval::Arguments),
    Plot(plot::Arguments),
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    match &arguments.command {
        Command::List(arguments) => list::run(arguments),
        Command::Eval(arguments) => eval::run(arguments),
        Command::Plot(arguments) => plot::run(arguments),
    }
}

/// What writing to standard output came to; a reader that has left is no failure.
fn written(outcome: std::io::Result<()>) -> Result<Exit, Failure> {
    match outcome {
        Err(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Failure::new(Exit::InputOutput, format!("standard output: {error}")))
        }
        _ => Ok(Exit::Done),
    }
}
