//! `etendue accuracy functions`: formulas, fits and precisions.

use etendue_accuracy::functions::{Effort, FAMILIES, FamilyInfo, introduction, measure, section};
use etendue_accuracy::timing::Budget;
use etendue_report::Report;

use super::facts;
use super::instructions::{Counter, Request};
use super::report_files::ReportArguments;
use crate::failure::{Exit, Failure};
use crate::progress::{ProgressDisplay, Quiet, Standing};

/// The part of a document that this writes.
const PART: &str = "functions";

/// Error against cost of every formula, fit and precision of the reflection models.
///
/// Tables and plots of every family, with the Pareto front marked.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// Only this family; may be given more than once.
    #[arg(long = "family", value_name = "NAME")]
    families: Vec<String>,
    /// Fewer points, samples and rounds: a glance.
    #[arg(long)]
    quick: bool,
    /// Do not count instructions, which needs valgrind and takes most of the time.
    #[arg(long)]
    no_instructions: bool,
    #[command(flatten)]
    quiet: Quiet,
    #[command(flatten)]
    report: ReportArguments,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let families = chosen(&arguments.families)?;
    let files = arguments.report.check(PART)?;
    let (effort, budget) = if arguments.quick {
        (Effort::Quick, Budget::QUICK)
    } else {
        (Effort::Full, Budget::USUAL)
    };
    let counter = if arguments.no_instructions { None } else { Counter::find() };
    let progress = ProgressDisplay::new("measuring", arguments.quiet);
    let mut sections = Vec::with_capacity(families.len());
    for info in &families {
        progress.update(Standing::parts(sections.len(), families.len()));
        let family = info.family(effort);
        let count = |variant| {
            let request = Request { family: info.name, variant, effort };
            counter.as_ref().map(|counter| counter.count(&request)).transpose()
        };
        let mut failed = None;
        let measured = measure(&family, budget, |variant| {
            count(variant).unwrap_or_else(|failure| {
                failed = Some(failure);
                None
            })
        });
        if let Some(failure) = failed {
            return Err(failure);
        }
        sections.push(section(&family, &measured));
    }
    progress.finish();
    let settings = if arguments.quick { "quick" } else { "full" };
    let mut facts = facts::of_this_run();
    facts.push(("settings".to_owned(), settings.to_owned()));
    let title = "Error against cost of functions".to_owned();
    let report = Report { title, facts, introduction: introduction(), sections };
    files.write(&report, PART)?;
    Ok(Exit::Done)
}

/// The families asked for, all where none is.
fn chosen(names: &[String]) -> Result<Vec<&'static FamilyInfo>, Failure> {
    let known = |name: &str| FAMILIES.iter().any(|family| family.name == name);
    if let Some(unknown) = names.iter().find(|name| !known(name)) {
        let names: Vec<&str> = FAMILIES.iter().map(|family| family.name).collect();
        let message = format!("no family '{unknown}'; there are: {}", names.join(", "));
        return Err(Failure::usage(message));
    }
    let asked = |family: &&FamilyInfo| names.is_empty() || names.iter().any(|n| n == family.name);
    Ok(FAMILIES.iter().filter(asked).collect())
}
