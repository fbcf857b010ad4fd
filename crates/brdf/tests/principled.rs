//! `Principled` and `PrincipledThin` against rows computed by Mitsuba 3.9.1 (scalar_rgb, single precision).
//!
//! `tests/peers/principled_rows.py` makes the rows; the environment variable `PRINCIPLED_ROWS` names another file of
//! them, for a comparison over more directions than are kept here.

use std::{env, fs};

use etendue_brdf::{
    Bsdf, Principled, PrincipledParameters, PrincipledThin, PrincipledThinParameters,
};
use etendue_math::Rgb;
use etendue_math::glam::DVec3;
use serde_json::Value;

/// Relative error: Mitsuba works in `f32`, and highlights and the critical angle amplify its ε of 6e-8 by
/// up to a few thousand. The rows kept agree to 6e-6; of 29 735 others the worst is 1.1e-4 off.
const TOLERANCE: f64 = 2e-4;
/// Below, the error counts as if the value were this large: Mitsuba subtracts F from 1, which leaves an
/// absolute error.
const SMALL: f64 = 0.05;

fn number(x: &Value) -> f64 {
    x.as_f64().expect("a number")
}

fn color(x: &Value) -> Rgb<f64> {
    Rgb::new(number(&x[0]), number(&x[1]), number(&x[2]))
}

fn direction(x: &Value) -> DVec3 {
    DVec3::new(number(&x[0]), number(&x[1]), number(&x[2])).normalize()
}

fn principled(row: &Value) -> Principled<Rgb<f64>> {
    let mut p = PrincipledParameters::default();
    for (name, value) in row["parameters"].as_object().expect("parameters") {
        match name.as_str() {
            "base_color" => p.base_color = color(value),
            "roughness" => p.roughness = number(value),
            "anisotropic" => p.anisotropic = number(value),
            "metallic" => p.metallic = number(value),
            "spec_trans" => p.spec_trans = number(value),
            "eta" => p.eta = number(value),
            "specular" => p = p.with_specular(number(value)).expect("specular in its domain"),
            "spec_tint" => p.spec_tint = number(value),
            "sheen" => p.sheen = number(value),
            "sheen_tint" => p.sheen_tint = number(value),
            "flatness" => p.flatness = number(value),
            "clearcoat" => p.clearcoat = number(value),
            "clearcoat_gloss" => p.clearcoat_gloss = number(value),
            "diffuse_reflectance_sampling_rate" => {
                p.diffuse_reflectance_sampling_rate = number(value);
            }
            "main_specular_sampling_rate" => p.main_specular_sampling_rate = number(value),
            "clearcoat_sampling_rate" => p.clearcoat_sampling_rate = number(value),
            _ => panic!("no parameter {name}"),
        }
    }
    Principled::new(p).expect("parameters in their domains")
}

fn thin(row: &Value) -> PrincipledThin<Rgb<f64>> {
    let mut p = PrincipledThinParameters::default();
    for (name, value) in row["parameters"].as_object().expect("parameters") {
        match name.as_str() {
            "base_color" => p.base_color = color(value),
            "roughness" => p.roughness = number(value),
            "anisotropic" => p.anisotropic = number(value),
            "spec_trans" => p.spec_trans = number(value),
            "eta" => p.eta = number(value),
            "spec_tint" => p.spec_tint = number(value),
            "sheen" => p.sheen = number(value),
            "sheen_tint" => p.sheen_tint = number(value),
            "flatness" => p.flatness = number(value),
            "diff_trans" => p.diff_trans = number(value),
            "specular_reflectance_sampling_rate" => {
                p.specular_reflectance_sampling_rate = number(value);
            }
            "specular_transmittance_sampling_rate" => {
                p.specular_transmittance_sampling_rate = number(value);
            }
            "diffuse_reflectance_sampling_rate" => {
                p.diffuse_reflectance_sampling_rate = number(value);
            }
            "diffuse_transmittance_sampling_rate" => {
                p.diffuse_transmittance_sampling_rate = number(value);
            }
            _ => panic!("no parameter {name}"),
        }
    }
    PrincipledThin::new(p).expect("parameters in their domains")
}

#[test]
fn values_and_densities_agree_with_mitsuba() {
    let kept = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/principled/rows.jsonl");
    let path = env::var("PRINCIPLED_ROWS").unwrap_or_else(|_| kept.into());
    let text = fs::read_to_string(path).expect("a file of rows");
    let (mut rows, mut lit, mut worst) = (0, 0, 0.0_f64);
    for line in text.lines() {
        let row: Value = serde_json::from_str(line).expect("a row");
        let (wo, wi) = (direction(&row["wo"]), direction(&row["wi"]));
        let (is_thin, (f, pdf)) = match row["plugin"].as_str() {
            Some("principled") => (false, principled(&row).eval_pdf(wo, wi)),
            Some("principledthin") => (true, thin(&row).eval_pdf(wo, wi)),
            other => panic!("no plugin {other:?}"),
        };
        rows += 1;
        let theirs = color(&row["f"]);
        // Documented: where nothing is sampled from below, Mitsuba's density is not 0.
        let nothing_below = !is_thin && wo.z < 0.0 && theirs == Rgb::default() && pdf == 0.0;
        let mut pairs = vec![(f.r, theirs.r), (f.g, theirs.g), (f.b, theirs.b)];
        if !nothing_below {
            pairs.push((pdf, number(&row["pdf"])));
        }
        for (ours, theirs) in pairs {
            let error = (ours - theirs).abs() / theirs.abs().max(SMALL);
            assert!(error <= TOLERANCE, "{line}\n{ours} is not {theirs}: {error}");
            worst = worst.max(error);
        }
        lit += usize::from(f != Rgb::default());
    }
    println!("{rows} rows, {lit} not black, largest relative error {worst:.1e}");
    assert!(rows >= 350 && lit * 2 > rows, "{rows} rows, {lit} of them not black");
}
