//! Samples that are not numbers, and counts.

use core::sync::atomic::AtomicBool;

use etendue_math::Spectrum;
use etendue_math::glam::DVec3;
use etendue_scene::Color;
use etendue_scene::scene::SamplerKind;

use super::scenes::{Sketch, rectangle, settings, sphere, with_skies_that_overflow};
use crate::{BadSamples, RenderSettings, Renderer, SampleAddress, Strategy};

fn two_samples_per_pixel() -> RenderSettings {
    RenderSettings {
        samples_per_pixel: 2,
        sampler: SamplerKind::Sobol,
        ..settings(Some(2), Strategy::Mis)
    }
}

#[test]
fn samples_that_overflow_are_counted_located_and_replayable() {
    let mut sketch = Sketch::default();
    let black = sketch.grey(0.0);
    sketch.sky(1.0);
    sketch.sky(1.0);
    sketch.shape(rectangle(DVec3::Y * 2.0, [1.0, 9.0], -DVec3::Y), black);
    let scene = with_skies_that_overflow(sketch.seen(DVec3::ZERO, DVec3::Y, 60.0, [20, 3]));
    let renderer = Renderer::new(&scene, two_samples_per_pixel()).expect("a thread");
    let rendering = renderer.render(&|_| (), &AtomicBool::new(false));

    let non_finite = &rendering.statistics.non_finite;
    assert!(non_finite.count() > 0);
    assert!(non_finite.count() < rendering.statistics.samples);
    assert_eq!(non_finite.some().len() as u64, non_finite.count(), "there are few");
    assert_eq!(rendering.statistics.negative, BadSamples::default());
    for SampleAddress { row, column, sample } in non_finite.some() {
        assert!(!Spectrum::is_finite(renderer.sample([column, row], sample)));
        assert!(renderer.replay([column, row], sample).first_not_finite().is_some());
    }
    assert!(rendering.image.pixels().iter().all(|&pixel| Spectrum::is_finite(pixel)));
}

#[test]
fn rays_are_counted_by_purpose_and_none_is_traced_for_nothing() {
    let mut sketch = Sketch::default();
    let white = sketch.textures.constant(Color::white());
    let mirror = sketch.material(etendue_scene::material::Material::Conductor {
        index: etendue_scene::material::ConductorIndex::Mirror,
        roughness: None,
        specular_reflectance: white,
    });
    sketch.shape(sphere(DVec3::ZERO, 100.0), mirror);
    sketch.sky(1.0);
    // Outside and towards the sphere: every camera ray meets the mirror, then the sky.
    let scene = sketch.seen(DVec3::Y * -101.0, DVec3::ZERO, 20.0, [4, 4]);
    let rendering = Renderer::new(&scene, two_samples_per_pixel())
        .expect("a thread")
        .render(&|_| (), &AtomicBool::new(false));
    let rays = rendering.statistics.rays;
    assert_eq!((rays.camera, rays.shadow, rays.indirect), (32, 0, 32));
    assert_eq!(rays.total(), 64);
    assert_eq!(rendering.image.pixel([2, 2]), Color::white());
}

/// In a box of albedo 1/2 without light every path goes on until it is cut.
#[test]
fn paths_that_are_cut_are_counted_with_what_they_carry() {
    let mut sketch = Sketch::default();
    let grey = sketch.grey(0.5);
    for axis in DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]) {
        sketch.shape(rectangle(axis, [1.001, 1.001], -axis), grey);
    }
    let scene = sketch.seen(DVec3::ZERO, DVec3::Y, 60.0, [4, 4]);
    for (max_depth, share) in [(1, 1.0), (2, 0.5), (4, 0.125)] {
        let mut settings =
            RenderSettings { samples_per_pixel: 2, ..settings(Some(max_depth), Strategy::Mis) };
        settings.path.roulette_depth = u32::MAX;
        let renderer = Renderer::new(&scene, settings).expect("a thread");
        for rendering in [
            renderer.render(&|_| (), &AtomicBool::new(false)),
            renderer.render_with_reuse(&|_| (), &AtomicBool::new(false)),
        ] {
            let statistics = rendering.statistics;
            assert_eq!(statistics.rays.cut, statistics.samples, "{max_depth}");
            // Albedos are rounded, and the sum to 2⁻²⁰.
            let found = statistics.rays.cut_share(statistics.samples);
            assert!((found / share - 1.0).abs() < 1e-5, "{max_depth}: {found}");
        }
        let cut = renderer.cut([1, 2], 1).expect("every path is");
        assert!((cut.throughput / share - 1.0).abs() < 1e-5, "{max_depth}: {cut:?}");
        assert!(cut.surface.is_some());
    }
}
