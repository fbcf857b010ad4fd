//! Memory of the board, rows of exact values, the model whose cost is measured, and the part of the models hashed.

#[path = "../../crates/brdf/tests/golden/bound.rs"]
mod bound;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs};

use bound::{HARD, TYPICAL, ulp32};
use serde_json::Value;

/// Files of rows that the firmware knows how to answer.
const FILES: &[&str] = &[
    "fresnel-conductor",
    "fresnel-dielectric",
    "fresnel-schlick",
    "lambert",
    "ndf-beckmann",
    "ndf-ggx",
    "oren-nayar",
    "oren-nayar-qualitative",
    "rough-conductor",
    "rough-dielectric",
    "smith-g2-beckmann",
    "smith-g2-ggx",
];
/// Rows taken of each file and kind; what fits in 256 KiB beside everything else.
const ROWS: usize = 24;

fn main() {
    let out = PathBuf::from(env::var("OUT_DIR").unwrap());
    let target = env::var("TARGET").unwrap();
    // Cortex-M0: BBC micro:bit (nRF51822). Cortex-M4F: Arm MPS2 with AN386.
    let (flash, ram) = if target.starts_with("thumbv6m") { ("256K", "16K") } else { ("4M", "4M") };
    let memory = format!(
        "MEMORY {{ FLASH : ORIGIN = 0x00000000, LENGTH = {flash}\n RAM : ORIGIN = 0x20000000, LENGTH = {ram} }}\n"
    );
    fs::write(out.join("memory.x"), memory).unwrap();
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    fs::write(out.join("rows.rs"), rows()).unwrap();
    for name in ["MODEL", "CALLS", "PART"] {
        println!("cargo:rerun-if-env-changed={name}");
        println!("cargo:rustc-env={name}={}", env::var(name).unwrap_or_default());
    }
}

/// The rows as Rust source.
fn rows() -> String {
    let folder = Path::new("../../crates/brdf/tests/golden");
    let mut text = String::from("pub const ROWS: &[Row] = &[\n");
    for file in FILES {
        let path = folder.join(file).with_extension("jsonl");
        println!("cargo:rerun-if-changed={}", path.display());
        let lines = fs::read_to_string(path).unwrap();
        let all: Vec<Value> =
            lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        for (stratum, bound) in [("typical", TYPICAL), ("hard", HARD)] {
            let of_stratum = all.iter().filter(|row| row["stratum"] == stratum);
            let rows: Vec<String> = of_stratum.filter_map(|row| source(file, row, bound)).collect();
            // Evenly over the file, in which the kinds of hard rows follow each other.
            for row in rows.iter().step_by(rows.len().div_ceil(ROWS)) {
                text += row;
            }
        }
    }
    text + "];\n"
}

/// One row, or `None` where its condition is beyond `f32` or its value below what `f32` holds.
fn source(file: &str, row: &Value, ulps: f64) -> Option<String> {
    let condition = row["cond"][1].as_f64().filter(|c| *c < 1e5)?;
    let exact = [row["f"].as_f64().or(row["value"].as_f64())?, row["pdf"].as_f64().unwrap_or(0.0)];
    let bound =
        |x: f64| if x == 0.0 { f64::from(f32::MAX) } else { ulps * ulp32(x) * (1.0 + condition) };
    if exact[0] < 1e-30 {
        return None;
    }
    let number = |v: &Value| v.as_f64().unwrap_or_default() as f32;
    let vector = |name: &str| [0, 1, 2].map(|i| number(&row[name][i]));
    let mut parameters = String::new();
    for (name, value) in row["params"].as_object().unwrap() {
        if value.is_number() {
            write!(parameters, "({name:?}, {:?}), ", number(value)).unwrap();
        }
    }
    let [wo, mut wi] = ["wo", "wi"].map(vector);
    for single in ["h", "w"] {
        if row[single].is_array() {
            wi = vector(single);
        }
    }
    Some(format!(
        "Row {{ file: {file:?}, id: {}, beckmann: {}, parameters: &[{parameters}], wo: {wo:?}, wi: {wi:?}, \
         cos: {:?}, exact: {exact:?}, bound: {:?} }},\n",
        row["id"],
        row["params"]["distribution"] == "beckmann" || file.ends_with("beckmann"),
        number(&row["cos_theta_i"]),
        exact.map(bound),
    ))
}
