//! What paths go through, and what they carry.

use core::marker::PhantomData;

use etendue_sampling::Sampler;
use etendue_scene::camera::Sight;
use etendue_scene::color::{Channels, Primaries, Wavelengths};
use etendue_scene::geometry::{Ray, Rays};
use etendue_scene::material::PreparedMaterials;
use etendue_scene::{Color, Scene};

use super::PathTracer;
use crate::statistics::RayCounts;

/// A configuration of the path tracer, compiled apart from the others.
///
/// Which one a scene needs is decided once per render, so that a scene without media runs code that
/// knows of none, and one without dispersion code that knows of no wavelengths.
pub(crate) trait Transport {
    /// Whether there may be media, and surfaces that light passes straight on do not count.
    const VOLUMES: bool;

    /// What paths carry.
    type Channels: Carried;

    /// An estimate of the radiance that arrives along a ray of the camera.
    fn radiance<S: Sampler, R: Rays>(
        tracer: &PathTracer<'_, '_, R, Self::Channels>,
        camera_ray: Ray,
        points: &S,
        rays: &mut RayCounts,
    ) -> Color;
}

/// Empty space between surfaces.
pub(crate) enum Surfaces {}

/// Participating media between surfaces, surfaces that bound them, and transparent bodies that overlap.
///
/// In primaries, or a few wavelengths at a time.
pub(crate) struct Volumes<C>(PhantomData<C>);

/// Channels that there are prepared materials for.
pub(crate) trait Carried: Channels {
    /// The materials for these channels.
    fn materials<'r, 'a>(prepared: &'r Prepared<'a>) -> &'r PreparedMaterials<'a, Self>;
}

impl Carried for Primaries {
    fn materials<'r, 'a>(prepared: &'r Prepared<'a>) -> &'r PreparedMaterials<'a> {
        &prepared.rgb
    }
}

impl Carried for Wavelengths {
    fn materials<'r, 'a>(prepared: &'r Prepared<'a>) -> &'r PreparedMaterials<'a, Self> {
        &prepared.spectral
    }
}

/// The materials of a scene for each kind of channels.
pub(crate) struct Prepared<'a> {
    pub(crate) rgb: PreparedMaterials<'a, Primaries>,
    pub(crate) spectral: PreparedMaterials<'a, Wavelengths>,
}

impl<'a> Prepared<'a> {
    pub(crate) fn new(scene: &'a Scene, samples_per_pixel: u32) -> Self {
        let Scene { materials, textures, geometry, camera, film, .. } = scene;
        let sight = Sight::new(camera, film, samples_per_pixel);
        Self {
            rgb: PreparedMaterials::new(materials, textures, geometry, sight),
            spectral: PreparedMaterials::new(materials, textures, geometry, sight),
        }
    }
}
