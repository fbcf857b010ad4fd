//! Laws of the whole geometry, against brute force and closed forms.

mod moving;
mod sampling;
mod spawning;
mod traversal;
mod watertight;

use alloc::vec::Vec;

use etendue_math::glam::{DVec3, Vec3};

use super::{Shape, Transform, TriangleMesh};

/// A small generator of test inputs.
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn uniform(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 * (1.0 / 16777216.0)
    }

    pub(super) fn pair(&mut self) -> [f32; 2] {
        [self.uniform(), self.uniform()]
    }

    /// In the cube `[−1, 1)³`.
    pub(super) fn point(&mut self) -> Vec3 {
        Vec3::new(self.uniform(), self.uniform(), self.uniform()) * 2.0 - 1.0
    }

    pub(super) fn direction(&mut self) -> Vec3 {
        loop {
            let v = self.point();
            if v.length_squared() > 1e-3 && v.length_squared() < 1.0 {
                return v.normalize();
            }
        }
    }

    /// A rotation, a uniform scaling and a shift of the same size.
    pub(super) fn similarity(&mut self, scale: f64) -> Transform {
        let axis = self.direction().as_dvec3();
        let turn = Transform::rotate(axis, 360.0 * f64::from(self.uniform()));
        let grow = Transform::scale(DVec3::splat(scale));
        let shift = Transform::translate(self.point().as_dvec3() * scale * 3.0);
        shift
            .and_then(|shift| shift.compose(&turn?)?.compose(&grow?))
            .expect("similarities have inverses")
    }
}

/// Triangles of all sizes at random places, some without area.
pub(super) fn soup(random: &mut Random, count: u32) -> TriangleMesh {
    let mut positions = Vec::new();
    for i in 0..count {
        let center = random.point();
        let size = 0.5 * random.uniform() * random.uniform();
        let corners = [0; 3].map(|_| center + random.point() * size);
        positions.extend(match i % 50 {
            0 => [corners[0], corners[0], corners[1]],
            // Axis-aligned and flat boxes.
            1 => corners.map(|c| Vec3::new(c.x, 0.25, c.z)),
            _ => corners,
        });
    }
    let triangles = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    TriangleMesh::new(positions, Vec::new(), Vec::new(), triangles).expect("finite corners")
}

/// The unit sphere as a closed mesh without poles of zero area: a subdivided octahedron.
pub(super) fn sphere_mesh(levels: u32) -> TriangleMesh {
    let mut positions = alloc::vec![Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
    let mut triangles: Vec<[u32; 3]> = (0..8_u32)
        .map(|octant| {
            let pick = |axis: u32| axis + 3 * (octant >> axis & 1);
            let corners = [pick(0), pick(1), pick(2)];
            if octant.count_ones() % 2 == 0 {
                corners
            } else {
                [corners[0], corners[2], corners[1]]
            }
        })
        .collect();
    for _ in 0..levels {
        let mut middles = alloc::collections::BTreeMap::new();
        let mut split = Vec::new();
        for [a, b, c] in triangles {
            let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(i, j)| {
                *middles.entry((i.min(j), i.max(j))).or_insert_with(|| {
                    let middle = positions[i as usize] + positions[j as usize];
                    positions.push(middle.normalize());
                    positions.len() as u32 - 1
                })
            });
            split.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = split;
    }
    TriangleMesh::new(positions, Vec::new(), Vec::new(), triangles).expect("finite corners")
}

/// Shapes on which no points are drawn: a distance field and both kinds of curves, placed by a similarity that grows by
/// `scale`.
pub(super) fn without_points(transform: &Transform, scale: f64) -> [Shape; 3] {
    use super::{CurveBasis, CurvePoint, Curves, SdfGrid, SdfNormals, SdfSamples};
    let ball = (0..6 * 6 * 6).map(|i| {
        let p = Vec3::new((i % 6) as f32, (i / 6 % 6) as f32, (i / 36) as f32) * 0.2 - 0.5;
        (p.length() - 0.42) * if i % 7 == 0 { 1.5 } else { 1.0 }
    });
    let samples = SdfSamples::new([6; 3], ball.collect()).expect("finite values");
    let field = SdfGrid::new(samples, SdfNormals::Smooth, transform).expect("it has a surface");
    let curves = |basis| {
        let winding = (0..8).map(|i| {
            let (sin, cos) = etendue_math::Real::sin_cos(i as f32 * 0.9);
            let radius = (0.15 + 0.02 * (i % 3) as f32) * scale as f32;
            CurvePoint { position: Vec3::new(cos, sin, 0.3 * i as f32 - 1.0) * 0.7, radius }
        });
        Curves::new(basis, winding.collect(), &[8], transform).expect("a curve")
    };
    [
        Shape::Sdf(field.into()),
        Shape::Curves(curves(CurveBasis::Linear).into()),
        Shape::Curves(curves(CurveBasis::BSpline).into()),
    ]
}

/// One of each shape on which points are drawn, placed by a transform.
pub(super) fn one_of_each(transform: &Transform) -> [Shape; 5] {
    use super::{Cylinder, Disk, Rectangle, Sphere};
    let p1 = DVec3::new(0.3, -0.2, 1.0);
    [
        Shape::Mesh(sphere_mesh(2).transformed(transform).expect("in range")),
        Shape::Sphere(Sphere::new(DVec3::new(0.2, 0.1, 0.0), 0.9, transform).expect("a sphere")),
        Shape::Rectangle(Rectangle::new(transform).expect("in range")),
        Shape::Disk(Disk::new(transform)),
        Shape::Cylinder(Cylinder::new(-p1, p1, 0.5, transform).expect("a cylinder")),
    ]
}
