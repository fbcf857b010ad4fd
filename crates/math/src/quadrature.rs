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

#[cfg(test)]
mod tests {
    use super::*;

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
