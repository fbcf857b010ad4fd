//! Light that a ray has found: emitted by what it meets, or from where there is nothing.

use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_sampling::mis;
use etendue_scene::Color;
use etendue_scene::geometry::{Rays, SurfacePoint};
use etendue_scene::light::LightId;

use super::{Arrival, PathTracer, Walk};
use crate::light_sampler::Receiver;
use crate::settings::Strategy;

impl<R: Rays> PathTracer<'_, '_, R> {
    /// Light that the surface itself emits along the ray, weighted for how the ray was found.
    #[inline(always)]
    pub(super) fn emitted(&self, walk: &Walk, point: &SurfacePoint) -> Color {
        let direction = walk.ray.direction;
        let Some((light, radiance)) = self.scene.emitted(point, -direction) else {
            return Color::black();
        };
        radiance * self.weight_of_hit(walk.arrival, light, *point)
    }

    /// Out of line, and everything by value: few rays find a light, and a reference would keep what
    /// all of them carry in memory.
    #[inline(never)]
    fn weight_of_hit(&self, arrival: Arrival, light: LightId, point: SurfacePoint) -> f32 {
        self.scattering_weight(&arrival, |receiver| {
            self.lights.probability(receiver, light, point.primitive)
                * self.scene.light_pdf_hit(light, receiver.position, &point)
        })
    }

    /// Light from infinitely far away, weighted for how the ray was found.
    #[inline(always)]
    pub(super) fn escaped(&self, walk: &Walk) -> Color {
        // A ray that ends at the far clipping plane has seen nothing yet, but only cameras have one.
        if self.hides_emitters(walk) || self.scene.infinite_lights().is_empty() {
            return Color::black();
        }
        let (radiance, weight) = self.background(walk.arrival, walk.ray.direction);
        radiance * weight
    }

    /// What infinite lights send, and its weight; out of line, because it ends the path.
    #[inline(never)]
    fn background(&self, arrival: Arrival, direction: Vec3) -> (Color, f32) {
        let radiance = self.scene.background(direction);
        if radiance.is_black() {
            return (radiance, 0.0);
        }
        let density = |receiver: &Receiver| self.infinite_density(receiver, direction);
        (radiance, self.scattering_weight(&arrival, density))
    }

    /// Density with which light sampling draws a direction towards infinite lights.
    #[inline(always)]
    pub(super) fn infinite_density(&self, receiver: &Receiver, direction: Vec3) -> f32 {
        let density = |&light: &LightId| {
            self.lights.probability(receiver, light, 0)
                * self.scene.light_pdf_escaped(light, direction)
        };
        self.scene.infinite_lights().iter().map(density).sum()
    }

    /// Weight of light that a scattered ray has found and that light sampling would have found with
    /// density `light_density(receiver)`.
    #[inline(always)]
    fn scattering_weight(
        &self,
        arrival: &Arrival,
        light_density: impl FnOnce(&Receiver) -> f32,
    ) -> f32 {
        match (arrival, self.strategy) {
            (Arrival::Certain, _) | (_, Strategy::BsdfOnly) => 1.0,
            (_, Strategy::LightOnly) => 0.0,
            (Arrival::Scattered { receiver, density }, Strategy::Mis) => {
                mis::power(*density, light_density(receiver))
            }
        }
    }
}
