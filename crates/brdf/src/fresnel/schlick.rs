//! Schlick's approximation and normal reflectances.

use etendue_math::{Real, Spectrum};

use super::checked_cosine;

/// Schlick's approximation of the Fresnel reflectance.
///
/// ```text
/// F = F0 + (1 − F0)(1 − c)⁵
/// ```
///
/// * `f0`: reflectance at normal incidence, per channel in `[0, 1]`; a channel outside gives 0.
/// * `cos_i`: cosine c of the angle of incidence; see the [module](crate::fresnel).
///
/// # Precision
/// Within 4 ulp of the formula: the fifth power is three products.
///
/// # Source
/// C. Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", Eurographics 1994, eq. 15.
#[inline]
pub fn schlick<C: Spectrum>(f0: C, cos_i: C::Real) -> C {
    let one = <C::Real as Real>::ONE;
    let Some(c) = checked_cosine(cos_i) else { return C::black() };
    schlick_of_versine(f0, one - c)
}

/// [`schlick`] of `m = 1 − c` in `[0, 1]`, for who knows m to more digits than `1 − c` leaves.
#[inline(always)]
pub(crate) fn schlick_of_versine<C: Spectrum>(f0: C, m: C::Real) -> C {
    let one = <C::Real as Real>::ONE;
    let m5 = fifth_power(m);
    f0.map(|f| if f >= C::Real::ZERO && f <= one { f + (one - f) * m5 } else { C::Real::ZERO })
}

/// `1 − F` of Schlick's approximation, without the cancellation towards grazing incidence.
///
/// ```text
/// 1 − F = (1 − F0)(1 − m⁵) = (1 − F0) c (1 + m + m² + m³ + m⁴),  m = 1 − c
/// ```
///
/// Arguments as for [`schlick`]; a channel outside gives 0.
///
/// # Precision
/// Within 6 ulp, relative to the small number itself.
#[inline]
pub fn schlick_transmittance<C: Spectrum>(f0: C, cos_i: C::Real) -> C {
    let one = <C::Real as Real>::ONE;
    let Some(c) = checked_cosine(cos_i) else { return C::black() };
    let m = one - c;
    let q = c * ((one + m) * (one + m * m) + (m * m) * (m * m));
    f0.map(|f| if f >= C::Real::ZERO && f <= one { (one - f) * q } else { C::Real::ZERO })
}

/// `m⁵` by three products.
#[inline(always)]
pub(super) fn fifth_power<T: Real>(m: T) -> T {
    (m * m) * (m * m) * m
}

/// Reflectance at normal incidence of an interface with relative index η.
///
/// ```text
/// F0 = ((η − 1) / (η + 1))²
/// ```
///
/// η positive and finite; 0 is returned outside.
///
/// # Precision
/// Within 3 ulp times the condition of η − 1.
#[inline]
pub fn f0_from_ior<T: Real>(eta: T) -> T {
    if eta > T::ZERO && eta < T::INFINITY {
        ((eta - T::ONE) / (eta + T::ONE)).sqr()
    } else {
        T::ZERO
    }
}

/// The relative index η ≥ 1 whose normal reflectance is `f0`: the inverse of [`f0_from_ior`].
///
/// ```text
/// η = (1 + √F0) / (1 − √F0) = (1 + √F0)² / (1 − F0)
/// ```
///
/// `f0` in `[0, 1)`; `None` outside. The same reflectance has the interface seen from the other side, `1/η`.
///
/// # Precision
/// 4 ulp; `1 − √F0` would cancel for F0 → 1.
#[inline]
pub fn ior_from_f0<T: Real>(f0: T) -> Option<T> {
    (f0 >= T::ZERO && f0 < T::ONE).then(|| (T::ONE + f0.sqrt()).sqr() / (T::ONE - f0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_are_f0_and_one() {
        assert_eq!(schlick(0.04_f32, 1.0), 0.04);
        assert_eq!(schlick(0.25_f64, 0.0), 1.0);
    }

    #[test]
    fn ior_and_f0_are_inverses() {
        for eta in [1.0_f64, 1.33, 1.5, 2.4, 10.0] {
            let back = ior_from_f0(f0_from_ior(eta)).unwrap();
            // F0 → 1 for large η amplifies the rounding of F0 by η.
            assert!((back - eta).abs() < 1e-15 * eta * (1.0 + eta), "{eta} {back}");
        }
        for bad in [1.0_f32, -0.1, f32::NAN, f32::INFINITY] {
            assert_eq!(ior_from_f0(bad), None);
        }
    }

    #[test]
    fn the_transmittance_is_the_complement_to_its_own_last_digits() {
        for c in [1.0_f32, 0.7, 0.1, 1e-3, 1e-7, 0.0] {
            let m5 = fifth_power(1.0 - f64::from(c));
            // In f64 the difference keeps nine digits of the smallest.
            let want = 0.96 * (1.0 - m5);
            let error = (f64::from(schlick_transmittance(0.04_f32, c)) - want).abs();
            assert!(error <= 6.0 * f64::from(f32::EPSILON) * want, "{c} {error}");
        }
        assert_eq!(schlick_transmittance(f64::NAN, 0.5), 0.0);
    }
}
