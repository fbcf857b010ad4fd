//! Directions that hit a triangle, uniform in solid angle.

use etendue_math::{Real, Vec3, Vector3};

use super::{accurate_cross, into_unit};

/// A triangle as a point sees it.
///
/// # Examples
/// ```
/// use etendue_math::glam::Vec3;
/// use etendue_sampling::warp::spherical_triangle::SphericalTriangle;
/// // One octant: an eighth of 4π.
/// let octant = SphericalTriangle::<f32>::new([Vec3::X, Vec3::Y * 2.0, Vec3::Z * 3.0]).unwrap();
/// assert!((octant.solid_angle() - std::f32::consts::FRAC_PI_2).abs() < 1e-6);
/// let w = octant.from_square([0.3, 0.7]);
/// assert!(w.min_element() > 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalTriangle<T: Real> {
    vertices: [Vec3<T>; 3],
    directions: [Vec3<T>; 3],
    /// `|det(v₀, v₁, v₂)|`, `v₂·(v₀ + v₁)` and `1 + v₀·v₁`: tan(Ω/2) = det / (the sum of the
    /// others).
    volume: T,
    across: T,
    base: T,
    solid_angle: T,
}

impl<T: Real> SphericalTriangle<T> {
    /// The triangle with the given vertices relative to the seeing point.
    ///
    /// ```text
    /// tan(Ω/2) = |v₀·((v₁ − v₀) × (v₂ − v₀))| / (1 + v₀·v₁ + v₁·v₂ + v₂·v₀)      vᵢ unit vectors
    /// ```
    ///
    /// `None` where sampling by solid angle does not pay or cannot be trusted, and
    /// [`triangle`](super::triangle) should be used: below √ε sr (3.5e-4 in `f32`), where the
    /// triangle spans about ε^¼ and the rounding of directions would show; above 6.22 sr, where the
    /// point all but lies in the triangle; for vertices at the point, degenerate triangles, NaN and
    /// infinity.
    ///
    /// # Precision
    /// Relative error of Ω about 8 ε at any admitted size, divided by the sines of the angle under
    /// which the triangle's plane is seen and of its own smallest angle: what rounding of the
    /// vertices does anyway. The volume comes from the edges by differences of products.
    ///
    /// # Source
    /// Van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", 1983; upper bound as in
    /// pbrt-v4.
    #[inline]
    pub fn new(vertices: [Vec3<T>; 3]) -> Option<Self> {
        let lengths = vertices.map(Vector3::length);
        let longest = lengths[0].max(lengths[1]).max(lengths[2]);
        if !(longest > T::ZERO && longest.is_finite()) {
            return None;
        }
        // Scaled by the longest so that no product over- or underflows.
        let [a, b, c] = vertices.map(|v| v / longest);
        let lengths = lengths.map(|l| l / longest);
        let normal = accurate_cross(
            (vertices[1] - vertices[0]) / longest,
            (vertices[2] - vertices[0]) / longest,
        );
        let volume = a.dot(normal).abs() / (lengths[0] * lengths[1] * lengths[2]);
        let directions = [a / lengths[0], b / lengths[1], c / lengths[2]];
        let [v0, v1, v2] = directions;
        let sum = v0 + v1;
        // 1 + v₀·v₁ without cancellation for nearly opposite vertices.
        let base = T::HALF * sum.length_squared();
        let across = v2.dot(sum);
        let solid_angle = T::TWO * volume.atan2(base + across);
        // Written so that NaN is refused.
        if solid_angle > T::EPSILON.sqrt() && solid_angle < T::lit(6.22) {
            Some(Self { vertices, directions, volume, across, base, solid_angle })
        } else {
            None
        }
    }

    /// Solid angle Ω in sr.
    #[inline]
    pub fn solid_angle(&self) -> T {
        self.solid_angle
    }

    /// A direction uniform in solid angle within the triangle.
    ///
    /// ```text
    /// v₂' on the arc v₀v₂ such that (v₀, v₁, v₂') has solid angle σ = u₀ Ω: v₀ reflected in
    ///     o = (det cos σ/2 − v₂·(v₀ + v₁) sin σ/2) v₀ + (1 + v₀·v₁) sin σ/2 v₂
    /// w on the arc v₁v₂' with 1 − v₁·w = u₁ (1 − v₁·v₂')
    /// ```
    ///
    /// # Precision
    /// 8 ε for triangles below 1 sr, 16 ε up to 2π.
    ///
    /// # Source
    /// J. Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH 1995, in the form of
    /// C. Peters, "BRDF Importance Sampling for Polygonal Lights", SIGGRAPH 2021, section 4.1,
    /// whose terms do not cancel for small triangles. Departure: `1 − v₁·v₂'` from the difference
    /// of the two vectors.
    #[inline]
    pub fn from_square(&self, [u, v]: [T; 2]) -> Vec3<T> {
        let [v0, v1, v2] = self.directions;
        let (sin, cos) = (T::HALF * u * self.solid_angle).sin_cos();
        let half_way = v0 * (self.volume * cos - self.across * sin) + v2 * (self.base * sin);
        let moved = reflect(v0, half_way);
        // 1 − s and 1 + s of s = v₁·w and of its largest value, v₁·v₂'.
        let one_minus_end = T::HALF * (v1 - moved).length_squared();
        let one_plus_end = T::HALF * (v1 + moved).length_squared();
        let one_minus_s = v * one_minus_end;
        let t = if one_plus_end > T::ZERO {
            (v * (T::TWO - one_minus_s) / one_plus_end).sqrt()
        } else {
            v
        };
        let along_v1 = (T::ONE - one_minus_s) - t * (T::ONE - one_minus_end);
        (v1 * along_v1 + moved * t).try_normalize().unwrap_or(v1)
    }

    /// The uniforms of a direction within the triangle.
    ///
    /// # Precision
    /// Absolute, about `32 ε/√Ω` for well-shaped triangles; u₀ is an angle around v₁ and loses
    /// digits towards it.
    #[inline]
    pub fn to_square(&self, w: Vec3<T>) -> [T; 2] {
        let [v0, v1, v2] = self.directions;
        // The great circle through v₁ and w meets the one through v₀ and v₂.
        let meet = accurate_cross(accurate_cross(v1, w), accurate_cross(v2, v0));
        let meet = if meet.dot(v0 + v2) < T::ZERO { -meet } else { meet };
        let Some(moved) = meet.try_normalize() else { return [T::ZERO; 2] };
        let sum = v0 + v1;
        let volume = v0.dot(accurate_cross(v1 - v0, moved - v0)).abs();
        let part = T::TWO * volume.atan2(self.base + moved.dot(sum));
        let v = (v1 - w).length_squared() / (v1 - moved).length_squared();
        [into_unit(part / self.solid_angle), into_unit(v)]
    }

    /// Density per steradian, `1/Ω`, of every direction that hits the triangle.
    #[inline]
    pub fn pdf(&self) -> T {
        T::ONE / self.solid_angle
    }

    /// Barycentric coordinates of the point that direction `w` hits; limited to the triangle.
    ///
    /// ```text
    /// b₀ ∝ w·(p₁ × p₂),   b₁ ∝ w·(p₂ × p₀),   b₂ ∝ w·(p₀ × p₁)
    /// ```
    #[inline]
    pub fn barycentrics(&self, w: Vec3<T>) -> [T; 3] {
        let [a, b, c] = self.vertices;
        // One common sign for triangles seen from either side.
        let weights =
            [accurate_cross(b, c).dot(w), accurate_cross(c, a).dot(w), accurate_cross(a, b).dot(w)];
        let sign = T::ONE.copysign(weights[0] + weights[1] + weights[2]);
        let weights = weights.map(|x| (x * sign).max(T::ZERO));
        let sum = weights[0] + weights[1] + weights[2];
        weights.map(|x| if sum > T::ZERO { x / sum } else { T::ONE / T::lit(3.0) })
    }
}

/// `v` mirrored in the axis `axis`, which need not be a unit vector; `v` for a zero axis.
#[inline]
fn reflect<V: Vector3>(v: V, axis: V) -> V {
    match axis.try_normalize() {
        Some(axis) => axis * (V::Scalar::TWO * v.dot(axis)) - v,
        None => v,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_density_on_sphere, check_inverse, check_jacobian, uniforms};
    use etendue_math::glam::{DVec3, Vec3 as Vec3f};

    const LARGE: [DVec3; 3] =
        [DVec3::new(1.0, 0.2, 0.1), DVec3::new(-0.5, 2.0, 0.3), DVec3::new(0.1, 0.4, 1.5)];

    /// Inside the three planes through the seeing point and the edges.
    fn hits([a, b, c]: [DVec3; 3], w: DVec3) -> bool {
        let side = a.cross(b).dot(c).signum();
        [a.cross(b), b.cross(c), c.cross(a)].iter().all(|n| n.dot(w) * side >= 0.0)
    }

    #[test]
    fn solid_angles_of_known_triangles() {
        for (vertices, want) in [
            ([DVec3::X, DVec3::Y, DVec3::Z], f64::PI / 2.0),
            // A quarter of the faces of a regular tetrahedron around its centre.
            ([DVec3::ONE, DVec3::new(1.0, -1.0, -1.0), DVec3::new(-1.0, 1.0, -1.0)], f64::PI),
        ] {
            let got = SphericalTriangle::<f64>::new(vertices).unwrap().solid_angle();
            assert!((got / want - 1.0).abs() < 4.0 * f64::EPSILON, "{got} {want}");
        }
    }

    /// Nearly all of a hemisphere, 5.3 sr.
    const WIDE: [DVec3; 3] =
        [DVec3::new(1.0, 0.0, 0.1), DVec3::new(-0.5, 0.9, 0.1), DVec3::new(-0.5, -0.9, 0.1)];
    /// 1.5 long and 0.01 wide.
    const THIN: [DVec3; 3] =
        [DVec3::new(-0.7, 0.5, 1.0), DVec3::new(0.8, 0.5, 1.0), DVec3::new(-0.6, 0.51, 1.0)];

    #[test]
    fn density_is_that_of_the_map() {
        for vertices in [LARGE, WIDE, THIN, [THIN[1], THIN[2], THIN[0]]] {
            let shape = SphericalTriangle::<f64>::new(vertices).unwrap();
            check_jacobian(|u| shape.from_square(u), |_| shape.pdf());
        }
        for vertices in [LARGE, WIDE] {
            let shape = SphericalTriangle::<f64>::new(vertices).unwrap();
            let pdf = |w| if hits(vertices, w) { shape.pdf() } else { 0.0 };
            check_density_on_sphere(|u| shape.from_square(u), pdf);
        }
    }

    #[test]
    fn inverse_undoes_the_map() {
        for vertices in [LARGE, WIDE, THIN] {
            let shape = SphericalTriangle::<f64>::new(vertices).unwrap();
            // u₀ is an angle around v₁, divided by the triangle's own angle there (0.007 of the
            // thin one); a thousand points come as close to v₁ as 0.03.
            check_inverse(|u| shape.from_square(u), |w| shape.to_square(w), 1e-12);
        }
    }

    #[test]
    fn barycentrics_are_those_of_the_point_that_is_hit() {
        for vertices in [LARGE, [LARGE[1], LARGE[0], LARGE[2]]] {
            let shape = SphericalTriangle::<f64>::new(vertices).unwrap();
            for u in uniforms(100) {
                let w = shape.from_square(u);
                let [b0, b1, b2] = shape.barycentrics(w);
                let hit = vertices[0] * b0 + vertices[1] * b1 + vertices[2] * b2;
                // A few roundings at lengths of order 1.
                assert!((hit.normalize() - w).length() < 16.0 * f64::EPSILON);
            }
        }
    }

    #[test]
    fn small_triangles_in_single_precision_agree_with_double() {
        let corner = Vec3f::new(1.5, 1.0, 0.5);
        for size in [1.0, 0.5, 0.25, 0.125, 0.09_f32] {
            let narrow = [
                corner,
                corner + Vec3f::new(-0.4, 0.7, 0.1) * size,
                corner + Vec3f::new(0.1, 0.3, 0.9) * size,
            ];
            let wide = SphericalTriangle::<f64>::new(narrow.map(Vec3f::as_dvec3)).unwrap();
            let narrow = SphericalTriangle::<f32>::new(narrow).unwrap();
            let ratio = f64::from(narrow.solid_angle()) / wide.solid_angle();
            assert!((ratio - 1.0).abs() < 8.0 * f64::from(f32::EPSILON), "{size}: {ratio}");
            for u in uniforms::<f32>(200) {
                let got = narrow.from_square(u).as_dvec3();
                let want = wide.from_square(u.map(f64::from));
                let error = (got - want).length();
                assert!(error < 8.0 * f64::from(f32::EPSILON), "{size} {u:?}: {error:e}");
            }
        }
    }

    #[test]
    fn triangles_that_cannot_be_trusted_are_refused() {
        let new = SphericalTriangle::<f32>::new;
        let far = Vec3f::new(0.0, 0.0, 1e3);
        assert_eq!(new([far, far + Vec3f::X, far + Vec3f::Y]), None, "5e-7 sr");
        assert_eq!(new([Vec3f::ZERO, Vec3f::X, Vec3f::Y]), None, "vertex at the point");
        assert_eq!(new([Vec3f::X, Vec3f::Y, Vec3f::new(-1.0, -1.0, 0.0)]), None, "2π");
        assert_eq!(new([Vec3f::X, Vec3f::X * 2.0, Vec3f::Y]), None, "seen edge on");
        assert_eq!(new([Vec3f::X, Vec3f::NAN, Vec3f::Y]), None);
        assert_eq!(new([Vec3f::X, Vec3f::INFINITY, Vec3f::Y]), None);
    }

    #[test]
    fn scale_does_not_matter() {
        let reference = SphericalTriangle::<f32>::new(LARGE.map(DVec3::as_vec3)).unwrap();
        for scale in [1e-18_f32, 1e18] {
            let scaled = LARGE.map(|v| v.as_vec3() * scale);
            let got = SphericalTriangle::<f32>::new(scaled).unwrap();
            let ratio = got.solid_angle() / reference.solid_angle();
            // The vertices are rounded again by the scaling.
            assert!((ratio - 1.0).abs() < 8.0 * f32::EPSILON, "{scale}: {ratio}");
        }
    }
}
