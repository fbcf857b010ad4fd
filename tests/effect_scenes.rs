//! The scenes in `scenes/effects/`: each calls for the effect it is named after, and looks as it did.
//! Some call for further effects that have no scene of their own.

mod common;

use std::collections::HashSet;

use common::effects::{list, names};
use common::golden::Golden;
use common::{Folder, repository};
use serde_json::Value;

/// Name of every scene, bound of the relMSE and of the relative difference of the means: twice the largest of eight seeds,
/// as `tests/golden/bounds.sh` measures them.
const SCENES: &[(&str, f64, f64)] = &[
    ("area-light", 0.00064, 0.003),
    ("bitmap-texture", 0.0029, 0.0013),
    ("blend", 0.016, 0.0058),
    ("bump-map", 0.078, 0.017),
    ("checkerboard-texture", 0.0032, 0.0026),
    ("constant-background", 0.0011, 0.00057),
    ("delta-reflection", 0.00051, 0.00097),
    ("delta-transmission", 0.005, 0.0037),
    ("depth-of-field", 0.0021, 0.0017),
    ("directional-light", 0.00025, 0.0006),
    ("dispersion", 0.16, 0.017),
    ("emitter-in-medium", 0.0068, 0.0077),
    ("environment-map", 0.0031, 0.0024),
    ("heterogeneous-medium", 0.02, 0.011),
    ("hidden-emitters", 0.0021, 0.0035),
    ("homogeneous-medium", 0.018, 0.013),
    ("indirect-light", 0.0025, 0.0042),
    ("instancing", 0.0037, 0.0022),
    ("mesh-attribute", 0.026, 0.01),
    ("motion-blur", 0.0031, 0.0014),
    ("multiple-scattering", 0.016, 0.0097),
    ("nested-dielectrics", 0.0145, 0.007),
    ("normal-map", 0.057, 0.011),
    ("opacity-mask", 0.015, 0.0028),
    ("pass-through", 0.0015, 0.0011),
    ("point-light", 0.000058, 0.00039),
    ("principled", 0.24, 0.016),
    ("projector", 0.00014, 0.0016),
    ("rough-reflection", 0.0018, 0.0034),
    ("rough-transmission", 0.0044, 0.0047),
    ("spectral-colours", 0.0069, 0.0072),
    ("spot-light", 0.00018, 0.00096),
    ("strict-normals", 0.0028, 0.0016),
    ("subsurface", 0.034, 0.007),
    ("texture-filtering", 0.0038, 0.0012),
    ("volume-texture", 0.0029, 0.0023),
];

/// Scenes of what comes of several effects, which are called after that.
const COMPOSITIONS: [&str; 2] = ["emitter-in-medium", "subsurface"];

fn scene(name: &str) -> String {
    format!("scenes/effects/{name}.xml")
}

/// What `etendue effects` says of a scene.
fn effects(scene: &str) -> Vec<Value> {
    list(&Folder::new(), repository(scene).to_str().expect("UTF-8"), &[])
}

#[test]
fn every_effect_has_a_scene_that_calls_for_it() {
    let mut called_for = HashSet::new();
    let mut vocabulary = HashSet::new();
    for &(name, ..) in SCENES {
        let effects = effects(&scene(name));
        let (present, absent) =
            (names(&effects, "present", true), names(&effects, "present", false));
        vocabulary = present.union(&absent).map(|&effect| effect.to_owned()).collect();
        if vocabulary.contains(name) {
            assert!(present.contains(name), "{name}");
        }
        called_for.extend(present.into_iter().map(str::to_owned));
    }
    assert_eq!(called_for, vocabulary);
    let document = std::fs::read_to_string(repository("docs/effects.md")).expect("a document");
    for effect in vocabulary {
        assert!(document.contains(&format!("\n| `{effect}` | ")), "{effect} in docs/effects.md");
    }
}

#[test]
fn every_scene_has_a_golden_picture_and_looks_as_it_did() {
    let files = std::fs::read_dir(repository("scenes/effects")).expect("a folder");
    let files = files.map(|file| file.expect("a file").path());
    let scenes = files.filter(|path| path.extension().is_some_and(|e| e == "xml"));
    let found: HashSet<_> = scenes.filter_map(|p| Some(p.file_stem()?.to_owned())).collect();
    assert_eq!(found, SCENES.iter().map(|scene| scene.0.into()).collect());
    for &(name, relative_mse, mean_difference) in SCENES {
        let (scene, golden) = (scene(name), format!("effects/{name}"));
        Golden { scene: &scene, name: &golden, size: "48x32", relative_mse, mean_difference }
            .check();
    }
}

#[test]
fn leaving_out_what_is_absent_changes_no_bit_of_any_scene() {
    for &(name, ..) in SCENES {
        let (path, effects) = (repository(&scene(name)), effects(&scene(name)));
        let absent = names(&effects, "present", false).into_iter().collect::<Vec<_>>().join(",");
        let folder = Folder::new();
        let options = ["--size", "24x16", "--spp", "8"];
        let whole = folder.render(&path, &options);
        let without = folder.render(&path, &[&options[..], &["--without", &absent]].concat());
        assert!(whole.samples().eq(without.samples()), "{name} without {absent}");
    }
}

#[test]
fn leaving_out_the_effect_of_a_scene_changes_its_picture() {
    for &(name, ..) in SCENES.iter().filter(|(name, ..)| !COMPOSITIONS.contains(name)) {
        assert!(
            names(&effects(&scene(name)), "present", true).contains(name),
            "{name} is no effect"
        );
        let (path, folder) = (repository(&scene(name)), Folder::new());
        let options = ["--size", "48x32", "--spp", "8"];
        let whole = folder.render(&path, &options);
        let without = folder.render(&path, &[&options[..], &["--without", name]].concat());
        assert!(!whole.samples().eq(without.samples()), "{name}");
    }
}
