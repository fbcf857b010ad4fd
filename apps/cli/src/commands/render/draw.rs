//! Drawing the picture and its layers.

use std::time::{Duration, Instant};

use etendue_renderer::progressive::{Advance, Goal, Halt, ImageError, Round};
use etendue_renderer::{Configuration, Image, RenderSettings, Renderer, Statistics};
use etendue_scene::Scene;

use super::task::{Method, Task};
use crate::clock::processor_seconds;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::output::{Aov, Channel, Sources};
use crate::progress::{ProgressDisplay, Standing};

/// A picture and what is known of it.
pub(super) struct Drawing {
    pub(super) image: Image,
    pub(super) layers: Vec<Channel>,
    pub(super) statistics: Statistics,
    pub(super) whole: Whole,
    pub(super) configuration: Configuration,
    /// Processor time of all threads while rendering, where the system tells.
    pub(super) processor_seconds: Option<f64>,
    /// Of a progressive render.
    pub(super) accuracy: Option<Accuracy>,
}

/// Whether all that was asked for is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Whole {
    Yes,
    /// Interrupted, but every pixel has samples.
    WithFewerSamples,
    /// Interrupted, and some pixels are black.
    BlackInParts,
}

/// How accurate a picture is.
pub(super) struct Accuracy {
    /// `None` where pixels lack samples.
    pub(super) error: Option<ImageError>,
    pub(super) rounds: Vec<Round>,
}

/// Draws the layers that show what is seen, and then the picture.
pub(super) fn draw(task: &Task, scene: &Scene, interrupt: &Interrupt) -> Result<Drawing, Failure> {
    let start = Instant::now();
    let settings = RenderSettings { threads: task.threads, ..RenderSettings::of_scene(scene) };
    let before = processor_seconds();
    let renderer = Renderer::new(scene, settings)?;
    let seen = |aov: &Aov| !aov.is_of_samples();
    let features = if task.layers.iter().any(seen) {
        renderer.features(task.feature_samples, interrupt.flag())
    } else {
        Vec::new()
    };
    let progress = ProgressDisplay::new("rendering", task.quiet);
    let (mut drawing, variance, samples) = match task.method {
        method @ (Method::Plain | Method::Reuse) => {
            let drawing = plain(&renderer, method, interrupt, &progress);
            (drawing, Image::black([0, 0]), Vec::new())
        }
        Method::Progressive { goal, time } => {
            let limits = Limits { goal, time, start };
            progressive(&renderer, &limits, interrupt, &progress)
        }
    };
    progress.finish();
    // The renderer's threads are still there.
    drawing.processor_seconds = before.zip(processor_seconds()).map(|(before, now)| now - before);
    let sources = Sources { features: &features, variance: &variance, samples: &samples };
    drawing.layers = task.layers.iter().flat_map(|&aov| sources.channels(aov)).collect();
    Ok(drawing)
}

/// A picture without an estimate of its error.
fn plain(
    renderer: &Renderer<'_>,
    method: Method,
    interrupt: &Interrupt,
    progress: &ProgressDisplay,
) -> Drawing {
    let report = |now: etendue_renderer::Progress| {
        progress.update(Standing::parts(now.finished, now.total));
    };
    let rendering = match method {
        Method::Reuse => renderer.render_with_reuse(&report, interrupt.flag()),
        _ => renderer.render(&report, interrupt.flag()),
    };
    let etendue_renderer::Progress { finished, total } = rendering.progress;
    let whole = if finished == total {
        Whole::Yes
    } else if method == Method::Reuse && renderer.reuses_paths() && 2 * finished >= total {
        // The pilot has been everywhere.
        Whole::WithFewerSamples
    } else {
        Whole::BlackInParts
    };
    Drawing {
        image: rendering.image,
        layers: Vec::new(),
        statistics: rendering.statistics,
        configuration: renderer.configuration(),
        whole,
        processor_seconds: None,
        accuracy: None,
    }
}

/// The picture, its variance and its samples.
fn progressive(
    renderer: &Renderer<'_>,
    limits: &Limits,
    interrupt: &Interrupt,
    progress: &ProgressDisplay,
) -> (Drawing, Image, Vec<u32>) {
    let halt = || {
        if interrupt.requested() {
            Halt::Now
        } else if limits.time.is_some_and(|time| limits.start.elapsed() >= time) {
            Halt::WhenWhole
        } else {
            Halt::No
        }
    };
    let report = |now| progress.update(limits.standing(now));
    let rendering = renderer.render_progressively(&limits.goal, &report, &halt);
    let whole = match rendering.error {
        None => Whole::BlackInParts,
        Some(_) if interrupt.requested() => Whole::WithFewerSamples,
        Some(_) => Whole::Yes,
    };
    let drawing = Drawing {
        image: rendering.image,
        layers: Vec::new(),
        statistics: rendering.statistics,
        configuration: renderer.configuration(),
        whole,
        processor_seconds: None,
        accuracy: Some(Accuracy { error: rendering.error, rounds: rendering.rounds }),
    };
    (drawing, rendering.variance, rendering.samples)
}

/// What ends a render, whichever comes first.
struct Limits {
    goal: Goal,
    time: Option<Duration>,
    start: Instant,
}

impl Limits {
    /// How far the render is towards its nearest end. Errors fall with the root of the samples or
    /// faster.
    fn standing(&self, now: Advance) -> Standing {
        let of_time = self.time.map(|time| self.start.elapsed().as_secs_f64() / time.as_secs_f64());
        let of_samples =
            self.goal.samples_per_pixel.map(|limit| now.samples_per_pixel / f64::from(limit));
        let of_error = self.goal.error.zip(now.error).map(|(bound, error)| {
            let ratio = bound / error.upper;
            ratio * ratio
        });
        let parts = [of_time, of_samples, of_error].into_iter().flatten();
        Standing { fraction: parts.fold(0.0, f64::max).min(1.0), error: now.error }
    }
}
