//! One sample once more, ray by ray.

use core::cell::RefCell;

use etendue_math::Spectrum;
use etendue_sampling::Sampler;
use etendue_scene::Color;
use etendue_scene::geometry::{Hit, Moment, Ray, Rays, SurfacePoint};

use crate::configuration::Configured;
use crate::path::Transport;
use crate::render::{PathSample, Renderer};
use crate::settings::RenderSettings;
use crate::statistics::RayCounts;

/// What happened along the path of one sample.
#[derive(Clone, Debug)]
pub struct Replay {
    /// One for each edge of the path: the first is the camera's ray.
    pub steps: Vec<Step>,
    /// The sample, weighted by the filter, as [`Renderer::sample`] returns it.
    pub radiance: Color,
}

/// What one edge more adds to a path.
#[derive(Clone, Debug)]
pub struct Step {
    /// The rays that it takes, in their order: to lights from the vertex before, and to the next vertex.
    pub rays: Vec<TracedRay>,
    /// What a path of at most so many edges finds, weighted by the filter.
    pub radiance: Color,
}

/// A ray, and what has come of it.
#[derive(Clone, Copy, Debug)]
pub struct TracedRay {
    /// The ray.
    pub ray: Ray,
    /// What it met.
    pub found: Found,
}

/// What a ray has met.
#[derive(Clone, Copy, Debug)]
pub enum Found {
    /// A surface, at a distance.
    Surface(SurfacePoint, f32),
    /// Nothing.
    Nothing,
    /// Something between a point and a light.
    Blocked,
    /// Nothing between a point and a light.
    Free,
}

impl Step {
    /// The surface that the edge leads to.
    pub fn surface(&self) -> Option<&SurfacePoint> {
        self.rays.iter().rev().find_map(TracedRay::surface)
    }
}

impl TracedRay {
    /// The surface that it met.
    fn surface(&self) -> Option<&SurfacePoint> {
        match &self.found {
            Found::Surface(point, _) => Some(point),
            _ => None,
        }
    }
}

/// A path that the largest number of edges cuts.
#[derive(Clone, Copy, Debug)]
pub struct Cut {
    /// What it still carries: the largest channel of its throughput. More than one where it was cut in several places.
    pub throughput: f64,
    /// What its last ray met; in a medium it is cut on the way there.
    pub surface: Option<SurfacePoint>,
}

impl Replay {
    /// The longest path that is shown step by step.
    pub const MOST_STEPS: u32 = 1024;

    /// The first step with which the sample is no longer finite.
    pub fn first_not_finite(&self) -> Option<usize> {
        self.steps.iter().position(|step| !step.radiance.is_finite())
    }

    /// The first step that brings less than no light in some channel.
    pub fn first_negative(&self) -> Option<usize> {
        let mut before = [0.0; 3];
        self.steps.iter().position(|step| {
            let found = step.radiance.to_array();
            let less = found.iter().zip(before).any(|(&found, before)| found < before);
            before = found;
            less
        })
    }
}

impl Renderer<'_> {
    /// A sample as [`sample`](Self::sample) computes it, with the rays that it takes.
    ///
    /// Random numbers have addresses, so that a path of at most n edges is the beginning of the whole one: each step is one more edge, at most
    /// [`Replay::MOST_STEPS`].
    pub fn replay(&self, pixel: [u32; 2], index: u64) -> Replay {
        let (radiance, _, whole) = self.traced(pixel, index, self.settings.path.max_depth);
        let longest = self.settings.path.max_depth.unwrap_or(u32::MAX).min(Replay::MOST_STEPS);
        let mut steps = Vec::new();
        let mut before = 0;
        for depth in 1..=longest {
            let (radiance, _, rays) = self.traced(pixel, index, Some(depth));
            // The last edge was the last for another reason than this limit.
            if rays.len() <= before {
                break;
            }
            steps.push(Step { rays: rays[before..].to_vec(), radiance });
            before = rays.len();
            if before >= whole.len() {
                break;
            }
        }
        Replay { steps, radiance }
    }

    /// Where the path of a sample is cut, if it is.
    pub fn cut(&self, pixel: [u32; 2], index: u64) -> Option<Cut> {
        let (_, counts, rays) = self.traced(pixel, index, self.settings.path.max_depth);
        let surface = rays.iter().rev().find_map(TracedRay::surface).copied();
        (counts.cut > 0).then(|| Cut { throughput: counts.cut_share(1), surface })
    }

    fn traced(
        &self,
        pixel: [u32; 2],
        index: u64,
        max_depth: Option<u32>,
    ) -> (Color, RayCounts, Vec<TracedRay>) {
        let log = RefCell::default();
        let mut settings = self.settings.clone();
        settings.path.max_depth = max_depth;
        let recorded = Some(&log);
        let (sample, counts) = self.configured(OneSample {
            renderer: self,
            settings: &settings,
            pixel,
            index,
            recorded,
        });
        (sample.radiance, counts, log.into_inner())
    }
}

/// One sample, by itself.
pub(crate) struct OneSample<'r, 'a> {
    pub(crate) renderer: &'r Renderer<'a>,
    pub(crate) settings: &'r RenderSettings,
    pub(crate) pixel: [u32; 2],
    pub(crate) index: u64,
    /// Where its rays are noted.
    pub(crate) recorded: Option<&'r RefCell<Vec<TracedRay>>>,
}

impl Configured for OneSample<'_, '_> {
    type Output = (PathSample, RayCounts);

    fn run<S: Sampler, T: Transport>(self) -> Self::Output {
        let Self { renderer, settings, pixel, index, recorded } = self;
        let points = S::at(settings.seed, pixel, index);
        let filter = renderer.filter.pixel(pixel);
        let rays = Recorder { moment: renderer.scene.geometry.at(0.0), renderer, recorded };
        let tracer = renderer.tracer_with::<T::Channels, _>(rays, settings);
        let mut counts = RayCounts::default();
        let sample = renderer.path_sample::<S, T, _>(&tracer, &filter, &points, &mut counts);
        (sample, counts)
    }
}

/// Traces rays, and notes them.
#[derive(Clone, Copy)]
struct Recorder<'r, 'a> {
    moment: Moment<'r>,
    renderer: &'r Renderer<'a>,
    recorded: Option<&'r RefCell<Vec<TracedRay>>>,
}

impl Recorder<'_, '_> {
    fn note(&self, ray: &Ray, found: impl FnOnce() -> Found) {
        if let Some(log) = self.recorded {
            log.borrow_mut().push(TracedRay { ray: *ray, found: found() });
        }
    }
}

impl Rays for Recorder<'_, '_> {
    fn at(self, time: f32) -> Self {
        Self { moment: self.moment.at(time), ..self }
    }

    fn intersect(&self, ray: &Ray) -> Option<Hit> {
        let hit = self.moment.intersect(ray);
        self.note(ray, || match &hit {
            Some(hit) => {
                Found::Surface(self.renderer.scene.geometry.surface_point(ray, hit), hit.t)
            }
            None => Found::Nothing,
        });
        hit
    }

    fn occluded(&self, ray: &Ray) -> bool {
        let blocked = self.moment.occluded(ray);
        self.note(ray, || if blocked { Found::Blocked } else { Found::Free });
        blocked
    }
}
