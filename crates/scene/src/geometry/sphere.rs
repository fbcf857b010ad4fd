//! Spheres.

use etendue_math::glam::{DAffine3, DVec3, Vec3};
use etendue_math::{Real, Vector3};
use etendue_sampling::warp::uniform_sphere;

use super::surface::LocalSurface;
use super::{Aabb, Ray, ShapeError, ShapeSample, Transform};

/// A sphere.
///
/// `u` is the azimuth about the local z axis over 2π, `v` the angle from +z over π. The front is
/// outside unless the normals are flipped or the transform mirrors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    center: DVec3,
    radius: f64,
    /// From the unit sphere.
    to_world: Transform,
    /// +1 where the front is outside, −1 where it is inside.
    side: f64,
}

impl Sphere {
    /// A sphere with centre and radius in local space, placed by a transform.
    ///
    /// # Errors
    /// A radius that is not positive and finite; a transform that would make it an ellipsoid.
    pub fn new(center: DVec3, radius: f64, transform: &Transform) -> Result<Self, ShapeError> {
        if !(radius > 0.0 && radius.is_finite()) {
            return Err(ShapeError::BadRadius);
        }
        let to_world = transform
            .compose(&Transform::translate(center)?)?
            .compose(&Transform::scale(DVec3::splat(radius))?)?;
        Self::of_unit(&to_world)
    }

    /// The image of the unit sphere.
    fn of_unit(to_world: &Transform) -> Result<Self, ShapeError> {
        let radius = uniform_scale(to_world).ok_or(ShapeError::NonUniformScale)?;
        Ok(Self {
            center: to_world.affine().translation.as_vec3().as_dvec3(),
            radius: f64::from(radius as f32),
            side: if to_world.is_mirrored() { -1.0 } else { 1.0 },
            to_world: *to_world,
        })
    }

    /// The sphere moved by a transform.
    pub(super) fn transformed(self, transform: &Transform) -> Result<Self, ShapeError> {
        let is_flipped = self.faces_inward() != self.to_world.is_mirrored();
        let moved = Self::of_unit(&transform.compose(&self.to_world)?)?;
        Ok(if is_flipped { moved.flipped() } else { moved })
    }

    /// The same sphere with front and back exchanged.
    pub fn flipped(self) -> Self {
        Self { side: -self.side, ..self }
    }

    /// The centre in world space.
    pub fn center(&self) -> Vec3 {
        self.center.as_vec3()
    }

    /// The radius in world space.
    pub fn radius(&self) -> f32 {
        self.radius as f32
    }

    /// Whether the front is inside.
    pub(crate) fn faces_inward(&self) -> bool {
        self.side < 0.0
    }

    /// What places the unit sphere, and whether front and back are exchanged.
    pub fn placement(&self) -> (&DAffine3, bool) {
        (self.to_world.affine(), self.faces_inward() != self.to_world.is_mirrored())
    }

    pub(crate) fn exact_center(&self) -> DVec3 {
        self.center
    }

    pub(crate) fn exact_radius(&self) -> f64 {
        self.radius
    }

    /// The surface area, `4 π r²`.
    pub fn area(&self) -> f32 {
        (4.0 * <f64 as Real>::PI * self.radius * self.radius) as f32
    }

    pub(crate) fn bounds(&self) -> Aabb {
        // Rounding the corners of exact numbers: one step outwards makes up for it.
        let (low, high) = (self.center - self.radius, self.center + self.radius);
        let (low, high) = (low.as_vec3(), high.as_vec3());
        Aabb {
            min: Vec3::new(low.x.next_down(), low.y.next_down(), low.z.next_down()),
            max: Vec3::new(high.x.next_up(), high.y.next_up(), high.z.next_up()),
        }
    }

    /// Both roots of `|o + t d − c| = r` in ascending order, in `f64`.
    ///
    /// ```text
    /// t_m = −(l·d)/(d·d),  l⊥ = l + t_m d,  h = √((r² − l⊥²)/(d·d)),  l = o − c
    /// far root t_m ± h with the sign of t_m; the other one from their product (l² − r²)/(d·d)
    /// ```
    ///
    /// # Source
    /// The perpendicular form: Haines et al., "Precision Improvements for Ray/Sphere
    /// Intersection", Ray Tracing Gems, 2019, chapter 7.
    fn roots(&self, ray: &Ray) -> Option<(f64, f64)> {
        let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let l = o - self.center;
        let dd = d.dot(d);
        let middle = -l.dot(d) / dd;
        let perpendicular = l + d * middle;
        let discriminant = self.radius * self.radius - perpendicular.dot(perpendicular);
        if discriminant < 0.0 || discriminant.is_nan() {
            return None;
        }
        let half = Real::sqrt(discriminant / dd);
        let distance = Real::sqrt(l.dot(l));
        let product = (distance - self.radius) * (distance + self.radius) / dd;
        if middle > 0.0 {
            let far = middle + half;
            Some((product / far, far))
        } else {
            let near = middle - half;
            let far = if near == 0.0 { 0.0 } else { product / near };
            Some((near, far))
        }
    }

    pub(crate) fn intersect(&self, ray: &Ray) -> Option<f32> {
        let (near, far) = self.roots(ray)?;
        [near as f32, far as f32].into_iter().find(|&t| t > 0.0 && t < ray.t_max)
    }

    pub(crate) fn surface(&self, ray: &Ray, t: f32) -> LocalSurface {
        let (near, far) = self.roots(ray).unwrap_or((f64::from(t), f64::from(t)));
        // The root in f64 that was rounded to `t`.
        let t = f64::from(t);
        let exact = if Real::abs(near - t) <= Real::abs(far - t) { near } else { far };
        let hit = ray.origin.as_dvec3() + ray.direction.as_dvec3() * exact;
        let outward = Vector3::try_normalize(hit - self.center).unwrap_or(DVec3::Z);
        self.at(outward)
    }

    /// The point in an outward unit direction from the centre.
    fn at(&self, outward: DVec3) -> LocalSurface {
        let (position, error) =
            round_point(self.center + outward * self.radius, self.center, self.radius);
        let local = self.to_world.inverse_affine().transform_vector3(outward * self.radius);
        // Texture coordinates are as good in f32, and most points are asked for none.
        let [x, y, z] = local.as_vec3().to_array();
        let (theta, phi) = (Real::atan2((x * x + y * y).sqrt(), z), azimuth(y, x));
        let to_world = self.to_world.affine();
        let du = DVec3::new(-local.y, local.x, 0.0) * (2.0 * <f64 as Real>::PI);
        let normal = (outward * self.side).as_vec3();
        LocalSurface {
            position,
            error,
            normal,
            shading_normal: normal,
            uv: [phi * 0.5 * f32::FRAC_1_PI, theta * f32::FRAC_1_PI],
            tangent: Some(to_world.transform_vector3(du).as_vec3()),
            primitive: 0,
        }
    }

    /// `∂p/∂u` and `∂p/∂v`.
    pub(crate) fn partials(&self, uv: [f32; 2]) -> [Vec3; 2] {
        let pi = <f64 as Real>::PI;
        let (sin_phi, cos_phi) = Real::sin_cos(f64::from(uv[0]) * 2.0 * pi);
        let (sin, cos) = Real::sin_cos(f64::from(uv[1]) * pi);
        let du = DVec3::new(-sin_phi, cos_phi, 0.0) * (2.0 * pi * sin);
        let dv = DVec3::new(cos * cos_phi, cos * sin_phi, -sin) * pi;
        [du, dv].map(|d| self.to_world.affine().transform_vector3(d).as_vec3())
    }

    /// The point in an outward unit direction from the centre, as a sample.
    pub(crate) fn sample_at(&self, outward: DVec3) -> ShapeSample {
        let s = self.at(outward);
        ShapeSample {
            position: s.position,
            error: s.error,
            normal: s.normal,
            uv: s.uv,
            pdf_area: 1.0 / self.area(),
        }
    }

    pub(crate) fn sample_area(&self, u: [f32; 2]) -> ShapeSample {
        self.sample_at(uniform_sphere::from_square(u.map(f64::from)))
    }
}

/// A point computed in `f64` as the sum of an anchor and a vector of length up to `reach`, rounded
/// to `f32`, and the bound on its error: half a unit in the last place and the noise of `f64`.
pub(crate) fn round_point(exact: DVec3, anchor: DVec3, reach: f64) -> (Vec3, Vec3) {
    let noise = (anchor.abs() + reach) * (16.0 * f64::EPSILON);
    let error = exact.abs() * (0.5 * f64::from(f32::EPSILON)) + noise;
    // The factor covers the rounding of the bound itself.
    (exact.as_vec3(), (error * (1.0 + 1e-6)).as_vec3())
}

/// The angle of `(x, y)` in `[0, 2π)`.
pub(crate) fn azimuth<T: Real>(y: T, x: T) -> T {
    let phi = Real::atan2(y, x);
    if phi < T::ZERO { phi + T::lit(2.0) * T::PI } else { phi }
}

/// The common length of the columns if they are orthogonal and equally long.
pub(super) fn uniform_scale(t: &Transform) -> Option<f64> {
    // Matrices in scene files have six or seven digits.
    const TOLERANCE: f64 = 1e-4;
    let m = &t.affine().matrix3;
    let squared = m.x_axis.dot(m.x_axis);
    let close = |a: f64, b: f64| Real::abs(a - b) <= TOLERANCE * squared;
    let same = close(m.y_axis.dot(m.y_axis), squared) && close(m.z_axis.dot(m.z_axis), squared);
    let orthogonal = close(m.x_axis.dot(m.y_axis), 0.0)
        && close(m.x_axis.dot(m.z_axis), 0.0)
        && close(m.y_axis.dot(m.z_axis), 0.0);
    (same && orthogonal).then(|| Real::sqrt(squared))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit() -> Sphere {
        Sphere::new(DVec3::ZERO, 1.0, &Transform::IDENTITY).expect("a sphere")
    }

    #[test]
    fn far_spheres_are_hit_where_they_are() {
        for distance in [1e2_f32, 1e4, 1e6] {
            for offset in [0.0_f32, 0.5, 0.999] {
                let ray = Ray::new(Vec3::new(offset, 0.0, -distance), Vec3::Z);
                let want = f64::from(distance) - Real::sqrt(1.0 - f64::from(offset * offset));
                let t = unit().intersect(&ray).expect("within the radius");
                // The root is found in f64 and rounded once.
                assert!(Real::abs(f64::from(t) - want) <= want * f64::from(f32::EPSILON));
                let p = unit().surface(&ray, t);
                assert!(Real::abs(p.position.x - offset) <= 1e-6, "{p:?}");
            }
            let beside = Ray::new(Vec3::new(1.0001, 0.0, -distance), Vec3::Z);
            assert_eq!(unit().intersect(&beside), None);
        }
    }

    #[test]
    fn a_ray_from_inside_meets_the_far_side_and_mirroring_turns_the_front_inwards() {
        let ray = Ray::new(Vec3::new(0.5, 0.0, 0.0), Vec3::X * 2.0);
        assert_eq!(unit().intersect(&ray), Some(0.25));
        let mirror = Transform::scale(DVec3::splat(-1.0)).expect("a map");
        let inward = Sphere::new(DVec3::ZERO, 1.0, &mirror).expect("a sphere");
        assert_eq!(inward.surface(&ray, 0.25).normal, -Vec3::X);
        assert_eq!(inward.flipped().surface(&ray, 0.25).normal, Vec3::X);
    }

    #[test]
    fn the_azimuth_is_u_and_the_polar_angle_v() {
        let p = unit().surface(&Ray::new(Vec3::Y * 3.0, -Vec3::Y), 2.0);
        assert_eq!(p.uv, [0.25, 0.5]);
        let du = p.tangent.expect("a sphere has texture coordinates");
        // ∂p/∂u is 2π times a unit vector on the equator.
        assert!(du.x < 0.0 && (du.length() / (2.0 * f32::PI) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn ellipsoids_and_bad_radii_are_refused() {
        let stretch = Transform::scale(DVec3::new(1.0, 2.0, 1.0)).expect("a map");
        let sphere = |radius, t| Sphere::new(DVec3::ZERO, radius, t);
        assert_eq!(sphere(1.0, &stretch), Err(ShapeError::NonUniformScale));
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(sphere(radius, &Transform::IDENTITY), Err(ShapeError::BadRadius));
        }
    }
}
