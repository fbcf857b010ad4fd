//! Rendering that re-uses paths, and that a pilot tells where samples are worth most.
//!
//! # Re-use
//! Pixels are grouped, and the paths of a group [share](crate::path) what they find behind their first diffuse surface. The
//! error of indirect diffuse light falls with the size of the group, for a shadow ray per pair of paths. Neighbours have
//! errors in common then, which the estimates of [`progressive`](crate::progressive) do not allow for.
//!
//! # Two passes
//! The pilot draws the first quarter of the samples, the same number in every pixel. What is left goes where the error
//! is large for the brightness of the pixel, as the eye sees it: the aim is a small
//!
//! ```text
//! mean((x − μ)² / (μ² + 0.01))
//! ```
//!
//! over all channels of all pixels ([`guide`]). Pixels go on with one sequence of Sobol' points each, in powers of two.
//! Where the pilot promises little, all pixels get the same number. It also says how large groups are to be and how
//! many light samples paths are to take at their first vertex ([`plan`]).
//!
//! # Without bias
//! The pixels are those of a chessboard. How many samples a black one gets depends on nothing but the pilots of white
//! ones, and the other way round, the sharing out of the budget included; groups are of one colour. A pixel is thus the mean of a
//! number of samples that is independent of them. What is planned for the whole picture weights no sample by its value: those of either
//! pass have the same expectation whatever the plan.
//!
//! # Invariants
//! The same bits for any number of threads, and no allocation per sample. 104 bytes per pixel while rendering.

mod guide;
mod pixel;
mod plan;
mod state;

pub use state::ReuseState;

use core::marker::PhantomData;
use core::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use etendue_math::Spectrum;
use etendue_sampling::{Independent, Sampler, Sobol};
use etendue_scene::Scene;
use etendue_scene::geometry::{Rays, Task};
use etendue_scene::scene::SamplerKind;

use crate::bad_samples::is_negative;
use crate::canvas::{CanvasTile, index};
use crate::configuration::Configuration;
use crate::film::PixelFilter;
use crate::path::{LightSamples, MOST, SharedPath};
use crate::render::{Progress, Renderer, Rendering};
use crate::settings::RenderSettings;
use crate::statistics::Statistics;
use crate::tile::Tile;
use guide::Guide;
use pixel::{Extension, Find, PilotPixel};
use plan::Plan;

impl Renderer<'_> {
    /// Renders the film's crop as [`render`](Self::render) does, with paths that share what they find, and with more of the
    /// samples where a pilot found the error to be large for the brightness of the pixel. Each sample has the same expectation.
    ///
    /// Paths through media, of wavelengths, of different moments, and with roulette at their first edge do not share: then it is
    /// the same as [`render`](Self::render).
    ///
    /// * `report` is called after every tile of both passes, by the thread that finished it.
    /// * Once `cancel` is true, tiles under way are finished and no further ones begun; pixels that were not reached are black.
    pub fn render_with_reuse(
        &self,
        report: &(dyn Fn(Progress) + Sync),
        cancel: &AtomicBool,
    ) -> Rendering {
        if !self.reuses_paths() {
            return self.render(report, cancel);
        }
        let work = Mutex::new(ReuseState::new(self.scene.film.crop));
        self.continue_with_reuse(&work, report, cancel);
        work.into_inner().unwrap_or_else(PoisonError::into_inner).rendering()
    }

    /// Draws what is missing of a render with reuse, which is one of the film's crop, the same seed and the same number of samples. Of a
    /// renderer that does not [reuse paths](Self::reuses_paths) nothing is drawn.
    ///
    /// `work` is locked for moments only, and whole at any time: another thread may copy it for storing, and after a panic all
    /// tiles that were finished are in it. `report` and `cancel` are those of [`render_with_reuse`](Self::render_with_reuse).
    pub fn continue_with_reuse(
        &self,
        work: &Mutex<ReuseState>,
        report: &(dyn Fn(Progress) + Sync),
        cancel: &AtomicBool,
    ) {
        if !self.reuses_paths() {
            return;
        }
        let passes = Passes { renderer: self, work, report, cancel };
        match self.settings.sampler {
            SamplerKind::Independent => passes.draw_all::<Independent>(),
            SamplerKind::Sobol => passes.draw_all::<Sobol>(),
        }
    }

    /// Whether [`render_with_reuse`](Self::render_with_reuse) does anything else than [`render`](Self::render).
    pub fn reuses_paths(&self) -> bool {
        shares(self.configuration, self.scene, &self.settings)
    }
}

impl RenderSettings {
    /// Whether a renderer of these settings [reuses paths](Renderer::reuses_paths) of a scene.
    pub fn reuses_paths(&self, scene: &Scene) -> bool {
        shares(Configuration::of(scene, self), scene, self)
    }
}

fn shares(configuration: Configuration, scene: &Scene, settings: &RenderSettings) -> bool {
    configuration == Configuration::Surfaces
        && !scene.has_motion()
        && settings.path.roulette_depth > 0
}

/// The two passes of a render.
struct Passes<'r, 'a> {
    renderer: &'r Renderer<'a>,
    work: &'r Mutex<ReuseState>,
    report: &'r (dyn Fn(Progress) + Sync),
    cancel: &'r AtomicBool,
}

impl Passes<'_, '_> {
    fn lock(&self) -> MutexGuard<'_, ReuseState> {
        // A lock is poisoned by a panic outside of it, such as of a report.
        self.work.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    fn draw_all<S: Sampler>(&self) {
        let crop = self.renderer.scene.film.crop;
        let mean = self.renderer.settings.samples_per_pixel;
        let first = guide::pilot_samples(mean);
        self.draw::<S>(0, &|_| first, Plan::PILOT);
        if self.cancelled() {
            return;
        }
        // Of all pilots, those of pixels that are finished included.
        let pilots = self.lock().canvas.map(PilotPixel::pilot);
        let counts = Guide::new(crop.size, &pilots).samples(first, mean);
        let count = |pixel| counts[index(&crop, pixel)];
        self.draw::<S>(1, &count, Plan::of(&pilots, f64::from(mean) / f64::from(first)));
    }

    /// Brings every pixel to its number of samples.
    ///
    /// * `before`: passes that are finished.
    fn draw<S: Sampler>(
        &self,
        before: usize,
        wanted: &(dyn Fn([u32; 2]) -> u32 + Sync),
        plan: Plan,
    ) {
        let all = Tile::cover(&self.renderer.scene.film.crop);
        let mut work = self.lock();
        let is_missing = |&(index, tile): &(usize, Tile)| {
            let found = work.canvas.tile(index);
            let mut pixels = tile.pixels().zip(&found.pixels);
            pixels.any(|(pixel, state)| state.drawn() < wanted(pixel))
        };
        let total = all.len();
        let missing: Vec<(usize, Tile)> = all.into_iter().enumerate().filter(is_missing).collect();
        work.finished = (before + 1) * total - missing.len();
        drop(work);
        self.renderer.share_out(&missing, &|| self.cancelled(), |&(index, tile)| {
            let before = self.lock().canvas.tile(index);
            let mut after = CanvasTile::clone(&before);
            let task = ExtendTile::<S> {
                renderer: self.renderer,
                tile,
                pixels: &mut after.pixels,
                wanted,
                plan,
                sampler: PhantomData,
            };
            after.statistics.merge(&self.renderer.scene.geometry.run(task));
            let mut work = self.lock();
            work.canvas.replace(index, after);
            work.finished += 1;
            let progress = work.progress();
            drop(work);
            (self.report)(progress);
        });
    }
}

/// Bringing the pixels of one tile to their numbers of samples.
struct ExtendTile<'t, 'r, 'a, S> {
    renderer: &'r Renderer<'a>,
    tile: Tile,
    pixels: &'t mut [PilotPixel],
    wanted: &'t (dyn Fn([u32; 2]) -> u32 + Sync),
    plan: Plan,
    sampler: PhantomData<S>,
}

/// One pixel of a group.
struct Member<'f> {
    /// Within the tile, row by row.
    place: usize,
    pixel: [u32; 2],
    filter: PixelFilter<'f>,
    begin: u32,
    extension: Extension,
}

impl Member<'_> {
    fn takes(&self, sample: u32) -> bool {
        (self.begin..self.extension.end()).contains(&sample)
    }
}

impl<S: Sampler> Task for ExtendTile<'_, '_, '_, S> {
    type Output = Statistics;

    #[inline(always)]
    fn run<R: Rays>(self, rays: R) -> Statistics {
        let Self { renderer, tile, pixels, wanted, plan, .. } = self;
        let seed = renderer.settings.seed;
        let tracer = renderer.tracer(rays);
        let mut statistics = Statistics::default();
        let mut members: Vec<Member<'_>> = Vec::with_capacity(MOST);
        let patience = plan.patience();
        let mut paths: Vec<SharedPath> = Vec::with_capacity(MOST);
        let mut weights = [0.0; MOST];
        for group in tile.groups(plan.rectangle) {
            members.clear();
            members.extend(group.map(|place| {
                let (pixel, state) = (tile.pixel(place), pixels[place]);
                let filter = renderer.filter.pixel(pixel);
                let extension = state.extend(wanted(pixel));
                Member { place, pixel, filter, begin: state.drawn(), extension }
            }));
            let begin = members.iter().map(|member| member.begin).min().unwrap_or(0);
            let end = members.iter().map(|member| member.extension.end()).max().unwrap_or(0);
            for sample in begin..end {
                paths.clear();
                for member in members.iter_mut().filter(|member| member.takes(sample)) {
                    let (pixel, sample) = (member.pixel, u64::from(sample));
                    let points = S::at(seed, pixel, sample);
                    let (ray, weight) = renderer.camera_ray(&member.filter, 0.0, &points);
                    let lights = LightSamples {
                        seed,
                        pixel,
                        sample,
                        count: plan.lights,
                        sampler: PhantomData::<S>,
                    };
                    let before = statistics.rays.total();
                    let path =
                        tracer.path_to_share(ray, &points, lights, patience, &mut statistics.rays);
                    let after = statistics.rays.total();
                    let first = path.first.map_or(after, |first| first.rays);
                    member.extension.spend([first - before, after - first, 0]);
                    weights[paths.len()] = weight;
                    paths.push(path);
                }
                let before = statistics.rays.total();
                tracer.share(&mut paths, &mut statistics.rays);
                let to_share = statistics.rays.total() - before;
                let found = paths.iter().zip(weights);
                let members = members.iter_mut().filter(|member| member.takes(sample));
                for (i, (member, (path, weight))) in (0..).zip(members.zip(found)) {
                    // Evenly, what does not divide included.
                    member.extension.spend([0, 0, (to_share + i) / paths.len() as u64]);
                    let negative = is_negative(path.own + path.lent);
                    let [own, lent, alone] =
                        [path.own, path.lent, path.alone()].map(|light| light.scale(weight));
                    let first = path.first.map_or(own, |first| first.radiance.scale(weight));
                    let counts = member.extension.add(Find { own, lent, alone, first });
                    statistics.check(member.pixel, u64::from(sample), counts, negative);
                }
                statistics.samples += paths.len() as u64;
            }
            for member in members.drain(..) {
                pixels[member.place] = member.extension.finish();
            }
        }
        statistics
    }
}
