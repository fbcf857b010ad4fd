//! Directions that hit a sphere, seen from a point.

use etendue_math::{Frame, Real, Vec3, Vector3};

use super::cone::Cone;
use super::{area, disk, uniform_sphere};

/// A sphere as a point sees it: uniform in solid angle from outside, uniform in area from inside.
///
/// # Examples
/// ```
/// use etendue_math::glam::Vec3;
/// use etendue_sampling::warp::seen_sphere::SeenSphere;
/// let sun = SeenSphere::<f32>::new(Vec3::Z * 1.496e11, 6.957e8).unwrap();
/// let point = sun.from_square([0.5, 0.5]).unwrap();
/// assert_eq!(point.direction, Vec3::Z);
/// assert_eq!(point.normal, -Vec3::Z);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenSphere<T: Real> {
    center: Vec3<T>,
    radius: T,
    distance: T,
    view: View<T>,
}

/// What the map needs, by the side on which the point lies.
#[derive(Clone, Copy, Debug, PartialEq)]
enum View<T: Real> {
    Outside { frame: Frame<T>, cone: Cone<T>, sine: T },
    Inside,
}

/// A point of the sphere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpherePoint<T: Real> {
    /// Unit vector from the seeing point.
    pub direction: Vec3<T>,
    /// Distance from the seeing point.
    pub distance: T,
    /// Outward unit normal.
    pub normal: Vec3<T>,
}

impl<T: Real> SeenSphere<T> {
    /// The sphere around `center` (relative to the seeing point) with `radius`.
    ///
    /// `None` for a radius that is not positive, for NaN and infinity, and for a sphere so far away
    /// that its solid angle underflows.
    #[inline]
    pub fn new(center: Vec3<T>, radius: T) -> Option<Self> {
        let distance = center.length();
        if !(radius > T::ZERO && radius.is_finite() && distance.is_finite()) {
            return None;
        }
        let view = if distance > radius {
            let sine = radius / distance;
            let cone = Cone::from_sine(sine);
            if cone.one_minus_cos() < T::MIN_POSITIVE {
                return None;
            }
            View::Outside { frame: Frame::from_normal(center / distance), cone, sine }
        } else {
            View::Inside
        };
        Some(Self { center, radius, distance, view })
    }

    /// A point of the sphere: from outside uniform in solid angle on the visible cap, from inside
    /// uniform in area. `None` where the drawn point is the seeing point itself.
    ///
    /// ```text
    /// outside:  (dx, dy) on the disk, r² = dx² + dy², m = 1 − cos θmax, s = sin θmax
    ///           k = √((1 − r²)(2 − m(1 + r²))/(2 − m))                     cosine of incidence
    ///           t = (d² − R²)/(d cos θ + R k)                              distance
    /// ```
    ///
    /// # Precision
    /// From outside 8 ε of each unit vector at any distance: the normal is built from the angles,
    /// not as the difference of two far points. The distance carries the rounding of `d − R`, a
    /// relative error of about `ε d/|d − R|`, as does everything seen from just inside.
    ///
    /// # Source
    /// The cone of the sphere, P. Shirley, C. Wang, "Monte Carlo Techniques for Direct Lighting
    /// Calculations", ACM TOG 15(1), 1996, section 3.3. Departure: `1 − cos θmax` and the point's
    /// depth in forms without cancellation.
    #[inline]
    pub fn from_square(&self, u: [T; 2]) -> Option<SpherePoint<T>> {
        match &self.view {
            View::Inside => {
                let normal = uniform_sphere::from_square(u);
                let offset = self.center + normal * self.radius;
                let distance = offset.length();
                let direction = offset.try_normalize()?;
                Some(SpherePoint { direction, distance, normal })
            }
            View::Outside { frame, cone, sine } => {
                let m = cone.one_minus_cos();
                let point = disk::concentric(u);
                let one_minus_cos = m * point.radius_squared;
                let cos = T::ONE - one_minus_cos;
                // sin θ = scale · r
                let scale = (m * (T::TWO - one_minus_cos)).sqrt();
                let incidence = (point.one_minus_radius_squared
                    * (T::TWO - m * (T::ONE + point.radius_squared))
                    / (T::TWO - m))
                    .safe_sqrt();
                // The angle at the centre is the angle of incidence minus θ.
                let across = scale * (cos / *sine - incidence);
                let sin_squared = scale.sqr() * point.radius_squared;
                let along = incidence * cos + sin_squared / *sine;
                let local = Vec3::<T>::new(point.x * scale, point.y * scale, cos);
                let normal = Vec3::<T>::new(point.x * across, point.y * across, -along);
                let (d, r) = (self.distance, self.radius);
                let distance = (d - r) / (d * cos + r * incidence) * (d + r);
                Some(SpherePoint {
                    direction: frame.to_world(local),
                    distance,
                    normal: frame.to_world(normal),
                })
            }
        }
    }

    /// The uniforms of a direction that hits the sphere.
    ///
    /// # Precision
    /// Absolute. The world direction itself is rounded: about `2 ε/s` from outside, with s the sine
    /// of the cone.
    #[inline]
    pub fn to_square(&self, direction: Vec3<T>) -> [T; 2] {
        match &self.view {
            View::Inside => uniform_sphere::to_square(self.exit(direction).1),
            View::Outside { frame, cone, .. } => cone.to_square(frame.to_local(direction)),
        }
    }

    /// Density per steradian of a direction that hits the sphere.
    ///
    /// ```text
    /// outside:  1/(2π(1 − cos θmax))          inside:  t²/(4πR² |n·ω|)
    /// ```
    ///
    /// From outside it does not test whether `direction` hits: rounding would cut off the rim of
    /// far spheres. The caller has intersected the sphere anyway.
    #[inline]
    pub fn pdf(&self, direction: Vec3<T>) -> T {
        match &self.view {
            View::Inside => {
                let (distance, normal) = self.exit(direction);
                let t = distance / self.radius;
                area::to_solid_angle(uniform_sphere::pdf(), t * t, normal.dot(direction))
            }
            View::Outside { cone, .. } => T::ONE / cone.solid_angle(),
        }
    }

    /// Where a ray from inside leaves the sphere: distance and outward normal.
    #[inline]
    fn exit(&self, direction: Vec3<T>) -> (T, Vec3<T>) {
        let b = self.center.dot(direction);
        let q = (self.radius - self.distance) * (self.radius + self.distance);
        let root = (b * b + q).safe_sqrt();
        // t = b + √(b² + q), in the form whose terms have one sign.
        let distance = if b < T::ZERO { q / (root - b) } else { root + b };
        (distance, (direction * distance - self.center) / self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_density_on_sphere, check_inverse, check_jacobian, uniforms};
    use etendue_math::glam::{DVec3, Vec3 as Vec3f};

    const CENTER: DVec3 = DVec3::new(1.0, -2.0, 2.0);

    fn seen(radius: f64) -> SeenSphere<f64> {
        SeenSphere::new(CENTER, radius).unwrap()
    }

    #[test]
    fn densities_are_those_of_the_maps() {
        for radius in [0.5, 2.0, 2.9, 3.5, 6.0] {
            let sphere = seen(radius);
            let map = |u| sphere.from_square(u).unwrap().direction;
            check_jacobian(map, |w| sphere.pdf(w));
            let hit = |w: DVec3| {
                let b = w.dot(CENTER);
                radius > 3.0 || b > 0.0 && b * b - 9.0 + radius * radius >= 0.0
            };
            // A cone of 0.09 sr covers too few cells of the grid to be integrated on it.
            if radius > 1.0 {
                check_density_on_sphere(map, |w| if hit(w) { sphere.pdf(w) } else { 0.0 });
            }
        }
    }

    #[test]
    fn inverse_undoes_the_map() {
        for radius in [0.5, 2.0, 2.9, 3.5, 6.0] {
            let sphere = seen(radius);
            let map = |u| sphere.from_square(u).unwrap().direction;
            // Rotation into the frame, at most 2 ε, over a sine of at least 1/6; near the cone's
            // rim and near the poles of the inside map slopes of up to 10.
            check_inverse(map, |w| sphere.to_square(w), 256.0 * f64::EPSILON);
        }
    }

    #[test]
    fn points_lie_on_the_sphere_and_normals_point_outwards() {
        for radius in [1e-3, 0.5, 2.0, 2.9, 3.5, 6.0] {
            for u in uniforms(200) {
                let p = seen(radius).from_square(u).unwrap();
                let from_center = p.direction * p.distance - CENTER;
                // Lengths of about 10 are subtracted: 10 ε absolute.
                let error = (from_center - p.normal * radius).length();
                assert!(error < 32.0 * f64::EPSILON, "{radius} {u:?}: {error:e}");
            }
        }
    }

    #[test]
    fn far_and_near_spheres_in_single_precision_agree_with_double() {
        let center = Vec3f::new(1.0, -2.0, 2.0);
        for radius in [2.9, 1.0, 1e-2, 1e-4, 1e-8, 1e-15_f32] {
            let narrow = SeenSphere::<f32>::new(center, radius).unwrap();
            let wide = SeenSphere::<f64>::new(center.as_dvec3(), f64::from(radius)).unwrap();
            let axis = Vec3f::new(1.0, -2.0, 2.0) / 3.0;
            let ratio = f64::from(narrow.pdf(axis)) / wide.pdf(axis.as_dvec3());
            // s² doubles the rounding of s; near s = 1 another factor.
            assert!((ratio - 1.0).abs() < 12.0 * f64::from(f32::EPSILON), "{radius}: {ratio}");
            for u in uniforms::<f32>(200) {
                let got = narrow.from_square(u).unwrap();
                let want = wide.from_square(u.map(f64::from)).unwrap();
                let error = (got.direction.as_dvec3() - want.direction).length();
                assert!(error < 8.0 * f64::from(f32::EPSILON), "{radius} {u:?}: {error:e}");
                let error = (got.normal.as_dvec3() - want.normal).length();
                assert!(error < 32.0 * f64::from(f32::EPSILON), "{radius} {u:?}: {error:e}");
            }
        }
    }

    #[test]
    fn impossible_spheres_are_refused() {
        let new = |distance, radius| SeenSphere::<f32>::new(Vec3f::Z * distance, radius);
        assert_eq!(new(2.0, 0.0), None);
        assert_eq!(new(2.0, -1.0), None);
        assert_eq!(new(2.0, f32::NAN), None);
        assert_eq!(new(f32::NAN, 1.0), None);
        assert_eq!(new(1e30, 1.0), None, "length overflows");
        assert_eq!(new(1e18, 1e-10), None, "solid angle underflows");
        assert!(new(0.0, 1.0).is_some());
    }

    #[test]
    fn a_point_on_the_sphere_does_not_see_itself() {
        let sphere = SeenSphere::<f32>::new(Vec3f::Z, 1.0).unwrap();
        // u₀ → 1 is the pole −z, where the seeing point lies.
        for u in [f32::ONE_MINUS_EPSILON, 0.5, 0.0] {
            if let Some(p) = sphere.from_square([u, 0.0]) {
                assert!(p.direction.is_finite() && p.distance > 0.0);
            }
        }
    }
}
