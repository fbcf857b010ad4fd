//! Documents that programs write are what the programs would write now.

use std::fs;
use std::path::{Path, PathBuf};

use etendue_audit::hard_cases::HARD_CASES;
use etendue_audit::model_table::{Links, model_table};
use etendue_audit::mutations;
use etendue_brdf::registry::MODELS;
use etendue_report::document::with_part;

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)
}

fn read(name: &str) -> String {
    fs::read_to_string(path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn tables_of_models_are_those_of_the_registry() {
    for (name, links) in
        [("crates/brdf/README.md", Links::None), ("crates/brdf/src/lib.rs", Links::Rustdoc)]
    {
        let text = read(name);
        let fresh = with_part(&text, "models", &model_table(links)).unwrap();
        assert!(fresh == text, "stale: cargo run --release -p etendue-audit -- --models {name}");
    }
}

#[test]
fn the_audits_findings_cover_every_model_and_every_hard_case() {
    let text = read("docs/audit.md");
    let rerun = "cargo run --release -p etendue-audit -- --exhaustive --markdown docs/audit.md";
    for info in MODELS {
        assert!(
            text.contains(&format!("\n| {} | ", info.name)),
            "{} is missing: {rerun}",
            info.name
        );
    }
    for hard in HARD_CASES {
        let row = format!("\n| `{}` | {} | ", hard.function, hard.name);
        assert!(text.contains(&row), "{row} is missing: {rerun}");
    }
    assert!(text.contains("checks passed, 0 failed"), "findings with failures: {rerun}");
}

#[test]
fn the_seeded_bugs_are_those_of_the_document_and_all_were_found() {
    let text = read("docs/audit.md");
    let rerun =
        "cargo run --release -p etendue-audit --bin etendue-mutations -- --markdown docs/audit.md";
    let table = text.split("<!-- begin mutations -->").nth(1).expect("a part for seeded bugs");
    // Below the head of the table: the file, the bug, and the checks that found it.
    let rows: Vec<&str> = table.lines().filter(|line| line.starts_with("| `crates/")).collect();
    let all = mutations::all();
    for mutation in &all {
        let fault = format!(" | {} | ", mutation.fault.replace('|', "\\|"));
        let row = rows.iter().find(|row| row.contains(&fault));
        let row = row.unwrap_or_else(|| panic!("'{fault}' is missing: {rerun}"));
        let found = row.rsplit(&fault).next().unwrap_or_default();
        assert!(found.len() > 2 && !found.starts_with("**"), "not found: {row}; {rerun}");
    }
    assert_eq!(rows.len(), all.len(), "rows of bugs that there are no more: {rerun}");
}

#[test]
fn every_seeded_bug_still_has_its_place() {
    let all = mutations::all();
    assert!(all.len() >= 130);
    for (i, mutation) in all.iter().enumerate() {
        let count = read(mutation.file).matches(mutation.find).count();
        assert_eq!(count, 1, "'{}' in {}", mutation.fault, mutation.file);
        assert_ne!(mutation.find, mutation.replace, "{}", mutation.fault);
        let same = all[..i].iter().filter(|m| m.fault == mutation.fault).count();
        assert_eq!(same, 0, "two bugs are called '{}'", mutation.fault);
    }
}
