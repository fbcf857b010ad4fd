//! Light that a ray has found: emitted by what it meets, or from where there is nothing.

use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_sampling::mis;
use etendue_scene::Color;
use etendue_scene::color::Channels;
use etendue_scene::geometry::{Rays, SurfacePoint};
use etendue_scene::light::LightId;

use super::{Arrival, PathTracer, Walk};
use crate::light_sampler::Receiver;
use crate::settings::Strategy;

impl<R: Rays, C: Channels> PathTracer<'_, '_, R, C> {
    /// Light that the surface itself emits along the ray, weighted for how the ray was found.
    #[inline(always)]
    pub(super) fn emitted(&self, walk: &Walk<C>, point: &SurfacePoint) -> C::Color {
        let direction = walk.ray.direction;
        let Some((light, radiance)) = self.scene.emitted(point, -direction, walk.channels) else {
            return C::Color::black();
        };
        let weight = match walk.arrival {
            Arrival::Certain => 1.0,
            Arrival::Scattered { receiver, density } => {
                let (receiver, point) = (Receiver { ..receiver }, SurfacePoint { ..*point });
                self.weight_of_hit(receiver, density, light, point)
            }
        };
        radiance.scale(weight)
    }

    /// The weight of light that a scattered ray has found on a surface.
    ///
    /// Out of line, because few rays do, and with copies field by field: a reference would keep what
    /// every path carries in memory, and so would a copy that the compiler sees through.
    #[inline(never)]
    fn weight_of_hit(
        &self,
        receiver: Receiver,
        density: f32,
        light: LightId,
        point: SurfacePoint,
    ) -> f32 {
        self.scattering_weight(density, || {
            self.lights.probability(&receiver, light, point.primitive)
                * self.scene.light_pdf_hit(light, receiver.position, &point)
        })
    }

    /// Light from infinitely far away, weighted for how the ray was found.
    #[inline(always)]
    pub(super) fn escaped(&self, walk: &Walk<C>) -> C::Color {
        // A ray that ends at the far clipping plane has seen nothing yet, but only cameras have one.
        if self.hides_emitters(walk) || self.scene.infinite_lights().is_empty() {
            return C::Color::black();
        }
        let radiance = match walk.arrival {
            Arrival::Certain => self.scene.background(walk.ray.direction),
            Arrival::Scattered { receiver, density } => {
                self.found_background(Receiver { ..receiver }, density, walk.ray.direction)
            }
        };
        walk.channels.light(radiance)
    }

    /// Light that a scattered ray has found by leaving the scene, weighted; out of line as well.
    #[inline(never)]
    fn found_background(&self, receiver: Receiver, density: f32, direction: Vec3) -> Color {
        let (radiance, light_density) = self.infinite_light(&receiver, direction);
        radiance * self.scattering_weight(density, || light_density)
    }

    /// Radiance from infinitely far away, and the density with which light sampling draws the direction: as if from the mixture of
    /// all infinite lights.
    #[inline]
    pub(super) fn infinite_light(&self, receiver: &Receiver, direction: Vec3) -> (Color, f32) {
        self.scene.infinite_lights().iter().fold((Color::black(), 0.0), |(sum, sum_pdf), &light| {
            let (radiance, pdf) = self.scene.escaped(light, direction);
            (sum + radiance, sum_pdf + self.lights.probability(receiver, light, 0) * pdf)
        })
    }

    /// Weight of light that a ray scattered with a density has found and that light sampling would
    /// have found with density `light_density()`.
    #[inline]
    fn scattering_weight(&self, density: f32, light_density: impl FnOnce() -> f32) -> f32 {
        match self.strategy {
            Strategy::BsdfOnly => 1.0,
            Strategy::LightOnly => 0.0,
            Strategy::Mis => mis::power(density, light_density()),
        }
    }
}
