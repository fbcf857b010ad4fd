//! `etendue convert`: a scene as one of Mitsuba 3.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use etendue_scene::export::{Export, ExportOptions, export};

use super::scene_arguments::{SceneArguments, load};
use crate::failure::{Exit, Failure};
use crate::output::Destination;

/// Writes a scene as one of Mitsuba 3 that shows the same.
///
/// Meshes, images and volumes go into a folder beside it: OUT_files for OUT.xml. What Mitsuba 3 does not have is written as the
/// nearest that it has, with a warning that says what is lost.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// The scene file to write (.xml); it is replaced as a whole, after the files that it names.
    output: PathBuf,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let output = &arguments.output;
    if !output.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("xml")) {
        let message = format!("{}: a scene file is named *.xml", output.display());
        return Err(Failure::usage(message));
    }
    let destination = Destination::check(output)?;
    let input = &arguments.scene.scene;
    spare([input.as_path()], output)?;
    let folder = folder_of(output);
    if folder.is_dir() {
        Destination::check(&folder.join("file"))?;
    }
    let loaded = load(input, &arguments.scene.load_options())?;
    let inputs: Vec<&Path> = loaded.files.iter().map(PathBuf::as_path).collect();
    spare(inputs.iter().copied(), output)?;
    let options = ExportOptions {
        folder: lossy(folder.file_name()),
        remark: format!(
            "Written by étendue {} from {}",
            env!("CARGO_PKG_VERSION"),
            lossy(input.file_name())
        ),
        layers: loaded.layers,
    };
    let Export { xml, files, losses } =
        export(loaded.scene, &options).map_err(|error| Failure::write(output, error))?;
    for loss in losses {
        eprintln!("etendue: warning: {loss}");
    }
    if !files.is_empty() {
        fs::create_dir_all(&folder).map_err(|error| Failure::write(&folder, error))?;
    }
    // All of them before any is written.
    let mut destinations = Vec::with_capacity(files.len());
    for file in &files {
        let path = folder.join(&file.name);
        spare(inputs.iter().copied(), &path)?;
        destinations.push(Destination::check(&path)?);
    }
    for (file, destination) in files.iter().zip(&destinations) {
        destination.write(&file.bytes)?;
    }
    destination.write(xml.as_bytes())?;
    Ok(Exit::Done)
}

/// `OUT_files` beside `OUT.xml`.
fn folder_of(output: &Path) -> PathBuf {
    output.with_file_name(lossy(output.file_stem()) + "_files")
}

fn lossy(name: Option<&OsStr>) -> String {
    name.unwrap_or_default().to_string_lossy().into_owned()
}

/// Refuses to write over a file that is read.
fn spare<'a>(inputs: impl IntoIterator<Item = &'a Path>, output: &Path) -> Result<(), Failure> {
    // A file that does not exist yet is none that is read.
    let Ok(output_itself) = output.canonicalize() else { return Ok(()) };
    let is_output = |input: &&Path| input.canonicalize().is_ok_and(|input| input == output_itself);
    match inputs.into_iter().find(is_output) {
        Some(input) => Err(Failure::usage(format!(
            "{} would be written over {}, which the scene is read from; choose another name",
            output.display(),
            input.display()
        ))),
        None => Ok(()),
    }
}
