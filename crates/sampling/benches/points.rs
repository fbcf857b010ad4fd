//! Time of random numbers, warps and tabulated choices, in calls per second: `cargo bench -p etendue-sampling --bench points`.
//!
//! Half a minute; a trailing `-- warp` restricts the run.
#![allow(missing_docs, reason = "a program")]

use core::hint::black_box;
use core::time::Duration;

use criterion::{Criterion, Throughput};
use etendue_math::glam::Vec3;
use etendue_sampling::warp::rectangle::Rectangle;
use etendue_sampling::warp::seen_sphere::SeenSphere;
use etendue_sampling::warp::spherical_rectangle::SphericalRectangle;
use etendue_sampling::warp::spherical_triangle::SphericalTriangle;
use etendue_sampling::warp::{cosine_hemisphere, disk, triangle, uniform_sphere};
use etendue_sampling::{
    Decision, Dimension, Independent, Sampler, Sobol, Tabulated1d, Tabulated2d,
};

/// Calls per iteration.
const CALLS: u32 = 256;

fn main() {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .sample_size(20)
        .without_plots()
        .configure_from_args();
    sampler::<Independent>(&mut criterion, "independent");
    sampler::<Sobol>(&mut criterion, "sobol");
    warps(&mut criterion);
    tables(&mut criterion);
    criterion.final_summary();
}

/// Numbers of one decision in consecutive samples of a pixel, the address included.
fn sampler<S: Sampler>(criterion: &mut Criterion, name: &str) {
    let dimension = Dimension::vertex(1, Decision::Direction);
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(CALLS.into()));
    let at = |sample| S::at(black_box(7), [12, 34], u64::from(sample));
    group.bench_function("1d", |bencher| {
        bencher.iter(|| {
            (0..CALLS).for_each(|i| _ = black_box(at(i).sample_1d::<f32>(dimension)));
        });
    });
    group.bench_function("2d", |bencher| {
        bencher.iter(|| {
            (0..CALLS).for_each(|i| _ = black_box(at(i).sample_2d::<f32>(dimension)));
        });
    });
    group.finish();
}

fn uniforms() -> Vec<[f32; 2]> {
    let at = |i| Sobol::at(1, [0, 0], i).sample_2d(Dimension::camera(Decision::Film));
    (0..u64::from(CALLS)).map(at).collect()
}

fn warps(criterion: &mut Criterion) {
    let uniforms = uniforms();
    let mut group = criterion.benchmark_group("warp");
    group.throughput(Throughput::Elements(CALLS.into()));
    let mut over = |name: &str, call: &dyn Fn(&[[f32; 2]])| {
        group.bench_function(name, |bencher| bencher.iter(|| call(black_box(&uniforms))));
    };
    over("disk", &|uniforms| each(uniforms, disk::from_square));
    over("uniform-sphere", &|uniforms| each(uniforms, uniform_sphere::from_square));
    over("cosine-hemisphere", &|uniforms| each(uniforms, cosine_hemisphere::from_square));
    over("triangle", &|uniforms| each(uniforms, triangle::from_square));

    // What is seen is looked at anew by every point of a surface: the set-up counts.
    let center = black_box(Vec3::new(0.3, -0.4, 3.0));
    over("seen-sphere", &|uniforms| {
        each(uniforms, |u| SeenSphere::new(center, 0.5)?.from_square(u));
    });
    let rectangle = black_box(Rectangle { corner: center, edges: [Vec3::X, Vec3::Y] });
    over("spherical-rectangle", &|uniforms| {
        each(uniforms, |u| Some(SphericalRectangle::new(rectangle)?.from_square(u)));
    });
    let vertices = black_box([center, center + Vec3::X, center + Vec3::Y]);
    over("spherical-triangle", &|uniforms| {
        each(uniforms, |u| Some(SphericalTriangle::new(vertices)?.from_square(u)));
    });
    group.finish();
}

fn each<R>(uniforms: &[[f32; 2]], call: impl Fn([f32; 2]) -> R) {
    for &u in uniforms {
        black_box(call(u));
    }
}

/// Tables of the size of a few lamps and of environment maps.
fn tables(criterion: &mut Criterion) {
    let uniforms = uniforms();
    let weight = |i: usize| 1.0 + (i * 7919 % 97) as f32;
    let mut group = criterion.benchmark_group("tabulated");
    group.throughput(Throughput::Elements(CALLS.into()));
    for entries in [16, 4096] {
        let weights: Vec<f32> = (0..entries).map(weight).collect();
        let mut storage = vec![0.0; entries + 1];
        let table = Tabulated1d::build(&weights, &mut storage).expect("positive weights");
        group.bench_function(format!("1d-{entries}"), |bencher| {
            bencher.iter(|| each(black_box(&uniforms), |[u, _]| table.choose(u)));
        });
    }
    for [width, height] in [[64, 32], [2048, 1024]] {
        let weights: Vec<f32> = (0..width * height).map(weight).collect();
        let mut storage = vec![0.0; Tabulated2d::<f32>::storage_len(width, height).expect("sides")];
        let table =
            Tabulated2d::build(&weights, width, height, &mut storage).expect("positive weights");
        group.bench_function(format!("2d-{width}x{height}"), |bencher| {
            bencher.iter(|| each(black_box(&uniforms), |u| table.sample(u)));
        });
    }
    group.finish();
}
