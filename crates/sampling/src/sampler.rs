//! What a renderer asks of a source of random numbers.

use etendue_math::{Real, mix_u64};

use crate::{Dimension, Pcg32};

/// Uniform numbers addressed by (seed, pixel, sample index, dimension).
///
/// The same address gives the same number, whatever was asked before: there is no state, no order
/// and no thread. A dimension is one decision: it is asked for *once* per sample, by one of the
/// three functions, because numbers at one address are not independent of each other.
///
/// # Examples
/// ```
/// use etendue_sampling::{Decision, Dimension, Sampler, Sobol};
/// let points = Sobol::at(0, [12, 34], 5);
/// let [x, y]: [f32; 2] = points.sample_2d(Dimension::camera(Decision::Film));
/// assert!((0.0..1.0).contains(&x) && (0.0..1.0).contains(&y));
/// assert_eq!([x, y], Sobol::at(0, [12, 34], 5).sample_2d(Dimension::camera(Decision::Film)));
/// ```
pub trait Sampler: Copy {
    /// The numbers of sample `sample` of pixel `pixel` (column, row) under `seed`.
    fn at(seed: u64, pixel: [u32; 2], sample: u64) -> Self;

    /// One uniform number in `[0, 1)`.
    fn sample_1d<T: Real>(&self, dimension: Dimension) -> T;

    /// Two uniform numbers in `[0, 1)`, a point of the unit square.
    fn sample_2d<T: Real>(&self, dimension: Dimension) -> [T; 2];

    /// A generator for a decision that takes an unknown number of uniforms, such as tracking
    /// through a heterogeneous medium.
    fn rng(&self, dimension: Dimension) -> Pcg32;
}

/// Hash of the part of an address that all dimensions of a sample share.
#[inline]
pub(crate) fn address(seed: u64, [x, y]: [u32; 2], sample: u64) -> u64 {
    let pixel = (y as u64) << 32 | x as u64;
    mix_u64(mix_u64(mix_u64(0, seed), pixel), sample)
}
