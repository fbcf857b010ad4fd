//! The χ² distribution and the correction for making many tests.

use etendue_math::Real;

/// Regularised upper incomplete gamma function `Q(a, x)`, for `a > 0` and `x ≥ 0`.
///
/// ```text
/// Q(a, x) = 1/Γ(a) ∫ₓ^∞ tᵃ⁻¹ e⁻ᵗ dt
/// ```
///
/// # Precision
/// Relative error below 1e-10 for `a ≤ 1000` where the result is above 1e-300.
///
/// # Source
/// Press et al., Numerical Recipes, 3rd ed., section 6.2: the series below `a + 1`, Lentz's
/// continued fraction above.
pub fn upper_gamma(a: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 1.0;
    }
    let log_front = a * Real::ln(x) - x - ln_gamma(a);
    if x < a + 1.0 { 1.0 - lower_series(a, x, log_front) } else { continued(a, x, log_front) }
}

fn lower_series(a: f64, x: f64, log_front: f64) -> f64 {
    let mut term = 1.0 / a;
    let mut sum = term;
    for n in 1..10_000 {
        term *= x / (a + f64::from(n));
        sum += term;
        if term < sum * 1e-17 {
            break;
        }
    }
    sum * Real::exp(log_front)
}

/// Keeps Lentz's quotients away from a division by 0.
const TINY: f64 = 1e-300;

fn continued(a: f64, x: f64, log_front: f64) -> f64 {
    let nonzero = |x: f64| if x.abs() < TINY { TINY } else { x };
    let mut b = x + 1.0 - a;
    let mut c = 1.0 / TINY;
    let mut d = 1.0 / b;
    let mut h = d;
    for i in 1..10_000 {
        let i = f64::from(i);
        let an = -i * (i - a);
        b += 2.0;
        d = 1.0 / nonzero(an * d + b);
        c = nonzero(b + an / c);
        h *= d * c;
        if (d * c - 1.0).abs() < 1e-16 {
            break;
        }
    }
    Real::exp(log_front) * h
}

/// Logarithm of the gamma function for `x > 0`, by Lanczos' approximation (g = 7, 9 terms).
fn ln_gamma(x: f64) -> f64 {
    const C: [f64; 9] = [
        0.9999999999998099,
        676.5203681218851,
        -1259.1392167224028,
        771.3234287776531,
        -176.6150291621406,
        12.507343278686905,
        -0.13857109526572012,
        9.984369578019572e-6,
        1.5056327351493116e-7,
    ];
    let x = x - 1.0;
    let t = x + 7.5;
    let sum = C[1..].iter().zip(1..).fold(C[0], |s, (c, i)| s + c / (x + f64::from(i)));
    0.5 * Real::ln(2.0 * f64::PI) + (x + 0.5) * Real::ln(t) - t + Real::ln(sum)
}

/// Probability that χ² with `degrees` degrees of freedom exceeds `statistic`.
pub fn chi_square_p(statistic: f64, degrees: usize) -> f64 {
    upper_gamma(0.5 * degrees as f64, 0.5 * statistic)
}

/// The significance each of `tests` independent tests must use, so that a run of them all
/// raises one false alarm with probability `overall`.
///
/// ```text
/// α₁ = 1 − (1 − α)^(1/n)
/// ```
///
/// # Source
/// Z. Šidák, JASA 62 (1967), 626–633.
pub fn sidak(overall: f64, tests: usize) -> f64 {
    -Real::exp_m1(Real::ln_1p(-overall) / tests.max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_degrees_of_freedom_are_an_exponential() {
        // Q(1, x) = e⁻ˣ; the stated bound of the function.
        for x in [1e-3, 0.5, 1.9, 2.1, 10.0, 300.0] {
            let want = Real::exp(-x);
            assert!((upper_gamma(1.0, x) - want).abs() <= 1e-10 * want, "{x}");
        }
    }

    #[test]
    fn tabulated_critical_values_are_met() {
        // Critical values at 5 %, printed to 3 decimals: their rounding moves p by less than 1e-4.
        for (degrees, critical) in [(1, 3.841), (10, 18.307), (30, 43.773), (100, 124.342)] {
            assert!((chi_square_p(critical, degrees) - 0.05).abs() < 1e-4, "{degrees}");
        }
    }

    #[test]
    fn corrected_tests_together_have_the_overall_level() {
        let each = sidak(0.01, 500);
        // (1 − α₁)^500 = 0.99 to rounding of 500 factors.
        assert!((Real::powi(1.0 - each, 500) - 0.99).abs() < 500.0 * f64::EPSILON);
    }
}
