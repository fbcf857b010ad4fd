//! Time of texture look-ups at random places: `cargo bench -p etendue-scene --bench textures`, some ten seconds.
//!
//! Images of 8 bits and of floats, one that a processor's second cache holds and one that it does not.
#![allow(missing_docs, reason = "a program")]

use core::hint::black_box;
use core::time::Duration;

use criterion::{Criterion, Throughput};
use etendue_math::Spectrum;
use etendue_sampling::{Decision, Dimension, Independent, Sampler};
use etendue_scene::Color;
use etendue_scene::texture::{
    Bitmap, BitmapImage, Checkerboard, Filter, Texture, TextureId, Textures, UvTransform, Wrap,
};

const LOOKUPS: u64 = 4096;

fn main() {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(600))
        .sample_size(20)
        .without_plots()
        .configure_from_args();
    let at = |i| Independent::at(1, [0, 0], i).sample_2d(Dimension::camera(Decision::Film));
    let places: Vec<[f32; 2]> = (0..LOOKUPS).map(at).collect();
    let mut textures = Textures::default();
    let colors = [0.2, 0.8].map(|grey| textures.constant(Color::splat(grey)));
    let mut all = vec![("constant".to_owned(), colors[0])];
    let uv = UvTransform::IDENTITY;
    let board = Checkerboard { color0: colors[0], color1: colors[1], uv };
    all.push(("checkerboard".to_owned(), textures.add(Texture::Checkerboard(board))));
    for side in [256, 4096] {
        for (kind, image) in [("bytes", bytes(side)), ("floats", floats(side))] {
            for (name, filter) in [("nearest", Filter::Nearest), ("bilinear", Filter::Bilinear)] {
                let bitmap = Bitmap::new(image.clone(), filter, Wrap::Repeat, uv);
                let id = textures.add(Texture::Bitmap(bitmap));
                all.push((format!("{kind}-{side}-{name}"), id));
            }
        }
    }
    let mut group = criterion.benchmark_group("texture");
    group.throughput(Throughput::Elements(LOOKUPS));
    for (name, id) in all {
        group.bench_function(name, |bencher| {
            bencher.iter(|| look_up(black_box(&textures), black_box(id), &places));
        });
    }
    group.finish();
    criterion.final_summary();
}

fn look_up(textures: &Textures, id: TextureId, places: &[[f32; 2]]) {
    for &uv in places {
        black_box(textures.color(id, uv));
    }
}

/// Any texels do: where they lie decides.
fn byte(i: u32) -> u8 {
    (i % 251) as u8
}

fn bytes(side: u32) -> BitmapImage {
    let data: Vec<u8> = (0..3 * side * side).map(byte).collect();
    BitmapImage::from_srgb8(side, side, 3, &data).expect("an image")
}

fn floats(side: u32) -> BitmapImage {
    let data: Vec<f32> = (0..3 * side * side).map(|i| f32::from(byte(i)) / 255.0).collect();
    BitmapImage::from_f32(side, side, 3, &data).expect("an image")
}
