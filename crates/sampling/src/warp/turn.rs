//! Angles counted in turns.

use etendue_math::Real;

/// Sine and cosine of `u` turns.
///
/// ```text
/// (sin 2πu, cos 2πu)
/// ```
///
/// `u`: number of turns, any finite value. Multiples of a quarter give exact 0 and ±1.
///
/// # Precision
/// Within 3 ulp of each component, however close to 0 it is: `u` is reduced exactly to
/// `[−1/8, 1/8]` before it meets π. `sin(2π·u)` in `f32` is wrong by 19 % of its value at the
/// last `u` below 1.
///
/// # Examples
/// ```
/// use etendue_sampling::warp::turn;
/// assert_eq!(turn::sin_cos(0.25_f32), (1.0, 0.0));
/// ```
#[inline]
pub fn sin_cos<T: Real>(u: T) -> (T, T) {
    let nearest = (u * T::lit(4.0) + T::HALF).floor();
    let (sin, cos) = ((u - nearest * T::lit(0.25)) * T::lit(8.0)).sin_cos_eighth_turn();
    let quarter = nearest - T::lit(4.0) * (nearest * T::lit(0.25)).floor();
    if quarter == T::ONE {
        (cos, -sin)
    } else if quarter == T::TWO {
        (-sin, -cos)
    } else if quarter == T::lit(3.0) {
        (-cos, sin)
    } else {
        (sin, cos)
    }
}

/// The angle of the point `(x, y)` in turns, in `[0, 1)`; 0 at the origin.
///
/// ```text
/// u = atan2(y, x)/2π  (mod 1)
/// ```
#[inline]
pub fn from_point<T: Real>(x: T, y: T) -> T {
    let u = y.atan2(x) * (T::HALF * T::FRAC_1_PI);
    super::into_unit(if u < T::ZERO { u + T::ONE } else { u })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quarters_are_exact() {
        for whole in [-1.0, 0.0, 5.0_f64] {
            assert_eq!(sin_cos(whole), (0.0, 1.0));
            assert_eq!(sin_cos(whole + 0.25), (1.0, 0.0));
            assert_eq!(sin_cos(whole + 0.5), (0.0, -1.0));
            assert_eq!(sin_cos(whole + 0.75), (-1.0, 0.0));
        }
    }

    #[test]
    fn small_components_keep_their_digits_in_single_precision() {
        for i in 1..400 {
            for base in [0.0, 0.25, 0.5, 0.75, 1.0_f32] {
                for u in [base + i as f32 / 3200.0, base - (i as f32 / 3200.0)] {
                    let (sin, cos) = sin_cos(u);
                    let (want_sin, want_cos) = sin_cos(f64::from(u));
                    // Argument: rounding of 2π and of the product; then the function's ulp.
                    let bound = 3.0 * f64::from(f32::EPSILON);
                    assert!((f64::from(sin) - want_sin).abs() <= bound * want_sin.abs(), "{u}");
                    assert!((f64::from(cos) - want_cos).abs() <= bound * want_cos.abs(), "{u}");
                }
            }
        }
        // The last number below 1: −2π·2⁻²⁴.
        let (sin, _) = sin_cos(f32::ONE_MINUS_EPSILON);
        assert!((sin / -3.7450703e-7 - 1.0).abs() < 2.0 * f32::EPSILON, "{sin}");
        let naive = Real::sin(2.0 * f32::PI * f32::ONE_MINUS_EPSILON);
        assert!((naive / -3.7450703e-7 - 1.0).abs() > 0.1, "the plain product loses a digit");
    }

    #[test]
    fn the_angle_of_a_point_comes_back() {
        for i in 0..1000 {
            let u = f64::from(i) / 1000.0;
            let (sin, cos) = sin_cos(u);
            // atan2 and the division by 2π, at values up to 1.
            assert!((from_point(cos, sin) - u).abs() < 4.0 * f64::EPSILON);
        }
        assert_eq!(from_point(0.0_f32, 0.0), 0.0);
        assert!(from_point(1.0_f32, -f32::MIN_POSITIVE) < 1.0);
    }
}
