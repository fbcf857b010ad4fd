//! What `etendue effects` says of a scene.

use std::collections::HashSet;

use serde_json::Value;

use super::Folder;

/// The list for a scene, named as seen from the folder.
pub(crate) fn list(folder: &Folder, scene: &str, arguments: &[&str]) -> Vec<Value> {
    let outcome = folder.run(&[&["effects", scene, "--json"], arguments].concat());
    assert_eq!(outcome.exit, Some(0), "{scene}: {}", outcome.stderr);
    outcome.json().as_array().expect("a list").clone()
}

/// The names of those for which `what` is `value`.
pub(crate) fn names<'a>(effects: &'a [Value], what: &str, value: bool) -> HashSet<&'a str> {
    let chosen = effects.iter().filter(|effect| effect[what] == value);
    chosen.map(|effect| effect["effect"].as_str().expect("a name")).collect()
}
