//! Cylinders.

use etendue_math::glam::{DAffine3, DVec3, Vec3};
use etendue_math::{Frame, Real, Vector3};

use super::sphere::{azimuth, round_point};
use super::surface::LocalSurface;
use super::{Aabb, Ray, ShapeError, ShapeSample, Transform};

/// A cylinder without caps.
///
/// `u` is the azimuth over 2π, `v` runs from 0 at the start to 1 at the end of the axis. The front
/// is outside unless the normals are flipped or the transform mirrors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    start: DVec3,
    /// Orthonormal; `s` points to u = 0, `n` along the axis. Left-handed after mirroring.
    frame: Frame<f64>,
    radius: f64,
    length: f64,
    /// +1 where the front is outside, −1 where it is inside.
    side: f64,
    /// From the cylinder of radius 1 about the z axis from 0 to 1.
    to_world: DAffine3,
}

/// How far a cross-section may be from round, relative: matrices in scene files have six or seven
/// digits.
const TOLERANCE: f64 = 1e-4;

impl Cylinder {
    /// The cylinder about the segment from `p0` to `p1` in local space, placed by a transform.
    ///
    /// # Errors
    /// A radius that is not positive and finite, end points that coincide, a transform under which
    /// the cross-section is no circle or the sides are not upright.
    pub fn new(
        p0: DVec3,
        p1: DVec3,
        radius: f64,
        transform: &Transform,
    ) -> Result<Self, ShapeError> {
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(ShapeError::BadRadius);
        }
        let axis = p1 - p0;
        let local =
            Frame::<f64>::from_normal(Vector3::try_normalize(axis).ok_or(ShapeError::NoAxis)?);
        Self::of_unit(&transform.compose(&Transform::from_affine(DAffine3::from_cols(
            local.s * radius,
            local.t * radius,
            axis,
            p0,
        ))?)?)
    }

    /// The image of the cylinder of radius 1 about the z axis from 0 to 1.
    fn of_unit(to_world: &Transform) -> Result<Self, ShapeError> {
        let m = &to_world.affine().matrix3;
        let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
        let (radius, length) = (Vector3::length(x), Vector3::length(z));
        let round = Real::abs(Vector3::length(y) - radius) <= TOLERANCE * radius
            && Real::abs(x.dot(y)) <= TOLERANCE * radius * radius;
        let upright = Real::abs(x.dot(z)) <= TOLERANCE * radius * length
            && Real::abs(y.dot(z)) <= TOLERANCE * radius * length;
        if !(round && upright) {
            return Err(ShapeError::NonUniformScale);
        }
        let side = if to_world.is_mirrored() { -1.0 } else { 1.0 };
        let n = z / length;
        let s = Vector3::try_normalize(x - n * n.dot(x)).ok_or(ShapeError::NonUniformScale)?;
        Ok(Self {
            start: to_world.affine().translation,
            frame: Frame { s, t: n.cross(s) * side, n },
            radius,
            length,
            side,
            to_world: *to_world.affine(),
        })
    }

    /// The cylinder moved by a transform.
    pub(super) fn transformed(self, transform: &Transform) -> Result<Self, ShapeError> {
        let (unit, is_flipped) = self.placement();
        let moved = Self::of_unit(&transform.compose(&Transform::from_affine(*unit)?)?)?;
        Ok(if is_flipped { moved.flipped() } else { moved })
    }

    /// What places the cylinder of radius 1 about the z axis from 0 to 1, and whether front and back are exchanged.
    pub fn placement(&self) -> (&DAffine3, bool) {
        let is_mirrored = self.to_world.matrix3.determinant() < 0.0;
        (&self.to_world, (self.side < 0.0) != is_mirrored)
    }

    /// The same cylinder with front and back exchanged.
    pub fn flipped(self) -> Self {
        Self { side: -self.side, ..self }
    }

    /// The area of the side, `2 π r l`.
    pub fn area(&self) -> f32 {
        (2.0 * <f64 as Real>::PI * self.radius * self.length) as f32
    }

    pub(crate) fn bounds(&self) -> Aabb {
        let Frame { s, t, n } = self.frame;
        let half = s * s + t * t;
        let half = DVec3::new(Real::sqrt(half.x), Real::sqrt(half.y), Real::sqrt(half.z));
        let half = half * self.radius;
        let end = self.start + n * self.length;
        let (low, high) = (self.start.min(end) - half, self.start.max(end) + half);
        let error = (low.abs().max(high.abs()) * f64::from(f32::EPSILON)).as_vec3();
        Aabb { min: low.as_vec3() - error, max: high.as_vec3() + error }
    }

    /// The points where a line meets the infinite cylinder: `(t, z)` twice, nearer one first, in
    /// `f64`; the perpendicular form of [`Sphere`](super::Sphere) in two dimensions.
    fn roots(&self, ray: &Ray) -> Option<[(f64, f64); 2]> {
        let o = self.frame.to_local(ray.origin.as_dvec3() - self.start);
        let d = self.frame.to_local(ray.direction.as_dvec3());
        let dd = d.x * d.x + d.y * d.y;
        let middle = -(o.x * d.x + o.y * d.y) / dd;
        let (x, y) = (o.x + middle * d.x, o.y + middle * d.y);
        let discriminant = self.radius * self.radius - (x * x + y * y);
        // A ray along the axis divides 0 by 0: NaN is a miss.
        if discriminant < 0.0 || discriminant.is_nan() {
            return None;
        }
        let half = Real::sqrt(discriminant / dd);
        let distance = Real::sqrt(o.x * o.x + o.y * o.y);
        let product = (distance - self.radius) * (distance + self.radius) / dd;
        let (near, far) = if middle > 0.0 {
            let far = middle + half;
            (product / far, far)
        } else {
            let near = middle - half;
            (near, if near == 0.0 { 0.0 } else { product / near })
        };
        Some([near, far].map(|t| (t, o.z + t * d.z)))
    }

    pub(crate) fn intersect(&self, ray: &Ray) -> Option<f32> {
        self.roots(ray)?
            .into_iter()
            .filter(|&(_, z)| z >= 0.0 && z <= self.length)
            .map(|(t, _)| t as f32)
            .find(|&t| t > 0.0 && t < ray.t_max)
    }

    pub(crate) fn surface(&self, ray: &Ray, t: f32) -> LocalSurface {
        let t = f64::from(t);
        let nearest = self.roots(ray).map_or(t, |[(near, _), (far, _)]| {
            if Real::abs(near - t) <= Real::abs(far - t) { near } else { far }
        });
        let hit = ray.origin.as_dvec3() + ray.direction.as_dvec3() * nearest - self.start;
        let local = self.frame.to_local(hit);
        let ring = Real::sqrt(local.x * local.x + local.y * local.y);
        let (cos, sin) = if ring > 0.0 { (local.x / ring, local.y / ring) } else { (1.0, 0.0) };
        self.at(cos, sin, Real::clamp_to(local.z, 0.0, self.length))
    }

    fn at(&self, cos: f64, sin: f64, z: f64) -> LocalSurface {
        let Frame { s, t, n } = self.frame;
        let outward = s * cos + t * sin;
        let exact = self.start + outward * self.radius + n * z;
        let (position, error) = round_point(exact, self.start, self.radius + self.length);
        let normal = (outward * self.side).as_vec3();
        let around = (t * cos - s * sin) * (2.0 * <f64 as Real>::PI * self.radius);
        LocalSurface {
            position,
            error,
            normal,
            shading_normal: normal,
            uv: [
                (azimuth(sin, cos) * 0.5 * <f64 as Real>::FRAC_1_PI) as f32,
                (z / self.length) as f32,
            ],
            tangent: Some(around.as_vec3()),
            primitive: 0,
        }
    }

    /// `∂p/∂u` and `∂p/∂v`.
    pub(crate) fn partials(&self, [u, _]: [f32; 2]) -> [Vec3; 2] {
        let Frame { s, t, n } = self.frame;
        let turn = 2.0 * <f64 as Real>::PI;
        let (sin, cos) = Real::sin_cos(f64::from(u) * turn);
        let around = (t * cos - s * sin) * (turn * self.radius);
        [around.as_vec3(), (n * self.length).as_vec3()]
    }

    pub(crate) fn sample_area(&self, u: [f32; 2]) -> ShapeSample {
        let (sin, cos) = Real::sin_cos(2.0 * <f64 as Real>::PI * f64::from(u[1]));
        let s = self.at(cos, sin, f64::from(u[0]) * self.length);
        ShapeSample {
            position: s.position,
            error: s.error,
            normal: s.normal,
            uv: s.uv,
            pdf_area: 1.0 / self.area(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::glam::Vec3;

    #[test]
    fn rays_pass_through_the_open_ends_and_along_the_axis() {
        let c = Cylinder::new(DVec3::ZERO, DVec3::Z * 2.0, 1.0, &Transform::IDENTITY);
        let c = c.expect("a cylinder");
        assert_eq!(c.intersect(&Ray::new(Vec3::new(0.5, 0.0, -1.0), Vec3::Z)), None);
        assert_eq!(c.intersect(&Ray::new(Vec3::new(3.0, 0.0, 1.0), -Vec3::X)), Some(2.0));
        // In through an open end, out through the wall.
        let slanted = Ray::new(Vec3::new(0.0, 0.0, -0.5), Vec3::new(1.0, 0.0, 1.0));
        assert_eq!(c.intersect(&slanted), Some(1.0));
        let p = c.surface(&slanted, 1.0);
        assert_eq!((p.normal, p.uv), (Vec3::X, [0.0, 0.25]));
        assert_eq!(c.flipped().surface(&slanted, 1.0).normal, -Vec3::X);
    }

    #[test]
    fn oblique_and_elliptic_cylinders_are_refused() {
        let stretch = Transform::scale(DVec3::new(1.0, 2.0, 1.0)).expect("a map");
        let cylinder = |p1, t| Cylinder::new(DVec3::ZERO, p1, 1.0, t).map(|_| ());
        assert_eq!(cylinder(DVec3::Z, &stretch), Err(ShapeError::NonUniformScale));
        assert_eq!(cylinder(DVec3::ONE, &stretch), Err(ShapeError::NonUniformScale));
        assert_eq!(cylinder(DVec3::ZERO, &Transform::IDENTITY), Err(ShapeError::NoAxis));
    }
}
