//! Vertex normals for meshes that come without.

use alloc::vec;
use alloc::vec::Vec;

use etendue_math::Real;
use etendue_math::glam::{DVec3, Vec3};

use crate::geometry::TriangleMesh;

/// Unit vertex normals `n_v`: the mean of the normals of the triangles around a vertex, weighted by
/// their angles there.
///
/// ```text
/// n_v ∝ Σ_t φ_{t,v} n_t        φ = atan2(|a × b|, a · b),  a, b the edges of t that leave v
/// ```
///
/// The result is as long as the mesh's positions. It is zero, which stands for the geometric
/// normal, where a vertex belongs to no triangle of positive area or where the sum cancels.
/// Vertices that share a position but not an index, as along texture seams, are not joined; Mitsuba
/// leaves them apart too.
///
/// # Precision
/// Sums run in `f64`, so that no finite `f32` coordinates overflow.
///
/// # Source
/// Thürmer and Wüthrich, "Computing vertex normals from polygonal facets", JGT 3(1), 1998.
pub fn smooth_normals(mesh: &TriangleMesh) -> Vec<Vec3> {
    let mut sums = vec![DVec3::ZERO; mesh.positions().len()];
    for triangle in mesh.triangles() {
        let p = triangle.map(|v| mesh.positions()[v as usize].as_dvec3());
        let edges = [p[1] - p[0], p[2] - p[1], p[0] - p[2]];
        let cross = edges[0].cross(edges[1]);
        let twice_area = cross.length();
        // A vanishing product keeps nothing of the direction, and 1 / 0 would poison the sum.
        if twice_area <= 0.0 {
            continue;
        }
        let normal = cross / twice_area;
        for (corner, &vertex) in triangle.iter().enumerate() {
            let cosine = -edges[corner].dot(edges[(corner + 2) % 3]);
            sums[vertex as usize] += normal * Real::atan2(twice_area, cosine);
        }
    }
    sums.into_iter().map(|n| n.normalize_or_zero().as_vec3()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> TriangleMesh {
        let positions = positions.iter().map(|&p| Vec3::from(p)).collect();
        TriangleMesh::new(positions, vec![], vec![], triangles.to_vec()).expect("a valid mesh")
    }

    #[test]
    fn a_cube_corner_is_its_diagonal_however_its_faces_are_cut() {
        // Three quads at the origin corner; two triangles of one quad meet there, one of the
        // others: weights by area or by count would favour the former.
        let positions = [
            [0., 0., 0.],
            [1., 0., 0.],
            [1., 1., 0.],
            [0., 1., 0.],
            [0., 0., 1.],
            [1., 0., 1.],
            [0., 1., 1.],
        ];
        let triangles = [[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 5, 4], [0, 4, 3], [4, 6, 3]];
        let corner = smooth_normals(&mesh(&positions, &triangles))[0];
        // Three angles of π/2 in f64, rounded once to f32.
        assert!((corner - Vec3::splat(-1.0 / 3f32.sqrt())).length() < 2e-7, "{corner}");
    }

    #[test]
    fn huge_and_tiny_triangles_have_unit_normals() {
        for size in [1e-19f32, 1e-6, 1.0, 1e30] {
            let m = mesh(&[[0., 0., 0.], [size, 0., 0.], [0., size, 0.]], &[[0, 1, 2]]);
            assert_eq!(smooth_normals(&m), vec![Vec3::Z; 3], "{size}");
        }
    }

    #[test]
    fn degenerate_triangles_and_lonely_vertices_have_zero_normals() {
        let m = mesh(&[[0., 0., 0.], [1., 0., 0.], [2., 0., 0.], [5., 5., 5.]], &[[0, 1, 2]]);
        assert_eq!(smooth_normals(&m), vec![Vec3::ZERO; 4]);
    }
}
