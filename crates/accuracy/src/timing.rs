//! Times of several computations, comparable on a machine that does other things as well.

use core::time::Duration;
use std::time::Instant;

/// What one contestant's rounds took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timing {
    /// Median over the rounds of the time per evaluation in nanoseconds, that of the idle loop taken off; 0 where it
    /// vanishes in the noise of that loop.
    pub nanoseconds: f64,
    /// Lower and upper quartile of the same.
    pub quartiles: [f64; 2],
    /// Median over the rounds of its time divided by that of the first contestant in the same round; NaN where the
    /// first one's time vanishes.
    pub ratio: f64,
}

/// Evaluates everything once and returns how many evaluations that were.
pub type Pass<'a> = &'a dyn Fn() -> usize;

/// How long a race takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// How often each contestant runs.
    pub rounds: usize,
    /// How long a round of one contestant lasts at least: many times the resolution of the clock.
    pub round: Duration,
}

impl Budget {
    /// A quarter of a second per contestant: ratios within a few per cent on a quiet machine. Rounds are short against the
    /// slices of time that a busy machine hands out, so that most are not interrupted and the median is of one that was not.
    pub const USUAL: Self = Self { rounds: 501, round: Duration::from_micros(300) };
    /// Quick and rough.
    pub const QUICK: Self = Self { rounds: 7, round: Duration::from_micros(100) };
}

/// Lets contestants run one after the other, round by round, so that whatever slows the machine slows all alike.
///
/// `idle` is the loop without the computation; its time in the same round is taken off. Every second round runs in reverse
/// order.
pub fn race(idle: Pass<'_>, contestants: &[Pass<'_>], budget: Budget) -> Vec<Timing> {
    let all: Vec<Pass<'_>> = core::iter::once(idle).chain(contestants.iter().copied()).collect();
    let repeats: Vec<u32> = all.iter().map(|pass| calibrate(*pass, budget.round)).collect();
    let mut rounds = vec![vec![0.0; all.len()]; budget.rounds.max(1)];
    for (number, round) in rounds.iter_mut().enumerate() {
        for step in 0..all.len() {
            let i = if number % 2 == 0 { step } else { all.len() - 1 - step };
            round[i] = time(all[i], repeats[i]);
        }
    }
    let net = |round: &[f64], i: usize| (round[i] - round[0]).max(0.0);
    (1..all.len())
        .map(|i| {
            let mut times: Vec<f64> = rounds.iter().map(|round| net(round, i)).collect();
            let mut ratios: Vec<f64> = rounds.iter().map(|r| net(r, i) / net(r, 1)).collect();
            times.sort_by(f64::total_cmp);
            ratios.sort_by(f64::total_cmp);
            Timing {
                nanoseconds: quantile(&times, 0.5),
                quartiles: [0.25, 0.75].map(|q| quantile(&times, q)),
                ratio: quantile(&ratios, 0.5),
            }
        })
        .collect()
}

/// How often to repeat a pass so that it lasts as long as asked.
fn calibrate(pass: Pass<'_>, round: Duration) -> u32 {
    let mut repeats = 1_u32;
    loop {
        let start = Instant::now();
        for _ in 0..repeats {
            core::hint::black_box(pass());
        }
        if start.elapsed() >= round || repeats >= 1 << 24 {
            return repeats;
        }
        repeats *= 2;
    }
}

/// Nanoseconds per evaluation.
fn time(pass: Pass<'_>, repeats: u32) -> f64 {
    let start = Instant::now();
    let evaluations: usize = (0..repeats).map(|_| core::hint::black_box(pass())).sum();
    start.elapsed().as_secs_f64() * 1e9 / evaluations.max(1) as f64
}

/// Of sorted values, between the two nearest.
fn quantile(sorted: &[f64], q: f64) -> f64 {
    let place = q * (sorted.len() - 1) as f64;
    let (i, t) = (place as usize, place.fract());
    let next = sorted[(i + 1).min(sorted.len() - 1)];
    if t == 0.0 { sorted[i] } else { sorted[i] * (1.0 - t) + next * t }
}

#[cfg(test)]
mod tests {
    use super::*;
    use core::hint::black_box;
    use etendue_math::Real;

    #[test]
    fn quantiles_lie_between_their_neighbours() {
        let sorted = [1.0, 2.0, 4.0, 8.0];
        assert_eq!([0.0, 0.5, 1.0].map(|q| quantile(&sorted, q)), [1.0, 3.0, 8.0]);
        assert_eq!(quantile(&[5.0], 0.5), 5.0);
    }

    #[test]
    fn every_contestant_has_an_orderly_timing_and_the_first_is_its_own_measure() {
        let sines = |n: u32| {
            move || {
                for i in 0..n {
                    black_box(Real::sin(black_box(f64::from(i))));
                }
                n as usize
            }
        };
        let (one, two) = (sines(64), sines(128));
        let timings = race(&|| 64, &[&one, &two], Budget::QUICK);
        assert_eq!(timings.len(), 2);
        for timing in &timings {
            let [low, high] = timing.quartiles;
            assert!(low <= timing.nanoseconds && timing.nanoseconds <= high, "{timing:?}");
        }
        assert!(timings[0].ratio == 1.0 || timings[0].ratio.is_nan(), "{timings:?}");
    }
}
