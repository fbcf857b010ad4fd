//! Time of choosing one of 1 to 10⁵ lights, and of asking for the probability of one: `cargo bench -p etendue-renderer --bench
//! lights`, some ten seconds. Emitting triangles and receivers are scattered in a cube.
#![allow(missing_docs, reason = "a program")]

use core::hint::black_box;
use core::time::Duration;

use criterion::{Criterion, Throughput};
use etendue_math::Spectrum;
use etendue_math::glam::Vec3;
use etendue_renderer::{LightSampler, Receiver, Sides};
use etendue_sampling::{Decision, Dimension, Independent, Sampler, warp::uniform_sphere};
use etendue_scene::camera::{Camera, FieldOfView, FovAxis, Projection};
use etendue_scene::film::Film;
use etendue_scene::geometry::{GeometryBuilder, Shape, Transform, TriangleMesh};
use etendue_scene::light::{AreaLight, Light, LightId};
use etendue_scene::material::{Material, Materials};
use etendue_scene::medium::Media;
use etendue_scene::scene::{PathSettings, SamplingSettings, SceneParts, SurfaceInfo};
use etendue_scene::texture::Textures;
use etendue_scene::{Color, Scene};

const RECEIVERS: u64 = 1024;
const LAMPS: [u32; 6] = [1, 10, 100, 1000, 10_000, 100_000];

fn main() {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .sample_size(20)
        .without_plots()
        .configure_from_args();
    let receivers: Vec<(Receiver, f32)> = (0..RECEIVERS).map(receiver).collect();
    let mut group = criterion.benchmark_group("lights");
    group.throughput(Throughput::Elements(RECEIVERS));
    for lamps in LAMPS {
        let lights = LightSampler::new(&lit_by(lamps));
        assert_eq!(lights.count(), lamps as usize);
        group.bench_function(format!("choose-{lamps}"), |bencher| {
            bencher.iter(|| {
                for (receiver, u) in &receivers {
                    black_box(lights.choose(black_box(receiver), *u));
                }
            });
        });
        group.bench_function(format!("probability-{lamps}"), |bencher| {
            bencher.iter(|| {
                for (i, (receiver, _)) in (0..).zip(&receivers) {
                    let lamp = i * 7919 % lamps;
                    black_box(lights.probability(black_box(receiver), LightId(0), lamp));
                }
            });
        });
    }
    group.finish();
    criterion.final_summary();
}

/// The `i`-th place in the cube [-1, 1]³, and a direction there.
fn place(seed: u64, i: u64) -> (Vec3, Vec3) {
    let random = Independent::at(seed, [0, 0], i);
    let [x, y]: [f32; 2] = random.sample_2d(Dimension::camera(Decision::Film));
    let z: f32 = random.sample_1d(Dimension::camera(Decision::Lens));
    let direction: [f32; 2] = random.sample_2d(Dimension::camera(Decision::Direction));
    (Vec3::new(x, y, z) * 2.0 - 1.0, uniform_sphere::from_square(direction))
}

fn receiver(i: u64) -> (Receiver, f32) {
    let (position, normal) = place(1, i);
    let u = Independent::at(1, [0, 0], i).sample_1d(Dimension::camera(Decision::LightChoice));
    (Receiver { position, normal, sides: Sides::Front }, u)
}

/// A scene that is one mesh of emitting triangles.
fn lit_by(lamps: u32) -> Scene {
    let corners = (0..3 * u64::from(lamps)).map(|i| {
        let (centre, _) = place(2, i / 3);
        centre + place(3, i).1 * 0.01
    });
    let triangles = (0..lamps).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
    let mesh = TriangleMesh::new(corners.collect(), vec![], vec![], triangles.collect());
    let mut builder = GeometryBuilder::new();
    let shape = builder.add_shape(Shape::Mesh(mesh.expect("a valid mesh")));
    let mut textures = Textures::default();
    let radiance = textures.constant(Color::splat(1.0));
    let mut materials = Materials::default();
    let material =
        materials.add(Material::Diffuse { reflectance: radiance }).expect("a simple material");
    let field_of_view = FieldOfView::Angle { degrees: 40.0, axis: FovAxis::X };
    let projection = Projection::Perspective { field_of_view, principal_point_offset: [0.0; 2] };
    let camera = Camera::new(projection, Transform::IDENTITY, 0.1, 10.0, [1, 1]);
    Scene::new(SceneParts {
        geometry: builder.build(),
        surfaces: vec![SurfaceInfo {
            material,
            light: Some(LightId(0)),
            boundary: None,
            name: "lamps".into(),
        }],
        materials,
        textures,
        lights: vec![Light::Area(AreaLight { shape, radiance })],
        media: Media::default(),
        camera: camera.expect("a valid camera"),
        film: Film::new([1, 1]),
        sampling: SamplingSettings::default(),
        path: PathSettings::default(),
    })
    .expect("a scene")
}
