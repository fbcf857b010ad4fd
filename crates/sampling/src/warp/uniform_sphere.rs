//! The sphere of directions, uniform in solid angle.

use etendue_math::{Real, Vec3, Vector3};

use super::{into_unit, turn};

/// A direction uniform on the sphere.
///
/// ```text
/// z = 1 − 2u₀,   sin θ = 2 √(u₀(1 − u₀)),   φ = 2π u₁
/// ```
///
/// # Precision
/// 4 ulp of x and y, z to half an ulp of 1.
///
/// # Source
/// Archimedes' hat-box theorem; the form of sin θ avoids `1 − z²`.
///
/// # Examples
/// ```
/// use etendue_sampling::warp::uniform_sphere;
/// assert_eq!(uniform_sphere::from_square([0.5_f32, 0.25]).y, 1.0);
/// ```
#[inline]
pub fn from_square<T: Real>([u, v]: [T; 2]) -> Vec3<T> {
    let sin_theta = T::TWO * (u * (T::ONE - u)).sqrt();
    let (sin_phi, cos_phi) = turn::sin_cos(v);
    Vec3::<T>::new(sin_theta * cos_phi, sin_theta * sin_phi, T::ONE - T::TWO * u)
}

/// The uniforms of a direction; absolute precision 4 ε. At the poles `u₁` is 0.
#[inline]
pub fn to_square<T: Real>(w: Vec3<T>) -> [T; 2] {
    // (1 − z)/2 without cancellation near +z.
    let u = if w.z() > T::ZERO {
        T::HALF * (w.x() * w.x() + w.y() * w.y()) / (T::ONE + w.z())
    } else {
        T::HALF * (T::ONE - w.z())
    };
    [into_unit(u), turn::from_point(w.x(), w.y())]
}

/// Density per steradian: `1/4π`.
#[inline]
pub fn pdf<T: Real>() -> T {
    T::lit(0.25) * T::FRAC_1_PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_density_on_sphere, check_inverse, check_jacobian};

    #[test]
    fn inverse_undoes_the_map() {
        check_inverse(from_square::<f64>, to_square::<f64>, 4.0 * f64::EPSILON);
        check_inverse(from_square::<f32>, to_square::<f32>, 4.0 * f64::from(f32::EPSILON));
    }

    #[test]
    fn density_is_that_of_the_map() {
        check_jacobian(from_square::<f64>, |_| pdf());
        check_density_on_sphere(from_square::<f64>, |_| pdf());
    }
}
