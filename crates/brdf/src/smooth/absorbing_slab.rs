//! A thin pane of tinted glass.

use etendue_math::{Real, Spectrum, Vector3};

use crate::bsdf::above;
use crate::direction::reflect;
use crate::fresnel::{RelativeIndex, dielectric, dielectric_transmittance};
use crate::registry::{Albedo, Energy, ModelInfo, Reciprocity, parameter};
use crate::{Bsdf, BsdfReal, BsdfVec, Density, Ior, Lobes, OpticalDepth, Sample};

/// [`ThinDielectric`](crate::ThinDielectric) whose inside absorbs: all internal reflections summed, each passage
/// attenuated.
///
/// ```text
/// A = exp(−τ / cos θt),  R = F(cos θ, η),  T = 1 − R,  a = 1 − A
/// R' = R (a (1 + A) + 2 A² T) / ((a + A T)(1 + R A)),   T' = A T² / ((a + A T)(1 + R A))
/// reflection:    wi = (−x, −y, z),  weight = R'/p,        probability p = mean R' / (mean R' + mean T')
/// transmission:  wi = −wo,          weight = T'/(1 − p),  probability 1 − p
/// ```
///
/// * Parameters: η and the optical depth τ = σa d per channel. The thickness d is small against everything else in
///   the scene, but need not be against 1/σa.
/// * Laws: reciprocal; albedo `R' + T' ≤ 1`. Delta, two-sided, the same from both sides.
/// * Sampling: `u_lobe` chooses between the two; `None` at `wo.z = 0` and for zero weights.
///
/// # Precision
/// A few ulp times the condition of the problem: all sums are of terms of one sign. The series
/// `R + A² T² R / (1 − A² R²)` loses the digits of `1 − R'` for R → 1.
///
/// # Source
/// The geometric series of a plane-parallel slab without interference: O. Heavens, Optical
/// Properties of Thin Solid Films, 1955.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AbsorbingSlab<C: Spectrum> {
    eta: C::Real,
    depth: OpticalDepth<C>,
}

impl<C: Spectrum> AbsorbingSlab<C> {
    /// A slab whose index relative to its surroundings is `eta`; for the depth see
    /// [`Absorption::depth`](crate::Absorption::depth).
    #[inline]
    pub fn new(eta: Ior<C::Real>, depth: OpticalDepth<C>) -> Self {
        Self { eta: eta.value(), depth }
    }

    /// `[R', T']` at the cosine of incidence.
    #[inline]
    fn shares(&self, cos: C::Real) -> [C; 2] {
        let one = <C::Real as Real>::ONE;
        let Some(g) = RelativeIndex::from_above(self.eta).scaled_cos_t(cos) else {
            return [C::white(), C::black()];
        };
        let (r, t) = (dielectric(cos, self.eta), dielectric_transmittance(cos, self.eta));
        let cos_t = g / self.eta;
        let [passed, lost] = [self.depth.transmittance(cos_t), self.depth.absorptance(cos_t)];
        let denominator = |pass: C::Real, lose: C::Real| (lose + pass * t) * (one + r * pass);
        let reflected = passed.zip(lost, |pass, lose| {
            let sum = denominator(pass, lose);
            let back = lose * (one + pass) + C::Real::TWO * pass * pass * t;
            // At grazing incidence without absorption nothing enters.
            if sum > C::Real::ZERO { (r * (back / sum)).min(one) } else { one }
        });
        let transmitted = passed.zip(lost, |pass, lose| {
            let sum = denominator(pass, lose);
            if sum > C::Real::ZERO { (pass * t * (t / sum)).min(one) } else { C::Real::ZERO }
        });
        [reflected, transmitted]
    }
}

impl<C: Spectrum> Bsdf for AbsorbingSlab<C> {
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
        let one = <C::Real as Real>::ONE;
        let [reflected, transmitted] = self.shares(wo.z().abs());
        let (r, sum) = (reflected.mean(), reflected.mean() + transmitted.mean());
        if !(sum > C::Real::ZERO) {
            return None;
        }
        let p = r / sum;
        let (wi, share, p) =
            if u_lobe < p { (reflect(wo), reflected, p) } else { (-wo, transmitted, one - p) };
        (!share.is_black() && p > C::Real::ZERO).then(|| Sample {
            wi,
            weight: share.scale(one / p),
            density: Density::Delta(p),
            eta: one,
        })
    }

    #[inline]
    fn albedo(&self, wo: BsdfVec<Self>) -> Option<C> {
        if !above(wo) && !above(-wo) {
            return Some(C::black());
        }
        let [reflected, transmitted] = self.shares(wo.z().abs());
        Some(reflected + transmitted)
    }
}

/// The entry of the model in the [registry](crate::registry).
pub(crate) const INFO: ModelInfo = ModelInfo {
    name: "absorbing-slab",
    type_name: "AbsorbingSlab",
    parameters: &[
        parameter::ETA,
        parameter::named("optical_depth", "each channel finite, not negative"),
    ],
    reciprocity: Reciprocity::Reciprocal,
    energy: Energy::Conserves,
    lobes: Lobes::DELTA_THROUGH,
    albedo: Albedo::ClosedForm,
    density: "delta, by the mean shares",
    source: "Heavens 1955",
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ThinDielectric, laws};
    use etendue_math::Rgb;
    use etendue_math::glam::DVec3;

    fn pane(eta: f64, sigma: f64) -> AbsorbingSlab<f64> {
        AbsorbingSlab::new(Ior::new(eta).unwrap(), OpticalDepth::new(sigma).unwrap())
    }

    fn at(z: f64) -> DVec3 {
        DVec3::new((1.0 - z * z).sqrt(), 0.0, z)
    }

    #[test]
    fn the_series_of_attenuated_reflections_is_summed() {
        for (z, sigma) in [(0.8_f64, 0.3), (0.3, 2.0), (1.0, 1e-3)] {
            let (r, cos_t) = (dielectric(z, 1.5), (1.0 - (1.0 - z * z) / 2.25).sqrt());
            let pass = Real::exp(-sigma / cos_t);
            let (mut reflected, mut through) = (r, 0.0);
            let mut inside = (1.0 - r) * pass;
            for bounce in 0..60 {
                let sum = if bounce % 2 == 0 { &mut through } else { &mut reflected };
                *sum += inside * (1.0 - r);
                inside *= r * pass;
            }
            let [r, t] = pane(1.5, sigma).shares(z);
            assert!((r - reflected).abs() < 1e-15 && (t - through).abs() < 1e-15, "{z} {sigma}");
        }
    }

    #[test]
    fn clear_glass_is_the_thin_dielectric_and_thick_tint_its_front() {
        let clear = ThinDielectric::<f64>::new(Ior::new(1.5).unwrap());
        for z in [1.0, 0.5, 1e-3, 1e-9] {
            let (a, b) =
                (pane(1.5, 0.0).sample(at(z), 0.0, [0.0; 2]), clear.sample(at(z), 0.0, [0.0; 2]));
            let share = |s: Option<Sample<f64>>| match s.unwrap() {
                Sample { weight, density: Density::Delta(p), .. } => weight * p,
                _ => f64::NAN,
            };
            assert!((share(a) - share(b)).abs() < 1e-15, "{z}");
            assert!((pane(1.5, 1e3).albedo(at(z)).unwrap() - dielectric(z, 1.5)).abs() < 1e-15);
        }
    }

    #[test]
    fn every_channel_has_its_own_colour() {
        let depth = OpticalDepth::new(Rgb::new(0.05_f32, 0.5, 5.0)).unwrap();
        let slab = AbsorbingSlab::new(Ior::new(1.5).unwrap(), depth);
        let s = slab.sample(etendue_math::glam::Vec3::Z, 0.999, [0.0; 2]).unwrap();
        assert!(s.wi.z < 0.0 && s.weight.r > s.weight.g && s.weight.g > s.weight.b);
        laws::total(&slab);
    }

    #[test]
    fn no_input_is_a_nan() {
        for eta in [0.5, 1.0, 1.000_001, 1.5, 1e4] {
            for sigma in [0.0, 1e-9, 1.0, 1e30] {
                laws::total(&pane(eta, sigma));
            }
        }
    }
}
