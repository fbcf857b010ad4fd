//! A thin pane of glass.

use etendue_math::{Real, Spectrum, Vector3};

use crate::bsdf::above;
use crate::direction::reflect;
use crate::fresnel::dielectric;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Ior, Lobes, Reflectance, Sample};

/// A slab so thin that light leaves where it entered, all internal reflections summed.
///
/// ```text
/// R' = 2R / (1 + R),  T' = (1 − R) / (1 + R),  R = F(|cos θ|, η)
/// reflection:    wi = (−x, −y, z),  weight = ks,  probability R'
/// transmission:  wi = −wo,          weight = kt,  probability T'
/// ```
///
/// * Laws: reciprocal; albedo `ks R' + kt T'`. Delta, two-sided, the same from both sides.
/// * Sampling: `u_lobe` chooses between the two; `None` at `wo.z = 0` and for zero weights.
///
/// # Precision
/// A few ulp; the geometric series `R + T²R/(1 − R²)` would lose the digits of `1 − R'` for R → 1.
///
/// # Source
/// Sum over the internal reflections of a slab, as in Mitsuba's thindielectric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinDielectric<C: Spectrum> {
    eta: C::Real,
    specular_reflectance: C,
    specular_transmittance: C,
}

impl<C: Spectrum> ThinDielectric<C> {
    /// A slab whose index relative to its surroundings is `eta`.
    #[inline]
    pub fn new(eta: Ior<C::Real>) -> Self {
        Self {
            eta: eta.value(),
            specular_reflectance: C::white(),
            specular_transmittance: C::white(),
        }
    }

    /// The same with reflection scaled by `ks` and transmission by `kt`, factors without physical meaning.
    #[inline]
    pub fn with_factors(self, ks: Reflectance<C>, kt: Reflectance<C>) -> Self {
        Self { specular_reflectance: ks.value(), specular_transmittance: kt.value(), ..self }
    }

    /// `[R', T']` at the cosine of incidence.
    #[inline]
    fn shares(&self, cos: C::Real) -> [C::Real; 2] {
        let one = <C::Real as Real>::ONE;
        let r = dielectric(cos, self.eta);
        [C::Real::TWO * r / (one + r), (one - r) / (one + r)]
    }
}

impl<C: Spectrum> Bsdf for ThinDielectric<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::DELTA_THROUGH
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        _u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        if !above(wo) && !above(-wo) {
            return None;
        }
        let [r, t] = self.shares(wo.z().abs());
        let (wi, weight, p) = if u_lobe < r {
            (reflect(wo), self.specular_reflectance, r)
        } else {
            (-wo, self.specular_transmittance, t)
        };
        (!weight.is_black() && p > C::Real::ZERO).then_some(Sample {
            wi,
            weight,
            density: Density::Delta(p),
            eta: C::Real::ONE,
        })
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        if !above(wo) && !above(-wo) {
            return Some(C::black());
        }
        let [r, t] = self.shares(wo.z().abs());
        Some(self.specular_reflectance.scale(r) + self.specular_transmittance.scale(t))
    }

    #[inline]
    fn pass_through(&self, wo: BsdfVec<Self>) -> C {
        if !above(wo) && !above(-wo) {
            return C::black();
        }
        let [_, t] = self.shares(wo.z().abs());
        self.specular_transmittance.scale(t)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "thin-dielectric",
    type_name: "ThinDielectric",
    parameters: &[parameter::ETA, parameter::KS, parameter::KT],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::DELTA_THROUGH,
    albedo: Albedo::ClosedForm,
    density: "delta, reflection with probability 2F/(1 + F)",
    source: "Mitsuba, thindielectric",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::DVec3;

    #[test]
    fn the_series_of_internal_reflections_is_summed() {
        let pane = ThinDielectric::<f64>::new(Ior::new(1.5).unwrap());
        let r = dielectric(0.8, 1.5);
        let mut series = r;
        let mut term = (1.0 - r) * (1.0 - r) * r;
        for _ in 0..60 {
            series += term;
            term *= r * r;
        }
        assert!((pane.shares(0.8)[0] - series).abs() < 1e-15);
        assert_eq!(
            pane.albedo(DVec3::new(0.6, 0.0, -0.8)).map(|a| (a - 1.0).abs() < 1e-15),
            Some(true)
        );
        laws::total(&pane);
    }
}
