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

    #[test]
    fn erf_inv_inverts_erf() {
        for i in -999..1000 {
            let x = f64::from(i) / 1000.0;
            // Newton's last step leaves the error of erf itself, amplified by at most 1/x near 0.
            assert!((erf(erf_inv(x)) - x).abs() <= 4.0 * f64::EPSILON, "{x}");
        }
        for i in -999..1000 {
            let x = i as f32 / 1000.0;
            assert!((erf(erf_inv(x)) - x).abs() <= 4.0 * f32::EPSILON, "{x}");
        }
        assert_eq!(erf_inv(1.0_f32), f32::INFINITY);
        assert_eq!(erf_inv(-1.0_f64), f64::NEG_INFINITY);
    }
}
