//! Coupled matte and specular reflection, polished or rough by its roughness.

use etendue_math::Spectrum;

use super::coupled_interface::{self, CoupledInterface};
use super::mirror_over_matte;
use crate::registry::{Albedo, ModelInfo, parameter};
use crate::rough::smooth_or_rough::{either, rough_widths};
use crate::{
    Bsdf, BsdfReal, BsdfVec, Coupled, Distribution, Lobes, Masking, Microfacets, ParameterError,
    Reflectance, RoughCoupled, Sample,
};

/// A coupled surface that has a mirror where its roughness is 0.
///
/// The choice falls once, at construction: the limit of the rough model is the delta model, which
/// no evaluation of the rough one reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyCoupled<C: Spectrum> {
    /// A mirror over the matte term.
    Smooth(Coupled<C>),
    /// Microfacets over the matte term.
    Rough(RoughCoupled<C>),
}

impl<C: Spectrum> AnyCoupled<C> {
    /// A base of reflectance `rm` under the interface, with widths `alpha = [αx, αy]`: smooth where both are
    /// below [`Alpha::RANGE`](crate::Alpha::RANGE), 0 included.
    ///
    /// # Errors
    /// [`ParameterError`] where α is negative, NaN or too large. A single width below the range is
    /// raised to its lower end.
    pub fn new(
        interface: CoupledInterface<C>,
        distribution: Distribution,
        alpha: [C::Real; 2],
        masking: Masking,
        rm: Reflectance<C>,
    ) -> Result<Self, ParameterError> {
        Ok(match rough_widths(alpha)? {
            None => Self::Smooth(Coupled::new(interface, rm)),
            Some([x, y]) => {
                let facets = Microfacets::new(distribution, x, y, masking);
                Self::Rough(RoughCoupled::new(interface, facets, rm))
            }
        })
    }
}

impl<C: Spectrum> Bsdf for AnyCoupled<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        either!(self, m => m.lobes(); Smooth, Rough)
    }
    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        either!(self, m => m.eval_pdf(wo, wi); Smooth, Rough)
    }
    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        either!(self, m => m.sample(wo, u_lobe, u); Smooth, Rough)
    }
    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        either!(self, m => m.albedo(wo); Smooth, Rough)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "any-coupled",
    type_name: "AnyCoupled",
    parameters: &[
        coupled_interface::PARAMETER,
        coupled_interface::MATTE,
        parameter::DISTRIBUTION,
        parameter::ANY_ALPHA_X,
        parameter::ANY_ALPHA_Y,
        parameter::MASKING,
    ],
    reciprocity: super::rough_coupled::INFO.reciprocity,
    energy: super::rough_coupled::INFO.energy,
    lobes: mirror_over_matte::LOBES,
    albedo: Albedo::Inner,
    density: "that of the variant chosen at construction",
    source: "coupled, or rough-coupled for alpha >= 1e-8",
};

#[cfg(test)]
mod tests {
    use super::*;

    fn wood(alpha: [f32; 2]) -> Result<AnyCoupled<f32>, ParameterError> {
        let interface = CoupledInterface::schlick(Reflectance::new(0.04)?);
        let rm = Reflectance::new(0.5)?;
        AnyCoupled::new(interface, Distribution::Ggx, alpha, Masking::HeightCorrelated, rm)
    }

    #[test]
    fn vanishing_roughness_is_the_mirror_itself() {
        for alpha in [[0.0; 2], [1e-30, 0.0], [1e-9; 2]] {
            assert!(matches!(wood(alpha), Ok(AnyCoupled::Smooth(_))), "{alpha:?}");
        }
        for alpha in [[1e-6; 2], [0.0, 0.5]] {
            assert!(matches!(wood(alpha), Ok(AnyCoupled::Rough(_))), "{alpha:?}");
        }
        for alpha in [[-0.1, 0.1], [f32::NAN; 2], [0.1, f32::MAX]] {
            assert!(wood(alpha).is_err(), "{alpha:?}");
        }
    }
}
