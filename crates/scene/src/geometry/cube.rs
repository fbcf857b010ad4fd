//! The cube, as a mesh.

use alloc::vec::Vec;

use etendue_math::glam::{Vec2, Vec3};

use super::{MeshError, Transform, TriangleMesh};

impl TriangleMesh {
    /// The cube `[−1, 1]³` placed by a transform: twelve triangles with face normals that point
    /// outwards, each face covering `[0, 1]²` of texture space.
    ///
    /// # Errors
    /// A corner that leaves the range of `f32`.
    ///
    /// # Source
    /// Vertex order and texture coordinates of Mitsuba 3's `cube`.
    pub fn cube(transform: &Transform) -> Result<Self, MeshError> {
        /// Four corners per face as signs, in Mitsuba's order: −y, +y, +x, +z, −x, −z.
        const CORNERS: [[[i8; 3]; 4]; 6] = [
            [[1, -1, -1], [1, -1, 1], [-1, -1, 1], [-1, -1, -1]],
            [[1, 1, -1], [-1, 1, -1], [-1, 1, 1], [1, 1, 1]],
            [[1, -1, -1], [1, 1, -1], [1, 1, 1], [1, -1, 1]],
            [[1, -1, 1], [1, 1, 1], [-1, 1, 1], [-1, -1, 1]],
            [[-1, -1, 1], [-1, 1, 1], [-1, 1, -1], [-1, -1, -1]],
            [[1, 1, -1], [1, -1, -1], [-1, -1, -1], [-1, 1, -1]],
        ];
        const NORMALS: [Vec3; 6] =
            [Vec3::NEG_Y, Vec3::Y, Vec3::X, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Z];
        const UVS: [Vec2; 4] = [Vec2::new(0.0, 1.0), Vec2::ONE, Vec2::new(1.0, 0.0), Vec2::ZERO];

        let positions = CORNERS.iter().flatten().map(|c| Vec3::from(c.map(f32::from))).collect();
        let normals = NORMALS.iter().flat_map(|&n| [n; 4]).collect();
        let uvs = core::iter::repeat_n(UVS, 6).flatten().collect();
        let triangles: Vec<[u32; 3]> =
            (0..24).step_by(4).flat_map(|i| [[i, i + 1, i + 2], [i + 3, i, i + 2]]).collect();
        Self::new(positions, normals, uvs, triangles)?.transformed(transform)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::triangle;

    #[test]
    fn every_face_winds_around_its_outward_normal() {
        let cube = TriangleMesh::cube(&Transform::IDENTITY).expect("finite corners");
        assert_eq!(cube.triangles().len(), 12);
        for (i, t) in cube.triangles().iter().enumerate() {
            let normal = triangle::normal(&cube.corners(i as u32));
            assert_eq!(normal, Some(cube.normals()[t[0] as usize]));
        }
    }
}
