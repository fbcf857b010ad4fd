//! `etendue render`: from a scene to a picture.

mod defects;
mod draw;
mod replay;
mod report;
mod settings;
mod storage;
mod task;

use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::Parser;
use etendue_renderer::{SampleAddress, progressive};
use etendue_scene::film::Crop;
use etendue_scene::{LoadOptions, LoadedScene, SamplerKind};

use super::encoding_arguments::EncodingArguments;
use super::scene_arguments::{SceneArguments, load};
use super::selection::SelectionArguments;
use super::values::{crop, duration, max_depth, relative_error, size};
use crate::checkpoint::{Header, Recipe, Shard, State, Stored, Target, folder};
use crate::failure::{Exit, Failure};
use crate::interrupt::Interrupt;
use crate::output::{Aov, Output, of_bad_samples, of_part};
use crate::progress::Quiet;
use defects::Defects;
use draw::draw;
use report::Report;
use storage::Storage;
use task::{Method, Task};

/// Renders a scene to a picture.
#[derive(Debug, clap::Args)]
#[allow(clippy::struct_excessive_bools, reason = "flags of a command line")]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    selection: SelectionArguments,
    /// The picture to write; its extension chooses the format: exr, hdr, pfm (linear), png (sRGB).
    #[arg(short, long, value_name = "FILE", required_unless_present = "replay")]
    output: Option<PathBuf>,
    /// Samples per pixel; with --error, --time or --allocation their mean over the picture, at most.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    spp: Option<u32>,
    /// Render until the relative error of the picture is below this with 95 % confidence: 1% or 0.01.
    #[arg(long, value_name = "ERROR", value_parser = relative_error)]
    error: Option<f64>,
    /// Render for this long: 500ms, 30s, 2min, 1h. Every pixel gets two samples in any case.
    #[arg(long, value_name = "TIME", value_parser = duration)]
    time: Option<Duration>,
    /// Where samples go; adaptive with --error or --time, uniform otherwise.
    #[arg(long, value_name = "NAME")]
    allocation: Option<Allocation>,
    /// Let the paths of neighbouring pixels share what they find, and put samples where a pilot finds the error: most of the error
    /// of indirect diffuse light is gone, neighbours have what is left in common, and there is no estimate of it. With Sobol'
    /// points unless --sampler says otherwise.
    #[arg(long, conflicts_with_all = ["error", "time", "allocation"])]
    reuse: bool,
    /// Keep what has been drawn in this file, now and then (every 60s if not said otherwise) and at the end. The same command goes on with
    /// it, and so does `etendue resume FILE`, to the same picture bit by bit.
    #[arg(long, value_name = "FILE[:INTERVAL]", value_parser = Target::parse)]
    checkpoint: Option<Target>,
    /// Draw only the I-th of N equal parts of the samples, into an EXR picture for `etendue merge`. A part that is there is not drawn
    /// again, an unfinished one is finished.
    #[arg(long, value_name = "I/N", value_parser = Shard::parse, conflicts_with_all = ["reuse", "error", "time", "allocation", "aov"])]
    shard: Option<Shard>,
    /// Render nothing, but compute one sample of the same render again, and print its path ray by ray: column, row, number of the sample,
    /// as the warning about samples that are not finite names them.
    #[arg(long, value_name = "X,Y,S", value_parser = replay::address, conflicts_with_all = ["output", "reuse", "checkpoint", "shard"])]
    replay: Option<SampleAddress>,
    /// Further layers of an EXR picture, separated by commas.
    #[arg(long, value_name = "LAYERS", value_delimiter = ',')]
    aov: Vec<Aov>,
    /// Size of the whole film in pixels.
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Render only this part of the film: left, top, width, height.
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop)]
    crop: Option<Crop>,
    /// Threads; all cores if not given. The picture does not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    threads: Option<u16>,
    /// Seed of the random numbers.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// Longest path in edges, as Mitsuba counts them: 1 is emitters only, 2 direct light; -1 no limit.
    #[arg(long, value_name = "N", value_parser = max_depth, allow_hyphen_values = true)]
    max_depth: Option<i64>,
    /// Carry wavelengths instead of red, green and blue, which dispersion calls for, also where there is none.
    #[arg(long)]
    spectral: bool,
    /// Sample points.
    #[arg(long, value_name = "NAME")]
    sampler: Option<Sampler>,
    #[command(flatten)]
    encoding: EncodingArguments,
    #[command(flatten)]
    quiet: Quiet,
    /// Print one line of statistics as JSON.
    #[arg(long)]
    json: bool,
    /// Exit with 6 if any sample was NaN, infinite or negative.
    #[arg(long)]
    strict: bool,
}

/// Sample points by name.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Sampler {
    /// Independent random numbers.
    Independent,
    /// Owen-scrambled Sobol' points.
    Sobol,
}

/// Where samples go, by name.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Allocation {
    /// Where the error is.
    Adaptive,
    /// To all pixels alike.
    Uniform,
}

impl From<Allocation> for progressive::Allocation {
    fn from(allocation: Allocation) -> Self {
        match allocation {
            Allocation::Adaptive => Self::Adaptive,
            Allocation::Uniform => Self::Uniform,
        }
    }
}

impl Arguments {
    /// The scene, with what the command line asks of all of it.
    fn load(&self) -> Result<LoadedScene, Failure> {
        let mut loaded = load(&self.scene.scene, &self.load_options())?;
        loaded.scene.path.spectral |= self.spectral;
        Ok(loaded)
    }

    fn load_options(&self) -> LoadOptions {
        LoadOptions {
            film_size: self.size,
            crop: self.crop,
            samples_per_pixel: self.spp,
            max_depth: self.max_depth,
            sampler: self.sampler.or(self.reuse.then_some(Sampler::Sobol)).map(|sampler| {
                match sampler {
                    Sampler::Independent => SamplerKind::Independent,
                    Sampler::Sobol => SamplerKind::Sobol,
                }
            }),
            seed: self.seed,
            ..self.scene.load_options()
        }
    }
}

/// The command line of a stored render.
#[derive(Debug, clap::Parser)]
#[command(no_binary_name = true)]
struct StoredCommand {
    #[command(flatten)]
    arguments: Arguments,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    if let Some(address) = arguments.replay {
        let loaded = arguments.load()?;
        let scene = arguments.selection.select(loaded.scene);
        return replay::run(arguments, address, &scene, &loaded.origins);
    }
    let stored = arguments.checkpoint.is_some() || arguments.shard.is_some();
    render(arguments, &if stored { Recipe::of_process()? } else { Recipe::default() })
}

/// Goes on with a checkpoint.
///
/// * `recipe`: its own, with what is asked for now.
pub(crate) fn resume(
    checkpoint: &Path,
    recipe: &Recipe,
    quiet: Quiet,
    threads: Option<u16>,
) -> Result<Exit, Failure> {
    let parsed = StoredCommand::try_parse_from(&recipe.arguments).map_err(|error| {
        Failure::usage(format!(
            "{}: this version does not know the command line of the checkpoint: {error}",
            checkpoint.display()
        ))
    })?;
    let mut arguments = parsed.arguments;
    let changes = &recipe.changes;
    arguments.scene.scene = recipe.resolve(&arguments.scene.scene);
    let output = changes.output.as_ref().or(arguments.output.as_ref());
    arguments.output = output.map(|output| recipe.resolve(output));
    arguments.spp = changes.spp.or(arguments.spp);
    arguments.error = changes.error.or(arguments.error);
    arguments.time = changes.time.or(arguments.time);
    arguments.threads = threads.or(arguments.threads);
    arguments.quiet.quiet |= quiet.quiet;
    if let Some(target) = &mut arguments.checkpoint {
        target.path = checkpoint.to_path_buf();
    }
    render(&arguments, recipe)
}

fn render(arguments: &Arguments, recipe: &Recipe) -> Result<Exit, Failure> {
    let output =
        arguments.output.as_deref().ok_or_else(|| Failure::usage("-o names no picture"))?;
    let output = Output::check(output)?;
    if !arguments.aov.is_empty() {
        output.check_layers()?;
    }
    if arguments.shard.is_some() {
        output.check_part()?;
    }
    let interrupt = Interrupt::install()?;
    let start = Instant::now();
    let loaded = arguments.load()?;
    let mut layers = arguments.aov.clone();
    if arguments.shard.is_some() {
        // Those of a part would be those of the whole picture, which only a whole render has.
        if !loaded.layers.is_empty() {
            eprintln!(
                "etendue: warning: parts of renders do not have the layers that the scene asks for"
            );
        }
    } else if output.has_layers() {
        layers.extend(loaded.layers.into_iter().map(Aov::from));
    } else if !loaded.layers.is_empty() {
        eprintln!("etendue: warning: only EXR pictures have the layers that the scene asks for");
    }
    layers.sort_unstable();
    layers.dedup();
    let scene = arguments.selection.select(loaded.scene);
    let build_seconds = start.elapsed().as_secs_f64();
    for diagnosis in scene.diagnose() {
        eprintln!("etendue: warning: {diagnosis}");
    }

    let task = Task::new(arguments, layers, &scene)?;
    let storage = Storage::open(arguments, recipe, &scene, &loaded.files, &task, &output)?;
    if storage.as_ref().is_some_and(|storage| storage.is_there) {
        if !arguments.quiet.quiet {
            eprintln!("etendue: {} is there and whole", output.path().display());
        }
        return Ok(Exit::Done);
    }
    let header = storage.as_ref().map(|storage| storage.header.clone());
    let start = Instant::now();
    let mut drawing = draw(&task, &scene, &interrupt, storage)?;
    // Samples and rays are those of all processes that have worked on the picture, and so is the time.
    let seconds_before = header.as_ref().map_or(0.0, |header| header.seconds);
    let render_seconds = seconds_before + start.elapsed().as_secs_f64();
    let (trouble, panic) = (drawing.trouble.take(), drawing.panic.take());
    let part = drawing.sums.take().filter(|_| arguments.shard.is_some());
    if let Some(sums) = &part {
        drawing.layers = of_part(sums);
    }
    drawing.layers.extend(of_bad_samples(&drawing.statistics, &scene.film.crop));
    let defects =
        Defects::of(&drawing.statistics, &scene, &loaded.origins, task.method == Method::Reuse);
    let report = Report { render_seconds, build_seconds, drawing: &drawing, defects: &defects };
    report.warn_of_bad_samples(scene.sampling.seed);
    report.warn_of_overflow();

    let encoding = arguments.encoding.encoding();
    let mut metadata = report.metadata(arguments, &scene);
    if let Some((header, sums)) = header.zip(part) {
        let configuration = metadata.configuration.clone();
        let header = Header { configuration, ..header };
        let stored = Stored::new(&header, metadata.seconds, State::Plain(sums));
        let bytes = stored.to_bytes().map_err(|error| Failure::new(Exit::Internal, error))?;
        metadata.part = Some(bytes);
    }
    let elsewhere = arguments.checkpoint.as_ref().map(|target| folder(&target.path));
    output.write_or_rescue(&drawing.image, &drawing.layers, encoding, &metadata, elsewhere)?;
    if !arguments.quiet.quiet {
        eprintln!("etendue: {}", report.summary(&output));
    }
    if arguments.json {
        println!("{}", report.json());
    }
    if let Some(panic) = panic {
        eprintln!("etendue: the work so far is in {}", output.path().display());
        resume_unwind(panic);
    }
    if let Some(failure) = trouble {
        return Err(failure);
    }
    Ok(match interrupt.exit() {
        Some(exit) => exit,
        None if arguments.strict && report.is_unhealthy() => Exit::Unhealthy,
        None => Exit::Done,
    })
}
