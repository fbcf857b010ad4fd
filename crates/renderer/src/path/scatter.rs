//! Where a path goes on, and whether it does.

use etendue_brdf::Density;
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_sampling::{Decision, Dimension, Sampler};
use etendue_scene::color::Channels;
use etendue_scene::geometry::Rays;

use super::{Arrival, Fate, PathTracer, Transport, Vertex, View, Walk};

/// How a path leaves a vertex.
#[derive(Clone, Copy)]
pub(super) struct Departure {
    /// From the camera to here, as roulette counts them.
    edges: u16,
    /// How many light samples were taken here.
    lights: u32,
    /// How much less a path may carry than 1 before roulette ends it.
    patience: f32,
}

impl Departure {
    /// The usual one, after so many edges.
    #[inline(always)]
    pub(super) fn after(edges: u16) -> Self {
        Self { edges, lights: 1, patience: 1.0 }
    }

    /// The same after several light samples.
    #[inline(always)]
    pub(super) fn with_lights(self, lights: u32) -> Self {
        Self { lights, ..self }
    }

    /// The same with more patience.
    #[inline(always)]
    pub(super) fn with_patience(self, patience: f32) -> Self {
        Self { patience, ..self }
    }
}

impl<R: Rays, C: Channels> PathTracer<'_, '_, R, C> {
    /// Chooses where the path goes on, and whether it does.
    #[inline(always)]
    pub(super) fn scatter<T: Transport<Channels = C>, S: Sampler>(
        &self,
        vertex: &Vertex<'_, C>,
        departure: Departure,
        walk: &mut Walk<C>,
        points: &S,
    ) -> Fate {
        let u_lobe = if vertex.bsdf.chooses_lobe() {
            points.sample_1d(vertex.dimension(Decision::LobeChoice))
        } else {
            0.0
        };
        let u = points.sample_2d(vertex.dimension(Decision::Direction));
        let Some(sample) = vertex.sample(u_lobe, u, walk, points) else { return Fate::Ends };
        walk.throughput = walk.throughput * sample.weight;
        walk.eta *= sample.eta;
        // A pass-through is the one delta direction that goes straight on.
        let is_straight = matches!(sample.density, Density::Delta(_)) && sample.wi == -vertex.wo;
        // Shadow rays have passed, too. A refracted ray may go straight on, but is no pass-through.
        let passes = T::VOLUMES && self.settings.volumes && is_straight && sample.eta == 1.0;
        walk.arrival = match sample.density {
            Density::Delta(_) if passes => walk.arrival,
            Density::Delta(_) => Arrival::Certain,
            Density::Continuous(density) => {
                // Against several light samples a scattered ray counts for less.
                let density = density / departure.lights as f32;
                Arrival::Scattered { receiver: vertex.receiver, density }
            }
        };
        if !is_straight {
            walk.view = View::Scattered;
        }
        let direction = vertex.point.shading.to_world(sample.wi);
        if self.is_inconsistent(vertex, direction, sample.wi) {
            return Fate::Ends;
        }
        walk.ray = vertex.point.spawn(direction);
        match self.roulette(vertex.dimension(Decision::Roulette), departure, walk, points) {
            Fate::Continues if passes => Fate::Passes,
            fate => fate,
        }
    }

    /// Whether strict normals forbid a direction, given in world and local coordinates: it lies on
    /// different sides of the surface and of its interpolated normal.
    #[inline(always)]
    pub(super) fn is_inconsistent(&self, vertex: &Vertex<'_, C>, world: Vec3, local: Vec3) -> bool {
        self.settings.strict_normals && world.dot(vertex.point.normal) * local.z <= 0.0
    }

    /// Russian roulette: ends paths that carry little and scales up the others.
    ///
    /// ```text
    /// q = min(patience · max(throughput) η², 0.95)
    /// ```
    ///
    /// η² undoes the compression of radiance inside a medium, which the way out reverses.
    #[inline(always)]
    pub(super) fn roulette<S: Sampler>(
        &self,
        dimension: Dimension,
        departure: Departure,
        walk: &mut Walk<C>,
        points: &S,
    ) -> Fate {
        let largest = walk.throughput.max_channel();
        // False for NaN, which goes on to be counted where it reaches the film.
        if largest <= 0.0 {
            return Fate::Ends;
        }
        if u32::from(departure.edges) < self.settings.roulette_depth {
            return Fate::Continues;
        }
        let survival = (departure.patience * largest * walk.eta * walk.eta).min(0.95);
        if points.sample_1d::<f32>(dimension) >= survival {
            return Fate::Ends;
        }
        walk.throughput = walk.throughput.scale(1.0 / survival);
        Fate::Continues
    }
}
