//! Arguments of every command that reads a scene.

use std::path::{Path, PathBuf};

use etendue_scene::xml::Leniency;
use etendue_scene::{LoadOptions, LoadedScene, load_scene};

use crate::failure::Failure;

/// Which scene, and how it is read.
#[derive(Debug, clap::Args)]
pub(crate) struct SceneArguments {
    /// A scene in Mitsuba's XML, a glTF model (.gltf, .glb), or a bare mesh (.obj, .ply).
    pub(crate) scene: PathBuf,
    /// Set a parameter of the scene file, as in `-D spp=64`.
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = definition)]
    definitions: Vec<(String, String)>,
    /// Report unknown parameters as warnings instead of errors.
    #[arg(long)]
    lenient: bool,
    /// Material of a bare mesh or of all of a model, as in `--bsdf roughconductor:material=Au,alpha=0.2`.
    #[arg(long, value_name = "TYPE[:KEY=VALUE,…]")]
    bsdf: Option<String>,
    /// Refuse files outside of the scene's folder, wherever links and `..` lead: for scenes that are not trusted.
    #[arg(long)]
    sandbox: bool,
}

impl SceneArguments {
    /// Those that a picture depends on, by name.
    pub(crate) fn settings(&self) -> Vec<(String, String)> {
        let definitions =
            self.definitions.iter().map(|(name, value)| (format!("-D {name}"), value.clone()));
        let bsdf = self.bsdf.iter().map(|bsdf| ("--bsdf".to_owned(), bsdf.clone()));
        definitions.chain(bsdf).collect()
    }

    /// What these arguments ask of the loader.
    pub(crate) fn load_options(&self) -> LoadOptions {
        LoadOptions {
            definitions: self.definitions.clone(),
            leniency: if self.lenient { Leniency::Lenient } else { Leniency::Strict },
            bsdf: self.bsdf.clone(),
            sandbox: self.sandbox,
            ..LoadOptions::default()
        }
    }
}

/// Warnings that are printed one by one.
const MOST_WARNINGS: usize = 100;

/// Reads a scene and prints its warnings.
pub(crate) fn load(path: &Path, options: &LoadOptions) -> Result<LoadedScene, Failure> {
    let loaded = load_scene(path, options)?;
    for warning in loaded.warnings.iter().take(MOST_WARNINGS) {
        eprintln!("etendue: warning: {warning}");
    }
    if let Some(more @ 1..) = loaded.warnings.len().checked_sub(MOST_WARNINGS) {
        eprintln!("etendue: warning: {more} more warnings of the scene");
    }
    Ok(loaded)
}

fn definition(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.is_empty() => Ok((name.to_owned(), value.to_owned())),
        _ => Err("expected NAME=VALUE".to_owned()),
    }
}
