//! Strategies differ in noise, never in expectation.

use etendue_math::Spectrum;
use etendue_math::glam::{DVec3, Vec3};
use etendue_scene::light::{Light, PointLight};
use etendue_scene::{Color, Scene};

use super::scenes::{Sketch, estimate, rectangle, settings, sphere};
use crate::Strategy;

/// A glossy floor with a grey sphere, under two rectangles, a point light and a sky.
fn glossy_floor() -> Scene {
    let mut sketch = Sketch::default();
    let (grey, black) = (sketch.grey(0.5), sketch.grey(0.0));
    let metal = sketch.rough_mirror(0.3);
    sketch.shape(rectangle(DVec3::ZERO, [4.0, 4.0], DVec3::Z), metal);
    sketch.shape(sphere(DVec3::new(0.0, 2.0, 0.5), 0.5), grey);
    let large = rectangle(DVec3::new(0.0, 3.0, 2.0), [1.0, 1.0], DVec3::new(0.0, -3.0, -2.0));
    sketch.emitter(large, black, 2.0);
    let small = rectangle(DVec3::new(-1.0, 1.0, 1.0), [0.4, 0.4], DVec3::new(1.0, -1.0, -1.0));
    sketch.emitter(small, grey, 5.0);
    let (position, intensity) = (Vec3::new(1.0, 1.0, 2.0), Color::splat(3.0));
    sketch.light(Light::Point(PointLight { position, intensity }));
    sketch.sky(0.2);
    sketch.point_seen(DVec3::new(0.0, -3.0, 2.0), DVec3::ZERO)
}

#[test]
fn all_strategies_agree_on_a_glossy_scene() {
    let scene = glossy_floor();
    let run = |strategy| estimate(&scene, settings(Some(5), strategy), 60_000);
    let mis = run(Strategy::Mis);
    for other in [run(Strategy::BsdfOnly), run(Strategy::LightOnly)] {
        // 4 standard deviations of the difference.
        let error = (mis.error * mis.error + other.error * other.error).sqrt();
        assert!((mis.mean - other.mean).abs() < 4.0 * error, "{mis:?} {other:?}");
        assert!(error < 0.02 * mis.mean, "too noisy to tell: {mis:?} {other:?}");
        assert!(mis.error < 1.1 * other.error, "{mis:?} {other:?}");
    }
}
