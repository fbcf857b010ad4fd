//! Schlick's approximation bent to an edge colour at 82°.

use etendue_math::{Real, Spectrum};

use super::schlick::fifth_power;
use super::{checked_cosine, schlick_average};
use crate::Reflectance;

/// Fresnel reflectance of a metal by its colours at normal incidence and at 82°, prepared once.
///
/// ```text
/// S(c) = F0 + (1 − F0)(1 − c)⁵,  μ = 1/7 (81.8°)
/// F(c) = max(0, S(c) − b c (1 − c)⁶),  b = (S(μ) − F82) / (μ (1 − μ)⁶)
/// ```
///
/// `c (1 − c)⁶` has its maximum at μ and vanishes at both ends, so that F is F0 at normal incidence,
/// F82 at μ and 1 at grazing incidence.
///
/// * Domain: F0 and the tint (or F82) per channel in `[0, 1]`, by the type [`Reflectance`].
/// * The formula turns negative beside μ for dark edges (tints below 0.52 at F0 = 0, 0.24 at 0.1,
///   0.09 at 0.3), which no metal has: F is 0 there.
///
/// # Precision
/// A few ulp of `S + b c (1 − c)⁶`.
///
/// # Source
/// C. Kutz, M. Hašan, A. Edmondson, "Novel aspects of the Adobe Standard Material", Adobe 2021, after
/// N. Hoffman, "Fresnel Equations Considered Harmful", MAM 2019; the metal of OpenPBR.
///
/// # Examples
/// ```
/// use etendue_brdf::{Reflectance, fresnel::F82Tint};
/// let metal = F82Tint::new(Reflectance::new(0.9_f64)?, Reflectance::new(0.7)?);
/// let schlick = 0.9 + 0.1 * (6.0_f64 / 7.0).powi(5);
/// assert!((metal.reflectance(1.0 / 7.0) - 0.7 * schlick).abs() < 1e-15);
/// # Ok::<(), etendue_brdf::ParameterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct F82Tint<C> {
    f0: C,
    /// `b`; negative where F82 lies above Schlick's curve.
    b: C,
}

/// `μ (1 − μ)⁶` and `(1 − μ)⁵` at μ = 1/7.
const PEAK: f64 = 46_656.0 / 823_543.0;
const FIFTH_POWER: f64 = 7_776.0 / 16_807.0;

impl<C: Spectrum> F82Tint<C> {
    /// By the colour `f0` at normal incidence and the share `tint` of Schlick's value that is
    /// reflected at 82°: `F82 = tint S(μ)`. White is Schlick's curve itself.
    #[inline]
    pub fn new(f0: Reflectance<C>, tint: Reflectance<C>) -> Self {
        let (f0, tint) = (f0.value(), tint.value());
        let one = <C::Real as Real>::ONE;
        let b = schlick_at_peak(f0).zip(tint, |s, t| s * (one - t) / C::Real::lit(PEAK));
        Self { f0, b }
    }

    /// By the colours at normal incidence and at 82°.
    #[inline]
    pub fn from_f82(f0: Reflectance<C>, f82: Reflectance<C>) -> Self {
        let (f0, f82) = (f0.value(), f82.value());
        let b = (schlick_at_peak(f0) - f82).map(|d| d / C::Real::lit(PEAK));
        Self { f0, b }
    }

    /// F at the cosine of incidence `cos_i`, in `[0, 1]`; 0 outside the domain of the
    /// [module](crate::fresnel).
    #[inline]
    pub fn reflectance(&self, cos_i: C::Real) -> C {
        let one = <C::Real as Real>::ONE;
        let Some(c) = checked_cosine(cos_i) else { return C::black() };
        let m = one - c;
        let m5 = fifth_power(m);
        let dip = c * m * m5;
        self.f0.zip(self.b, |f, b| (f + (one - f) * m5 - b * dip).clamp_to(C::Real::ZERO, one))
    }

    /// Cosine-weighted average over the hemisphere.
    ///
    /// ```text
    /// F_avg = 2 ∫₀¹ F c dc = F0 + (1 − F0)/21 − b/126
    /// ```
    ///
    /// Exact wherever the formula is not negative; too low by up to 0.016 for the darkest edges (F0 ≤ 0.03,
    /// tint 0), and limited to 0.
    #[inline]
    pub fn average(&self) -> C {
        let dip = self.b.map(|b| b / C::Real::lit(126.0));
        (schlick_average(self.f0) - dip).map(|f| f.clamp_to(C::Real::ZERO, C::Real::ONE))
    }
}

/// Schlick's curve at μ.
#[inline]
fn schlick_at_peak<C: Spectrum>(f0: C) -> C {
    f0.map(|f| f + (C::Real::ONE - f) * C::Real::lit(FIFTH_POWER))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::schlick;
    use etendue_math::quadrature::gauss_legendre;

    fn metal(f0: f64, tint: f64) -> F82Tint<f64> {
        F82Tint::new(Reflectance::new(f0).unwrap(), Reflectance::new(tint).unwrap())
    }

    fn integral(model: F82Tint<f64>) -> f64 {
        gauss_legendre::<f64, 64>().iter().map(|&(c, w)| w * 2.0 * c * model.reflectance(c)).sum()
    }

    #[test]
    fn the_curve_passes_through_its_three_colours() {
        let aluminium =
            F82Tint::from_f82(Reflectance::new(0.912).unwrap(), Reflectance::new(0.87).unwrap());
        assert_eq!(aluminium.reflectance(1.0), 0.912);
        assert_eq!(aluminium.reflectance(0.0), 1.0);
        // Three products of numbers below 20.
        assert!((aluminium.reflectance(1.0 / 7.0) - 0.87).abs() < 1e-14);
    }

    #[test]
    fn a_white_tint_is_schlick() {
        for i in 0..=100 {
            let c = f64::from(i) / 100.0;
            assert_eq!(metal(0.3, 1.0).reflectance(c), schlick(0.3, c));
        }
    }

    #[test]
    fn the_average_is_the_integral() {
        for (f0, tint) in [(0.0, 0.6), (0.3, 0.2), (0.9, 0.7), (1.0, 0.0), (0.5, 1.0)] {
            let model = metal(f0, tint);
            // A polynomial of degree 8: exact but for rounding.
            assert!((model.average() - integral(model)).abs() < 1e-14, "{f0} {tint}");
        }
    }

    #[test]
    fn dark_edges_are_black_and_not_negative() {
        let darkest = metal(0.0, 0.0);
        assert_eq!(darkest.reflectance(0.3), 0.0);
        let error = integral(darkest) - darkest.average();
        assert!(error > 0.0 && error < 0.016, "{error}");
        assert_eq!(darkest.reflectance(f64::NAN), 0.0);
    }
}
