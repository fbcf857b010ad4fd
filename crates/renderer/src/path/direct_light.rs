//! Light that comes straight from a sampled light.

use etendue_brdf::{Bsdf, Density};
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_sampling::{Decision, Dimension, Sampler, mis};
use etendue_scene::Color;
use etendue_scene::color::Channels;
use etendue_scene::geometry::{Rays, SurfacePoint};
use etendue_scene::light::LightSample;

use super::{LightSampling, PathTracer, Several, Vertex};
use crate::light_sampler::{LightChoice, Receiver};
use crate::settings::Strategy;
use crate::statistics::RayCounts;

impl<R: Rays, C: Channels> PathTracer<'_, '_, R, C> {
    /// An estimate, by one light sample of `of`, of the light scattered towards the camera.
    #[inline(always)]
    pub(super) fn direct_light<S: Sampler>(
        &self,
        vertex: &Vertex<'_, C>,
        points: &S,
        of: u32,
        rays: &mut RayCounts,
    ) -> C::Color {
        match self.unoccluded_light(vertex, points, of) {
            Some((light, sample)) if !self.occluded(vertex.point, &sample, rays) => light,
            _ => C::Color::black(),
        }
    }

    /// The same without regard to what lies between, and the light sample that it comes by; `None`
    /// for no light.
    #[inline(always)]
    pub(super) fn unoccluded_light<S: Sampler>(
        &self,
        vertex: &Vertex<'_, C>,
        points: &S,
        of: u32,
    ) -> Option<(C::Color, LightSample<C::Color>)> {
        if self.light_sampling == LightSampling::Useless || !vertex.bsdf.lobes().continuous {
            return None;
        }
        let (_, sample) =
            self.sample_light(vertex.depth, &vertex.receiver, vertex.channels, points)?;
        let wi = vertex.point.shading.to_local(sample.direction);
        if self.is_inconsistent(vertex, sample.direction, wi) {
            return None;
        }
        let (f, scattering_density) = vertex.eval_pdf(wi);
        let scale = match sample.density {
            Density::Delta(p) => 1.0 / p,
            Density::Continuous(p) => self.light_weight(p, scattering_density / of as f32) / p,
        };
        let light = (f * sample.radiance).scale(scale * wi.z.abs());
        (!light.is_black()).then_some((light, sample))
    }

    /// A light sample for the vertex with address `depth`, and the light that it is of; its density accounts for the choice of the
    /// light.
    #[inline(always)]
    pub(super) fn sample_light<S: Sampler>(
        &self,
        depth: u16,
        receiver: &Receiver,
        channels: C,
        points: &S,
    ) -> Option<(LightChoice, LightSample<C::Color>)> {
        let dimension = |decision| Dimension::vertex(depth, decision);
        let u = if self.lights.count() > 1 {
            points.sample_1d(dimension(Decision::LightChoice))
        } else {
            0.0
        };
        let choice = self.lights.choose(receiver, u)?;
        let u = points.sample_2d(dimension(Decision::LightPoint));
        let mut sample = self.scene.sample_light(
            choice.light,
            choice.primitive,
            receiver.position,
            u,
            channels,
        )?;
        sample.density = match sample.density {
            Density::Continuous(_)
                if sample.target.is_none() && self.several_infinite_lights == Several::Yes =>
            {
                let (radiance, density) =
                    self.over_all_infinite_lights(Receiver { ..*receiver }, sample.direction);
                let (radiance, density) = (channels.light(radiance), Density::Continuous(density));
                return Some((choice, LightSample { radiance, density, ..sample }));
            }
            Density::Continuous(p) => Density::Continuous(p * choice.probability),
            Density::Delta(p) => Density::Delta(p * choice.probability),
        };
        Some((choice, sample))
    }

    /// Radiance and density of a direction as if drawn from the mixture of all infinite lights: what
    /// the scattered ray that leaves the scene in this direction finds, too.
    ///
    /// Out of line, and with a copy of the receiver: a reference would keep it in memory on every path.
    #[inline(never)]
    fn over_all_infinite_lights(&self, receiver: Receiver, direction: Vec3) -> (Color, f32) {
        self.infinite_light(&receiver, direction)
    }

    /// Weight of light that light sampling has found and that scattering could have found.
    #[inline(always)]
    pub(super) fn light_weight(&self, light_density: f32, scattering_density: f32) -> f32 {
        match self.strategy {
            Strategy::Mis => mis::power(light_density, scattering_density),
            Strategy::LightOnly => 1.0,
            Strategy::BsdfOnly => 0.0,
        }
    }

    #[inline(always)]
    fn occluded(
        &self,
        point: &SurfacePoint,
        sample: &LightSample<C::Color>,
        rays: &mut RayCounts,
    ) -> bool {
        rays.shadow += 1;
        let ray = match sample.target {
            Some(target) => point.spawn_to(target),
            None => point.spawn(sample.direction),
        };
        self.rays.occluded(&ray)
    }
}
