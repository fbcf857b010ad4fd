//! Rendering a whole picture on all processors.

use core::marker::PhantomData;
use core::ops::Range;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use etendue_math::Spectrum;
use etendue_sampling::{Decision, Dimension, Sampler};
use etendue_scene::color::Channels;
use etendue_scene::geometry::{Ray, Rays, Task};
use etendue_scene::{Color, Scene};

use crate::accumulation::{PackedTile, PixelMoments};
use crate::bad_samples::is_negative;
use crate::configuration::{Configuration, Configured};
use crate::film::{FilterSampler, Image, PixelFilter};
use crate::light_sampler::{LightSampler, PointLights};
use crate::path::{Carried, PathTracer, Prepared, Transport};
use crate::renderer_error::RendererError;
use crate::replay::OneSample;
use crate::settings::{Airlight, RenderSettings};
use crate::statistics::{RayCounts, Statistics};
use crate::tile::Tile;

/// Renders one scene with one set of settings.
///
/// Every number of a sample is addressed by (seed, pixel, sample, decision), and every pixel sums
/// its own samples exactly: the picture has the same bits for any number of threads, and for any division of the samples
/// ([`accumulate`](Self::accumulate)).
pub struct Renderer<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) settings: RenderSettings,
    pub(crate) configuration: Configuration,
    pub(crate) materials: Prepared<'a>,
    lights: LightSampler,
    point_lights: PointLights,
    /// Whether samples have a time.
    has_motion: bool,
    pub(crate) filter: FilterSampler,
    pool: rayon::ThreadPool,
}

/// How far a render is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Tiles finished.
    pub finished: usize,
    /// Tiles in all.
    pub total: usize,
}

/// A rendered picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendering {
    /// The film's crop; pixels that a cancelled render did not reach are black.
    pub image: Image,
    /// What was done.
    pub statistics: Statistics,
    /// How far the render came: all tiles unless it was cancelled.
    pub progress: Progress,
}

impl<'a> Renderer<'a> {
    /// Prepares materials, lights, filter and threads.
    ///
    /// # Errors
    /// The picture does not fit in memory; the threads cannot be started; the program was compiled without the configuration that the scene calls for.
    pub fn new(scene: &'a Scene, settings: RenderSettings) -> Result<Self, RendererError> {
        let configuration = Configuration::of(scene, &settings);
        if !configuration.is_compiled() {
            return Err(RendererError::NotCompiled(configuration));
        }
        let [width, height] = scene.film.crop.size;
        let pixels = width as usize * height as usize;
        // Asked for and given back: a program without memory ends, which no caller can stop.
        Vec::<[f32; 3]>::new()
            .try_reserve_exact(pixels)
            .map_err(|_| RendererError::Memory { width, height })?;
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(settings.threads)
            .thread_name(|i| format!("render {i}"))
            .build()
            .map_err(RendererError::Threads)?;
        let materials = Prepared::new(scene, settings.samples_per_pixel);
        let lights = LightSampler::new(scene);
        let point_lights = match settings.airlight {
            Airlight::Combined => PointLights::new(scene),
            Airlight::Transmittance => PointLights::default(),
        };
        let filter = FilterSampler::new(&scene.film);
        let has_motion = scene.has_motion();
        Ok(Self {
            scene,
            settings,
            configuration,
            materials,
            lights,
            point_lights,
            has_motion,
            filter,
            pool,
        })
    }

    /// What is rendered with.
    pub fn configuration(&self) -> Configuration {
        self.configuration
    }

    /// The same with everything compiled in that the picture does not depend on: what leaving it out saves.
    #[must_use]
    pub fn with_everything(mut self) -> Self {
        self.configuration = Configuration::largest(self.scene, &self.settings);
        self
    }

    /// Number of threads that render.
    pub fn threads(&self) -> usize {
        self.pool.current_num_threads()
    }

    /// Renders the film's crop.
    ///
    /// * `report` is called after every tile, by the thread that finished it.
    /// * Once `cancel` is true, pixels under way are finished and no further ones begun.
    pub fn render(&self, report: &(dyn Fn(Progress) + Sync), cancel: &AtomicBool) -> Rendering {
        let rendering = Mutex::new(self.nothing_rendered());
        self.render_onto(&rendering, report, cancel);
        rendering.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    /// A black picture of the film's crop: what a render begins with.
    pub fn nothing_rendered(&self) -> Rendering {
        let crop = &self.scene.film.crop;
        Rendering {
            image: Image::black(crop.size),
            statistics: Statistics::default(),
            progress: Progress { finished: 0, total: Tile::count(crop) as usize },
        }
    }

    /// Renders as [`render`](Self::render) does, onto a picture that is there, with what was finished, also after a panic.
    pub fn render_onto(
        &self,
        rendering: &Mutex<Rendering>,
        report: &(dyn Fn(Progress) + Sync),
        cancel: &AtomicBool,
    ) {
        self.render_tiles(&Tile::cover(&self.scene.film.crop), rendering, report, cancel);
    }

    /// The radiance of one sample, weighted by the filter: what the picture's pixel is the mean of.
    /// `pixel` is a column and a row of the full film, `index` that of a [`SampleAddress`](crate::SampleAddress).
    pub fn sample(&self, pixel: [u32; 2], index: u64) -> Color {
        let settings = &self.settings;
        let sample = OneSample { renderer: self, settings, pixel, index, recorded: None };
        self.configured(sample).0.radiance
    }

    /// Renders the given tiles, in this order.
    pub(crate) fn render_tiles(
        &self,
        tiles: &[Tile],
        rendering: &Mutex<Rendering>,
        report: &(dyn Fn(Progress) + Sync),
        cancel: &AtomicBool,
    ) {
        self.configured(RenderTiles { renderer: self, tiles, rendering, report, cancel });
    }

    fn render_with<S: Sampler, T: Transport>(
        &self,
        tiles: &[Tile],
        rendering: &Mutex<Rendering>,
        report: &(dyn Fn(Progress) + Sync),
        cancel: &AtomicBool,
    ) {
        let crop = &self.scene.film.crop;
        self.share_out(tiles, &|| cancel.load(Ordering::Relaxed), |&tile| {
            let samples = 0..self.settings.samples_per_pixel;
            let keep = Keep::Means(Vec::new());
            let drawn = self.render_tile::<S, T>(tile, samples, keep, cancel);
            let Keep::Means(pixels) = drawn.kept else { return };
            // Merging is the same in any order. A poisoned lock means that `report` panicked
            // on another thread, whose tile is complete.
            let mut shared = rendering.lock().unwrap_or_else(PoisonError::into_inner);
            for (pixel, color) in tile.pixels().zip(pixels) {
                let [x, y] = [0, 1].map(|axis| pixel[axis] - crop.offset[axis]);
                shared.image.set([x, y], color);
            }
            shared.statistics.merge(&drawn.statistics);
            shared.progress.finished += usize::from(drawn.whole);
            let progress = shared.progress;
            drop(shared);
            report(progress);
        });
    }

    /// A tile with further samples; `None` if it was cancelled.
    ///
    /// * `samples`: follow those that `before` has.
    pub(crate) fn extend_tile<S: Sampler, T: Transport>(
        &self,
        tile: Tile,
        samples: Range<u32>,
        before: &PackedTile,
        cancel: &AtomicBool,
    ) -> Option<PackedTile> {
        let pixels = before.unpack(tile).collect();
        let drawn = before.drawn() + (samples.end - samples.start);
        let after = self.render_tile::<S, T>(tile, samples, Keep::Moments(pixels), cancel);
        let Keep::Moments(pixels) = after.kept else { return None };
        let mut statistics = before.statistics().clone();
        statistics.merge(&after.statistics);
        after.whole.then(|| PackedTile::new(drawn, &pixels, statistics))
    }

    fn render_tile<S: Sampler, T: Transport>(
        &self,
        tile: Tile,
        samples: Range<u32>,
        keep: Keep,
        cancel: &AtomicBool,
    ) -> DrawnTile {
        let task = RenderTile::<S, T> {
            renderer: self,
            tile,
            samples,
            keep,
            cancel,
            configuration: PhantomData,
        };
        self.scene.geometry.run(task)
    }

    /// Every thread takes the next piece of work until none is left or `cancelled` says so.
    ///
    /// A panic ends the work: pieces that others have begun are finished, and then it goes on in the caller.
    pub(crate) fn share_out<T: Sync>(
        &self,
        pieces: &[T],
        cancelled: &(dyn Fn() -> bool + Sync),
        work: impl Fn(&T) + Sync,
    ) {
        let next = AtomicUsize::new(0);
        let panicked = AtomicBool::new(false);
        self.pool.broadcast(|_| {
            let _alarm = Alarm(&panicked);
            while !cancelled() && !panicked.load(Ordering::Relaxed) {
                let Some(piece) = pieces.get(next.fetch_add(1, Ordering::Relaxed)) else { break };
                work(piece);
            }
        });
    }

    pub(crate) fn tracer<C: Carried, R: Rays>(&self, rays: R) -> PathTracer<'_, 'a, R, C> {
        self.tracer_with(rays, &self.settings)
    }

    /// The same for paths of other settings.
    pub(crate) fn tracer_with<C: Carried, R: Rays>(
        &self,
        rays: R,
        settings: &RenderSettings,
    ) -> PathTracer<'_, 'a, R, C> {
        let RenderSettings { path, strategy, .. } = *settings;
        let materials = C::materials(&self.materials);
        PathTracer::new(
            rays,
            self.scene,
            materials,
            &self.lights,
            &self.point_lights,
            path,
            strategy,
        )
    }

    #[inline(always)]
    fn render_pixel<S: Sampler, T: Transport, R: Rays>(
        &self,
        tracer: &PathTracer<'_, '_, R, T::Channels>,
        pixel: [u32; 2],
        samples: Range<u32>,
        moments: &mut PixelMoments,
        squares: bool,
        statistics: &mut Statistics,
    ) {
        let filter = self.filter.pixel(pixel);
        statistics.samples += u64::from(samples.end - samples.start);
        for sample in samples {
            let points = S::at(self.settings.seed, pixel, u64::from(sample));
            let PathSample { radiance, negative } =
                self.path_sample::<S, T, R>(tracer, &filter, &points, &mut statistics.rays);
            let counts = moments.add(radiance);
            if counts && squares {
                moments.add_squares(radiance);
            }
            statistics.check(pixel, u64::from(sample), counts, negative);
        }
    }

    #[inline(always)]
    pub(crate) fn path_sample<S: Sampler, T: Transport, R: Rays>(
        &self,
        tracer: &PathTracer<'_, '_, R, T::Channels>,
        filter: &PixelFilter<'_>,
        points: &S,
        rays: &mut RayCounts,
    ) -> PathSample {
        let time = self.time(points);
        let (ray, weight) = self.camera_ray(filter, time, points);
        let radiance = T::radiance(&tracer.at(time), ray, points, rays);
        let negative = <T::Channels as Channels>::FIXED.is_some() && is_negative(radiance);
        PathSample { radiance: radiance.scale(weight), negative }
    }

    /// The moment of one sample, in shares of the exposure: one for all rays of its path.
    #[inline(always)]
    pub(crate) fn time<S: Sampler>(&self, points: &S) -> f32 {
        if self.has_motion { points.sample_1d(Dimension::camera(Decision::Time)) } else { 0.0 }
    }

    /// The camera's ray of one sample, and the weight of the radiance that it finds.
    #[inline(always)]
    pub(crate) fn camera_ray<S: Sampler>(
        &self,
        filter: &PixelFilter<'_>,
        time: f32,
        points: &S,
    ) -> (Ray, f32) {
        let film = filter.sample(points.sample_2d(Dimension::camera(Decision::Film)));
        let camera = &self.scene.camera;
        let lens = if camera.samples_lens() {
            points.sample_2d(Dimension::camera(Decision::Lens))
        } else {
            [0.0; 2]
        };
        (camera.ray_at(film.position, lens, time), film.weight * camera.weight())
    }
}

/// What one path has found.
pub(crate) struct PathSample {
    /// Weighted by the filter.
    pub(crate) radiance: Color,
    /// Whether it was less than no light before.
    pub(crate) negative: bool,
}

/// The rendering of some tiles.
struct RenderTiles<'r, 'a> {
    renderer: &'r Renderer<'a>,
    tiles: &'r [Tile],
    rendering: &'r Mutex<Rendering>,
    report: &'r (dyn Fn(Progress) + Sync),
    cancel: &'r AtomicBool,
}

impl Configured for RenderTiles<'_, '_> {
    type Output = ();

    fn run<S: Sampler, T: Transport>(self) {
        let Self { renderer, tiles, rendering, report, cancel } = self;
        renderer.render_with::<S, T>(tiles, rendering, report, cancel);
    }
}

/// Says that a thread panics.
struct Alarm<'f>(&'f AtomicBool);

impl Drop for Alarm<'_> {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.store(true, Ordering::Relaxed);
        }
    }
}

/// What is kept of the pixels of a tile.
enum Keep {
    /// The means, of those that were reached.
    Means(Vec<Color>),
    /// All moments, to which samples are added.
    Moments(Vec<PixelMoments>),
}

/// A tile after more samples.
struct DrawnTile {
    kept: Keep,
    statistics: Statistics,
    /// Whether every pixel was reached.
    whole: bool,
}

/// The rendering of one tile.
struct RenderTile<'r, 'a, S, T> {
    renderer: &'r Renderer<'a>,
    tile: Tile,
    samples: Range<u32>,
    keep: Keep,
    cancel: &'r AtomicBool,
    configuration: PhantomData<(S, T)>,
}

impl<S: Sampler, T: Transport> Task for RenderTile<'_, '_, S, T> {
    type Output = DrawnTile;

    #[inline(always)]
    fn run<R: Rays>(self, rays: R) -> DrawnTile {
        let Self { renderer, tile, samples, mut keep, cancel, .. } = self;
        let tracer = renderer.tracer::<T::Channels, R>(rays);
        let mut statistics = Statistics::default();
        let squares = matches!(keep, Keep::Moments(_));
        let mut whole = true;
        for (place, pixel) in tile.pixels().enumerate() {
            if cancel.load(Ordering::Relaxed) {
                whole = false;
                break;
            }
            let mut moments = match &keep {
                Keep::Means(_) => PixelMoments::default(),
                Keep::Moments(pixels) => pixels[place],
            };
            renderer.render_pixel::<S, T, R>(
                &tracer,
                pixel,
                samples.clone(),
                &mut moments,
                squares,
                &mut statistics,
            );
            match &mut keep {
                Keep::Means(pixels) => pixels.push(moments.mean()),
                Keep::Moments(pixels) => pixels[place] = moments,
            }
        }
        DrawnTile { kept: keep, statistics, whole }
    }
}
