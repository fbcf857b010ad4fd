//! The price list of a scene: what each of its effects costs, and what leaving it out does to the picture.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::time::Instant;

use etendue_renderer::image_metrics::{SizeMismatch, compare, difference_picture, flip};
use etendue_renderer::{Image, RenderSettings, Renderer, RendererError};
use etendue_report::{Cell, Table};
use etendue_scene::{Effect, Scene};
use serde_json::json;

use super::Arguments;
use crate::failure::{Exit, Failure};
use crate::interrupt::Interrupt;
use crate::output::{Encoding, Metadata, Output, Precision};
use crate::progress::{ProgressDisplay, Standing};

/// Measures every effect and prints the table.
pub(super) fn run(
    arguments: &Arguments,
    scene: &Scene,
    effects: &BTreeSet<Effect>,
) -> Result<Exit, Failure> {
    let pictures = pictures(arguments.pictures.as_deref(), effects)?;
    let interrupt = Interrupt::install()?;
    let display = ProgressDisplay::new("measuring", arguments.quiet);
    let mut table = Table::new([
        ("effect", "effect"),
        ("seconds_without", "time without it (s)"),
        ("time_percent", "time it adds (%)"),
        ("mean_difference_percent", "mean without it (%)"),
        ("flip", "ꟻLIP without it"),
    ]);
    let rounds = arguments.rounds as usize;
    let (whole, pairs) = (prepare(scene)?, effects.len() + 1);
    let report = |pair: usize, done: usize| {
        display.update(Standing::parts(2 * rounds * pair + done, 2 * rounds * pairs));
    };
    let measure = |i: usize, with: &Renderer<'_>, without: &Renderer<'_>| {
        Pair::measure([with, without], rounds, &interrupt, &|done| report(i, done))
    };
    let interrupted = || {
        display.finish();
        Ok(interrupt.exit().unwrap_or(Exit::Interrupted))
    };
    let configuration = whole.configuration().name();
    let everything = prepare(scene)?.with_everything();
    let Some(unused) = measure(0, &everything, &whole) else { return interrupted() };
    for (i, &effect) in effects.iter().enumerate() {
        let without = scene.clone().without(&BTreeSet::from([effect]));
        let Some(pair) = measure(i + 1, &whole, &prepare(&without)?) else { return interrupted() };
        table.push(pair.row(effect)?);
        if let Some(output) = pictures.get(i) {
            let [whole, without] = &pair.images;
            let encoding = Encoding { precision: Precision::Float, exposure: 0.0 };
            let picture = difference_picture(without, whole).map_err(different_sizes)?;
            output.write(&picture, &[], encoding, &Metadata::default())?;
        }
    }
    display.finish();
    if arguments.json {
        let document = json!({
            "configuration": configuration,
            "unused_percent": unused.percent(),
            "effects": table.json(),
        });
        println!("{document}");
    } else {
        println!(
            "configuration {configuration}; with everything compiled in: {:+.1} % of time",
            unused.percent()
        );
        print!("{}", table.markdown());
    }
    Ok(Exit::Done)
}

/// The files of the difference pictures, one for each effect, if there is a folder for them.
fn pictures(folder: Option<&Path>, effects: &BTreeSet<Effect>) -> Result<Vec<Output>, Failure> {
    let Some(folder) = folder else { return Ok(Vec::new()) };
    fs::create_dir_all(folder).map_err(|error| Failure::write(folder, error))?;
    let file = |effect: &Effect| Output::check(&folder.join(format!("{}.png", effect.name())));
    effects.iter().map(file).collect()
}

/// A scene as it is, and without an effect.
struct Pair {
    images: [Image; 2],
    /// Seconds without the effect, in the shortest round.
    seconds: f64,
    /// Median of time with the effect over time without.
    ratio: f64,
}

impl Pair {
    /// Renders both in turn, `rounds` times, telling `report` how many pictures are done; `None` if a signal came.
    fn measure(
        [whole, without]: [&Renderer<'_>; 2],
        rounds: usize,
        interrupt: &Interrupt,
        report: &dyn Fn(usize),
    ) -> Option<Self> {
        let (mut images, mut ratios, mut least) = (None, Vec::new(), f64::INFINITY);
        for round in 0..rounds {
            report(2 * round);
            let (image, seconds) = timed(whole, interrupt);
            report(2 * round + 1);
            let (image_without, seconds_without) = timed(without, interrupt);
            if interrupt.requested() {
                return None;
            }
            images = Some([image, image_without]);
            ratios.push(seconds / seconds_without);
            least = least.min(seconds_without);
        }
        ratios.sort_by(f64::total_cmp);
        let ratio = ratios[ratios.len() / 2];
        images.map(|images| Self { images, seconds: least, ratio })
    }

    /// Time that the effect adds.
    fn percent(&self) -> f64 {
        100.0 * (self.ratio - 1.0)
    }

    fn row(&self, effect: Effect) -> Result<[Cell; 5], Failure> {
        let [whole, without] = &self.images;
        let comparison = compare(without, whole).map_err(different_sizes)?;
        let flip = flip::mean(&flip::hdr(without, whole).map_err(different_sizes)?);
        Ok([
            Cell::text(effect.name()),
            Cell::number(self.seconds),
            Cell::number(self.percent()),
            Cell::number(100.0 * comparison.mean_difference),
            Cell::number(flip),
        ])
    }
}

fn prepare(scene: &Scene) -> Result<Renderer<'_>, RendererError> {
    Renderer::new(scene, RenderSettings::of_scene(scene))
}

/// A picture and the seconds that it took.
fn timed(renderer: &Renderer<'_>, interrupt: &Interrupt) -> (Image, f64) {
    let start = Instant::now();
    let rendering = renderer.render(&|_| (), interrupt.flag());
    (rendering.image, start.elapsed().as_secs_f64())
}

fn different_sizes(error: SizeMismatch) -> Failure {
    Failure::new(Exit::Internal, error.to_string())
}
