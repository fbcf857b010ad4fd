//! Light of single points that a homogeneous medium scatters towards a ray.

use etendue_math::glam::Vec3;
use etendue_math::{Real, Spectrum};
use etendue_sampling::warp::equiangular::Equiangular;
use etendue_sampling::{Decision, Dimension, Sampler, mis};
use etendue_scene::Scene;
use etendue_scene::color::Channels;
use etendue_scene::geometry::{Ray, Rays};
use etendue_scene::light::LightId;
use etendue_scene::medium::Medium;

use super::collision::around;
use super::shadow::Shadowed;
use crate::light_sampler::PointLight;
use crate::path::{PathTracer, Walk};

/// A stretch of a ray through a homogeneous medium, whole: as far as there is no surface.
///
/// Where along it light of a single point is scattered is found in two ways: at a collision, whose distance is drawn by
/// the transmittance, and at a distance drawn by the inverse square of that from the light. Both could have found the
/// other's point with the other's light, and share it by the power heuristic:
///
/// ```text
/// by collisions   p(s) P(light | s),   p(s) = mean over channels of ratio · σ exp(−σ s)
/// about lights    P(light) q(s | light)
/// ```
///
/// # Source
/// Kulla, Fajardo, "Importance Sampling Techniques for Path Tracing in Participating Media", EGSR 2012.
pub(super) struct Beam<'s, C: Channels> {
    medium: &'s Medium,
    sigma: C::Color,
    origin: Vec3,
    /// Unit direction.
    along: Vec3,
    length: f32,
    /// Of the path as far as the origin.
    throughput: C::Color,
    ratios: C::Color,
}

impl<'s, C: Channels> Beam<'s, C> {
    /// From the origin of the path's ray to its parameter `end`; `None` for a direction without length.
    #[inline]
    pub(super) fn new(
        medium: &'s Medium,
        sigma: C::Color,
        walk: &Walk<C>,
        end: f32,
    ) -> Option<Self> {
        let Walk { ray, throughput, ratios, .. } = *walk;
        let along = ray.direction.try_normalize()?;
        let length = end * ray.direction.length();
        Some(Self { medium, sigma, origin: ray.origin, along, length, throughput, ratios })
    }

    /// Density of a collision at a distance, as the mixture of all channels draws it.
    #[inline]
    fn collision_density(&self, distance: f32) -> f32 {
        (self.ratios * self.sigma * self.transmittance(distance)).mean()
    }

    #[inline]
    fn transmittance(&self, distance: f32) -> C::Color {
        self.sigma.map(|sigma| Real::exp(-sigma * distance))
    }

    /// Distances about a light, on what it lights of the beam.
    #[inline]
    fn about(&self, scene: &Scene, point: PointLight) -> Option<About> {
        let light = scene.lights.get(point.light.0 as usize)?;
        let [start, end] = light.lit_stretch(self.origin, self.along, self.length)?;
        let to_light = point.position - (self.origin + self.along * start);
        let distances = Equiangular::new(to_light, self.along, end - start)?;
        Some(About { start, distances })
    }
}

/// Distances along a beam, drawn about a light.
struct About {
    /// Where it begins to light the beam.
    start: f32,
    /// From there.
    distances: Equiangular<f32>,
}

impl About {
    #[inline]
    fn distance(&self, u: f32) -> f32 {
        self.start + self.distances.from_unit(u)
    }

    #[inline]
    fn density(&self, distance: f32) -> f32 {
        self.distances.pdf(distance - self.start)
    }
}

impl<'s, R: Rays, C: Channels> PathTracer<'_, 's, R, C> {
    /// Whether light of single points is looked for along the whole way through a homogeneous medium. Not where there are
    /// none, nor where a way may go on behind an emitter that is not seen.
    #[inline]
    pub(super) fn has_beams(&self, medium: &Medium, walk: &Walk<C>) -> bool {
        !self.point_lights.is_empty() && medium.samples_lights && !self.hides_emitters(walk)
    }

    /// The weight of a light that was found from a collision on the beam, chosen there with a probability.
    pub(super) fn collision_weight(
        &self,
        beam: &Beam<'s, C>,
        position: Vec3,
        light: LightId,
        probability: f32,
    ) -> f32 {
        let about = |point| Some((point, beam.about(self.scene, point)?));
        let Some((point, about)) = self.point_lights.get(light).and_then(about) else { return 1.0 };
        let distance = position.distance(beam.origin);
        let own = beam.collision_density(distance) * probability;
        mis::power(own, point.probability * about.density(distance))
    }

    /// Light that the beam scatters towards its origin from a point near one of the lights, and the throughput there, if
    /// nothing is in the way.
    ///
    /// * `depth`: the address of the vertex at its end.
    #[inline(never)]
    pub(super) fn light_on_beam<S: Sampler>(
        &self,
        beam: &Beam<'s, C>,
        depth: u16,
        channels: C,
        points: &S,
    ) -> Option<(C::Color, Shadowed<'s, C>)> {
        let [u, v] = points.sample_2d(Dimension::vertex(depth, Decision::Airlight));
        let point = self.point_lights.choose(u)?;
        let about = beam.about(self.scene, point)?;
        let distance = about.distance(v);
        let position = beam.origin + beam.along * distance;
        let sample = self.scene.sample_light(point.light, 0, position, [0.0; 2], channels)?;
        let Beam { medium, sigma, along, .. } = *beam;
        let own = point.probability * about.density(distance);
        // Rounded over an end.
        if own == 0.0 {
            return None;
        }
        let other = beam.collision_density(distance)
            * self.lights.probability(&around(position), point.light, 0);
        let phase = medium.phase.eval(position, along, sample.direction);
        let scattered = sigma * medium.albedo_at(position, channels);
        let light = (scattered * beam.transmittance(distance) * sample.radiance)
            .scale(phase * mis::power(own, other) / own);
        let ray = Ray::between(position, sample.target?);
        let shadowed =
            Shadowed { light, ray, target: sample.target, medium: Some(medium), channels };
        (!light.is_black()).then_some((beam.throughput, shadowed))
    }
}
