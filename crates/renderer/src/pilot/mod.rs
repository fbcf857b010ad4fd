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

use core::marker::PhantomData;
use core::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use etendue_math::Spectrum;
use etendue_sampling::{Independent, Sampler, Sobol};
use etendue_scene::geometry::{Rays, Task};
use etendue_scene::scene::SamplerKind;

use crate::bad_samples::is_negative;
use crate::configuration::Configuration;
use crate::film::{Image, PixelFilter};
use crate::path::{LightSamples, MOST, SharedPath};
use crate::render::{Progress, Renderer, Rendering};
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
        match self.settings.sampler {
            SamplerKind::Independent => self.with_pilot::<Independent>(report, cancel),
            SamplerKind::Sobol => self.with_pilot::<Sobol>(report, cancel),
        }
    }

    /// Whether [`render_with_reuse`](Self::render_with_reuse) does anything else than [`render`](Self::render).
    pub fn reuses_paths(&self) -> bool {
        self.configuration == Configuration::Surfaces
            && !self.scene.has_motion()
            && self.settings.path.roulette_depth > 0
    }

    fn with_pilot<S: Sampler>(
        &self,
        report: &(dyn Fn(Progress) + Sync),
        cancel: &AtomicBool,
    ) -> Rendering {
        let crop = self.scene.film.crop;
        let passes = Passes::new(self, report, cancel);
        let mean = self.settings.samples_per_pixel;
        let first = guide::pilot_samples(mean);
        passes.draw::<S>(&|_| first, Plan::PILOT);
        let pilots = passes.map(PilotPixel::pilot);
        let counts = Guide::new(crop.size, &pilots).samples(first, mean);
        let count = |[x, y]: [u32; 2]| {
            let [column, row] = [x - crop.offset[0], y - crop.offset[1]];
            counts[(row * crop.size[0] + column) as usize]
        };
        passes.draw::<S>(&count, Plan::of(&pilots, f64::from(mean) / f64::from(first)));
        passes.rendering()
    }
}

/// The pixels of one tile, row by row.
struct Piece {
    tile: Tile,
    pixels: Mutex<Vec<PilotPixel>>,
}

impl Piece {
    fn new(tile: Tile) -> Self {
        let count = tile.size[0] as usize * tile.size[1] as usize;
        Self { tile, pixels: Mutex::new(vec![PilotPixel::default(); count]) }
    }
}

/// A render under way.
struct Passes<'r, 'a> {
    renderer: &'r Renderer<'a>,
    report: &'r (dyn Fn(Progress) + Sync),
    cancel: &'r AtomicBool,
    pieces: Vec<Piece>,
    done: Mutex<(Statistics, Progress)>,
}

impl<'r, 'a> Passes<'r, 'a> {
    fn new(
        renderer: &'r Renderer<'a>,
        report: &'r (dyn Fn(Progress) + Sync),
        cancel: &'r AtomicBool,
    ) -> Self {
        let tiles = Tile::cover(&renderer.scene.film.crop);
        let pieces: Vec<Piece> = tiles.into_iter().map(Piece::new).collect();
        let progress = Progress { finished: 0, total: 2 * pieces.len() };
        let done = Mutex::new((Statistics::default(), progress));
        Self { renderer, report, cancel, pieces, done }
    }

    /// Brings every pixel to its number of samples.
    fn draw<S: Sampler>(&self, wanted: &(dyn Fn([u32; 2]) -> u32 + Sync), plan: Plan) {
        let cancelled = || self.cancel.load(Ordering::Relaxed);
        self.renderer.share_out(&self.pieces, &cancelled, |piece: &Piece| {
            // A lock is poisoned by a panic outside of it, such as of a report.
            let mut pixels = piece.pixels.lock().unwrap_or_else(PoisonError::into_inner);
            let task = ExtendTile::<S> {
                renderer: self.renderer,
                tile: piece.tile,
                pixels: &mut pixels,
                wanted,
                plan,
                sampler: PhantomData,
            };
            let statistics = self.renderer.scene.geometry.run(task);
            let mut done = self.done.lock().unwrap_or_else(PoisonError::into_inner);
            done.0.merge(&statistics);
            done.1.finished += 1;
            let progress = done.1;
            drop(done);
            (self.report)(progress);
        });
    }

    /// What a function says of every pixel, row by row.
    fn map<A: Clone + Default>(&self, f: impl Fn(&PilotPixel) -> A) -> Vec<A> {
        let crop = &self.renderer.scene.film.crop;
        let mut plane = vec![A::default(); crop.size.map(|n| n as usize).iter().product()];
        for piece in &self.pieces {
            let pixels = piece.pixels.lock().unwrap_or_else(PoisonError::into_inner);
            for ([x, y], pixel) in piece.tile.pixels().zip(pixels.iter()) {
                let [column, row] = [x - crop.offset[0], y - crop.offset[1]];
                plane[(row * crop.size[0] + column) as usize] = f(pixel);
            }
        }
        plane
    }

    fn rendering(self) -> Rendering {
        let size = self.renderer.scene.film.crop.size;
        let pixels = self.map(PilotPixel::mean);
        let image = Image::from_pixels(size, pixels).unwrap_or_else(|| Image::black(size));
        let (statistics, progress) = self.done.into_inner().unwrap_or_else(PoisonError::into_inner);
        Rendering { image, statistics, progress }
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
                    if !counts || negative {
                        statistics.record(member.pixel, u64::from(sample), !counts, negative);
                    }
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
