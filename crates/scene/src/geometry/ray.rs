//! Rays.

use etendue_math::glam::Vec3;

/// A ray: the points `origin + t·direction` with `0 < t < t_max`.
///
/// There is no lower limit on `t` but 0: rays that leave a surface start beside it
/// (see [`offset_point`](super::offset_point)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes; need not have unit length, `t` counts in multiples of it.
    pub direction: Vec3,
    /// Where it ends, exclusive; infinity for a ray without end.
    pub t_max: f32,
}

impl Ray {
    /// A ray without end.
    #[inline(always)]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction, t_max: f32::INFINITY }
    }

    /// The open segment between two points, with `t` from 0 to 1.
    #[inline(always)]
    pub fn between(origin: Vec3, target: Vec3) -> Self {
        Self { origin, direction: target - origin, t_max: 1.0 }
    }

    /// The point at parameter `t`.
    #[inline(always)]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }

    /// Finite origin, finite direction that is not zero, and a positive `t_max`.
    #[inline(always)]
    pub(crate) fn is_valid(&self) -> bool {
        // Zero times what is not finite is NaN, and a comparison with NaN is false: six tests in
        // one, and a NaN t_max is refused as well.
        let zero = self.origin * 0.0 + self.direction * 0.0;
        let size = self.direction.abs();
        zero.x + zero.y + zero.z == 0.0 && size.x + size.y + size.z > 0.0 && self.t_max > 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_finite_rays_that_go_somewhere_are_valid() {
        assert!(Ray::new(Vec3::ZERO, Vec3::X).is_valid());
        assert!(!Ray::new(Vec3::NAN, Vec3::X).is_valid());
        assert!(!Ray::new(Vec3::ZERO, Vec3::ZERO).is_valid());
        assert!(!Ray::new(Vec3::ZERO, Vec3::new(0.0, f32::INFINITY, 0.0)).is_valid());
        assert!(!Ray { t_max: f32::NAN, ..Ray::new(Vec3::ZERO, Vec3::X) }.is_valid());
    }

    #[test]
    fn a_segment_ends_at_its_target() {
        let ray = Ray::between(Vec3::X, Vec3::new(3.0, 4.0, 0.0));
        assert_eq!(ray.at(ray.t_max), Vec3::new(3.0, 4.0, 0.0));
    }
}
