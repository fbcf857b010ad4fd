//! The command `etendue`: renders scenes, inspects them, converts them, compares pictures and evaluates reflection models.
//!
//! Only this crate prints, parses arguments and exits. Each subcommand is a file in `commands`.

#![allow(
    clippy::std_instead_of_alloc,
    clippy::std_instead_of_core,
    reason = "a program for hosts with an operating system"
)]

use std::panic;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

mod checkpoint;
mod clock;
mod commands;
mod excerpt;
mod failure;
mod figures;
mod interrupt;
mod memory;
mod output;
mod progress;

use commands::{accuracy, brdf, compare, convert, effects, info, merge, render, resume};
use failure::{Exit, Failure};

/// Renders Mitsuba scenes, glTF models and bare meshes, exactly and fast.
#[derive(Debug, Parser)]
#[command(name = "etendue", version, after_help = EXIT_CODES)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Render(Box<render::Arguments>),
    Resume(resume::Arguments),
    Merge(merge::Arguments),
    Effects(effects::Arguments),
    Info(info::Arguments),
    Convert(convert::Arguments),
    Compare(compare::Arguments),
    Brdf(brdf::Arguments),
    Accuracy(accuracy::Arguments),
}

const EXIT_CODES: &str = "Exit codes: 0 done, 1 internal error, 2 usage, 3 scene, 4 input or output, \
5 resource limit, 6 finished but unhealthy under --strict, 130 or 143 interrupted after saving.";

fn main() -> ExitCode {
    // clap prints its own messages and exits with 2 on bad usage, 0 after --help and --version.
    let arguments = Arguments::parse();
    let outcome = panic::catch_unwind(|| match &arguments.command {
        Command::Render(arguments) => render::run(arguments),
        Command::Resume(arguments) => resume::run(arguments),
        Command::Merge(arguments) => merge::run(arguments),
        Command::Effects(arguments) => effects::run(arguments),
        Command::Info(arguments) => info::run(arguments),
        Command::Convert(arguments) => convert::run(arguments),
        Command::Compare(arguments) => compare::run(arguments),
        Command::Brdf(arguments) => brdf::run(arguments),
        Command::Accuracy(arguments) => accuracy::run(arguments),
    })
    .unwrap_or_else(|_| Err(internal_error()));
    match outcome {
        Ok(exit) => exit.into(),
        Err(failure) => {
            eprintln!("etendue: error: {failure}");
            failure.exit.into()
        }
    }
}

/// The panic hook has already printed where; this says what is needed to replay it.
fn internal_error() -> Failure {
    let command: Vec<String> = std::env::args().collect();
    Failure::new(
        Exit::Internal,
        format!(
            "internal error in version {}; please report the message above with the scene and this \
             command: {}",
            env!("CARGO_PKG_VERSION"),
            command.join(" ")
        ),
    )
}
