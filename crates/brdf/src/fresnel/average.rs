//! Cosine-weighted averages of the Fresnel reflectance over the hemisphere.

use etendue_math::quadrature::gauss_legendre;
use etendue_math::{Real, Spectrum};

use super::{conductor, dielectric};
use crate::ComplexIor;

/// Average reflectance of a smooth dielectric interface under diffuse light.
///
/// ```text
/// F_avg(η) = 2 ∫₀¹ F(c, η) c dc,           η ≥ 1, by quadrature in c = t²
/// F_avg(η) = 1 − η² (1 − F_avg(1/η)),      η < 1, total internal reflection included
/// ```
///
/// * `eta`: n(far side) / n(side the light is on), positive and finite; 0 outside.
///   Larger than 1 for light from outside, smaller than 1 for light trapped inside.
///
/// # Precision
/// Relative error below 1e-9 in `f64` for η in `[1.01, 10]` (checked against the closed form), and
/// a few ulp in `f32`. Not for hot paths: 48 evaluations.
///
/// # Source
/// The relation between the two sides: Egan and Hilgeman, Optical Properties of Inhomogeneous
/// Materials, 1979; it is the reciprocity of Fresnel transmission.
pub fn dielectric_average<T: Real>(eta: T) -> T {
    if !(eta > T::ZERO && eta < T::INFINITY) {
        return T::ZERO;
    }
    if eta < T::ONE {
        return T::ONE - eta * eta * (T::ONE - dielectric_average(T::ONE / eta));
    }
    // F changes over c ~ √(η² − 1); c = t² puts nodes there. 2 c dc = 4 t³ dt.
    let eta = eta.to_f64();
    let sum: f64 = gauss_legendre::<f64, 48>()
        .iter()
        .map(|&(t, w)| w * dielectric(t * t, eta) * 4.0 * t * t * t)
        .sum();
    T::lit(sum)
}

/// Polynomial fits of [`dielectric_average`].
///
/// ```text
/// η < 1:  −1.4399 η² + 0.7099 η + 0.6681 + 0.0636/η
/// η ≥ 1:  0.919317 − 3.4793/η + 6.75335/η² − 7.80989/η³ + 4.98554/η⁴ − 1.36881/η⁵
/// ```
///
/// * `eta`: as for [`dielectric_average`]; 0 outside its domain.
///
/// # Precision
/// Against the exact average: 0.1 % for 1/η in `[1, 1.5]`, 0.6 % to 2, 9.5 % to 5 for light from
/// inside; 0.1 % for η to 2 and 0.2 % to 10 for light from outside.
///
/// # Source
/// W. Egan and T. Hilgeman 1973 (η < 1); E. d'Eon and G. Irving, "A Quantized-Diffusion Model for
/// Rendering Translucent Materials", SIGGRAPH 2011 (η ≥ 1). The pair is what Mitsuba uses.
pub fn dielectric_average_fit<T: Real>(eta: T) -> T {
    let horner = |x: T, coefficients: &[f64]| {
        coefficients.iter().rev().fold(T::ZERO, |sum, &c| sum * x + T::lit(c))
    };
    if !(eta > T::ZERO && eta < T::INFINITY) {
        T::ZERO
    } else if eta < T::ONE {
        horner(eta, &[0.6681, 0.7099, -1.4399]) + T::lit(0.0636) / eta
    } else {
        horner(T::ONE / eta, &[0.919317, -3.4793, 6.75335, -7.80989, 4.98554, -1.36881])
    }
}

/// Cosine-weighted average of Schlick's approximation.
///
/// ```text
/// F_avg = F0 + (1 − F0) / 21
/// ```
///
/// `f0` per channel in `[0, 1]`.
#[inline]
pub fn schlick_average<C: Spectrum>(f0: C) -> C {
    f0.map(|f| f + (C::Real::ONE - f) / C::Real::lit(21.0))
}

/// Average reflectance of a smooth conductor under diffuse light, per channel.
///
/// ```text
/// F_avg = 2 ∫₀¹ F(c, η, k) c dc
/// ```
///
/// # Precision
/// Within 1e-6 for the indices of metals, 24 Gauss–Legendre nodes: for constructors.
pub fn conductor_average<C: Spectrum>(ior: ComplexIor<C>) -> C {
    let mut sum = C::black();
    for (t, w) in gauss_legendre::<C::Real, 24>() {
        // c = t²: F falls steeply from grazing. 2 c dc = 4 t³ dt.
        let weight = w * C::Real::lit(4.0) * t * t * t;
        sum += ior.eta().zip(ior.k(), |eta, k| weight * conductor(t * t, eta, k));
    }
    sum.map(|f| f.min(C::Real::ONE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::schlick;

    /// Walsh 1926 / Duntley 1942, the closed form for η > 1; cancels for η → 1.
    fn closed_form(n: f64) -> f64 {
        let n2 = n * n;
        let n4 = n2 * n2;
        0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * Real::sqr(n + 1.0))
            + n2 * Real::sqr(n2 - 1.0) / Real::powi(n2 + 1.0, 3) * Real::ln((n - 1.0) / (n + 1.0))
            - 2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n4 - 1.0))
            + 8.0 * n4 * (n4 + 1.0) / ((n2 + 1.0) * Real::sqr(n4 - 1.0)) * Real::ln(n)
    }

    #[test]
    fn quadrature_agrees_with_the_closed_form_on_both_sides() {
        for eta in [1.01, 1.1, 1.33, 1.5, 2.4, 10.0] {
            let want = closed_form(eta);
            let got = dielectric_average(eta);
            assert!((got - want).abs() < 1e-9 * want, "{eta} {got} {want}");
            let inside = dielectric_average(1.0 / eta);
            let want = 1.0 - (1.0 - want) / (eta * eta);
            assert!((inside - want).abs() < 1e-9 * want, "{eta} {inside} {want}");
        }
    }

    #[test]
    fn the_fits_are_within_their_published_error() {
        for (eta, bound) in [(1.1, 1e-2), (1.5, 2e-3), (1.9, 3e-3)] {
            let (fit, exact) = (dielectric_average_fit(eta), dielectric_average(eta));
            assert!((fit - exact).abs() < bound * exact.max(0.1), "{eta} {fit} {exact}");
            let (fit, exact) = (dielectric_average_fit(1.0 / eta), dielectric_average(1.0 / eta));
            assert!((fit - exact).abs() < 1e-2 * exact, "1/{eta} {fit} {exact}");
        }
    }

    #[test]
    fn the_average_of_a_conductor_without_extinction_is_that_of_a_dielectric() {
        for eta in [1.33, 1.5, 2.4] {
            let got: f64 = conductor_average(ComplexIor::new(eta, 0.0).unwrap());
            // 24 against 48 nodes, as stated.
            assert!((got - dielectric_average(eta)).abs() < 1e-6, "{eta} {got}");
        }
        let mirror: f64 = conductor_average(ComplexIor::perfect());
        // 24 weights that add up to 1.
        assert!((mirror - 1.0).abs() < 1e-14);
    }

    #[test]
    fn schlicks_average_is_its_integral() {
        let sum: f64 =
            gauss_legendre::<f64, 8>().iter().map(|&(c, w)| w * 2.0 * c * schlick(0.3, c)).sum();
        // The integrand is a polynomial of degree 6: exact but for rounding.
        assert!((sum - schlick_average(0.3)).abs() < 1e-15);
    }
}
