//! Fujii's improved Oren–Nayar reflector.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::cosine::cosine_sample;
use super::fon;
use crate::bsdf::{above, both_above};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Lobes, Reflectance, Roughness, Sample};

/// Fujii's improvement of the qualitative Oren–Nayar model: no dark ring, no gain of energy.
///
/// ```text
/// f = ρ/π A (1 + r s/t),   A = 1 / (1 + (1/2 − 2/(3π)) r)
/// s = wo·wi − μo μi,   t = max(μo, μi) where s > 0, else 1
/// ```
///
/// * Shape: flattened like a rough matte surface, brightest towards the light; r = 0 is Lambert's reflector.
/// * Laws: reciprocal; conserves energy, and loses what facets scatter twice: the albedo `ρ E(μ)` of
///   [`fon::albedo`] is 1 only at grazing, and for ρ = 1, r = 1 at the normal 0.7765. [`Eon`](crate::Eon)
///   adds the rest. At r = 1 it vanishes at opposite grazing.
/// * Sampling: cosine-weighted, two uniforms; `None` from below and where f = 0.
///
/// # Precision
/// A few ulp times the condition of the problem; `1 + s` is a sum of squares where it is small.
///
/// # Source
/// Y. Fujii, "A tiny improvement of Oren–Nayar reflectance model", 2012 (the second, energy-bounded form), with r
/// in place of σ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrenNayarFujii<C: Spectrum> {
    reflectance: C,
    roughness: Roughness<C::Real>,
    /// ρ A/π
    scale: C,
}

impl<C: Spectrum> OrenNayarFujii<C> {
    /// The reflector with facet albedo ρ and roughness r.
    pub fn new(reflectance: Reflectance<C>, roughness: Roughness<C::Real>) -> Self {
        let reflectance = reflectance.value();
        let scale = reflectance.scale(fon::normal_albedo(roughness) * C::Real::FRAC_1_PI);
        Self { reflectance, roughness, scale }
    }
}

impl<C: Spectrum> Bsdf for OrenNayarFujii<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::CONTINUOUS
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        if !both_above(wo, wi) {
            return (C::black(), C::Real::ZERO);
        }
        let value = self.scale.scale(fon::shape(wo, wi, self.roughness.value()));
        (value, cosine_hemisphere::pdf::<C::Real>(wi))
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        _u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        cosine_sample(self, wo, u)
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        if !above(wo) {
            return Some(C::black());
        }
        Some(self.reflectance.scale(fon::albedo(wo.z(), self.roughness)))
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "oren-nayar-fujii",
    type_name: "OrenNayarFujii",
    parameters: &[parameter::REFLECTANCE, parameter::ROUGHNESS],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::ClosedForm,
    density: "cosine",
    source: "Fujii 2012",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::{DVec3, Vec3};

    fn model(r: f64) -> OrenNayarFujii<f64> {
        OrenNayarFujii::new(Reflectance::white(), Roughness::new(r).unwrap())
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for r in [0.0, 0.3, 1.0] {
            laws::reciprocal(&model(r), 1e-14);
            laws::sampling_matches_density(&model(r), 1e-13);
            laws::total(&model(r));
        }
        laws::total(&OrenNayarFujii::new(
            Reflectance::<f32>::white(),
            Roughness::new(1.0).unwrap(),
        ));
    }

    #[test]
    fn without_roughness_it_is_lamberts() {
        let f = model(0.0).eval(DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.8, 0.0, 0.6));
        assert_eq!(f, f64::FRAC_1_PI);
    }

    #[test]
    fn the_albedo_is_its_closed_form() {
        for r in [0.2, 1.0] {
            // The kink at s = 0 and the singularity at μ = 0 cost the rule three digits.
            laws::albedo_is_closed_form(&model(r), 1e-3);
        }
        let white = model(1.0).albedo(DVec3::Z).unwrap();
        assert!((white - 0.776_522).abs() < 1e-6, "{white}");
    }

    #[test]
    fn opposite_grazing_keeps_its_digits_in_single_precision() {
        let f = OrenNayarFujii::new(Reflectance::<f32>::white(), Roughness::new(1.0).unwrap());
        for k in 4..12 {
            let z = Real::powi(0.5_f32, k);
            // A direction that is of length 1 to rounding, and its opposite across the normal.
            let wo = Vec3::new((1.0 - z * z).sqrt(), 0.0, z);
            let got = f.eval(wo, Vec3::new(-wo.x, 0.0, z));
            let want = f64::from(f.scale) * f64::from(z).sqr();
            // Three roundings of positive terms; 1 + s itself would have lost log2(1/z²) bits.
            assert!((f64::from(got) / want - 1.0).abs() < 4.0 * f64::from(f32::EPSILON), "{z}");
        }
    }
}
