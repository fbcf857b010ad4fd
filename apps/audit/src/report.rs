//! The report, for people and for programs.

use std::io::{self, Write};

use serde_json::{Value, json};

use crate::budget::Budget;
use crate::measure::{Measurement, Outcome};
use crate::run::Record;

/// Which float functions this program was built on.
pub const FLOAT_BACKEND: &str = if cfg!(feature = "libm") { "libm" } else { "std" };

/// Totals of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Checks that measured something and passed.
    pub passed: usize,
    /// Checks that failed.
    pub failed: usize,
    /// Checks that had nothing to look at.
    pub not_applicable: usize,
    /// Points looked at.
    pub evaluations: u64,
}

impl Totals {
    /// Totals of some records.
    pub fn of<'a>(records: impl IntoIterator<Item = &'a Record>) -> Self {
        let mut totals = Self::default();
        for record in records {
            match &record.outcome {
                Outcome::NotApplicable(_) => totals.not_applicable += 1,
                Outcome::Measured(m) => {
                    totals.evaluations += m.evaluations;
                    if m.passed() {
                        totals.passed += 1;
                    } else {
                        totals.failed += 1;
                    }
                }
            }
        }
        totals
    }

    /// Something was checked and nothing failed.
    pub fn all_passed(&self) -> bool {
        self.failed == 0 && self.passed > 0
    }
}

/// Writes one line per model and check, with the worst figure over parameters and precisions,
/// then the failures in full and the totals.
///
/// # Errors
/// What the writer reports.
pub fn table(out: &mut dyn Write, records: &[Record], budget: Budget) -> io::Result<()> {
    writeln!(out, "étendue audit, {} run, float functions: {FLOAT_BACKEND}\n", budget.name)?;
    writeln!(
        out,
        "{:24} {:18} {:6} {:>10} {:>10} {:11} worst at",
        "model", "check", "result", "worst", "bound", "unit"
    )?;
    for group in groups(records) {
        line(out, &group)?;
    }
    let failures: Vec<_> = records.iter().filter(|r| !r.outcome.passed()).collect();
    if !failures.is_empty() {
        writeln!(out, "\nfailures:")?;
    }
    for record in failures {
        if let Outcome::Measured(m) = &record.outcome {
            writeln!(
                out,
                "  {} ({}) {} {}: {:.3e} {} exceeds {:.3e}\n    at {}",
                record.model,
                record.parameters,
                record.precision,
                record.check,
                m.worst,
                m.unit,
                m.bound,
                m.at
            )?;
        }
    }
    let totals = Totals::of(records);
    writeln!(
        out,
        "\n{} passed, {} failed, {} not applicable; {:.2e} points",
        totals.passed, totals.failed, totals.not_applicable, totals.evaluations as f64
    )
}

fn line(out: &mut dyn Write, group: &[&Record]) -> io::Result<()> {
    let first = group[0];
    write!(out, "{:24} {:18} ", first.model, first.check)?;
    match worst_of(group) {
        Err(reason) => writeln!(out, "–      {reason}"),
        Ok(m) => writeln!(
            out,
            "{:6} {:>10.3e} {:>10.3e} {:11} {}",
            if group.iter().all(|r| r.outcome.passed()) { "pass" } else { "FAIL" },
            m.worst,
            m.bound,
            m.unit,
            m.at
        ),
    }
}

/// Records of one model and check, in the order in which the pair was first met.
fn groups(records: &[Record]) -> Vec<Vec<&Record>> {
    let mut groups: Vec<Vec<&Record>> = Vec::new();
    for record in records {
        let known =
            groups.iter_mut().find(|g| g[0].model == record.model && g[0].check == record.check);
        match known {
            Some(group) => group.push(record),
            None => groups.push(vec![record]),
        }
    }
    groups
}

/// The measurement nearest to its bound or furthest beyond, or why there is none.
fn worst_of<'a>(group: &[&'a Record]) -> Result<&'a Measurement, &'static str> {
    let mut found = Err("");
    let mut severity = f64::NEG_INFINITY;
    for record in group {
        match &record.outcome {
            Outcome::NotApplicable(reason) => {
                if found.is_err() {
                    found = Err(*reason);
                }
            }
            Outcome::Measured(m) => {
                let this = if m.passed() {
                    m.worst / m.bound.max(f64::MIN_POSITIVE)
                } else {
                    f64::INFINITY
                };
                if this > severity || found.is_err() {
                    (found, severity) = (Ok(m), this);
                }
            }
        }
    }
    found
}

/// The whole report as JSON: every record, nothing condensed. Infinite figures are `null`.
pub fn to_json(records: &[Record], budget: Budget) -> Value {
    let totals = Totals::of(records);
    json!({
        "program": "etendue-audit",
        "version": env!("CARGO_PKG_VERSION"),
        "run": budget.name,
        "float_functions": FLOAT_BACKEND,
        "passed": totals.all_passed(),
        "totals": {
            "passed": totals.passed,
            "failed": totals.failed,
            "not_applicable": totals.not_applicable,
            "evaluations": totals.evaluations,
        },
        "records": records.iter().map(record_json).collect::<Vec<_>>(),
    })
}

fn record_json(record: &Record) -> Value {
    let mut value = json!({
        "model": record.model,
        "parameters": record.parameters,
        "precision": record.precision,
        "check": record.check,
    });
    match &record.outcome {
        Outcome::NotApplicable(reason) => value["not_applicable"] = json!(reason),
        Outcome::Measured(m) => {
            value["passed"] = json!(m.passed());
            value["worst"] = json!(m.worst);
            value["bound"] = json!(m.bound);
            value["unit"] = json!(m.unit);
            value["at"] = json!(m.at);
            value["evaluations"] = json!(m.evaluations);
        }
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(parameters: &str, worst: f64) -> Record {
        Record {
            model: "m",
            parameters: parameters.into(),
            precision: "f32",
            check: "c",
            outcome: Outcome::Measured(Measurement {
                worst,
                bound: 1.0,
                unit: "ulp",
                at: format!("at {parameters}"),
                evaluations: 10,
            }),
            naive: None,
        }
    }

    fn text(records: &[Record]) -> String {
        let mut out = Vec::new();
        table(&mut out, records, Budget::TEST).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn a_line_shows_the_worst_of_its_group_and_a_failure_is_repeated_in_full() {
        let sound = text(&[record("a", 0.25), record("b", 0.5)]);
        assert!(sound.contains("pass") && sound.contains("at b") && !sound.contains("at a"));
        assert!(sound.contains("2 passed, 0 failed"));
        let broken = text(&[record("a", 0.5), record("b", 2.0), record("c", f64::INFINITY)]);
        assert!(broken.contains("FAIL") && broken.contains("1 passed, 2 failed"));
        assert!(broken.contains("m (b) f32 c: 2.000e0 ulp exceeds 1.000e0"));
    }

    #[test]
    fn json_holds_every_record_and_the_verdict() {
        let value = to_json(&[record("a", 0.5), record("b", 2.0)], Budget::TEST);
        assert_eq!(value["passed"], false);
        assert_eq!(value["records"][1]["worst"], 2.0);
        assert_eq!(value["totals"]["evaluations"], 20);
    }

    #[test]
    fn an_empty_run_does_not_pass() {
        assert!(!Totals::of(&[]).all_passed());
    }
}
