//! Numerical integration.

use crate::Real;

/// Nodes and weights of the `N`-point Gauss–Legendre rule on `[0, 1]`.
///
/// ```text
/// ∫₀¹ f(x) dx ≈ Σ wᵢ f(xᵢ), exact for polynomials of degree 2N − 1
/// ```
///
/// # Precision
/// Nodes and weights are computed in `f64` by Newton's method and rounded: within a few ulp.
///
/// # Source
/// Press et al., Numerical Recipes, 3rd ed., section 4.6.1 (`gauleg`).
///
/// # Examples
/// ```
/// use etendue_math::quadrature::gauss_legendre;
/// let integral: f64 = gauss_legendre::<f64, 8>().iter().map(|&(x, w)| w * x * x * x).sum();
/// assert!((integral - 0.25).abs() < 1e-15);
/// ```
pub fn gauss_legendre<T: Real, const N: usize>() -> [(T, T); N] {
    let mut rule = [(T::ZERO, T::ZERO); N];
    for (i, entry) in rule.iter_mut().enumerate() {
        let (x, w) = node(N, i);
        *entry = (T::lit(0.5 * (1.0 - x)), T::lit(0.5 * w));
    }
    rule
}

/// Node `i` (from +1 downwards) and weight of the `n`-point rule on `[−1, 1]`.
fn node(n: usize, i: usize) -> (f64, f64) {
    let mut x = Real::cos(f64::PI * (i as f64 + 0.75) / (n as f64 + 0.5));
    let mut slope = 1.0;
    // Newton from this start converges in at most 5 steps for n ≤ 1000; 10 leave no doubt.
    for _ in 0..10 {
        let (mut p, mut previous) = (1.0, 0.0);
        for k in 0..n {
            let k = k as f64;
            (p, previous) = (((2.0 * k + 1.0) * x * p - k * previous) / (k + 1.0), p);
        }
        slope = n as f64 * (x * p - previous) / (x * x - 1.0);
        x -= p / slope;
    }
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

/// Adaptive integration in one dimension: an `N`-point Gauss–Legendre rule, bisected where that changes it.
///
/// ```text
/// ∫ₐᵇ f dx ≈ L + R when |L + R − W| ≤ tolerance, or the depth is used up; else both halves likewise
/// ```
///
/// with the rule over the whole interval W and over its halves L, R. Bisection also gets at an end or a kink where
/// the integrand is not smooth, for the panel around it halves its share of the integral with every step. A
/// NaN ends the refinement.
///
/// # Precision
/// The difference that is compared is the error of the coarser rule; where f is smooth, that of the finer one, which
/// is returned, is about 4⁻ᴺ of it.
///
/// # Examples
/// ```
/// use etendue_math::quadrature::Adaptive;
/// let rule = Adaptive::<f64, 10>::new(40);
/// let quarter_disk = rule.integrate([0.0, 1.0], 1e-14, &mut |x| (1.0 - x * x).sqrt());
/// assert!((quarter_disk - 0.25 * std::f64::consts::PI).abs() < 1e-13);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Adaptive<T, const N: usize> {
    rule: [(T, T); N],
    depth: u32,
}

impl<T: Real, const N: usize> Adaptive<T, N> {
    /// The rule with at most `depth` bisections in a row.
    pub fn new(depth: u32) -> Self {
        Self { rule: gauss_legendre(), depth }
    }

    /// `∫ f dx` over an interval; the tolerance is absolute and that of each panel.
    pub fn integrate(&self, interval: [T; 2], tolerance: T, f: &mut dyn FnMut(T) -> T) -> T {
        let whole = self.whole(interval, f);
        self.refine(interval, whole, tolerance, self.depth, f)
    }

    fn refine(
        &self,
        [a, b]: [T; 2],
        whole: T,
        tolerance: T,
        depth: u32,
        f: &mut dyn FnMut(T) -> T,
    ) -> T {
        let middle = T::HALF * (a + b);
        let (left, right) = (self.whole([a, middle], f), self.whole([middle, b], f));
        let sum = left + right;
        let change = (sum - whole).abs();
        // What is not a number does not become one by halving.
        if depth == 0 || change <= tolerance || change.is_nan() {
            return sum;
        }
        self.refine([a, middle], left, tolerance, depth - 1, f)
            + self.refine([middle, b], right, tolerance, depth - 1, f)
    }

    fn whole(&self, [a, b]: [T; 2], f: &mut dyn FnMut(T) -> T) -> T {
        let width = b - a;
        self.rule.iter().map(|&(x, w)| w * f(a + width * x)).sum::<T>() * width
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn adaptive_integration_finds_narrow_peaks_kinks_and_infinite_slopes() {
        let rule = Adaptive::<f64, 8>::new(50);
        let mut evaluations = 0;
        let mut check = |f: &dyn Fn(f64) -> f64, exact: f64| {
            let mut counted = |x| {
                evaluations += 1;
                f(x)
            };
            let got = rule.integrate([0.0, 1.0], 1e-14, &mut counted);
            // Dozens of panels, each well within its tolerance.
            assert!((got - exact).abs() < 1e-13 * exact.max(1.0), "{got} {exact}");
        };
        check(&|x| 1e-3 / ((x - 0.3) * (x - 0.3) + 1e-6), {
            Real::atan2(0.7, 1e-3) + Real::atan2(0.3, 1e-3)
        });
        check(&|x| (x - 0.3).abs(), 0.5 * (0.3 * 0.3 + 0.7 * 0.7));
        check(&f64::sqrt, 2.0 / 3.0);
        assert!(evaluations < 10_000, "{evaluations}");
        assert!(rule.integrate([0.0, 1.0], 0.0, &mut |_| f64::NAN).is_nan());
    }

    #[test]
    fn polynomials_up_to_degree_2n_minus_1_are_exact() {
        let rule = gauss_legendre::<f64, 16>();
        for degree in 0..32 {
            let got: f64 = rule.iter().map(|&(x, w)| w * Real::powi(x, degree)).sum();
            let want = 1.0 / f64::from(degree + 1);
            // 16 positive terms, each within a few ε.
            assert!((got - want).abs() < 16.0 * f64::EPSILON, "degree {degree}: {got} {want}");
        }
    }
}
