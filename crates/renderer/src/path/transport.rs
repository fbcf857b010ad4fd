//! What paths go through: surfaces alone, or volumes as well.

use etendue_sampling::Sampler;
use etendue_scene::geometry::{Ray, Rays};
use etendue_scene::{Color, Scene};

use super::PathTracer;
use crate::settings::RenderSettings;
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

/// What a render was compiled for: the smallest configuration that covers what its scene calls for.
///
/// A larger one gives the same picture and takes longer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Configuration {
    /// Light between surfaces, in empty space.
    Surfaces,
    /// Participating media as well, and surfaces that do not count on the way of light through them.
    Volumes,
}

impl Configuration {
    /// What a scene needs.
    pub(crate) fn of(scene: &Scene, settings: &RenderSettings) -> Self {
        if settings.path.volumes && scene.has_volumes() { Self::Volumes } else { Self::Surfaces }
    }

    /// The largest in which a scene has the same picture. Surfaces that light passes straight on count where paths do not
    /// [know media](etendue_scene::scene::PathSettings::volumes): such a scene keeps its own.
    pub(crate) fn largest(scene: &Scene, settings: &RenderSettings) -> Self {
        if settings.path.volumes || !scene.has_volumes() { Self::Volumes } else { Self::Surfaces }
    }

    /// Its name, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Surfaces => "surfaces",
            Self::Volumes => "volumes",
        }
    }
}
