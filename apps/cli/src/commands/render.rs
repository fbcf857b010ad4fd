//! `etendue render`: from a scene to a picture.

use std::path::PathBuf;
use std::time::Instant;

use etendue_renderer::{RenderSettings, Renderer, Rendering};
use etendue_scene::film::Crop;
use etendue_scene::{LoadOptions, LoadedScene, SamplerKind, Scene};
use serde_json::json;

use super::scene_arguments::{SceneArguments, load};
use crate::failure::{Exit, Failure};
use crate::interrupt::Interrupt;
use crate::memory::peak_resident_bytes;
use crate::output::{Encoding, Metadata, Output, Precision};
use crate::progress::{ProgressDisplay, Quiet};

/// Renders a scene to a picture.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// The picture to write; its extension chooses the format: exr, hdr, pfm (linear), png (sRGB).
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Samples per pixel.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    spp: Option<u32>,
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
    /// Sample points.
    #[arg(long, value_name = "NAME")]
    sampler: Option<Sampler>,
    /// Brighten 8-bit pictures by this many stops.
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, value_parser = exposure, allow_hyphen_values = true)]
    exposure: f32,
    /// Sample type of EXR pictures.
    #[arg(long, value_name = "TYPE", default_value = "float")]
    precision: Precision,
    /// Print no progress and no summary.
    #[arg(long, short)]
    quiet: bool,
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

impl Arguments {
    fn load_options(&self) -> LoadOptions {
        LoadOptions {
            film_size: self.size,
            crop: self.crop,
            samples_per_pixel: self.spp,
            max_depth: self.max_depth,
            sampler: self.sampler.map(|sampler| match sampler {
                Sampler::Independent => SamplerKind::Independent,
                Sampler::Sobol => SamplerKind::Sobol,
            }),
            seed: self.seed,
            ..self.scene.load_options()
        }
    }

    fn quiet(&self) -> Quiet {
        if self.quiet { Quiet::Yes } else { Quiet::No }
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let output = Output::check(&arguments.output)?;
    let interrupt = Interrupt::install()
        .map_err(|e| Failure::new(Exit::Internal, format!("cannot handle signals: {e}")))?;
    let start = Instant::now();
    let loaded = load(&arguments.scene.scene, &arguments.load_options())?;
    let build_seconds = start.elapsed().as_secs_f64();
    for diagnosis in loaded.scene.diagnose() {
        eprintln!("etendue: warning: {diagnosis}");
    }

    let start = Instant::now();
    let rendering = draw(arguments, &loaded.scene, &interrupt)?;
    let report = Report {
        render_seconds: start.elapsed().as_secs_f64(),
        build_seconds,
        rendering: &rendering,
    };
    report.warn_of_bad_samples(loaded.scene.sampling.seed);

    let encoding = Encoding { precision: arguments.precision, exposure: arguments.exposure };
    output.write(&rendering.image, encoding, &report.metadata(arguments, &loaded))?;
    if !arguments.quiet {
        eprintln!("etendue: {}", report.summary(&output));
    }
    if arguments.json {
        println!("{}", report.json());
    }
    Ok(match interrupt.exit() {
        Some(exit) => exit,
        None if arguments.strict && report.non_finite() > 0 => Exit::Unhealthy,
        None => Exit::Done,
    })
}

fn draw(arguments: &Arguments, scene: &Scene, interrupt: &Interrupt) -> Result<Rendering, Failure> {
    let settings = RenderSettings {
        threads: arguments.threads.map_or(0, usize::from),
        ..RenderSettings::of_scene(scene)
    };
    let renderer =
        Renderer::new(scene, settings).map_err(|e| Failure::new(Exit::Resource, e.to_string()))?;
    let progress = ProgressDisplay::new(arguments.quiet());
    let rendering = renderer.render(&|now| progress.update(now), interrupt.flag());
    progress.finish();
    Ok(rendering)
}

/// What a finished render says about itself.
struct Report<'a> {
    render_seconds: f64,
    build_seconds: f64,
    rendering: &'a Rendering,
}

impl Report<'_> {
    fn non_finite(&self) -> u64 {
        self.rendering.statistics.non_finite.count()
    }

    fn complete(&self) -> bool {
        let progress = self.rendering.progress;
        progress.finished == progress.total
    }

    fn mrays_per_second(&self) -> f64 {
        self.rendering.statistics.rays.total() as f64 / self.render_seconds.max(1e-9) / 1e6
    }

    fn metadata(&self, arguments: &Arguments, loaded: &LoadedScene) -> Metadata {
        Metadata {
            scene: arguments.scene.scene.display().to_string(),
            samples_per_pixel: loaded.scene.sampling.samples_per_pixel,
            seed: loaded.scene.sampling.seed,
            seconds: self.render_seconds,
            non_finite: self.non_finite(),
        }
    }

    fn warn_of_bad_samples(&self, seed: u64) {
        if self.non_finite() == 0 {
            return;
        }
        eprintln!(
            "etendue: warning: {} samples were NaN or infinite and were left out; the first of them \
             with seed {seed}:",
            self.non_finite()
        );
        for address in self.rendering.statistics.non_finite.first() {
            eprintln!(
                "etendue:   column {}, row {}, sample {}",
                address.column, address.row, address.sample
            );
        }
    }

    fn summary(&self, output: &Output) -> String {
        let statistics = &self.rendering.statistics;
        let memory = peak_resident_bytes()
            .map_or(String::new(), |bytes| format!(", {} MiB at most", bytes >> 20));
        let cut = if self.complete() { "" } else { " (interrupted: parts are black)" };
        format!(
            "{} in {:.2} s ({:.2} s to load and build), {} samples, {} rays, {:.1} Mrays/s{memory}{cut}",
            output.path().display(),
            self.render_seconds,
            self.build_seconds,
            statistics.samples,
            statistics.rays.total(),
            self.mrays_per_second(),
        )
    }

    fn json(&self) -> serde_json::Value {
        let statistics = &self.rendering.statistics;
        json!({
            "render_seconds": self.render_seconds,
            "build_seconds": self.build_seconds,
            "samples": statistics.samples,
            "rays": statistics.rays.total(),
            "mrays_per_second": self.mrays_per_second(),
            "peak_rss": peak_resident_bytes(),
            "non_finite": self.non_finite(),
            "complete": self.complete(),
        })
    }
}

fn numbers<const N: usize>(text: &str, separator: char) -> Option<[u32; N]> {
    let parsed: Vec<u32> =
        text.split(separator).map(|t| t.trim().parse().ok()).collect::<Option<_>>()?;
    parsed.try_into().ok()
}

/// Reads a width and a height.
pub(crate) fn size(text: &str) -> Result<[u32; 2], String> {
    match numbers(text, 'x') {
        Some(size) if !size.contains(&0) => Ok(size),
        _ => Err("expected WIDTHxHEIGHT, as in 640x480, both at least 1".to_owned()),
    }
}

fn crop(text: &str) -> Result<Crop, String> {
    let [x, y, w, h] =
        numbers(text, ',').ok_or("expected four numbers: left, top, width, height")?;
    Ok(Crop { offset: [x, y], size: [w, h] })
}

fn max_depth(text: &str) -> Result<i64, String> {
    match text.parse() {
        Ok(depth) if (-1..=i64::from(u32::MAX)).contains(&depth) => Ok(depth),
        _ => Err("expected a number of edges, or -1 for no limit".to_owned()),
    }
}

fn exposure(text: &str) -> Result<f32, String> {
    match text.parse::<f32>() {
        Ok(stops) if stops.abs() <= 64.0 => Ok(stops),
        _ => Err("expected a number of stops between -64 and 64".to_owned()),
    }
}
