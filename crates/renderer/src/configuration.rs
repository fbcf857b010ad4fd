//! What is compiled apart: the sampler and what paths go through.

use etendue_sampling::{Independent, Sampler, Sobol};
use etendue_scene::Scene;
use etendue_scene::scene::SamplerKind;

use crate::path::{Surfaces, Transport, Volumes};
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
            (SamplerKind::Sobol, Configuration::Surfaces) => work.run::<Sobol, Surfaces>(),
            (SamplerKind::Sobol, Configuration::Volumes) => work.run::<Sobol, Volumes>(),
        }
    }
}
