//! Directions that hit a rectangle, uniform in solid angle.

use etendue_math::{Real, Vec3, Vector3};

use super::into_unit;
use super::rectangle::Rectangle;

/// A rectangle as a point sees it, in the frame of the rectangle's edges.
///
/// # Examples
/// ```
/// use etendue_math::glam::Vec3;
/// use etendue_sampling::warp::{rectangle::Rectangle, spherical_rectangle::SphericalRectangle};
/// // A face of the cube around the point: a sixth of 4π.
/// let edges = [Vec3::X * 2.0, Vec3::Y * 2.0];
/// let face = Rectangle { corner: Vec3::new(-1.0, -1.0, 1.0), edges };
/// let seen = SphericalRectangle::<f32>::new(face).unwrap();
/// assert!((seen.solid_angle() - 4.0 / 6.0 * std::f32::consts::PI).abs() < 1e-6);
/// assert!(seen.from_square([0.2, 0.9]).z > 0.5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalRectangle<T: Real> {
    axes: [Vec3<T>; 3],
    /// Extent along the first and the second axis, distance of the plane along the third.
    x: [T; 2],
    y: [T; 2],
    z: T,
    /// Cosines between the third axis and the inward normals of the planes through the point and
    /// the edges at y₀ and y₁, and their sum.
    normals: [T; 2],
    normal_sum: T,
    /// `asin(n₀ c₀) + asin(n₁ c₀)`, the angle at which the sweep along x starts.
    start: T,
    solid_angle: T,
}

impl<T: Real> SphericalRectangle<T> {
    /// The rectangle seen from the origin: its corner is relative to the seeing point.
    ///
    /// `None` where [`Rectangle`]'s own map should be used: below √ε sr (3.5e-4 in `f32`), where
    /// the rectangle may be as narrow as the rounding of directions; above 6.22 sr or with the
    /// point in the rectangle's plane; for edges that are not at right angles (to 1e-3), degenerate
    /// rectangles, NaN and infinity.
    ///
    /// # Source
    /// Ureña, Fajardo and King, "An Area-Preserving Parametrization for Spherical Rectangles",
    /// EGSR 2013.
    #[inline]
    pub fn new(rectangle: Rectangle<T>) -> Option<Self> {
        let [width, height] = rectangle.edges.map(Vector3::length);
        let x_axis = rectangle.edges[0].try_normalize()?;
        let y_axis = rectangle.edges[1].try_normalize()?;
        let normal = x_axis.cross(y_axis).try_normalize()?;
        let distance = rectangle.corner.dot(normal);
        let z = distance.abs();
        let (x0, y0) = (rectangle.corner.dot(x_axis), rectangle.corner.dot(y_axis));
        let (x, y) = ([x0, x0 + width], [y0, y0 + height]);
        let solid_angle = solid_angle(x0, width, y0, height, z);
        // Written so that NaN is refused.
        let right_angle = x_axis.dot(y_axis).abs() <= T::lit(1e-3);
        let usable = solid_angle > T::EPSILON.sqrt() && solid_angle < T::lit(6.22);
        if !(right_angle && usable) {
            return None;
        }
        let (h0, h1) = (hypot(z, y[0]), hypot(z, y[1]));
        let normals = [-y[0] / h0, y[1] / h1];
        let normal_sum = if y[0] * y[1] > T::ZERO {
            // y₁/h₁ − y₀/h₀ over the common denominator, without cancellation.
            (z / h0) * (z / h1) * height * (y[0] + y[1]) / (y[1] * h0 + y[0] * h1)
        } else {
            normals[0] + normals[1]
        };
        let start = sum_of_arc_sines(normals, normal_sum, x0 / hypot(z, x0));
        let axes = [x_axis, y_axis, normal * T::ONE.copysign(distance)];
        Some(Self { axes, x, y, z, normals, normal_sum, start, solid_angle })
    }

    /// Solid angle Ω in sr.
    ///
    /// ```text
    /// tan(Ωᵢ/2) = z·w·h / (|a||b||c| + (a·b)|c| + (b·c)|a| + (c·a)|b|),   Ω = Ω₁ + Ω₂
    /// ```
    ///
    /// # Precision
    /// Relative error about 10 ε. Departure from Ureña's sum of four inner angles minus 2π, which
    /// cancels for small rectangles.
    #[inline]
    pub fn solid_angle(&self) -> T {
        self.solid_angle
    }

    /// A direction uniform in solid angle within the rectangle.
    ///
    /// ```text
    /// φ = asin(n₀ c₀) + asin(n₁ c₀) + u₀ Ω       nᵢ = ∓yᵢ/√(z² + yᵢ²), c = x/√(z² + x²)
    /// c = sin φ / √((n₀ + n₁)² − 4 n₀ n₁ sin²(φ/2)),   x = z c/√(1 − c²)
    /// y/√(x² + y² + z²) uniform between its values at y₀ and y₁
    /// ```
    ///
    /// # Precision
    /// 16 ε of a unit vector where the direction is not at grazing incidence to the plane
    /// (|x|, |y| ≤ 3 z); beyond, the error grows as `(|x|/z)²` but stays within the rectangle.
    ///
    /// # Source
    /// Ureña et al. 2013, section 4. Departure: inner angles by arc sines instead of arc cosines,
    /// so that the 2π of their sum drops out before anything is rounded, and the square root in the
    /// form whose terms have one sign.
    #[inline]
    pub fn from_square(&self, [u, v]: [T; 2]) -> Vec3<T> {
        let [n0, n1] = self.normals;
        let phi = self.start + u * self.solid_angle;
        let half_sin = (T::HALF * phi).sin();
        let squared = self.normal_sum.sqr() - T::lit(4.0) * n0 * n1 * half_sin.sqr();
        let c = phi.sin() / squared.safe_sqrt();
        let one_minus_squared = (T::ONE - c) * (T::ONE + c);
        let x = (self.z * c / one_minus_squared.safe_sqrt()).clamp_to(self.x[0], self.x[1]);
        let distance = hypot(x, self.z);
        let [low, high] = self.y.map(|y| y / hypot(distance, y));
        let s = low + v * (high - low);
        let y = distance * s / ((T::ONE - s) * (T::ONE + s)).safe_sqrt();
        let y = y.clamp_to(self.y[0], self.y[1]);
        let [x_axis, y_axis, z_axis] = self.axes;
        // z > 0 by construction: the length never vanishes.
        let w = x_axis * x + y_axis * y + z_axis * self.z;
        w / w.length()
    }

    /// The uniforms of a direction within the rectangle.
    ///
    /// # Precision
    /// Absolute, at most about `64 ε` over the smaller angular extent.
    #[inline]
    pub fn to_square(&self, w: Vec3<T>) -> [T; 2] {
        let [x, y] = self.hit(w);
        let height = self.y[1] - self.y[0];
        let part = solid_angle(self.x[0], x - self.x[0], self.y[0], height, self.z);
        let distance = hypot(x, self.z);
        let [low, s, high] = [self.y[0], y, self.y[1]].map(|y| y / hypot(distance, y));
        [into_unit(part / self.solid_angle), into_unit((s - low) / (high - low))]
    }

    /// Density per steradian, `1/Ω`, of every direction that hits the rectangle.
    #[inline]
    pub fn pdf(&self) -> T {
        T::ONE / self.solid_angle
    }

    /// Where direction `w` hits the rectangle, as coordinates in `[0, 1]` along its two edges.
    #[inline]
    pub fn coordinates(&self, w: Vec3<T>) -> [T; 2] {
        let [x, y] = self.hit(w);
        [(x - self.x[0]) / (self.x[1] - self.x[0]), (y - self.y[0]) / (self.y[1] - self.y[0])]
    }

    /// The point of the rectangle's plane that `w` hits, in the frame, limited to the rectangle.
    #[inline]
    fn hit(&self, w: Vec3<T>) -> [T; 2] {
        let [wx, wy, wz] = self.axes.map(|axis| axis.dot(w));
        [
            (wx / wz * self.z).clamp_to(self.x[0], self.x[1]),
            (wy / wz * self.z).clamp_to(self.y[0], self.y[1]),
        ]
    }
}

#[inline]
fn hypot<T: Real>(a: T, b: T) -> T {
    (a * a + b * b).sqrt()
}

/// `asin(n₀ c) + asin(n₁ c)` given `n₀ + n₁`, without cancellation where the two have opposite
/// signs.
#[inline]
fn sum_of_arc_sines<T: Real>([n0, n1]: [T; 2], sum: T, c: T) -> T {
    let (a, b) = (n0 * c, n1 * c);
    if n0 * n1 < T::ZERO {
        let cos_a = ((T::ONE - a) * (T::ONE + a)).safe_sqrt();
        let cos_b = ((T::ONE - b) * (T::ONE + b)).safe_sqrt();
        // sin(α + β), its two terms turned into a difference of squares.
        (c * sum * (n0 - n1) / (n0 * cos_b - n1 * cos_a)).asin()
    } else {
        a.asin() + b.asin()
    }
}

/// Solid angle of the rectangle `[x, x + width] × [y, y + height]` at height `z`.
#[inline]
fn solid_angle<T: Real>(x: T, width: T, y: T, height: T, z: T) -> T {
    let corner = |x, y| {
        let v = Vec3::<T>::new(x, y, z);
        let length = v.length();
        (v / length, length)
    };
    let (x1, y1) = (x + width, y + height);
    let ((a, la), (b, lb), (c, lc), (d, ld)) =
        (corner(x, y), corner(x1, y), corner(x1, y1), corner(x, y1));
    let (ab, bc, ca, cd, da) = (a.dot(b), b.dot(c), c.dot(a), c.dot(d), d.dot(a));
    let volume = (z / la) * (width / lc);
    let first = (volume * (height / lb)).atan2(T::ONE + ab + bc + ca);
    let second = (volume * (height / ld)).atan2(T::ONE + ca + cd + da);
    T::TWO * (first + second)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{check_density_on_sphere, check_inverse, check_jacobian, uniforms};
    use etendue_math::glam::{DVec3, Vec3 as Vec3f};

    const ABOVE: Rectangle<f64> = Rectangle {
        corner: DVec3::new(-0.5, 0.4, 1.0),
        edges: [DVec3::new(2.0, 0.0, 0.0), DVec3::new(0.0, 1.2, 0.9)],
    };
    const AROUND: Rectangle<f64> = Rectangle {
        corner: DVec3::new(-1.0, -1.0, -0.5),
        edges: [DVec3::new(0.0, 2.5, 0.0), DVec3::new(2.2, 0.0, 0.0)],
    };

    fn hits(rectangle: Rectangle<f64>, w: DVec3) -> bool {
        let n = rectangle.edges[0].cross(rectangle.edges[1]);
        let t = rectangle.corner.dot(n) / w.dot(n);
        let p = w * t - rectangle.corner;
        let inside = |e: DVec3| (0.0..=e.length_squared()).contains(&p.dot(e));
        t > 0.0 && inside(rectangle.edges[0]) && inside(rectangle.edges[1])
    }

    #[test]
    fn density_is_that_of_the_map() {
        for rectangle in [ABOVE, AROUND] {
            let seen = SphericalRectangle::<f64>::new(rectangle).unwrap();
            check_jacobian(|u| seen.from_square(u), |_| seen.pdf());
            let pdf = |w| if hits(rectangle, w) { seen.pdf() } else { 0.0 };
            check_density_on_sphere(|u| seen.from_square(u), pdf);
        }
    }

    #[test]
    fn inverse_undoes_the_map() {
        for rectangle in [ABOVE, AROUND] {
            let seen = SphericalRectangle::<f64>::new(rectangle).unwrap();
            // A dozen roundings, over extents of order 1.
            check_inverse(|u| seen.from_square(u), |w| seen.to_square(w), 64.0 * f64::EPSILON);
        }
    }

    #[test]
    fn coordinates_lead_to_the_point_that_is_hit() {
        let seen = SphericalRectangle::<f64>::new(ABOVE).unwrap();
        for u in uniforms(100) {
            let w = seen.from_square(u);
            let hit = ABOVE.from_square(seen.coordinates(w));
            // A few roundings at lengths of order 1.
            assert!((hit.normalize() - w).length() < 16.0 * f64::EPSILON);
        }
    }

    #[test]
    fn small_rectangles_in_single_precision_agree_with_double() {
        for (x, y) in [(-0.3, -0.2), (0.5, 0.25), (-2.0, 1.0), (1.0, 2.5_f32)] {
            for (width, height) in [(1.0, 0.5), (0.05, 1.0), (1.0, 0.05), (0.1, 0.1_f32)] {
                let corner = Vec3f::new(x, y, 1.0);
                let edges = [Vec3f::X * width, Vec3f::Y * height];
                let narrow = SphericalRectangle::<f32>::new(Rectangle { corner, edges }).unwrap();
                let wide = SphericalRectangle::<f64>::new(Rectangle {
                    corner: corner.as_dvec3(),
                    edges: edges.map(Vec3f::as_dvec3),
                });
                let wide = wide.unwrap();
                let ratio = f64::from(narrow.solid_angle()) / wide.solid_angle();
                assert!((ratio - 1.0).abs() < 8.0 * f64::from(f32::EPSILON), "{x} {y}: {ratio}");
                for u in uniforms::<f32>(100) {
                    let got = narrow.from_square(u).as_dvec3();
                    let error = (got - wide.from_square(u.map(f64::from))).length();
                    let bound = 16.0 * f64::from(f32::EPSILON);
                    assert!(error < bound, "{x} {y} {width} {height} {u:?}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn rectangles_that_cannot_be_trusted_are_refused() {
        let new = |corner, edges| SphericalRectangle::<f32>::new(Rectangle { corner, edges });
        let square = [Vec3f::X, Vec3f::Y];
        assert_eq!(new(Vec3f::Z * 1e3, square), None, "1e-6 sr");
        assert_eq!(new(Vec3f::new(1.0, 1.0, 0.0), square), None, "seen edge on");
        assert_eq!(new(Vec3f::new(-0.5, -0.5, 0.0), square), None, "point in the rectangle");
        assert_eq!(new(Vec3f::Z, [Vec3f::X, Vec3f::ONE]), None, "oblique");
        assert_eq!(new(Vec3f::Z, [Vec3f::X, Vec3f::ZERO]), None, "no area");
        assert_eq!(new(Vec3f::NAN, square), None);
        assert_eq!(new(Vec3f::INFINITY, square), None);
    }
}
