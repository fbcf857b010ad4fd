//! Directions within a cone, uniform in solid angle.

use etendue_math::{Real, Vec3, Vector3};

use super::disk;

/// All directions within a given angle of +z, from a single ray to the whole sphere.
///
/// The cone is stored as `1 − cos θmax`, which keeps its digits for the cones of far lights, where
/// the cosine itself rounds to 1.
///
/// # Examples
/// ```
/// use etendue_sampling::warp::cone::Cone;
/// // A light of radius 1 at distance 10 000: a solid angle of π/10⁸.
/// let cone = Cone::from_sine(1e-4_f32);
/// assert!((cone.solid_angle() / 3.1415927e-8 - 1.0).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone<T> {
    one_minus_cos: T,
}

impl<T: Real> Cone<T> {
    /// The cone with `1 − cos θmax = one_minus_cos`, limited to `[0, 2]`; NaN counts as 0.
    #[inline]
    pub fn from_one_minus_cos(one_minus_cos: T) -> Self {
        Self { one_minus_cos: one_minus_cos.clamp_to(T::ZERO, T::TWO) }
    }

    /// The cone of at most a right angle with `sin θmax = sine`, limited to `[0, 1]`.
    ///
    /// ```text
    /// 1 − cos θ = sin²θ / (1 + √(1 − sin²θ))
    /// ```
    ///
    /// # Precision
    /// 3 ulp at any size; `1 − √(1 − s²)` is wrong by 7 % at `s = 1e-3` in `f32`.
    #[inline]
    pub fn from_sine(sine: T) -> Self {
        let s = sine.clamp_to(T::ZERO, T::ONE);
        Self::from_one_minus_cos(s * s / (T::ONE + ((T::ONE - s) * (T::ONE + s)).sqrt()))
    }

    /// `1 − cos θmax`.
    #[inline]
    pub fn one_minus_cos(&self) -> T {
        self.one_minus_cos
    }

    /// Solid angle `Ω = 2π(1 − cos θmax)` in sr.
    #[inline]
    pub fn solid_angle(&self) -> T {
        T::TWO * T::PI * self.one_minus_cos
    }

    /// A direction uniform in solid angle within the cone.
    ///
    /// ```text
    /// (dx, dy) concentric on the disk, r² = dx² + dy², m = 1 − cos θmax
    /// 1 − cos θ = m r²,   (x, y) = (dx, dy) √(m (2 − m r²))
    /// ```
    ///
    /// # Precision
    /// 6 ulp of x and y at any size of the cone; z likewise, at the rim of a hemisphere too,
    /// because `1 − r²` comes from the uniforms.
    ///
    /// # Source
    /// The concentric map of Shirley and Chiu 1997, section 3, generalised from the hemisphere.
    #[inline]
    pub fn from_square(&self, u: [T; 2]) -> Vec3<T> {
        let m = self.one_minus_cos;
        let point = disk::concentric(u);
        // 1 + cos θ = 2 − m r² without cancellation at the rim of the whole sphere (m = 2).
        let one_plus_z = (T::TWO - m) + m * point.one_minus_radius_squared;
        let scale = (m * one_plus_z).sqrt();
        let z = (T::ONE - m) + m * point.one_minus_radius_squared;
        Vec3::<T>::new(point.x * scale, point.y * scale, z)
    }

    /// The uniforms of a direction; those of the nearest rim direction outside the cone.
    ///
    /// # Precision
    /// Absolute, 6 ε. Around −z of the whole sphere all uniforms of the rim meet.
    #[inline]
    pub fn to_square(&self, w: Vec3<T>) -> [T; 2] {
        let scale = (self.one_minus_cos * one_plus_z(w)).sqrt();
        if scale > T::ZERO {
            disk::to_square([w.x() / scale, w.y() / scale])
        } else {
            disk::to_square([T::ONE, T::ZERO])
        }
    }

    /// Density per steradian: `1/Ω` within the cone, 0 outside.
    ///
    /// `w`: unit vector. Whether it lies in the cone is decided to about 8 ε of `1 − cos θmax`.
    #[inline]
    pub fn pdf(&self, w: Vec3<T>) -> T {
        let one_minus_z = if w.z() > T::ZERO {
            (w.x() * w.x() + w.y() * w.y()) / (T::ONE + w.z())
        } else {
            T::ONE - w.z()
        };
        if one_minus_z <= self.one_minus_cos * (T::ONE + T::lit(8.0) * T::EPSILON) {
            T::ONE / self.solid_angle()
        } else {
            T::ZERO
        }
    }
}

/// `1 + z` of a unit vector without cancellation towards −z.
#[inline]
fn one_plus_z<V: Vector3>(w: V) -> V::Scalar {
    if w.z() < V::Scalar::ZERO {
        (w.x() * w.x() + w.y() * w.y()) / (V::Scalar::ONE - w.z())
    } else {
        V::Scalar::ONE + w.z()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_density_on_sphere, check_inverse, check_jacobian, uniforms};

    #[test]
    fn inverse_undoes_the_map_for_every_size() {
        for m in [1e-30, 1e-12, 1e-3, 0.3, 1.0, 1.7] {
            let (wide, narrow) = (Cone::from_one_minus_cos(m), Cone::from_one_minus_cos(m as f32));
            // Two square roots and an arc tangent; towards m = 2 the pole loses another factor.
            let ulps = if m > 1.0 { 32.0 } else { 8.0 };
            check_inverse(|u| wide.from_square(u), |w| wide.to_square(w), ulps * f64::EPSILON);
            check_inverse(
                |u| narrow.from_square(u),
                |w| narrow.to_square(w),
                ulps * f64::from(f32::EPSILON),
            );
        }
    }

    #[test]
    fn density_is_that_of_the_map() {
        for m in [0.1, 0.5, 1.0, 1.5] {
            let cone = Cone::from_one_minus_cos(m);
            check_jacobian(|u| cone.from_square(u), |w| cone.pdf(w));
        }
        let cone = Cone::from_one_minus_cos(0.5);
        check_density_on_sphere(|u| cone.from_square(u), |w| cone.pdf(w));
    }

    #[test]
    fn far_lights_keep_their_digits_in_single_precision() {
        for exponent in 1..18 {
            let sine = Real::powi(0.1_f32, exponent);
            let (narrow, wide) = (Cone::from_sine(sine), Cone::from_sine(f64::from(sine)));
            let ratio = f64::from(narrow.solid_angle()) / wide.solid_angle();
            // Three roundings of the formula, two of the solid angle.
            assert!((ratio - 1.0).abs() < 3.0 * f64::from(f32::EPSILON), "{sine}: {ratio}");
            for u in uniforms::<f32>(100) {
                let (a, b) =
                    (narrow.from_square(u), wide.from_square([f64::from(u[0]), f64::from(u[1])]));
                // Relative to the width of the cone, not to the unit vector.
                let error = (a.as_dvec3() - b).truncate().length() / f64::from(sine);
                assert!(error < 6.0 * f64::from(f32::EPSILON), "{sine} {u:?}: {error:e}");
                assert!(narrow.pdf(a) > 0.0, "{sine} {u:?}");
            }
        }
    }

    #[test]
    fn nonsense_sizes_are_limited() {
        assert_eq!(Cone::from_sine(f32::NAN).solid_angle(), 0.0);
        assert_eq!(Cone::from_sine(2.0_f64).one_minus_cos(), 1.0);
        assert_eq!(Cone::from_one_minus_cos(3.0_f64).one_minus_cos(), 2.0);
        let pole = Vec3::<f64>::new(0.0, 0.0, -1.0);
        let [u, v] = Cone::from_one_minus_cos(2.0).to_square(pole);
        assert!(u < 1.0 && v < 1.0);
    }
}
