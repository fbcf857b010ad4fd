//! `f32` against `f64` over the hostile domain, by the hundred million.
//!
//! Inputs are cut into blocks of a fixed size; blocks run in parallel and are merged in order, so
//! that the outcome does not depend on the number of threads. Each input costs one evaluation in
//! either precision; how well conditioned the problem is there is only asked of inputs whose plain
//! error would otherwise be a new worst.

mod delta;
mod scale;
mod tally;

use core::time::Duration;
use std::time::Instant;

use etendue_math::{Vec3, mix_u64};
use rayon::prelude::*;

use crate::generators::{SweepPair, SweepPairs};
use crate::measure::Outcome;
use crate::scalar::{self, narrow, widen};
use crate::subject::{Case, Width};

use scale::error_beyond;
use tally::Tally;

/// Inputs per block.
const BLOCK: u64 = 1 << 14;

/// What a sweep over one case found.
#[derive(Clone, Debug, PartialEq)]
pub struct Swept {
    /// The check `precision`: the worst error on the scale of the problem's condition.
    pub precision: Outcome,
    /// The check `finite`: NaN, infinities and negative numbers.
    pub finite: Outcome,
}

/// Compares `f32` with `f64` at `count` inputs or a few more, and says how long the evaluations took,
/// summed over the threads.
///
/// ```text
/// |f32 − f64| ≤ 64 · scale
/// scale = [`conditioned_ulp`](crate::subject::conditioned_ulp) over both directions, ε = 2⁻²³
/// ```
///
/// for the value and the density of every pair of directions, and for energy and direction of a
/// delta lobe. Parameters are numbers that both precisions hold.
///
/// Tolerance: an error of a few tens on this scale is the rounding of some twenty operations; a
/// form that cancels exceeds it by powers of ten. Of NaN, infinite and negative numbers, in either
/// precision, there may be none.
pub fn sweep(single: &Case<f32>, double: &Case<f64>, count: u64) -> (Swept, Duration) {
    let blocks: Vec<(Tally, Duration)> = (0..count.div_ceil(BLOCK))
        .into_par_iter()
        .map(|block| {
            let start = Instant::now();
            let tally = sweep_block(single, double, block);
            (tally, start.elapsed())
        })
        .collect();
    // In order of the blocks, whichever thread was first.
    let (mut tally, mut time) = (Tally::default(), Duration::ZERO);
    for (block, elapsed) in blocks {
        tally.merge(block);
        time += elapsed;
    }
    (Swept { precision: tally.precision(), finite: tally.finite() }, time)
}

fn sweep_block(single: &Case<f32>, double: &Case<f64>, block: u64) -> Tally {
    const STREAM: u64 = 81;
    let lobes = single.bsdf.lobes();
    let pairs = SweepPairs::new(block);
    let mut tally = Tally::default();
    for i in block * BLOCK..(block + 1) * BLOCK {
        let SweepPair { wo, mut wi, sampled } = pairs.pair(mix_u64(STREAM, i));
        if lobes.delta {
            delta::compare(&mut tally, single, double, wo, i);
        }
        if !lobes.continuous {
            continue;
        }
        if sampled {
            let Some(sample) = single.draw(wo, STREAM, i) else { continue };
            wi = sample.wi;
        }
        compare(&mut tally, single, double, [wo, wi]);
    }
    tally
}

fn compare(tally: &mut Tally, single: &Case<f32>, double: &Case<f64>, [wo, wi]: [Vec3<f32>; 2]) {
    let got = single.bsdf.eval_pdf(wo, wi);
    let [wo64, wi64] = [wo, wi].map(exactly);
    let want = double.bsdf.eval_pdf(wo64, wi64);
    tally.inputs += 1;
    for value in [got.0, got.1].map(f64::from).into_iter().chain([want.0, want.1]) {
        tally.inspect(value, || place(single, [wo, wi], value));
    }
    // Across the surface the half vector is wo + η wi, whose product is rounded before it cancels:
    // that moves it out of any lobe narrower than an ulp.
    if single.width == Width::Needle && wo.z * wi.z < 0.0 {
        return;
    }
    let value = |[wo, wi]: [Vec3<f64>; 2]| double.bsdf.eval_pdf(wo, wi).0;
    let density = |[wo, wi]: [Vec3<f64>; 2]| double.bsdf.eval_pdf(wo, wi).1;
    let f = error_beyond(tally.worst(), got.0, want.0, [wo64, wi64], value);
    tally.observe(f, || place(single, [wo, wi], got.0.into()));
    let pdf = error_beyond(tally.worst(), got.1, want.1, [wo64, wi64], density);
    tally.observe(pdf, || place(single, [wo, wi], got.1.into()));
}

/// The same vector in `f64`.
#[inline]
fn exactly(w: Vec3<f32>) -> Vec3<f64> {
    narrow::<f64>(widen::<f32>(w))
}

fn show(w: Vec3<f32>) -> String {
    scalar::show::<f32>(w)
}

fn place(case: &Case<f32>, [wo, wi]: [Vec3<f32>; 2], value: f64) -> String {
    format!("{}, wo {}, wi {}: {value:.7e}", case.parameters, show(wo), show(wi))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::broken::{Fault, MirrorFault, case, mirror};

    fn verdict(fault: Fault) -> Swept {
        sweep(&case::<f32>(fault), &case::<f64>(fault), BLOCK).0
    }

    #[test]
    fn a_sound_model_passes_and_a_cancelling_form_is_caught() {
        let sound = verdict(Fault::None);
        assert!(sound.precision.passed() && sound.finite.passed(), "{sound:?}");
        assert!(!verdict(Fault::Cancels).precision.passed());
        assert!(!verdict(Fault::NanAtGrazing).finite.passed());
        assert!(!verdict(Fault::NegativeBehind).finite.passed());
    }

    #[test]
    fn a_delta_lobe_is_swept_too() {
        let swept = |fault| sweep(&mirror::<f32>(fault), &mirror::<f64>(fault), BLOCK).0;
        assert!(swept(MirrorFault::None).precision.passed());
        assert!(!swept(MirrorFault::Cancels).precision.passed());
    }

    #[test]
    fn the_outcome_does_not_depend_on_the_number_of_threads() {
        let run_on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| verdict(Fault::Cancels))
        };
        assert_eq!(run_on(1), run_on(3));
    }
}
