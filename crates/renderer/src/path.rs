//! Unidirectional path tracing.

use etendue_brdf::{Bsdf, Density};
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_sampling::{Decision, Dimension, Sampler, mis};
use etendue_scene::geometry::{Ray, SurfacePoint};
use etendue_scene::light::{Light, LightId, LightSample};
use etendue_scene::material::PreparedBsdf;
use etendue_scene::scene::PathSettings;
use etendue_scene::{Color, Scene};

use crate::light_sampler::{LightSampler, Receiver, Sides};
use crate::settings::Strategy;
use crate::statistics::RayCounts;

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
/// in Mitsuba 3's `path`, pass-through surfaces included: each is a vertex of its own.
#[derive(Clone, Copy)]
pub(crate) struct PathTracer<'a> {
    scene: &'a Scene,
    lights: &'a LightSampler,
    settings: PathSettings,
    strategy: Strategy,
    light_sampling: LightSampling,
    several_infinite_lights: Several,
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
    /// Scattered at a surface, with a density per steradian.
    Scattered { receiver: Receiver, position: Vec3, density: f32 },
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
struct Vertex<'a> {
    /// Number of edges from the camera to here.
    depth: u16,
    point: SurfacePoint,
    bsdf: PreparedBsdf<'a>,
    /// Towards the camera, in the shading frame.
    wo: Vec3,
    receiver: Receiver,
}

impl Vertex<'_> {
    fn dimension(&self, decision: Decision) -> Dimension {
        Dimension::vertex(self.depth, decision)
    }
}

/// The state of a path under construction.
struct Walk {
    ray: Ray,
    throughput: Color,
    /// Product of the relative indices of refraction crossed: η of the present medium.
    eta: f32,
    arrival: Arrival,
    view: View,
}

/// Whether a path goes on.
enum Fate {
    Continues,
    Ends,
}

impl<'a> PathTracer<'a> {
    pub(crate) fn new(
        scene: &'a Scene,
        lights: &'a LightSampler,
        settings: PathSettings,
        strategy: Strategy,
    ) -> Self {
        let has_delta_light = scene.lights.iter().any(Light::is_delta);
        let useful = lights.count() > 0 && (strategy != Strategy::BsdfOnly || has_delta_light);
        let light_sampling = if useful { LightSampling::Useful } else { LightSampling::Useless };
        let several_infinite_lights =
            if scene.infinite_lights().len() > 1 { Several::Yes } else { Several::No };
        Self { scene, lights, settings, strategy, light_sampling, several_infinite_lights }
    }

    /// An estimate of the radiance that arrives along a ray of the camera.
    ///
    /// Paths end after `u16::MAX` edges at the latest: random numbers have no more addresses.
    pub(crate) fn radiance<S: Sampler>(
        &self,
        camera_ray: Ray,
        points: &S,
        rays: &mut RayCounts,
    ) -> Color {
        let longest = self.settings.max_depth.unwrap_or(u32::MAX).min(u32::from(u16::MAX)) as u16;
        let mut radiance = Color::black();
        let mut walk = Walk {
            ray: camera_ray,
            throughput: Color::white(),
            eta: 1.0,
            arrival: Arrival::Certain,
            view: View::Unobstructed,
        };
        rays.camera += 1;
        for depth in 1..=longest {
            let Some(point) = self.next_surface(&mut walk, rays) else {
                radiance += walk.throughput * self.escaped(&walk);
                break;
            };
            radiance += walk.throughput * self.emitted(&walk, &point);
            if depth == longest {
                break;
            }
            let vertex = self.vertex(depth, point, walk.ray.direction);
            if self.is_inconsistent(&vertex, -walk.ray.direction, vertex.wo) {
                break;
            }
            radiance += walk.throughput * self.direct_light(&vertex, points, rays);
            match self.scatter(&vertex, &mut walk, points) {
                Fate::Continues => rays.indirect += 1,
                Fate::Ends => break,
            }
        }
        radiance
    }

    /// The surface that the ray meets; a camera that must not see emitters looks through them.
    fn next_surface(&self, walk: &mut Walk, rays: &mut RayCounts) -> Option<SurfacePoint> {
        loop {
            let hit = self.scene.geometry.intersect(&walk.ray)?;
            let point = self.scene.geometry.surface_point(&walk.ray, &hit);
            if !(self.hides_emitters(walk) && self.is_emitter(&point)) {
                return Some(point);
            }
            let far_end = walk.ray.at(walk.ray.t_max);
            let onwards = point.spawn(walk.ray.direction);
            // The far clipping plane stays where it is.
            let t_max = if far_end.is_finite() { walk.ray.t_max - hit.t } else { f32::INFINITY };
            walk.ray = Ray { t_max, ..onwards };
            rays.camera += 1;
        }
    }

    fn hides_emitters(&self, walk: &Walk) -> bool {
        self.settings.hide_emitters && walk.view == View::Unobstructed
    }

    fn is_emitter(&self, point: &SurfacePoint) -> bool {
        self.scene.surfaces[point.shape.0 as usize].light.is_some()
    }

    fn vertex(&self, depth: u16, point: SurfacePoint, direction: Vec3) -> Vertex<'a> {
        let bsdf = self.scene.prepare(&point);
        let wo = point.shading.to_local(-direction);
        let normal = if wo.z < 0.0 { -point.shading.n } else { point.shading.n };
        let sides = if bsdf.lobes().transmission { Sides::Both } else { Sides::Front };
        let receiver = Receiver { position: point.position, normal, sides };
        Vertex { depth, point, bsdf, wo, receiver }
    }

    /// Light that the surface itself emits along the ray, weighted for how the ray was found.
    fn emitted(&self, walk: &Walk, point: &SurfacePoint) -> Color {
        let direction = walk.ray.direction;
        let Some((light, radiance)) = self.scene.emitted(point, -direction) else {
            return Color::black();
        };
        let weight = self.scattering_weight(&walk.arrival, |receiver, from| {
            self.lights.probability(receiver, light, point.primitive)
                * self.scene.light_pdf_hit(light, from, point)
        });
        radiance * weight
    }

    /// Light from infinitely far away, weighted for how the ray was found.
    fn escaped(&self, walk: &Walk) -> Color {
        let direction = walk.ray.direction;
        // A ray that ends at the far clipping plane has seen nothing yet, but only cameras have one.
        if self.hides_emitters(walk) || self.scene.infinite_lights().is_empty() {
            return Color::black();
        }
        let radiance = self.scene.background(direction);
        if radiance.is_black() {
            return radiance;
        }
        let density = |receiver: &Receiver, _| self.infinite_density(receiver, direction);
        radiance * self.scattering_weight(&walk.arrival, density)
    }

    /// Density with which light sampling draws a direction towards infinite lights.
    fn infinite_density(&self, receiver: &Receiver, direction: Vec3) -> f32 {
        let density = |&light: &LightId| {
            self.lights.probability(receiver, light, 0)
                * self.scene.light_pdf_escaped(light, direction)
        };
        self.scene.infinite_lights().iter().map(density).sum()
    }

    /// Weight of light that a scattered ray has found and that light sampling would have found with
    /// density `light_density(receiver, position)`.
    fn scattering_weight(
        &self,
        arrival: &Arrival,
        light_density: impl FnOnce(&Receiver, Vec3) -> f32,
    ) -> f32 {
        match (arrival, self.strategy) {
            (Arrival::Certain, _) | (_, Strategy::BsdfOnly) => 1.0,
            (_, Strategy::LightOnly) => 0.0,
            (Arrival::Scattered { receiver, position, density }, Strategy::Mis) => {
                mis::power(*density, light_density(receiver, *position))
            }
        }
    }

    /// An estimate, by one light sample, of the light scattered towards the camera.
    fn direct_light<S: Sampler>(
        &self,
        vertex: &Vertex<'_>,
        points: &S,
        rays: &mut RayCounts,
    ) -> Color {
        if self.light_sampling == LightSampling::Useless || !vertex.bsdf.lobes().continuous {
            return Color::black();
        }
        let Some((sample, probability)) = self.sample_light(vertex, points) else {
            return Color::black();
        };
        let wi = vertex.point.shading.to_local(sample.direction);
        if self.is_inconsistent(vertex, sample.direction, wi) {
            return Color::black();
        }
        let (f, scattering_density) = vertex.bsdf.eval_pdf(vertex.wo, wi);
        let scale = match sample.density {
            Density::Delta(p) => 1.0 / (p * probability),
            Density::Continuous(p) => {
                let density = p * probability;
                self.light_weight(density, scattering_density) / density
            }
        };
        let light = f * sample.radiance * (scale * wi.z.abs());
        if light.is_black() || self.occluded(&vertex.point, &sample, rays) {
            return Color::black();
        }
        light
    }

    /// A light sample and the probability of having chosen its light.
    fn sample_light<S: Sampler>(
        &self,
        vertex: &Vertex<'_>,
        points: &S,
    ) -> Option<(LightSample, f32)> {
        let u = if self.lights.count() > 1 {
            points.sample_1d(vertex.dimension(Decision::LightChoice))
        } else {
            0.0
        };
        let choice = self.lights.choose(&vertex.receiver, u)?;
        let u = points.sample_2d(vertex.dimension(Decision::LightPoint));
        let sample = self.scene.sample_light(choice.light, choice.primitive, &vertex.point, u)?;
        match sample.density {
            Density::Continuous(_)
                if sample.target.is_none() && self.several_infinite_lights == Several::Yes =>
            {
                Some((self.over_all_infinite_lights(&vertex.receiver, &sample), 1.0))
            }
            _ => Some((sample, choice.probability)),
        }
    }

    /// The same direction as if drawn from the mixture of all infinite lights: what the scattered
    /// ray that leaves the scene in this direction finds, too.
    fn over_all_infinite_lights(&self, receiver: &Receiver, sample: &LightSample) -> LightSample {
        LightSample {
            radiance: self.scene.background(sample.direction),
            density: Density::Continuous(self.infinite_density(receiver, sample.direction)),
            ..*sample
        }
    }

    /// Weight of light that light sampling has found and that scattering could have found.
    fn light_weight(&self, light_density: f32, scattering_density: f32) -> f32 {
        match self.strategy {
            Strategy::Mis => mis::power(light_density, scattering_density),
            Strategy::LightOnly => 1.0,
            Strategy::BsdfOnly => 0.0,
        }
    }

    fn occluded(&self, point: &SurfacePoint, sample: &LightSample, rays: &mut RayCounts) -> bool {
        rays.shadow += 1;
        let ray = match sample.target {
            Some(target) => point.spawn_to(target),
            None => point.spawn(sample.direction),
        };
        self.scene.geometry.occluded(&ray)
    }

    /// Chooses where the path goes on, and whether it does.
    fn scatter<S: Sampler>(&self, vertex: &Vertex<'_>, walk: &mut Walk, points: &S) -> Fate {
        let u_lobe = points.sample_1d(vertex.dimension(Decision::LobeChoice));
        let u = points.sample_2d(vertex.dimension(Decision::Direction));
        let Some(sample) = vertex.bsdf.sample(vertex.wo, u_lobe, u) else { return Fate::Ends };
        walk.throughput = walk.throughput * sample.weight;
        walk.eta *= sample.eta;
        walk.arrival = match sample.density {
            Density::Delta(_) => Arrival::Certain,
            Density::Continuous(density) => Arrival::Scattered {
                receiver: vertex.receiver,
                position: vertex.point.position,
                density,
            },
        };
        // A pass-through is the one delta direction that goes straight on.
        if !(matches!(sample.density, Density::Delta(_)) && sample.wi == -vertex.wo) {
            walk.view = View::Scattered;
        }
        let direction = vertex.point.shading.to_world(sample.wi);
        if self.is_inconsistent(vertex, direction, sample.wi) {
            return Fate::Ends;
        }
        walk.ray = vertex.point.spawn(direction);
        self.roulette(vertex, walk, points)
    }

    /// Whether strict normals forbid a direction, given in world and local coordinates: it lies on
    /// different sides of the surface and of its interpolated normal.
    fn is_inconsistent(&self, vertex: &Vertex<'_>, world: Vec3, local: Vec3) -> bool {
        self.settings.strict_normals && world.dot(vertex.point.normal) * local.z <= 0.0
    }

    /// Russian roulette: ends paths that carry little and scales up the others.
    ///
    /// ```text
    /// q = min(max(throughput) η², 0.95)
    /// ```
    ///
    /// η² undoes the compression of radiance inside a medium, which the way out reverses.
    fn roulette<S: Sampler>(&self, vertex: &Vertex<'_>, walk: &mut Walk, points: &S) -> Fate {
        let largest = walk.throughput.max_channel();
        // False for NaN, which goes on to be counted where it reaches the film.
        if largest <= 0.0 {
            return Fate::Ends;
        }
        if u32::from(vertex.depth) < self.settings.roulette_depth {
            return Fate::Continues;
        }
        let survival = (largest * walk.eta * walk.eta).min(0.95);
        if points.sample_1d::<f32>(vertex.dimension(Decision::Roulette)) >= survival {
            return Fate::Ends;
        }
        walk.throughput = walk.throughput.scale(1.0 / survival);
        Fate::Continues
    }
}
