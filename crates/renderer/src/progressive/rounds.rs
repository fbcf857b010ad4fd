//! The rounds of a progressive render.

use alloc::sync::Arc;
use core::marker::PhantomData;
use std::sync::{Mutex, MutexGuard, PoisonError};

use etendue_sampling::Sampler;
use etendue_scene::film::Crop;
use etendue_scene::geometry::{Rays, Task};

use super::allocation::{dither, levels, merits};
use super::convergence::Round;
use super::goal::{Goal, Halt};
use super::half::Half;
use super::image_error::ImageError;
use super::schedule::{Schedule, Stage, UNIFORM};
use super::state::ProgressiveState;
use crate::canvas::{CanvasTile, index};
use crate::configuration::Configured;
use crate::film::{Image, PixelSum};
use crate::path::Transport;
use crate::render::Renderer;
use crate::statistics::Statistics;
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
        let work = Mutex::new(ProgressiveState::new(self.scene.film.crop, goal.allocation));
        self.continue_progressively(&work, goal, report, halt);
        work.into_inner().unwrap_or_else(PoisonError::into_inner).rendering()
    }

    /// Goes on with a progressive render until a goal is reached, as [`render_progressively`](Self::render_progressively) does from
    /// the beginning. Samples go where they have gone so far, whatever the goal says.
    ///
    /// `work` is locked for moments only, and whole at any time: another thread may copy it for storing, and after a panic all
    /// tiles that were finished are in it.
    pub fn continue_progressively(
        &self,
        work: &Mutex<ProgressiveState>,
        goal: &Goal,
        report: &(dyn Fn(Advance) + Sync),
        halt: &(dyn Fn() -> Halt + Sync),
    ) {
        self.configured(RunRounds { rounds: Rounds::new(self, work, report, halt), goal });
    }
}

#[cfg(test)]
impl Renderer<'_> {
    /// The mistake that the two halves avoid: each half is allocated by what it has found itself.
    pub(crate) fn render_guided_by_own_samples(&self, goal: &Goal) -> ProgressiveRendering {
        let work = Mutex::new(ProgressiveState::new(self.scene.film.crop, goal.allocation));
        let mut rounds = Rounds::new(self, &work, &|_| (), &|| Halt::No);
        rounds.guides = [0, 1];
        self.configured(RunRounds { rounds, goal });
        work.into_inner().unwrap_or_else(PoisonError::into_inner).rendering()
    }
}

/// The whole of a progressive render.
struct RunRounds<'r, 'a> {
    rounds: Rounds<'r, 'a>,
    goal: &'r Goal,
}

impl Configured for RunRounds<'_, '_> {
    type Output = ();

    fn run<S: Sampler, T: Transport>(self) {
        self.rounds.run::<S, T>(self.goal);
    }
}

/// A progressive render under way.
struct Rounds<'r, 'a> {
    renderer: &'r Renderer<'a>,
    work: &'r Mutex<ProgressiveState>,
    report: &'r (dyn Fn(Advance) + Sync),
    halt: &'r (dyn Fn() -> Halt + Sync),
    crop: Crop,
    tiles: Vec<(usize, Tile)>,
    dither: Vec<u8>,
    /// For each half, the one by whose differences its samples are allocated.
    guides: [usize; 2],
}

impl<'r, 'a> Rounds<'r, 'a> {
    fn new(
        renderer: &'r Renderer<'a>,
        work: &'r Mutex<ProgressiveState>,
        report: &'r (dyn Fn(Advance) + Sync),
        halt: &'r (dyn Fn() -> Halt + Sync),
    ) -> Self {
        let crop = renderer.scene.film.crop;
        let tiles = Tile::cover(&crop).into_iter().enumerate().collect();
        let dither = dither(&crop);
        Self { renderer, work, report, halt, crop, tiles, dither, guides: [1, 0] }
    }

    /// A poisoned lock means that a report panicked: what it guards is whole.
    fn lock(&self) -> MutexGuard<'r, ProgressiveState> {
        self.work.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn run<S: Sampler, T: Transport>(self, goal: &Goal) {
        let goal = Goal { allocation: self.lock().allocation, ..*goal };
        for (place, stage) in (0..).zip(Schedule::new(&goal)) {
            // Of a render that goes on, the rounds that it has behind it are left out, and one that was begun is not begun again.
            let before = self.lock().clone();
            let is_last = place + 1 == before.begun && before.last == Some(stage);
            if place + 1 < before.begun {
                continue;
            }
            if !(is_last && before.is_finished) {
                if !is_last {
                    self.begin(place, stage, &before);
                }
                self.round::<S, T>();
                let error = self.lock().error();
                let Some(error) = error.filter(|_| (self.halt)() == Halt::No) else { return };
                self.finish(error);
            }
            let reached = {
                let last = self.lock().finished.last().copied();
                goal.error.zip(last).is_some_and(|(bound, round)| round.error.upper <= bound)
            };
            if reached && stage.samples_per_pixel >= UNIFORM {
                return;
            }
        }
    }

    /// Decides what the samples of a round are.
    fn begin(&self, place: u32, stage: Stage, before: &ProgressiveState) {
        let levels = Arc::new([0, 1].map(|half| self.levels_of(half, stage, before)));
        let mut work = self.lock();
        work.levels = levels;
        work.begun = place + 1;
        // A round that a smaller limit had cut short counts once, as what it becomes.
        work.finished.truncate(place as usize);
        work.last = Some(stage);
        work.is_finished = false;
    }

    fn finish(&self, error: ImageError) {
        let mut work = self.lock();
        let round = Round { samples_per_pixel: work.samples_per_pixel(), error };
        work.finished.push(round);
        work.is_finished = true;
        drop(work);
        (self.report)(self.advance());
    }

    /// Levels of one half of the pixels after a stage.
    fn levels_of(&self, half: usize, stage: Stage, before: &ProgressiveState) -> Vec<u8> {
        let merits = stage.known.map(|known| {
            let guide = self.guides[half];
            let variances = before.canvas.map(|halves| halves[guide].difference(known));
            merits(&variances, self.crop.size[0] as usize)
        });
        let budget = (0.5 * stage.samples_per_pixel * self.dither.len() as f64 + 0.5) as u64;
        levels(merits.as_deref(), &self.dither, &before.levels[half], stage.bounds, budget)
    }

    fn advance(&self) -> Advance {
        let work = self.lock();
        Advance {
            samples_per_pixel: work.samples_per_pixel(),
            error: work.finished.last().map(|round| round.error),
        }
    }

    /// Brings every pixel to its level.
    fn round<S: Sampler, T: Transport>(&self) {
        let (first, levels) = {
            let work = self.lock();
            (work.finished.is_empty(), Arc::clone(&work.levels))
        };
        let halted = || match (self.halt)() {
            Halt::No => false,
            Halt::WhenWhole => !first,
            Halt::Now => true,
        };
        let advance = Mutex::new(self.advance());
        let pixels = self.dither.len() as f64;
        self.renderer.share_out(&self.tiles, &halted, |&(index, tile)| {
            let before = self.lock().canvas.tile(index);
            let mut after = CanvasTile::clone(&before);
            let task = ExtendTile::<S, T> {
                renderer: self.renderer,
                tile,
                halves: &mut after.pixels,
                crop: &self.crop,
                levels: &levels,
                halted: &halted,
                configuration: PhantomData,
            };
            let statistics = self.renderer.scene.geometry.run(task);
            after.statistics.merge(&statistics);
            self.lock().canvas.replace(index, after);
            let mut shared = advance.lock().unwrap_or_else(PoisonError::into_inner);
            shared.samples_per_pixel += statistics.samples as f64 / pixels;
            let advance = *shared;
            drop(shared);
            (self.report)(advance);
        });
    }
}

/// Bringing the pixels of one tile to their levels.
struct ExtendTile<'t, 'r, 'a, S, T> {
    renderer: &'r Renderer<'a>,
    tile: Tile,
    halves: &'t mut [[Half; 2]],
    crop: &'t Crop,
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
            let place = index(self.crop, pixel);
            if (self.halted)() {
                break;
            }
            let filter = renderer.filter.pixel(pixel);
            for (half, first) in [0, SECOND_HALF].into_iter().enumerate() {
                let wanted = 1_u32 << self.levels[half][place];
                while halves[half].drawn() < wanted {
                    let mut block = PixelSum::default();
                    for sample in halves[half].next_block() {
                        let sample = first + u64::from(sample);
                        let points = S::at(renderer.settings.seed, pixel, sample);
                        let path = renderer.path_sample::<S, T, R>(
                            &tracer,
                            &filter,
                            &points,
                            &mut statistics.rays,
                        );
                        let counts = block.add(path.radiance);
                        statistics.check(pixel, sample, counts, path.negative);
                        statistics.samples += 1;
                    }
                    halves[half].add(&block);
                }
            }
        }
        statistics
    }
}
