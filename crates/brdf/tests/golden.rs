//! Every row of exact values, in both precisions; see `golden/README.md` for the conventions.

#[path = "golden/bound.rs"]
mod bound;

use std::fs;
use std::path::Path;

use etendue_brdf::named::{Answer, Output, Row};
use etendue_math::{Real, Spectrum, Vector3};
use serde_json::Value;

use bound::{HARD, LEAST, TYPICAL, ulp32};

/// What is left of these bounds in `f64`: its ε is 2⁻²⁹ = 1.9e-9 of that of `f32`, so 1e-6 allows
/// 500 times as many roundings and no constant of `f32` precision.
const F64_SHARE: f64 = 1e-6;

/// Albedos that are not those of the rows, and what their integrals may be off.
///
/// - Full Oren–Nayar: the row integrates the negative values of the formula, where the model is 0, with a corner in
///   between that lies along no coordinate.
/// - Ashikhmin–Shirley, nu = 1e4, nv = 1: the row is 7e-4 too small. The expectation over half vectors, another
///   integral for the same number, gives 0.32181 as well.
const DEPARTURES: [(&str, f64, f64); 2] = [
    ("albedo-oren-nayar-h4", 0.395_505_926_694_466, 1e-11),
    ("albedo-ashikhmin-shirley-h5", 0.321_812_762_194_34, 1e-12),
];
/// What the integral of a rough interface may be off: it has a jump that lies along no coordinate.
const TRANSMISSION_ERROR: f64 = 2e-7;

/// The condition-scaled error of a number, in ulps of `f32`; infinite for a broken one.
fn scaled_error(got: f64, exact: f64, condition: &Value) -> f64 {
    if !got.is_finite() || (got < 0.0 && exact >= 0.0) {
        return f64::INFINITY;
    }
    if exact == 0.0 {
        return if got.abs() <= LEAST { 0.0 } else { f64::INFINITY };
    }
    if exact < 0.0 && got == 0.0 {
        return 0.0;
    }
    let condition = condition[1].as_f64().unwrap_or(0.0);
    if condition > 1e5 {
        return 0.0;
    }
    (got - exact).abs() / ulp32(exact) / (1.0 + condition)
}

/// The worst of a row's errors.
fn row_error<T: Real>(row: &Value, answer: Option<&Answer<T>>) -> f64 {
    let number = |got: f64, key: &str| match row[key].as_f64() {
        Some(exact) => scaled_error(got, exact, &row["cond"]),
        None => 0.0, // no density is defined for this row
    };
    match answer {
        None => f64::INFINITY,
        Some(Answer::Bsdf { f, pdf }) => number(f.to_f64(), "f").max(number(pdf.to_f64(), "pdf")),
        Some(Answer::Function(Output::Number(x))) => number(x.to_f64(), "value"),
        Some(Answer::Function(Output::Sample { direction, pdf })) => {
            vector_error::<T>(row, *direction).max(number(pdf.to_f64(), "pdf"))
        }
        Some(Answer::Function(Output::Direction(Some(w)))) => vector_error::<T>(row, *w),
        Some(Answer::Function(Output::Direction(None))) if row["tir"] == true => 0.0,
        Some(Answer::Function(Output::Direction(None))) => f64::INFINITY,
        Some(&Answer::Albedo { value, sides }) => {
            let number = |key: &str| row[key].as_f64().unwrap();
            let (exact, stated) = DEPARTURES
                .iter()
                .find(|(id, ..)| row["id"] == *id)
                .map_or_else(|| (number("value"), number("abs_err")), |&(_, x, error)| (x, error));
            // The rows' own quadrature has an error, which they state, and ours one where light passes through.
            let through = if sides.transmitted > 0.0 { TRANSMISSION_ERROR } else { 0.0 };
            let error = stated + through;
            let excess = ((value - exact).abs() - error).max(0.0);
            scaled_error(exact + excess, exact, &row["cond"])
        }
    }
}

/// The error of a unit vector in ulps of 1.
fn vector_error<T: Real>(row: &Value, got: T::Vec3) -> f64 {
    let Some(exact) = row["value"].as_array() else { return f64::INFINITY };
    let got = [got.x(), got.y(), got.z()].map(Real::to_f64);
    let squared: f64 = got.iter().zip(exact).map(|(g, e)| Real::sqr(g - e.as_f64().unwrap())).sum();
    let condition = row["cond"][1].as_f64().unwrap_or(0.0);
    squared.sqrt() / ulp32(1.0) / (1.0 + condition)
}

/// Whether an answer is one a caller outside the domain may get.
fn is_acceptable<T: Real>(row: &Value, answer: Option<&Answer<T>>) -> bool {
    let (got, pdf) = match answer {
        Some(Answer::Bsdf { f, pdf }) => (f.to_f64(), pdf.to_f64()),
        Some(Answer::Function(Output::Number(x))) => (x.to_f64(), 0.0),
        Some(&Answer::Albedo { value, .. }) => (value, 0.0),
        // A vector where the row expects a refusal is wrong, elsewhere it need only be finite.
        Some(Answer::Function(
            Output::Direction(Some(w)) | Output::Sample { direction: w, .. },
        )) => {
            return row["expect"] != "reject" && w.is_finite();
        }
        None | Some(Answer::Function(Output::Direction(None))) => return true,
    };
    let valid = |x: f64| x.is_finite() && x >= 0.0;
    let near =
        |exact: &Value| exact.as_f64().is_none_or(|e| (got - e).abs() <= 1e-3 * e.abs() + 1e-44);
    valid(got)
        && valid(pdf)
        && match row["expect"].as_str().unwrap() {
            "zero" | "zero-or-error" | "reject" => got == 0.0,
            "zero-or-flipped" => got == 0.0 || near(&row["f_flipped"]),
            "value-or-error" => near(if row["fn"].is_string() { &row["value"] } else { &row["f"] }),
            "no-nan" => true,
            other => panic!("unknown expectation {other}"),
        }
}

/// Checks all files in one precision and names every row that misses its bound.
fn check<T: Real + Spectrum<Real = T>>(share: f64) {
    let mut misses = Vec::new();
    let mut rows = 0;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "jsonl") {
            continue;
        }
        // An interpreter takes every sixteenth row, and none whose value is an integral over thousands of calls.
        let step = if cfg!(miri) { 16 } else { 1 };
        if cfg!(miri) && path.ends_with("albedo.jsonl") {
            continue;
        }
        for line in fs::read_to_string(&path).unwrap().lines().step_by(step) {
            let row: Value = serde_json::from_str(line).unwrap();
            let answer = serde_json::from_str::<Row>(line).unwrap().answer::<T>().ok();
            rows += 1;
            let stratum = row["stratum"].as_str().unwrap();
            if stratum == "ood" {
                if !is_acceptable(&row, answer.as_ref()) {
                    misses.push(format!("{} {}: {}", row["id"], row["tag"], row["expect"]));
                }
                continue;
            }
            let bound = share * if stratum == "typical" { TYPICAL } else { HARD };
            let error = row_error(&row, answer.as_ref());
            if error > bound {
                misses.push(format!("{} {}: {error:.3e} > {bound:.1e}", row["id"], row["tag"]));
            }
        }
    }
    assert!(rows > if cfg!(miri) { 480 } else { 7900 }, "only {rows} rows were found");
    assert!(misses.is_empty(), "of {rows} rows these miss their bound:\n{}", misses.join("\n"));
}

#[test]
fn every_row_holds_in_single_precision() {
    check::<f32>(1.0);
}

#[test]
fn every_row_holds_in_double_precision() {
    check::<f64>(F64_SHARE);
}
