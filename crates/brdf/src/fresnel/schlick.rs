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
    let m = one - c;
    let m5 = (m * m) * (m * m) * m;
    f0.map(|f| if f >= C::Real::ZERO && f <= one { f + (one - f) * m5 } else { C::Real::ZERO })
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
/// η = (1 + √F0) / (1 − √F0)
/// ```
///
/// `f0` in `[0, 1)`; NaN is returned outside.
#[inline]
pub fn ior_from_f0<T: Real>(f0: T) -> T {
    if f0 >= T::ZERO && f0 < T::ONE {
        let r = f0.sqrt();
        (T::ONE + r) / (T::ONE - r)
    } else {
        T::NAN
    }
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
            // √F0 → 1 for large η amplifies rounding by η.
            assert!((ior_from_f0(f0_from_ior(eta)) - eta).abs() < 1e-14 * eta * eta, "{eta}");
        }
        assert!(ior_from_f0(1.0_f32).is_nan());
    }
}
