//! Affine maps.

use etendue_math::Real;
use etendue_math::glam::{DAffine3, DMat3, DVec3, Mat3, Vec3};

use super::{Aabb, Ray};

/// An invertible affine map and its inverse, both computed in `f64` and then rounded.
///
/// # Examples
/// ```
/// use etendue_math::glam::{DVec3, Vec3};
/// use etendue_scene::geometry::Transform;
/// let lift = Transform::translate(DVec3::new(0.0, 0.0, 1.0))?;
/// let grow = Transform::scale(DVec3::splat(2.0))?;
/// // The right-hand map acts first.
/// assert_eq!(lift.compose(&grow)?.point(Vec3::ONE), Vec3::new(2.0, 2.0, 3.0));
/// # Ok::<(), etendue_scene::geometry::TransformError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    exact: DAffine3,
    exact_inverse: DAffine3,
    forward: Affine,
    inverse: Affine,
}

/// One direction of a transform, in the renderer's precision.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Affine {
    linear: Mat3,
    offset: Vec3,
}

/// Why a transform is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TransformError {
    /// An entry is NaN or infinite, or too large for `f32`.
    #[error("the transform has an entry that is not finite")]
    NotFinite,
    /// The map flattens space and has no inverse.
    #[error("the transform is singular: it maps space onto a plane, a line or a point")]
    Singular,
    /// The last row of the matrix is not (0, 0, 0, 1).
    #[error("the last row of the matrix is not 0 0 0 1")]
    NotAffine,
    /// A rotation about the zero vector.
    #[error("the axis of rotation is zero")]
    ZeroAxis,
    /// The camera looks at the point where it stands.
    #[error("origin and target coincide")]
    TargetAtOrigin,
    /// The up direction is zero or along the view direction.
    #[error("the up vector is parallel to the view direction")]
    UpAlongView,
}

impl Affine {
    fn round(exact: &DAffine3) -> Self {
        Self { linear: exact.matrix3.as_mat3(), offset: exact.translation.as_vec3() }
    }

    fn is_finite(&self) -> bool {
        self.linear.is_finite() && self.offset.is_finite()
    }

    #[inline]
    fn point(&self, p: Vec3) -> Vec3 {
        self.linear * p + self.offset
    }

    /// Bound on the rounding error of [`point`](Self::point), the entries' own included:
    /// `γ(5) (|M| |p| + |b|) + |M| δ`.
    fn point_error(&self, p: Vec3, error: Vec3) -> Vec3 {
        // Entry, product, two sums, translation: five roundings of 2⁻²⁴ each.
        const GAMMA_5: f32 = 5.0 * 0.5 * f32::EPSILON * (1.0 + 1e-6);
        let magnitude = Mat3::from_cols(
            self.linear.x_axis.abs(),
            self.linear.y_axis.abs(),
            self.linear.z_axis.abs(),
        );
        (magnitude * p.abs() + self.offset.abs()) * GAMMA_5 + magnitude * error * (1.0 + 1e-6)
    }
}

impl Transform {
    /// The map that changes nothing.
    pub const IDENTITY: Self = Self {
        exact: DAffine3::IDENTITY,
        exact_inverse: DAffine3::IDENTITY,
        forward: Affine { linear: Mat3::IDENTITY, offset: Vec3::ZERO },
        inverse: Affine { linear: Mat3::IDENTITY, offset: Vec3::ZERO },
    };

    /// From its linear part and translation.
    ///
    /// # Errors
    /// An entry that is not finite in `f32`, or a linear part without inverse.
    pub fn from_affine(exact: DAffine3) -> Result<Self, TransformError> {
        let forward = Affine::round(&exact);
        if !exact.is_finite() || !forward.is_finite() {
            return Err(TransformError::NotFinite);
        }
        // The determinant relative to the product of the column lengths tells flat from small.
        let m = &exact.matrix3;
        let volume = length(m.x_axis) * length(m.y_axis) * length(m.z_axis);
        if m.determinant().abs() <= 1e-14 * volume {
            return Err(TransformError::Singular);
        }
        let exact_inverse = exact.inverse();
        let inverse = Affine::round(&exact_inverse);
        if !inverse.is_finite() {
            return Err(TransformError::Singular);
        }
        Ok(Self { exact, exact_inverse, forward, inverse })
    }

    /// A map that is known to have an inverse, up to rounding; rays through one that has none hit nothing.
    #[inline]
    pub(super) fn of_pose(exact: DAffine3) -> Self {
        let exact_inverse = exact.inverse();
        let (forward, inverse) = (Affine::round(&exact), Affine::round(&exact_inverse));
        Self { exact, exact_inverse, forward, inverse }
    }

    /// From a 4 × 4 matrix, row by row.
    ///
    /// # Errors
    /// As [`from_affine`](Self::from_affine), or a last row other than 0 0 0 1.
    pub fn from_rows(rows: [[f64; 4]; 4]) -> Result<Self, TransformError> {
        if rows.iter().flatten().any(|x| !x.is_finite()) {
            return Err(TransformError::NotFinite);
        }
        if rows[3] != [0.0, 0.0, 0.0, 1.0] {
            return Err(TransformError::NotAffine);
        }
        let column = |j: usize| DVec3::new(rows[0][j], rows[1][j], rows[2][j]);
        Self::from_affine(DAffine3::from_cols(column(0), column(1), column(2), column(3)))
    }

    /// A translation.
    ///
    /// # Errors
    /// A component that is not finite in `f32`.
    pub fn translate(by: DVec3) -> Result<Self, TransformError> {
        Self::from_affine(DAffine3 { matrix3: DMat3::IDENTITY, translation: by })
    }

    /// A scaling about the origin; negative factors mirror.
    ///
    /// # Errors
    /// A factor that is 0 or not finite.
    pub fn scale(by: DVec3) -> Result<Self, TransformError> {
        Self::from_affine(DAffine3 { matrix3: DMat3::from_diagonal(by), translation: DVec3::ZERO })
    }

    /// The rotation about an axis through the origin, anticlockwise as seen from the axis' tip.
    ///
    /// # Errors
    /// A zero axis, or anything that is not finite.
    ///
    /// # Source
    /// Rodrigues: `R = cos φ I + (1 − cos φ) a aᵀ + sin φ [a]×`.
    pub fn rotate(axis: DVec3, degrees: f64) -> Result<Self, TransformError> {
        if !axis.is_finite() || !degrees.is_finite() {
            return Err(TransformError::NotFinite);
        }
        let a = unit(axis).ok_or(TransformError::ZeroAxis)?;
        let (sin, cos) = Real::sin_cos(degrees.to_radians());
        let column = |e: DVec3| e * cos + a * (a.dot(e) * (1.0 - cos)) + a.cross(e) * sin;
        Self::from_affine(DAffine3 {
            matrix3: DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z)),
            translation: DVec3::ZERO,
        })
    }

    /// A frame at `origin` whose +z points at `target` and whose +y lies on the side of `up`:
    ///
    /// ```text
    /// z = normalize(target − origin),  x = normalize(up × z),  y = z × x
    /// ```
    ///
    /// # Errors
    /// Origin and target that coincide, an up vector that is zero or parallel to the view.
    pub fn look_at(origin: DVec3, target: DVec3, up: DVec3) -> Result<Self, TransformError> {
        if !(origin.is_finite() && target.is_finite() && up.is_finite()) {
            return Err(TransformError::NotFinite);
        }
        let z = unit(target - origin).ok_or(TransformError::TargetAtOrigin)?;
        let side = unit(up).ok_or(TransformError::UpAlongView)?.cross(z);
        // Two unit vectors: what is left below 1e-10 is the rounding of their components.
        if length(side) < 1e-10 {
            return Err(TransformError::UpAlongView);
        }
        let x = unit(side).ok_or(TransformError::UpAlongView)?;
        Self::from_affine(DAffine3::from_cols(x, z.cross(x), z, origin))
    }

    /// The map that applies `first` and then `self`.
    ///
    /// # Errors
    /// A product that overflows or is singular.
    pub fn compose(&self, first: &Self) -> Result<Self, TransformError> {
        Self::from_affine(self.exact * first.exact)
    }

    /// The opposite map.
    pub fn inverse(&self) -> Self {
        Self {
            exact: self.exact_inverse,
            exact_inverse: self.exact,
            forward: self.inverse,
            inverse: self.forward,
        }
    }

    /// The map in `f64`.
    pub fn affine(&self) -> &DAffine3 {
        &self.exact
    }

    /// The opposite map in `f64`.
    pub(crate) fn inverse_affine(&self) -> &DAffine3 {
        &self.exact_inverse
    }

    /// Whether it turns right-handed frames into left-handed ones.
    pub fn is_mirrored(&self) -> bool {
        self.exact.matrix3.determinant() < 0.0
    }

    /// A point.
    #[inline]
    pub fn point(&self, p: Vec3) -> Vec3 {
        self.forward.point(p)
    }

    /// A point by the opposite map.
    #[inline]
    pub fn inverse_point(&self, p: Vec3) -> Vec3 {
        self.inverse.point(p)
    }

    /// A vector: the translation does not act.
    #[inline]
    pub fn vector(&self, v: Vec3) -> Vec3 {
        self.forward.linear * v
    }

    /// A vector by the opposite map.
    #[inline]
    pub fn inverse_vector(&self, v: Vec3) -> Vec3 {
        self.inverse.linear * v
    }

    /// A normal, by the transposed inverse, of unit length; zero stays zero.
    ///
    /// Mirroring does not turn it inside out: outward normals stay outward.
    #[inline]
    pub fn normal(&self, n: Vec3) -> Vec3 {
        let m = &self.inverse.linear;
        unit_or_zero(Vec3::new(m.x_axis.dot(n), m.y_axis.dot(n), m.z_axis.dot(n)))
    }

    /// A ray; `t` keeps its meaning because the direction is not normalised again.
    #[inline]
    pub fn ray(&self, ray: &Ray) -> Ray {
        Ray {
            origin: self.point(ray.origin),
            direction: self.vector(ray.direction),
            t_max: ray.t_max,
        }
    }

    /// A ray by the opposite map.
    #[inline]
    pub fn inverse_ray(&self, ray: &Ray) -> Ray {
        Ray {
            origin: self.inverse_point(ray.origin),
            direction: self.inverse_vector(ray.direction),
            t_max: ray.t_max,
        }
    }

    /// A box that holds the image of a box.
    pub fn aabb(&self, b: &Aabb) -> Aabb {
        if b.is_empty() {
            return Aabb::EMPTY;
        }
        let image = Aabb::from_points(b.corners().map(|p| self.point(p)));
        let corner = b.min.abs().max(b.max.abs());
        let error = self.round_trip_error(corner, Vec3::ZERO, self.point(corner));
        Aabb { min: image.min - error, max: image.max + error }
    }

    /// Bound on the distance, axis by axis, between the image of `p ± error` and the computed
    /// `image`, plus what the way back would add, seen on this side:
    ///
    /// ```text
    /// γ(5) (|M| |p| + |b|) + |M| (δ + γ(5) (|M⁻¹| |image| + |M⁻¹ b|))
    /// ```
    ///
    /// A ray that starts this far from an instance's surface also starts on the right side of it
    /// after it has been brought back into the instance's own coordinates.
    ///
    /// # Source
    /// Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., section 6.8; the way back
    /// is ours.
    pub(crate) fn round_trip_error(&self, p: Vec3, error: Vec3, image: Vec3) -> Vec3 {
        let back = self.inverse.point_error(image, Vec3::ZERO);
        self.forward.point_error(p, error + back)
    }
}

/// Length of a vector; glam's own goes through a slow square root without `std`.
fn length(v: DVec3) -> f64 {
    Real::sqrt(v.dot(v))
}

fn unit(v: DVec3) -> Option<DVec3> {
    // Scaled by the largest component first: squares of tiny or huge numbers leave the range.
    let scale = v.abs().max_element();
    (scale > 0.0 && scale.is_finite()).then(|| {
        let v = v / scale;
        v / length(v)
    })
}

/// The unit vector along `v`; zero for the zero vector.
pub(crate) fn unit_or_zero(v: Vec3) -> Vec3 {
    unit(v.as_dvec3()).map_or(Vec3::ZERO, DVec3::as_vec3)
}

/// Whether a vector is a unit vector up to the rounding of its components, half a unit in the last place each: by at most
/// 2 √3 2⁻²⁵ in the square of its length.
pub(crate) fn is_unit(v: Vec3) -> bool {
    let v = v.as_dvec3();
    Real::abs(v.dot(v) - 1.0) <= f64::from(f32::EPSILON)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forward_and_inverse_cancel_within_their_error_bound() {
        let t = Transform::rotate(DVec3::new(1.0, 2.0, 3.0), 37.0)
            .and_then(|r| r.compose(&Transform::scale(DVec3::new(0.1, 20.0, -3.0))?))
            .and_then(|m| Transform::translate(DVec3::new(5.0, -6.0, 7.0))?.compose(&m))
            .expect("an invertible map");
        assert!(t.is_mirrored());
        for p in [Vec3::ZERO, Vec3::ONE, Vec3::new(-3.0, 0.2, 8.0)] {
            let image = t.point(p);
            let back = t.point(t.inverse_point(image));
            let bound = t.round_trip_error(p, Vec3::ZERO, image);
            assert!((back - image).abs().cmple(bound).all(), "{back} {image} {bound}");
        }
    }

    #[test]
    fn normals_stay_orthogonal_to_tangents() {
        let t = Transform::scale(DVec3::new(1.0, 4.0, -2.0)).expect("an invertible map");
        let (n, s) = (Vec3::new(1.0, 1.0, 0.0), Vec3::new(1.0, -1.0, 0.0));
        // Exact products, one rounding in the unit length: 4 ε of the tangent's length.
        assert!(t.normal(n).dot(t.vector(s)).abs() < 2e-6);
    }

    #[test]
    fn rotation_is_anticlockwise_and_looking_puts_z_on_the_target() {
        let r = Transform::rotate(DVec3::Z, 90.0).expect("an invertible map");
        assert!((r.point(Vec3::X) - Vec3::Y).length() < 1e-7); // one rounding of each entry
        let c =
            Transform::look_at(DVec3::new(0.0, 0.0, 5.0), DVec3::ZERO, DVec3::Y).expect("a view");
        assert_eq!(c.vector(Vec3::Z), -Vec3::Z);
        assert_eq!(c.vector(Vec3::Y), Vec3::Y);
        // up × z: the image is seen mirrored, which the camera undoes.
        assert_eq!(c.vector(Vec3::X), -Vec3::X);
    }

    #[test]
    fn maps_without_inverse_are_refused() {
        use TransformError as E;
        assert_eq!(Transform::scale(DVec3::new(1.0, 0.0, 1.0)), Err(E::Singular));
        assert_eq!(Transform::scale(DVec3::splat(f64::NAN)), Err(E::NotFinite));
        assert_eq!(Transform::translate(DVec3::splat(1e300)), Err(E::NotFinite));
        assert_eq!(Transform::rotate(DVec3::ZERO, 10.0), Err(E::ZeroAxis));
        assert_eq!(Transform::look_at(DVec3::X, DVec3::X, DVec3::Y), Err(E::TargetAtOrigin));
        assert_eq!(Transform::look_at(DVec3::ZERO, DVec3::Y, DVec3::Y * -3.0), Err(E::UpAlongView));
        let mut rows = [[1.0, 2.0, 3.0, 0.0], [2.0, 4.0, 6.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0; 4]];
        assert_eq!(Transform::from_rows(rows), Err(E::NotAffine));
        rows[3][3] = 1.0;
        assert_eq!(Transform::from_rows(rows), Err(E::Singular));
    }

    #[test]
    fn small_but_regular_maps_are_accepted() {
        assert!(Transform::scale(DVec3::splat(1e-9)).is_ok());
    }
}
