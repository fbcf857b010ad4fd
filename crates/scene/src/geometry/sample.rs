//! Points drawn on shapes.

use etendue_math::Real;
use etendue_math::glam::Vec3;

use super::offset_point;

/// A point drawn on the surface of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeSample {
    /// Where it is.
    pub position: Vec3,
    /// Absolute bound on the error of the position, per axis.
    pub error: Vec3,
    /// Unit geometric normal, on the front side of the shape.
    pub normal: Vec3,
    /// Texture coordinates.
    pub uv: [f32; 2],
    /// Density with respect to area on the primitive, 1/area.
    pub pdf_area: f32,
}

impl ShapeSample {
    /// The sampled point moved off its surface, towards `reference`: where a segment from there can
    /// end without touching the surface.
    ///
    /// It stops short by the error of the position and by what rounding the direction does to a
    /// segment of this length: `2⁻²¹ |q − p|` per axis.
    #[inline(always)]
    pub fn seen_from(&self, reference: Vec3) -> Vec3 {
        let direction = self.position - reference;
        let error = self.error + direction.abs() * (4.0 * f32::EPSILON);
        offset_point(self.position, error, self.normal, -direction)
    }
}

/// The density with respect to solid angle seen from `reference` of a point drawn with a density
/// with respect to area:
///
/// ```text
/// p_ω = p_A d² / |n · w| = p_A d³ / |n · (p − reference)|
/// ```
///
/// 0 where the surface is seen edge-on or from itself: no light passes there.
#[inline(always)]
pub(crate) fn solid_angle_density(
    pdf_area: f32,
    reference: Vec3,
    position: Vec3,
    normal: Vec3,
) -> f32 {
    // In f64: the cube of a distance leaves the range of f32 at 1e13 and below 1e-13.
    let d = position.as_dvec3() - reference.as_dvec3();
    let squared = d.dot(d);
    let pdf =
        f64::from(pdf_area) * squared * Real::sqrt(squared) / Real::abs(d.dot(normal.as_dvec3()));
    let pdf = pdf as f32;
    if pdf.is_finite() { pdf } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_density_grows_with_squared_distance_and_obliquity() {
        let pdf = |p| solid_angle_density(1.0, Vec3::ZERO, p, Vec3::Z);
        assert_eq!(pdf(Vec3::Z * 3.0), 9.0);
        // d² = 25, cosine 3/5.
        assert!((pdf(Vec3::new(4.0, 0.0, 3.0)) - 25.0 / 0.6).abs() < 1e-5);
        assert_eq!(pdf(Vec3::X), 0.0);
        assert_eq!(pdf(Vec3::ZERO), 0.0);
    }
}
