//! Glass, smooth or rough by its roughness, absent where the indices match.

use etendue_math::Spectrum;

use super::smooth_or_rough::{either, rough_widths};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{
    Bsdf, BsdfReal, BsdfVec, Distribution, Ior, Lobes, Masking, Microfacets, Null, ParameterError,
    Reflectance, RoughDielectric, Sample, SmoothDielectric,
};

/// A dielectric interface that is a delta model where its roughness is 0 and a rough pass-through
/// nowhere.
///
/// The choice falls once, at construction: neither limit is reached by evaluating the rough model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Dielectric<C: Spectrum> {
    /// Both media have the same index: straight on, whatever the roughness.
    Matched(Null<C>),
    /// Mirror reflection and refraction.
    Smooth(SmoothDielectric<C>),
    /// Microfacets.
    Rough(RoughDielectric<C>),
}

impl<C: Spectrum> Dielectric<C> {
    /// The interface to a medium with relative index `eta` and widths `alpha = [αx, αy]`, smooth where
    /// both are below [`Alpha::RANGE`](crate::Alpha::RANGE), 0 included.
    ///
    /// # Errors
    /// [`ParameterError`] where α is negative, NaN or too large. A single width below the range is
    /// raised to its lower end.
    pub fn new(
        eta: Ior<C::Real>,
        distribution: Distribution,
        alpha: [C::Real; 2],
        masking: Masking,
    ) -> Result<Self, ParameterError> {
        let widths = rough_widths(alpha)?;
        Ok(match widths {
            _ if eta.is_matched() => Self::Matched(Null::new()),
            None => Self::Smooth(SmoothDielectric::new(eta)),
            Some([x, y]) => Self::Rough(RoughDielectric::new(
                eta,
                Microfacets::new(distribution, x, y, masking),
            )?),
        })
    }

    /// The same with reflection scaled by `ks` and transmission by `kt`, factors without physical
    /// meaning. A matched interface has neither and stays as it is.
    pub fn with_factors(self, ks: Reflectance<C>, kt: Reflectance<C>) -> Self {
        match self {
            Self::Matched(model) => Self::Matched(model),
            Self::Smooth(model) => Self::Smooth(model.with_factors(ks, kt)),
            Self::Rough(model) => Self::Rough(model.with_factors(ks, kt)),
        }
    }
}

impl<C: Spectrum> Bsdf for Dielectric<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        either!(self, m => m.lobes(); Matched, Smooth, Rough)
    }
    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        either!(self, m => m.eval_pdf(wo, wi); Matched, Smooth, Rough)
    }
    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        either!(self, m => m.sample(wo, u_lobe, u); Matched, Smooth, Rough)
    }
    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        either!(self, m => m.albedo(wo); Matched, Smooth, Rough)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "dielectric",
    type_name: "Dielectric",
    parameters: &[
        parameter::ETA,
        parameter::DISTRIBUTION,
        parameter::ANY_ALPHA_X,
        parameter::ANY_ALPHA_Y,
        parameter::MASKING,
        parameter::KS,
        parameter::KT,
    ],
    reciprocity: Reciprocity::UpToSquaredIndex,
    energy: Energy::Conserves,
    lobes: Lobes { continuous: true, delta: true, transmission: true },
    albedo: Albedo::Inner,
    density: "that of the variant chosen at construction",
    source: "null for eta = 1, smooth-dielectric, or rough-dielectric for alpha >= 1e-8",
};

#[cfg(test)]
mod tests {
    use super::*;

    fn glass(eta: f32, alpha: f32) -> Result<Dielectric<f32>, ParameterError> {
        Dielectric::new(Ior::new(eta)?, Distribution::Ggx, [alpha; 2], Masking::Separable)
    }

    #[test]
    fn limits_are_chosen_at_construction() {
        assert!(matches!(glass(1.0, 0.5), Ok(Dielectric::Matched(_))));
        assert!(matches!(glass(1.5, 0.0), Ok(Dielectric::Smooth(_))));
        assert!(matches!(glass(1.5, 0.5), Ok(Dielectric::Rough(_))));
        assert!(glass(1.5, -0.5).is_err() && glass(1.0, f32::NAN).is_err());
    }
}
