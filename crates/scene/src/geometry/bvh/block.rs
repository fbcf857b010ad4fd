//! Blocks of triangles.

use super::LANES;
use super::build::TriangleRef;
use super::traverse::Found;

/// Eight triangles side by side. Lanes without a triangle hold NaN, which no test lets pass.
#[derive(Clone, Debug)]
#[repr(C, align(32))]
pub(super) struct TriangleBlock {
    /// Coordinates by corner, axis and lane.
    pub(super) corners: [[[f32; LANES]; 3]; 3],
    pub(super) shapes: [u32; LANES],
    pub(super) primitives: [u32; LANES],
}

impl TriangleBlock {
    /// Up to eight triangles; more are left out.
    pub(super) fn new(triangles: impl Iterator<Item = TriangleRef>) -> Self {
        let mut block = Self {
            corners: [[[f32::NAN; LANES]; 3]; 3],
            shapes: [u32::MAX; LANES],
            primitives: [u32::MAX; LANES],
        };
        for (lane, triangle) in triangles.take(LANES).enumerate() {
            for (corner, position) in triangle.corners.iter().enumerate() {
                for axis in 0..3 {
                    block.corners[corner][axis][lane] = position[axis];
                }
            }
            block.shapes[lane] = triangle.shape;
            block.primitives[lane] = triangle.primitive;
        }
        block
    }

    /// A hit in a lane.
    #[inline(always)]
    pub(super) fn found(&self, lane: usize, t: f32, uv: [f32; 2]) -> Found {
        let (shape, primitive) = (self.shapes[lane], self.primitives[lane]);
        Found { t, uv, shape, primitive, instance: u32::MAX }
    }
}

/// Equality of bits: NaN in empty lanes must compare equal.
impl PartialEq for TriangleBlock {
    fn eq(&self, other: &Self) -> bool {
        let bits = |b: &Self| b.corners.map(|c| c.map(|a| a.map(f32::to_bits)));
        bits(self) == bits(other)
            && self.shapes == other.shapes
            && self.primitives == other.primitives
    }
}
