//! The forms of textbooks and shaders, for comparison only.

use etendue_math::{Real, Spectrum};

/// Dielectric reflectance as textbooks print it. **For comparison only**: use [`dielectric`](super::dielectric).
///
/// ```text
/// t = √(max(0, 1 − (1 − c²)/η²))
/// F = ½ (((c − η t)/(c + η t))² + ((η c − t)/(η c + t))²)
/// ```
///
/// Where it breaks: for η → 1 both numerators subtract numbers that agree to `η − 1`, and what is left
/// is rounding. In `f32` it is wrong by 1.7e-4 at η = 1.001, by 27 % at 1 + 5e-7, and 0/0 at η = 1,
/// c = 0. Near the critical angle its test of total reflection disagrees with that of a refraction
/// that tests another expression.
///
/// Arguments are not checked: outside the domain of [`dielectric`](super::dielectric) it returns NaN.
#[inline]
pub fn dielectric_textbook<T: Real>(cos_i: T, eta: T) -> T {
    let c = cos_i;
    let t = (T::ONE - (T::ONE - c * c) / (eta * eta)).max(T::ZERO).sqrt();
    let rs = (c - eta * t) / (c + eta * t);
    let rp = (eta * c - t) / (eta * c + t);
    T::HALF * (rs * rs + rp * rp)
}

/// Conductor reflectance in the common form of renderers. **For comparison only**: use
/// [`conductor`](super::conductor).
///
/// ```text
/// t₀ = η² − k² − s²,  r = √(t₀² + 4 η² k²),  a = √(½ (r + t₀))
/// Rs = (r + c² − 2 a c)/(r + c² + 2 a c),  Rp = Rs (c² r + s⁴ − 2 a c s²)/(c² r + s⁴ + 2 a c s²)
/// ```
///
/// Where it breaks: `r + t₀` cancels for `t₀ < 0`, so that a is 0 or the root of a negative number, and
/// `r + c² − 2 a c` is a difference of equals for η → 1, k → 0. In `f32` it is off by more than its value there.
///
/// Arguments are not checked.
#[inline]
pub fn conductor_textbook<T: Real>(cos_i: T, eta: T, k: T) -> T {
    let (c, c2) = (cos_i, cos_i * cos_i);
    let s2 = T::ONE - c2;
    let t0 = eta * eta - k * k - s2;
    let sum = (t0 * t0 + T::lit(4.0) * eta * eta * k * k).sqrt();
    let t1 = sum + c2;
    let a = (T::HALF * (sum + t0)).sqrt();
    let t2 = T::TWO * a * c;
    let rs = (t1 - t2) / (t1 + t2);
    let (t3, t4) = (c2 * sum + s2 * s2, t2 * s2);
    T::HALF * (rs + rs * (t3 - t4) / (t3 + t4))
}

/// Schlick's approximation by the power function. **For comparison only**: use [`schlick`](super::schlick).
///
/// ```text
/// F = F0 + (1 − F0) pow(1 − c, 5)
/// ```
///
/// The same number to a few ulp, at the price of a general power function. Shading languages leave the
/// power of a negative base undefined, which is what `1 − c` is when rounding makes c larger than 1.
///
/// Arguments are not checked.
#[inline]
pub fn schlick_powf<C: Spectrum>(f0: C, cos_i: C::Real) -> C {
    let one = <C::Real as Real>::ONE;
    let m5 = (one - cos_i).powf(C::Real::lit(5.0));
    f0.map(|f| f + (one - f) * m5)
}

/// Schlick's approximation with its power replaced by a Gaussian. **For comparison only**: use
/// [`schlick`](super::schlick).
///
/// ```text
/// F = F0 + (1 − F0) 2^((−5.55473 c − 6.98316) c)
/// ```
///
/// An approximation of an approximation: up to 0.0038 away from `(1 − c)⁵`, and 1.7e-4 instead of 0 at
/// normal incidence. It paid on hardware on which an exponential costs less than three products.
///
/// Arguments are not checked.
///
/// # Source
/// S. Lagarde, "Spherical Gaussian approximation for Blinn–Phong, Phong and Fresnel", 2012; B. Karis,
/// "Real Shading in Unreal Engine 4", SIGGRAPH 2013 course.
#[inline]
pub fn schlick_gaussian<C: Spectrum>(f0: C, cos_i: C::Real) -> C {
    let lit = C::Real::lit;
    let exponent = (lit(-5.554_73) * cos_i - lit(6.983_16)) * cos_i;
    let m5 = (exponent * lit(core::f64::consts::LN_2)).exp();
    f0.map(|f| f + (C::Real::ONE - f) * m5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fresnel::{conductor, dielectric, schlick};

    #[test]
    fn they_agree_with_the_forms_in_use_where_nothing_cancels() {
        for i in 1..=100 {
            let c = f64::from(i) / 100.0;
            assert!((dielectric_textbook(c, 1.5) - dielectric(c, 1.5)).abs() < 1e-14);
            assert!((conductor_textbook(c, 1.4, 1.6) - conductor(c, 1.4, 1.6)).abs() < 1e-14);
            assert!((schlick_powf(0.04, c) - schlick(0.04, c)).abs() < 1e-15);
        }
    }

    #[test]
    fn they_break_as_documented() {
        let eta = 1.0 + 5e-7_f32;
        let exact = |c: f32| dielectric(f64::from(c), f64::from(eta));
        let error = |c: f32| f64::from(dielectric_textbook(c, eta)) / exact(c) - 1.0;
        let worst = (1..=1000).map(|i| error(0.001 * i as f32).abs()).fold(0.0, f64::max);
        assert!(worst > 0.2, "{worst}");
        assert!(dielectric_textbook(0.0_f32, 1.0).is_nan());
    }

    #[test]
    fn the_gaussian_is_within_its_stated_error() {
        let error = (0..=1000)
            .map(|i| f64::from(i) / 1000.0)
            .map(|c| (schlick_gaussian(0.0, c) - schlick(0.0, c)).abs())
            .fold(0.0, f64::max);
        assert!(error > 0.003 && error < 0.0038, "{error}");
    }
}
