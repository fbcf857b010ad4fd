//! Paths that share what they find have the expectation of paths that do not.

use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::Mutex;

use etendue_math::Real;
use etendue_math::glam::DVec3;
use etendue_scene::scene::SamplerKind;
use etendue_scene::{Color, Scene};

use super::bias::{PIXELS, SIZE, Sums, assert_equal_means};
use super::scenes::{Sketch, rectangle, settings, sphere};
use crate::{RenderSettings, Renderer, Rendering, ReuseState, Strategy};

/// A corner of diffuse walls with a glass ball, a rough mirror, and a lamp that lights the floor from close by: joints behind
/// delta and glossy surfaces, branches near their joints, and walls that hide them.
fn corner(size: [u32; 2]) -> Scene {
    let mut sketch = Sketch::default();
    let (grey, dark, black) = (sketch.grey(0.8), sketch.grey(0.3), sketch.grey(0.0));
    let (glass, mirror) = (sketch.glass(), sketch.rough_mirror(0.2));
    sketch.shape(rectangle(DVec3::ZERO, [3.0, 3.0], DVec3::Z), grey);
    sketch.shape(rectangle(DVec3::new(0.0, 1.5, 1.0), [3.0, 3.0], -DVec3::Y), dark);
    sketch.shape(rectangle(DVec3::new(1.5, 0.0, 1.0), [0.7, 0.7], -DVec3::X), mirror);
    sketch.shape(sphere(DVec3::new(-0.6, -0.3, 0.4), 0.4), glass);
    sketch.shape(sphere(DVec3::new(0.5, 0.2, 0.35), 0.35), grey);
    let lamp = rectangle(DVec3::new(0.0, 0.8, 1.6), [0.4, 0.2], -DVec3::Z);
    sketch.emitter(lamp, black, 4.0);
    sketch.seen(DVec3::new(-0.4, -4.0, 1.6), DVec3::new(0.0, 0.0, 0.5), 42.0, size)
}

/// A room whose lamp shines at the ceiling.
fn indirectly_lit(size: [u32; 2]) -> Scene {
    let mut sketch = Sketch::default();
    let (grey, black) = (sketch.grey(0.7), sketch.grey(0.0));
    for (centre, normal) in [
        (DVec3::ZERO, DVec3::Z),
        (DVec3::new(0.0, 0.0, 2.0), -DVec3::Z),
        (DVec3::new(0.0, 1.5, 1.0), -DVec3::Y),
        (DVec3::new(-1.5, 0.0, 1.0), DVec3::X),
        (DVec3::new(1.5, 0.0, 1.0), -DVec3::X),
    ] {
        sketch.shape(rectangle(centre, [2.0, 2.0], normal), grey);
    }
    sketch.emitter(rectangle(DVec3::new(0.0, 0.5, 1.4), [0.2, 0.2], DVec3::Z), black, 10.0);
    sketch.seen(DVec3::new(0.0, -3.5, 1.0), DVec3::new(0.0, 0.0, 0.7), 40.0, size)
}

fn with_seed(seed: u64, samples_per_pixel: u32) -> RenderSettings {
    RenderSettings {
        seed,
        samples_per_pixel,
        sampler: SamplerKind::Sobol,
        ..settings(Some(6), Strategy::Mis)
    }
}

fn renderer(scene: &Scene, settings: RenderSettings) -> Renderer<'_> {
    Renderer::new(scene, settings).expect("threads")
}

fn reuse(renderer: &Renderer<'_>) -> Rendering {
    renderer.render_with_reuse(&|_| (), &AtomicBool::new(false))
}

#[test]
fn every_pixel_has_the_mean_of_paths_that_do_not_share() {
    const PICTURES: u64 = 600;
    let mut scene = corner(SIZE);
    // Roulette at every vertex where it may be.
    scene.path.roulette_depth = 1;
    let plain = Sums::of(PICTURES, |seed| {
        let go_on = AtomicBool::new(false);
        renderer(&scene, with_seed(seed, 32)).render(&|_| (), &go_on).image
    });
    let shared = Sums::of(PICTURES, |seed| {
        let rendering = reuse(&renderer(&scene, with_seed(10_000 + seed, 32)));
        assert_eq!(rendering.statistics.non_finite.count(), 0);
        rendering.image
    });
    // Groups of 8.
    assert_equal_means(&plain, &shared, 8.0);
}

#[test]
fn sharing_leaves_a_third_of_the_squared_error_of_diffuse_interreflection() {
    let scene = indirectly_lit([32, 32]);
    let plain = |seed, samples| {
        renderer(&scene, with_seed(seed, samples)).render(&|_| (), &AtomicBool::new(false))
    };
    let reference = plain(1 << 32, 1024);
    let error = |rendering: &Rendering| -> f64 {
        let pairs = rendering.image.pixels().iter().zip(reference.image.pixels());
        // Relative to what is there: the ceiling above the lamp is the brightest by far.
        let square = |(a, b): (&Color, &Color)| f64::from((a.g - b.g) / b.g.max(0.1)).sqr();
        pairs.map(square).sum()
    };
    let mut sums = [0.0; 2];
    for seed in 0..4 {
        sums[0] += error(&plain(seed, 16));
        sums[1] += error(&reuse(&renderer(&scene, with_seed(seed, 16))));
    }
    // Groups of 8 would leave an eighth, were pixels as small as in a picture.
    assert!(sums[1] < 0.33 * sums[0], "{sums:?}");
}

#[test]
fn threads_and_seeds_as_everywhere() {
    let scene = corner(SIZE);
    let with =
        |threads, seed| reuse(&renderer(&scene, RenderSettings { threads, ..with_seed(seed, 64) }));
    let one = with(1, 1);
    assert_eq!(one, with(2, 1));
    assert_eq!(one, with(7, 1));
    assert_ne!(one.image, with(1, 2).image);
    // As many samples as were asked for, or somewhat less where they go where the error is.
    let wanted = 64 * PIXELS as u64;
    assert!((wanted * 7 / 10..=wanted).contains(&one.statistics.samples));
}

#[test]
fn a_render_that_is_stopped_stored_and_continued_has_the_bits_of_one_that_is_not() {
    let scene = corner([37, 20]);
    let expected = reuse(&renderer(&scene, with_seed(1, 24)));
    // Of both passes there are twelve tiles: stops lie within each, and between them.
    for (threads, cancel_after) in [(1, 1), (2, 2), (3, 5), (1, 6), (7, 4)] {
        let renderer = renderer(&scene, RenderSettings { threads, ..with_seed(1, 24) });
        let mut work = ReuseState::new(scene.film.crop);
        let mut stops = 0;
        loop {
            let (reports, cancel) = (AtomicUsize::new(0), AtomicBool::new(false));
            let report = |_| {
                if reports.fetch_add(1, Ordering::Relaxed) + 1 == cancel_after {
                    cancel.store(true, Ordering::Relaxed);
                }
            };
            let shared = Mutex::new(work);
            renderer.continue_with_reuse(&shared, &report, &cancel);
            let mut bytes = Vec::new();
            shared.into_inner().expect("no panic").encode(&mut bytes);
            work = ReuseState::decode(&bytes).expect("a render");
            if !cancel.into_inner() {
                break;
            }
            stops += 1;
        }
        assert!(stops >= 1, "{threads} threads stop {stops} times");
        assert_eq!(work.rendering(), expected, "{threads} threads");
    }
}

#[test]
fn bytes_that_are_cut_short_anywhere_are_refused_and_changed_ones_do_no_harm() {
    let scene = corner([3, 2]);
    let renderer = renderer(&scene, with_seed(1, 8));
    let work = Mutex::new(ReuseState::new(scene.film.crop));
    renderer.continue_with_reuse(&work, &|_| (), &AtomicBool::new(false));
    let mut bytes = Vec::new();
    work.into_inner().expect("no panic").encode(&mut bytes);
    for length in 0..bytes.len() {
        assert!(ReuseState::decode(&bytes[..length]).is_err(), "{length}");
    }
    for place in 0..bytes.len() {
        let before = core::mem::replace(&mut bytes[place], 0xff);
        if let Ok(changed) = ReuseState::decode(&bytes) {
            let _ = changed.rendering();
        }
        bytes[place] = before;
    }
}

#[test]
fn where_paths_cannot_share_the_picture_is_the_plain_one() {
    let mut scene = corner(SIZE);
    scene.path.roulette_depth = 0;
    let settings = with_seed(3, 8);
    let settings = RenderSettings { path: scene.path, ..settings };
    let renderer = renderer(&scene, settings);
    assert!(!renderer.reuses_paths());
    assert_eq!(reuse(&renderer), renderer.render(&|_| (), &AtomicBool::new(false)));
}
