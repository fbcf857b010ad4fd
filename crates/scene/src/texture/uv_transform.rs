//! The transformation of texture coordinates.

use etendue_math::glam::{DMat4, Mat2, Vec2};

/// An affine map of texture coordinates, applied before the look-up.
///
/// ```text
/// uv' = M uv + t
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UvTransform {
    matrix: Mat2,
    translation: Vec2,
}

impl UvTransform {
    /// Leaves coordinates as they are.
    pub const IDENTITY: Self = Self { matrix: Mat2::IDENTITY, translation: Vec2::ZERO };

    /// The part of a 4 × 4 matrix that acts on x and y; z, its translation and the projective row
    /// are ignored, as scene files write texture transformations with the same elements as those of
    /// shapes. `None` if the part used is not finite.
    ///
    /// # Source
    /// Mitsuba 3's `to_uv`, which extracts the upper left 2 × 2 block and the first two entries of the
    /// last column.
    pub fn from_matrix4(matrix: DMat4) -> Option<Self> {
        let (x, y, w) = (matrix.x_axis, matrix.y_axis, matrix.w_axis);
        let own = Self {
            matrix: Mat2::from_cols_array(&[x.x as f32, x.y as f32, y.x as f32, y.y as f32]),
            translation: Vec2::new(w.x as f32, w.y as f32),
        };
        (own.matrix.is_finite() && own.translation.is_finite()).then_some(own)
    }

    /// Its entries by rows, the translation last in each.
    pub fn rows(&self) -> [[f32; 3]; 2] {
        let (x, y, t) = (self.matrix.x_axis, self.matrix.y_axis, self.translation);
        [[x.x, y.x, t.x], [x.y, y.y, t.y]]
    }

    /// The transformed coordinates.
    #[inline]
    pub fn apply(&self, [u, v]: [f32; 2]) -> [f32; 2] {
        (self.matrix * Vec2::new(u, v) + self.translation).to_array()
    }

    /// The gradient before the map of a function whose gradient after it is given: `Mᵀ g`.
    pub fn pull_back(&self, gradient: [f32; 2]) -> [f32; 2] {
        (self.matrix.transpose() * Vec2::from_array(gradient)).to_array()
    }
}

impl Default for UvTransform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use etendue_math::glam::DVec3;

    #[test]
    fn scaling_and_translating_a_matrix_does_so_to_coordinates() {
        let matrix = DMat4::from_translation(DVec3::new(0.25, 0.5, 9.0))
            * DMat4::from_scale(DVec3::new(2.0, 4.0, 0.0));
        let uv = UvTransform::from_matrix4(matrix).map(|t| t.apply([0.5, 0.25]));
        assert_eq!(uv, Some([1.25, 1.5]));
        assert_eq!(UvTransform::from_matrix4(DMat4::NAN), None);
    }
}
