//! The command `etendue-mutations`: seeds bugs into a copy of the workspace and sees that the audit
//! finds every one.
//!
//! Exit codes: 0 every bug was found, 1 one was not or does not build, 2 usage, 4 the sound copy could
//! not be made or built, or the document could not be written.

use core::time::Duration;
use std::collections::HashMap;
use std::fs;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::thread;
use std::time::Instant;

use clap::Parser;
use etendue_audit::mutations::{self, Mutation};
use etendue_report::document::{row, with_part};
use serde_json::Value;

/// Seeds bugs into a copy of the workspace and sees that the audit finds every one.
#[derive(Parser)]
#[command(version, about)]
struct Arguments {
    /// Only bugs whose file or description contains TEXT; may be given several times.
    #[arg(long, value_name = "TEXT")]
    only: Vec<String>,
    /// Also write the table into FILE, between its lines `begin mutations` and `end mutations`; with
    /// `--only` what it says of other bugs is kept.
    #[arg(long, value_name = "FILE")]
    markdown: Option<PathBuf>,
    /// Root of the workspace.
    #[arg(long, value_name = "DIR", default_value = concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))]
    root: PathBuf,
    /// Number of jobs of the compiler and threads of the audit (default: all cores).
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
}

/// What of the workspace the audit is built from.
const COPIED: [&str; 8] = [
    "Cargo.toml",
    "Cargo.lock",
    "crates/math",
    "crates/sampling",
    "crates/brdf",
    "crates/report",
    "crates/specimens",
    "apps/audit",
];
/// A run takes seconds; a machine may be busy.
const PATIENCE: Duration = Duration::from_secs(600);

fn main() -> ExitCode {
    match execute(&Arguments::parse()) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("etendue-mutations: {message}");
            ExitCode::from(4)
        }
    }
}

/// How many bugs were not found.
fn execute(arguments: &Arguments) -> Result<usize, String> {
    let (all, only) = (mutations::all(), &arguments.only);
    let named = |m: &&Mutation| only.iter().any(|t| m.file.contains(t) || m.fault.contains(t));
    let wanted: Vec<&Mutation> = all.iter().filter(|m| only.is_empty() || named(m)).collect();
    let copy = Workspace::new(arguments)?;
    copy.build()?;
    let mut filters: Vec<&str> = wanted.iter().flat_map(|m| m.filters).copied().collect();
    filters.sort_unstable();
    filters.dedup();
    if let found @ Verdict::Found(_) = copy.audit(&filters) {
        return Err(format!("without any bug the audit does not pass: {found:?}"));
    }
    let mut table = Table::read(arguments.markdown.as_deref())?;
    let mut missed = 0;
    for (i, mutation) in wanted.iter().enumerate() {
        let start = Instant::now();
        let verdict = copy.seed(mutation)?;
        let found = match &verdict {
            Verdict::Found(by) => by.join(", "),
            Verdict::Missed => "**not found**".to_owned(),
            Verdict::NotBuilt(error) => {
                eprintln!("{error}");
                "**does not build**".to_owned()
            }
        };
        missed += usize::from(!matches!(verdict, Verdict::Found(_)));
        let seconds = start.elapsed().as_secs_f64();
        eprintln!("{}/{} {seconds:.1} s  {}: {found}", i + 1, wanted.len(), mutation.fault);
        table.insert(mutation, &found);
        // After every bug, so that a run that is stopped loses nothing.
        table.write(&all)?;
    }
    print!("{}", table.text(&all));
    Ok(missed)
}

/// What is known of each bug, by the first two cells of its row.
struct Table {
    document: Option<PathBuf>,
    rows: HashMap<String, String>,
}

impl Table {
    /// The rows that stand in the document, if there is one.
    fn read(document: Option<&Path>) -> Result<Self, String> {
        let mut rows = HashMap::new();
        if let Some(path) = document {
            let text = fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
            let part = text.split("<!-- begin mutations -->").nth(1).unwrap_or_default();
            for line in part.lines() {
                if let Some((bug, found)) = line.trim_end_matches(" |").rsplit_once(" | ") {
                    rows.insert(bug.to_owned(), found.to_owned());
                }
            }
        }
        Ok(Self { document: document.map(Path::to_owned), rows })
    }

    /// The first two cells of a bug's row.
    fn key(mutation: &Mutation) -> String {
        let file = mutation.file.replace("/src/", "/");
        let cells = row([format!("`{file}`").as_str(), mutation.fault]);
        cells.trim_end().trim_end_matches(" |").to_owned()
    }

    fn insert(&mut self, mutation: &Mutation, found: &str) {
        self.rows.insert(Self::key(mutation), found.to_owned());
    }

    /// The rows of the bugs that there are, in their order.
    fn text(&self, all: &[Mutation]) -> String {
        let known: Vec<_> =
            all.iter().filter_map(|m| self.rows.get_key_value(&Self::key(m))).collect();
        let missed = known.iter().filter(|(_, found)| found.starts_with("**")).count();
        let mut text = format!(
            "Run of {}: {} of {} found.\n\n",
            time::OffsetDateTime::now_utc().date(),
            known.len() - missed,
            known.len(),
        );
        text += &row(["file", "bug", "found by"]);
        text += &row(["---"; 3]);
        for (bug, found) in known {
            text += &format!("{bug} | {found} |\n");
        }
        text
    }

    fn write(&self, all: &[Mutation]) -> Result<(), String> {
        let Some(path) = &self.document else { return Ok(()) };
        let named = |error: String| format!("{}: {error}", path.display());
        let text = fs::read_to_string(path).map_err(|e| named(e.to_string()))?;
        let text =
            with_part(&text, "mutations", &self.text(all)).map_err(|e| named(e.to_string()))?;
        fs::write(path, text).map_err(|e| named(e.to_string()))
    }
}

#[derive(Debug, PartialEq, Eq)]
enum Verdict {
    /// By these checks.
    Found(Vec<String>),
    Missed,
    /// With these errors of the compiler.
    NotBuilt(String),
}

/// The copy that is broken, kept beside the other products of the build so that the next run starts
/// from its object files.
struct Workspace {
    original: PathBuf,
    root: PathBuf,
    jobs: Option<String>,
}

impl Workspace {
    fn new(arguments: &Arguments) -> Result<Self, String> {
        let original = arguments.root.clone();
        let root = original.join("target/mutations");
        let copy = Self { original, root, jobs: arguments.jobs.map(|n| n.to_string()) };
        for part in COPIED {
            let (from, to) = (copy.original.join(part), copy.root.join(part));
            mirror(&from, &to).map_err(|e| format!("cannot copy {}: {e}", from.display()))?;
        }
        Ok(copy)
    }

    /// Puts one bug in, builds, audits, and takes it out again.
    fn seed(&self, mutation: &Mutation) -> Result<Verdict, String> {
        let Mutation { fault, file, find, replace, filters } = mutation;
        let path = self.root.join(file);
        let named = |e: io::Error| format!("{}: {e}", path.display());
        let sound = fs::read_to_string(&path).map_err(named)?;
        if sound.matches(find).count() != 1 {
            return Err(format!("{file} does not hold the text of '{fault}' exactly once"));
        }
        fs::write(&path, sound.replacen(find, replace, 1)).map_err(named)?;
        let verdict = self.build().map(|()| self.audit(filters));
        fs::write(&path, sound).map_err(named)?;
        Ok(verdict.unwrap_or_else(Verdict::NotBuilt))
    }

    fn build(&self) -> Result<(), String> {
        let mut command = Command::new(env!("CARGO"));
        command.current_dir(&self.root).env("CARGO_TARGET_DIR", self.root.join("target"));
        // What this program was started with is for its own build, not for the copy's.
        command.env_remove("CARGO_INCREMENTAL").args(["build", "--quiet", "--profile", "mutation"]);
        command.args(["--package", "etendue-audit", "--bin", "etendue-audit"]);
        command.args(self.jobs.iter().flat_map(|n| ["--jobs", n]));
        let output = command.output().map_err(|e| format!("cargo does not start: {e}"))?;
        if output.status.success() {
            Ok(())
        } else {
            Err(format!("does not build:\n{}", String::from_utf8_lossy(&output.stderr)))
        }
    }

    fn audit(&self, filters: &[&str]) -> Verdict {
        let mut command = Command::new(self.root.join("target/mutation/etendue-audit"));
        command.args(["--quick", "--json", "-"]);
        command.args(self.jobs.iter().flat_map(|n| ["--threads", n]));
        command.args(filters.iter().flat_map(|name| ["--filter", name]));
        match output_of(command) {
            None => Verdict::Found(vec!["does not end".to_owned()]),
            Some(text) => match serde_json::from_str::<Value>(&text) {
                Err(_) => Verdict::Found(vec!["panic".to_owned()]),
                Ok(report) => verdict_of(&report),
            },
        }
    }
}

/// The standard output of a program, or `None` if it had to be stopped.
fn output_of(mut command: Command) -> Option<String> {
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().ok()?;
    let mut pipe = child.stdout.take()?;
    let reader = thread::spawn(move || {
        let mut text = String::new();
        // What cannot be read is not a report and counts as a panic.
        let _ = pipe.read_to_string(&mut text);
        text
    });
    let start = Instant::now();
    while child.try_wait().ok()?.is_none() {
        if start.elapsed() > PATIENCE {
            child.kill().ok()?;
            child.wait().ok()?;
            return None;
        }
        thread::sleep(Duration::from_millis(10));
    }
    reader.join().ok()
}

/// The checks that failed, each once, in the order of the report.
fn verdict_of(report: &Value) -> Verdict {
    let mut by: Vec<String> = Vec::new();
    for record in report["records"].as_array().into_iter().flatten() {
        let check = record["check"].as_str().unwrap_or_default();
        if record["passed"] == false && !by.iter().any(|known| known == check) {
            by.push(check.to_owned());
        }
    }
    if by.is_empty() { Verdict::Missed } else { Verdict::Found(by) }
}

/// Makes `to` what `from` is. Files that are the same are left alone, and with them what was built of
/// them.
fn mirror(from: &Path, to: &Path) -> io::Result<()> {
    if from.is_dir() {
        fs::create_dir_all(to)?;
        for entry in fs::read_dir(to)? {
            let name = entry?.file_name();
            if !from.join(&name).exists() {
                remove(&to.join(&name))?;
            }
        }
        for entry in fs::read_dir(from)? {
            let name = entry?.file_name();
            mirror(&from.join(&name), &to.join(&name))?;
        }
        return Ok(());
    }
    let new = fs::read(from)?;
    if fs::read(to).is_ok_and(|old| old == new) {
        return Ok(());
    }
    if let Some(parent) = to.parent() {
        fs::create_dir_all(parent)?;
    }
    fs::write(to, new)
}

fn remove(path: &Path) -> io::Result<()> {
    if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) }
}

#[cfg(test)]
mod tests {
    use super::COPIED;

    #[test]
    fn what_the_audit_depends_on_is_copied() {
        let manifest = include_str!("../../Cargo.toml");
        let crates = manifest.lines().filter_map(|line| line.strip_prefix("etendue-"));
        let mut count = 0;
        for name in crates.filter_map(|line| line.split_once(" = ")).map(|(name, _)| name) {
            assert!(COPIED.contains(&format!("crates/{name}").as_str()), "{name}");
            count += 1;
        }
        assert!(count >= 4, "{count}");
    }
}
