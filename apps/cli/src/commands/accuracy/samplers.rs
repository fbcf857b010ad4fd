//! `etendue accuracy samplers`: noise and time of every way of sampling every model.

use etendue_accuracy::samplers::{self, Settings};

use super::facts;
use super::report_files::ReportArguments;
use crate::failure::{Exit, Failure};
use crate::progress::{ProgressDisplay, Quiet, Standing};

/// Variance, time and efficiency of every way of drawing directions from every model.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Only this model; may be given several times.
    #[arg(long = "model", value_name = "NAME")]
    models: Vec<String>,
    /// Seconds instead of minutes, and rougher.
    #[arg(long)]
    quick: bool,
    /// Seed of the random numbers.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    #[command(flatten)]
    quiet: Quiet,
    #[command(flatten)]
    files: ReportArguments,
}

const PART: &str = "samplers";

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    check_names(&arguments.models)?;
    let files = arguments.files.check(PART)?;
    let base = if arguments.quick { Settings::quick() } else { Settings::usual() };
    let settings = Settings { models: arguments.models.clone(), seed: arguments.seed, ..base };
    let display = ProgressDisplay::new("measuring", arguments.quiet);
    let measurement = samplers::measure(&settings, &mut |finished, total| {
        display.update(Standing::parts(finished, total));
    });
    display.finish();
    files.write(&samplers::report(&measurement, &settings, facts::of_this_run()), PART)?;
    Ok(Exit::Done)
}

fn check_names(models: &[String]) -> Result<(), Failure> {
    let names = samplers::names();
    match models.iter().find(|model| !names.contains(&model.as_str())) {
        None => Ok(()),
        Some(model) => Err(Failure::usage(format!(
            "--model: there is no model “{model}” with a continuous part; there are {}",
            names.join(", ")
        ))),
    }
}
