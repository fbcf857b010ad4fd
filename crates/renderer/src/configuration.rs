//! What is compiled apart: the sampler and what paths go through.

use etendue_sampling::{Independent, Sampler, Sobol};
use etendue_scene::Scene;
use etendue_scene::color::{Primaries, Wavelengths};
use etendue_scene::scene::{SamplerKind, Shows};

use crate::path::{Distances, Surfaces, Transport, Volumes};
use crate::render::Renderer;
use crate::settings::RenderSettings;

/// What a render was compiled for: the smallest configuration that covers what its scene calls for.
///
/// A larger one gives the same picture and takes longer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Configuration {
    /// Light between surfaces, in empty space.
    Surfaces,
    /// Participating media as well, surfaces that do not count on the way of light through them, and transparent bodies that
    /// overlap.
    Volumes,
    /// All of that, a few wavelengths at a time instead of three primaries.
    Spectral,
    /// No light: how far away things are.
    Distances,
}

impl Configuration {
    /// What a scene needs.
    pub(crate) fn of(scene: &Scene, settings: &RenderSettings) -> Self {
        if settings.path.shows == Shows::Distance {
            Self::Distances
        } else if settings.path.spectral || scene.has_dispersion() {
            Self::Spectral
        } else if settings.path.volumes && scene.has_volumes() || scene.materials.nest() {
            Self::Volumes
        } else {
            Self::Surfaces
        }
    }

    /// The largest in which a scene has the same bits. Surfaces that light passes straight on count where paths do not
    /// [know media](etendue_scene::scene::PathSettings::volumes): such a scene keeps its own.
    pub(crate) fn largest(scene: &Scene, settings: &RenderSettings) -> Self {
        match Self::of(scene, settings) {
            Self::Surfaces
                if Self::Volumes.is_compiled()
                    && (settings.path.volumes || !scene.has_volumes()) =>
            {
                Self::Volumes
            }
            own => own,
        }
    }

    /// Whether the program was compiled with it: the features `volumes` and `spectral` of this crate.
    pub fn is_compiled(self) -> bool {
        match self {
            Self::Surfaces | Self::Distances => true,
            Self::Volumes => cfg!(feature = "volumes"),
            Self::Spectral => cfg!(feature = "spectral"),
        }
    }

    /// Its name, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Surfaces => "surfaces",
            Self::Volumes => "volumes",
            Self::Spectral => "spectral",
            Self::Distances => "distances",
        }
    }
}

/// Work whose code depends on the sampler and on what paths go through.
pub(crate) trait Configured {
    /// What comes of it.
    type Output;
    /// Does it.
    fn run<S: Sampler, T: Transport>(self) -> Self::Output;
}

impl Renderer<'_> {
    /// Does a piece of work in the configuration of this render.
    pub(crate) fn configured<C: Configured>(&self, work: C) -> C::Output {
        match self.settings.sampler {
            SamplerKind::Independent => self.configured_with::<Independent, C>(work),
            SamplerKind::Sobol => self.configured_with::<Sobol, C>(work),
        }
    }

    fn configured_with<S: Sampler, C: Configured>(&self, work: C) -> C::Output {
        match self.configuration {
            // The conditions are known to the compiler, which leaves out what is not asked for.
            Configuration::Volumes if cfg!(feature = "volumes") => {
                work.run::<S, Volumes<Primaries>>()
            }
            Configuration::Spectral if cfg!(feature = "spectral") => {
                work.run::<S, Volumes<Wavelengths>>()
            }
            Configuration::Distances => work.run::<S, Distances>(),
            _ => work.run::<S, Surfaces>(),
        }
    }
}
