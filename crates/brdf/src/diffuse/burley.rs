//! Burley's diffuse lobe of the Disney model.

use etendue_math::{Real, Spectrum, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::cosine::cosine_sample;
use crate::bsdf::{above, both_above};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Lobes, Reflectance, Roughness, Sample};

/// Disney's diffuse reflector: darkened at grazing when smooth, brightened when rough.
///
/// ```text
/// f = base/π (1 + (F90 − 1)(1 − μo)⁵) (1 + (F90 − 1)(1 − μi)⁵)
/// F90 = 1/2 + 2 r cos² θd,   cos² θd = |wo + wi|²/4
/// ```
///
/// * Laws: reciprocal; gains energy for rough surfaces (directional albedo up to 785/504 = 1.5575 at r = 1, grazing),
///   loses it for smooth ones (down to 41/84 = 0.488 at r = 0, grazing).
/// * Directional albedo in closed form: F90 is linear in `wo·wi`, so its azimuthal mean and mean square are polynomials
///   in the cosines, and the integral over `μi` is one of beta functions. With `k = r − 1/2`, `m = (1 − μo)⁵` and
///   `S² = 1 − μo²`:
///
/// ```text
/// R = base [1 + k/21 + r μo/84
///           + m (k + 2/3 r μo + k²/21 + k r μo/42 + r² (μo²/252 + 11 S²/504))]
/// ```
///
/// * Sampling: cosine-weighted, two uniforms; `None` from below.
///
/// # Precision
/// A few ulp times the condition of the problem; `cos² θd` is a sum of squares.
///
/// # Source
/// B. Burley, "Physically-Based Shading at Disney", SIGGRAPH 2012 course, section 5.3. The albedo is derived here;
/// `r = 0` gives the known `41/42 − (41/84)(1 − μo)⁵`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Burley<C: Spectrum> {
    base_color: C,
    roughness: C::Real,
}

impl<C: Spectrum> Burley<C> {
    /// The reflector with colour `base_color` and roughness r.
    #[inline]
    pub fn new(base_color: Reflectance<C>, roughness: Roughness<C::Real>) -> Self {
        Self { base_color: base_color.value(), roughness: roughness.value() }
    }
}

/// `(1 − μ)⁵`
#[inline(always)]
fn fifth<T: Real>(mu: T) -> T {
    let m = T::ONE - mu;
    (m * m) * (m * m) * m
}

impl<C: Spectrum> Bsdf for Burley<C> {
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
        let one = <C::Real as Real>::ONE;
        // F90 − 1 = r |wo + wi|²/2 − 1/2
        let lift = C::Real::HALF * (self.roughness * (wo + wi).length_squared() - one);
        // Not negative for unit directions; longer ones, outside the domain, could make it so.
        let factor = |mu| (one + lift * fifth(mu)).max(C::Real::ZERO);
        let value = C::Real::FRAC_1_PI * (factor(wo.z()) * factor(wi.z())).min(C::Real::MAX);
        (self.base_color.scale(value), cosine_hemisphere::pdf::<C::Real>(wi))
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
        let lit = C::Real::lit;
        let mu = wo.z().min(C::Real::ONE);
        let sin_squared = (C::Real::ONE - mu) * (C::Real::ONE + mu);
        let (k, r) = (self.roughness - C::Real::HALF, self.roughness);
        let one_factor = k * lit(1.0 / 21.0) + r * mu * lit(1.0 / 84.0);
        let square = k * k * lit(1.0 / 21.0)
            + k * r * mu * lit(1.0 / 42.0)
            + r * r * (mu * mu * lit(1.0 / 252.0) + sin_squared * lit(11.0 / 504.0));
        let both_factors = k + r * mu * lit(2.0 / 3.0) + square;
        let albedo = C::Real::ONE + one_factor + fifth(mu) * both_factors;
        Some(self.base_color.scale(albedo))
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "burley",
    type_name: "Burley",
    parameters: &[parameter::named("base_color", "each channel in [0, 1]"), parameter::ROUGHNESS],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Gains { maximum: 785.0 / 504.0, at: "roughness = 1, cos -> 0" },
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::ClosedForm,
    density: "cosine",
    source: "Burley 2012",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::DVec3;

    fn model(r: f64) -> Burley<f64> {
        Burley::new(Reflectance::white(), Roughness::new(r).unwrap())
    }

    fn viewer(z: f64) -> DVec3 {
        DVec3::new((1.0 - z * z).sqrt(), 0.0, z)
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for r in [0.0, 0.5, 1.0] {
            laws::reciprocal(&model(r), 1e-15);
            laws::sampling_matches_density(&model(r), 1e-13);
            laws::total(&model(r));
        }
        laws::total(&Burley::new(Reflectance::<f32>::white(), Roughness::new(1.0).unwrap()));
    }

    #[test]
    fn the_albedo_is_its_closed_form() {
        for r in [0.0, 0.25, 0.5, 1.0] {
            // A polynomial in μi; the rule's nodes in t with μ = t (2 − t) integrate it exactly.
            laws::albedo_is_closed_form(&model(r), 1e-12);
        }
    }

    #[test]
    fn the_albedo_of_a_smooth_surface_is_the_known_one() {
        for z in [1.0, 0.6, 0.1, 1e-9] {
            let want = 41.0 / 42.0 - 41.0 / 84.0 * Real::powi(1.0 - z, 5);
            assert!((model(0.0).albedo(viewer(z)).unwrap() - want).abs() < 1e-15, "{z}");
        }
    }

    #[test]
    fn the_gain_is_the_documented_one_and_the_largest() {
        let grazing = model(1.0).albedo(viewer(1e-12)).unwrap();
        assert!((grazing - 785.0 / 504.0).abs() < 1e-10, "{grazing}");
        for i in 1..=100 {
            let r = Roughness::new(f64::from(i % 11) / 10.0).unwrap();
            let albedo =
                Burley::new(Reflectance::<f64>::white(), r).albedo(viewer(f64::from(i) / 100.0));
            assert!(albedo.unwrap() < grazing);
        }
    }
}
