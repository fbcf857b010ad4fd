//! The report, for people and for programs.

mod group;
mod json;
mod markdown;
mod table;

use crate::budget::Budget;
use crate::measure::Outcome;
use crate::run::Record;

pub use json::to_json;
pub use markdown::to_markdown;
pub use table::table;

/// Which float functions this program was built on.
pub const FLOAT_BACKEND: &str = if cfg!(feature = "libm") { "libm" } else { "std" };

/// A finished run.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The day it ended, year-month-day; not in the table, which two runs print alike.
    pub date: String,
    /// How much was looked at.
    pub budget: Budget,
    /// What came of it.
    pub records: Vec<Record>,
}

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

#[cfg(test)]
pub(crate) fn sample(worst: &[(&str, f64)]) -> Report {
    let record = |&(parameters, worst): &(&str, f64)| Record {
        model: "m",
        parameters: parameters.into(),
        precision: "f32",
        check: "c",
        outcome: Outcome::Measured(crate::measure::Measurement {
            worst,
            bound: 1.0,
            unit: "ulp",
            at: format!("at {parameters}"),
            evaluations: 10,
        }),
        naive: None,
    };
    let records = worst.iter().map(record).collect();
    Report { date: "2000-01-01".into(), budget: Budget::TEST, records }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_run_does_not_pass() {
        assert!(!Totals::of(&[]).all_passed());
    }
}
