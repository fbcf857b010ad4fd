//! `etendue accuracy scene`: error against time of ways to render a scene.

use std::fs;
use std::path::PathBuf;

use etendue_accuracy::scene::{self, Checkpoint, ExperimentError, Settings, Subject, Watch};
use etendue_math::mix_u64;
use etendue_renderer::{Image, Progress};
use etendue_scene::{LoadOptions, LoadedScene, load_scene};

use super::facts;
use super::report_files::ReportArguments;
use crate::commands::compare::read;
use crate::commands::scene_arguments::{SceneArguments, load};
use crate::commands::values::size;
use crate::failure::{Exit, Failure};
use crate::interrupt::Interrupt;
use crate::progress::{ProgressDisplay, Quiet, Standing};

/// Error against time of ways to render a scene: strategies, points, limits of path lengths, forms of models.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// What pictures are compared with; rendered with many samples if not given.
    #[arg(long, value_name = "PICTURE")]
    reference: Option<PathBuf>,
    /// Samples per pixel of the rendered reference, which is two pictures of so many; 32 times the most samples of a
    /// picture if not given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), conflicts_with = "reference")]
    reference_spp: Option<u32>,
    /// Most samples per pixel; every power of two up to it is rendered.
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u32).range(1..=1 << 20))]
    spp_max: u32,
    /// Size of the pictures; that of the reference, or the film's scaled down to 96 pixels, if not given.
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Pictures of every kind, an even number from 4 on: bias and its error come from pairs.
    #[arg(long, value_name = "N", default_value_t = 8, value_parser = replications)]
    replications: u32,
    /// Seed of the random numbers.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Threads; all cores if not given. Errors do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    threads: Option<u16>,
    /// Keep every finished pair of pictures in this folder, and go on from what is there.
    #[arg(long, value_name = "FOLDER")]
    checkpoint: Option<PathBuf>,
    #[command(flatten)]
    quiet: Quiet,
    #[command(flatten)]
    files: ReportArguments,
}

const PART: &str = "scene";
/// Longest side of a picture whose size nobody chose.
const USUAL_SIDE: u32 = 96;

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let files = arguments.files.check(PART)?;
    let interrupt = Interrupt::install()?;
    let reference = arguments.reference.as_deref().map(read).transpose()?;
    let options = arguments.load_options(reference.as_ref())?;
    let path = &arguments.scene.scene;
    let loaded = load(path, &options)?;
    let subject = Subject::new(|| load_scene(path, &options).map(|again| again.scene))?;
    let settings = arguments.settings();
    let hash = reference.as_ref().map(picture_hash);
    let circumstances = settings.circumstances(&subject, arguments.scene_hash(&loaded)?, hash);
    let open = |folder: &PathBuf| Checkpoint::open(folder, circumstances);
    let checkpoint =
        arguments.checkpoint.as_ref().map(open).transpose().map_err(ExperimentError::from)?;

    let display = ProgressDisplay::new("measuring", arguments.quiet);
    let watch = Watch {
        progress: &|now: Progress| display.update(Standing::parts(now.finished, now.total)),
        cancel: interrupt.flag(),
    };
    let outcome = scene::run(&subject, &settings, reference, checkpoint, &watch);
    display.finish();
    let Some(outcome) = outcome? else {
        return Ok(arguments.interrupted(&interrupt));
    };
    let mut facts = facts::of_this_run();
    facts.push(("scene".to_owned(), path.display().to_string()));
    files.write(&scene::report(&outcome, &settings, facts), PART)?;
    Ok(Exit::Done)
}

impl Arguments {
    fn settings(&self) -> Settings {
        let samples: Vec<u32> = (0..=20).map(|i| 1 << i).filter(|n| *n <= self.spp_max).collect();
        Settings {
            seed: self.seed,
            samples,
            pairs: self.replications / 2,
            reference_samples: self.reference_spp.unwrap_or(32 * self.spp_max),
            threads: self.threads.map_or(0, usize::from),
        }
    }

    /// The scene at the size that was asked for, that of the reference, or a small one.
    fn load_options(&self, reference: Option<&Image>) -> Result<LoadOptions, Failure> {
        let options = self.scene.load_options();
        let film_size = match (self.size, reference) {
            (Some(size), _) => size,
            (None, Some(image)) => image.size(),
            (None, None) => {
                let film = load_scene(&self.scene.scene, &options)?.scene.film.size;
                let longest = u64::from(film[0].max(film[1]).max(USUAL_SIDE));
                film.map(|side| (u64::from(side) * u64::from(USUAL_SIDE) / longest).max(1) as u32)
            }
        };
        Ok(LoadOptions { film_size: Some(film_size), ..options })
    }

    /// Of the content of every file of the scene and what the command line says about it.
    fn scene_hash(&self, loaded: &LoadedScene) -> Result<u64, Failure> {
        let mut hash = bytes_hash(0, format!("{:?}", self.scene.load_options()).as_bytes());
        for path in &loaded.files {
            let bytes = fs::read(path).map_err(|error| {
                Failure::new(Exit::InputOutput, format!("{}: {error}", path.display()))
            })?;
            hash = bytes_hash(hash, &bytes);
        }
        Ok(hash)
    }

    fn interrupted(&self, interrupt: &Interrupt) -> Exit {
        match &self.checkpoint {
            Some(folder) => eprintln!(
                "etendue: interrupted; the same command goes on from what {} holds",
                folder.display()
            ),
            None => {
                eprintln!("etendue: interrupted; with --checkpoint FOLDER nothing would be lost");
            }
        }
        interrupt.exit().unwrap_or(Exit::Interrupted)
    }
}

impl From<ExperimentError> for Failure {
    fn from(error: ExperimentError) -> Self {
        let exit = match error {
            ExperimentError::Threads(_) => Exit::Resource,
            ExperimentError::Size(_) => Exit::Usage,
            ExperimentError::Checkpoint(_) => Exit::InputOutput,
        };
        Self::new(exit, error.to_string())
    }
}

fn bytes_hash(hash: u64, bytes: &[u8]) -> u64 {
    let length = mix_u64(hash, bytes.len() as u64);
    bytes.chunks(8).fold(length, |hash, chunk| {
        let mut word = [0; 8];
        word[..chunk.len()].copy_from_slice(chunk);
        mix_u64(hash, u64::from_le_bytes(word))
    })
}

fn picture_hash(image: &Image) -> u64 {
    let values = image.pixels().iter().flat_map(|pixel| [pixel.r, pixel.g, pixel.b]);
    values.fold(0, |hash, value| mix_u64(hash, u64::from(value.to_bits())))
}

fn replications(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(n) if (4..=1 << 16).contains(&n) && n % 2 == 0 => Ok(n),
        _ => Err("expected an even number from 4 on".to_owned()),
    }
}
