//! How many edges a path has.

use etendue_math::glam::DVec3;
use etendue_scene::Scene;
use etendue_scene::material::Material;

use super::scenes::{Sketch, estimate, rectangle, settings, sphere};
use crate::Strategy;

const ALBEDO: f64 = 0.5;

/// Inside a sphere whose wall emits 1 and reflects half.
fn glowing_hollow() -> Scene {
    let mut sketch = Sketch::default();
    let wall = sketch.grey(ALBEDO as f32);
    sketch.emitter(sphere(DVec3::ZERO, 1.0).flipped(), wall, 1.0);
    sketch.point_seen(DVec3::new(0.1, -0.3, 0.0), DVec3::new(0.0, 0.0, 0.9))
}

#[test]
fn each_edge_adds_one_term_of_the_geometric_series() {
    let scene = glowing_hollow();
    for depth in 0..5 {
        let series: f64 = (0..depth).map(|k| etendue_math::Real::powi(ALBEDO, k)).sum();
        estimate(&scene, settings(Some(depth), Strategy::Mis), 10_000).assert_is(series);
    }
}

#[test]
fn unlimited_paths_sum_the_series_with_and_without_roulette() {
    let scene = glowing_hollow();
    for roulette_depth in [1, 5, u32::MAX] {
        for strategy in [Strategy::Mis, Strategy::BsdfOnly] {
            let mut settings = settings(None, strategy);
            settings.path.roulette_depth = roulette_depth;
            estimate(&scene, settings, 4000).assert_is(1.0 / (1.0 - ALBEDO));
        }
    }
}

/// A grey floor under a sky, inside `shells` nested spheres that are not there.
fn inside_shells(shells: u32) -> Scene {
    let mut sketch = Sketch::default();
    let (grey, null) = (sketch.grey(0.5), sketch.material(Material::Null));
    sketch.shape(rectangle(DVec3::ZERO, [5.0, 5.0], DVec3::Z), grey);
    for i in 0..shells {
        sketch.shape(sphere(DVec3::ZERO, 10.0 + f64::from(i)), null);
    }
    sketch.sky(1.0);
    sketch.point_seen(DVec3::new(0.0, 0.0, 20.0), DVec3::ZERO)
}

#[test]
fn surfaces_that_are_not_there_count_as_edges() {
    // Camera, two shells, floor, two shells, sky: six edges.
    let scene = inside_shells(2);
    estimate(&scene, settings(Some(5), Strategy::Mis), 100).assert_is(0.0);
    estimate(&scene, settings(Some(6), Strategy::Mis), 20_000).assert_is(0.5);
    estimate(&scene, settings(None, Strategy::Mis), 20_000).assert_is(0.5);
}

/// The mean of the first pixel, with emitters shown and hidden.
fn shown_and_hidden(scene: &Scene) -> [f64; 2] {
    [false, true].map(|hide_emitters| {
        let mut settings = settings(None, Strategy::Mis);
        settings.path.hide_emitters = hide_emitters;
        estimate(scene, settings, 4000).mean
    })
}

#[test]
fn hidden_emitters_are_looked_through_but_still_light_the_scene() {
    let mut sketch = Sketch::default();
    let (grey, black) = (sketch.grey(0.5), sketch.grey(0.0));
    sketch.shape(rectangle(DVec3::ZERO, [5.0, 5.0], DVec3::Z), grey);
    // Between camera and floor, towards the floor: seen from behind it is black.
    sketch.emitter(rectangle(DVec3::Z * 2.0, [1.0, 1.0], -DVec3::Z), black, 4.0);
    let scene = sketch.point_seen(DVec3::new(0.0, 0.0, 3.0), DVec3::ZERO);
    let [shown, hidden] = shown_and_hidden(&scene);
    assert_eq!(shown, 0.0);
    // Form factor of a 2 × 2 square from a point below its middle at distance 2, four times
    // F = 1/2π · 2 · a/√(1+a²) atan(a/√(1+a²)) with a = ½: 0.2395. Times albedo ½, radiance 4.
    assert!((hidden - 2.0 * 0.2395).abs() < 0.02, "{hidden}");
}

#[test]
fn a_hidden_sky_is_black_behind_the_scene() {
    let mut sketch = Sketch::default();
    sketch.sky(1.0);
    assert_eq!(shown_and_hidden(&sketch.point_seen(DVec3::ZERO, DVec3::Y)), [1.0, 0.0]);
    // Through surfaces that are not there, it is still directly visible.
    let mut sketch = Sketch::default();
    let null = sketch.material(Material::Null);
    sketch.shape(sphere(DVec3::ZERO, 1.0), null);
    sketch.sky(1.0);
    assert_eq!(shown_and_hidden(&sketch.point_seen(DVec3::ZERO, DVec3::Y)), [1.0, 0.0]);
}
