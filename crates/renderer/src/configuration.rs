//! What is compiled apart: the sampler and what paths go through.

use etendue_sampling::{Independent, Sampler, Sobol};
use etendue_scene::scene::SamplerKind;

use crate::path::{Configuration, Surfaces, Transport, Volumes};
use crate::render::Renderer;

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
