//! Rays per second: `cargo bench -p etendue-scene --bench traversal [FILE]`, a scene or a mesh.
//!
//! Without a file, a bumpy sphere of 72 000 triangles stands in. One thread; three kinds of rays:
//! from a camera, from hit points in random directions, and segments between random hit points.
#![allow(missing_docs, reason = "a program")]

use core::time::Duration;
use std::path::Path;
use std::time::Instant;

use etendue_math::glam::Vec3;
use etendue_scene::geometry::{Geometry, GeometryBuilder, Ray, Shape, SurfacePoint, TriangleMesh};
use etendue_scene::{LoadOptions, load_scene};

/// Rays along each side of the camera's picture.
const SIZE: u32 = 768;

fn main() {
    // Cargo passes `--bench` along.
    let file = std::env::args().skip(1).find(|a| !a.starts_with("--"));
    let start = Instant::now();
    let (geometry, primary) = match file {
        Some(path) => {
            let options = LoadOptions { film_size: Some([SIZE; 2]), ..LoadOptions::default() };
            let scene = load_scene(Path::new(&path), &options).expect("a scene").scene;
            let rays = pixels().map(|film| scene.camera.ray(film, [0.5; 2])).collect();
            (scene.geometry, rays)
        }
        None => {
            let geometry = bumpy_sphere(120, 300);
            let rays = camera_rays(&geometry);
            (geometry, rays)
        }
    };
    let seconds = start.elapsed().as_secs_f64();
    let s = geometry.statistics();
    println!(
        "{} triangles, {} nodes, {:.1} bytes/triangle, loaded and built in {:.1} ms",
        s.triangles,
        s.nodes,
        s.bytes_per_triangle(),
        seconds * 1e3
    );

    report("primary", &primary, |ray| geometry.intersect(ray).is_some());
    let points: Vec<SurfacePoint> = primary
        .iter()
        .filter_map(|ray| Some(geometry.surface_point(ray, &geometry.intersect(ray)?)))
        .collect();
    let mut random = Random(1);
    let bounce: Vec<Ray> = points
        .iter()
        .map(|p| {
            let d = random.direction();
            p.spawn(if d.dot(p.normal) < 0.0 { -d } else { d })
        })
        .collect();
    report("bounce", &bounce, |ray| geometry.intersect(ray).is_some());
    let shadow: Vec<Ray> = points
        .iter()
        .map(|p| {
            let other = &points[(random.uniform() * points.len() as f32) as usize % points.len()];
            p.spawn_to(other.position + other.normal * (0.1 * geometry.bounds().extent().x))
        })
        .collect();
    report("shadow", &shadow, |ray| geometry.occluded(ray));
}

/// Traces all rays a few times and prints the rate that an undisturbed processor has: the sum of
/// the least times that each thousand of rays took.
fn report(name: &str, rays: &[Ray], trace: impl Fn(&Ray) -> bool) {
    let mut best = vec![Duration::MAX; rays.len().div_ceil(1000)];
    let mut hits = 0;
    for _ in 0..7 {
        hits = 0;
        for (rays, best) in rays.chunks(1000).zip(&mut best) {
            let start = Instant::now();
            hits += rays.iter().filter(|ray| trace(ray)).count();
            *best = start.elapsed().min(*best);
        }
    }
    let seconds = best.iter().sum::<Duration>().as_secs_f64();
    println!(
        "{name:8} {:6.2} Mrays/s ({} rays, {:.1} % hit)",
        rays.len() as f64 / seconds * 1e-6,
        rays.len(),
        100.0 * hits as f64 / rays.len() as f64
    );
}

/// The middles of the camera's pixels.
fn pixels() -> impl Iterator<Item = [f32; 2]> {
    let middle = |i: u32| i as f32 + 0.5;
    (0..SIZE * SIZE).map(move |i| [middle(i % SIZE), middle(i / SIZE)])
}

fn camera_rays(geometry: &Geometry) -> Vec<Ray> {
    let bounds = geometry.bounds();
    let (center, reach) = (bounds.center(), bounds.extent().max_element());
    let eye = center + Vec3::new(0.3, 0.4, 1.6) * reach;
    let forward = (center - eye).normalize();
    let right = forward.cross(Vec3::Y).normalize();
    let up = right.cross(forward);
    pixels()
        .map(|film| film.map(|pixel| 0.75 * (pixel / SIZE as f32 - 0.5)))
        .map(|[x, y]| Ray::new(eye, forward + right * x + up * y))
        .collect()
}

/// A sphere of `rows × columns` quadrilaterals with bumps.
fn bumpy_sphere(rows: u32, columns: u32) -> Geometry {
    use etendue_math::Real;
    let position = |row: u32, column: u32| {
        let theta = core::f32::consts::PI * row as f32 / rows as f32;
        let phi = core::f32::consts::TAU * column as f32 / columns as f32;
        let r = 1.0 + 0.1 * Real::sin(9.0 * theta) * Real::cos(11.0 * phi);
        let (sin, cos) = Real::sin_cos(theta);
        Vec3::new(sin * Real::cos(phi), cos, sin * Real::sin(phi)) * r
    };
    let positions =
        (0..=rows).flat_map(|i| (0..columns).map(move |j| (i, j))).map(|(i, j)| position(i, j));
    let triangles = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))).flat_map(|(i, j)| {
        let index = |i: u32, j: u32| i * columns + j % columns;
        let (a, b, c, d) = (index(i, j), index(i, j + 1), index(i + 1, j + 1), index(i + 1, j));
        [[a, b, c], [a, c, d]]
    });
    let mesh = TriangleMesh::new(positions.collect(), vec![], vec![], triangles.collect());
    let mut builder = GeometryBuilder::new();
    builder.add_shape(Shape::Mesh(mesh.expect("a valid mesh")));
    builder.build()
}

/// A small generator: the order of rays must not be what the processor's caches like.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f32 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 40) as f32 / 16777216.0
    }

    fn direction(&mut self) -> Vec3 {
        loop {
            let v = Vec3::from_array(core::array::from_fn(|_| 2.0 * self.uniform() - 1.0));
            if v.length_squared() > 1e-6 && v.length_squared() < 1.0 {
                return v.normalize();
            }
        }
    }
}
