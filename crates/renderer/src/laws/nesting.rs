//! Transparent bodies that overlap.

use etendue_brdf::Ior;
use etendue_math::Spectrum;
use etendue_math::glam::DVec3;
use etendue_scene::material::{Material, MaterialId, Nesting};
use etendue_scene::{Color, Scene};

use super::scenes::{Sketch, settings, sphere};
use crate::{Renderer, Strategy};

/// A body of an index and a priority, in air.
fn body(sketch: &mut Sketch, index: f32, priority: Option<i32>) -> MaterialId {
    let white = sketch.textures.constant(Color::white());
    let nesting = |priority| Nesting { priority, interior: index, exterior: 1.0 };
    sketch.material(Material::Dielectric {
        eta: Ior::new(index).expect("an index"),
        dispersion: None,
        nesting: priority.map(nesting),
        roughness: None,
        specular_reflectance: white,
        specular_transmittance: white,
    })
}

/// Balls of `(radius, height of the centre, index, priority)` under a sky with a bright patch, seen from the side.
fn balls(balls: &[(f64, f64, f32, Option<i32>)]) -> Scene {
    let mut sketch = Sketch::default();
    for &(radius, height, index, priority) in balls {
        let material = body(&mut sketch, index, priority);
        sketch.shape(sphere(DVec3::new(0.0, 0.0, height), radius), material);
    }
    let black = sketch.grey(0.0);
    sketch.emitter(sphere(DVec3::new(0.5, 3.0, 0.5), 0.7), black, 2.0);
    sketch.sky(0.5);
    sketch.seen(DVec3::new(0.0, -4.0, 0.7), DVec3::ZERO, 40.0, [6, 6])
}

/// What every pixel sees of some samples.
fn seen(scene: &Scene) -> Vec<Color> {
    let renderer = Renderer::new(scene, settings(None, Strategy::Mis)).expect("a thread");
    let pixels = (0..36).map(|i| [i % 6, i / 6]);
    pixels
        .flat_map(|pixel| (0..50).map(move |i| (pixel, i)))
        .map(|(p, i)| renderer.sample(p, i))
        .collect()
}

/// Mean of all of them.
fn mean(samples: &[Color]) -> f64 {
    samples.iter().map(|color| f64::from(color.g)).sum::<f64>() / samples.len() as f64
}

#[test]
fn a_body_by_itself_looks_as_it_does_without_a_priority() {
    let [nested, plain] =
        [Some(3), None].map(|priority| seen(&balls(&[(1.0, 0.0, 1.5, priority)])));
    assert_eq!(nested, plain);
}

#[test]
fn what_lies_inside_a_body_of_higher_priority_is_not_there() {
    let hidden = seen(&balls(&[(1.0, 0.0, 1.5, Some(2)), (0.4, 0.1, 1.9, Some(1))]));
    let alone = seen(&balls(&[(1.0, 0.0, 1.5, Some(2))]));
    // Surfaces that are passed have random numbers of their own, so that samples differ: 1800 of a standard deviation of
    // about 0.5, four standard errors.
    assert!((mean(&hidden) - mean(&alone)).abs() < 0.05, "{} {}", mean(&hidden), mean(&alone));
}

#[test]
fn a_body_inside_another_has_the_index_relative_to_it() {
    // Water in glass of the same index is not there; without priorities it would be in air.
    let inside = seen(&balls(&[(1.0, 0.0, 1.5, Some(1)), (0.5, 0.0, 1.5, Some(2))]));
    let alone = seen(&balls(&[(1.0, 0.0, 1.5, Some(1))]));
    let in_air = seen(&balls(&[(1.0, 0.0, 1.5, None), (0.5, 0.0, 1.5, None)]));
    assert!((mean(&inside) - mean(&alone)).abs() < 0.05, "{} {}", mean(&inside), mean(&alone));
    let changed = |samples: &[Color]| samples.iter().zip(&alone).filter(|(a, b)| a != b).count();
    assert!(changed(&in_air) > 100);
    // A ray that goes straight on through the inner ball finds what it would have found, to a rounding.
    let near = inside.iter().zip(&alone).filter(|(a, b)| (a.g - b.g).abs() < 1e-3).count();
    assert!(near > 1700, "{near} of 1800");
}

#[test]
fn equal_indices_of_any_priority_are_one_body() {
    // Two halves that overlap: whichever is there, no surface is left between them.
    let pair = |a, b| seen(&balls(&[(1.0, 0.3, 1.5, Some(a)), (1.0, -0.3, 1.5, Some(b))]));
    let (first, second, equal) = (mean(&pair(1, 2)), mean(&pair(2, 1)), mean(&pair(1, 1)));
    assert!(
        (first - second).abs() < 0.05 && (first - equal).abs() < 0.05,
        "{first} {second} {equal}"
    );
}

#[test]
fn bodies_that_absorb_nothing_are_invisible_under_an_even_sky() {
    let mut sketch = Sketch::default();
    for (radius, height, index, priority) in
        [(1.0, 0.0, 1.5, 2), (0.8, 0.5, 1.33, 1), (0.5, -0.6, 1.8, 3), (0.5, 0.9, 1.2, 3)]
    {
        let material = body(&mut sketch, index, Some(priority));
        sketch.shape(sphere(DVec3::new(0.0, 0.1 * f64::from(priority), height), radius), material);
    }
    sketch.sky(1.0);
    let scene = sketch.seen(DVec3::new(0.0, -4.0, 0.7), DVec3::ZERO, 40.0, [6, 6]);
    let mut settings = settings(None, Strategy::Mis);
    settings.path.roulette_depth = u32::MAX;
    settings.path.max_depth = Some(200);
    let renderer = Renderer::new(&scene, settings).expect("a thread");
    for pixel in (0..36).map(|i| [i % 6, i / 6]) {
        for i in 0..20 {
            let radiance = renderer.sample(pixel, i).g;
            // Radiance is divided by η² on the way in and multiplied on the way out, body after body; light that is caught
            // for two hundred edges is lost.
            assert!((radiance - 1.0).abs() < 1e-4 || radiance == 0.0, "{pixel:?} {radiance}");
        }
    }
}
