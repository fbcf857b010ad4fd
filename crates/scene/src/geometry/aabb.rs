//! Axis-aligned boxes.

use etendue_math::glam::Vec3;

/// An axis-aligned box, closed on every side; empty where `min > max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Smallest coordinates.
    pub min: Vec3,
    /// Largest coordinates.
    pub max: Vec3,
}

impl Aabb {
    /// The box of nothing: the neutral element of [`union`](Self::union).
    pub const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// The smallest box that holds all points.
    pub fn from_points(points: impl IntoIterator<Item = Vec3>) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::grow)
    }

    /// The smallest box that holds this one and a point.
    #[inline]
    pub fn grow(self, point: Vec3) -> Self {
        Self { min: self.min.min(point), max: self.max.max(point) }
    }

    /// The smallest box that holds both.
    #[inline]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Whether it holds no point.
    pub fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// The middle; NaN for an empty box.
    #[inline]
    pub fn center(&self) -> Vec3 {
        // Halved first: the sum of two large coordinates may overflow.
        self.min * 0.5 + self.max * 0.5
    }

    /// The edge lengths; 0 for an empty box.
    #[inline]
    pub fn extent(&self) -> Vec3 {
        (self.max - self.min).max(Vec3::ZERO)
    }

    /// Half the surface area, `xy + yz + zx` of the edge lengths; 0 for an empty box.
    #[inline]
    pub fn half_area(&self) -> f32 {
        let e = self.extent();
        e.x * e.y + e.y * e.z + e.z * e.x
    }

    /// The eight corners.
    pub fn corners(&self) -> [Vec3; 8] {
        let pick = |bit: usize, axis: usize| if bit >> axis & 1 == 0 { self.min } else { self.max };
        core::array::from_fn(|i| Vec3::new(pick(i, 0).x, pick(i, 1).y, pick(i, 2).z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_empty_box_is_neutral_and_has_no_area() {
        let unit = Aabb::from_points([Vec3::ZERO, Vec3::ONE]);
        assert_eq!(Aabb::EMPTY.union(unit), unit);
        assert!(Aabb::EMPTY.is_empty() && !unit.is_empty());
        assert_eq!(Aabb::EMPTY.half_area(), 0.0);
        assert_eq!(unit.half_area(), 3.0);
    }

    #[test]
    fn the_corners_span_the_box() {
        let b = Aabb::from_points([Vec3::new(-1.0, 2.0, 3.0), Vec3::new(4.0, -5.0, 6.0)]);
        assert_eq!(Aabb::from_points(b.corners()), b);
    }
}
