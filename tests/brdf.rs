//! `etendue brdf`: rows through the real command, lines that are no rows, lists and plots.

mod common;

use std::fs;
use std::io::Write;
use std::process::Stdio;

use common::{Folder, Outcome, repository};
use etendue_brdf::named::{Answer, Output, Row};
use etendue_brdf::registry::MODELS;
use etendue_math::{Real, Spectrum, Vector3};
use serde_json::{Value, json};

/// Runs `etendue brdf eval` on these lines.
fn eval(input: &[u8], precision: &str) -> Outcome {
    let folder = Folder::new();
    let mut command = folder.command(&["brdf", "eval", "--precision", precision]);
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().expect("the command starts");
    let mut stdin = child.stdin.take().expect("a pipe");
    // From a thread of its own, or both sides would wait on full pipes.
    let input = input.to_vec();
    let writer = std::thread::spawn(move || stdin.write_all(&input));
    let outcome = child.wait_with_output().expect("the command ends").into();
    writer.join().expect("no panic").expect("all lines are read");
    outcome
}

fn answers(outcome: &Outcome) -> Vec<Value> {
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    outcome.stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

/// What the library says, in the form of the command.
fn expected<T: Real + Spectrum<Real = T>>(line: &str) -> Value {
    let vector = |w: T::Vec3| [w.x(), w.y(), w.z()].map(Real::to_f64);
    let row: Row = serde_json::from_str(line).expect("a row");
    match row.answer::<T>() {
        Err(error) => json!({ "error": error.to_string() }),
        Ok(Answer::Bsdf { f, pdf }) => json!({ "f": f.to_f64(), "pdf": pdf.to_f64() }),
        Ok(Answer::Function(Output::Number(x))) => json!({ "value": x.to_f64() }),
        Ok(Answer::Function(Output::Direction(w))) => json!({ "value": w.map(vector) }),
        Ok(Answer::Function(Output::Sample { direction, pdf })) => {
            json!({ "value": vector(direction), "pdf": pdf.to_f64() })
        }
        Ok(Answer::Albedo { value, sides }) => json!({
            "value": value, "reflected": sides.reflected, "transmitted": sides.transmitted
        }),
    }
}

/// All rows whose exact values the core is tested against, albedos apart: those take an integral each.
fn rows() -> String {
    let folder = repository("crates/brdf/tests/golden");
    let mut text = String::new();
    for entry in fs::read_dir(folder).expect("the exact values") {
        let path = entry.expect("an entry").path();
        let is_rows = path.extension().is_some_and(|e| e == "jsonl");
        if is_rows && path.file_stem().is_some_and(|stem| stem != "albedo") {
            text += &fs::read_to_string(path).expect("rows");
        }
    }
    text
}

fn check<T: Real + Spectrum<Real = T>>(precision: &str) {
    let rows = rows();
    let answers = answers(&eval(rows.as_bytes(), precision));
    assert_eq!(answers.len(), rows.lines().count());
    assert!(answers.len() > 7000, "only {} rows were found", answers.len());
    for (line, answer) in rows.lines().zip(answers) {
        // Every digit: the command prints numbers in full.
        assert_eq!(answer, expected::<T>(line), "{line}");
    }
}

#[test]
fn every_row_gets_the_library_s_answer_in_single_precision() {
    check::<f32>("f32");
}

#[test]
fn every_row_gets_the_library_s_answer_in_double_precision() {
    check::<f64>("f64");
}

#[test]
fn an_albedo_is_answered_by_side() {
    let row = br#"{"fn": "albedo", "model": "diffuse-transmitter", "params": {"reflectance": 0.25,
        "transmittance": 0.5}, "wo": [0, 0, 1]}"#;
    let line: Vec<u8> = row.iter().map(|&b| if b == b'\n' { b' ' } else { b }).collect();
    let answer = &answers(&eval(&line, "f64"))[0];
    for (key, exact) in [("value", 0.25), ("reflected", 0.25), ("transmitted", 0.5)] {
        let got = answer[key].as_f64().expect(key);
        // An integral of a constant.
        assert!((got - exact).abs() < 1e-12, "{key}: {got}");
    }
}

#[test]
fn lines_that_are_no_rows_get_an_error_and_the_next_line_follows() {
    let good =
        r#"{"model": "lambert", "params": {"albedo": 0.5}, "wi": [0, 0, 1], "wo": [0, 0, 1]}"#;
    let mut nested = String::new();
    for _ in 0..10_000 {
        nested += r#"{"params":{"inner":"#;
    }
    let hostile: Vec<Vec<u8>> = [
        "{",
        "null",
        "[]",
        "3",
        "\"row\"",
        "{}",
        r#"{"model": "lambert"}"#,
        r#"{"model": 3}"#,
        r#"{"model": "lambert", "params": []}"#,
        r#"{"model": "lambert", "params": {"albedo": {}}, "wi": [0, 0, 1], "wo": [0, 0, 1]}"#,
        r#"{"model": "lambert", "params": {"albedo": 1e999}, "wi": [0, 0, 1], "wo": [0, 0, 1]}"#,
        r#"{"model": "lambert", "params": {"albedo": "NaN"}, "wi": [0, 0, 1], "wo": [0, 0, 1]}"#,
        r#"{"model": "lambert", "params": {"albedo": 0.5}, "wi": [0, 0], "wo": [0, 0, 1]}"#,
        r#"{"model": "lambert", "params": {"albedo": 0.5}, "wi": ["Infinity", 0, 1], "wo": [0, 0, 1]}"#,
        r#"{"model": "lambert", "params": {"albedo": 0.5, "colour": 1}, "wi": [0, 0, 1], "wo": [0, 0, 1]}"#,
        r#"{"model": "lambrt", "params": {}, "wi": [0, 0, 1], "wo": [0, 0, 1]}"#,
        r#"{"fn": "sqrt", "params": {}}"#,
        r#"{"fn": "albedo", "params": {}}"#,
        r#"{"model": "mask", "params": {"opacity": 1, "inner": "mask"}, "wi": [0, 0, 1], "wo": [0, 0, 1]}"#,
        &nested,
    ]
    .iter()
    .map(|line| line.as_bytes().to_vec())
    .chain([vec![0xff, 0xfe], vec![0; 40], vec![b'['; 2 << 20]])
    .collect();
    let mut input = Vec::new();
    for line in &hostile {
        input.extend_from_slice(line);
        input.extend_from_slice(b"\r\n\n");
        input.extend_from_slice(good.as_bytes());
        input.push(b'\n');
    }
    for precision in ["f32", "f64"] {
        let answers = answers(&eval(&input, precision));
        assert_eq!(answers.len(), 2 * hostile.len());
        for (line, pair) in hostile.iter().zip(answers.chunks(2)) {
            let line = String::from_utf8_lossy(&line[..line.len().min(200)]);
            assert!(
                pair[0]["error"].as_str().is_some_and(|e| !e.is_empty()),
                "{line}: {}",
                pair[0]
            );
            assert!(pair[1]["f"].as_f64().is_some_and(|f| f > 0.159), "{line}: {}", pair[1]);
        }
    }
}

#[test]
fn the_list_names_every_model_as_text_and_as_json() {
    let folder = Folder::new();
    let text = folder.run(&["brdf", "list"]);
    let json = folder.run(&["brdf", "list", "--json"]).json();
    let listed = json["models"].as_array().expect("models");
    assert_eq!(listed.len(), MODELS.len());
    for (model, entry) in MODELS.iter().zip(listed) {
        assert!(text.stdout.lines().any(|line| line == model.name), "{}", model.name);
        assert_eq!(entry["name"], model.name);
        assert_eq!(entry["parameters"].as_array().map(Vec::len), Some(model.parameters.len()));
    }
}

#[test]
fn a_plot_is_an_svg_with_every_model_and_no_number_that_is_none() {
    let folder = Folder::new();
    let models =
        ["lambert:albedo=0.8", "smooth-dielectric:eta=1.5", "phong:kd=0.2,ks=0.6,exponent=50"];
    let outcome = folder.run(&[&["brdf", "plot"], &models[..], &["-o", "out.svg"]].concat());
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    let svg = fs::read_to_string(folder.path("out.svg")).expect("a picture");
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    for text in ["lambert", "smooth-dielectric", "kd=0.2, ks=0.6, exponent=50", "viewer at 45°"] {
        assert!(svg.contains(text), "{text}");
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn plots_that_cannot_be_drawn_are_refused_with_one_message() {
    let folder = Folder::new();
    for (arguments, exit) in [
        (&["lambert:albedo=2", "-o", "out.svg"][..], 2),
        (&["lambert", "-o", "out.svg"], 2),
        (&["lamp:albedo=1", "-o", "out.svg"], 2),
        (&["null", "-o", "out.png"], 2),
        (&["null", "-o", "out.svg", "--angles", "95"], 2),
        (&["null", "-o", "out.svg", "--angles", "1,2,3,4,5"], 2),
        (&["null", "-o", "missing/out.svg"], 4),
    ] {
        let outcome = folder.run(&[&["brdf", "plot"], arguments].concat());
        assert_eq!(outcome.exit, Some(exit), "{arguments:?}: {}", outcome.stderr);
        assert_eq!(outcome.errors().len(), 1, "{arguments:?}: {}", outcome.stderr);
    }
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}
