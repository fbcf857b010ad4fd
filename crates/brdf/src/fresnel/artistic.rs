//! Metals by the colours an artist sees: reflectivity and edge tint.

use etendue_math::Real;

/// Complex index `[η, k]` of the metal with normal reflectance `r` and edge tint `g`.
///
/// ```text
/// s = √r,  1 − s = (1 − r)/(1 + s)
/// A = 2 s (1 + s) / ((1 − s)(1 + r)),   B = 2 s (1 − s) / ((1 + s)(1 + r))
/// η  = (1 − r)/(1 + r) + (1 − g) A
/// k² = g A (B + (1 − g) A)
/// ```
///
/// * `r`: reflectance at normal incidence, in `[0, 1]`.
/// * `g`: edge tint in `[0, 1]`: 1 is the smallest η with this reflectance in the parametrisation,
///   0 the index of a dielectric, k = 0.
///
/// `[0, 1]`, the perfect mirror, for r = 1: the limit of every g, all of which reflect everything.
/// `[1, 0]`, no interface at all, for arguments outside.
///
/// # Precision
/// A few ulp. The published `k² = (r (η + 1)² − (η − 1)²)/(1 − r)` is the same number, but its
/// difference cancels for g → 0 and r → 1, where its root is NaN when rounding makes it negative.
///
/// # Source
/// O. Gulbrandsen, "Artist Friendly Metallic Fresnel", JCGT 3(4), 2014, eqs. 5 to 8, with
/// `k² = (η_max − η)(η − 1/η_max)` and both differences written out.
///
/// # Examples
/// ```
/// use etendue_brdf::fresnel::{conductor, conductor_from_artistic};
/// let [eta, k] = conductor_from_artistic(0.9_f64, 0.7);
/// assert!((conductor(1.0, eta, k) - 0.9).abs() < 1e-14);
/// ```
#[inline]
pub fn conductor_from_artistic<T: Real>(r: T, g: T) -> [T; 2] {
    let unit = |x: T| x >= T::ZERO && x <= T::ONE;
    if !(unit(r) && unit(g)) {
        return [T::ONE, T::ZERO];
    }
    if r == T::ONE {
        return [T::ZERO, T::ONE];
    }
    let [low, wide, narrow] = extent(r, T::ONE - r);
    let above = (T::ONE - g) * wide;
    [low + above, (g * wide).sqrt() * (narrow + above).sqrt()]
}

/// Reflectivity and edge tint `[r, g]` of a metal: the inverse of [`conductor_from_artistic`].
///
/// ```text
/// 1 − r = 4 η / ((η + 1)² + k²),   g = k² / ((η − 1/η_max) A),   η_max = (1 + √r)/(1 − √r)
/// ```
///
/// * `eta`, `k`: as for [`conductor`](super::conductor); `[0, 0]` outside.
///
/// `g` exceeds 1 for indices beyond the reach of the parametrisation, η below `(1 − r)/(1 + r)`; it is 0 for η = 1,
/// k = 0 and 1 for r = 1, where the tint has no effect.
///
/// # Precision
/// r to a few ulp times the condition of the problem; `1 − r` likewise, which the published form
/// subtracts. g as η determines it: near η = 1, k = 0 both its terms vanish.
///
/// # Source
/// Gulbrandsen 2014, eqs. 3 and 9, with `η_max − η = k²/(η − 1/η_max)`.
#[inline]
pub fn artistic_from_conductor<T: Real>(eta: T, k: T) -> [T; 2] {
    let finite = |x: T| x >= T::ZERO && x < T::INFINITY;
    if !(finite(eta) && finite(k)) {
        return [T::ZERO; 2];
    }
    // Divided by η + 1 throughout, so that nothing overflows.
    let (a, b) = ((eta - T::ONE) / (eta + T::ONE), k / (eta + T::ONE));
    let denominator = T::ONE + b * b;
    if !(denominator < T::INFINITY) {
        return [T::ONE; 2];
    }
    let r = (a * a + b * b) / denominator;
    let complement = T::lit(4.0) * (eta / (eta + T::ONE)) / ((eta + T::ONE) * denominator);
    if !(complement > T::ZERO) {
        return [r.min(T::ONE), T::ONE];
    }
    let [low, wide, narrow] = extent(r, complement);
    let above = (eta - low) + narrow;
    if !(wide > T::ZERO && above > T::ZERO) {
        return [r, T::ZERO];
    }
    [r, ((k / wide) * (k / above)).min(T::MAX)]
}

/// `(1 − r)/(1 + r)`, its distance A from the largest η with reflectance r, and B from the smallest.
#[inline(always)]
fn extent<T: Real>(r: T, complement: T) -> [T; 3] {
    let s = r.sqrt();
    let plus = T::ONE + s;
    let minus = complement / plus;
    let common = T::TWO * s / (T::ONE + r);
    [complement / (T::ONE + r), common * (plus / minus), common * (minus / plus)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{conductor, ior_from_f0};

    #[test]
    fn the_reflectance_at_normal_incidence_is_the_one_asked_for() {
        for r in [0.01, 0.04, 0.3, 0.9, 0.999, 1.0 - 1e-9] {
            for g in [0.0, 1e-6, 0.3, 0.7, 1.0] {
                let [eta, k] = conductor_from_artistic(r, g);
                // 1 − r is what is small.
                assert!(((1.0 - conductor(1.0, eta, k)) / (1.0 - r) - 1.0).abs() < 1e-6, "{r} {g}");
            }
        }
    }

    #[test]
    fn the_published_form_agrees_where_it_holds() {
        for r in [0.2_f64, 0.6, 0.95] {
            for g in [0.2, 0.5, 0.9] {
                let [eta, k] = conductor_from_artistic(r, g);
                let s = r.sqrt();
                let want = g * (1.0 - r) / (1.0 + r) + (1.0 - g) * (1.0 + s) / (1.0 - s);
                let k2 = (r * Real::sqr(want + 1.0) - Real::sqr(want - 1.0)) / (1.0 - r);
                // The published k² loses the digits of η²/(1 − r).
                assert!((eta - want).abs() < 1e-13 * want && (k * k - k2).abs() < 1e-11 * k2);
            }
        }
    }

    #[test]
    fn there_and_back() {
        for r in [1e-4, 0.04, 0.3, 0.9, 0.999] {
            for g in [1e-3, 0.3, 0.7, 1.0] {
                let [eta, k] = conductor_from_artistic(r, g);
                let [back, tint] = artistic_from_conductor(eta, k);
                // r near 0 is the square of η − 1, which keeps 1e-16 / 1e-2.
                assert!((back / r - 1.0).abs() < 1e-12, "{r} {g} {back}");
                assert!((tint / g - 1.0).abs() < 1e-11, "{r} {g} {tint}");
            }
        }
    }

    #[test]
    fn limits_are_mirrors_glass_and_nothing() {
        assert_eq!(conductor_from_artistic(1.0_f32, 0.3), [0.0, 1.0]);
        assert_eq!(conductor_from_artistic(0.0_f32, 0.3), [1.0, 0.0]);
        assert_eq!(artistic_from_conductor(1.0_f32, 0.0), [0.0, 0.0]);
        assert_eq!(artistic_from_conductor(0.0_f32, 1.0), [1.0, 1.0]);
        let [eta, k] = conductor_from_artistic(0.04_f64, 0.0);
        assert!((eta - ior_from_f0(0.04).unwrap()).abs() < 1e-14 && k == 0.0);
        for bad in [f32::NAN, -0.1, 1.1, f32::INFINITY] {
            assert_eq!(conductor_from_artistic(bad, 0.5), [1.0, 0.0]);
            assert_eq!(conductor_from_artistic(0.5, bad), [1.0, 0.0]);
        }
        for eta in [0.0_f32, 1e-30, 1.0, 1e4, 1e30, f32::MAX] {
            for k in [0.0_f32, 1e-30, 1.0, 1e30, f32::MAX] {
                let [r, g] = artistic_from_conductor(eta, k);
                assert!((0.0..=1.0).contains(&r) && g >= 0.0 && g.is_finite(), "{eta} {k} {r} {g}");
            }
        }
    }
}
