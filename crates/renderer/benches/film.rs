//! Time from two uniforms and a radiance to a pixel, by reconstruction filter: `cargo bench -p etendue-renderer --bench film`, a few
//! seconds.
#![allow(missing_docs, reason = "a program")]

use core::hint::black_box;
use core::time::Duration;

use criterion::{Criterion, Throughput};
use etendue_math::Spectrum;
use etendue_renderer::{FilterSampler, PixelSum};
use etendue_sampling::{Decision, Dimension, Independent, Sampler};
use etendue_scene::Color;
use etendue_scene::film::{Film, ReconstructionFilter};

const SAMPLES: u64 = 1024;

fn main() {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .sample_size(20)
        .without_plots()
        .configure_from_args();
    let at = |i| Independent::at(1, [0, 0], i).sample_2d(Dimension::camera(Decision::Film));
    let uniforms: Vec<[f32; 2]> = (0..SAMPLES).map(at).collect();
    let mut group = criterion.benchmark_group("film");
    group.throughput(Throughput::Elements(SAMPLES));
    for (name, filter) in [
        ("box", ReconstructionFilter::Box { radius: 0.5 }),
        ("gaussian", ReconstructionFilter::default()),
    ] {
        let film = Film { filter, ..Film::new([64, 64]) };
        let sampler = FilterSampler::new(&film);
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                let pixel = sampler.pixel(black_box([31, 31]));
                let mut sum = PixelSum::default();
                for &u in &uniforms {
                    let sample = pixel.sample(u);
                    black_box(sum.add(Color::splat(sample.weight * sample.position[0])));
                }
                sum.mean()
            });
        });
    }
    group.finish();
    criterion.final_summary();
}
