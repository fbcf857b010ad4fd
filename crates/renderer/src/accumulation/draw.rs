//! Drawing the samples that are missing.

use core::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};

use etendue_sampling::Sampler;

use super::sums::Accumulation;
use crate::configuration::Configured;
use crate::path::Transport;
use crate::render::Renderer;
use crate::tile::Tile;

/// Samples per pixel of a pass, once there are as many: 16 000 paths per tile, a fraction of a second.
const MOST: u32 = 64;

impl Renderer<'_> {
    /// Draws what is missing of an accumulation, which is one of the film's crop.
    ///
    /// `work` is locked for moments only, and whole at any time: another thread may copy it for storing, and after a panic all
    /// tiles that were finished are in it.
    ///
    /// * `report` is called after every tile of every pass with the part of the samples that has been drawn, from 0 to 1.
    /// * Once `cancel` is true, pixels under way are finished and tiles left as they were before the pass.
    pub fn accumulate(
        &self,
        work: &Mutex<Accumulation>,
        report: &(dyn Fn(f64) + Sync),
        cancel: &AtomicBool,
    ) {
        self.configured(Accumulate { renderer: self, work, report, cancel });
    }
}

struct Accumulate<'r, 'a> {
    renderer: &'r Renderer<'a>,
    work: &'r Mutex<Accumulation>,
    report: &'r (dyn Fn(f64) + Sync),
    cancel: &'r AtomicBool,
}

/// The end of the pass that follows so many samples.
fn pass_end(drawn: u32) -> u32 {
    if drawn < MOST {
        (drawn + 1).next_power_of_two()
    } else {
        (drawn / MOST + 1).saturating_mul(MOST)
    }
}

impl Configured for Accumulate<'_, '_> {
    type Output = ();

    fn run<S: Sampler, T: Transport>(self) {
        let Self { renderer, work, report, cancel } = self;
        // A poisoned lock means that a report panicked: what it guards is whole.
        let lock = || work.lock().unwrap_or_else(PoisonError::into_inner);
        let (crop, samples, wanted) = {
            let work = lock();
            (work.crop(), work.samples(), work.wanted())
        };
        let tiles: Vec<(usize, Tile)> = Tile::cover(&crop).into_iter().enumerate().collect();
        let cancelled = || cancel.load(core::sync::atomic::Ordering::Relaxed);
        loop {
            let least = lock().least();
            if least >= wanted || cancelled() {
                return;
            }
            let end = pass_end(least).min(wanted);
            renderer.share_out(&tiles, &cancelled, |&(index, tile)| {
                let before = lock().tile(index);
                if before.drawn() >= end {
                    return;
                }
                let begin = samples.start;
                let range = begin + before.drawn()..begin + end;
                let Some(after) = renderer.extend_tile::<S, T>(tile, range, &before, cancel) else {
                    return;
                };
                let mut work = lock();
                work.replace(index, after);
                let fraction = work.fraction();
                drop(work);
                report(fraction);
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_double_the_samples_and_then_add_equally_many() {
        let mut ends = vec![0];
        while let Some(&last) = ends.last().filter(|&&last| last < 256) {
            ends.push(pass_end(last));
        }
        assert_eq!(ends, [0, 1, 2, 4, 8, 16, 32, 64, 128, 192, 256]);
        assert_eq!([pass_end(5), pass_end(100), pass_end(u32::MAX)], [8, 128, u32::MAX]);
    }
}
