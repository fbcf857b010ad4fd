//! The rounds of a progressive render.

use core::marker::PhantomData;
use std::sync::{Mutex, PoisonError};

use etendue_sampling::Sampler;
use etendue_scene::geometry::{Rays, Task};

use super::allocation::{dither, levels, merits};
use super::canvas::{self, Canvas, CanvasTile};
use super::convergence::Round;
use super::goal::{Goal, Halt};
use super::half::Half;
use super::image_error::ImageError;
use super::schedule::{Schedule, Stage, UNIFORM};
use crate::configuration::Configured;
use crate::film::{Image, PixelSum};
use crate::path::Transport;
use crate::render::Renderer;
use crate::statistics::{SampleAddress, Statistics};
use crate::tile::Tile;

/// Where the samples of the second half begin: the next run of 2³² samples, for which samplers have
/// keys of their own.
const SECOND_HALF: u64 = 1 << 32;

/// How far a progressive render is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Advance {
    /// Samples per pixel so far, in the mean over the picture.
    pub samples_per_pixel: f64,
    /// The error after the last round; `None` before the first.
    pub error: Option<ImageError>,
}

/// A progressively rendered picture.
#[derive(Clone, Debug, PartialEq)]
pub struct ProgressiveRendering {
    /// The film's crop: the mean of the two halves. Pixels that a halted render did not reach are black.
    pub image: Image,
    /// An estimate of the variance of every pixel, `((a − b) / 2)²` of its halves; unbiased, and as
    /// noisy as a single difference squared.
    pub variance: Image,
    /// Number of samples of each pixel, row by row.
    pub samples: Vec<u32>,
    /// The error of the picture; `None` where some pixel has less than a sample in either half.
    pub error: Option<ImageError>,
    /// The rounds that were finished.
    pub rounds: Vec<Round>,
    /// What was done.
    pub statistics: Statistics,
}

impl Renderer<'_> {
    /// Renders the film's crop until a goal is reached.
    ///
    /// * `report` is called after every tile of every round, by the thread that finished it.
    /// * `halt` is asked at every pixel.
    ///
    /// Settings count as in [`render`](Renderer::render), except for the samples per pixel.
    pub fn render_progressively(
        &self,
        goal: &Goal,
        report: &(dyn Fn(Advance) + Sync),
        halt: &(dyn Fn() -> Halt + Sync),
    ) -> ProgressiveRendering {
        self.configured(RunRounds { rounds: Rounds::new(self, report, halt), goal })
    }
}

#[cfg(test)]
impl Renderer<'_> {
    /// The mistake that the two halves avoid: each half is allocated by what it has found itself.
    pub(crate) fn render_guided_by_own_samples(&self, goal: &Goal) -> ProgressiveRendering {
        let mut rounds = Rounds::new(self, &|_| (), &|| Halt::No);
        rounds.guides = [0, 1];
        self.configured(RunRounds { rounds, goal })
    }
}

/// The whole of a progressive render.
struct RunRounds<'r, 'a> {
    rounds: Rounds<'r, 'a>,
    goal: &'r Goal,
}

impl Configured for RunRounds<'_, '_> {
    type Output = ProgressiveRendering;

    fn run<S: Sampler, T: Transport>(self) -> ProgressiveRendering {
        self.rounds.run::<S, T>(self.goal)
    }
}

/// A progressive render under way.
struct Rounds<'r, 'a> {
    renderer: &'r Renderer<'a>,
    report: &'r (dyn Fn(Advance) + Sync),
    halt: &'r (dyn Fn() -> Halt + Sync),
    canvas: Canvas,
    dither: Vec<u8>,
    /// Level that each half of each pixel has or is being brought to.
    levels: [Vec<u8>; 2],
    /// For each half, the one by whose differences its samples are allocated.
    guides: [usize; 2],
    finished: Vec<Round>,
    statistics: Statistics,
}

impl<'r, 'a> Rounds<'r, 'a> {
    fn new(
        renderer: &'r Renderer<'a>,
        report: &'r (dyn Fn(Advance) + Sync),
        halt: &'r (dyn Fn() -> Halt + Sync),
    ) -> Self {
        let crop = renderer.scene.film.crop;
        let dither = dither(&crop);
        Self {
            renderer,
            report,
            halt,
            canvas: Canvas::new(crop),
            levels: [vec![0; dither.len()], vec![0; dither.len()]],
            guides: [1, 0],
            dither,
            finished: Vec::new(),
            statistics: Statistics::default(),
        }
    }

    fn run<S: Sampler, T: Transport>(mut self, goal: &Goal) -> ProgressiveRendering {
        for stage in Schedule::new(goal) {
            self.levels = [0, 1].map(|half| self.levels_of(half, stage));
            self.round::<S, T>();
            let Some(error) = self.error().filter(|_| (self.halt)() == Halt::No) else { break };
            self.finished.push(Round { samples_per_pixel: self.samples_per_pixel(), error });
            (self.report)(self.advance());
            let reached = goal.error.is_some_and(|bound| error.upper <= bound);
            if reached && stage.samples_per_pixel >= UNIFORM {
                break;
            }
        }
        let halves = self.canvas.halves();
        ProgressiveRendering {
            image: canvas::mean(&halves),
            variance: canvas::variance(&halves),
            samples: self.canvas.samples(),
            error: self.error(),
            rounds: self.finished,
            statistics: self.statistics,
        }
    }

    /// Levels of one half of the pixels after a stage.
    fn levels_of(&self, half: usize, stage: Stage) -> Vec<u8> {
        let merits = stage.known.map(|known| {
            let guide = self.guides[half];
            let variances = self.canvas.map(|halves| halves[guide].difference(known));
            merits(&variances, self.renderer.scene.film.crop.size[0] as usize)
        });
        let budget = (0.5 * stage.samples_per_pixel * self.dither.len() as f64 + 0.5) as u64;
        levels(merits.as_deref(), &self.dither, &self.levels[half], stage.bounds, budget)
    }

    fn samples_per_pixel(&self) -> f64 {
        self.statistics.samples as f64 / self.dither.len() as f64
    }

    fn advance(&self) -> Advance {
        Advance {
            samples_per_pixel: self.samples_per_pixel(),
            error: self.finished.last().map(|round| round.error),
        }
    }

    fn error(&self) -> Option<ImageError> {
        let whole = self.canvas.map(|halves| halves.iter().all(|half| half.drawn() > 0));
        let [a, b] = self.canvas.halves();
        whole.into_iter().all(|whole| whole).then(|| ImageError::between(&a, &b))
    }

    /// Brings every pixel to its level.
    fn round<S: Sampler, T: Transport>(&mut self) {
        let first = self.finished.is_empty();
        let halted = || match (self.halt)() {
            Halt::No => false,
            Halt::WhenWhole => !first,
            Halt::Now => true,
        };
        let advance = self.advance();
        let done = Mutex::new((Statistics::default(), advance));
        let pixels = self.dither.len() as f64;
        self.renderer.share_out(&self.canvas.tiles, &halted, |piece: &CanvasTile| {
            let mut halves = piece.pixels.lock().unwrap_or_else(PoisonError::into_inner);
            let task = ExtendTile::<S, T> {
                renderer: self.renderer,
                tile: piece.tile,
                halves: &mut halves,
                canvas: &self.canvas,
                levels: &self.levels,
                halted: &halted,
                configuration: PhantomData,
            };
            let statistics = self.renderer.scene.geometry.run(task);
            let mut shared = done.lock().unwrap_or_else(PoisonError::into_inner);
            shared.0.merge(&statistics);
            shared.1.samples_per_pixel += statistics.samples as f64 / pixels;
            let advance = shared.1;
            drop(shared);
            (self.report)(advance);
        });
        let (statistics, _) = done.into_inner().unwrap_or_else(PoisonError::into_inner);
        self.statistics.merge(&statistics);
    }
}

/// Bringing the pixels of one tile to their levels.
struct ExtendTile<'t, 'r, 'a, S, T> {
    renderer: &'r Renderer<'a>,
    tile: Tile,
    halves: &'t mut [[Half; 2]],
    canvas: &'t Canvas,
    levels: &'t [Vec<u8>; 2],
    halted: &'t (dyn Fn() -> bool + Sync),
    configuration: PhantomData<(S, T)>,
}

impl<S: Sampler, T: Transport> Task for ExtendTile<'_, '_, '_, S, T> {
    type Output = Statistics;

    #[inline(always)]
    fn run<R: Rays>(self, rays: R) -> Statistics {
        let renderer = self.renderer;
        let tracer = renderer.tracer::<T::Channels, R>(rays);
        let mut statistics = Statistics::default();
        for (pixel, halves) in self.tile.pixels().zip(self.halves) {
            let index = self.canvas.index(pixel);
            if (self.halted)() {
                break;
            }
            let filter = renderer.filter.pixel(pixel);
            for (half, first) in [0, SECOND_HALF].into_iter().enumerate() {
                let wanted = 1_u32 << self.levels[half][index];
                while halves[half].drawn() < wanted {
                    let mut block = PixelSum::default();
                    for sample in halves[half].next_block() {
                        let sample = first + u64::from(sample);
                        let points = S::at(renderer.settings.seed, pixel, sample);
                        let radiance = renderer.path_sample::<S, T, R>(
                            &tracer,
                            &filter,
                            &points,
                            &mut statistics.rays,
                        );
                        if !block.add(radiance) {
                            let [column, row] = pixel;
                            statistics.non_finite.record(SampleAddress { row, column, sample });
                        }
                        statistics.samples += 1;
                    }
                    halves[half].add(&block);
                }
            }
        }
        statistics
    }
}
