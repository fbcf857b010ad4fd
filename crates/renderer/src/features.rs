//! What pixels show: the surfaces that camera rays meet first.

use core::marker::PhantomData;
use core::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};

use etendue_math::glam::{DVec2, DVec3};
use etendue_sampling::{Independent, Sampler, Sobol};
use etendue_scene::Color;
use etendue_scene::color::Primaries;
use etendue_scene::geometry::{Rays, Task};
use etendue_scene::scene::SamplerKind;

use crate::path::FirstHit;
use crate::render::Renderer;
use crate::tile::Tile;

/// What a pixel shows, in the mean over some of its samples.
///
/// Samples lie where those of the picture lie: in proportion to the magnitude of the reconstruction
/// filter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Features {
    /// Directional albedo towards the camera, `∫ f |cos| dω` with all lobes, in each channel; black
    /// where nothing is met. In radiance: what enters a denser medium counts 1/η².
    pub albedo: Color,
    /// Shading normal in world space, on the front of the surface, 0 where nothing is met. A mean of
    /// unit vectors, shorter than 1 where they differ.
    pub normal: [f32; 3],
    /// Depth along the camera's axis in units of the scene, in the mean over the samples that meet
    /// something; ∞ where none does.
    pub depth: f32,
    /// Position in world space, in the mean over the samples that meet something; 0 where none does.
    pub position: [f32; 3],
    /// Texture coordinates, in the mean over the samples that meet something; 0 where none does.
    pub uv: [f32; 2],
    /// The shape that the first sample to meet one meets, counted from 1; 0 where none does.
    pub shape: u32,
}

impl Features {
    /// Those of a pixel that shows nothing.
    pub const NOTHING: Self = Self {
        albedo: Color { r: 0.0, g: 0.0, b: 0.0 },
        normal: [0.0; 3],
        depth: f32::INFINITY,
        position: [0.0; 3],
        uv: [0.0; 2],
        shape: 0,
    };
}

impl Renderer<'_> {
    /// The features of all pixels of the film's crop, row by row, over the first samples of the
    /// picture.
    ///
    /// * `samples_per_pixel`: how many of them; 0 counts as 1.
    /// * Once `cancel` is true, tiles under way are finished and no further ones begun; pixels that
    ///   were not reached show nothing.
    pub fn features(&self, samples_per_pixel: u32, cancel: &AtomicBool) -> Vec<Features> {
        match self.settings.sampler {
            SamplerKind::Independent => {
                self.features_with::<Independent>(samples_per_pixel, cancel)
            }
            SamplerKind::Sobol => self.features_with::<Sobol>(samples_per_pixel, cancel),
        }
    }

    fn features_with<S: Sampler>(&self, samples: u32, cancel: &AtomicBool) -> Vec<Features> {
        let crop = &self.scene.film.crop;
        let [width, height] = crop.size.map(|n| n as usize);
        let features = Mutex::new(vec![Features::NOTHING; width * height]);
        let tiles = Tile::cover(crop);
        self.share_out(&tiles, &|| cancel.load(Ordering::Relaxed), |&tile| {
            let task = TileFeatures::<S> {
                renderer: self,
                tile,
                samples: samples.max(1),
                points: PhantomData,
            };
            let pixels = self.scene.geometry.run(task);
            let mut features = features.lock().unwrap_or_else(PoisonError::into_inner);
            for ([x, y], pixel) in tile.pixels().zip(pixels) {
                let [x, y] = [x - crop.offset[0], y - crop.offset[1]].map(|n| n as usize);
                features[y * width + x] = pixel;
            }
        });
        features.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The features of one tile.
struct TileFeatures<'r, 'a, S> {
    renderer: &'r Renderer<'a>,
    tile: Tile,
    samples: u32,
    points: PhantomData<fn() -> S>,
}

impl<S: Sampler> Task for TileFeatures<'_, '_, S> {
    type Output = Vec<Features>;

    #[inline(always)]
    fn run<R: Rays>(self, rays: R) -> Vec<Features> {
        let Self { renderer, tile, samples, .. } = self;
        let tracer = renderer.tracer::<Primaries, R>(rays);
        let mut features = Vec::new();
        for pixel in tile.pixels() {
            let filter = renderer.filter.pixel(pixel);
            let mut sums = Sums::default();
            for sample in 0..samples {
                let points = S::at(renderer.settings.seed, pixel, u64::from(sample));
                let time = renderer.time(&points);
                let (ray, _) = renderer.camera_ray(&filter, time, &points);
                if let Some(hit) = tracer.at(time).first_hit(ray, &points) {
                    sums.add(&hit, renderer.scene.camera.depth_at(hit.point.position, time));
                }
            }
            features.push(sums.features(samples));
        }
        features
    }
}

/// Sums over the samples of a pixel.
#[derive(Default)]
struct Sums {
    hits: u32,
    albedo: DVec3,
    normal: DVec3,
    depth: f64,
    position: DVec3,
    uv: DVec2,
    shape: u32,
}

impl Sums {
    fn add(&mut self, hit: &FirstHit, depth: f32) {
        if self.hits == 0 {
            self.shape = hit.point.shape.0 + 1;
        }
        self.hits += 1;
        self.albedo += DVec3::from_array(hit.albedo.to_array().map(f64::from));
        self.normal += hit.point.shading.n.as_dvec3();
        self.depth += f64::from(depth);
        self.position += hit.point.position.as_dvec3();
        self.uv += DVec2::from_array(hit.point.uv.map(f64::from));
    }

    fn features(&self, samples: u32) -> Features {
        if self.hits == 0 {
            return Features::NOTHING;
        }
        let (samples, hits) = (f64::from(samples), f64::from(self.hits));
        Features {
            albedo: (self.albedo / samples).as_vec3().to_array().into(),
            normal: (self.normal / samples).as_vec3().to_array(),
            depth: (self.depth / hits) as f32,
            position: (self.position / hits).as_vec3().to_array(),
            uv: (self.uv / hits).as_vec2().to_array(),
            shape: self.shape,
        }
    }
}
