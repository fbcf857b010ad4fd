//! `etendue accuracy scene`: a small experiment through the real command, its files and its checkpoint.

mod common;

use std::fs;

use common::{Folder, Outcome};
use serde_json::Value;

/// A rough ball under a bright sky: forms of models, depths, and lights that both ways find.
const SCENE: &str = r#"<scene version="3.0.0">
    <emitter type="constant"/>
    <shape type="sphere"><bsdf type="roughdiffuse"><float name="sigma" value="0.5"/></bsdf></shape>
</scene>"#;

fn run(folder: &Folder, more: &[&str]) -> Outcome {
    folder.write("scene.xml", SCENE);
    let base = [
        "accuracy",
        "scene",
        "scene.xml",
        "--quiet",
        "--size",
        "8x8",
        "--spp-max",
        "4",
        "--replications",
        "4",
        "--threads",
        "1",
    ];
    let mut arguments = base.to_vec();
    arguments.extend(more);
    folder.run(&arguments)
}

#[test]
fn a_scene_has_a_row_for_every_variant_and_level_in_every_kind_of_file() {
    let folder = Folder::new();
    folder.write("doc.md", "<!-- begin scene -->\n<!-- end scene -->\n");
    let files = [
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
    ];
    let outcome = run(&folder, &files);
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    let json = folder.json("a.json");
    assert_eq!(json["facts"]["size"], "8×8");
    let rows = |section: &str| json["sections"][section]["rows"].as_array().expect("rows").clone();
    let variants = rows("times").len();
    assert!(variants > 6, "{json}");
    assert_eq!(rows("bias").len(), variants);
    // 1, 2 and 4 samples.
    assert_eq!(rows("levels").len(), 3 * variants);
    for form in ["Oren–Nayar, qualitative", "Lambert for Oren–Nayar"] {
        assert!(rows("bias").iter().any(|row| row["variant"] == form), "{form}");
    }
    for name in ["a.csv", "a.svg", "a.html"] {
        let text = folder.read(name);
        assert!(text.contains("BSDF only"), "{name}");
    }
    let document = folder.read("doc.md");
    assert!(document.contains("(images/accuracy/scene-times-2.svg)"), "{document}");
}

#[test]
fn a_checkpoint_is_gone_on_from_and_that_of_another_experiment_refused() {
    let folder = Folder::new();
    let first = run(&folder, &["--checkpoint", "kept", "--json", "a.json"]);
    assert_eq!(first.exit, Some(0), "{}", first.stderr);
    let second = run(&folder, &["--checkpoint", "kept", "--json", "b.json"]);
    assert_eq!(second.exit, Some(0), "{}", second.stderr);
    // Times too: nothing was rendered again.
    assert_eq!(folder.json("a.json"), folder.json("b.json"));
    let other = run(&folder, &["--checkpoint", "kept", "--seed", "2"]);
    assert_eq!(other.exit, Some(4));
    assert!(other.errors()[0].contains("seed is 1 there and 2 now"), "{}", other.stderr);
    let file = run(&folder, &["--checkpoint", "scene.xml"]);
    assert_eq!(
        (file.exit, file.errors()),
        (Some(4), vec!["etendue: error: scene.xml: not a directory".to_owned()])
    );
}

#[test]
fn a_given_reference_sets_the_size_and_one_of_another_size_is_refused() {
    let folder = Folder::new();
    folder.write("scene.xml", SCENE);
    let rendered = folder.run(&[
        "render",
        "scene.xml",
        "-o",
        "r.exr",
        "--size",
        "6x4",
        "--spp",
        "64",
        "--quiet",
    ]);
    assert_eq!(rendered.exit, Some(0), "{}", rendered.stderr);
    let refused = run(&folder, &["--reference", "r.exr"]);
    assert_eq!(refused.exit, Some(2));
    assert!(
        refused.errors()[0].contains("8×8") && refused.errors()[0].contains("6×4"),
        "{}",
        refused.stderr
    );
    let arguments = [
        "accuracy",
        "scene",
        "scene.xml",
        "--quiet",
        "--reference",
        "r.exr",
        "--spp-max",
        "1",
        "--replications",
        "4",
        "--json",
        "a.json",
    ];
    let outcome = folder.run(&arguments);
    assert_eq!(outcome.exit, Some(0), "{}", outcome.stderr);
    assert_eq!(folder.json("a.json")["facts"]["reference"], "given");
}

#[test]
fn an_odd_number_of_replications_is_refused() {
    let folder = Folder::new();
    let outcome = folder.run(&["accuracy", "scene", "scene.xml", "--replications", "5"]);
    assert_eq!(outcome.exit, Some(2));
    assert!(outcome.stderr.contains("even number"), "{}", outcome.stderr);
}

#[cfg(unix)]
#[test]
fn an_interrupted_experiment_keeps_what_is_finished() {
    use core::time::Duration;
    use std::process::{Command, Stdio};
    use std::thread::sleep;

    let folder = Folder::new();
    folder.write("scene.xml", SCENE);
    // Hours, if nobody interrupted it.
    let arguments = [
        "accuracy",
        "scene",
        "scene.xml",
        "--quiet",
        "--size",
        "16x16",
        "--spp-max",
        "1048576",
        "--reference-spp",
        "1",
        "--threads",
        "1",
        "--checkpoint",
        "kept",
    ];
    let mut command = folder.command(&arguments);
    let mut child =
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the command starts");
    let records = || {
        let text = fs::read_to_string(folder.path("kept/experiment.json")).unwrap_or_default();
        let state: Value = serde_json::from_str(&text).unwrap_or_default();
        state["records"].as_array().map_or(0, Vec::len)
    };
    while records() == 0 {
        assert_eq!(child.try_wait().expect("a child of this process"), None, "it ends by itself");
        sleep(Duration::from_millis(10));
    }
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status().expect("kill exists");
    assert!(sent.success());
    let outcome: Outcome = child.wait_with_output().expect("the command ends").into();
    assert_eq!(outcome.exit, Some(130), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("goes on from what kept holds"), "{}", outcome.stderr);
    assert!(records() > 0);
}
