//! Oren and Nayar's rough diffuse reflector, qualitative model.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::cosine::{cosine_sample, largest_value};
use crate::bsdf::both_above;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Lobes, Reflectance, Sample, Sigma};

/// V-cavities with Lambertian facets, two-term fit without interreflection.
///
/// ```text
/// f = ρ/π [A + B max(0, xi·xo + yi·yo) / max(cos θi, cos θo)]
/// A = 1 − 0.5 σ²/(σ² + 0.33),  B = 0.45 σ²/(σ² + 0.09)
/// ```
///
/// which is the published `A + B max(0, cos φ) sin α tan β` without an angle.
///
/// * Laws: reciprocal; gains energy near grazing for σ ≲ 0.3 (albedo up to 1.0152 at σ = 0.2,
///   ρ = 1), loses it for larger σ. σ = 0 is Lambert's reflector.
/// * Sampling: cosine-weighted, two uniforms; `None` from below.
///
/// # Precision
/// A few ulp times the condition of the problem.
///
/// # Source
/// M. Oren and S. Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994, eq. 30.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrenNayarQualitative<C: Spectrum> {
    reflectance: C,
    a: C::Real,
    b: C::Real,
}

impl<C: Spectrum> OrenNayarQualitative<C> {
    /// The reflector with facet albedo ρ and slope deviation σ.
    pub fn new(reflectance: Reflectance<C>, sigma: Sigma<C::Real>) -> Self {
        Self {
            reflectance: reflectance.value(),
            a: C::Real::ONE - C::Real::HALF * sigma.share(0.33),
            b: C::Real::lit(0.45) * sigma.share(0.09),
        }
    }
}

impl<C: Spectrum> Bsdf for OrenNayarQualitative<C> {
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
        let projection = (wo.x() * wi.x() + wo.y() * wi.y()).max(C::Real::ZERO);
        let lobe = self.b * (projection / wo.z().max(wi.z()));
        // Where both cosines are subnormal the quotient overflows.
        let value =
            self.reflectance.scale((C::Real::FRAC_1_PI * (self.a + lobe)).min(largest_value()));
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
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "oren-nayar-qualitative",
    type_name: "OrenNayarQualitative",
    parameters: &[parameter::REFLECTANCE, parameter::SIGMA],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Gains { maximum: 1.0152, at: "sigma = 0.2, cos -> 0" },
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::Quadrature,
    density: "cosine",
    source: "Oren and Nayar 1994, eq. 30",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use crate::quadrature::directional_albedo;
    use etendue_math::glam::DVec3;

    fn model(sigma: f64) -> OrenNayarQualitative<f64> {
        OrenNayarQualitative::new(Reflectance::white(), Sigma::new(sigma).unwrap())
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for sigma in [0.0, 0.2, 1.0] {
            laws::reciprocal(&model(sigma), 1e-14);
            laws::sampling_matches_density(&model(sigma), 1e-13);
            laws::total(&model(sigma));
        }
        laws::total(&OrenNayarQualitative::new(
            Reflectance::<f32>::white(),
            Sigma::new(0.3).unwrap(),
        ));
    }

    #[test]
    fn without_roughness_it_is_lamberts() {
        let f = model(0.0).eval(DVec3::new(0.6, 0.0, 0.8), DVec3::new(0.8, 0.0, 0.6));
        assert_eq!(f, f64::FRAC_1_PI);
    }

    #[test]
    fn the_known_albedo_is_reproduced() {
        for (sigma, want) in
            [(0.3, [0.893, 0.939, 0.983, 1.000]), (1.0, [0.625, 0.709, 0.789, 0.821])]
        {
            for (theta, want) in [0.01_f64, 0.8, 1.3, 1.5].into_iter().zip(want) {
                let wo = DVec3::new(Real::sin(theta), 0.0, Real::cos(theta));
                let got = directional_albedo::<_, 64>(&model(sigma), wo);
                // Three published digits, and a kink in φ that the rule sees at 1e-3.
                assert!((got - want).abs() < 1.5e-3, "{sigma} {theta} {got}");
            }
        }
    }
}
