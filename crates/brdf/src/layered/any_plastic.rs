//! Plastic, polished or rough by its roughness.

use etendue_math::{Real, Spectrum};

use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::rough::smooth_or_rough::{either, rough_widths};
use crate::{
    Bsdf, BsdfReal, BsdfVec, Distribution, InternalReflectance, InternalScattering, Ior, Lobes,
    Masking, ParameterError, Plastic, PlasticInterface, Reflectance, RoughPlastic, Sample,
    TransmittanceTable,
};

/// The interface of plastic with what is integrated over it beforehand: a mirror where its roughness is 0.
///
/// The choice falls once, at construction: the limit of the rough model is the delta model, which
/// no evaluation of the rough one reaches.
#[derive(Clone, Debug, PartialEq)]
#[allow(clippy::large_enum_variant, reason = "there is no heap to put the table on")]
pub enum PlasticSurface<T> {
    /// A mirror.
    Smooth(PlasticInterface<T>),
    /// Microfacets.
    Rough(TransmittanceTable<T>),
}

impl<T: Real> PlasticSurface<T> {
    /// The interface to a base with relative index `eta` and isotropic width `alpha`, smooth where that is
    /// below [`Alpha::RANGE`](crate::Alpha::RANGE), 0 included.
    ///
    /// # Errors
    /// [`ParameterError`] where α is negative, NaN or too large.
    pub fn new(
        eta: Ior<T>,
        distribution: Distribution,
        alpha: T,
        masking: Masking,
        internal: InternalReflectance,
    ) -> Result<Self, ParameterError> {
        Ok(match rough_widths([alpha; 2])? {
            None => Self::Smooth(PlasticInterface::new(eta, internal)),
            Some([alpha, _]) => {
                Self::Rough(TransmittanceTable::new(eta, distribution, alpha, masking, internal))
            }
        })
    }
}

/// Plastic with the surface that was chosen for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnyPlastic<'a, C: Spectrum> {
    /// A mirror over the diffuse base.
    Smooth(Plastic<C>),
    /// Microfacets over the diffuse base.
    Rough(RoughPlastic<'a, C>),
}

impl<'a, C: Spectrum> AnyPlastic<'a, C> {
    /// A base of albedo `diffuse` under the surface.
    #[inline]
    pub fn new(
        surface: &'a PlasticSurface<C::Real>,
        diffuse: Reflectance<C>,
        scattering: InternalScattering,
    ) -> Self {
        match surface {
            PlasticSurface::Smooth(interface) => {
                Self::Smooth(Plastic::new(*interface, diffuse, scattering))
            }
            PlasticSurface::Rough(table) => {
                Self::Rough(RoughPlastic::new(table, diffuse, scattering))
            }
        }
    }

    /// The same with its interface reflection scaled by `ks`, a factor without physical meaning.
    #[inline]
    pub fn with_specular_reflectance(self, ks: Reflectance<C>) -> Self {
        match self {
            Self::Smooth(model) => Self::Smooth(model.with_specular_reflectance(ks)),
            Self::Rough(model) => Self::Rough(model.with_specular_reflectance(ks)),
        }
    }
}

impl<C: Spectrum> Bsdf for AnyPlastic<'_, C> {
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
    name: "any-plastic",
    type_name: "AnyPlastic",
    parameters: &[
        parameter::ETA,
        parameter::DISTRIBUTION,
        parameter::ANY_ALPHA,
        parameter::MASKING,
        parameter::REFLECTANCE,
        parameter::KS,
        parameter::SCATTERING,
        parameter::INTERNAL,
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes { continuous: true, delta: true, transmission: false },
    albedo: Albedo::Inner,
    density: "that of the variant chosen at construction",
    source: "plastic, or rough-plastic for alpha >= 1e-8",
};

#[cfg(test)]
mod tests {
    use super::*;

    fn surface(alpha: f32) -> Result<PlasticSurface<f32>, ParameterError> {
        let (eta, internal) = (Ior::new(1.5)?, InternalReflectance::Exact);
        PlasticSurface::new(eta, Distribution::Ggx, alpha, Masking::HeightCorrelated, internal)
    }

    #[test]
    fn vanishing_roughness_is_the_mirror_itself() {
        for alpha in [0.0, 1e-30, 1e-9] {
            assert!(matches!(surface(alpha), Ok(PlasticSurface::Smooth(_))), "{alpha}");
        }
        for alpha in [-0.1, f32::NAN, f32::INFINITY, f32::MAX] {
            assert!(surface(alpha).is_err(), "{alpha}");
        }
        let rough = surface(1e-6).unwrap();
        let model = AnyPlastic::new(&rough, Reflectance::white(), InternalScattering::Linear);
        assert!(matches!(model, AnyPlastic::<f32>::Rough(_)));
    }
}
