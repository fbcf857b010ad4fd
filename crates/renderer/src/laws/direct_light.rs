//! Direct light against closed forms.

use etendue_math::glam::{DVec3, Vec3};
use etendue_math::{Real, Spectrum};
use etendue_scene::light::{ConstantLight, DirectionalLight, Light, PointLight};
use etendue_scene::{Color, Scene};

use super::scenes::{Sketch, estimate, rectangle, settings, sphere};
use crate::{Renderer, Strategy};

const ALBEDO: f32 = 0.6;
const EYE: DVec3 = DVec3::new(3.0, -2.0, 2.5);

/// A floor of albedo 0.6, seen at the origin.
fn floor(light: impl FnOnce(&mut Sketch)) -> Scene {
    let mut sketch = Sketch::default();
    let grey = sketch.grey(ALBEDO);
    sketch.shape(rectangle(DVec3::ZERO, [5.0, 5.0], DVec3::Z), grey);
    light(&mut sketch);
    sketch.point_seen(EYE, DVec3::ZERO)
}

#[test]
fn a_rectangle_overhead_gives_the_closed_form_by_every_strategy() {
    const RADIANCE: f32 = 3.0;
    let scene = floor(|sketch| {
        let black = sketch.grey(0.0);
        let overhead = DVec3::new(0.0, 0.0, 1.5);
        sketch.emitter(rectangle(overhead, [1.0, 0.5], -DVec3::Z), black, RADIANCE);
    });
    // Form factor of a parallel rectangle with a corner above the point, four times:
    // F = 1/2π (a/√(1+a²) atan(b/√(1+a²)) + b/√(1+b²) atan(a/√(1+b²))), sides over distance.
    let [a, b] = [1.0 / 1.5, 0.5 / 1.5_f64];
    let term = |a: f64, b: f64| {
        let root = Real::sqrt(1.0 + a * a);
        a / root * Real::atan(b / root)
    };
    let form_factor = 4.0 * (term(a, b) + term(b, a)) / (2.0 * f64::PI);
    let expected = f64::from(ALBEDO) * f64::from(RADIANCE) * form_factor;
    for strategy in [Strategy::Mis, Strategy::BsdfOnly, Strategy::LightOnly] {
        estimate(&scene, settings(Some(2), strategy), 40_000).assert_is(expected);
    }
}

#[test]
fn a_sphere_light_gives_the_closed_form_by_every_strategy() {
    let scene = floor(|sketch| {
        let black = sketch.grey(0.0);
        sketch.emitter(sphere(DVec3::new(0.0, 1.2, 1.6), 0.8), black, 2.0);
    });
    // A sphere wholly above the horizon: E = π L (r/d)² cos θ, with d = 2 and cos θ = 0.8.
    let expected = f64::from(ALBEDO) * 2.0 * 0.16 * 0.8;
    for strategy in [Strategy::Mis, Strategy::BsdfOnly, Strategy::LightOnly] {
        estimate(&scene, settings(Some(2), strategy), 40_000).assert_is(expected);
    }
}

#[test]
fn a_point_light_gives_intensity_times_cosine_over_squared_distance_in_every_sample() {
    let position = Vec3::new(0.0, 3.0, 4.0);
    let intensity = Color::splat(50.0);
    let scene = floor(|sketch| sketch.light(Light::Point(PointLight { position, intensity })));
    let expected = ALBEDO * f32::FRAC_1_PI * 50.0 * 0.8 / 25.0;
    for strategy in [Strategy::Mis, Strategy::BsdfOnly, Strategy::LightOnly] {
        let renderer = Renderer::new(&scene, settings(Some(2), strategy)).expect("a thread");
        for i in 0..20 {
            let radiance = renderer.sample([0, 0], i).r;
            // The pixel is 6·10⁻⁵ wide where it meets the floor.
            assert!((radiance / expected - 1.0).abs() < 1e-4, "{radiance} {expected}");
        }
    }
}

#[test]
fn lights_infinitely_far_away_add_up() {
    let scene = floor(|sketch| {
        sketch.sky(0.5);
        sketch.light(Light::Constant(ConstantLight { radiance: Color::splat(0.25) }));
        let direction = Vec3::new(0.0, -0.6, -0.8);
        let irradiance = Color::splat(2.0);
        sketch.light(Light::Directional(DirectionalLight { direction, irradiance }));
    });
    let expected = f64::from(ALBEDO) * (0.75 + 2.0 * 0.8 * f64::FRAC_1_PI);
    for strategy in [Strategy::Mis, Strategy::BsdfOnly, Strategy::LightOnly] {
        estimate(&scene, settings(Some(2), strategy), 40_000).assert_is(expected);
    }
}

#[test]
fn what_stands_between_casts_a_shadow() {
    let scene = floor(|sketch| {
        let black = sketch.grey(0.0);
        sketch.shape(sphere(DVec3::new(0.0, 1.5, 2.0), 0.3), black);
        let (position, intensity) = (Vec3::new(0.0, 3.0, 4.0), Color::white());
        sketch.light(Light::Point(PointLight { position, intensity }));
    });
    let renderer = Renderer::new(&scene, settings(None, Strategy::Mis)).expect("a thread");
    assert_eq!(renderer.sample([0, 0], 0), Color::black());
}
