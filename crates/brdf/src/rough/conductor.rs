//! Metal, smooth or rough by its roughness.

use etendue_math::Spectrum;

use super::smooth_or_rough::{either, rough_widths};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{
    Bsdf, BsdfReal, BsdfVec, ComplexIor, Distribution, Lobes, Masking, Microfacets, ParameterError,
    Reflectance, RoughConductor, Sample, SmoothConductor,
};

/// A conductor that is a mirror where its roughness is 0.
///
/// The choice falls once, at construction: the limit of the rough model is the delta model, which
/// no evaluation of the rough one reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conductor<C: Spectrum> {
    /// Mirror.
    Smooth(SmoothConductor<C>),
    /// Microfacets.
    Rough(RoughConductor<C>),
}

impl<C: Spectrum> Conductor<C> {
    /// Metal with widths `alpha = [αx, αy]`: smooth where both are below [`Alpha::RANGE`](crate::Alpha::RANGE), 0 included.
    ///
    /// # Errors
    /// [`ParameterError`] where α is negative, NaN or too large. A single width below the range is
    /// raised to its lower end.
    pub fn new(
        ior: ComplexIor<C>,
        distribution: Distribution,
        alpha: [C::Real; 2],
        masking: Masking,
    ) -> Result<Self, ParameterError> {
        Ok(match rough_widths(alpha)? {
            None => Self::Smooth(SmoothConductor::new(ior)),
            Some([x, y]) => {
                Self::Rough(RoughConductor::new(ior, Microfacets::new(distribution, x, y, masking)))
            }
        })
    }

    /// The same with its reflection scaled by `ks`, a factor without physical meaning.
    pub fn with_specular_reflectance(self, ks: Reflectance<C>) -> Self {
        match self {
            Self::Smooth(model) => Self::Smooth(model.with_specular_reflectance(ks)),
            Self::Rough(model) => Self::Rough(model.with_specular_reflectance(ks)),
        }
    }
}

impl<C: Spectrum> Bsdf for Conductor<C> {
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
    name: "conductor",
    type_name: "Conductor",
    parameters: &[
        parameter::COMPLEX_ETA,
        parameter::K,
        parameter::DISTRIBUTION,
        parameter::ANY_ALPHA_X,
        parameter::ANY_ALPHA_Y,
        parameter::MASKING,
        parameter::KS,
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes { continuous: true, delta: true, transmission: false },
    albedo: Albedo::Inner,
    density: "that of the variant chosen at construction",
    source: "smooth-conductor, or rough-conductor for alpha >= 1e-8",
};

#[cfg(test)]
mod tests {
    use super::*;

    fn gold(alpha: f32) -> Result<Conductor<f32>, ParameterError> {
        let ior = ComplexIor::new(0.2, 3.0)?;
        Conductor::new(ior, Distribution::Ggx, [alpha; 2], Masking::Separable)
    }

    #[test]
    fn vanishing_roughness_is_the_mirror_itself() {
        for alpha in [0.0, 1e-30, 1e-9] {
            assert!(matches!(gold(alpha), Ok(Conductor::Smooth(_))), "{alpha}");
        }
        assert!(matches!(gold(1e-6), Ok(Conductor::Rough(_))));
    }

    #[test]
    fn invalid_roughness_is_refused() {
        for alpha in [-0.1, f32::NAN, f32::INFINITY, f32::MAX] {
            assert!(gold(alpha).is_err(), "{alpha}");
        }
    }
}
