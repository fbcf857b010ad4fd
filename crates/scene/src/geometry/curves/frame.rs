//! Directions around a curve.

use etendue_math::glam::DVec3;
use etendue_math::{Real, Vector3};

use crate::geometry::sphere::azimuth;

/// The directions around a tangent from which texture coordinates are counted: one towards +z as far as the tangent
/// allows, and one across both; the angle is counted from the second to the first.
///
/// # Source
/// Mitsuba 3, `local_frame` of `src/shapes/bsplinecurve.cpp` and `linearcurve.cpp`.
pub(super) struct Around {
    pub(super) up: DVec3,
    pub(super) side: DVec3,
}

impl Around {
    /// * `tangent`: of unit length.
    pub(super) fn of(tangent: DVec3) -> Self {
        // Mitsuba knows that a tangent is along z by its component in `f32`.
        let is_along = Real::abs(tangent.z) > 1.0 - 0.25 * f64::from(f32::EPSILON);
        let up = Vector3::try_normalize(DVec3::Z - tangent * tangent.z).filter(|_| !is_along);
        let up = up.unwrap_or(DVec3::Y);
        Self { up, side: up.cross(tangent) }
    }

    /// The angle of a direction over 2π, in `[0, 1)`.
    pub(super) fn turn(&self, direction: DVec3) -> f64 {
        azimuth(direction.dot(self.up), direction.dot(self.side)) * 0.5 * <f64 as Real>::FRAC_1_PI
    }

    /// The direction at an angle over 2π.
    pub(super) fn at(&self, turn: f64) -> DVec3 {
        let (sin, cos) = Real::sin_cos(turn * 2.0 * <f64 as Real>::PI);
        self.side * cos + self.up * sin
    }
}
