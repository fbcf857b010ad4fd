//! Vertex normals for meshes that come without.

use alloc::vec;
use alloc::vec::Vec;

use etendue_math::Real;
use etendue_math::glam::{DVec3, Vec3};

use crate::geometry::MeshArrays;
use crate::parallel;

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
pub fn smooth_normals(mesh: &MeshArrays) -> Vec<Vec3> {
    let shares = |triangles| parallel::map(triangles, |t| Share::of(t, mesh.positions()));
    let mut sums = vec![DVec3::ZERO; mesh.positions().len()];
    let mut ready: Vec<Share> = Vec::new();
    let mut done = mesh.triangles().iter();
    // Angles are computed on all cores; meanwhile one of them adds those of the batch before, in the order of the triangles.
    for batch in mesh.triangles().chunks(BATCH).chain([[].as_slice()]) {
        let add = || {
            for (share, triangle) in ready.iter().zip(done.by_ref()) {
                for (&vertex, angle) in triangle.iter().zip(share.angles) {
                    sums[vertex as usize] += share.normal * angle;
                }
            }
        };
        let (next, ()) = rayon::join(|| shares(batch), add);
        ready = next;
    }
    parallel::map(&sums, |n| n.normalize_or_zero().as_vec3())
}

/// How many triangles are in memory with their angles at a time.
const BATCH: usize = 1 << 16;

/// What a triangle adds to the normals of its vertices.
struct Share {
    /// Its unit normal, or zero where it has no area.
    normal: DVec3,
    angles: [f64; 3],
}

impl Share {
    fn of(triangle: &[u32; 3], positions: &[Vec3]) -> Self {
        let p = triangle.map(|v| positions[v as usize].as_dvec3());
        let edges = [p[1] - p[0], p[2] - p[1], p[0] - p[2]];
        let cross = edges[0].cross(edges[1]);
        let twice_area = cross.length();
        // A vanishing product keeps nothing of the direction, and 1 / 0 would poison the sum.
        if twice_area <= 0.0 {
            return Self { normal: DVec3::ZERO, angles: [0.0; 3] };
        }
        let angle = |corner: usize| {
            let cosine = -edges[corner].dot(edges[(corner + 2) % 3]);
            Real::atan2(twice_area, cosine)
        };
        Self { normal: cross / twice_area, angles: [angle(0), angle(1), angle(2)] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> MeshArrays {
        let positions = positions.iter().map(|&p| Vec3::from(p)).collect();
        MeshArrays::new(positions, vec![], vec![], triangles.to_vec()).expect("a valid mesh")
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
    fn sums_run_in_the_order_of_the_triangles_across_batches() {
        // Every triangle meets the first vertex, where the order of a sum of so many shows.
        let count = BATCH as u32 + 1000;
        let positions: Vec<[f32; 3]> = (0..count + 2)
            .map(|i| [Real::sin(i as f32), Real::cos(i as f32), (i % 7) as f32])
            .collect();
        let triangles: Vec<[u32; 3]> = (1..=count).map(|i| [0, i, i + 1]).collect();
        let mesh = mesh(&positions, &triangles);
        let mut sum = DVec3::ZERO;
        for triangle in mesh.triangles() {
            let share = Share::of(triangle, mesh.positions());
            sum += share.normal * share.angles[0];
        }
        assert_eq!(smooth_normals(&mesh)[0], sum.normalize().as_vec3());
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
