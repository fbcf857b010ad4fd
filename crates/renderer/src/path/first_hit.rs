//! The first surface that a camera ray meets.

use etendue_brdf::Bsdf;
use etendue_math::Spectrum;
use etendue_sampling::{Decision, Sampler};
use etendue_scene::Color;
use etendue_scene::color::Primaries;
use etendue_scene::geometry::{Ray, Rays, SurfacePoint};
use etendue_scene::material::Varying;

use super::{PathTracer, Walk};
use crate::statistics::RayCounts;

/// What a camera ray meets first.
pub(crate) struct FirstHit {
    pub(crate) point: SurfacePoint,
    /// An estimate of the directional albedo towards the camera.
    pub(crate) albedo: Color,
}

impl<R: Rays> PathTracer<'_, '_, R, Primaries> {
    /// The first surface on a ray of the camera; emitters hidden from it are looked through.
    ///
    /// The albedo is that of the closed form where the model has one. Otherwise it is the weight of the
    /// direction that a path with the same points would take, whose mean is the albedo.
    #[inline(always)]
    pub(crate) fn first_hit<S: Sampler>(&self, camera_ray: Ray, points: &S) -> Option<FirstHit> {
        let mut walk = Walk::from_camera(camera_ray, Primaries);
        let point = self.next_surface(&mut walk, &mut RayCounts::default())?;
        let mut varying = Varying::default();
        let vertex = self.vertex(1, &point, &walk, None, &mut varying);
        let albedo = vertex.bsdf.albedo(vertex.wo).unwrap_or_else(|| {
            let u_lobe = points.sample_1d(vertex.dimension(Decision::LobeChoice));
            let u = points.sample_2d(vertex.dimension(Decision::Direction));
            let sample = vertex.bsdf.sample(vertex.wo, u_lobe, u);
            sample.map_or(Color::black(), |sample| sample.weight)
        });
        Some(FirstHit { point, albedo })
    }
}
