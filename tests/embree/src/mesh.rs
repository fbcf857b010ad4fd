//! Meshes: read, put together, subdivided.

use std::collections::HashMap;
use std::f32::consts::TAU;
use std::path::Path;

use etendue_math::glam::{Mat3, Vec3};
use etendue_scene::geometry::{Geometry, GeometryBuilder, Shape, TriangleMesh};
use etendue_scene::{LoadOptions, load_scene};

/// Triangles, and nothing else.
#[derive(Clone, Default)]
pub struct Mesh {
    pub positions: Vec<Vec3>,
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Reads what the scene's loaders read; all of its meshes become one, and vertices at the same place too.
    pub fn read(path: &Path) -> Self {
        let options = LoadOptions { film_size: Some([4, 4]), ..LoadOptions::default() };
        let scene = load_scene(path, &options).unwrap_or_else(|error| panic!("{error}")).scene;
        let mut mesh = Self::default();
        let mut places = HashMap::new();
        for shape in scene.geometry.shapes() {
            let Shape::Mesh(part) = shape else { continue };
            let mut index = |vertex: u32| {
                let p = part.positions()[vertex as usize];
                *places.entry(p.to_array().map(f32::to_bits)).or_insert_with(|| {
                    mesh.positions.push(p);
                    mesh.positions.len() as u32 - 1
                })
            };
            let triangles = part.triangles().iter().map(|corners| corners.map(&mut index));
            mesh.triangles.extend(triangles);
        }
        mesh.triangles.retain(|&[a, b, c]| a != b && b != c && c != a);
        assert!(!mesh.triangles.is_empty(), "{}: no triangles", path.display());
        mesh
    }

    pub fn geometry(&self) -> Geometry {
        self.builder().build()
    }

    /// All but the hierarchy.
    pub fn builder(&self) -> GeometryBuilder {
        let mesh =
            TriangleMesh::new(self.positions.clone(), vec![], vec![], self.triangles.clone());
        let mut builder = GeometryBuilder::new();
        builder.add_shape(Shape::Mesh(mesh.expect("a valid mesh")));
        builder
    }

    pub fn bounds(&self) -> [Vec3; 2] {
        let empty = [Vec3::INFINITY, Vec3::NEG_INFINITY];
        self.positions.iter().fold(empty, |[a, b], &p| [a.min(p), b.max(p)])
    }

    /// Adds another mesh.
    pub fn add(&mut self, other: &Self) {
        let first = self.positions.len() as u32;
        self.positions.extend_from_slice(&other.positions);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + first)));
    }

    pub fn map(mut self, f: impl Fn(Vec3) -> Vec3) -> Self {
        self.positions.iter_mut().for_each(|p| *p = f(*p));
        self
    }

    /// Moved to stand at a point of the floor, so large, turned about the vertical.
    pub fn standing(self, at: Vec3, size: f32, angle: f32) -> Self {
        let [least, largest] = self.bounds();
        let foot = Vec3::new(0.5 * (least.x + largest.x), least.y, 0.5 * (least.z + largest.z));
        let turn = Mat3::from_rotation_y(angle);
        let scale = size / (largest - least).max_element();
        self.map(|p| at + turn * (p - foot) * scale)
    }

    /// Subdivided until there are so many triangles.
    ///
    /// # Source
    /// Loop, "Smooth Subdivision Surfaces Based on Triangles", 1987; edges without a neighbour are halved.
    pub fn with_at_least(mut self, triangles: usize) -> Self {
        while self.triangles.len() < triangles {
            self = self.subdivided();
        }
        self
    }

    fn subdivided(&self) -> Self {
        /// An edge: its new vertex, the corners opposite.
        struct Edge {
            middle: u32,
            opposite: Vec3,
            faces: u32,
        }
        let mut edges: HashMap<[u32; 2], Edge> = HashMap::new();
        let mut count = self.positions.len() as u32;
        let sides = |[a, b, c]: [u32; 3]| [(a, b, c), (b, c, a), (c, a, b)];
        for &triangle in &self.triangles {
            for (a, b, c) in sides(triangle) {
                let edge = edges.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                    count += 1;
                    Edge { middle: count - 1, opposite: Vec3::ZERO, faces: 0 }
                });
                edge.opposite += self.positions[c as usize];
                edge.faces += 1;
            }
        }
        let mut positions = vec![Vec3::ZERO; count as usize];
        let mut around = vec![(Vec3::ZERO, 0.0_f32, true); self.positions.len()];
        for (&[a, b], edge) in &edges {
            let ends = self.positions[a as usize] + self.positions[b as usize];
            let inner = edge.faces == 2;
            positions[edge.middle as usize] =
                if inner { ends * 0.375 + edge.opposite * 0.125 } else { ends * 0.5 };
            for (i, j) in [(a, b), (b, a)] {
                let at = &mut around[i as usize];
                *at = (at.0 + self.positions[j as usize], at.1 + 1.0, at.2 && inner);
            }
        }
        for (i, &(sum, n, inner)) in around.iter().enumerate() {
            let p = self.positions[i];
            let weight = 0.375 + 0.25 * (TAU / n).cos();
            let weight = (0.625 - weight * weight) / n;
            positions[i] = if inner && n > 2.0 { p * (1.0 - n * weight) + sum * weight } else { p };
        }
        let triangles = self.triangles.iter().flat_map(|&triangle| {
            let [ab, bc, ca] = sides(triangle).map(|(a, b, _)| edges[&[a.min(b), a.max(b)]].middle);
            let [a, b, c] = triangle;
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        });
        Self { triangles: triangles.collect(), positions }
    }
}

/// A quadrilateral.
pub fn quad(corners: [Vec3; 4]) -> Mesh {
    Mesh { positions: corners.to_vec(), triangles: vec![[0, 1, 2], [0, 2, 3]] }
}

/// A box with one corner and the opposite one.
pub fn cuboid(least: Vec3, largest: Vec3) -> Mesh {
    let pick = |i: u32| {
        Vec3::from_array(std::array::from_fn(|axis| {
            if i >> axis & 1 == 0 { least[axis] } else { largest[axis] }
        }))
    };
    let faces =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    Mesh { positions: (0..8).map(pick).collect(), triangles: triangles.collect() }
}

/// A grid of `rows × columns` quadrilaterals over the unit square; `closed` columns meet their first.
pub fn grid(rows: u32, columns: u32, closed: bool, place: impl Fn(f32, f32) -> Vec3) -> Mesh {
    let width = if closed { columns } else { columns + 1 };
    let vertices = (0..=rows).flat_map(|i| (0..width).map(move |j| (i, j)));
    let positions = vertices.map(|(i, j)| place(i as f32 / rows as f32, j as f32 / columns as f32));
    let cells = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    let triangles = cells.flat_map(|(i, j)| {
        let at = |i: u32, j: u32| i * width + j % width;
        let (a, b, c, d) = (at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        [[a, b, c], [a, c, d]]
    });
    Mesh { positions: positions.collect(), triangles: triangles.collect() }
}

/// A profile of radii and heights, turned about the vertical through a point.
pub fn lathe(at: Vec3, profile: &[[f32; 2]], columns: u32) -> Mesh {
    let rows = profile.len() as u32 - 1;
    grid(rows, columns, true, |row, column| {
        let [radius, height] = profile[(row * rows as f32).round() as usize];
        let (sin, cos) = (TAU * column).sin_cos();
        at + Vec3::new(radius * cos, height, radius * sin)
    })
}

/// The unit sphere as a subdivided octahedron.
pub fn sphere(levels: u32) -> Mesh {
    let positions = vec![Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z];
    let triangles = vec![
        [0, 1, 2],
        [3, 2, 1],
        [3, 4, 2],
        [0, 2, 4],
        [0, 5, 1],
        [3, 1, 5],
        [3, 5, 4],
        [0, 4, 5],
    ];
    let mut mesh = Mesh { positions, triangles };
    for _ in 0..levels {
        mesh = mesh.subdivided();
        mesh.positions.iter_mut().for_each(|p| *p = p.normalize());
    }
    mesh
}
