//! `etendue accuracy functions`: formulas, fits and precisions.

use std::io::IsTerminal;

use etendue_accuracy::functions::{Effort, FAMILIES, FamilyInfo, introduction, measure, section};
use etendue_accuracy::timing::Budget;
use etendue_report::Report;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::facts;
use super::instructions::{Counter, Request};
use super::report_files::ReportArguments;
use crate::failure::{Exit, Failure};
use crate::progress::Quiet;

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
    /// No progress on standard error.
    #[arg(short, long)]
    quiet: bool,
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
    let quiet = if arguments.quiet { Quiet::Yes } else { Quiet::No };
    let progress = Steps::new(families.len(), quiet);
    let mut sections = Vec::with_capacity(families.len());
    for info in families {
        progress.start(info.title);
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

/// Which family is being measured: a bar on a terminal, a line each otherwise.
enum Steps {
    Nothing,
    Bar(ProgressBar),
    Lines,
}

impl Steps {
    fn new(count: usize, quiet: Quiet) -> Self {
        if quiet == Quiet::Yes {
            return Self::Nothing;
        }
        if !std::io::stderr().is_terminal() {
            return Self::Lines;
        }
        let target = ProgressDrawTarget::stderr();
        let bar = ProgressBar::with_draw_target(Some(count as u64), target);
        // The template is a constant; a bar in the default style is no reason not to measure.
        bar.set_style(
            ProgressStyle::with_template("{wide_bar} {pos} of {len}  {msg}")
                .unwrap_or_else(|_| ProgressStyle::default_bar()),
        );
        Self::Bar(bar)
    }

    fn start(&self, title: &'static str) {
        match self {
            Self::Nothing => {}
            Self::Bar(bar) => {
                if !bar.message().is_empty() {
                    bar.inc(1);
                }
                bar.set_message(title);
            }
            Self::Lines => eprintln!("etendue: {title}"),
        }
    }

    fn finish(&self) {
        if let Self::Bar(bar) = self {
            bar.finish_and_clear();
        }
    }
}
