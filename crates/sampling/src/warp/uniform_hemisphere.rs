//! The hemisphere around +z, uniform in solid angle.

use etendue_math::{Real, Vec3, Vector3};

use super::cone::Cone;

#[inline]
fn cone<T: Real>() -> Cone<T> {
    Cone::from_one_minus_cos(T::ONE)
}

/// A direction uniform on the upper hemisphere: the [`Cone`] of a right angle.
///
/// ```text
/// (dx, dy) concentric on the disk:   z = 1 − r²,   (x, y) = (dx, dy) √(2 − r²)
/// ```
///
/// # Precision
/// 6 ulp of each component, also of a z near 0.
///
/// # Source
/// Shirley and Chiu 1997, section 3.
///
/// # Examples
/// ```
/// use etendue_sampling::warp::uniform_hemisphere;
/// assert_eq!(uniform_hemisphere::from_square([0.5_f32, 0.5]).z, 1.0);
/// ```
#[inline]
pub fn from_square<T: Real>(u: [T; 2]) -> Vec3<T> {
    cone().from_square(u)
}

/// The uniforms of a direction of the upper hemisphere; absolute precision 8 ε.
#[inline]
pub fn to_square<T: Real>(w: Vec3<T>) -> [T; 2] {
    cone().to_square(w)
}

/// Density per steradian: `1/2π` for `z ≥ 0`, else 0.
#[inline]
pub fn pdf<T: Real>(w: Vec3<T>) -> T {
    if w.z() >= T::ZERO { T::HALF * T::FRAC_1_PI } else { T::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_density_on_sphere, check_inverse, check_jacobian};

    #[test]
    fn inverse_undoes_the_map() {
        check_inverse(from_square::<f64>, to_square::<f64>, 8.0 * f64::EPSILON);
        check_inverse(from_square::<f32>, to_square::<f32>, 8.0 * f64::from(f32::EPSILON));
    }

    #[test]
    fn density_is_that_of_the_map() {
        check_jacobian(from_square::<f64>, pdf::<f64>);
        check_density_on_sphere(from_square::<f64>, pdf::<f64>);
    }

    #[test]
    fn directions_never_point_below_the_horizon() {
        for edge in [0.0, f32::MIN_POSITIVE, f32::EPSILON, f32::ONE_MINUS_EPSILON] {
            for other in [0.0, 0.3, 0.5, f32::ONE_MINUS_EPSILON] {
                assert!(from_square::<f32>([edge, other]).z >= 0.0);
                assert!(from_square::<f32>([other, edge]).z >= 0.0);
            }
        }
    }
}
