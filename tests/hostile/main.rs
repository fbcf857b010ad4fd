//! Never believe the input: scenes and assets that are malformed, absurd or malicious, and what must come of each within bounded
//! time and memory. `README.md` beside this file lists them; each is a row of one of the modules below.

#![allow(clippy::too_many_lines, reason = "tables of cases")]
#![allow(clippy::format_collect, reason = "long texts of many short lines, made once")]

extern crate alloc;

#[path = "../common/mod.rs"]
mod common;

mod checkpoints;
mod files;
mod gltf;
mod growth;
mod images;
mod meshes;
mod png;
mod values;
mod volumes;
mod xml;

use alloc::collections::BTreeSet;
use std::env;
use std::fs;

use common::case::{Case, check};
use common::{Folder, repository};

/// The cases by what they attack.
fn corpus() -> Vec<(&'static str, Vec<Case>)> {
    vec![
        ("The text of scene files", xml::cases()),
        ("Values in scene files", values::cases()),
        ("What names lead to", files::cases()),
        ("What grows", growth::cases()),
        ("Meshes and curves", meshes::cases()),
        ("Images", images::cases()),
        ("Volumes and distance fields", volumes::cases()),
        ("glTF", gltf::cases()),
        ("Checkpoints", checkpoints::cases()),
    ]
}

/// The cases of one module.
fn of(title: &str) -> Vec<Case> {
    let found = corpus().into_iter().find(|(name, _)| *name == title);
    found.expect("a title of the corpus").1
}

#[test]
fn the_text_of_scene_files() {
    check(of("The text of scene files"));
}

#[test]
fn values_in_scene_files() {
    check(of("Values in scene files"));
}

#[cfg(unix)]
#[test]
fn what_names_lead_to() {
    check(of("What names lead to"));
}

#[test]
fn what_grows() {
    check(of("What grows"));
}

#[test]
fn meshes_and_curves() {
    check(of("Meshes and curves"));
}

#[test]
fn images() {
    check(of("Images"));
}

#[test]
fn volumes_and_distance_fields() {
    check(of("Volumes and distance fields"));
}

#[test]
fn gltf() {
    check(of("glTF"));
}

#[cfg(unix)]
#[test]
fn checkpoints() {
    check(of("Checkpoints"));
}

/// Where the list in `README.md` begins.
const MARK: &str = "<!-- cases -->\n";

/// With the variable `HOSTILE_TABLE` set, the list is written instead.
#[test]
fn the_list_is_that_of_the_cases() {
    let path = repository("tests/hostile/README.md");
    let text = fs::read_to_string(&path).expect("the README of the corpus");
    let (head, _) = text.split_once(MARK).expect("a place for the list");
    let mut table = String::new();
    let (mut count, mut names) = (0, BTreeSet::new());
    for (title, cases) in corpus() {
        table += &format!("\n### {title}\n\n| case | exit | says |\n| --- | ---: | --- |\n");
        for case in &cases {
            assert!(names.insert((title, case.what)), "{title}: two cases “{}”", case.what);
            let says = case.says.iter().map(|says| says.replace('|', "\\|"));
            let says = says.collect::<Vec<_>>().join(" … ");
            table += &format!("| {} | {} | {says} |\n", case.what, case.exit);
        }
        count += cases.len();
    }
    let expected = format!("{head}{MARK}\n{count} cases.\n{table}");
    if env::var_os("HOSTILE_TABLE").is_some() {
        fs::write(&path, expected).expect("a writable repository");
    } else {
        assert_eq!(
            text, expected,
            "write the list: HOSTILE_TABLE=1 cargo test --test hostile list"
        );
    }
}

/// With the variable `HOSTILE_FILES` set to a folder, the files of all cases are written there, for other programs.
#[test]
fn every_case_is_made_of_files_that_can_be_written() {
    let temporary;
    let root = match env::var_os("HOSTILE_FILES") {
        Some(folder) => std::path::PathBuf::from(folder),
        None => {
            temporary = Folder::new();
            temporary.path("corpus")
        }
    };
    let mut bytes = 0;
    for (title, cases) in corpus() {
        for case in cases {
            let folder = root.join(title).join(case.what.replace('/', "-"));
            bytes += case.write(&folder);
        }
    }
    // They are made when they are needed: nobody has to keep them. A bound, so that they stay quick to make.
    assert!(bytes < 1 << 27, "{bytes} bytes");
}
