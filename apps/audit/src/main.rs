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
use etendue_audit::progress::Progress;
use etendue_audit::report::Totals;
use etendue_audit::{cases, checks, furnace, hard_cases, report, run};

/// Audits every reflection model: laws, densities, hostile inputs, in f32 and f64.
#[derive(Parser)]
#[command(version, about)]
struct Arguments {
    /// Only models and checks whose name contains NAME.
    #[arg(long, value_name = "NAME", default_value = "", hide_default_value = true)]
    filter: String,
    /// Many more points: a long run.
    #[arg(long)]
    exhaustive: bool,
    /// Also write the report as JSON; `-` writes it to the standard output instead of the table.
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
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
    panic::catch_unwind(|| execute(&arguments)).unwrap_or_else(|_| ExitCode::from(FAILED))
}

fn execute(arguments: &Arguments) -> ExitCode {
    let mut out = io::stdout().lock();
    if arguments.list {
        return written(list(&mut out), "the list")
            .map_or_else(|code| code, |()| ExitCode::SUCCESS);
    }
    if let Some(threads) = arguments.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
        if let Err(error) = pool {
            eprintln!("etendue-audit: {error}");
            return ExitCode::from(FAILED);
        }
    }
    let budget = if arguments.exhaustive { Budget::EXHAUSTIVE } else { Budget::SMOKE };
    let progress = if arguments.exhaustive { Progress::lines() } else { Progress::Silent };
    let records = run::run(budget, &arguments.filter, &progress);
    if records.is_empty() {
        eprintln!("etendue-audit: no model or check is called '{}' (see --list)", arguments.filter);
        return ExitCode::from(USAGE);
    }
    let json = || format!("{:#}\n", report::to_json(&records, budget));
    let result = match arguments.json.as_deref() {
        Some(path) if path == Path::new("-") => {
            written(out.write_all(json().as_bytes()), "the report")
        }
        Some(path) => written(fs::write(path, json()), &path.display().to_string())
            .and_then(|()| written(report::table(&mut out, &records, budget), "the report")),
        None => written(report::table(&mut out, &records, budget), "the report"),
    };
    match result {
        Err(code) => code,
        Ok(()) if Totals::of(&records).all_passed() => ExitCode::SUCCESS,
        Ok(()) => ExitCode::from(FAILED),
    }
}

/// A reader that has seen enough (`etendue-audit | head`) is no error.
fn written(result: io::Result<()>, what: &str) -> Result<(), ExitCode> {
    match result {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            eprintln!("etendue-audit: cannot write {what}: {error}");
            Err(ExitCode::from(NOT_WRITTEN))
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
    writeln!(out, "  {} ({})\n\nhard cases:", furnace::CHECK, furnace::MODEL)?;
    for hard in hard_cases::HARD_CASES {
        writeln!(out, "  {} ({})", hard.name, hard.function)?;
    }
    Ok(())
}
