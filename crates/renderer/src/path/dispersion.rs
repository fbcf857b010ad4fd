//! Scattering whose direction depends on the wavelength.

use etendue_brdf::{Bsdf, Density, Sample};
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_sampling::{Decision, Dimension, Sampler};
use etendue_scene::color::Channels;
use etendue_scene::material::{Dispersed, Dispersive};

use super::{Vertex, Walk};

impl<C: Channels> Vertex<'_, C> {
    /// The interface whose index depends on the wavelength, where channels are wavelengths.
    #[inline(always)]
    fn dispersive(&self) -> Option<&Dispersive<C::Color>> {
        // Known where this is compiled: channels that are the same for all paths are no wavelengths.
        if C::FIXED.is_some() { None } else { self.bsdf.dispersive() }
    }

    /// Value of the scattering function, and the density with which the mixture of all channels draws this direction.
    #[inline(always)]
    pub(super) fn eval_pdf(&self, wi: Vec3) -> (C::Color, f32) {
        match self.dispersive() {
            Some(interface) => {
                let (values, densities) = interface.eval_pdfs(self.wo, wi);
                (values, (self.ratios * densities).mean())
            }
            None => self.bsdf.eval_pdf(self.wo, wi),
        }
    }

    /// Draws a direction by the leading channel, with weight and density of the mixture of all.
    #[inline(always)]
    pub(super) fn sample<S: Sampler>(
        &self,
        u_lobe: f32,
        u: [f32; 2],
        walk: &mut Walk<C>,
        points: &S,
    ) -> Option<Sample<C::Color>> {
        let Some(interface) = self.dispersive() else {
            return self.bsdf.sample(self.wo, u_lobe, u);
        };
        let leading = leading_channel::<C, S>(points);
        let Dispersed { sample, densities } = interface.sample_by(leading, self.wo, u_lobe, u)?;
        let per_mean = walk.weigh(densities);
        let density = match sample.density {
            Density::Delta(probability) => Density::Delta(probability / per_mean),
            Density::Continuous(density) => Density::Continuous(density / per_mean),
        };
        Some(Sample { weight: sample.weight.scale(per_mean), density, ..sample })
    }
}

/// The channel that draws what depends on the channel: one for the whole path.
#[inline(always)]
pub(super) fn leading_channel<C: Channels, S: Sampler>(points: &S) -> usize {
    C::leading(|| points.sample_1d(Dimension::camera(Decision::Wavelength)))
}
