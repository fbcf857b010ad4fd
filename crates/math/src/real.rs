//! The sealed trait over `f32` and `f64`.

use core::fmt::{Debug, Display};
use core::iter::Sum;
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

use crate::vector::Vector3;
use crate::{backend, eighth_turn};

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// A real number: `f32` or `f64`.
///
/// Float functions have the names they have in `std`; where they come from is a matter of the
/// crate's features (see the crate page). `min` and `max` return the other operand when one is NaN.
///
/// # Examples
/// ```
/// use etendue_math::Real;
/// fn half_angle_cosine<T: Real>(cos: T) -> T {
///     ((T::ONE + cos) * T::lit(0.5)).max(T::ZERO).sqrt()
/// }
/// assert_eq!(half_angle_cosine(1.0_f32), 1.0);
/// assert_eq!(half_angle_cosine(-1.0_f64), 0.0);
/// ```
pub trait Real:
    sealed::Sealed
    + Copy
    + Debug
    + Display
    + Default
    + PartialEq
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
    + Sum
    + Send
    + Sync
    + 'static
{
    /// glam's three-component vector of this precision.
    type Vec3: Vector3<Scalar = Self>;

    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// 1/2.
    const HALF: Self;
    /// 2.
    const TWO: Self;
    /// π.
    const PI: Self;
    /// 1/π.
    const FRAC_1_PI: Self;
    /// Distance from 1 to the next larger number, 2⁻²³ or 2⁻⁵².
    const EPSILON: Self;
    /// The smallest positive normal number.
    const MIN_POSITIVE: Self;
    /// The largest finite number.
    const MAX: Self;
    /// Positive infinity.
    const INFINITY: Self;
    /// Not a number.
    const NAN: Self;
    /// The largest number below 1: uniforms lie in `[0, ONE_MINUS_EPSILON]`.
    const ONE_MINUS_EPSILON: Self;
    /// Bits of the significand, the hidden one included: 24 or 53.
    const SIGNIFICAND_BITS: u32;

    /// The number nearest to `x`; how constants are written in generic code.
    fn lit(x: f64) -> Self;
    /// The same value as `f64`, exact.
    fn to_f64(self) -> f64;
    /// A uniform number in `[0, 1)` from 64 random bits: the top 24 or 53 of them times 2⁻²⁴ or 2⁻⁵³.
    ///
    /// Never rounds up to 1, as `bits · 2⁻³²` in `f32` does for the last 128 values.
    fn from_random_bits(bits: u64) -> Self;

    /// Absolute value.
    fn abs(self) -> Self;
    /// Square root, correctly rounded; NaN below 0.
    fn sqrt(self) -> Self;
    /// Square root of `max(x, 0)`: for values that are non-negative but for rounding.
    fn safe_sqrt(self) -> Self {
        self.max(Self::ZERO).sqrt()
    }
    /// The smaller of the two; the other one if one is NaN; `other` if they are equal.
    ///
    /// Of two zeros of different sign `core`'s minimum may be either, and differs between processors.
    fn min(self, other: Self) -> Self;
    /// The larger of the two; the other one if one is NaN; `other` if they are equal (see [`min`](Self::min)).
    fn max(self, other: Self) -> Self;
    /// `x` limited to `[low, high]`; `low` for NaN, so that nothing invalid passes.
    fn clamp_to(self, low: Self, high: Self) -> Self {
        if self > low { self.min(high) } else { low }
    }
    /// The magnitude of `self` with the sign of `sign`.
    fn copysign(self, sign: Self) -> Self;
    /// The largest integer not above.
    fn floor(self) -> Self;
    /// `self · a + b` with one rounding. Slow without hardware support: not for hot paths.
    fn mul_add(self, a: Self, b: Self) -> Self;
    /// Sine of an angle in radians.
    fn sin(self) -> Self;
    /// Cosine of an angle in radians.
    fn cos(self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }
    /// Sine and cosine of `self` eighths of a turn, `π/4 · x`, for `|x| ≤ 1`; some finite numbers
    /// for other finite `x`.
    ///
    /// Within 0.54 ulp for `f32`, 2 ulp for `f64`.
    fn sin_cos_eighth_turn(self) -> (Self, Self);
    /// Tangent of an angle in radians.
    fn tan(self) -> Self;
    /// Arc sine in radians; NaN outside `[−1, 1]`.
    fn asin(self) -> Self;
    /// Arc cosine in radians; NaN outside `[−1, 1]`.
    fn acos(self) -> Self;
    /// Arc tangent in radians.
    fn atan(self) -> Self;
    /// Angle of the point `(x, self)` in radians, in `[−π, π]`.
    fn atan2(self, x: Self) -> Self;
    /// eˣ.
    fn exp(self) -> Self;
    /// eˣ − 1 without cancellation near 0.
    fn exp_m1(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// `ln(1 + x)` without cancellation near 0.
    fn ln_1p(self) -> Self;
    /// `self` to the power `p`.
    fn powf(self, p: Self) -> Self;
    /// `self` to the integer power `n` by repeated squaring (not the platform's `powi`).
    fn powi(self, n: u32) -> Self {
        let (mut result, mut base, mut n) = (Self::ONE, self, n);
        while n > 0 {
            if n & 1 == 1 {
                result *= base;
            }
            base *= base;
            n >>= 1;
        }
        result
    }
    /// Square.
    fn sqr(self) -> Self {
        self * self
    }
    /// Error function, see [`crate::special::erf`].
    fn erf(self) -> Self;
    /// Complementary error function `1 − erf(x)` without cancellation for large `x`.
    fn erfc(self) -> Self;
    /// `a·b − c·d` without catastrophic cancellation: correct to 1.5 ulp where the products do not
    /// over- or underflow (Jeannerod et al. 2013 for `f64`; through `f64` for `f32`).
    fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self;
    /// `x² + y² + z² − 1`, how far a vector that is nearly of unit length is from it: absolute error of
    /// ε² instead of the ε that the squares are rounded by.
    fn excess_of_squares(x: Self, y: Self, z: Self) -> Self;
    /// Neither NaN nor infinite.
    fn is_finite(self) -> bool;
    /// Not a number.
    fn is_nan(self) -> bool;
    /// The next number towards +∞; NaN and +∞ stay as they are.
    fn next_up(self) -> Self;
    /// The next number towards −∞; NaN and −∞ stay as they are.
    fn next_down(self) -> Self;
}

macro_rules! real {
    ($float:ident, $vec3:ty, $sin_cos_eighth_turn:path, $erf:path, $erfc:path) => {
        impl Real for $float {
            type Vec3 = $vec3;

            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;
            const HALF: Self = 0.5;
            const TWO: Self = 2.0;
            const PI: Self = core::$float::consts::PI;
            const FRAC_1_PI: Self = core::$float::consts::FRAC_1_PI;
            const EPSILON: Self = $float::EPSILON;
            const MIN_POSITIVE: Self = $float::MIN_POSITIVE;
            const MAX: Self = $float::MAX;
            const INFINITY: Self = $float::INFINITY;
            const NAN: Self = $float::NAN;
            const ONE_MINUS_EPSILON: Self = 1.0 - $float::EPSILON / 2.0;
            const SIGNIFICAND_BITS: u32 = $float::MANTISSA_DIGITS;

            #[inline(always)]
            fn lit(x: f64) -> Self {
                x as $float
            }
            #[inline(always)]
            fn to_f64(self) -> f64 {
                self as f64
            }
            #[inline(always)]
            fn from_random_bits(bits: u64) -> Self {
                const SCALE: $float = $float::EPSILON / 2.0;
                (bits >> (64 - $float::MANTISSA_DIGITS)) as $float * SCALE
            }
            #[inline(always)]
            fn abs(self) -> Self {
                $float::abs(self)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                backend::exact::$float::sqrt(self)
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other || other.is_nan() { self } else { other }
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self > other || other.is_nan() { self } else { other }
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                $float::copysign(self, sign)
            }
            #[inline(always)]
            fn floor(self) -> Self {
                backend::exact::$float::floor(self)
            }
            #[inline(always)]
            fn mul_add(self, a: Self, b: Self) -> Self {
                backend::exact::$float::mul_add(self, a, b)
            }
            #[inline(always)]
            fn sin(self) -> Self {
                backend::$float::sin(self)
            }
            #[inline(always)]
            fn cos(self) -> Self {
                backend::$float::cos(self)
            }
            #[inline(always)]
            fn sin_cos_eighth_turn(self) -> (Self, Self) {
                $sin_cos_eighth_turn(self)
            }
            #[inline(always)]
            fn tan(self) -> Self {
                backend::$float::tan(self)
            }
            #[inline(always)]
            fn asin(self) -> Self {
                backend::$float::asin(self)
            }
            #[inline(always)]
            fn acos(self) -> Self {
                backend::$float::acos(self)
            }
            #[inline(always)]
            fn atan(self) -> Self {
                backend::$float::atan(self)
            }
            #[inline(always)]
            fn atan2(self, x: Self) -> Self {
                backend::$float::atan2(self, x)
            }
            #[inline(always)]
            fn exp(self) -> Self {
                backend::$float::exp(self)
            }
            #[inline(always)]
            fn exp_m1(self) -> Self {
                backend::$float::exp_m1(self)
            }
            #[inline(always)]
            fn ln(self) -> Self {
                backend::$float::ln(self)
            }
            #[inline(always)]
            fn ln_1p(self) -> Self {
                backend::$float::ln_1p(self)
            }
            #[inline(always)]
            fn powf(self, p: Self) -> Self {
                backend::$float::powf(self, p)
            }
            #[inline(always)]
            fn erf(self) -> Self {
                $erf(self)
            }
            #[inline(always)]
            fn erfc(self) -> Self {
                $erfc(self)
            }
            #[inline(always)]
            fn difference_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
                difference_of_products::$float(a, b, c, d)
            }
            #[inline(always)]
            fn excess_of_squares(x: Self, y: Self, z: Self) -> Self {
                excess_of_squares::$float(x, y, z)
            }
            #[inline(always)]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }
            #[inline(always)]
            fn is_nan(self) -> bool {
                $float::is_nan(self)
            }
            #[inline(always)]
            fn next_up(self) -> Self {
                $float::next_up(self)
            }
            #[inline(always)]
            fn next_down(self) -> Self {
                $float::next_down(self)
            }
        }
    };
}

real!(f32, glam::Vec3, eighth_turn::sin_cos_f32, libm_crate::erff, libm_crate::erfcf);
real!(f64, glam::DVec3, eighth_turn::sin_cos_f64, libm_crate::erf, libm_crate::erfc);

mod difference_of_products {
    use super::backend;

    /// Products of two `f32` are exact in `f64`; one rounding there, one on the way back.
    #[inline(always)]
    pub(super) fn f32(a: f32, b: f32, c: f32, d: f32) -> f32 {
        (a as f64 * b as f64 - c as f64 * d as f64) as f32
    }

    /// Kahan's algorithm: the error of the second product, found by fma, is put back.
    #[inline(always)]
    pub(super) fn f64(a: f64, b: f64, c: f64, d: f64) -> f64 {
        let cd = c * d;
        let error = backend::exact::f64::mul_add(-c, d, cd);
        backend::exact::f64::mul_add(a, b, -cd) + error
    }
}

mod excess_of_squares {
    use super::backend;

    /// Squares of `f32` are exact in `f64`.
    #[inline(always)]
    pub(super) fn f32(x: f32, y: f32, z: f32) -> f32 {
        let square = |a: f32| f64::from(a) * f64::from(a);
        (square(x) + square(y) + square(z) - 1.0) as f32
    }

    /// The squares and what their rounding has lost, found by fma; the same for their sums (Knuth's
    /// two-sum).
    #[inline(always)]
    pub(super) fn f64(x: f64, y: f64, z: f64) -> f64 {
        let (mut sum, mut lost) = (-1.0, 0.0);
        for a in [x, y, z] {
            let square = a * a;
            lost += backend::exact::f64::mul_add(a, a, -square);
            let total = sum + square;
            let part = total - sum;
            lost += (sum - (total - part)) + (square - part);
            sum = total;
        }
        sum + lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn random_bits_never_reach_one() {
        assert_eq!(f32::from_random_bits(u64::MAX), f32::ONE_MINUS_EPSILON);
        assert_eq!(f64::from_random_bits(u64::MAX), f64::ONE_MINUS_EPSILON);
        assert_eq!(f32::ONE_MINUS_EPSILON.next_up(), 1.0);
        assert_eq!(f32::from_random_bits(0), 0.0);
    }

    #[test]
    fn clamping_replaces_nan_by_the_lower_bound() {
        assert_eq!(Real::clamp_to(f32::NAN, 0.0, 1.0), 0.0);
        assert_eq!(Real::clamp_to(2.0_f64, 0.0, 1.0), 1.0);
    }

    #[test]
    fn extremes_skip_nan_and_of_two_zeros_take_the_argument() {
        for (nan, x) in [(f32::NAN, 1.0), (1.0, f32::NAN)] {
            assert_eq!((Real::min(nan, x), Real::max(nan, x)), (1.0, 1.0));
        }
        for (a, b) in [(0.0_f64, -0.0), (-0.0, 0.0)] {
            assert_eq!(Real::min(a, b).to_bits(), b.to_bits());
            assert_eq!(Real::max(a, b).to_bits(), b.to_bits());
        }
    }

    #[test]
    fn the_excess_of_a_nearly_unit_vector_keeps_its_digits() {
        // (1 + ε)² + ε² − 1 = 2ε + 2ε²; plain squares lose the ε² and half an ε.
        let e = f64::EPSILON;
        assert_eq!(f64::excess_of_squares(1.0 + e, e, 0.0), 2.0 * e + 2.0 * e * e);
        let e = f32::EPSILON;
        assert_eq!(f32::excess_of_squares(1.0 + e, e, 0.0), 2.0 * e + 2.0 * e * e);
        // 0.6² + 0.8² of the nearest numbers, from their exact decimal expansions.
        assert!((f64::excess_of_squares(0.6, 0.8, 0.0) - 4.440892098500626e-17).abs() < 1e-24);
    }

    #[test]
    fn difference_of_products_survives_cancellation() {
        // 33962.035·−30438.8 − 41563.4·−24871.969 (pbrt-v4's example): plain f32 gives 0 or ±128.
        let [a, b, c, d] = [33962.035_f32, -30438.8, 41563.4, -24871.969];
        let exact = f64::from(a) * f64::from(b) - f64::from(c) * f64::from(d);
        assert_eq!(f32::difference_of_products(a, b, c, d), exact as f32);
        // (1+ε)(1−ε) − 1·1 = −ε² exactly in f64.
        let e = f64::EPSILON;
        assert_eq!(f64::difference_of_products(1.0 + e, 1.0 - e, 1.0, 1.0), -e * e);
    }

    #[test]
    fn integer_powers_agree_with_products() {
        assert_eq!(3.0_f64.sqr(), 9.0);
        assert_eq!(Real::powi(2.0_f32, 10), 1024.0);
        assert_eq!(Real::powi(5.0_f32, 0), 1.0);
    }
}
