//! Mirror of metal.

use etendue_math::{Real, Spectrum, Vector3};

use crate::bsdf::above;
use crate::direction::reflect;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, ComplexIor, Density, Lobes, Reflectance, Sample, fresnel};

/// Smooth conductor: specular reflection, nothing else.
///
/// ```text
/// wi = (−x, −y, z) of wo,  weight = ks F(cos θ, η, k)
/// ```
///
/// * Laws: reciprocal; directional albedo `ks F ≤ 1`. Delta.
/// * Sampling: no uniform consumed; `None` from below.
///
/// # Source
/// As [`fresnel::conductor`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SmoothConductor<C> {
    ior: ComplexIor<C>,
    specular_reflectance: C,
}

impl<C: Spectrum> SmoothConductor<C> {
    /// The mirror with complex index `ior`.
    #[inline]
    pub fn new(ior: ComplexIor<C>) -> Self {
        Self { ior, specular_reflectance: C::white() }
    }

    /// The same with its reflection scaled by `ks`, a factor without physical meaning.
    #[inline]
    pub fn with_specular_reflectance(self, ks: Reflectance<C>) -> Self {
        Self { specular_reflectance: ks.value(), ..self }
    }

    fn reflectance(&self, cos: C::Real) -> C {
        conductor_reflectance(self.ior, cos) * self.specular_reflectance
    }
}

/// [`fresnel::conductor`] per channel.
#[inline(always)]
pub(crate) fn conductor_reflectance<C: Spectrum>(ior: ComplexIor<C>, cos: C::Real) -> C {
    ior.eta().zip(ior.k(), |eta, k| fresnel::conductor_of_valid(cos, eta, k))
}

impl<C: Spectrum> Bsdf for SmoothConductor<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::DELTA
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        _u_lobe: BsdfReal<Self>,
        _u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        let weight = self.albedo(wo)?;
        let one = <C::Real as Real>::ONE;
        (!weight.is_black()).then(|| Sample {
            wi: reflect(wo),
            weight,
            density: Density::Delta(one),
            eta: one,
        })
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        Some(if above(wo) { self.reflectance(wo.z()) } else { C::black() })
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "smooth-conductor",
    type_name: "SmoothConductor",
    parameters: &[parameter::COMPLEX_ETA, parameter::K, parameter::KS],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::DELTA,
    albedo: Albedo::ClosedForm,
    density: "delta",
    source: "Born and Wolf, section 14.2",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::Rgb;
    use etendue_math::glam::DVec3;

    #[test]
    fn it_reflects_into_the_mirror_direction_only() {
        let gold =
            ComplexIor::new(Rgb::new(0.14_f64, 0.37, 1.44), Rgb::new(3.98, 2.39, 1.60)).unwrap();
        let model = SmoothConductor::new(gold);
        let s = model.sample(DVec3::new(0.6, 0.0, 0.8), 0.3, [0.1, 0.9]).unwrap();
        assert_eq!(s.wi, DVec3::new(-0.6, 0.0, 0.8));
        assert_eq!(s.density, Density::Delta(1.0));
        assert!(s.weight.r > s.weight.g && s.weight.g > s.weight.b);
        laws::total(&model);
    }
}
