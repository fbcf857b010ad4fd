//! How many samples there are after each round, and within what bounds they are allocated.

use etendue_math::Real;

use super::goal::{Allocation, Goal};
use super::half::REACH;
use crate::codec::{Reader, StateError, Write as _};

/// The level that every pixel reaches before samples are allocated: eight samples in each half.
const START: u32 = 3;

/// Samples per pixel at which every pixel has reached the starting level.
pub(super) const UNIFORM: f64 = (2 << START) as f64;

/// No pixel goes beyond 2²⁹ samples in either half.
pub(super) const HIGHEST: u32 = 29;

/// Levels that samples may be allocated to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Bounds {
    /// What every pixel gets.
    pub(super) lowest: u32,
    /// What no pixel exceeds.
    pub(super) highest: u32,
}

/// One round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stage {
    /// Samples per pixel after the round, in the mean over the picture.
    pub(super) samples_per_pixel: f64,
    /// The levels that pixels may have after it.
    pub(super) bounds: Bounds,
    /// The level, reached by every pixel before the round, whose differences decide; `None` where all
    /// pixels deserve the same.
    pub(super) known: Option<u32>,
}

/// How stages are stored.
impl Stage {
    pub(super) fn write(&self, bytes: &mut Vec<u8>) {
        bytes.u64(self.samples_per_pixel.to_bits());
        bytes.u32(self.bounds.lowest);
        bytes.u32(self.bounds.highest);
        bytes.u8(u8::from(self.known.is_some()));
        bytes.u32(self.known.unwrap_or(0));
    }

    pub(super) fn read(reader: &mut Reader<'_>) -> Result<Self, StateError> {
        let samples_per_pixel = f64::from_bits(reader.u64()?);
        let bounds = Bounds { lowest: reader.u32()?, highest: reader.u32()? };
        let (is_known, known) = (reader.bool()?, reader.u32()?);
        Ok(Self { samples_per_pixel, bounds, known: is_known.then_some(known) })
    }
}

/// The rounds of a render. They double the samples up to 16 per pixel and multiply them by ⁴√2 from
/// there on, so that a goal is overshot by a fifth at most.
///
/// Every number here is fixed before the first sample is drawn.
#[derive(Clone, Debug)]
pub(super) struct Schedule {
    allocation: Allocation,
    limit: f64,
    full: f64,
    before: Option<Stage>,
}

impl Schedule {
    pub(super) fn new(goal: &Goal) -> Self {
        let most = f64::from(2_u32 << HIGHEST);
        let limit = goal.samples_per_pixel.map_or(most, |n| f64::from(n.max(2)).min(most));
        Self { allocation: goal.allocation, limit, full: 2.0, before: None }
    }

    /// The bounds where halves get `samples` per pixel in the mean. What every pixel gets is a 16th to
    /// an 8th of them, so that nothing is overlooked for good.
    ///
    /// Raising every pixel to an 8th of a budget and keeping what one smaller by ⁴√2 has spent stays
    /// within it: 2^-¼ + ⅛ < 1.
    fn adaptive_bounds(samples: f64) -> Bounds {
        let eighth = (samples / 8.0).max(1.0) as u32;
        let lowest = eighth.ilog2().max(START);
        Bounds { lowest, highest: (lowest + REACH).min(HIGHEST) }
    }
}

impl Iterator for Schedule {
    type Item = Stage;

    fn next(&mut self) -> Option<Stage> {
        if self.before.is_some_and(|stage| stage.samples_per_pixel >= self.limit) {
            return None;
        }
        let samples_per_pixel = self.full.min(self.limit);
        let stage = if self.full > UNIFORM && self.allocation == Allocation::Adaptive {
            let before = self.before.filter(|stage| stage.known.is_some());
            let bounds = match before {
                // A last round that the limit cuts short raises nobody's least.
                Some(stage) if samples_per_pixel < self.full => stage.bounds,
                _ => Self::adaptive_bounds(samples_per_pixel / 2.0),
            };
            let known = before.map_or(START, |stage| stage.bounds.lowest);
            Stage { samples_per_pixel, bounds, known: Some(known) }
        } else {
            let bounds = Bounds { lowest: 0, highest: HIGHEST };
            Stage { samples_per_pixel, bounds, known: None }
        };
        self.before = Some(stage);
        self.full *= if self.full < UNIFORM { 2.0 } else { Real::sqrt(core::f64::consts::SQRT_2) };
        Some(stage)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn schedule(allocation: Allocation, samples_per_pixel: Option<u32>) -> Vec<Stage> {
        let goal = Goal { allocation, samples_per_pixel, error: None };
        Schedule::new(&goal).collect()
    }

    #[test]
    fn rounds_double_then_grow_by_the_fourth_root_of_two_and_end_at_the_limit() {
        for allocation in [Allocation::Adaptive, Allocation::Uniform] {
            for limit in [1, 2, 3, 16, 17, 100, 128] {
                let stages = schedule(allocation, Some(limit));
                let last = stages.last().expect("a round");
                assert_eq!(last.samples_per_pixel, f64::from(limit.max(2)));
                for pair in stages.windows(2) {
                    let growth = pair[1].samples_per_pixel / pair[0].samples_per_pixel;
                    // Seven roundings of a fourth root.
                    assert!(growth > 1.0 && growth < 2.0 + 1e-12, "{limit} {growth}");
                    assert!(pair[0].samples_per_pixel < UNIFORM || growth < 1.19, "{growth}");
                }
            }
        }
    }

    #[test]
    fn what_decides_was_reached_before_and_is_remembered() {
        let stages = schedule(Allocation::Adaptive, None);
        assert!(stages.len() > 100, "up to 2³⁰ samples per pixel");
        for pair in stages.windows(2) {
            let Some(known) = pair[1].known else { continue };
            let reached = if pair[0].known.is_some() { pair[0].bounds.lowest } else { START };
            assert_eq!(known, reached);
            assert!(pair[1].bounds.highest <= known + 1 + REACH);
            assert!(pair[1].bounds.lowest >= known);
        }
    }

    #[test]
    fn what_every_pixel_gets_is_within_the_budget_whatever_was_spent_before() {
        for limit in [None, Some(40), Some(100), Some(1000)] {
            for pair in schedule(Allocation::Adaptive, limit).windows(2) {
                let [before, now] = [pair[0], pair[1]].map(|stage| stage.samples_per_pixel / 2.0);
                if pair[0].known.is_some() && pair[1].bounds != pair[0].bounds {
                    let least = f64::from(1_u32 << pair[1].bounds.lowest);
                    assert!(before + least <= now, "{before} {least} {now}");
                }
            }
        }
    }
}
