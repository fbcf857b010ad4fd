//! Paths from surface to surface.

use etendue_math::Spectrum;
use etendue_sampling::Sampler;
use etendue_scene::Color;
use etendue_scene::color::Primaries;
use etendue_scene::geometry::{Ray, Rays};
use etendue_scene::material::Varying;

use super::scatter::Departure;
use super::transport::{Surfaces, Transport};
use super::{Fate, PathTracer, Walk};
use crate::statistics::RayCounts;

impl Transport for Surfaces {
    const VOLUMES: bool = false;

    type Channels = Primaries;

    #[inline(always)]
    fn radiance<S: Sampler, R: Rays>(
        tracer: &PathTracer<'_, '_, R, Primaries>,
        camera_ray: Ray,
        points: &S,
        rays: &mut RayCounts,
    ) -> Color {
        let longest = tracer.longest();
        let mut radiance = Color::black();
        let mut walk = Walk::from_camera(camera_ray, Primaries);
        rays.camera += 1;
        for depth in 1..=longest {
            let Some(point) = tracer.next_surface(&mut walk, rays) else {
                radiance += walk.throughput * tracer.escaped(&walk);
                break;
            };
            radiance += walk.throughput * tracer.emitted(&walk, &point);
            if depth == longest {
                rays.cut(walk.throughput.max_channel());
                break;
            }
            let mut varying = Varying::default();
            let vertex = tracer.vertex(depth, &point, &walk, None, &mut varying);
            if tracer.is_inconsistent(&vertex, -walk.ray.direction, vertex.wo) {
                break;
            }
            radiance += walk.throughput * tracer.direct_light(&vertex, points, 1, rays);
            match tracer.scatter::<Self, S>(&vertex, Departure::after(depth), &mut walk, points) {
                Fate::Continues | Fate::Passes => rays.indirect += 1,
                Fate::Ends => break,
            }
        }
        radiance
    }
}
