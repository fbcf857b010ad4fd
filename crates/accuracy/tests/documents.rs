//! The document of results shows what the program would measure now.

use std::fs;
use std::path::Path;

use etendue_accuracy::functions::{Effort, FAMILIES};

#[test]
fn the_document_has_every_family_and_every_variant() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let text = fs::read_to_string(folder.join("accuracy.md")).expect("docs/accuracy.md");
    let rerun =
        "cargo run --release --bin etendue -- accuracy functions --markdown docs/accuracy.md";
    for info in FAMILIES {
        let heading = format!("\n## {}\n", info.title);
        let (_, rest) = text.split_once(&heading).unwrap_or_else(|| panic!("{heading}: {rerun}"));
        let part = rest.split("\n## ").next().unwrap_or_default();
        for variant in info.family(Effort::Quick).setup.variants {
            let row = format!("\n| {} | {} | ", variant.name(), variant.precision().name());
            assert!(part.contains(&row), "{}: no row{row}: {rerun}", info.title);
        }
        let picture = format!("images/accuracy/functions-{}.svg", info.name);
        assert!(part.contains(&picture) && folder.join(&picture).is_file(), "{picture}: {rerun}");
    }
}
