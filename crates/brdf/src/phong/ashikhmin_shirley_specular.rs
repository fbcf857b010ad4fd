//! The specular part of Ashikhmin and Shirley's model.

use etendue_math::{Real, Spectrum, Vec3, Vector3};

use super::PhongHalfVectors;
use crate::bsdf::{above, both_above};
use crate::direction::{reflect_about, sum_of_units};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Exponent, Lobes, Reflectance, Sample};

/// Reflection at half vectors distributed as an anisotropic power of their cosine, with Schlick's reflectance.
///
/// ```text
/// f = √((nu + 1)(nv + 1))/(8π) (n·h)^e F(h·wo) / ((h·wo) max(n·wo, n·wi))
/// e = (nu hx² + nv hy²)/(1 − hz²),   F(c) = rs + (1 − rs)(1 − c)⁵
/// ```
///
/// * Laws: reciprocal; conserves energy, since the albedo is the mean of `F cos θi / max(cos θi, cos θo)` over sampled
///   half vectors. Loses half of the light at grazing.
/// * Sampling: half vectors with density `p(h)` of [`PhongHalfVectors`], hence `p(h) / (4 h·wo)` per steradian of `wi`;
///   two uniforms, weight `F cos θi / max(cos θi, cos θo)`; `None` from below and where `wi` falls below.
///
/// # Precision
/// 8 ulp for the directions that the coordinates stand for, up to exponents of 1e12; `1 − c = |wo − wi|²/4 / (1 + c)`.
/// `f32` evaluates the lobe in `f64`: in a lobe of exponent n the rounding of a half vector counts n-fold, even where the
/// lobe is but a small part of the value and of its condition.
///
/// # Source
/// M. Ashikhmin and P. Shirley, "An Anisotropic Phong BRDF Model", J. Graphics Tools 5(2), 2000, eqs. 4 and 8.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AshikhminShirleySpecular<C: Spectrum> {
    half_vectors: PhongHalfVectors<C::Real>,
    reflectance: C,
}

impl<C: Spectrum> AshikhminShirleySpecular<C> {
    /// The lobe with exponents nu along x and nv along y and reflectance rs at normal incidence.
    #[inline]
    pub fn new(nu: Exponent<C::Real>, nv: Exponent<C::Real>, rs: Reflectance<C>) -> Self {
        Self { half_vectors: PhongHalfVectors::new(nu, nv), reflectance: rs.value() }
    }

    /// Schlick's reflectance, given `1 − c`.
    #[inline(always)]
    pub(super) fn fresnel(&self, complement: C::Real) -> C {
        let fifth = (complement * complement) * (complement * complement) * complement;
        self.reflectance.map(|rs| rs + (C::Real::ONE - rs) * fifth)
    }

    /// A reflected direction, its weight, which may be black, and its density.
    #[inline(always)]
    pub(super) fn reflect(
        &self,
        wo: Vec3<C::Real>,
        u: [C::Real; 2],
    ) -> Option<(Vec3<C::Real>, C, C::Real)> {
        let (h, pdf) = self.half_vectors.sample(u);
        let wi = reflect_about(wo, h);
        if !both_above(wo, wi) || !(wo.dot(h) > C::Real::ZERO) {
            return None;
        }
        let complement = (wo - h).length_squared() * C::Real::HALF;
        let weight = self.fresnel(complement).scale(wi.z() / wo.z().max(wi.z()));
        let pdf = (pdf / (C::Real::lit(4.0) * wo.dot(h))).min(C::Real::MAX);
        (pdf > C::Real::ZERO).then_some((wi, weight, pdf))
    }
}

/// A vector in double precision, exact.
#[inline(always)]
fn wide<T: Real>(w: Vec3<T>) -> Vec3<f64> {
    Vec3::<f64>::new(w.x().to_f64(), w.y().to_f64(), w.z().to_f64())
}

impl<C: Spectrum> Bsdf for AshikhminShirleySpecular<C> {
    type Color = C;

    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::CONTINUOUS
    }

    #[inline]
    fn eval_pdf(&self, wo: BsdfVec<Self>, wi: BsdfVec<Self>) -> (C, BsdfReal<Self>) {
        let nothing = (C::black(), C::Real::ZERO);
        if !both_above(wo, wi) {
            return nothing;
        }
        let (o, i) = (wide::<C::Real>(wo), wide::<C::Real>(wi));
        let sum = sum_of_units(o, i);
        let cos = (0.5 * sum.length()).min(1.0);
        if !(cos > 0.0) {
            return nothing;
        }
        let pdf = self.half_vectors.pdf_wide(sum) / (4.0 * cos);
        let narrow = |x: f64| C::Real::lit(x).min(C::Real::MAX);
        let complement = narrow((o - i).length_squared() / (4.0 * (1.0 + cos)));
        let reflectance = self.fresnel(complement.min(C::Real::ONE));
        (reflectance.scale(narrow(pdf / o.z.max(i.z))), narrow(pdf))
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        _u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        if !above(wo) {
            return None;
        }
        let (wi, weight, pdf) = self.reflect(wo, u)?;
        let density = Density::Continuous(pdf);
        (!weight.is_black()).then_some(Sample { wi, weight, density, eta: C::Real::ONE })
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "ashikhmin-shirley-specular",
    type_name: "AshikhminShirleySpecular",
    parameters: &[parameter::NU, parameter::NV, parameter::RS],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::Quadrature,
    density: "half vectors, p(h)/(4 h·wo)",
    source: "Ashikhmin and Shirley 2000",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use crate::quadrature::directional_albedo;
    use etendue_math::glam::DVec3;

    fn model<T: Real + Spectrum<Real = T>>(
        nu: f64,
        nv: f64,
        rs: f64,
    ) -> AshikhminShirleySpecular<T> {
        let [nu, nv] = [nu, nv].map(|n| Exponent::new(T::lit(n)).unwrap());
        AshikhminShirleySpecular::new(nu, nv, Reflectance::new(T::lit(rs)).unwrap())
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for (nu, nv, rs) in [(0.0, 0.0, 1.0), (3.0, 20.0, 0.5), (10.0, 10.0, 0.04)] {
            let model = model::<f64>(nu, nv, rs);
            laws::reciprocal(&model, 1e-13);
            laws::sampling_matches_density(&model, 1e-11);
            laws::total(&model);
        }
        laws::density_integrates_to_at_most_one(&model::<f64>(5.0, 30.0, 0.5));
        laws::total(&model::<f32>(1e6, 10.0, 0.0));
        laws::total(&model::<f32>(1e12, 1e12, 1.0));
    }

    #[test]
    fn the_known_albedo_is_reproduced() {
        for (n, z, want) in
            [(1.0, 1.0, 0.250), (1.0, 0.3, 0.425), (10.0, 1.0, 0.696), (10.0, 0.5, 0.613)]
        {
            let wo = DVec3::new(Real::sqrt(1.0 - z * z), 0.0, z);
            let got = directional_albedo::<_, 64>(&model::<f64>(n, n, 1.0), wo);
            // Three digits, and the rule's error at the kink cos θi = cos θo.
            assert!((got - want).abs() < 1.5e-3, "{n} {z}: {got}");
        }
    }

    #[test]
    fn looking_along_the_light_the_reflectance_keeps_its_digits_in_single_precision() {
        let wo = etendue_math::glam::Vec3::new(0.6, 0.0, 0.8);
        let wi = etendue_math::glam::Vec3::new(0.602, 0.01, (1.0_f32 - 0.362_504).sqrt());
        let want = model::<f64>(1.0, 1.0, 0.0).eval(wo.as_dvec3(), wi.as_dvec3());
        let got = f64::from(model::<f32>(1.0, 1.0, 0.0).eval(wo, wi));
        // (1 − c)⁵ of a rounded cosine would have no digit left.
        assert!((got / want - 1.0).abs() < 16.0 * f64::from(f32::EPSILON), "{got} {want}");
    }
}
