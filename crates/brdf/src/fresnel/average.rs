//! Cosine-weighted averages of the Fresnel reflectance over the hemisphere.

use etendue_math::quadrature::gauss_legendre;
use etendue_math::{Real, Spectrum};

use super::{conductor, dielectric_transmittance};

/// Average reflectance of a smooth dielectric interface under diffuse light.
///
/// ```text
/// F_avg(η) = 2 ∫₀¹ F(c, η) c dc = 1 − T_avg(η),  total internal reflection included
/// ```
///
/// with T_avg from [`dielectric_average_transmittance`].
///
/// * `eta`: n(far side) / n(side the light is on), positive and finite; 0 outside.
///   Larger than 1 for light from outside, smaller than 1 for light trapped inside.
///
/// # Precision
/// Absolute error below 1e-10 in `f64` for η in `[1.01, 10]` and its inverse (checked against the closed form).
/// Not for hot paths: 48 evaluations.
pub fn dielectric_average<T: Real>(eta: T) -> T {
    if !(eta > T::ZERO && eta < T::INFINITY) {
        return T::ZERO;
    }
    T::lit(1.0 - transmitted(eta.to_f64()))
}

/// Average transmittance of a smooth dielectric interface under diffuse light, without the cancellation of
/// `1 − F_avg` for large or small η.
///
/// ```text
/// T_avg(η) = 2 ∫₀¹ (1 − F(c, η)) c dc,   η ≥ 1, by quadrature in c = t²
/// T_avg(η) = η² T_avg(1/η),              η < 1
/// ```
///
/// * `eta`: as for [`dielectric_average`]; 0 outside its domain.
///
/// # Precision
/// Relative error below 1e-10 in `f64` for η in `[1.01, 10]` and its inverse. 48 evaluations.
///
/// # Source
/// The relation between the two sides: Egan and Hilgeman, Optical Properties of Inhomogeneous
/// Materials, 1979; it is the reciprocity of Fresnel transmission.
pub fn dielectric_average_transmittance<T: Real>(eta: T) -> T {
    if !(eta > T::ZERO && eta < T::INFINITY) {
        return T::ZERO;
    }
    T::lit(transmitted(eta.to_f64()))
}

fn transmitted(eta: f64) -> f64 {
    if eta < 1.0 {
        return eta * eta * transmitted(1.0 / eta);
    }
    // F changes over c ~ √(η² − 1); c = t² puts nodes there.
    from_zero(0.0, 1.0, |c| dielectric_transmittance(c, eta))
}

/// `∫ f(c) 2 c dc` from `start` to `end`, with nodes crowding at `start` as `(t end)²` do at 0.
fn from_zero(start: f64, end: f64, f: impl Fn(f64) -> f64) -> f64 {
    let length = end - start;
    gauss_legendre::<f64, 48>()
        .iter()
        .map(|&(t, w)| (start + length * t * t, 4.0 * w * t))
        .map(|(c, weight)| weight * c * length * f(c))
        .sum()
}

/// Average reflectance of a smooth conductor under diffuse light.
///
/// ```text
/// F_avg = 2 ∫₀¹ F(c, η, k) c dc
/// ```
///
/// * `eta`, `k`: as for [`conductor`]; 0 outside its domain.
///
/// By quadrature, split at the cosine `√(1 − η² + k²)` where η < 1 and k is small: there the conductor has
/// what is left of a critical angle.
///
/// # Precision
/// Relative error below 1e-7 in `f64` (against 3000 nodes), 1e-12 for metals. Not for hot paths: up to 96 evaluations.
pub fn conductor_average<T: Real>(eta: T, k: T) -> T {
    let (eta, k) = (eta.to_f64(), k.to_f64());
    let reflectance = |c| conductor(c, eta, k);
    let squared = (1.0 - eta) * (1.0 + eta) + k * k;
    T::lit(if squared > 0.0 && squared < 1.0 {
        let edge = squared.sqrt();
        // Both intervals crowd their nodes at the edge; the lower one runs downwards.
        from_zero(edge, 1.0, reflectance) - from_zero(edge, 0.0, reflectance)
    } else {
        from_zero(0.0, 1.0, reflectance)
    })
}

/// Polynomial fit of [`conductor_average`] for a metal given by its artistic parameters.
///
/// ```text
/// F_avg ≈ 0.087237 + 0.0230685 g − 0.0864902 g² + 0.0774594 g³ + 0.782654 r − 0.136432 r² + 0.278708 r³
///         + 0.19744 r g + 0.0360605 r g² − 0.2586 r² g
/// ```
///
/// * `r`, `g`: reflectivity and edge tint, see [`conductor_from_artistic`](super::conductor_from_artistic),
///   in `[0, 1]`; 0 outside. The result is limited to 1, which the fit passes by 0.012.
///
/// # Precision
/// Against the integral, absolute: 0.012 for r ≥ 0.2 and g ≤ 0.75; up to 0.05 towards g = 1; 0.1 for r → 0.
///
/// # Source
/// C. Kulla, A. Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course.
pub fn conductor_average_fit<T: Real>(r: T, g: T) -> T {
    let unit = |x: T| x >= T::ZERO && x <= T::ONE;
    if !(unit(r) && unit(g)) {
        return T::ZERO;
    }
    let constant = horner(g, &[0.087_237, 0.023_068_5, -0.086_490_2, 0.077_459_4]);
    let linear = horner(g, &[0.782_654, 0.197_44, 0.036_060_5]);
    let square = horner(g, &[-0.136_432, -0.258_6]);
    (constant + r * (linear + r * (square + r * T::lit(0.278_708)))).min(T::ONE)
}

/// A polynomial by its coefficients, lowest first.
fn horner<T: Real>(x: T, coefficients: &[f64]) -> T {
    coefficients.iter().rev().fold(T::ZERO, |sum, &c| sum * x + T::lit(c))
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
    if !(eta > T::ZERO && eta < T::INFINITY) {
        T::ZERO
    } else if eta < T::ONE {
        horner(eta, &[0.6681, 0.7099, -1.4399]) + T::lit(0.0636) / eta
    } else {
        horner(T::ONE / eta, &[0.919317, -3.4793, 6.75335, -7.80989, 4.98554, -1.36881])
    }
}

/// The cheapest fit of [`dielectric_average`]: one quotient, or a cubic.
///
/// ```text
/// η ≥ 1:  (η − 1) / (4.08567 + 1.00071 η)
/// η < 1:  0.997118 + 0.1014 η − 0.965241 η² − 0.130607 η³
/// ```
///
/// * `eta`: as for [`dielectric_average`]; 0 outside its domain.
///
/// # Precision
/// Against the exact average, absolute, for η to 10: 0.0066 from outside (7 % of it at 1.5, 38 % towards 1);
/// 0.0027 from inside. [`dielectric_average_fit`] is closer from outside, and from inside below 1/η = 1.5.
///
/// # Source
/// C. Kulla, A. Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course.
pub fn dielectric_average_quotient_fit<T: Real>(eta: T) -> T {
    if !(eta > T::ZERO && eta < T::INFINITY) {
        T::ZERO
    } else if eta < T::ONE {
        horner(eta, &[0.997_118, 0.101_4, -0.965_241, -0.130_607])
    } else {
        (eta - T::ONE) / (T::lit(4.08567) + T::lit(1.00071) * eta)
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{conductor_from_artistic, schlick};

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
            // The closed form loses 4/(η − 1)² of its digits.
            assert!((got - want).abs() < 1e-10, "{eta} {got} {want}");
            let inside = dielectric_average(1.0 / eta);
            let want = 1.0 - (1.0 - want) / (eta * eta);
            assert!((inside - want).abs() < 1e-10, "{eta} {inside} {want}");
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
    fn the_quotient_fit_is_within_its_published_error() {
        for eta in [1.001, 1.1, 1.33, 1.5, 1.9, 3.0, 5.0, 10.0] {
            let error = (dielectric_average_quotient_fit(eta) - dielectric_average(eta)).abs();
            assert!(error < 6.6e-3, "{eta} {error}");
            let eta = 1.0 / eta;
            let error = (dielectric_average_quotient_fit(eta) - dielectric_average(eta)).abs();
            assert!(error < 2.7e-3, "{eta} {error}");
        }
    }

    #[test]
    fn little_is_transmitted_into_extreme_indices_and_keeps_its_digits() {
        for eta in [1e2_f32, 1e4, 1e-2, 1e-4] {
            let narrow = f64::from(dielectric_average_transmittance(eta));
            let wide = dielectric_average_transmittance(f64::from(eta));
            // One rounding.
            assert!((narrow / wide - 1.0).abs() < f64::from(f32::EPSILON), "{eta} {narrow} {wide}");
        }
        // 48 weights that sum to 1 within a few ε each.
        assert!((dielectric_average_transmittance(1.0_f64) - 1.0).abs() < 1e-14);
        assert_eq!(dielectric_average(f32::NAN), 0.0);
    }

    #[test]
    fn a_conductor_without_extinction_averages_as_a_dielectric() {
        for eta in [0.3, 0.5, 0.9, 1.1, 1.5, 4.0] {
            let (metal, glass) = (conductor_average(eta, 0.0), dielectric_average(eta));
            // Below 1 the root at the critical angle is met by both sides' nodes, not exactly.
            assert!((metal - glass).abs() < 1e-8, "{eta} {metal} {glass}");
        }
        assert!((conductor_average(0.0, 1.0) - 1.0).abs() < 1e-12);
        assert_eq!(conductor_average(f32::NAN, 1.0), 0.0);
    }

    #[test]
    fn the_fit_of_metals_is_within_its_stated_error() {
        let mut worst = [0.0_f64; 2];
        for i in 0..16 {
            for j in 0..=16 {
                let (r, g) = (0.2 + 0.05 * f64::from(i), f64::from(j) / 16.0);
                let [eta, k] = conductor_from_artistic(r, g);
                let error = (conductor_average_fit(r, g) - conductor_average(eta, k)).abs();
                let class = usize::from(g > 0.75);
                worst[class] = worst[class].max(error);
            }
        }
        assert!(worst[0] < 0.012 && worst[1] > 0.03 && worst[1] < 0.05, "{worst:?}");
    }

    #[test]
    fn schlicks_average_is_its_integral() {
        let sum: f64 =
            gauss_legendre::<f64, 8>().iter().map(|&(c, w)| w * 2.0 * c * schlick(0.3, c)).sum();
        // The integrand is a polynomial of degree 6: exact but for rounding.
        assert!((sum - schlick_average(0.3)).abs() < 1e-15);
    }
}
