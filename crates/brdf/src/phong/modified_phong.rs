//! Phong's model in the physically plausible form of Lafortune and Willems.

use etendue_math::special::{gamma_half_step, incomplete_beta_half};
use etendue_math::{Frame, Real, Spectrum, Vec3, Vector3};
use etendue_sampling::warp::{cosine_hemisphere, turn};

use crate::bsdf::{above, both_above};
use crate::direction::reflect;
use crate::mixture::mixture_sample;
use crate::param::{at_most_all_together, scaled_to_all_together};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Exponent, Lobes, ParameterError, Reflectance, Sample};

/// A diffuse part and a power of the cosine around the mirror direction.
///
/// ```text
/// f = kd/π + ks (n + 2)/(2π) max(cos α, 0)ⁿ,   α between wi and the mirror direction of wo
/// ```
///
/// * Laws: reciprocal; directional albedo ≤ kd + ks ≤ 1, which the constructor checks. The lobe loses what it sends
///   below the horizon: with θ the angle of `wo`, `p = n/2 + 1` and `I` the regularised incomplete beta function,
///
/// ```text
/// R = kd + ks [½ cos θ (1 + I(½, p; cos² θ)) + sin²ᵖ θ Γ(p − ½) / (2 √π Γ(p))]
/// ```
///
/// * Sampling: `u_lobe` chooses the lobe with probability `mean(ks) / (mean(kd) + mean(ks))`,
///   `p = (n + 1)/(2π) cosⁿ α`, or else the cosine; both densities count. `None` from below, and where the lobe's
///   sample falls below the surface.
///
/// # Precision
/// A few ulp times the condition of the problem, up to n = 1e12: with `d²` the squared distance between `wi` and the
/// mirror direction, `cosⁿ α = exp(n log1p(−d²/2))`.
///
/// # Source
/// E. Lafortune and Y. Willems, "Using the Modified Phong Reflectance Model for Physically Based Rendering", report
/// CW197, KU Leuven, 1994. The albedo is derived here: in polar coordinates around the mirror direction the horizon
/// cuts the circles of constant α at `cos φ = −cot θ cot α`; one integration by parts leaves beta integrals.
///
/// # Examples
/// ```
/// use etendue_brdf::{Bsdf, Exponent, Phong, Reflectance};
/// use etendue_math::glam::DVec3;
/// let [kd, ks] = [Reflectance::new(0.3_f64)?, Reflectance::new(0.6)?];
/// let model = Phong::new(kd, ks, Exponent::new(50.0)?)?;
/// assert!((model.albedo(DVec3::Z).unwrap() - 0.9).abs() < 1e-15);
/// assert!(Phong::new(ks, ks, Exponent::new(50.0)?).is_err());
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong<C: Spectrum> {
    diffuse: C,
    specular: C,
    exponent: C::Real,
    /// Probabilities of choosing the cosine and the lobe: both, since one from the other would cancel.
    probability: [C::Real; 2],
}

impl<C: Spectrum> Phong<C> {
    /// The model with diffuse share kd, specular share ks and exponent n.
    ///
    /// # Errors
    /// [`ParameterError`] where kd + ks > 1 in a channel.
    pub fn new(
        diffuse: Reflectance<C>,
        specular: Reflectance<C>,
        exponent: Exponent<C::Real>,
    ) -> Result<Self, ParameterError> {
        at_most_all_together("kd + ks", diffuse, specular)?;
        Ok(Self::of_shares([diffuse, specular], exponent))
    }

    /// The same with kd and ks made smaller by one factor where they exceed 1 together in a channel: for values read from
    /// textures.
    #[inline]
    pub fn clamped(
        diffuse: Reflectance<C>,
        specular: Reflectance<C>,
        exponent: Exponent<C::Real>,
    ) -> Self {
        Self::of_shares(scaled_to_all_together(diffuse, specular), exponent)
    }

    #[inline]
    fn of_shares(shares: [Reflectance<C>; 2], exponent: Exponent<C::Real>) -> Self {
        let ([diffuse, specular], exponent) = (shares.map(Reflectance::value), exponent.value());
        let (d, s) = (diffuse.mean(), specular.mean());
        let share = |x| if d + s > C::Real::ZERO { x / (d + s) } else { C::Real::ZERO };
        Self { diffuse, specular, exponent, probability: [share(d), share(s)] }
    }

    /// `cos^(n/2) α`: half the power, because the whole may underflow where the product with n does not.
    #[inline(always)]
    fn root_of_power(&self, wo: Vec3<C::Real>, wi: Vec3<C::Real>) -> C::Real {
        let (x, y, z) = (wo.x() + wi.x(), wo.y() + wi.y(), wo.z() - wi.z());
        let versine = C::Real::HALF * (x * x + y * y + z * z);
        if versine < C::Real::ONE {
            (C::Real::HALF * self.exponent * (-versine).ln_1p()).exp()
        } else {
            C::Real::ZERO
        }
    }

    /// The albedo of the lobe for ks = 1.
    fn lobe_albedo(&self, wo: Vec3<C::Real>) -> C::Real {
        let one = <C::Real as Real>::ONE;
        let cos = wo.z().min(one);
        let cos_squared = cos * cos;
        let p = C::Real::HALF * self.exponent + one;
        let above = C::Real::HALF * cos * (one + incomplete_beta_half(p, cos_squared));
        let half_inverse_root_pi = C::Real::lit(0.25 * core::f64::consts::FRAC_2_SQRT_PI);
        let cut = gamma_half_step(p - C::Real::HALF) * half_inverse_root_pi;
        above + (p * (-cos_squared).ln_1p()).exp() * cut
    }
}

impl<C: Spectrum> Bsdf for Phong<C> {
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
        let root = self.root_of_power(wo, wi);
        let lobe = |factor| factor * (C::Real::HALF * C::Real::FRAC_1_PI) * root * root;
        let value = self.diffuse.scale(C::Real::FRAC_1_PI)
            + self.specular.scale(lobe(self.exponent + C::Real::TWO));
        let pdf = self.probability[0] * cosine_hemisphere::pdf::<C::Real>(wi)
            + self.probability[1] * lobe(self.exponent + one);
        (value, pdf)
    }

    #[inline]
    fn sample(
        &self,
        wo: BsdfVec<Self>,
        u_lobe: BsdfReal<Self>,
        u: [BsdfReal<Self>; 2],
    ) -> Option<Sample<C>> {
        if !above(wo) {
            return None;
        }
        let one = <C::Real as Real>::ONE;
        let wi = if u_lobe < self.probability[1] {
            let log_cos = (-u[0]).ln_1p() / (self.exponent + one);
            let sin_alpha = (-(C::Real::TWO * log_cos).exp_m1()).safe_sqrt();
            let (sin, cos) = turn::sin_cos(u[1]);
            let around = Vec3::<C::Real>::new(sin_alpha * cos, sin_alpha * sin, log_cos.exp());
            Frame::<C::Real>::from_normal(reflect(wo)).to_world(around)
        } else {
            cosine_hemisphere::from_square(u)
        };
        mixture_sample(self, wo, wi)
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        if !above(wo) {
            return Some(C::black());
        }
        Some(self.diffuse + self.specular.scale(self.lobe_albedo(wo)))
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "phong",
    type_name: "Phong",
    parameters: &[
        parameter::named("kd", "each channel in [0, 1]"),
        parameter::named("ks", "each channel in [0, 1], with kd at most 1"),
        parameter::named("exponent", "in [0, 1e12]"),
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::CONTINUOUS,
    albedo: Albedo::ClosedForm,
    density: "cosine, or the lobe, by mean colours",
    source: "Lafortune and Willems 1994",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::laws;
    use etendue_math::glam::DVec3;

    fn model<T: Real + Spectrum<Real = T>>(kd: f64, ks: f64, n: f64) -> Phong<T> {
        let [kd, ks] = [kd, ks].map(|k| Reflectance::new(T::lit(k)).unwrap());
        Phong::new(kd, ks, Exponent::new(T::lit(n)).unwrap()).unwrap()
    }

    fn viewer(z: f64) -> DVec3 {
        DVec3::new((1.0 - z * z).sqrt(), 0.0, z)
    }

    #[test]
    fn it_obeys_the_laws_of_a_bsdf() {
        for (kd, ks, n) in [(0.5, 0.5, 0.0), (0.2, 0.7, 30.0), (0.0, 1.0, 5.5), (1.0, 0.0, 3.0)] {
            let model = model::<f64>(kd, ks, n);
            laws::reciprocal(&model, 1e-13);
            laws::sampling_matches_density(&model, 1e-12);
            laws::total(&model);
        }
        laws::density_integrates_to_at_most_one(&model::<f64>(0.3, 0.7, 20.0));
        laws::total(&model::<f32>(0.1, 0.9, 1e6));
        laws::total(&model::<f32>(0.0, 1.0, 1e12));
    }

    #[test]
    fn the_albedo_is_its_closed_form() {
        for n in [0.0, 0.5, 1.0, 10.0, 33.3] {
            // cosⁿ α is cut off at α = π/2, with a kink for small n, that the rule sees at 1e-3.
            laws::albedo_is_closed_form(&model::<f64>(0.1, 0.9, n), 2e-3);
        }
    }

    #[test]
    fn the_albedo_of_the_lobe_is_the_known_one() {
        // n = 10, to three digits; 40 digits by numerical integration gave 0.700305…, 0.179158….
        for (z, want) in [(1.0, 1.0), (0.7, 0.700_305_363_7), (0.1, 0.179_158_448_3)] {
            let got = model::<f64>(0.0, 1.0, 10.0).albedo(viewer(z)).unwrap();
            assert!((got - want).abs() < 1e-9, "{z}: {got}");
        }
        // A lobe without width is a mirror that is seen foreshortened; one half of a flat lobe is below.
        let needle = model::<f64>(0.0, 1.0, 1e12).albedo(viewer(0.3)).unwrap();
        assert!((needle - 0.3).abs() < 1e-9, "{needle}");
        let flat = model::<f64>(0.0, 1.0, 0.0).albedo(viewer(1e-9)).unwrap();
        assert!((flat - 0.5).abs() < 1e-8, "{flat}");
    }

    #[test]
    fn weights_of_samples_add_up_to_the_albedo_however_narrow_the_lobe() {
        for n in [5.0, 300.0, 1e4, 1e7] {
            let model = model::<f64>(0.2, 0.6, n);
            for z in [0.05, 0.4, 1.0] {
                let unit = |i: i32| (f64::from(i) + 0.5) / 32.0;
                let sum: f64 = (0..32 * 32 * 32)
                    .filter_map(|i| {
                        let u = [unit(i % 32), unit(i / 32 % 32)];
                        model.sample(viewer(z), unit(i / 1024), u)
                    })
                    .map(|s| s.weight)
                    .sum();
                // The midpoint rule in three dimensions, with jumps at the horizon and where the lobe is chosen.
                let (mean, want) = (sum / 32.0 / 1024.0, model.albedo(viewer(z)).unwrap());
                assert!((mean - want).abs() < 5e-3, "{n} {z}: {mean} {want}");
            }
        }
    }

    #[test]
    fn shares_beyond_the_light_are_refused() {
        let [kd, ks] = [0.6, 0.5].map(|k| Reflectance::new(k).unwrap());
        assert!(Phong::new(kd, ks, Exponent::new(1.0).unwrap()).is_err());
    }

    #[test]
    fn shares_beyond_the_light_can_be_scaled() {
        let [kd, ks] = [0.9_f64, 0.6].map(|k| Reflectance::new(k).unwrap());
        let exponent = Exponent::new(4.0).unwrap();
        let model = Phong::clamped(kd, ks, exponent);
        // One rounding of each share.
        assert!((model.albedo(DVec3::Z).unwrap() - 1.0).abs() < 1e-15);
        assert!((model.diffuse / model.specular - 1.5).abs() < 1e-15);
        let [kd, ks] = [0.3_f64, 0.6].map(|k| Reflectance::new(k).unwrap());
        assert_eq!(Phong::clamped(kd, ks, exponent), Phong::new(kd, ks, exponent).unwrap());
    }

    #[test]
    fn a_narrow_lobe_keeps_its_digits_in_single_precision() {
        let wo = viewer(0.8).as_vec3();
        for k in 0..20 {
            let wi = viewer(0.8 + f64::from(k) * 1e-4).as_vec3();
            let wi = etendue_math::glam::Vec3::new(-wi.x, 1e-4, wi.z);
            let want = model::<f64>(0.0, 1.0, 1e6).eval(wo.as_dvec3(), wi.as_dvec3());
            let got = model::<f32>(0.0, 1.0, 1e6).eval(wo, wi);
            let exponent = 5e5 * f64::from((wo + wi).truncate().length_squared());
            // Rounding of the exponent, in units of the value, and of the rest.
            let bound = (8.0 + 4.0 * exponent) * f64::from(f32::EPSILON);
            assert!((f64::from(got) / want - 1.0).abs() < bound, "{k}: {got} {want}");
        }
    }
}
