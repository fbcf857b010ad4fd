//! Contenders and their time.

use std::time::{Duration, Instant};

use etendue_scene::geometry::{Geometry, Ray, Rays, Task};

use crate::embree::Scene;
use crate::rays::List;

/// Who traces.
pub enum Contender<'a> {
    Ours(&'a Geometry),
    Embree(&'a Scene<'a>),
}

/// What came of a chunk: hits, and the sum of their distances.
#[derive(Clone, Copy, Default)]
pub struct Outcome {
    pub hits: usize,
    pub distance: f64,
}

struct Ours<'a> {
    chunk: &'a [Ray],
    any: bool,
}

impl Task for Ours<'_> {
    type Output = Outcome;

    #[inline(always)]
    fn run<R: Rays>(self, rays: R) -> Outcome {
        trace(
            self.chunk,
            self.any,
            |ray| rays.intersect(ray).map(|hit| hit.t),
            |ray| rays.occluded(ray),
        )
    }
}

#[inline(always)]
fn trace(
    chunk: &[Ray],
    any: bool,
    intersect: impl Fn(&Ray) -> Option<f32>,
    occluded: impl Fn(&Ray) -> bool,
) -> Outcome {
    let mut outcome = Outcome::default();
    if any {
        outcome.hits = chunk.iter().filter(|ray| occluded(ray)).count();
    } else {
        for ray in chunk {
            if let Some(t) = intersect(ray) {
                outcome.hits += 1;
                outcome.distance += f64::from(t);
            }
        }
    }
    outcome
}

impl Contender<'_> {
    /// Traces a chunk on this thread.
    pub fn trace(&self, chunk: &[Ray], any: bool) -> Outcome {
        match self {
            Self::Ours(geometry) => geometry.run(Ours { chunk, any }),
            Self::Embree(scene) => {
                trace(chunk, any, |ray| scene.intersect(ray), |ray| scene.occluded(ray))
            }
        }
    }
}

/// Rays in a chunk: about a millisecond, less than what a scheduler gives at once.
const CHUNK: usize = 4096;

/// Millions of rays per second of each contender, and what came of the list.
///
/// The contenders trace each chunk in turn, several times; the least time of each chunk counts, so that neither other
/// programs nor a clock that changes favour one of them.
pub fn compare(
    contenders: &[Contender<'_>],
    list: &List,
    repetitions: usize,
) -> Vec<(f64, Outcome)> {
    let chunks: Vec<&[Ray]> = list.rays.chunks(CHUNK).collect();
    let mut least = vec![vec![Duration::MAX; chunks.len()]; contenders.len()];
    let mut outcomes = vec![Outcome::default(); contenders.len()];
    for repetition in 0..repetitions {
        for (i, chunk) in chunks.iter().enumerate() {
            for (who, contender) in contenders.iter().enumerate() {
                let start = Instant::now();
                let outcome = contender.trace(chunk, list.any);
                least[who][i] = least[who][i].min(start.elapsed());
                if repetition == 0 {
                    outcomes[who].hits += outcome.hits;
                    outcomes[who].distance += outcome.distance;
                }
            }
        }
    }
    let rate = |times: &Vec<Duration>| {
        list.rays.len() as f64 / times.iter().sum::<Duration>().as_secs_f64() * 1e-6
    };
    least.iter().map(rate).zip(outcomes).collect()
}
