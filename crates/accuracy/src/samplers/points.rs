//! The points that directions are drawn from.

use etendue_sampling::{Decision, Dimension, Independent, Sampler, Sobol};

use super::strategy::Uniforms;

/// A kind of points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointSet {
    /// Independent numbers.
    Independent,
    /// Owen-scrambled Sobol' points.
    Sobol,
}

impl PointSet {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Independent, Self::Sobol];

    /// Point number `index` of the replication.
    #[inline]
    pub fn uniforms(self, seed: u64, replication: u32, index: u32) -> Uniforms {
        match self {
            Self::Independent => uniforms::<Independent>(seed, replication, index),
            Self::Sobol => uniforms::<Sobol>(seed, replication, index),
        }
    }
}

/// A point as a path tracer draws it: replications are pixels, each with a scramble of its own.
#[inline]
fn uniforms<S: Sampler>(seed: u64, replication: u32, index: u32) -> Uniforms {
    let points = S::at(seed, [replication, 0], u64::from(index));
    Uniforms {
        lobe: points.sample_1d(Dimension::vertex(1, Decision::LobeChoice)),
        direction: points.sample_2d(Dimension::vertex(1, Decision::Direction)),
    }
}
