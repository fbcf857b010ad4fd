//! What happens where a medium scatters.

use etendue_brdf::Density;
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_sampling::{Decision, Dimension, Sampler};
use etendue_scene::color::Channels;
use etendue_scene::geometry::{Ray, Rays};

use super::airlight::Beam;
use super::shadow::Shadowed;
use super::travel::Collision;
use crate::light_sampler::{Receiver, Sides};
use crate::path::scatter::Departure;
use crate::path::{Arrival, Fate, LightSampling, PathTracer, View, Walk};

/// A point that scatters from everywhere alike.
pub(super) fn around(position: Vec3) -> Receiver {
    Receiver { position, normal: Vec3::ZERO, sides: Sides::Around }
}

impl<'s, R: Rays, C: Channels> PathTracer<'_, 's, R, C> {
    /// By one light sample, the light scattered towards the camera if nothing is in its way.
    ///
    /// * `beam`: on which the collision lies, where light on it is looked for as well.
    #[inline(always)]
    pub(super) fn light_in_medium<S: Sampler>(
        &self,
        collision: &Collision<'s>,
        beam: Option<&Beam<'s, C>>,
        channels: C,
        points: &S,
    ) -> Option<Shadowed<'s, C>> {
        let Collision { medium, position, along, depth } = *collision;
        if self.light_sampling == LightSampling::Useless || !medium.samples_lights {
            return None;
        }
        let (choice, sample) = self.sample_light(depth, &around(position), channels, points)?;
        let phase = medium.phase.eval(position, along, sample.direction);
        let scale = match sample.density {
            Density::Delta(p) => {
                let weight = |beam| self.collision_weight(beam, position, choice.light, p);
                beam.map_or(1.0, weight) / p
            }
            Density::Continuous(p) => self.light_weight(p, phase) / p,
        };
        let light = sample.radiance.scale(phase * scale);
        let ray = match sample.target {
            Some(target) => Ray::between(position, target),
            None => Ray::new(position, sample.direction),
        };
        let shadowed =
            Shadowed { light, ray, target: sample.target, medium: Some(medium), channels };
        (!light.is_black()).then_some(shadowed)
    }

    /// Chooses where the path goes on, and whether it does; `edges` lead from the camera to here.
    #[inline(always)]
    pub(super) fn scatter_in_medium<S: Sampler>(
        &self,
        collision: &Collision<'s>,
        edges: u16,
        walk: &mut Walk<C>,
        points: &S,
    ) -> Fate {
        let Collision { medium, position, along, depth } = *collision;
        let u = points.sample_2d(Dimension::vertex(depth, Decision::Phase));
        let (direction, density) = medium.phase.sample(position, along, u);
        walk.arrival = if medium.samples_lights {
            Arrival::Scattered { receiver: around(position), density }
        } else {
            Arrival::Certain
        };
        walk.view = View::Scattered;
        walk.ray = Ray::new(position, direction);
        let departure = Departure::after(edges);
        self.roulette(Dimension::vertex(depth, Decision::Roulette), departure, walk, points)
    }
}
