//! Oren and Nayar's rough diffuse reflector, full model.

use etendue_math::{Real, Spectrum, Vec3, Vector3};
use etendue_sampling::warp::cosine_hemisphere;

use super::cosine::{cosine_sample, largest_value};
use crate::bsdf::both_above;
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Lobes, Reflectance, Sample, Sigma};

/// V-cavities with Lambertian facets, one interreflection included.
///
/// ```text
/// α = max(θi, θo),  β = min(θi, θo),  φ = φo − φi
/// C1 = 1 − 0.5 σ²/(σ² + 0.33)
/// C2 = 0.45 σ²/(σ² + 0.09) (sin α − [cos φ < 0] (2β/π)³)
/// C3 = 0.125 σ²/(σ² + 0.09) (4αβ/π²)²
/// C4 = 0.17 σ²/(σ² + 0.13)
/// f  = ρ/π [C1 + C2 cos φ tan β + C3 (1 − |cos φ|) tan((α + β)/2)]
///    + ρ²/π C4 [1 − cos φ (2β/π)²],   limited to f ≥ 0
/// ```
///
/// * Laws: reciprocal; gains energy near grazing for σ ≲ 0.5 (albedo up to 1.0509 at σ = 0.3,
///   ρ = 1), loses it for larger σ. The published f1 turns negative for σ ≳ 0.7 at double grazing
///   with φ = π; f is clamped at 0 there, which keeps reciprocity. σ = 0 is Lambert's reflector.
/// * Sampling: cosine-weighted, two uniforms; `None` from below and where f = 0.
///
/// # Precision
/// A few ulp times the condition of the problem. Angles come from `atan2` of the exact sine and
/// tangents from quotients, `1 − |cos φ|` is `sin² φ / (1 + |cos φ|)`, and the difference in C2 is
/// taken between complements near grazing, where it cancels.
///
/// # Source
/// M. Oren and S. Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH 1994, eqs. 27 to 29.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrenNayar<C: Spectrum> {
    reflectance: C,
    c1: C::Real,
    /// σ²/(σ² + 0.09), shared by C2 and C3.
    share: C::Real,
    c4: C::Real,
}

impl<C: Spectrum> OrenNayar<C> {
    /// The reflector with facet albedo ρ and slope deviation σ.
    pub fn new(reflectance: Reflectance<C>, sigma: Sigma<C::Real>) -> Self {
        Self {
            reflectance: reflectance.value(),
            c1: C::Real::ONE - C::Real::HALF * sigma.share(0.33),
            share: sigma.share(0.09),
            c4: C::Real::lit(0.17) * sigma.share(0.13),
        }
    }
}

impl<T: Real> Sigma<T> {
    /// `σ²/(σ² + b)` without overflow or underflow: `1/(1 + b/σ²)`.
    pub(crate) fn share(self, b: f64) -> T {
        let sigma = self.value();
        T::ONE / (T::ONE + T::lit(b) / (sigma * sigma))
    }
}

/// What the formula needs of a pair of directions.
struct Angles<T> {
    sin_alpha: T,
    cos_alpha: T,
    sin_beta: T,
    cos_beta: T,
    cos_phi: T,
    /// `1 − |cos φ|`
    one_minus_abs_cos_phi: T,
}

impl<T: Real> Angles<T> {
    #[inline(always)]
    fn new(wo: Vec3<T>, wi: Vec3<T>) -> Self {
        // Two calls, because rustc 1.95 miscompiles `let (b, a) = if … { (wo, wi) } else { (wi, wo) }`
        // here: in `f64` a caller that passes the same pair again gets the value of another one.
        if wo.z() > wi.z() { Self::ordered(wo, wi) } else { Self::ordered(wi, wo) }
    }

    /// β belongs to `b`, the direction nearer to the normal, α to `a`.
    #[inline(always)]
    fn ordered(b: Vec3<T>, a: Vec3<T>) -> Self {
        let sine = |w: Vec3<T>| (w.x() * w.x() + w.y() * w.y()).sqrt().min(T::ONE);
        let (sin_alpha, sin_beta) = (sine(a), sine(b));
        let product = sin_alpha * sin_beta;
        let (cos_phi, sin_phi) = if product > T::ZERO {
            let cross = T::difference_of_products(a.x(), b.y(), a.y(), b.x());
            (
                ((a.x() * b.x() + a.y() * b.y()) / product).clamp_to(-T::ONE, T::ONE),
                (cross / product).clamp_to(-T::ONE, T::ONE),
            )
        } else {
            (T::ZERO, T::ONE) // φ is undefined along the normal, and every term with it has the factor 0
        };
        let one_minus_abs_cos_phi = sin_phi * sin_phi / (T::ONE + cos_phi.abs());
        Self {
            sin_alpha,
            cos_alpha: a.z(),
            sin_beta,
            cos_beta: b.z(),
            cos_phi,
            one_minus_abs_cos_phi,
        }
    }

    /// `(sin α − (2β/π)³ where cos φ < 0, 2β/π)`
    #[inline(always)]
    fn backward_difference(&self) -> (T, T) {
        let two_over_pi = T::TWO * T::FRAC_1_PI;
        if self.cos_beta > T::HALF {
            let b = two_over_pi * self.sin_beta.atan2(self.cos_beta);
            let cube = if self.cos_phi < T::ZERO { b * b * b } else { T::ZERO };
            return (self.sin_alpha - cube, b);
        }
        // With 2β/π = 1 − q: sin α − (1 − q)³ = q (3 − 3q + q²) − cos² α / (1 + sin α).
        let q = two_over_pi * self.cos_beta.atan2(self.sin_beta);
        let difference = if self.cos_phi < T::ZERO {
            q * (T::lit(3.0) - q * (T::lit(3.0) - q))
                - self.cos_alpha * self.cos_alpha / (T::ONE + self.sin_alpha)
        } else {
            self.sin_alpha
        };
        (difference, T::ONE - q)
    }
}

impl<C: Spectrum> Bsdf for OrenNayar<C> {
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
        let w = Angles::<C::Real>::new(wo, wi);
        let (difference, b) = w.backward_difference();
        let a = C::Real::TWO * C::Real::FRAC_1_PI * w.sin_alpha.atan2(w.cos_alpha);
        let c2 = C::Real::lit(0.45) * self.share * difference;
        let c3 = C::Real::lit(0.125) * self.share * (a * b) * (a * b);
        let tan_beta = w.sin_beta / w.cos_beta;
        let tan_mean = (w.sin_alpha + w.sin_beta) / (w.cos_alpha + w.cos_beta);
        let direct = self.c1 + c2 * w.cos_phi * tan_beta + c3 * w.one_minus_abs_cos_phi * tan_mean;
        let twice = self.c4 * (one - w.cos_phi * b * b);
        // Where both cosines are subnormal the tangent overflows.
        let value = self.reflectance.map(|rho| {
            (rho * C::Real::FRAC_1_PI * (direct + rho * twice))
                .max(C::Real::ZERO)
                .min(largest_value())
        });
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
    name: "oren-nayar",
    type_name: "OrenNayar",
    parameters: &[parameter::REFLECTANCE, parameter::SIGMA],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Gains { maximum: 1.0509, at: "sigma = 0.3, cos -> 0" },
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::Quadrature,
    density: "cosine",
    source: "Oren and Nayar 1994, eqs. 27 to 29",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use crate::quadrature::directional_albedo;
    use etendue_math::glam::DVec3;

    fn model(sigma: f64) -> OrenNayar<f64> {
        OrenNayar::new(Reflectance::white(), Sigma::new(sigma).unwrap())
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for sigma in [0.0, 0.3, 1.5] {
            laws::reciprocal(&model(sigma), 1e-12);
            laws::sampling_matches_density(&model(sigma), 1e-13);
            laws::total(&model(sigma));
        }
        laws::total(&OrenNayar::new(Reflectance::<f32>::white(), Sigma::new(0.3).unwrap()));
    }

    #[test]
    fn without_roughness_it_is_lamberts() {
        let f = model(0.0).eval(DVec3::new(0.6, 0.0, 0.8), DVec3::new(-0.8, 0.0, 0.6));
        assert_eq!(f, f64::FRAC_1_PI);
    }

    #[test]
    fn the_known_albedo_is_reproduced_gain_included() {
        for (sigma, want) in
            [(0.3, [0.962, 0.971, 1.004, 1.032]), (1.0, [0.775, 0.790, 0.852, 0.902])]
        {
            for (theta, want) in [0.01_f64, 0.8, 1.3, 1.5].into_iter().zip(want) {
                let wo = DVec3::new(Real::sin(theta), 0.0, Real::cos(theta));
                let got = directional_albedo::<_, 64>(&model(sigma), wo);
                // Three published digits, and kinks in θ and φ that the rule sees at 1e-3.
                assert!((got - want).abs() < 1.5e-3, "{sigma} {theta} {got}");
            }
        }
    }

    #[test]
    fn opposite_grazing_is_clamped_where_the_formula_is_negative() {
        let f = OrenNayar::new(Reflectance::new(0.01).unwrap(), Sigma::new(1.0).unwrap());
        let (sin, cos) = (1e-3_f64.mul_add(-5e-4, 1.0), 1e-3);
        assert_eq!(f.eval(DVec3::new(sin, 0.0, cos), DVec3::new(-sin, 0.0, cos)), 0.0);
    }
}
