//! Samples that go where the error is do not change what pictures converge to.

use etendue_math::glam::DVec3;
use etendue_math::special::erf;
use etendue_math::{Real, Spectrum};
use etendue_scene::Scene;

use super::scenes::{Sketch, rectangle, settings, sphere};
use crate::progressive::{Allocation, Goal, Halt};
use crate::{Image, RenderSettings, Renderer, Strategy};

pub(super) const SIZE: [u32; 2] = [12, 12];
pub(super) const PIXELS: usize = 144;

/// A floor with a sphere under a rectangle of half width `half`.
pub(super) fn lit_floor(half: f64) -> Scene {
    let mut sketch = Sketch::default();
    let (grey, black) = (sketch.grey(0.7), sketch.grey(0.0));
    sketch.shape(rectangle(DVec3::ZERO, [4.0, 4.0], DVec3::Z), grey);
    sketch.shape(sphere(DVec3::new(0.3, 0.0, 0.7), 0.7), grey);
    let lamp = rectangle(DVec3::new(1.0, 1.0, 3.0), [half, half], -DVec3::Z);
    sketch.emitter(lamp, black, 1.0 / (half * half) as f32);
    sketch.seen(DVec3::new(0.0, -4.0, 2.0), DVec3::ZERO, 60.0, SIZE)
}

/// Sums over many pictures.
pub(super) struct Sums {
    pictures: f64,
    /// Σx and Σx² of the mean of each pixel's channels, and of that of the picture.
    pixels: Vec<[f64; 2]>,
    picture: [f64; 2],
}

impl Sums {
    pub(super) fn of(count: u64, render: impl Fn(u64) -> Image) -> Self {
        let mut sums =
            Self { pictures: count as f64, pixels: vec![[0.0; 2]; PIXELS], picture: [0.0; 2] };
        let add = |sums: &mut [f64; 2], x: f64| {
            sums[0] += x;
            sums[1] += x * x;
        };
        for image in (0..count).map(render) {
            for (sums, pixel) in sums.pixels.iter_mut().zip(image.pixels()) {
                add(sums, f64::from(pixel.mean()));
            }
            add(&mut sums.picture, f64::from(image.mean().mean()));
        }
        sums
    }

    /// Mean and squared standard error.
    fn mean(&self, [sum, squares]: [f64; 2]) -> [f64; 2] {
        let mean = sum / self.pictures;
        [mean, (squares / self.pictures - mean * mean) / (self.pictures - 1.0)]
    }
}

/// Difference in standard errors; 0 where neither varies and both are equal.
fn z([a, var_a]: [f64; 2], [b, var_b]: [f64; 2]) -> f64 {
    if a == b { 0.0 } else { (a - b) / (var_a + var_b).safe_sqrt() }
}

/// The probability that a normal variable is at least as far from 0.
fn two_sided(z: f64) -> f64 {
    1.0 - erf(z.abs() * core::f64::consts::FRAC_1_SQRT_2)
}

/// Asserts that two ways of rendering have the same expectation in every pixel and as a whole; `alike` pixels have errors in common.
pub(super) fn assert_equal_means(a: &Sums, b: &Sums, alike: f64) {
    let zs: Vec<f64> =
        a.pixels.iter().zip(&b.pixels).map(|(&x, &y)| z(a.mean(x), b.mean(y))).collect();
    // Šidák: one false alarm in 100 for all pixels together.
    let each = 1.0 - Real::powf(0.99, 1.0 / PIXELS as f64);
    let worst = zs.iter().copied().fold(0.0, |worst: f64, z| worst.max(z.abs()));
    assert!(two_sided(worst) > each, "{worst}");
    // Σz² of n pixels is χ² with n degrees of freedom: mean n, variance 2n, times the pixels that have errors in common; 4 standard
    // deviations.
    let squares: f64 = zs.iter().map(|z| z * z).sum();
    let n = PIXELS as f64;
    assert!((squares - n).abs() < 4.0 * Real::sqrt(2.0 * n * alike), "{squares}");
    assert!(z(a.mean(a.picture), b.mean(b.picture)).abs() < 4.0);
}

fn goal(allocation: Allocation) -> Goal {
    Goal { allocation, samples_per_pixel: Some(40), error: None }
}

fn renderer(scene: &Scene, strategy: Strategy, seed: u64) -> Renderer<'_> {
    let settings = RenderSettings { seed, ..settings(Some(3), strategy) };
    Renderer::new(scene, settings).expect("a thread")
}

fn draw(scene: &Scene, strategy: Strategy, allocation: Allocation, count: u64, seed: u64) -> Sums {
    Sums::of(count, |i| {
        let renderer = renderer(scene, strategy, seed + i);
        renderer.render_progressively(&goal(allocation), &|_| (), &|| Halt::No).image
    })
}

#[test]
fn every_pixel_has_the_mean_of_uniform_sampling() {
    let scene = lit_floor(0.5);
    let draw = |allocation, seed| draw(&scene, Strategy::Mis, allocation, 500, seed);
    let uniform = draw(Allocation::Uniform, 0);
    let adaptive = draw(Allocation::Adaptive, 10_000);
    assert_equal_means(&uniform, &adaptive, 1.0);
}

#[test]
fn light_found_by_one_sample_in_a_thousand_is_kept_where_own_samples_would_lose_it() {
    const PICTURES: u64 = 1500;
    // A small lamp that only scattered rays find.
    let scene = lit_floor(0.1);
    let draw = |allocation, seed| draw(&scene, Strategy::BsdfOnly, allocation, PICTURES, seed);
    let uniform = draw(Allocation::Uniform, 0);
    let adaptive = draw(Allocation::Adaptive, 10_000);
    let own = Sums::of(PICTURES, |i| {
        let renderer = renderer(&scene, Strategy::BsdfOnly, 20_000 + i);
        renderer.render_guided_by_own_samples(&goal(Allocation::Adaptive)).image
    });
    let [uniform, adaptive, own] = [uniform, adaptive, own].map(|sums| sums.mean(sums.picture));
    // 4 standard errors of the difference.
    assert!(z(uniform, adaptive).abs() < 4.0, "{uniform:?} {adaptive:?}");
    assert!(z(uniform, own) > 10.0, "{uniform:?} {own:?}");
}
