//! Progressive renders in parts against renders in one go.

use core::panic::AssertUnwindSafe;
use core::sync::atomic::{AtomicUsize, Ordering};
use std::panic::catch_unwind;
use std::sync::{Mutex, PoisonError};

use etendue_scene::Scene;

use super::scenes::{lamp_over_sphere, settings};
use crate::progressive::{Allocation, Goal, Halt, ProgressiveState};
use crate::{RenderSettings, Renderer, Strategy};

fn scene() -> Scene {
    lamp_over_sphere([37, 20])
}

fn renderer(scene: &Scene, threads: usize) -> Renderer<'_> {
    let settings = RenderSettings { threads, ..settings(Some(4), Strategy::Mis) };
    Renderer::new(scene, settings).expect("threads")
}

fn goal(allocation: Allocation, samples: u32) -> Goal {
    Goal { allocation, samples_per_pixel: Some(samples), error: None }
}

fn nothing(scene: &Scene, allocation: Allocation) -> ProgressiveState {
    ProgressiveState::new(scene.film.crop, allocation)
}

/// Goes on until so many pixels have been asked for, or to the goal.
fn advance(
    renderer: &Renderer<'_>,
    work: ProgressiveState,
    goal: &Goal,
    pixels: Option<usize>,
) -> ProgressiveState {
    let work = Mutex::new(work);
    let asked = AtomicUsize::new(0);
    let halt = || {
        let asked = asked.fetch_add(1, Ordering::Relaxed);
        if pixels.is_some_and(|pixels| asked >= pixels) { Halt::Now } else { Halt::No }
    };
    renderer.continue_progressively(&work, goal, &|_| (), &halt);
    work.into_inner().expect("no panic")
}

fn stored(work: &ProgressiveState) -> ProgressiveState {
    let mut bytes = Vec::new();
    work.encode(&mut bytes);
    ProgressiveState::decode(&bytes).expect("a render")
}

#[test]
fn a_render_that_is_halted_stored_and_continued_has_the_bits_of_one_that_is_not() {
    let scene = scene();
    for allocation in [Allocation::Adaptive, Allocation::Uniform] {
        let goal = goal(allocation, 40);
        let one = renderer(&scene, 1);
        let expected = one.render_progressively(&goal, &|_| (), &|| Halt::No);
        for (threads, pixels) in [(1, 500), (2, 1700), (7, 1111)] {
            let renderer = renderer(&scene, threads);
            let mut work = nothing(&scene, allocation);
            for _ in 0..4 {
                work = stored(&advance(&renderer, work, &goal, Some(pixels)));
                assert!(work.rendering().statistics.samples < expected.statistics.samples);
            }
            let work = stored(&advance(&renderer, work, &goal, None));
            assert_eq!(work.rendering(), expected, "{allocation:?}, {threads} threads");
            // There is nothing left to do.
            assert_eq!(advance(&renderer, work.clone(), &goal, None), work);
        }
    }
}

#[test]
fn a_smaller_error_later_is_as_good_as_from_the_beginning() {
    let scene = scene();
    let renderer = renderer(&scene, 2);
    let until = |error| Goal { error: Some(error), ..goal(Allocation::Adaptive, 4000) };
    let large = advance(&renderer, nothing(&scene, Allocation::Adaptive), &until(0.2), None);
    let again = advance(&renderer, stored(&large), &until(0.2), None);
    assert_eq!(again, large, "a goal that is reached is not exceeded");
    let small = advance(&renderer, stored(&large), &until(0.01), None);
    assert!(small.rendering().rounds.len() > large.rendering().rounds.len());
    let expected = renderer.render_progressively(&until(0.01), &|_| (), &|| Halt::No);
    assert_eq!(small.rendering(), expected);
}

#[test]
fn more_samples_later_continue_a_round_that_the_limit_cut_short() {
    let scene = scene();
    let renderer = renderer(&scene, 1);
    for allocation in [Allocation::Adaptive, Allocation::Uniform] {
        let few = advance(&renderer, nothing(&scene, allocation), &goal(allocation, 20), None);
        let many = advance(&renderer, stored(&few), &goal(allocation, 64), None);
        let many = stored(&many).rendering();
        let direct = renderer.render_progressively(&goal(allocation, 64), &|_| (), &|| Halt::No);
        let [samples, expected] = [&many, &direct].map(|r| r.statistics.samples as f64);
        // Both spend their budget to a 64th of a level.
        assert!((samples / expected - 1.0).abs() < 0.05, "{samples} {expected}");
        let [many, direct] = [&many, &direct].map(|r| r.error.expect("all pixels").estimate);
        // Standard errors of both are a few percent of it.
        assert!((many / direct - 1.0).abs() < 0.3, "{many} {direct}");
    }
}

#[test]
fn a_panic_leaves_all_finished_tiles() {
    let scene = scene();
    let renderer = renderer(&scene, 2);
    let goal = goal(Allocation::Adaptive, 40);
    let work = Mutex::new(nothing(&scene, Allocation::Adaptive));
    let reports = AtomicUsize::new(0);
    let report =
        |_| assert_ne!(reports.fetch_add(1, Ordering::Relaxed), 30, "a panic that is meant");
    let outcome = catch_unwind(AssertUnwindSafe(|| {
        renderer.continue_progressively(&work, &goal, &report, &|| Halt::No);
    }));
    assert!(outcome.is_err());
    let work = work.into_inner().unwrap_or_else(PoisonError::into_inner);
    assert!(work.rendering().statistics.samples > 0);
    let expected = renderer.render_progressively(&goal, &|_| (), &|| Halt::No);
    assert_eq!(advance(&renderer, stored(&work), &goal, None).rendering(), expected);
}

#[test]
fn bytes_that_are_cut_short_anywhere_are_refused_and_changed_ones_do_no_harm() {
    let mut scene = scene();
    scene.film.crop.size = [17, 2];
    let renderer = renderer(&scene, 1);
    let goal = goal(Allocation::Adaptive, 20);
    let mut bytes = Vec::new();
    advance(&renderer, nothing(&scene, Allocation::Adaptive), &goal, None).encode(&mut bytes);
    for length in 0..bytes.len() {
        assert!(ProgressiveState::decode(&bytes[..length]).is_err(), "{length}");
    }
    // Whoever stores them finds changes out by a checksum; here they must not panic.
    for byte in 0..bytes.len() {
        bytes[byte] ^= 0x55;
        if let Ok(work) = ProgressiveState::decode(&bytes) {
            let _ = work.rendering();
        }
        bytes[byte] ^= 0x55;
    }
    let huge = [0, 0, u32::MAX, u32::MAX, 0].map(u32::to_le_bytes);
    assert!(ProgressiveState::decode(huge.as_flattened()).is_err());
}
