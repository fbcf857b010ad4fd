//! Pictures of distances.

use etendue_math::{Spectrum, Vector3};
use etendue_sampling::Sampler;
use etendue_scene::Color;
use etendue_scene::color::Primaries;
use etendue_scene::geometry::{Ray, Rays};

use super::transport::Transport;
use super::{PathTracer, Walk};
use crate::statistics::RayCounts;

/// No light at all: how far a camera ray goes from the near clipping plane to the first surface, in units of the scene and
/// in every channel; 0 where there is none.
pub(crate) enum Distances {}

impl Transport for Distances {
    const VOLUMES: bool = false;

    type Channels = Primaries;

    #[inline(always)]
    fn radiance<S: Sampler, R: Rays>(
        tracer: &PathTracer<'_, '_, R, Primaries>,
        camera_ray: Ray,
        _: &S,
        rays: &mut RayCounts,
    ) -> Color {
        rays.camera += 1;
        let mut walk = Walk::from_camera(camera_ray, Primaries);
        let Some(point) = tracer.next_surface(&mut walk, rays) else { return Color::black() };
        Color::splat(Vector3::length(point.position - camera_ray.origin))
    }
}
