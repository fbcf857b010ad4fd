//! The command `etendue-audit`.
//!
//! Exit codes: 0 every check passed, 1 a check failed or the program itself did, 2 usage,
//! 4 the report could not be written.

use std::fs;
use std::io::{self, Write};
use std::panic;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use etendue_audit::budget::Budget;
use etendue_audit::filter::Filter;
use etendue_audit::model_table::{Links, model_table};
use etendue_audit::progress::Progress;
use etendue_audit::report::{Report, Totals};
use etendue_audit::{cases, checks, closed_forms, furnace, hard_cases, report, run};
use etendue_report::document::with_part;

/// Audits every reflection model: laws, densities, hostile inputs, in f32 and f64.
#[derive(Parser)]
#[command(version, about)]
struct Arguments {
    /// Only models and checks whose name contains NAME, or both as MODEL/CHECK; may be given several
    /// times.
    #[arg(long, value_name = "NAME")]
    filter: Vec<String>,
    /// Many more points: a long run, with progress on the error output.
    #[arg(long)]
    exhaustive: bool,
    /// Few points: a run of seconds, enough for gross errors.
    #[arg(long, conflicts_with = "exhaustive")]
    quick: bool,
    /// Also write the report as JSON; `-` writes it to the standard output instead of the table.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Also write the report into FILE, between its lines `begin audit` and `end audit`.
    #[arg(long, value_name = "FILE", conflicts_with = "filter")]
    markdown: Option<PathBuf>,
    /// Write the table of models into FILE, between its lines `begin models` and `end models`, and
    /// run nothing.
    #[arg(long, value_name = "FILE")]
    models: Option<PathBuf>,
    /// Print models, parameters and checks, and run nothing.
    #[arg(long)]
    list: bool,
    /// Number of threads (default: all cores). The report does not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
}

const FAILED: u8 = 1;
const USAGE: u8 = 2;
const NOT_WRITTEN: u8 = 4;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    // A panic is a defect of the audit or of a model: its message stands on the error output.
    panic::catch_unwind(|| execute(&arguments))
        .unwrap_or(Err(FAILED))
        .map_or_else(ExitCode::from, |()| ExitCode::SUCCESS)
}

fn execute(arguments: &Arguments) -> Result<(), u8> {
    let mut out = io::stdout().lock();
    if arguments.list {
        return written(list(&mut out), "the list");
    }
    if let Some(path) = &arguments.models {
        let rust = path.extension().is_some_and(|extension| extension == "rs");
        let links = if rust { Links::Rustdoc } else { Links::None };
        return update(path, "models", &model_table(links));
    }
    if let Some(threads) = arguments.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
        pool.map_err(|error| {
            eprintln!("etendue-audit: {error}");
            FAILED
        })?;
    }
    // A document that cannot be written is reported before the run, not after it.
    if let Some(path) = &arguments.markdown {
        replaced(path, "audit", "")?;
        let writable = fs::OpenOptions::new().append(true).open(path).map(drop);
        written(writable, &path.display().to_string())?;
    }
    let report = audit(arguments)?;
    if let Some(path) = &arguments.markdown {
        update(path, "audit", &report::to_markdown(&report))?;
    }
    let json = || format!("{:#}\n", report::to_json(&report));
    match arguments.json.as_deref() {
        Some(path) if path == Path::new("-") => {
            written(out.write_all(json().as_bytes()), "the report")?;
        }
        other => {
            if let Some(path) = other {
                written(fs::write(path, json()), &path.display().to_string())?;
            }
            written(report::table(&mut out, &report), "the report")?;
        }
    }
    if Totals::of(&report.records).all_passed() { Ok(()) } else { Err(FAILED) }
}

fn audit(arguments: &Arguments) -> Result<Report, u8> {
    let (budget, progress) = if arguments.exhaustive {
        (Budget::EXHAUSTIVE, Progress::lines())
    } else if arguments.quick {
        (Budget::TEST, Progress::Silent)
    } else {
        (Budget::SMOKE, Progress::Silent)
    };
    let filter = Filter::new(&arguments.filter);
    let records = run::run(budget, &filter, &progress);
    if records.is_empty() {
        eprintln!("etendue-audit: no model or check is called '{}' (see --list)", filter.names());
        return Err(USAGE);
    }
    let date = time::OffsetDateTime::now_utc().date().to_string();
    Ok(Report { date, budget, records })
}

/// Replaces the part of a document that this program writes.
fn update(path: &Path, part: &str, content: &str) -> Result<(), u8> {
    written(fs::write(path, replaced(path, part, content)?), &path.display().to_string())
}

/// A document's text with a part replaced.
fn replaced(path: &Path, part: &str, content: &str) -> Result<String, u8> {
    let name = path.display();
    let text = fs::read_to_string(path).map_err(|error| {
        eprintln!("etendue-audit: cannot read {name}: {error}");
        NOT_WRITTEN
    })?;
    with_part(&text, part, content).map_err(|error| {
        eprintln!("etendue-audit: {name} has {error}");
        NOT_WRITTEN
    })
}

/// A reader that has seen enough (`etendue-audit | head`) is no error.
fn written(result: io::Result<()>, what: &str) -> Result<(), u8> {
    match result {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            eprintln!("etendue-audit: cannot write {what}: {error}");
            Err(NOT_WRITTEN)
        }
        _ => Ok(()),
    }
}

fn list(out: &mut impl Write) -> io::Result<()> {
    for model in cases::models() {
        writeln!(out, "{}", model.name)?;
        for case in (model.double)() {
            writeln!(out, "  {}", case.parameters)?;
        }
    }
    writeln!(out, "\nchecks:")?;
    for check in checks::all::<f64>() {
        writeln!(out, "  {}", check.name)?;
    }
    for check in checks::SWEPT {
        writeln!(out, "  {check}")?;
    }
    writeln!(out, "  {} ({})\n\nclosed forms:", furnace::CHECK, furnace::MODEL)?;
    for form in closed_forms::CLOSED_FORMS {
        writeln!(out, "  {} ({})", form.name, form.function)?;
    }
    writeln!(out, "\nhard cases:")?;
    for hard in hard_cases::HARD_CASES {
        writeln!(out, "  {} ({})", hard.name, hard.function)?;
    }
    Ok(())
}
