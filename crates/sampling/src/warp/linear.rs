//! Numbers whose density rises or falls evenly.

use etendue_math::Real;

use super::into_unit;

/// The density over `[0, 1)` that is linear between its values at both ends.
///
/// ```text
/// p(x) = 2 (a (1 − x) + b x) / (a + b)
/// ```
///
/// # Examples
/// ```
/// use etendue_sampling::warp::linear::Linear;
/// let rising = Linear::new(0.0_f64, 3.0).expect("not 0 at both ends");
/// assert_eq!((rising.from_unit(0.25), rising.pdf(0.5)), (0.5, 1.0));
/// assert_eq!(Linear::new(0.0_f64, 0.0), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear<T> {
    /// Densities at both ends, whose sum is 2.
    ends: [T; 2],
}

impl<T: Real> Linear<T> {
    /// The density proportional to `a` at 0 and to `b` at 1; `None` unless both are finite and not negative, and one is
    /// positive.
    #[inline]
    pub fn new(a: T, b: T) -> Option<Self> {
        let half_sum = T::HALF * a + T::HALF * b;
        let valid = a >= T::ZERO && b >= T::ZERO && half_sum > T::ZERO && half_sum.is_finite();
        valid.then(|| Self { ends: [a / half_sum, b / half_sum] })
    }

    /// A number by its density.
    ///
    /// ```text
    /// x = u (a + b) / (a + √(a² (1 − u) + b² u))
    /// ```
    ///
    /// which has no difference to lose digits by, and no special case for `a = b`.
    ///
    /// # Precision
    /// A few ulp.
    #[inline]
    pub fn from_unit(&self, u: T) -> T {
        let [a, b] = self.ends;
        let root = (a * a * (T::ONE - u) + b * b * u).sqrt();
        // 0 / 0 where the density rises from 0 and u is 0: NaN becomes 0.
        into_unit(T::TWO * u / (a + root))
    }

    /// The uniform that [`from_unit`](Self::from_unit) maps to `x`.
    ///
    /// ```text
    /// u = x (a (2 − x) + b x) / (a + b)
    /// ```
    ///
    /// # Precision
    /// A few ulp.
    #[inline]
    pub fn to_unit(&self, x: T) -> T {
        let [a, b] = self.ends;
        into_unit(T::HALF * x * (a * (T::TWO - x) + b * x))
    }

    /// Density at `x`; 0 outside `[0, 1]` and for NaN.
    #[inline]
    pub fn pdf(&self, x: T) -> T {
        let [a, b] = self.ends;
        if x >= T::ZERO && x <= T::ONE { a * (T::ONE - x) + b * x } else { T::ZERO }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::uniforms;

    const ENDS: [[f64; 2]; 6] =
        [[1.0, 1.0], [0.0, 2.0], [5.0, 0.0], [1.0, 1.0 + 1e-9], [1e-30, 1.0], [1e300, 1e308]];

    #[test]
    fn inverse_undoes_the_map_and_the_density_is_its_slope() {
        for [a, b] in ENDS {
            let linear = Linear::new(a, b).expect("a density");
            for [u, _] in uniforms::<f64>(200) {
                let x = linear.from_unit(u);
                assert!((0.0..1.0).contains(&x));
                // A few roundings.
                assert!((linear.to_unit(x) - u).abs() < 8.0 * f64::EPSILON, "{a} {b} {u}");
                let h = 1e-6;
                let slope = (linear.to_unit(x + h) - linear.to_unit(x - h)) / (2.0 * h);
                let inside = x > h && x < 1.0 - h;
                // ε / h of rounding; the difference of a parabola is exact.
                assert!(!inside || (slope - linear.pdf(x)).abs() < 1e-9, "{a} {b} {x}");
            }
        }
    }

    #[test]
    fn single_precision_keeps_all_digits() {
        for [a, b] in ENDS.map(|ends| ends.map(|x| (x / 1e3).min(1e38) as f32)) {
            let narrow = Linear::new(a, b).expect("a density");
            let wide = Linear::new(f64::from(a), f64::from(b)).expect("a density");
            for [u, _] in uniforms::<f32>(500) {
                let (x, exact) = (narrow.from_unit(u), wide.from_unit(f64::from(u)));
                let error = (f64::from(x) - exact).abs();
                assert!(error <= 8.0 * f64::from(f32::EPSILON) * exact, "{a} {b} {u}: {x} {exact}");
            }
        }
    }

    #[test]
    fn ends_and_refusals() {
        for [a, b] in ENDS {
            let linear = Linear::new(a, b).expect("a density");
            assert_eq!(linear.from_unit(0.0), 0.0);
            assert!(linear.from_unit(f64::ONE_MINUS_EPSILON) < 1.0);
            assert_eq!([linear.pdf(-0.1), linear.pdf(1.1), linear.pdf(f64::NAN)], [0.0; 3]);
        }
        for [a, b] in [[-1.0, 2.0], [2.0, -1.0], [f64::NAN, 1.0], [1.0, f64::INFINITY]] {
            assert_eq!(Linear::new(a, b), None);
        }
    }
}
