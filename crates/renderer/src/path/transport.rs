//! What paths go through: surfaces alone, or volumes as well.

use etendue_sampling::Sampler;
use etendue_scene::Color;
use etendue_scene::geometry::{Ray, Rays};

use super::PathTracer;
use crate::statistics::RayCounts;

/// A configuration of the path tracer, compiled apart from the others.
///
/// Which one a scene needs is decided once per render, so that a scene without media runs code that
/// knows of none.
pub(crate) trait Transport {
    /// Whether there may be media, and surfaces that light passes straight on do not count.
    const VOLUMES: bool;

    /// An estimate of the radiance that arrives along a ray of the camera.
    fn radiance<S: Sampler, R: Rays>(
        tracer: &PathTracer<'_, '_, R>,
        camera_ray: Ray,
        points: &S,
        rays: &mut RayCounts,
    ) -> Color;
}

/// Empty space between surfaces.
pub(crate) enum Surfaces {}

/// Participating media between surfaces, and surfaces that bound them.
pub(crate) enum Volumes {}
