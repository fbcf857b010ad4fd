//! A replay is the sample, ray by ray.

use etendue_math::Spectrum;
use etendue_math::glam::DVec3;
use etendue_scene::scene::SamplerKind;

use super::scenes::{Sketch, rectangle, settings, sphere, with_skies_that_overflow};
use crate::{Found, RenderSettings, Renderer, Strategy};

/// A floor, a glass ball and a lamp, without a limit of the depth.
#[test]
fn steps_lead_to_the_sample_and_their_rays_to_each_other() {
    let mut sketch = Sketch::default();
    let (grey, black, glass) = (sketch.grey(0.8), sketch.grey(0.0), sketch.glass());
    sketch.shape(rectangle(DVec3::ZERO, [3.0, 3.0], DVec3::Z), grey);
    sketch.shape(sphere(DVec3::new(0.0, 0.0, 0.5), 0.5), glass);
    sketch.emitter(rectangle(DVec3::Z * 3.0, [0.5, 0.5], -DVec3::Z), black, 4.0);
    sketch.sky(0.2);
    let scene = sketch.seen(DVec3::new(0.0, -4.0, 1.5), DVec3::Z * 0.3, 40.0, [8, 8]);
    for sampler in [SamplerKind::Independent, SamplerKind::Sobol] {
        let settings = RenderSettings { sampler, ..settings(None, Strategy::Mis) };
        let renderer = Renderer::new(&scene, settings).expect("a thread");
        let mut longest = 0;
        for pixel in (0..8).flat_map(|y| (0..8).map(move |x| [x, y])) {
            let replay = renderer.replay(pixel, 3);
            assert_eq!(replay.radiance, renderer.sample(pixel, 3));
            assert_eq!(replay.steps.last().map(|step| step.radiance), Some(replay.radiance));
            assert_eq!(replay.first_not_finite(), None);
            longest = longest.max(replay.steps.len());
            for pair in replay.steps.windows(2) {
                // Light is only added.
                let more = pair[1].radiance + pair[0].radiance.scale(-1.0);
                assert!(more.to_array().iter().all(|&c| c >= 0.0), "{pixel:?}");
                // Every ray starts where the edge before has ended, but for the bound of its rounding.
                let vertex = pair[0].surface().expect("a path goes on from a surface").position;
                for traced in &pair[1].rays {
                    let distance = (traced.ray.origin - vertex).length();
                    assert!(distance < 1e-4, "{pixel:?}: {distance}");
                }
            }
            let camera = &replay.steps[0].rays;
            assert!(
                matches!(camera[..], [ray] if matches!(ray.found, Found::Surface(..) | Found::Nothing))
            );
        }
        assert!(longest > 3, "paths through the ball: {longest}");
    }
}

#[test]
fn the_step_that_is_not_finite_is_found() {
    let mut sketch = Sketch::default();
    let white = sketch.grey(1.0);
    sketch.sky(1.0);
    sketch.sky(1.0);
    sketch.shape(sphere(DVec3::ZERO, 1.0), white);
    let scene = with_skies_that_overflow(sketch.seen(DVec3::Y * -4.0, DVec3::ZERO, 60.0, [9, 9]));
    let renderer = Renderer::new(&scene, settings(Some(3), Strategy::Mis)).expect("a thread");
    assert_eq!(renderer.replay([0, 0], 0).first_not_finite(), Some(0), "the sky itself");
    assert_eq!(renderer.replay([4, 4], 0).first_not_finite(), Some(1), "the light on the ball");
}
