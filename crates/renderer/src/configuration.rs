//! What is compiled apart: the sampler and what paths go through.

use etendue_sampling::{Independent, Sampler, Sobol};
use etendue_scene::Scene;
use etendue_scene::scene::SamplerKind;

use crate::path::{Spectral, Surfaces, Transport, Volumes};
use crate::render::Renderer;
use crate::settings::RenderSettings;

/// What a render was compiled for: the smallest configuration that covers what its scene calls for.
///
/// A larger one gives the same picture and takes longer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Configuration {
    /// Light between surfaces, in empty space.
    Surfaces,
    /// Participating media as well, and surfaces that do not count on the way of light through them.
    Volumes,
    /// All of that, a few wavelengths at a time instead of three primaries.
    Spectral,
}

impl Configuration {
    /// What a scene needs.
    pub(crate) fn of(scene: &Scene, settings: &RenderSettings) -> Self {
        if settings.path.spectral || scene.has_dispersion() {
            Self::Spectral
        } else if settings.path.volumes && scene.has_volumes() {
            Self::Volumes
        } else {
            Self::Surfaces
        }
    }

    /// The largest in which a scene has the same bits. Surfaces that light passes straight on count where paths do not
    /// [know media](etendue_scene::scene::PathSettings::volumes): such a scene keeps its own.
    pub(crate) fn largest(scene: &Scene, settings: &RenderSettings) -> Self {
        match Self::of(scene, settings) {
            Self::Surfaces if settings.path.volumes || !scene.has_volumes() => Self::Volumes,
            own => own,
        }
    }

    /// Its name, in lower case.
    pub fn name(self) -> &'static str {
        match self {
            Self::Surfaces => "surfaces",
            Self::Volumes => "volumes",
            Self::Spectral => "spectral",
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
        match (self.settings.sampler, self.configuration) {
            (SamplerKind::Independent, Configuration::Surfaces) => {
                work.run::<Independent, Surfaces>()
            }
            (SamplerKind::Independent, Configuration::Volumes) => {
                work.run::<Independent, Volumes>()
            }
            (SamplerKind::Independent, Configuration::Spectral) => {
                work.run::<Independent, Spectral>()
            }
            (SamplerKind::Sobol, Configuration::Surfaces) => work.run::<Sobol, Surfaces>(),
            (SamplerKind::Sobol, Configuration::Volumes) => work.run::<Sobol, Volumes>(),
            (SamplerKind::Sobol, Configuration::Spectral) => work.run::<Sobol, Spectral>(),
        }
    }
}
