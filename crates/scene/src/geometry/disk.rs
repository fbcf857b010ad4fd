//! Disks.

use etendue_math::glam::{DAffine3, DVec3, Vec3};
use etendue_math::{Real, Vector3};
use etendue_sampling::warp::disk;

use super::sphere::{azimuth, round_point};
use super::surface::LocalSurface;
use super::{Aabb, Ray, ShapeError, ShapeSample, Transform};

/// The unit disk in the plane z = 0, placed by a transform that may stretch it to an ellipse.
///
/// The front is on the side of +z. `u` is the distance from the centre, `v` the azimuth over 2π.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disk {
    to_world: Transform,
    normal: Vec3,
}

impl Disk {
    /// The disk placed by a transform.
    pub fn new(transform: &Transform) -> Self {
        Self { to_world: *transform, normal: transform.normal(Vec3::Z) }
    }

    /// The same disk with front and back exchanged.
    pub fn flipped(self) -> Self {
        Self { normal: -self.normal, ..self }
    }

    /// The disk moved by a transform.
    pub(super) fn transformed(self, transform: &Transform) -> Result<Self, ShapeError> {
        let to_world = transform.compose(&self.to_world)?;
        Ok(Self { to_world, normal: transform.normal(self.normal) })
    }

    /// The area, `π |∂p/∂x × ∂p/∂y|`.
    pub fn area(&self) -> f32 {
        let m = &self.to_world.affine().matrix3;
        (<f64 as Real>::PI * Vector3::length(m.x_axis.cross(m.y_axis))) as f32
    }

    /// What places the unit disk, and whether front and back are exchanged.
    pub fn placement(&self) -> (&DAffine3, bool) {
        (self.to_world.affine(), self.normal.dot(self.to_world.normal(Vec3::Z)) < 0.0)
    }

    pub(crate) fn bounds(&self) -> Aabb {
        let m = &self.to_world.affine().matrix3;
        let center = self.to_world.affine().translation;
        // The extent of an ellipse along an axis: √(a² + b²) of its conjugate half-diameters.
        let half = m.x_axis * m.x_axis + m.y_axis * m.y_axis;
        let half = DVec3::new(Real::sqrt(half.x), Real::sqrt(half.y), Real::sqrt(half.z));
        let error = ((center.abs() + half) * f64::from(f32::EPSILON)).as_vec3();
        Aabb { min: (center - half).as_vec3() - error, max: (center + half).as_vec3() + error }
    }

    /// `t` and the local coordinates where a line meets the plane, in `f64`.
    fn plane(&self, ray: &Ray) -> (f64, f64, f64) {
        let inverse = self.to_world.inverse_affine();
        let o = inverse.transform_point3(ray.origin.as_dvec3());
        let d = inverse.transform_vector3(ray.direction.as_dvec3());
        let t = -o.z / d.z;
        (t, o.x + t * d.x, o.y + t * d.y)
    }

    pub(crate) fn intersect(&self, ray: &Ray) -> Option<f32> {
        let (t, x, y) = self.plane(ray);
        let t = t as f32;
        // A ray in the plane gives NaN or infinity, which no comparison lets pass.
        (x * x + y * y <= 1.0 && t > 0.0 && t < ray.t_max).then_some(t)
    }

    pub(crate) fn surface(&self, ray: &Ray) -> LocalSurface {
        let (_, x, y) = self.plane(ray);
        self.at(x, y)
    }

    fn at(&self, x: f64, y: f64) -> LocalSurface {
        let to_world = self.to_world.affine();
        let offset = to_world.transform_vector3(DVec3::new(x, y, 0.0));
        let center = to_world.translation;
        let (position, error) = round_point(center + offset, center, Vector3::length(offset));
        let r = Real::sqrt(x * x + y * y);
        let (cos, sin) = if r > 0.0 { (x / r, y / r) } else { (1.0, 0.0) };
        LocalSurface {
            position,
            error,
            normal: self.normal,
            shading_normal: self.normal,
            uv: [r as f32, (azimuth(y, x) * 0.5 * <f64 as Real>::FRAC_1_PI) as f32],
            tangent: Some(to_world.transform_vector3(DVec3::new(cos, sin, 0.0)).as_vec3()),
            primitive: 0,
        }
    }

    /// `∂p/∂u` and `∂p/∂v`.
    pub(crate) fn partials(&self, [u, v]: [f32; 2]) -> [Vec3; 2] {
        let turn = 2.0 * <f64 as Real>::PI;
        let (sin, cos) = Real::sin_cos(f64::from(v) * turn);
        [DVec3::new(cos, sin, 0.0), DVec3::new(-sin, cos, 0.0) * (f64::from(u) * turn)]
            .map(|d| self.to_world.affine().transform_vector3(d).as_vec3())
    }

    pub(crate) fn sample_area(&self, u: [f32; 2]) -> ShapeSample {
        let [x, y] = disk::from_square(u.map(f64::from));
        self.sample_at(x, y)
    }

    /// The point from which the normal leads to `above`; `None` where that is outside or behind.
    pub(crate) fn foot(&self, above: Vec3) -> Option<ShapeSample> {
        let (height, x, y) = self.plane(&Ray::new(above, -self.normal));
        (height > 0.0 && x * x + y * y <= 1.0).then(|| self.sample_at(x, y))
    }

    fn sample_at(&self, x: f64, y: f64) -> ShapeSample {
        let s = self.at(x, y);
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

    #[test]
    fn the_foot_of_a_point_lies_below_it() {
        let tilt = Transform::rotate(DVec3::X, 30.0).expect("a map");
        let disk = Disk::new(&tilt);
        let [at, up] = [Vec3::new(0.3, -0.4, 0.0), Vec3::Z].map(|v| tilt.vector(v));
        let foot = disk.foot(at + 5.0 * up).expect("a point inside");
        // A few roundings of coordinates of up to 5.
        assert!(foot.position.distance(at) < 2e-6, "{foot:?}");
        assert!((foot.uv[0] - 0.5).abs() < 1e-6);
        assert!(disk.foot(at - 5.0 * up).is_none(), "behind");
        assert!(disk.foot(at * 3.0 + up).is_none(), "outside");
        assert!(disk.flipped().foot(at - 5.0 * up).is_some());
    }

    #[test]
    fn the_radius_is_u_and_the_azimuth_v() {
        let grow = Transform::scale(DVec3::new(4.0, 2.0, 1.0)).expect("a map");
        let disk = Disk::new(&grow);
        let ray = Ray::new(Vec3::new(0.0, 1.0, 3.0), -Vec3::Z);
        assert_eq!(disk.intersect(&ray), Some(3.0));
        let p = disk.surface(&ray);
        assert_eq!((p.uv, p.normal), ([0.5, 0.25], Vec3::Z));
        assert_eq!(p.tangent, Some(Vec3::Y * 2.0));
        assert_eq!(disk.intersect(&Ray::new(Vec3::new(0.0, 2.1, 3.0), -Vec3::Z)), None);
        assert_eq!(disk.intersect(&Ray::new(Vec3::X, Vec3::Y)), None);
    }
}
