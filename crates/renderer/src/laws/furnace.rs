//! In light that is the same everywhere, surfaces that absorb nothing are invisible.

use etendue_math::glam::DVec3;
use etendue_scene::Scene;

use super::scenes::{Sketch, estimate, rectangle, settings, sphere};
use crate::{RenderSettings, Renderer, Strategy};

/// Two white spheres on a white floor under a uniform sky: light goes to and fro between them.
fn white_spheres() -> Scene {
    let mut sketch = Sketch::default();
    let white = sketch.grey(1.0);
    sketch.shape(sphere(DVec3::new(-1.0, 0.0, 1.0), 1.0), white);
    sketch.shape(sphere(DVec3::new(1.05, 0.0, 1.0), 1.0), white);
    sketch.shape(rectangle(DVec3::ZERO, [10.0, 10.0], DVec3::Z), white);
    sketch.sky(1.0);
    sketch.point_seen(DVec3::new(0.0, -6.0, 2.0), DVec3::new(-0.15, -0.3, 0.8))
}

fn glass_sphere() -> Scene {
    let mut sketch = Sketch::default();
    let glass = sketch.glass();
    sketch.shape(sphere(DVec3::ZERO, 1.0), glass);
    sketch.sky(1.0);
    sketch.seen(DVec3::new(0.0, -4.0, 1.0), DVec3::ZERO, 40.0, [8, 8])
}

fn without_roulette(strategy: Strategy) -> RenderSettings {
    let mut settings = settings(None, strategy);
    settings.path.roulette_depth = u32::MAX;
    settings
}

#[test]
fn every_path_that_follows_a_white_surface_brings_back_exactly_the_sky() {
    let scene = white_spheres();
    let renderer = Renderer::new(&scene, without_roulette(Strategy::BsdfOnly)).expect("a thread");
    for i in 0..500 {
        let radiance = renderer.sample([0, 0], i).r;
        // A few roundings per bounce; the floor is not infinite, but paths that leave it meet
        // the sky below.
        assert!((radiance - 1.0).abs() < 1e-4, "{radiance}");
    }
}

#[test]
fn white_spheres_are_invisible_with_light_sampling_and_roulette() {
    let scene = white_spheres();
    for strategy in [Strategy::Mis, Strategy::LightOnly] {
        estimate(&scene, settings(None, strategy), 10_000).assert_is(1.0);
    }
}

#[test]
fn every_path_through_a_glass_sphere_brings_back_exactly_the_sky() {
    let scene = glass_sphere();
    let renderer = Renderer::new(&scene, without_roulette(Strategy::Mis)).expect("a thread");
    for y in 0..8 {
        for x in 0..8 {
            for i in 0..20 {
                let radiance = renderer.sample([x, y], i);
                // Radiance is divided by η² on the way in and multiplied on the way out.
                assert!((radiance.g - 1.0).abs() < 1e-4, "{radiance:?}");
            }
        }
    }
}

#[test]
fn roulette_leaves_the_glass_sphere_invisible_on_average() {
    let mut settings = settings(None, Strategy::Mis);
    settings.path.roulette_depth = 1;
    settings.samples_per_pixel = 400;
    let scene = glass_sphere();
    let rendering = Renderer::new(&scene, settings)
        .expect("a thread")
        .render(&|_| (), &core::sync::atomic::AtomicBool::new(false));
    // 25 600 paths of two or three bounces, each surviving with 0.95: relative variance about
    // 0.15 per path, standard error 0.0025; four of them.
    assert!((rendering.image.mean().r - 1.0).abs() < 0.01, "{:?}", rendering.image.mean());
}
