//! Renders in parts against renders in one go.

use core::panic::AssertUnwindSafe;
use core::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::panic::catch_unwind;
use std::sync::{Mutex, PoisonError};

use etendue_math::Real;
use etendue_scene::Scene;
use etendue_scene::scene::SamplerKind;

use super::scenes::{lamp_over_sphere, settings};
use crate::{Accumulation, RenderSettings, Renderer, Rendering, Strategy};

const SPP: u32 = 11;

fn scene() -> Scene {
    lamp_over_sphere([37, 20])
}

fn renderer(scene: &Scene, threads: usize, sampler: SamplerKind) -> Renderer<'_> {
    let settings = RenderSettings {
        threads,
        sampler,
        samples_per_pixel: SPP,
        ..settings(Some(4), Strategy::Mis)
    };
    Renderer::new(scene, settings).expect("threads")
}

fn whole(renderer: &Renderer<'_>) -> Rendering {
    renderer.render(&|_| (), &AtomicBool::new(false))
}

fn accumulate(renderer: &Renderer<'_>, work: Accumulation, cancel_after: usize) -> Accumulation {
    let work = Mutex::new(work);
    let (reports, cancel) = (AtomicUsize::new(0), AtomicBool::new(false));
    let report = |_| {
        if reports.fetch_add(1, Ordering::Relaxed) + 1 == cancel_after {
            cancel.store(true, Ordering::Relaxed);
        }
    };
    renderer.accumulate(&work, &report, &cancel);
    work.into_inner().expect("no panic")
}

fn stored(work: &Accumulation) -> Accumulation {
    let mut bytes = Vec::new();
    work.encode(&mut bytes);
    Accumulation::decode(&bytes).expect("a render")
}

#[test]
fn a_render_that_is_stopped_stored_and_continued_has_the_bits_of_one_that_is_not() {
    let scene = scene();
    for sampler in [SamplerKind::Independent, SamplerKind::Sobol] {
        let expected = whole(&renderer(&scene, 1, sampler));
        for (threads, cancel_after) in [(1, 1), (2, 2), (3, 5), (7, 4)] {
            let renderer = renderer(&scene, threads, sampler);
            let mut work = Accumulation::new(scene.film.crop, 0..SPP);
            let mut stops = 0;
            while !work.is_whole() {
                let before = work.fraction();
                work = stored(&accumulate(&renderer, work, cancel_after));
                assert!(work.fraction() > before);
                stops += 1;
            }
            assert!(stops > 2, "{threads} threads stop {stops} times");
            assert_eq!(work.image(), expected.image, "{sampler:?}, {threads} threads");
            assert_eq!(work.statistics(), expected.statistics);
        }
    }
}

#[test]
fn more_samples_later_are_as_good_as_from_the_beginning() {
    let scene = scene();
    let renderer = renderer(&scene, 2, SamplerKind::Sobol);
    let mut work = accumulate(&renderer, Accumulation::new(scene.film.crop, 0..3), 0);
    assert!(work.is_whole());
    work.extend_to(SPP);
    let work = accumulate(&renderer, stored(&work), 0);
    assert_eq!(work.image(), whole(&renderer).image);
}

#[test]
fn ranges_joined_in_any_order_have_the_bits_of_the_whole() {
    let scene = scene();
    let renderer = renderer(&scene, 2, SamplerKind::Independent);
    let expected = accumulate(&renderer, Accumulation::new(scene.film.crop, 0..SPP), 0);
    assert_eq!(expected.image(), whole(&renderer).image);
    let part = |range| stored(&accumulate(&renderer, Accumulation::new(scene.film.crop, range), 0));
    let [a, b, c] = [part(0..2), part(2..7), part(7..SPP)];
    let joined =
        |x: &Accumulation, y: &Accumulation| x.clone().joined(y.clone()).expect("neighbours");
    for all in
        [joined(&joined(&a, &b), &c), joined(&c, &joined(&b, &a)), joined(&joined(&c, &b), &a)]
    {
        assert_eq!(all, expected);
    }
    assert_eq!(a.clone().joined(c), None, "they are not neighbours");
    assert_eq!(a.joined(part(1..7)), None, "they overlap");
}

#[test]
fn second_moments_are_those_of_the_samples() {
    let scene = scene();
    let renderer = renderer(&scene, 1, SamplerKind::Independent);
    let work = accumulate(&renderer, Accumulation::new(scene.film.crop, 0..SPP), 0);
    let (position, pixel) = ([20, 10], [20, 10]);
    let squares: f64 =
        (0..SPP).map(|sample| f64::from(renderer.sample(pixel, u64::from(sample)).g).sqr()).sum();
    let found = f64::from(work.second_moments().pixel(position).g);
    let expected = squares / f64::from(SPP);
    // Each square and the mean are rounded to f32.
    assert!(
        (found - expected).abs() <= 2.0 * f64::from(f32::EPSILON) * expected,
        "{found} {expected}"
    );
    assert!(expected > 0.0);
    assert_eq!(work.counts()[10 * 37 + 20], SPP);
}

#[test]
fn a_panic_leaves_all_finished_tiles() {
    let scene = scene();
    let renderer = renderer(&scene, 2, SamplerKind::Sobol);
    let work = Mutex::new(Accumulation::new(scene.film.crop, 0..SPP));
    let reports = AtomicUsize::new(0);
    let report =
        |_| assert_ne!(reports.fetch_add(1, Ordering::Relaxed), 3, "a panic that is meant");
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        renderer.accumulate(&work, &report, &AtomicBool::new(false));
    }));
    assert!(outcome.is_err());
    let work = work.into_inner().unwrap_or_else(PoisonError::into_inner);
    assert!(work.fraction() > 0.0 && !work.is_whole());
    let work = accumulate(&renderer, stored(&work), 0);
    assert_eq!(work.image(), whole(&renderer).image);
}

#[test]
fn bytes_that_are_cut_short_anywhere_are_refused_and_changed_ones_do_no_harm() {
    let mut scene = scene();
    scene.film.crop.size = [17, 2];
    let renderer = renderer(&scene, 1, SamplerKind::Sobol);
    let mut bytes = Vec::new();
    accumulate(&renderer, Accumulation::new(scene.film.crop, 0..2), 0).encode(&mut bytes);
    for length in 0..bytes.len() {
        assert!(Accumulation::decode(&bytes[..length]).is_err(), "{length}");
    }
    let mut accepted = 0;
    for bit in 0..8 * bytes.len() {
        bytes[bit / 8] ^= 1 << (bit % 8);
        // Whoever stores them finds this out by a checksum; here it must not panic.
        if let Ok(work) = Accumulation::decode(&bytes) {
            let _ = (work.image(), work.statistics(), work.is_whole());
            accepted += 1;
        }
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
    assert!(accepted > 0, "sums are any bits");
    let huge = [0, 0, u32::MAX, u32::MAX, 0, u32::MAX].map(u32::to_le_bytes);
    assert!(Accumulation::decode(huge.as_flattened()).is_err());
}
