//! Numbers of twice the precision of `f64`.

use core::ops::{Add, Div, Mul, Neg, Sub};

use etendue_math::Real;

/// An unevaluated sum of two `f64`, of which the second is less than half an ulp of the first: 106 bits.
///
/// Textbook formulas evaluated in it lose what cancels and still have more digits than `f64`: the reference for variants in
/// `f64` that shares no formula with them.
///
/// # Precision
/// Sums, products, quotients and roots to some 4·10⁻³², exponentials to 10⁻²⁹, relative, logarithms and sines
/// likewise, but absolute where they are below 1. Numbers near the ends of the range of `f64` are outside the domain.
///
/// # Source
/// T. Dekker, "A Floating-Point Technique for Extending the Available Precision", Numer. Math. 18, 1971; Y. Hida, X. Li,
/// D. Bailey, "Algorithms for Quad-Double Precision Floating Point Arithmetic", ARITH 2001.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleDouble {
    high: f64,
    low: f64,
}

const LN_2: DoubleDouble =
    DoubleDouble { high: core::f64::consts::LN_2, low: 2.319_046_813_846_299_6e-17 };
const FRAC_PI_2: DoubleDouble =
    DoubleDouble { high: core::f64::consts::FRAC_PI_2, low: 6.123_233_995_736_766e-17 };

/// `a + b` where |a| ≥ |b|.
fn renormalised(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble { high, low: b - (high - a) }
}

impl DoubleDouble {
    /// π.
    pub const PI: Self = Self { high: core::f64::consts::PI, low: 2.0 * 6.123_233_995_736_766e-17 };

    /// The nearest `f64`.
    pub fn to_f64(self) -> f64 {
        self.high
    }

    /// Square root; 0 for what is not positive.
    pub fn sqrt(self) -> Self {
        if !(self.high > 0.0) {
            return 0.0.into();
        }
        let root = Self::from(self.high.sqrt());
        // One step of Newton's method doubles the digits.
        root + (self - root * root) / (root * 2.0.into())
    }

    /// The larger of the two.
    pub fn max(self, other: Self) -> Self {
        if self.high > other.high || (self.high == other.high && self.low > other.low) {
            self
        } else {
            other
        }
    }

    /// `x²`
    pub fn sqr(self) -> Self {
        self * self
    }

    /// A whole power.
    pub fn powi(self, n: u32) -> Self {
        (0..n).fold(1.0.into(), |power, _| power * self)
    }

    /// eˣ, for |x| below 700.
    pub fn exp(self) -> Self {
        let k = (self.high / LN_2.high).round();
        // |r| ≤ ln 2 / 512 after division by 256, undone by squaring eight times.
        let r = (self - LN_2 * k.into()) * (1.0 / 256.0).into();
        let mut sum = (1..=10)
            .rev()
            .fold(Self::from(1.0), |sum, n| Self::from(1.0) + r * sum / f64::from(n).into());
        for _ in 0..8 {
            sum = sum * sum;
        }
        let power = f64::from_bits(((1023 + k as i64) as u64) << 52);
        Self { high: sum.high * power, low: sum.low * power }
    }

    /// Natural logarithm of a positive number.
    pub fn ln(self) -> Self {
        let y = Self::from(Real::ln(self.high));
        // One step of Newton's method on eʸ = x.
        y + self * (-y).exp() - 1.0.into()
    }

    /// `xʸ` of a positive number.
    pub fn powf(self, y: Self) -> Self {
        (self.ln() * y).exp()
    }

    /// Sine of an angle in radians, |x| up to some hundred.
    pub fn sin(self) -> Self {
        let k = (self.high / FRAC_PI_2.high).round();
        let r = self - FRAC_PI_2 * k.into();
        let r2 = r * r;
        // sin r = r (1 − r²/(2·3) (1 − r²/(4·5) …)), cos r likewise from r²/(1·2); |r| ≤ π/4.
        let series = |first: u32| {
            (0..14).rev().fold(Self::from(1.0), |sum, n| {
                let m = f64::from(first + 2 * n);
                Self::from(1.0) - r2 * sum / (m * (m + 1.0)).into()
            })
        };
        match (k as i64).rem_euclid(4) {
            0 => r * series(2),
            1 => series(1),
            2 => -(r * series(2)),
            _ => -series(1),
        }
    }
}

impl From<f64> for DoubleDouble {
    fn from(x: f64) -> Self {
        Self { high: x, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let two_sum = |a: f64, b: f64| {
            let sum = a + b;
            let part = sum - a;
            (sum, (a - (sum - part)) + (b - part))
        };
        let (high, error) = two_sum(self.high, other.high);
        let (low, low_error) = two_sum(self.low, other.low);
        let first = renormalised(high, error + low);
        renormalised(first.high, first.low + low_error)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        Self { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let high = self.high * other.high;
        let error = self.high.mul_add(other.high, -high);
        renormalised(high, error + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first.into();
        let second = rest.high / other.high;
        let rest = rest - other * second.into();
        renormalised(first, second) + (rest.high / other.high).into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative difference, from the low parts as well.
    fn error(got: DoubleDouble, want: DoubleDouble) -> f64 {
        ((got - want) / want).to_f64().abs()
    }

    #[test]
    fn arithmetic_has_thirty_digits() {
        let third = DoubleDouble::from(1.0) / 3.0.into();
        assert!(error(third * 3.0.into(), 1.0.into()) < 1e-31);
        let root = DoubleDouble::from(2.0).sqrt();
        assert!(error(root * root, 2.0.into()) < 1e-31);
        // 1e-20 would vanish beside 1 in f64.
        let tiny = (DoubleDouble::from(1.0) + 1e-20.into()) - 1.0.into();
        assert!(error(tiny, 1e-20.into()) < 1e-11);
    }

    #[test]
    fn functions_meet_their_identities() {
        for x in [-30.0, -1.0, 1e-3, 0.7, 5.0, 80.0] {
            let x = DoubleDouble::from(x);
            assert!(error(x.exp() * (-x).exp(), 1.0.into()) < 1e-28);
            // A logarithm near 0 has the absolute error of one near 1.
            assert!((x.exp().ln() - x).to_f64().abs() < 1e-29 * x.to_f64().abs().max(1.0));
            // sin 3x = 3 sin x − 4 sin³ x
            let s = x.sin();
            let triple = s * 3.0.into() - s.powi(3) * 4.0.into();
            assert!((triple - (x * 3.0.into()).sin()).to_f64().abs() < 1e-28);
        }
        assert!(error((DoubleDouble::PI * 0.5.into()).sin(), 1.0.into()) < 1e-30);
        assert!(error(DoubleDouble::from(3.0).powf(4.0.into()), 81.0.into()) < 1e-28);
    }

    #[test]
    fn the_high_part_is_the_function_of_f64() {
        for x in [0.1, 0.9, 2.5, 40.0_f64] {
            let got = [
                DoubleDouble::from(x).exp(),
                DoubleDouble::from(x).ln(),
                DoubleDouble::from(x).sin(),
            ];
            let want = [Real::exp(x), Real::ln(x), Real::sin(x)];
            for (got, want) in got.into_iter().zip(want) {
                // One ulp of the platform's function.
                assert!((got.to_f64() / want - 1.0).abs() < 3e-16, "{x} {got:?} {want}");
            }
        }
    }
}
