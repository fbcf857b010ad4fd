//! The diffuse part of Ashikhmin and Shirley's model.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use crate::bsdf::{above, both_above};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Lobes, Reflectance, Sample};

/// Diffuse reflection of what a specular coat lets through, both ways.
///
/// ```text
/// f = 28 rd/(23π) (1 − rs) g(μo) g(μi),   g(μ) = 1 − (1 − μ/2)⁵
/// ```
///
/// * Laws: reciprocal; directional albedo `rd (1 − rs) g(μ)`, at most 31/32 and 0 at grazing; 23/28 on average.
/// * Sampling: cosine-weighted, two uniforms; `None` from below and where f = 0.
///
/// # Precision
/// 6 ulp: `g` is the product `x (5 − 10x + 10x² − 5x³ + x⁴)`, `x = μ/2`, without cancellation at grazing.
///
/// # Source
/// M. Ashikhmin and P. Shirley, "An Anisotropic Phong BRDF Model", J. Graphics Tools 5(2), 2000, eq. 5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AshikhminShirleyDiffuse<C> {
    /// `rd (1 − rs)`
    reflectance: C,
}

impl<C: Spectrum> AshikhminShirleyDiffuse<C> {
    /// The part with diffuse reflectance rd under a coat of normal reflectance rs.
    #[inline]
    pub fn new(rs: Reflectance<C>, rd: Reflectance<C>) -> Self {
        let one = <C::Real as Real>::ONE;
        Self { reflectance: rd.value().zip(rs.value(), |rd, rs| rd * (one - rs)) }
    }
}

/// `g(μ) = 1 − (1 − μ/2)⁵`
#[inline(always)]
fn gain<T: Real>(mu: T) -> T {
    let x = mu.min(T::ONE) * T::HALF;
    let [five, ten] = [T::lit(5.0), T::lit(10.0)];
    x * (five + x * (-ten + x * (ten + x * (x - five))))
}

impl<C: Spectrum> Bsdf for AshikhminShirleyDiffuse<C> {
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
        let scale = C::Real::lit(28.0 / (23.0 * core::f64::consts::PI));
        let value = self.reflectance.scale(scale * gain(wo.z()) * gain(wi.z()));
        (value, cosine_hemisphere::pdf::<C::Real>(wi))
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        _u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        let wi = cosine_hemisphere::from_square(u);
        let (f, pdf) = self.eval_pdf(wo, wi);
        let density = Density::Continuous(pdf);
        let weight = f.scale(C::Real::PI);
        (!weight.is_black()).then_some(Sample { wi, weight, density, eta: C::Real::ONE })
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        Some(if above(wo) { self.reflectance.scale(gain(wo.z())) } else { C::black() })
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "ashikhmin-shirley-diffuse",
    type_name: "AshikhminShirleyDiffuse",
    parameters: &[parameter::RS, parameter::RD],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::ClosedForm,
    density: "cosine",
    source: "Ashikhmin and Shirley 2000, eq. 5",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::DVec3;
    use etendue_math::quadrature::gauss_legendre;

    fn model(rs: f64, rd: f64) -> AshikhminShirleyDiffuse<f64> {
        let [rs, rd] = [rs, rd].map(|r| Reflectance::new(r).unwrap());
        AshikhminShirleyDiffuse::new(rs, rd)
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        laws::reciprocal(&model(0.05, 0.9), 1e-15);
        laws::sampling_matches_density(&model(0.05, 0.9), 1e-13);
        laws::total(&model(0.05, 0.9));
        laws::total(&AshikhminShirleyDiffuse::new(
            Reflectance::<f32>::clamped(0.0),
            Reflectance::white(),
        ));
    }

    #[test]
    fn the_albedo_is_its_closed_form() {
        // A polynomial in the cosine: rounding of 16 384 terms.
        laws::albedo_is_closed_form(&model(0.3, 0.7), 1e-12);
        assert_eq!(model(0.0, 1.0).albedo(DVec3::Z), Some(31.0 / 32.0));
    }

    #[test]
    fn the_average_albedo_is_23_over_28() {
        let average: f64 = gauss_legendre::<f64, 8>()
            .iter()
            .map(|&(z, w)| {
                let wo = DVec3::new((1.0 - z * z).sqrt(), 0.0, z);
                w * 2.0 * z * model(0.0, 1.0).albedo(wo).unwrap()
            })
            .sum();
        assert!((average - 23.0 / 28.0).abs() < 1e-15, "{average}");
    }

    #[test]
    fn grazing_keeps_its_digits_in_single_precision() {
        for k in 0..60 {
            let z = Real::powi(0.7_f32, k);
            let want = gain(f64::from(z));
            let error = (f64::from(gain(z)) / want - 1.0).abs();
            assert!(error < 3.0 * f64::from(f32::EPSILON), "{z}: {error}");
        }
    }
}
