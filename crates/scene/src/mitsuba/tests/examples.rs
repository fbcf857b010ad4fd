//! The examples of plugins.

use alloc::collections::BTreeSet;
use alloc::vec::Vec;

use std::path::PathBuf;

use super::*;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/scenes/plugins")
}

/// Names of the files, without their extension.
fn examples() -> BTreeSet<String> {
    let entries = std::fs::read_dir(folder()).expect("the examples");
    let names = entries.map(|entry| entry.expect("an entry").file_name().into_string());
    let names = names.map(|name| name.expect("a name in UTF-8"));
    names.filter_map(|name| name.strip_suffix(".xml").map(String::from)).collect()
}

/// The plugins of a family, as the message about one that does not exist lists them.
fn plugins(scene: &str) -> Vec<String> {
    let error = load(&scene.replace("type=\"?\"", "type=\"§§§§§§\"")).expect_err(scene);
    let help = error.help.expect("a list");
    let list = help.strip_prefix("supported are ").expect("a list").split(", ");
    list.map(String::from).collect()
}

#[test]
fn every_plugin_has_an_example() {
    let examples = examples();
    let families = [
        ("bsdf", "<bsdf type=\"?\"/>"),
        ("texture", "<texture type=\"?\"/>"),
        ("emitter", "<emitter type=\"?\"/>"),
        ("emitter", "<shape type=\"sphere\"><emitter type=\"?\"/></shape>"),
        ("shape", "<shape type=\"?\"/>"),
        ("medium", "<shape type=\"sphere\"><medium name=\"interior\" type=\"?\"/></shape>"),
        (
            "phase",
            "<shape type=\"sphere\"><medium name=\"interior\" type=\"homogeneous\"><phase type=\"?\"/></medium></shape>",
        ),
        (
            "volume",
            "<shape type=\"sphere\"><medium name=\"interior\" type=\"homogeneous\"><volume name=\"albedo\" type=\"?\"/></medium></shape>",
        ),
        ("integrator", "<integrator type=\"?\"/>"),
        ("sensor", "<sensor type=\"?\"/>"),
        ("film", "<sensor type=\"perspective\"><film type=\"?\"/></sensor>"),
        (
            "rfilter",
            "<sensor type=\"perspective\"><film type=\"hdrfilm\"><rfilter type=\"?\"/></film></sensor>",
        ),
        ("sampler", "<sensor type=\"perspective\"><sampler type=\"?\"/></sensor>"),
    ];
    let mut missing = Vec::new();
    for (family, scene) in families {
        for plugin in plugins(scene) {
            let is_there = |family| examples.contains(&format!("{family}_{plugin}"));
            // Textures that are the same everywhere are spectra.
            if !(is_there(family) || family == "texture" && is_there("spectrum")) {
                missing.push(format!("{family}_{plugin}"));
            }
        }
    }
    assert!(missing.is_empty(), "no example of {missing:?}");
}

#[test]
fn every_example_is_a_scene_without_warnings() {
    for name in examples() {
        let loaded = load_scene(&folder().join(format!("{name}.xml")), &LoadOptions::default());
        let loaded = loaded.unwrap_or_else(|error| panic!("{name}: {error}"));
        assert!(loaded.warnings.is_empty(), "{name}: {:?}", loaded.warnings);
        assert!(!loaded.scene.surfaces.is_empty(), "{name}");
    }
}
