//! Lambert's ideal diffuse reflector.

use etendue_math::{Real, Spectrum};
use etendue_sampling::warp::cosine_hemisphere;

use crate::bsdf::{above, both_above};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Reflectance, Sample};

/// Ideal diffuse reflection.
///
/// ```text
/// f = ρ / π
/// ```
///
/// * Shape: constant; appears equally bright from everywhere.
/// * Laws: reciprocal; directional albedo exactly ρ.
/// * Sampling: cosine-weighted, two uniforms, weight ρ; `None` from below.
///
/// # Precision
/// 1 ulp.
///
/// # Source
/// J. H. Lambert, Photometria, 1760.
///
/// # Examples
/// ```
/// use etendue_brdf::{Bsdf, Lambert, Reflectance};
/// use etendue_math::glam::DVec3;
/// let grey = Lambert::new(Reflectance::new(0.5_f64)?);
/// let f = grey.eval(DVec3::Z, DVec3::new(0.6, 0.0, 0.8));
/// assert!((f - 0.5 / std::f64::consts::PI).abs() < 1e-16);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lambert<C> {
    reflectance: C,
}

impl<C: Spectrum> Lambert<C> {
    /// The reflector with albedo ρ.
    #[inline]
    pub fn new(reflectance: Reflectance<C>) -> Self {
        Self { reflectance: reflectance.value() }
    }
}

impl<C: Spectrum> Bsdf for Lambert<C> {
    type Color = C;

    #[inline(always)]
    fn lobes(&self) -> Lobes {
        Lobes::CONTINUOUS
    }

    #[inline(always)]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        if !both_above(wo, wi) {
            return (C::black(), C::Real::ZERO);
        }
        (self.reflectance.scale(C::Real::FRAC_1_PI), cosine_hemisphere::pdf::<C::Real>(wi))
    }

    #[inline(always)]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        _u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        let wi = cosine_hemisphere::from_square(u);
        if !above(wo) || !above(wi) || self.reflectance.is_black() {
            return None;
        }
        Some(Sample {
            wi,
            weight: self.reflectance,
            density: Density::Continuous(cosine_hemisphere::pdf::<C::Real>(wi)),
            eta: C::Real::ONE,
        })
    }

    #[inline(always)]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        Some(if above(wo) { self.reflectance } else { C::black() })
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "lambert",
    type_name: "Lambert",
    parameters: &[parameter::REFLECTANCE],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::ClosedForm,
    density: "cosine",
    source: "Lambert 1760",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        let model = Lambert::new(Reflectance::<f64>::white());
        laws::reciprocal(&model, 1e-15);
        laws::sampling_matches_density(&model, 1e-14);
        laws::total(&model);
        laws::total(&Lambert::new(Reflectance::<f32>::white()));
    }

    #[test]
    fn white_reflects_everything() {
        // The integrand is a polynomial: the rule is exact but for rounding.
        laws::albedo_is_closed_form(&Lambert::new(Reflectance::<f64>::white()), 1e-13);
    }
}
