//! Features are those of what is seen.

use core::sync::atomic::AtomicBool;

use etendue_brdf::Bsdf;
use etendue_math::glam::{DVec3, Vec3};
use etendue_math::{Real, Spectrum};
use etendue_scene::camera::Sight;
use etendue_scene::color::Primaries;
use etendue_scene::geometry::Ray;
use etendue_scene::material::{PreparedMaterials, Side, Varying};
use etendue_scene::{Color, Scene};

use super::scenes::{Sketch, rectangle, settings, sphere};
use crate::{Features, RenderSettings, Renderer, Strategy};

fn features(scene: &Scene, samples: u32, settings: RenderSettings) -> Vec<Features> {
    let renderer = Renderer::new(scene, settings).expect("threads");
    renderer.features(samples, &AtomicBool::new(false))
}

#[test]
fn a_floor_seen_from_above_has_its_albedo_normal_depth_and_place() {
    let mut sketch = Sketch::default();
    let (grey, black) = (sketch.grey(0.25), sketch.grey(0.0));
    // Somewhere the camera does not look, and then the floor, whose size is 2 × 6.
    sketch.shape(sphere(DVec3::Z * 9.0, 1.0), black);
    sketch.shape(rectangle(DVec3::new(1.0, 0.0, -1.0), [3.0, 1.0], DVec3::Z), grey);
    let scene = sketch.seen(DVec3::new(0.0, 0.0, 3.0), DVec3::ZERO, 10.0, [8, 8]);
    let features = features(&scene, 16, settings(None, Strategy::Mis));
    let (floor, nothing): (Vec<Features>, Vec<Features>) =
        features.into_iter().partition(|pixel| pixel.shape > 0);
    // The floor's edge goes through the camera's axis: half of the pixels show it, and only it.
    assert_eq!((floor.len(), nothing.len()), (32, 32));
    for pixel in floor {
        assert_eq!(pixel.albedo, Color::splat(0.25));
        assert_eq!((pixel.normal, pixel.shape), ([0.0, 0.0, 1.0], 2));
        // The plane z = −1 is 4 away whatever the direction; f32 rounds to 5e-7.
        assert!((pixel.depth - 4.0).abs() < 1e-6, "{pixel:?}");
        let [x, y, z] = pixel.position;
        // tan 5° × 4 to either side.
        assert!((z + 1.0).abs() < 1e-6 && x.abs() < 0.35 && y.abs() < 0.35, "{pixel:?}");
        // u runs over 6 units, v over 2, from a corner.
        assert!(pixel.uv.iter().all(|t| (0.0..1.0).contains(t)), "{pixel:?}");
    }
    assert!(nothing.iter().all(|&pixel| pixel == Features::NOTHING));
}

#[test]
fn pixels_that_are_partly_covered_show_a_part() {
    let mut sketch = Sketch::default();
    let grey = sketch.grey(0.5);
    sketch.shape(rectangle(DVec3::new(1.0, 0.0, 0.0), [3.0, 1.0], DVec3::Z), grey);
    let scene = sketch.seen(DVec3::new(0.0, 0.0, 3.0), DVec3::ZERO, 10.0, [1, 1]);
    let pixel = features(&scene, 4096, settings(None, Strategy::Mis))[0];
    // Half of 4096 samples: 0.5 ± 0.008; four of them.
    assert!((pixel.normal[2] - 0.5).abs() < 0.032, "{pixel:?}");
    assert!((pixel.albedo.r - 0.25).abs() < 0.016, "{pixel:?}");
    // What is not there has no depth.
    assert!((pixel.depth - 3.0).abs() < 1e-6, "{pixel:?}");
}

#[test]
fn an_albedo_without_a_closed_form_is_estimated() {
    let mut sketch = Sketch::default();
    let metal = sketch.rough_mirror(0.5);
    sketch.shape(rectangle(DVec3::ZERO, [4.0, 4.0], DVec3::Z), metal);
    sketch.sky(1.0);
    let scene = sketch.point_seen(DVec3::new(0.0, -1.0, 1.0), DVec3::ZERO);
    let materials =
        PreparedMaterials::new(&scene.materials, &scene.textures, &scene.geometry, Sight::SHARP);
    let ray = Ray::new(Vec3::Z, -Vec3::Z);
    let hit = scene.geometry.intersect(&ray).expect("the metal is below");
    let point = scene.geometry.surface_point(&ray, &hit);
    let mut varying = Varying::default();
    let model = materials.at(metal, &point, Side::Front, Primaries, &mut varying);
    let wo = Vec3::new(0.0, -1.0, 1.0) * core::f32::consts::FRAC_1_SQRT_2;
    assert!(model.albedo(wo).is_none(), "no closed form");
    let albedo = features(&scene, 20_000, settings(None, Strategy::Mis))[0].albedo.r;
    // What reflects a sky of radiance 1 by one bounce has the albedo as its radiance.
    let renderer = Renderer::new(&scene, settings(Some(2), Strategy::BsdfOnly)).expect("a thread");
    let radiance = (0..20_000).map(|i| f64::from(renderer.sample([0, 0], i).r)).sum::<f64>() / 2e4;
    // The same samples, summed in another precision.
    assert!((f64::from(albedo) - radiance).abs() < 1e-5, "{albedo} {radiance}");
    assert!((0.6..0.75).contains(&albedo), "some light is lost between facets: {albedo}");
}

#[test]
fn features_look_through_hidden_emitters_and_are_the_same_on_any_number_of_threads() {
    let mut sketch = Sketch::default();
    let (grey, black) = (sketch.grey(0.5), sketch.grey(0.0));
    sketch.shape(sphere(DVec3::ZERO, 1.0), grey);
    sketch.emitter(rectangle(DVec3::Z * 2.0, [9.0, 9.0], DVec3::Z), black, 4.0);
    let scene = sketch.seen(DVec3::new(0.0, 0.0, 4.0), DVec3::ZERO, 20.0, [33, 17]);
    let with = |threads, hide_emitters| {
        let mut settings = RenderSettings { threads, ..settings(None, Strategy::Mis) };
        settings.path.hide_emitters = hide_emitters;
        features(&scene, 4, settings)
    };
    let middle = 8 * 33 + 16;
    let (shown, hidden) = (with(1, false), with(1, true));
    assert_eq!((shown[middle].shape, hidden[middle].shape), (2, 1));
    // The nearest point of the sphere, seen through four samples of a pixel 0.02 wide.
    assert!((hidden[middle].depth - 3.0).abs() < 1e-3 && (shown[middle].depth - 2.0).abs() < 1e-5);
    assert_eq!(hidden, with(7, true));
    let up = Real::sqrt(hidden[middle].normal.map(|n| n * n).iter().sum::<f32>());
    assert!(up <= 1.0 + f32::EPSILON);
}
