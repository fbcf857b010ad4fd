//! Drawing the picture and its layers.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use etendue_renderer::progressive::{Advance, Goal, Halt, ImageError, ProgressiveState, Round};
use etendue_renderer::{
    Accumulation, Configuration, Image, Progress, RenderSettings, Renderer, Rendering, ReuseState,
    Statistics,
};
use etendue_scene::Scene;

use super::storage::Storage;
use super::task::{Method, Task};
use crate::checkpoint::{Header, Keeper, State};
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
    /// Of a plain render that is stored.
    pub(super) sums: Option<Accumulation>,
    /// That the last checkpoint could not be written.
    pub(super) trouble: Option<Failure>,
    /// How a thread that rendered has failed; the picture is what it left.
    pub(super) panic: Option<Box<dyn Any + Send>>,
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
///
/// * `storage`: of a render that is stored, what there is of it.
pub(super) fn draw(
    task: &Task,
    scene: &Scene,
    interrupt: &Interrupt,
    storage: Option<Storage>,
) -> Result<Drawing, Failure> {
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
    let (state, kept) = match storage {
        Some(Storage { keeper, header, state, .. }) => {
            let configuration = renderer.configuration().name().to_owned();
            let header = Header { configuration, ..header };
            (Some(state), Kept { keeper, header })
        }
        None => (None, Kept::default()),
    };
    let (mut drawing, variance, samples) = match (task.method, state) {
        (Method::Progressive { goal, time }, state) => {
            let state = match state {
                Some(State::Progressive(state)) => state,
                _ => ProgressiveState::new(scene.film.crop, goal.allocation),
            };
            // What a render that goes on has used of its time is used.
            let used = kept.header.rendered_for();
            let time = time.map(|time| time.saturating_sub(used));
            let limits = Limits { goal, time, start };
            progressive(&renderer, state, &limits, kept, interrupt, &progress)
        }
        (_, Some(State::Plain(sums))) => {
            let drawing = accumulated(&renderer, sums, kept, interrupt, &progress);
            (drawing, Image::black([0, 0]), Vec::new())
        }
        (Method::Reuse, state) => {
            let state = match state {
                Some(State::Reuse(state)) => state,
                _ => ReuseState::new(scene.film.crop),
            };
            let drawing = reused(&renderer, state, kept, interrupt, &progress);
            (drawing, Image::black([0, 0]), Vec::new())
        }
        (Method::Plain, _) => {
            let drawing = plain(&renderer, interrupt, &progress);
            (drawing, Image::black([0, 0]), Vec::new())
        }
    };
    progress.finish();
    // The renderer's threads are still there.
    drawing.processor_seconds = before.zip(processor_seconds()).map(|(before, now)| now - before);
    let sources = Sources { features: &features, variance: &variance, samples: &samples };
    drawing.layers = task.layers.iter().flat_map(|&aov| sources.channels(aov)).collect();
    Ok(drawing)
}

/// Where a render is kept, if anywhere.
#[derive(Default)]
struct Kept {
    keeper: Option<Keeper>,
    header: Header,
}

impl Kept {
    /// Does a piece of work, with checkpoints if there is a keeper of them. How the work panicked, and whether the last checkpoint could be
    /// written.
    fn work(
        self,
        snapshot: &(dyn Fn() -> State + Sync),
        work: impl FnOnce(),
    ) -> (thread::Result<()>, Result<(), Failure>) {
        match self.keeper {
            Some(mut keeper) => keeper.keep(&self.header, snapshot, work),
            None => (catch_unwind(AssertUnwindSafe(work)), Ok(())),
        }
    }
}

/// A copy of what threads share. A poisoned lock means that one has panicked between two changes.
fn copy<T: Clone>(shared: &Mutex<T>) -> T {
    shared.lock().unwrap_or_else(PoisonError::into_inner).clone()
}

/// A picture without an estimate of its error.
fn plain(renderer: &Renderer<'_>, interrupt: &Interrupt, progress: &ProgressDisplay) -> Drawing {
    let rendering = Mutex::new(renderer.nothing_rendered());
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        renderer.render_onto(&rendering, &|now| progress.update(of_tiles(now)), interrupt.flag());
    }));
    let rendering = rendering.into_inner().unwrap_or_else(PoisonError::into_inner);
    let whole = if is_finished(rendering.progress) { Whole::Yes } else { Whole::BlackInParts };
    of_rendering(rendering, renderer, whole, (outcome, Ok(())))
}

/// A picture of paths that share what they find, that goes on from what there is.
fn reused(
    renderer: &Renderer<'_>,
    state: ReuseState,
    kept: Kept,
    interrupt: &Interrupt,
    progress: &ProgressDisplay,
) -> Drawing {
    let work = Mutex::new(state);
    let outcome = kept.work(&|| State::Reuse(copy(&work)), || {
        let report = |now| progress.update(of_tiles(now));
        renderer.continue_with_reuse(&work, &report, interrupt.flag());
    });
    let rendering = copy(&work).rendering();
    let Progress { finished, total } = rendering.progress;
    let whole = if is_finished(rendering.progress) {
        Whole::Yes
    } else if 2 * finished >= total {
        // The pilot has been everywhere.
        Whole::WithFewerSamples
    } else {
        Whole::BlackInParts
    };
    of_rendering(rendering, renderer, whole, outcome)
}

fn of_tiles(Progress { finished, total }: Progress) -> Standing {
    Standing::parts(finished, total)
}

fn is_finished(Progress { finished, total }: Progress) -> bool {
    finished == total
}

/// * `outcome`: of the work, and of its last checkpoint.
fn of_rendering(
    rendering: Rendering,
    renderer: &Renderer<'_>,
    whole: Whole,
    (outcome, saved): (thread::Result<()>, Result<(), Failure>),
) -> Drawing {
    Drawing {
        image: rendering.image,
        layers: Vec::new(),
        statistics: rendering.statistics,
        configuration: renderer.configuration(),
        whole,
        processor_seconds: None,
        accuracy: None,
        sums: None,
        trouble: saved.err(),
        panic: outcome.err(),
    }
}

/// A picture without an estimate of its error that goes on from what there is and is stored.
fn accumulated(
    renderer: &Renderer<'_>,
    sums: Accumulation,
    kept: Kept,
    interrupt: &Interrupt,
    progress: &ProgressDisplay,
) -> Drawing {
    let work = Mutex::new(sums);
    let report = |fraction| progress.update(Standing { fraction, error: None });
    let (outcome, saved) = kept.work(&|| State::Plain(copy(&work)), || {
        renderer.accumulate(&work, &report, interrupt.flag());
    });
    let sums = copy(&work);
    let whole = if sums.is_whole() {
        Whole::Yes
    } else if sums.least() > 0 {
        Whole::WithFewerSamples
    } else {
        Whole::BlackInParts
    };
    Drawing {
        image: sums.image(),
        layers: Vec::new(),
        statistics: sums.statistics(),
        configuration: renderer.configuration(),
        whole,
        processor_seconds: None,
        accuracy: None,
        sums: Some(sums),
        trouble: saved.err(),
        panic: outcome.err(),
    }
}

/// The picture, its variance and its samples.
fn progressive(
    renderer: &Renderer<'_>,
    state: ProgressiveState,
    limits: &Limits,
    kept: Kept,
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
    let work = Mutex::new(state);
    let (outcome, saved) = kept.work(&|| State::Progressive(copy(&work)), || {
        renderer.continue_progressively(&work, &limits.goal, &report, &halt);
    });
    let rendering = copy(&work).rendering();
    let whole = match rendering.error {
        None => Whole::BlackInParts,
        Some(_) if interrupt.requested() || outcome.is_err() => Whole::WithFewerSamples,
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
        sums: None,
        trouble: saved.err(),
        panic: outcome.err(),
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
