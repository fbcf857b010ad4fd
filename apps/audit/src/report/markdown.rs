//! The report as the generated part of a document.

use core::fmt::Write;

use etendue_brdf::registry::{Energy, MODELS};

use super::group::{groups, worst_of};
use super::{FLOAT_BACKEND, Report, Totals};
use crate::cases;
use crate::checks::{self, SWEPT};
use crate::hard_cases::HARD_CASES;
use crate::measure::Measurement;
use crate::run::Record;
use etendue_report::document::row;

/// The report as Markdown: summary, precision, laws, gains, hard cases, and every worst point.
pub fn to_markdown(report: &Report) -> String {
    [
        summary(report),
        precision(report),
        laws(report),
        gains(report),
        hard_cases(report),
        points(report),
    ]
    .join("\n\n")
}

fn summary(report: &Report) -> String {
    let totals = Totals::of(&report.records);
    let budget = &report.budget;
    format!(
        "Run of {}: {}, version {}, float functions: {FLOAT_BACKEND}.\n\
         {} models and {} hard cases; **{} checks passed, {} failed**, {} not applicable; {:.2e} points.\n\
         Per case and precision: {} view directions, {} samples per χ² test, {} pairs of directions, {} draws;\n\
         per model {:.1e} inputs in both precisions.",
        report.date,
        budget.name,
        env!("CARGO_PKG_VERSION"),
        MODELS.len(),
        HARD_CASES.len(),
        totals.passed,
        totals.failed,
        totals.not_applicable,
        totals.evaluations as f64,
        budget.viewers,
        budget.samples,
        budget.pairs,
        budget.draws,
        budget.swept as f64,
    )
}

/// Worst over parameters and precisions of a model's check, with all its points counted.
fn worst<'a>(
    report: &'a Report,
    model: &str,
    check: &str,
) -> Result<&'a Measurement, &'static str> {
    let group: Vec<&Record> =
        report.records.iter().filter(|r| r.model == model && r.check == check).collect();
    worst_of(&group)
}

fn count(report: &Report, model: &str, check: &str) -> u64 {
    let records = report.records.iter().filter(|r| r.model == model && r.check == check);
    records.filter_map(|r| r.outcome.measurement()).map(|m| m.evaluations).sum()
}

fn precision(report: &Report) -> String {
    let mut text = "### `f32` against `f64`\n\n\
        An error of 1 is one ulp of the value, plus what moving the directions by one ulp changes.\n\n"
        .to_owned();
    text += &row(["model", "inputs", "worst, ulp", "at", "NaN, ∞, negative"]);
    text += &row(["---", "---:", "---:", "---", "---:"]);
    for model in cases::models() {
        let inputs = format!("{:.2e}", count(report, model.name, SWEPT[0]) as f64);
        let (figure, at) = match worst(report, model.name, SWEPT[0]) {
            Ok(m) => (format!("{:.3}", m.worst), m.at.clone()),
            Err(reason) => ("–".to_owned(), reason.to_owned()),
        };
        let violations = worst(report, model.name, SWEPT[1]).map_or(0.0, |m| m.worst);
        text += &row([model.name, &inputs, &figure, &at, &violations.to_string()]);
    }
    text
}

fn laws(report: &Report) -> String {
    let checks = checks::all::<f64>().map(|check| check.name);
    let heading: Vec<&str> = ["model"].into_iter().chain(checks).collect();
    let mut text = "### Laws\n\nThe worst figure over all parameters and both precisions, as a share of its bound: \
        1 is the most that passes.\n– where a check has nothing to look at.\n\n"
        .to_owned();
    text += &row(heading.iter().copied());
    text += &row(heading.iter().map(|_| "---"));
    for model in cases::models() {
        let figures = checks.map(|check| match worst(report, model.name, check) {
            Ok(m) => share(m),
            Err(_) => "–".to_owned(),
        });
        text += &row([model.name].into_iter().chain(figures.iter().map(String::as_str)));
    }
    text
}

/// A figure as a share of its bound; where the bound is 0, the figure.
fn share(m: &Measurement) -> String {
    let share = if m.bound > 0.0 { m.worst / m.bound } else { m.worst };
    let text = if share == 0.0 { "0".to_owned() } else { format!("{share:.1e}") };
    if m.passed() { text } else { format!("**{text}**") }
}

fn gains(report: &Report) -> String {
    let mut text = "### Documented energy, reproduced\n\n\
        Directional albedos known from the literature, white parameters, at θ in radians. Gains belong to the\n\
        models as published and are neither clamped nor hidden.\n\n"
        .to_owned();
    text += &row(["model", "parameters", "published albedo at θ", "largest difference"]);
    text += &row(["---", "---", "---", "---:"]);
    for model in cases::models() {
        for case in (model.double)().iter().filter(|case| !case.published.is_empty()) {
            let figures: Vec<String> =
                case.published.iter().map(|(theta, r)| format!("{r} at {theta}")).collect();
            let records = report.records.iter().filter(|r| {
                r.model == model.name
                    && r.parameters == case.parameters
                    && r.check == "published-albedo"
            });
            let difference = worst_of(&records.collect::<Vec<_>>())
                .map_or_else(str::to_owned, |m| format!("{:.1e}", m.worst));
            text += &row([model.name, &case.parameters, &figures.join(", "), &difference]);
        }
    }
    let gaining = MODELS.iter().filter_map(|info| match info.energy {
        Energy::Gains { maximum, at } => Some(format!("`{}` up to {maximum} ({at})", info.name)),
        Energy::Conserves | Energy::OfData => None,
    });
    let _ = write!(text, "\nModels that gain: {}.", gaining.collect::<Vec<_>>().join("; "));
    text
}

fn hard_cases(report: &Report) -> String {
    let mut text = "### Hard cases\n\n\
        Single functions where published forms break in `f32`, each against a reference in `f64` over the same\n\
        inputs. A naive form that passes is a failure.\n\n"
        .to_owned();
    let heading = [
        "function",
        "case",
        "what goes wrong",
        "form that holds",
        "naive",
        "ours",
        "bound",
        "unit",
    ];
    text += &row(heading);
    text += &row(["---", "---", "---", "---", "---:", "---:", "---:", "---"]);
    for hard in HARD_CASES {
        let of_case = |r: &&Record| r.model == hard.function && r.check == hard.name;
        let naive = report.records.iter().find(of_case).and_then(|r| r.naive);
        let number =
            |x: f64| if x == f64::INFINITY { "∞".to_owned() } else { format!("{x:.1e}") };
        let ours = worst(report, hard.function, hard.name);
        text += &row([
            &format!("`{}`", hard.function),
            hard.name,
            hard.problem,
            hard.remedy,
            &naive.map_or_else(|| "–".to_owned(), number),
            &ours.map_or_else(str::to_owned, |m| number(m.worst)),
            &ours.map_or_else(str::to_owned, |m| number(m.bound)),
            &ours.map_or_else(str::to_owned, |m| m.unit.to_owned()),
        ]);
    }
    text
}

fn points(report: &Report) -> String {
    let mut text = "### Worst points\n\n<details><summary>Every figure above 0, its bound and where it was met</summary>\n\n"
        .to_owned();
    text += &row(["model", "check", "worst", "bound", "unit", "at"]);
    text += &row(["---", "---", "---:", "---:", "---", "---"]);
    for group in groups(&report.records) {
        let Ok(m) = worst_of(&group) else { continue };
        if m.worst > 0.0 {
            let figures = [m.worst, m.bound].map(|x| format!("{x:.3e}"));
            text += &row([group[0].model, group[0].check, &figures[0], &figures[1], m.unit, &m.at]);
        }
    }
    text + "\n</details>"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

    #[test]
    fn a_failure_stands_out_and_figures_have_their_points() {
        let mut report = sample(&[("a", 2.0)]);
        report.records[0].model = "lambert";
        report.records[0].check = "energy";
        let text = to_markdown(&report);
        assert!(text.contains("0 checks passed, 1 failed") && text.contains("**2.0e0**"), "{text}");
        assert!(text.contains("| lambert | energy | 2.000e0 | 1.000e0 | ulp | at a |"));
    }
}
