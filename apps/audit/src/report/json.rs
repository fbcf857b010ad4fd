//! The report as JSON.

use serde_json::{Value, json};

use super::{FLOAT_BACKEND, Report, Totals};
use crate::budget::Budget;
use crate::hard_cases::HARD_CASES;
use crate::measure::Outcome;
use crate::run::Record;

/// The whole report as JSON: every record, nothing condensed. Infinite figures are `null`.
pub fn to_json(report: &Report) -> Value {
    let totals = Totals::of(&report.records);
    json!({
        "program": "etendue-audit",
        "version": env!("CARGO_PKG_VERSION"),
        "date": report.date,
        "run": report.budget.name,
        "budget": budget_json(&report.budget),
        "float_functions": FLOAT_BACKEND,
        "passed": totals.all_passed(),
        "totals": {
            "passed": totals.passed,
            "failed": totals.failed,
            "not_applicable": totals.not_applicable,
            "evaluations": totals.evaluations,
        },
        "records": report.records.iter().map(record_json).collect::<Vec<_>>(),
    })
}

fn budget_json(budget: &Budget) -> Value {
    json!({
        "view_directions_per_case": budget.viewers,
        "samples_per_chi_square_test": budget.samples,
        "samples_that_shape_cells": budget.pilot,
        "pairs_per_case": budget.pairs,
        "draws_per_case": budget.draws,
        "inputs_swept_per_model": budget.swept,
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
    let hard = HARD_CASES.iter().find(|h| h.function == record.model && h.name == record.check);
    if let Some(hard) = hard {
        value["problem"] = json!(hard.problem);
        value["remedy"] = json!(hard.remedy);
        value["naive_worst"] = json!(record.naive);
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    #[test]
    fn json_holds_every_record_and_the_verdict() {
        let value = to_json(&sample(&[("a", 0.5), ("b", 2.0)]));
        assert_eq!(value["passed"], false);
        assert_eq!(value["records"][1]["worst"], 2.0);
        assert_eq!(value["totals"]["evaluations"], 20);
        assert_eq!(value["date"], "2000-01-01");
        assert_eq!(value["budget"]["inputs_swept_per_model"], Budget::TEST.swept);
    }
}
