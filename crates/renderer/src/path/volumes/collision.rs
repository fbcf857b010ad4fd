//! What happens where a medium scatters.

use etendue_brdf::Density;
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_sampling::{Decision, Dimension, Sampler};
use etendue_scene::Color;
use etendue_scene::geometry::{Ray, Rays};

use super::course::Course;
use super::travel::Collision;
use crate::light_sampler::{Receiver, Sides};
use crate::path::{Arrival, Fate, LightSampling, PathTracer, View, Walk};
use crate::statistics::RayCounts;

impl Collision<'_> {
    fn receiver(&self) -> Receiver {
        Receiver { position: self.position, normal: Vec3::ZERO, sides: Sides::Around }
    }
}

impl<'s, R: Rays> PathTracer<'_, 's, R> {
    /// An estimate, by one light sample, of the light scattered towards the camera.
    #[inline(always)]
    pub(super) fn light_in_medium<S: Sampler>(
        &self,
        collision: &Collision<'s>,
        course: &Course<'s>,
        points: &S,
        rays: &mut RayCounts,
    ) -> Color {
        let Collision { medium, position, along, depth } = *collision;
        if self.light_sampling == LightSampling::Useless || !medium.samples_lights {
            return Color::black();
        }
        let Some(sample) = self.sample_light(depth, &collision.receiver(), points) else {
            return Color::black();
        };
        let phase = medium.phase.eval(along, sample.direction);
        let scale = match sample.density {
            Density::Delta(p) => 1.0 / p,
            Density::Continuous(p) => self.light_weight(p, phase) / p,
        };
        let light = sample.radiance.scale(phase * scale);
        if light.is_black() {
            return light;
        }
        let ray = match sample.target {
            Some(target) => Ray::between(position, target),
            None => Ray::new(position, sample.direction),
        };
        light * self.transmittance(ray, &sample, course.medium, depth, points, rays)
    }

    /// Chooses where the path goes on, and whether it does.
    #[inline(always)]
    pub(super) fn scatter_in_medium<S: Sampler>(
        &self,
        collision: &Collision<'s>,
        walk: &mut Walk,
        points: &S,
    ) -> Fate {
        let Collision { medium, position, along, depth } = *collision;
        let u = points.sample_2d(Dimension::vertex(depth, Decision::Phase));
        let (direction, density) = medium.phase.sample(along, u);
        walk.arrival = if medium.samples_lights {
            Arrival::Scattered { receiver: collision.receiver(), density }
        } else {
            Arrival::Certain
        };
        walk.view = View::Scattered;
        walk.ray = Ray::new(position, direction);
        self.roulette(depth, walk, points)
    }
}
