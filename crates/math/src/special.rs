//! Special functions.

use crate::Real;

/// The error function.
///
/// ```text
/// erf(x) = 2/√π ∫₀ˣ exp(−t²) dt
/// ```
///
/// # Precision
/// Within 1 ulp (the `libm` crate's, on both backends: `std` has none).
pub fn erf<T: Real>(x: T) -> T {
    x.erf()
}

/// The inverse of the error function on `(−1, 1)`; ±∞ at ±1 and NaN beyond.
///
/// Giles' polynomial starts, two Newton steps on [`erf`] finish.
///
/// # Precision
/// Relative error below 1e-6 in `f32` and 1e-13 in `f64` for `|x| ≤ 1 − 1e-6`; towards ±1 the
/// function itself is ill-conditioned in `x`.
///
/// # Source
/// M. Giles, "Approximating the erfinv function", GPU Computing Gems 2, 2010, single precision form.
pub fn erf_inv<T: Real>(x: T) -> T {
    if x.abs() >= T::ONE {
        return if x.abs() == T::ONE { T::INFINITY.copysign(x) } else { T::NAN };
    }
    let w = -((T::ONE - x) * (T::ONE + x)).ln();
    let (w, coefficients) =
        if w < T::lit(5.0) { (w - T::lit(2.5), &CENTRAL) } else { (w.sqrt() - T::lit(3.0), &TAIL) };
    let mut p = T::ZERO;
    for &c in coefficients {
        p = T::lit(c) + p * w;
    }
    let mut y = p * x;
    for _ in 0..2 {
        // f(y) = erf(y) − x, f'(y) = 2/√π exp(−y²)
        let slope = T::lit(core::f64::consts::FRAC_2_SQRT_PI) * (-y * y).exp();
        if slope > T::MIN_POSITIVE {
            y -= (y.erf() - x) / slope;
        }
    }
    y
}

/// Ratio of gamma functions half a step apart, `Γ(x) / Γ(x + ½)`, for x > 0; NaN elsewhere.
///
/// # Precision
/// Within 20 ulp, in `f64` as in `f32`: at most 16 steps of `Γ(x + 1) = x Γ(x)`, then the asymptotic series, whose
/// remainder is 3e-17.
///
/// # Source
/// The series in `1/w²`, `w = x − ¼`, of ln Γ(w + ¼) − ln Γ(w + ¾): its coefficients are Euler numbers over
/// `2k 4²ᵏ`.
///
/// # Examples
/// ```
/// use etendue_math::special::gamma_half_step;
/// // Γ(1/2) = √π, Γ(1) = 1
/// assert!((gamma_half_step(0.5_f64) - std::f64::consts::PI.sqrt()).abs() < 1e-14);
/// ```
pub fn gamma_half_step<T: Real>(x: T) -> T {
    if x.is_nan() || x <= T::ZERO {
        return T::NAN;
    }
    let (mut x, mut steps) = (x, T::ONE);
    while x < T::lit(16.0) {
        steps *= (x + T::HALF) / x;
        x += T::ONE;
    }
    let w = x - T::lit(0.25);
    let v = T::ONE / (w * w);
    let series = GAMMA_HALF_STEP.iter().rev().fold(T::ZERO, |sum, &c| T::lit(c) + v * sum);
    steps * (v * series).exp() / w.sqrt()
}

/// Euler numbers `±1, 5, 61, 1385, 50521` over `2k 4²ᵏ`.
const GAMMA_HALF_STEP: [f64; 5] =
    [-1.0 / 64.0, 5.0 / 2_048.0, -61.0 / 49_152.0, 1_385.0 / 1_048_576.0, -50_521.0 / 20_971_520.0];

/// The regularised incomplete beta function whose first parameter is ½.
///
/// ```text
/// I(½, p; y) = ∫₀ʸ t^(−½) (1 − t)^(p−1) dt / B(½, p)
/// ```
///
/// For integer 2p it is the distribution of the cosine in the power lobes of reflection models; for large p it tends to
/// `erf √(p y)`.
///
/// * `p`: at least ½, finite, of any size; NaN below.
/// * `y`: in `[0, 1]`; limited to it, and NaN counts as 0.
///
/// # Precision
/// Absolute, 1e-14 in `f64` and 40 ε in `f32`: one of two power series without a change of sign, of at most some 300
/// terms.
///
/// # Source
/// Abramowitz and Stegun, Handbook of Mathematical Functions, 26.5.4, from either end.
///
/// # Examples
/// ```
/// use etendue_math::special::incomplete_beta_half;
/// // p = 1: the integral is elementary, √y.
/// assert!((incomplete_beta_half(1.0_f64, 0.25) - 0.5).abs() < 1e-15);
/// ```
pub fn incomplete_beta_half<T: Real>(p: T, y: T) -> T {
    if p.is_nan() || p < T::HALF {
        return T::NAN;
    }
    let y = y.clamp_to(T::ZERO, T::ONE);
    // 1 − I < erfc √(p y) is below an ε of f64; the series would have as many terms as p y.
    if p * y > T::lit(40.0) {
        return T::ONE;
    }
    let below_one = (p * (-y).ln_1p()).exp();
    // 1/B(½, p) = Γ(p + ½) / (Γ(½) Γ(p))
    let scale = T::lit(core::f64::consts::FRAC_2_SQRT_PI) * T::HALF / gamma_half_step(p);
    if y <= T::HALF {
        let series = rising_quotient(p + T::HALF, T::lit(1.5), y);
        (T::TWO * scale * y.sqrt() * below_one * series).min(T::ONE)
    } else {
        let series = rising_quotient(p + T::HALF, p + T::ONE, T::ONE - y);
        (T::ONE - scale * y.sqrt() * below_one / p * series).max(T::ZERO)
    }
}

/// `Σ (a)ₖ/(b)ₖ zᵏ`, positive terms that fall by at least 2 in the end (z ≤ ½).
fn rising_quotient<T: Real>(a: T, b: T, z: T) -> T {
    let (mut a, mut b, mut term, mut sum) = (a, b, T::ONE, T::ONE);
    // Terms grow up to k = 40, and then a hundred fall below the last bit.
    for _ in 0..400 {
        term *= a / b * z;
        sum += term;
        a += T::ONE;
        b += T::ONE;
        if term < sum * T::EPSILON * T::HALF {
            break;
        }
    }
    sum
}

const CENTRAL: [f64; 9] = [
    2.81022636e-08,
    3.43273939e-07,
    -3.5233877e-06,
    -4.39150654e-06,
    0.00021858087,
    -0.00125372503,
    -0.00417768164,
    0.246640727,
    1.50140941,
];
const TAIL: [f64; 9] = [
    -0.000200214257,
    0.000100950558,
    0.00134934322,
    -0.00367342844,
    0.00573950773,
    -0.0076224613,
    0.00943887047,
    1.00167406,
    2.83297682,
];

#[cfg(test)]
mod tests {
    use super::*;

    /// Every how many of the arguments are tried: few by an interpreter.
    const STEP: usize = if cfg!(miri) { 125 } else { 1 };

    #[test]
    fn the_gamma_ratio_meets_its_recurrence_and_known_values() {
        // Γ(1)/Γ(3/2) = 2/√π; Γ(x)/Γ(x + ½) · Γ(x + ½)/Γ(x + 1) = 1/x.
        assert!((gamma_half_step(1.0_f64) - core::f64::consts::FRAC_2_SQRT_PI).abs() < 1e-14);
        for x in [1e-3_f64, 0.5, 3.3, 15.9, 16.1, 1e5, 5e11] {
            let product = gamma_half_step(x) * gamma_half_step(x + 0.5) * x;
            assert!((product - 1.0).abs() < 20.0 * f64::EPSILON, "{x}: {product}");
            let single = f64::from(gamma_half_step(x as f32));
            let error = single / gamma_half_step(f64::from(x as f32)) - 1.0;
            assert!(error.abs() < 20.0 * f64::from(f32::EPSILON), "{x}: {error}");
        }
        assert!(gamma_half_step(0.0_f64).is_nan() && gamma_half_step(f32::NAN).is_nan());
    }

    #[test]
    fn the_incomplete_beta_function_meets_its_closed_forms() {
        for i in (0..=1000).step_by(STEP) {
            let y = f64::from(i) / 1000.0;
            let root = y.sqrt();
            // p = ½: 2/π asin √y; p = 2: ½ √y (3 − y).
            let asin = Real::atan2(root, (1.0 - y).sqrt()) * 2.0 / f64::PI;
            assert!((incomplete_beta_half(0.5, y) - asin).abs() < 1e-14, "{y}");
            let cubic = 0.5 * root * (3.0 - y);
            assert!((incomplete_beta_half(2.0, y) - cubic).abs() < 1e-14, "{y}");
            // Large p: erf √(p y) but for relative 1/p.
            let p = 1e12;
            let narrow = incomplete_beta_half(p, 50.0 * y / p);
            assert!((narrow - erf((50.0 * y).sqrt())).abs() < 1e-10, "{y}");
            for p in [0.5_f32, 1.0, 7.3, 70.0, 900.0] {
                let y = y as f32;
                let error = f64::from(incomplete_beta_half(p, y))
                    - incomplete_beta_half(f64::from(p), f64::from(y));
                assert!(error.abs() < 40.0 * f64::from(f32::EPSILON), "{p} {y}: {error}");
            }
        }
        assert_eq!(incomplete_beta_half(3.0_f32, f32::NAN), 0.0);
        assert!(incomplete_beta_half(0.0_f64, 0.5).is_nan());
    }

    #[test]
    fn erf_inv_inverts_erf() {
        for i in (-999..1000).step_by(STEP) {
            let x = f64::from(i) / 1000.0;
            // Newton's last step leaves the error of erf itself, amplified by at most 1/x near 0.
            assert!((erf(erf_inv(x)) - x).abs() <= 4.0 * f64::EPSILON, "{x}");
        }
        for i in (-999..1000).step_by(STEP) {
            let x = i as f32 / 1000.0;
            assert!((erf(erf_inv(x)) - x).abs() <= 4.0 * f32::EPSILON, "{x}");
        }
        assert_eq!(erf_inv(1.0_f32), f32::INFINITY);
        assert_eq!(erf_inv(-1.0_f64), f64::NEG_INFINITY);
    }
}
