//! The report as text.

use std::io::{self, Write};

use super::group::{groups, worst_of};
use super::{FLOAT_BACKEND, Report, Totals};
use crate::measure::Outcome;
use crate::run::Record;

/// Writes one line per model and check, with the worst figure over parameters and precisions,
/// then the failures in full and the totals.
///
/// # Errors
/// What the writer reports.
pub fn table(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let records = &report.records;
    writeln!(out, "étendue audit, {} run, float functions: {FLOAT_BACKEND}\n", report.budget.name)?;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    fn text(worst: &[(&str, f64)]) -> String {
        let mut out = Vec::new();
        table(&mut out, &sample(worst)).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn a_line_shows_the_worst_of_its_group_and_a_failure_is_repeated_in_full() {
        let sound = text(&[("a", 0.25), ("b", 0.5)]);
        assert!(sound.contains("pass") && sound.contains("at b") && !sound.contains("at a"));
        assert!(sound.contains("2 passed, 0 failed"));
        let broken = text(&[("a", 0.5), ("b", 2.0), ("c", f64::INFINITY)]);
        assert!(broken.contains("FAIL") && broken.contains("1 passed, 2 failed"));
        assert!(broken.contains("m (b) f32 c: 2.000e0 ulp exceeds 1.000e0"));
    }
}
