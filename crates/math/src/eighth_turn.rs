//! Sine and cosine within an eighth of a turn, where maps of disks and spheres need them.

use crate::backend;

/// Through `f64`, in which a polynomial of degree 8 is within 2⁻²⁸ of both functions: the rounding
/// to `f32` is nearly all of the error. The same bits everywhere, for a quarter of the time that a
/// library takes, which has to reduce any argument.
///
/// ```text
/// sin(π/4 x) ≈ x (s₀ + s₁ x² + s₂ x⁴ + s₃ x⁶),   cos(π/4 x) ≈ 1 + x² (c₁ + c₂ x² + c₃ x⁴ + c₄ x⁶)
/// ```
///
/// The coefficients are those of least relative error on `[−1, 1]` (Remez' algorithm at 50 digits).
#[inline(always)]
pub(crate) fn sin_cos_f32(x: f32) -> (f32, f32) {
    let x = f64::from(x);
    let z = x * x;
    let z2 = z * z;
    let sin = (0.7853981608541723 + z * -0.0807454325291785)
        + z2 * (0.0024900010240756837 + z * -0.00003595045227485045);
    let cos = (-0.30842513564941685 + z * 0.015854326622843052)
        + z2 * (-0.00032594007986653606 + z * 0.0000035303380594539425);
    ((x * sin) as f32, (1.0 + z * cos) as f32)
}

/// By the backend's functions, after a rounding of the angle.
#[inline(always)]
pub(crate) fn sin_cos_f64(x: f64) -> (f64, f64) {
    let angle = x * core::f64::consts::FRAC_PI_4;
    (backend::f64::sin(angle), backend::f64::cos(angle))
}

#[cfg(test)]
mod tests {
    use crate::Real;

    #[test]
    fn single_precision_is_double_precision_rounded() {
        // An interpreter tries a few of them.
        for i in (-10_000..=10_000).step_by(if cfg!(miri) { 1250 } else { 1 }) {
            let x = i as f32 / 10_000.0;
            let (sin, cos) = x.sin_cos_eighth_turn();
            let (want_sin, want_cos) = f64::from(x).sin_cos_eighth_turn();
            // Half an ulp of rounding (up to ε/2 in relative terms), and 2⁻²⁸ = ε/32.
            let bound = (0.5 + 1.0 / 32.0) * f64::from(f32::EPSILON);
            assert!((f64::from(sin) - want_sin).abs() <= bound * want_sin.abs(), "{x}");
            assert!((f64::from(cos) - want_cos).abs() <= bound * want_cos.abs(), "{x}");
        }
    }

    #[test]
    fn ends_and_middle_are_those_of_the_circle() {
        assert_eq!(0.0_f32.sin_cos_eighth_turn(), (0.0, 1.0));
        assert_eq!(0.0_f64.sin_cos_eighth_turn(), (0.0, 1.0));
        for end in [1.0_f32, -1.0] {
            let (sin, cos) = end.sin_cos_eighth_turn();
            assert_eq!((sin * end, cos), (Real::sqrt(0.5), Real::sqrt(0.5)));
        }
    }
}
