//! Directions around ±z with the density of Rayleigh.

use etendue_math::{Real, Vec3, Vector3};

use super::{from_poles, into_unit, turn};

/// The golden ratio φ, with φ³ = 2 + √5.
const GOLDEN: f64 = 1.618_033_988_749_895;

/// A direction by Rayleigh's density.
///
/// With v = min(u, 1 − u) and t = 1 − |cos θ|, the fraction of directions nearer to their pole is
/// `8v = t³ − 3t² + 6t`, whose root is
///
/// ```text
/// q = 2 − 4v,   r = √(q² + 1),   A = ∛(q + r)
/// t = 4v (1 + 4(1 − v) / (√5 + r)) (A + 1/φ) / (A (φ² + φA + A²)),   azimuth 2π u₁
/// ```
///
/// # Precision
/// 16 ulp of x and y, z to 16 ε.
///
/// # Source
/// Lord Rayleigh, "On the light from the sky, its polarization and colour", 1871. Cardano's root for the cosine,
/// A − 1/A, loses its digits at the poles; here the difference from 1 is divided out of it, so that all terms are
/// positive.
///
/// # Examples
/// ```
/// use etendue_sampling::warp::rayleigh;
/// assert_eq!(rayleigh::from_square([0.5_f64, 0.25]).y, 1.0);
/// ```
#[inline]
pub fn from_square<T: Real>([u, turned]: [T; 2]) -> Vec3<T> {
    let v = u.min(T::ONE - u);
    let golden = T::lit(GOLDEN);
    let four = T::lit(4.0);
    let q = T::TWO - four * v;
    let r = (q * q + T::ONE).sqrt();
    let root = (q + r).powf(T::lit(1.0 / 3.0));
    let beyond = T::ONE + four * (T::ONE - v) / (T::lit(5.0).sqrt() + r);
    let one_minus = four * v * beyond * (root + T::ONE / golden)
        / (root * (golden * golden + golden * root + root * root));
    let sin_theta = (one_minus * (T::TWO - one_minus)).safe_sqrt();
    let z = T::ONE - one_minus;
    let (sin_phi, cos_phi) = turn::sin_cos(turned);
    Vec3::<T>::new(sin_theta * cos_phi, sin_theta * sin_phi, if u < T::HALF { z } else { -z })
}

/// The uniforms of a unit direction; at the poles `u₁` is 0.
///
/// # Precision
/// Absolute, 16 ε, of directions that keep the digits of their angle.
#[inline]
pub fn to_square<T: Real>(w: Vec3<T>) -> [T; 2] {
    let [one_minus_z, one_plus_z]: [T; 2] = from_poles(w);
    let t = one_minus_z.min(one_plus_z);
    let v = T::lit(0.125) * t * (T::lit(6.0) - t * (T::lit(3.0) - t));
    let u = if one_minus_z < one_plus_z { v } else { T::ONE - v };
    [into_unit(u), turn::from_point(w.x(), w.y())]
}

/// Density per steradian of directions at an angle θ to the axis.
///
/// ```text
/// p(θ) = 3 (1 + cos² θ) / 16π
/// ```
#[inline]
pub fn pdf<T: Real>(cos_theta: T) -> T {
    T::lit(3.0 / 16.0) * T::FRAC_1_PI * (T::ONE + cos_theta * cos_theta)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_density_on_sphere, check_inverse, check_jacobian, uniforms};

    #[test]
    fn inverse_undoes_the_map() {
        check_inverse(from_square::<f64>, to_square::<f64>, 16.0 * f64::EPSILON);
        check_inverse(from_square::<f32>, to_square::<f32>, 16.0 * f64::from(f32::EPSILON));
    }

    #[test]
    fn density_is_that_of_the_map() {
        check_jacobian(from_square, |w| pdf(w.z));
        check_density_on_sphere(from_square, |w| pdf(w.z));
    }

    #[test]
    fn the_root_solves_the_cubic_to_its_last_digits_next_to_the_poles() {
        for exponent in 1..60 {
            let v = Real::powi(0.5_f64, exponent);
            let w = from_square([v, 0.0]);
            let t = w.x * w.x / (1.0 + w.z);
            let cubic = t * (6.0 - t * (3.0 - t)) / 8.0;
            // A few roundings each of the root, its sine and the square of that.
            assert!((cubic / v - 1.0).abs() < 16.0 * f64::EPSILON, "{v}: {cubic}");
        }
    }

    #[test]
    fn single_precision_keeps_the_angle() {
        let ends = [0.0, 1e-30, 1e-7, 0.5, 0.5_f32.next_down(), f32::ONE_MINUS_EPSILON];
        let ends = ends.map(|u| [u, 0.3]);
        for [u, v] in uniforms::<f32>(500).chain(ends) {
            let w = from_square([u, v]);
            let exact = from_square([u, v].map(f64::from));
            let error = (w.as_dvec3() - exact).truncate().length();
            let size = exact.truncate().length();
            // The documented 16 ulp of the sine.
            assert!(error <= 16.0 * f64::from(f32::EPSILON) * size, "{u}: {error} {size}");
            assert!((w.length() - 1.0).abs() < 8.0 * f32::EPSILON);
        }
    }
}
