//! No ray gets into or out of a closed surface.

use alloc::vec::Vec;

use etendue_math::glam::Vec3;

use super::{Random, sphere_mesh};
use crate::geometry::{GeometryBuilder, Ray, Shape, Transform, TriangleMesh};

/// Fires rays from a point inside at vertices, edges and faces of a mesh around it.
fn assert_closed(mesh: &TriangleMesh, random: &mut Random, rays_per_triangle: u32) -> u32 {
    let mut builder = GeometryBuilder::new();
    builder.add_shape(Shape::Mesh(mesh.clone()));
    let geometry = builder.build();
    let center = geometry.bounds().center();
    let reach = geometry.bounds().extent().min_element() * 0.2;
    let mut rays = 0;
    for i in 0..mesh.triangles().len() as u32 {
        let [a, b, c] = mesh.corners(i);
        for k in 0..rays_per_triangle {
            let origin = if k % 5 == 0 { center } else { center + random.point() * reach };
            let [s, t] = random.pair();
            let target = match k % 4 {
                0 => a,
                1 => (a + b) * 0.5,
                2 => a + (c - a) * s,
                _ => a + (b - a) * (s * (1.0 - t)) + (c - a) * (s * t),
            };
            let ray = Ray::new(origin, target - origin);
            assert!(geometry.intersect(&ray).is_some(), "{ray:?} leaves through triangle {i}");
            assert!(geometry.occluded(&ray), "{ray:?} leaves through triangle {i}");
            rays += 1;
        }
    }
    rays
}

#[test]
fn no_ray_leaves_a_closed_mesh_through_edges_and_vertices() {
    let mut random = Random(11);
    let mut rays = 0;
    let sphere = sphere_mesh(4);
    for scale in [1e-4, 1.0, 1e6] {
        let place = random.similarity(scale);
        let moved = sphere.clone().transformed(&place).expect("in range");
        rays += assert_closed(&moved, &mut random, 24);
        let cube = TriangleMesh::cube(&place).expect("in range");
        rays += assert_closed(&cube, &mut random, 400);
    }
    // Axis-aligned faces and rays: zeros in directions, edge functions and boxes.
    let cube = TriangleMesh::cube(&Transform::IDENTITY).expect("in range");
    rays += assert_closed(&cube, &mut random, 4000);
    rays += assert_closed(&sphere_mesh(1), &mut random, 2000);
    assert!(rays > 100_000, "{rays}");
}

#[test]
fn a_mesh_far_from_the_origin_is_closed() {
    // 2²⁰ units away a unit cube has coordinates with 1/16 of resolution: the faces still meet.
    let shift = etendue_math::glam::DVec3::new(1048576.0, -1048576.0, 524288.0);
    let place = Transform::translate(shift).expect("in range");
    let cube = TriangleMesh::cube(&place).expect("in range");
    assert_closed(&cube, &mut Random(12), 500);
}

#[test]
fn rays_from_far_away_hit_what_they_are_aimed_at() {
    let mut random = Random(13);
    let mut builder = GeometryBuilder::new();
    builder.add_shape(Shape::Mesh(sphere_mesh(3)));
    let geometry = builder.build();
    for _ in 0..2000 {
        let direction = random.direction();
        let origin = direction * -1e6;
        // The resolution of the origin is 1/16: aim at a point well inside.
        let target = random.point() * 0.2;
        assert!(geometry.intersect(&Ray::new(origin, target - origin)).is_some());
    }
}

/// Two cones with a common rim, about the diagonal: each triangle goes from the middle to one end, and its box is large
/// and all but empty.
fn spindle(around: u32) -> TriangleMesh {
    use etendue_math::Real;
    let axis = Vec3::ONE.normalize();
    let side = axis.cross(Vec3::X).normalize();
    let up = axis.cross(side);
    let rim = (0..around).map(|i| {
        let (sin, cos) = Real::sin_cos(core::f32::consts::TAU * i as f32 / around as f32);
        side * cos + up * sin
    });
    let positions: Vec<Vec3> = [axis * 100.0, axis * -100.0].into_iter().chain(rim).collect();
    let triangles = (0..around).flat_map(|i| {
        let (a, b) = (2 + i, 2 + (i + 1) % around);
        [[0, a, b], [1, b, a]]
    });
    TriangleMesh::new(positions, Vec::new(), Vec::new(), triangles.collect()).expect("a mesh")
}

#[test]
fn a_mesh_of_triangles_in_several_parts_is_closed() {
    let mut random = Random(14);
    let mesh = spindle(300);
    let mut builder = GeometryBuilder::new();
    builder.add_shape(Shape::Mesh(mesh.clone()));
    let geometry = builder.build();
    for i in 0..mesh.triangles().len() as u32 {
        let [tip, a, b] = mesh.corners(i);
        for k in 0..60 {
            let [s, t] = random.pair();
            // On the axis, in the half of the triangle or in the other one.
            let origin = tip * (1.8 * s - 0.9);
            let target = match k % 4 {
                0 => a,
                1 => tip + (a - tip) * t,
                2 => a + (b - a) * t,
                _ => tip + (a + (b - a) * s - tip) * t,
            };
            let ray = Ray::new(origin, target - origin);
            assert!(geometry.intersect(&ray).is_some(), "{ray:?} leaves through triangle {i}");
            assert!(geometry.occluded(&ray), "{ray:?} leaves through triangle {i}");
        }
    }
}
