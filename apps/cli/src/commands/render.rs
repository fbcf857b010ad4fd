//! `etendue render`: from a scene to a picture.

mod draw;
mod report;
mod task;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use etendue_renderer::progressive;
use etendue_scene::film::Crop;
use etendue_scene::{LoadOptions, SamplerKind};

use super::scene_arguments::{SceneArguments, load};
use super::selection::SelectionArguments;
use super::values::{crop, duration, exposure, max_depth, relative_error, size};
use crate::failure::{Exit, Failure};
use crate::interrupt::Interrupt;
use crate::output::{Aov, Encoding, Output, Precision};
use crate::progress::Quiet;
use draw::draw;
use report::Report;
use task::Task;

/// Renders a scene to a picture.
#[derive(Debug, clap::Args)]
#[allow(clippy::struct_excessive_bools, reason = "flags of a command line")]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    #[command(flatten)]
    selection: SelectionArguments,
    /// The picture to write; its extension chooses the format: exr, hdr, pfm (linear), png (sRGB).
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
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
    /// Brighten 8-bit pictures by this many stops.
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, value_parser = exposure, allow_hyphen_values = true)]
    exposure: f32,
    /// Sample type of EXR pictures.
    #[arg(long, value_name = "TYPE", default_value = "float")]
    precision: Precision,
    #[command(flatten)]
    quiet: Quiet,
    /// Print one line of statistics as JSON.
    #[arg(long)]
    json: bool,
    /// Exit with 6 if any sample was NaN or infinite.
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

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let output = Output::check(&arguments.output)?;
    if !arguments.aov.is_empty() {
        output.check_layers()?;
    }
    let interrupt = Interrupt::install()?;
    let start = Instant::now();
    let mut loaded = load(&arguments.scene.scene, &arguments.load_options())?;
    loaded.scene.path.spectral |= arguments.spectral;
    let mut layers = arguments.aov.clone();
    if output.has_layers() {
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
    let start = Instant::now();
    let drawing = draw(&task, &scene, &interrupt)?;
    let render_seconds = start.elapsed().as_secs_f64();
    let report = Report { render_seconds, build_seconds, drawing: &drawing };
    report.warn_of_bad_samples(scene.sampling.seed);
    report.warn_of_overflow();

    let encoding = Encoding { precision: arguments.precision, exposure: arguments.exposure };
    let metadata = report.metadata(arguments, &scene);
    output.write(&drawing.image, &drawing.layers, encoding, &metadata)?;
    if !arguments.quiet.quiet {
        eprintln!("etendue: {}", report.summary(&output));
    }
    if arguments.json {
        println!("{}", report.json());
    }
    Ok(match interrupt.exit() {
        Some(exit) => exit,
        None if arguments.strict && (report.non_finite() > 0 || report.overflowed() > 0) => {
            Exit::Unhealthy
        }
        None => Exit::Done,
    })
}
