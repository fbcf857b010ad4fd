//! `etendue accuracy`: what it writes can be read.

mod common;

use common::Folder;

/// A family without references that take long.
const FAMILY: &str = "dielectric-fresnel";

#[test]
fn every_output_of_a_quick_run_can_be_read() {
    let folder = Folder::new();
    let files = ["--json", "r.json", "--csv", "r.csv", "--svg", "r.svg", "--html", "r.html"];
    let fixed =
        ["accuracy", "functions", "--quick", "--no-instructions", "--quiet", "--family", FAMILY];
    let outcome = folder.run(&[&fixed[..], &files].concat());
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    assert_eq!(outcome.stderr, "");

    let json = folder.json("r.json");
    let rows = json["sections"][FAMILY]["rows"].as_array().expect("rows of the family");
    assert_eq!(rows.iter().filter(|row| row["exact"] == true).count(), 1);
    assert!(rows.iter().any(|row| row["front_time"] == true));
    assert!(rows.iter().all(|row| row["instructions"].is_null()));
    let error = |name: &str, precision: &str| {
        let found = rows.iter().find(|r| r["variant"] == name && r["precision"] == precision);
        found.and_then(|row| row["rms_relative"].as_f64()).expect(name)
    };
    // A few ulp of either precision, and an approximation of another function.
    assert!(error("stable", "f64") < 1e-15 && error("stable", "f32") < 1e-6);
    assert!(error("Schlick by products", "f64") > 1e-3);

    let csv = folder.read("r.csv");
    let width = |line: &str| {
        line.split('"').step_by(2).map(|part| part.matches(',').count()).sum::<usize>()
    };
    let heading = csv.lines().next().expect("a line of headings");
    assert!(heading.starts_with("section,variant,precision,exact,"), "{heading}");
    assert_eq!(csv.lines().count(), 1 + rows.len());
    for line in csv.lines() {
        assert_eq!(width(line), width(heading), "{line}");
    }

    let svg = folder.read("r.svg");
    let picture = roxmltree::Document::parse(&svg).expect("well-formed SVG");
    let markers =
        |node: &roxmltree::Node| node.attribute("class").is_some_and(|c| c.starts_with("marker"));
    assert!(picture.descendants().filter(markers).count() >= rows.len());
    let html = folder.read("r.html");
    // But for the type of the document and the void elements of its head, the page is XML.
    let page = html.replace("<!DOCTYPE html>\n", "").replace("<meta charset=\"utf-8\">", "");
    let page = page.replace("content=\"width=device-width,initial-scale=1\">", "content=\"\"/>");
    let page = roxmltree::Document::parse(&page).expect("well-formed HTML");
    assert!(page.descendants().any(|node| node.attribute("id") == Some(FAMILY)));
    assert!(outcome.stdout.contains("| stable | f64 | ● |"), "{}", outcome.stdout);
}

#[test]
fn a_document_gets_its_part_and_its_pictures() {
    let folder = Folder::new();
    folder.write("doc.md", "before\n<!-- begin functions -->\n<!-- end functions -->\nafter\n");
    let arguments = ["accuracy", "functions", "--quick", "--no-instructions", "--quiet"];
    let outcome =
        folder.run(&[&arguments[..], &["--family", FAMILY, "--markdown", "doc.md"]].concat());
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    let document = folder.read("doc.md");
    assert!(document.starts_with("before\n") && document.ends_with("after\n"));
    let picture = format!("images/accuracy/functions-{FAMILY}.svg");
    assert!(document.contains(&picture), "{document}");
    assert!(folder.path(&picture).is_file());
}

#[test]
fn an_unknown_family_is_an_error_that_names_the_known_ones() {
    let folder = Folder::new();
    let outcome = folder.run(&["accuracy", "functions", "--family", "phrenology"]);
    assert_eq!(outcome.exit, Some(2));
    assert_eq!(outcome.errors().len(), 1, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("'phrenology'") && outcome.stderr.contains(FAMILY));
}

#[test]
fn two_outputs_into_one_file_are_refused_before_anything_is_measured() {
    let folder = Folder::new();
    let files = ["--json", "r.txt", "--csv", "r.txt"];
    let outcome = folder.run(&[&["accuracy", "functions"], &files[..]].concat());
    assert_eq!(outcome.exit, Some(2));
    assert_eq!(outcome.errors(), ["etendue: error: --json and --csv both name r.txt"]);
    assert!(folder.names().is_empty());
}

#[test]
fn a_document_without_the_part_is_refused_before_anything_is_measured() {
    let folder = Folder::new();
    folder.write("doc.md", "nothing\n");
    let outcome = folder.run(&["accuracy", "functions", "--markdown", "doc.md"]);
    assert_eq!(outcome.exit, Some(4));
    assert!(outcome.stderr.contains("begin functions"), "{}", outcome.stderr);
}
