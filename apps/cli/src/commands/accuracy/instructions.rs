//! Instructions per evaluation, counted by valgrind: a measure of cost that a busy machine does not disturb.

use std::path::{Path, PathBuf};
use std::process::Command;

use etendue_accuracy::functions::Effort;

use super::calls::{self, Work};
use crate::failure::{Exit, Failure};

/// This program under valgrind.
pub(super) struct Counter {
    valgrind: PathBuf,
    program: PathBuf,
}

/// Which variant to count.
pub(super) struct Request {
    pub(super) family: &'static str,
    pub(super) variant: usize,
    pub(super) effort: Effort,
}

/// Evaluations at least. What else a process does differs by some hundred instructions from run to run: a tenth of one
/// per evaluation.
const EVALUATIONS: usize = 4000;

impl Counter {
    /// Nothing where valgrind is not in the path.
    pub(super) fn find() -> Option<Self> {
        let path = std::env::var_os("PATH")?;
        let file = |folder: PathBuf| Some(folder.join("valgrind")).filter(|file| file.is_file());
        let valgrind = std::env::split_paths(&path).find_map(file)?;
        Some(Self { valgrind, program: std::env::current_exe().ok()? })
    }

    /// Instructions per evaluation, those of the loop taken off.
    pub(super) fn count(&self, request: &Request) -> Result<f64, Failure> {
        let (busy, evaluations) = self.run(request, Work::Full)?;
        let (idle, _) = self.run(request, Work::Idle)?;
        Ok((busy - idle) / evaluations)
    }

    /// Instructions of a whole process, and how many evaluations it made.
    fn run(&self, request: &Request, work: Work) -> Result<(f64, f64), Failure> {
        let mut command = Command::new(&self.valgrind);
        command.args(["--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]);
        command.arg(&self.program).args(["accuracy", calls::NAME, "--family", request.family]);
        command.args(["--variant", &request.variant.to_string()]);
        command.args(["--evaluations", &EVALUATIONS.to_string(), "--work", work.name()]);
        command.args((request.effort == Effort::Quick).then_some("--quick"));
        let failed = |reason: &str| failure(&self.valgrind, reason);
        let output = command.output().map_err(|error| failed(&error.to_string()))?;
        let log = String::from_utf8_lossy(&output.stderr);
        if !output.status.success() {
            return Err(failed(log.lines().last().unwrap_or_default()));
        }
        let evaluations = String::from_utf8_lossy(&output.stdout).trim().parse();
        let evaluations = evaluations.map_err(|_| failed("no number of evaluations"))?;
        let instructions = references(&log).ok_or_else(|| failed("no number of instructions"))?;
        Ok((instructions, evaluations))
    }
}

/// The number in cachegrind's line `I refs: 1,234`, by whatever name it goes in this version.
fn references(log: &str) -> Option<f64> {
    let line = log.lines().find(|line| line.contains("refs:"))?;
    let digits: String =
        line.rsplit("refs:").next()?.chars().filter(char::is_ascii_digit).collect();
    digits.parse().ok()
}

fn failure(valgrind: &Path, reason: &str) -> Failure {
    let hint = "leave instructions out with --no-instructions";
    Failure::new(Exit::InputOutput, format!("{}: {reason}; {hint}", valgrind.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_of_references_is_read_from_the_log() {
        let log = "==12== Cachegrind\n==12== \n==12== I refs:        1,234,567\n";
        assert_eq!(references(log), Some(1_234_567.0));
        assert_eq!(references("==12== I   refs:      42"), Some(42.0));
        assert_eq!(references("nothing"), None);
    }
}
