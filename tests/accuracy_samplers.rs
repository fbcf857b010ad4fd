//! `etendue accuracy`: short measurements through the real command and every file they leave.

mod common;

use common::Folder;

#[test]
fn samplers_of_a_model_leave_every_kind_of_file() {
    let folder = Folder::new();
    folder.write("doc.md", "<!-- begin samplers -->\n<!-- end samplers -->\n");
    let outcome = folder.run(&[
        "accuracy",
        "samplers",
        "--quick",
        "--quiet",
        "--model",
        "lambert",
        "--json",
        "a.json",
        "--csv",
        "a.csv",
        "--svg",
        "a.svg",
        "--html",
        "a.html",
        "--markdown",
        "doc.md",
    ]);
    assert_eq!((outcome.exit, outcome.stderr.as_str()), (Some(0), ""));
    assert!(outcome.stdout.contains("| lambert | cosine |"), "{}", outcome.stdout);

    let json = folder.json("a.json");
    assert!(json["facts"]["date"].is_string() && json["facts"]["processor"].is_string());
    let rows = json["sections"]["furnace"]["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 3);
    for row in rows {
        let is_uniform = row["strategy"] == "uniform";
        assert_eq!(row["efficiency_independent"] == "exact", !is_uniform, "{row}");
    }
    // One row of the digest, then three sections of three rows, under two lines of headings with an empty line between.
    let csv = folder.read("a.csv");
    assert_eq!(csv.lines().count(), 13, "{csv}");
    assert!(folder.read("a.html").contains("<svg"));
    assert!(folder.read("a.svg").starts_with("<svg"));
    let document = folder.read("doc.md");
    assert!(document.contains("(images/accuracy/samplers-furnace.svg)"), "{document}");
    assert!(folder.path("images/accuracy/samplers-furnace.svg").exists());
}

#[test]
fn an_unknown_model_is_refused_with_the_list_of_those_there_are() {
    let folder = Folder::new();
    for name in ["lambort", "null"] {
        let outcome = folder.run(&["accuracy", "samplers", "--model", name]);
        assert_eq!(outcome.exit, Some(2), "{name}");
        let message = outcome.errors().join("\n");
        assert!(message.contains(name) && message.contains("lambert, "), "{message}");
    }
}
