//! Unidirectional path tracing.

mod direct_light;
mod dispersion;
mod distances;
mod first_hit;
mod found_light;
mod reuse;
mod scatter;
mod surfaces;
mod transport;
mod volumes;

use etendue_brdf::Bsdf;
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_sampling::{Decision, Dimension};
use etendue_scene::Scene;
use etendue_scene::color::{Channels, Primaries};
use etendue_scene::geometry::{Hit, Ray, Rays, SurfacePoint};
use etendue_scene::light::Light;
use etendue_scene::material::{PreparedBsdf, PreparedMaterials, Side, Varying};
use etendue_scene::scene::PathSettings;

use crate::light_sampler::{LightSampler, PointLights, Receiver, Sides};
use crate::settings::Strategy;
use crate::statistics::RayCounts;

pub(crate) use distances::Distances;
pub(crate) use first_hit::FirstHit;
pub(crate) use reuse::{LightSamples, MOST, SharedPath};
pub(crate) use transport::{Carried, Prepared, Surfaces, Transport, Volumes};

/// Solves the rendering equation for one ray at a time.
///
/// ```text
/// L(x, ωo) = Le(x, ωo) + ∫ f(ωi, ωo) L(x', −ωi) |cos θi| dωi
/// ```
///
/// At every vertex one light sample and one scattered ray estimate the integral; light that both
/// can find is weighted by the power heuristic. What only one of them can find (point lights,
/// mirror directions) is known by the type of its density and counts in full.
///
/// # Source
/// Kajiya, "The Rendering Equation", SIGGRAPH 1986; Veach, "Robust Monte Carlo Methods for Light
/// Transport Simulation", 1997, chapters 9 and 10. Depth, roulette and hidden emitters count as
/// in Mitsuba 3's `path`, pass-through surfaces included: each is a vertex of its own. With volumes
/// they count as in its `volpath`: a surface that light passes straight on is no vertex.
#[derive(Clone, Copy)]
pub(crate) struct PathTracer<'a, 's, R, C: Channels = Primaries> {
    rays: R,
    scene: &'s Scene,
    materials: &'a PreparedMaterials<'s, C>,
    lights: &'a LightSampler,
    /// Those to be looked for along whole ways through media.
    point_lights: &'a PointLights,
    settings: PathSettings,
    strategy: Strategy,
    light_sampling: LightSampling,
    several_infinite_lights: Several,
    /// Whether there are transparent bodies that overlap.
    nests: bool,
}

/// Whether light sampling can contribute at all.
#[derive(Clone, Copy, PartialEq, Eq)]
enum LightSampling {
    Useful,
    Useless,
}

/// How many lights a direction that leaves the scene can belong to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Several {
    Yes,
    No,
}

/// How the present ray was found: what the light it finds counts for.
#[derive(Clone, Copy)]
enum Arrival {
    /// By the camera or a delta lobe: light sampling could not have found the same light.
    Certain,
    /// Scattered at a surface or in a medium, with a density per steradian.
    Scattered { receiver: Receiver, density: f32 },
}

/// What of the camera's view has been crossed so far.
#[derive(Clone, Copy, PartialEq, Eq)]
enum View {
    /// Nothing, or surfaces that let light pass unchanged.
    Unobstructed,
    /// A surface that scatters.
    Scattered,
}

/// A surface that a path has met.
struct Vertex<'a, C: Channels> {
    /// Its address: the number of edges from the camera to here, those that only pass included.
    depth: u16,
    point: &'a SurfacePoint,
    bsdf: &'a PreparedBsdf<'a, C>,
    /// Towards the camera, in the shading frame.
    wo: Vec3,
    receiver: Receiver,
    /// Those of the path, and how they fare, as in [`Walk`].
    channels: C,
    ratios: C::Color,
}

impl<C: Channels> Vertex<'_, C> {
    fn dimension(&self, decision: Decision) -> Dimension {
        Dimension::vertex(self.depth, decision)
    }
}

/// The state of a path under construction.
#[derive(Clone, Copy)]
struct Walk<C: Channels> {
    ray: Ray,
    channels: C,
    throughput: C::Color,
    /// The density of the path so far as if drawn by each channel, relative to the mean over all, by which the throughput is
    /// divided. All 1 where nothing that was drawn depends on the channel.
    ratios: C::Color,
    /// Product of the relative indices of refraction crossed: η of the present medium.
    eta: f32,
    arrival: Arrival,
    view: View,
}

impl<C: Channels> Walk<C> {
    #[inline(always)]
    fn from_camera(ray: Ray, channels: C) -> Self {
        Self {
            ray,
            channels,
            throughput: C::Color::white(),
            ratios: C::Color::white(),
            eta: 1.0,
            arrival: Arrival::Certain,
            view: View::Unobstructed,
        }
    }

    /// Takes account of an event drawn by one channel that has a density in each: 1 over the density with which the mixture of
    /// all channels would have drawn it.
    ///
    /// ```text
    /// 1 / mean(ratios · densities),   ratios ← ratios · densities / mean
    /// ```
    ///
    /// The balance heuristic over the channels. Densities need a common scale only.
    #[inline]
    fn weigh(&mut self, densities: C::Color) -> f32 {
        let joint = self.ratios * densities;
        let per_mean = 1.0 / joint.mean();
        self.ratios = joint.scale(per_mean);
        per_mean
    }

    /// Goes on behind a surface in the same direction.
    #[inline(always)]
    fn look_through(&mut self, hit: &Hit, point: &SurfacePoint, rays: &mut RayCounts) {
        let far_end = self.ray.at(self.ray.t_max);
        let onwards = point.spawn(self.ray.direction);
        // The far clipping plane stays where it is.
        let t_max = if far_end.is_finite() { self.ray.t_max - hit.t } else { f32::INFINITY };
        self.ray = Ray { t_max, ..onwards };
        rays.camera += 1;
    }
}

/// Whether a path goes on.
enum Fate {
    Continues,
    /// Straight on, as if there were no surface; told from the former only where that matters.
    Passes,
    Ends,
}

impl<'a, 's, R: Rays, C: Channels> PathTracer<'a, 's, R, C> {
    pub(crate) fn new(
        rays: R,
        scene: &'s Scene,
        materials: &'a PreparedMaterials<'s, C>,
        lights: &'a LightSampler,
        point_lights: &'a PointLights,
        settings: PathSettings,
        strategy: Strategy,
    ) -> Self {
        let has_delta_light = scene.lights.iter().any(Light::is_delta);
        let useful = lights.count() > 0 && (strategy != Strategy::BsdfOnly || has_delta_light);
        let light_sampling = if useful { LightSampling::Useful } else { LightSampling::Useless };
        let several_infinite_lights =
            if scene.infinite_lights().len() > 1 { Several::Yes } else { Several::No };
        Self {
            rays,
            scene,
            materials,
            lights,
            point_lights,
            settings,
            strategy,
            light_sampling,
            several_infinite_lights,
            nests: scene.materials.nest(),
        }
    }

    /// The same for paths at another moment, in shares of the exposure.
    #[inline(always)]
    pub(crate) fn at(&self, time: f32) -> Self {
        Self { rays: self.rays.at(time), ..*self }
    }

    /// The largest number of edges of a path.
    ///
    /// `u16::MAX` at the latest: random numbers have no more addresses.
    #[inline(always)]
    fn longest(&self) -> u16 {
        self.settings.max_depth.unwrap_or(u32::MAX).min(u32::from(u16::MAX)) as u16
    }

    /// The surface that the ray meets; a camera that must not see emitters looks through them.
    #[inline(always)]
    fn next_surface(&self, walk: &mut Walk<C>, rays: &mut RayCounts) -> Option<SurfacePoint> {
        loop {
            let hit = self.rays.intersect(&walk.ray)?;
            let point = self.scene.geometry.surface_point(&walk.ray, &hit);
            if !(self.hides_emitters(walk) && self.is_emitter(&point)) {
                return Some(point);
            }
            walk.look_through(&hit, &point, rays);
        }
    }

    #[inline(always)]
    fn hides_emitters(&self, walk: &Walk<C>) -> bool {
        self.settings.hide_emitters && walk.view == View::Unobstructed
    }

    #[inline(always)]
    fn is_emitter(&self, point: &SurfacePoint) -> bool {
        self.scene.surfaces[point.shape.0 as usize].light.is_some()
    }

    /// The vertex at a point.
    ///
    /// * `exterior`: index of refraction outside of a body among others, where the surface is one of those.
    /// * `varying` holds the reflection model where textures or bodies make it one of its own.
    #[inline(always)]
    fn vertex<'v>(
        &'v self,
        depth: u16,
        point: &'v SurfacePoint,
        walk: &Walk<C>,
        exterior: Option<f32>,
        varying: &'v mut Varying<'v, C>,
    ) -> Vertex<'v, C> {
        let Walk { channels, ratios, .. } = *walk;
        let wo = point.shading.to_local(-walk.ray.direction);
        let side = Side::of(wo);
        let material = self.scene.surfaces[point.shape.0 as usize].material;
        let bsdf = match exterior {
            None => self.materials.at(material, point, side, channels, varying),
            // A copy field by field: a reference would keep the point of every path in memory.
            Some(_) => {
                let point = SurfacePoint { ..*point };
                self.materials.at_surface(material, point, side, channels, exterior, varying)
            }
        };
        let normal = if wo.z < 0.0 { -point.shading.n } else { point.shading.n };
        let sides = if bsdf.lobes().transmission { Sides::Both } else { Sides::Front };
        let receiver = Receiver { position: point.position, normal, sides };
        Vertex { depth, point, bsdf, wo, receiver, channels, ratios }
    }
}
