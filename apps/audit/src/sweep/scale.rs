//! Errors on the scale of a problem's condition, as cheaply as they can be had.

use etendue_math::Real;
use etendue_math::glam::DVec3;

/// The error of an `f32` on the scale of [`conditioned_ulp`](crate::subject::conditioned_ulp) over
/// some directions, or `None` where it is not beyond `known`.
///
/// ```text
/// |got − want| / (Σ over directions (ε |want| + Σₖ max |g(w ± ε eₖ) − want|) + smallest normal f32)
/// ```
///
/// The sum only grows: as soon as it explains the error nothing more is evaluated, and where rounding
/// alone does, nothing at all.
#[inline]
pub(super) fn error_beyond<const N: usize>(
    known: f64,
    got: f32,
    want: f64,
    directions: [DVec3; N],
    g: impl Fn([DVec3; N]) -> f64,
) -> Option<f64> {
    const EPSILON: f64 = f32::EPSILON as f64;
    let error = (f64::from(got) - want).abs();
    let mut scale = N as f64 * EPSILON * want.abs() + f64::from(<f32 as Real>::MIN_POSITIVE);
    if error <= known * scale {
        return None;
    }
    for i in 0..N {
        for axis in DVec3::AXES {
            let moved = [EPSILON, -EPSILON].map(|step| {
                let mut directions = directions;
                directions[i] += axis * step;
                (g(directions) - want).abs()
            });
            scale += moved[0].max(moved[1]);
            if error <= known * scale {
                return None;
            }
        }
    }
    Some(error / scale)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subject::conditioned_ulp;

    #[test]
    fn the_scale_is_that_of_the_conditioned_ulp_and_known_errors_are_passed_over() {
        let (w, g) = (DVec3::new(0.6, 0.0, 0.8), |w: DVec3| 1.0 / (w.z - 0.799_999));
        let got = g(w) as f32 * 1.1;
        let scale = conditioned_ulp::<f64>(w, f64::from(f32::EPSILON), g);
        let want = (f64::from(got) - g(w)).abs() / scale;
        let error = |known| error_beyond(known, got, g(w), [w], |[w]| g(w));
        // The smallest normal number and the order of the sum.
        assert!((error(0.0).unwrap() / want - 1.0).abs() < 1e-9);
        assert!(error(1.001 * want).is_none() && error(0.999 * want).is_some());
    }
}
