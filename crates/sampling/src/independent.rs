//! Independent uniform numbers.

use etendue_math::{Real, hash_u64, mix_u64};

use crate::sampler::address;
use crate::{Dimension, Pcg32, Sampler};

/// Independent uniform numbers: hashes of the address.
///
/// ```text
/// h = hash(address)        x = the upper bits of h,  y = the lower half of h in f32, hash(h) in f64
/// ```
///
/// The reference that [`Sobol`](crate::Sobol) is judged against, and the choice where an error
/// estimate needs independent samples.
///
/// # Examples
/// ```
/// use etendue_sampling::{Decision, Dimension, Independent, Sampler};
/// let u: f64 = Independent::at(1, [0, 0], 7).sample_1d(Dimension::vertex(3, Decision::Roulette));
/// assert!((0.0..1.0).contains(&u));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Independent {
    address: u64,
}

impl Sampler for Independent {
    #[inline]
    fn at(seed: u64, pixel: [u32; 2], sample: u64) -> Self {
        Self { address: address(seed, pixel, sample) }
    }

    #[inline]
    fn sample_1d<T: Real>(&self, dimension: Dimension) -> T {
        T::from_random_bits(self.hash(dimension))
    }

    #[inline]
    fn sample_2d<T: Real>(&self, dimension: Dimension) -> [T; 2] {
        let first = self.hash(dimension);
        let second = if T::SIGNIFICAND_BITS <= 32 { first << 32 } else { hash_u64(first) };
        [first, second].map(T::from_random_bits)
    }

    #[inline]
    fn rng(&self, dimension: Dimension) -> Pcg32 {
        Pcg32::from_hash(self.hash(dimension))
    }
}

impl Independent {
    #[inline]
    fn hash(self, dimension: Dimension) -> u64 {
        mix_u64(self.address, dimension.id() as u64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Decision;
    use crate::testing::{chi_squared_deviation, correlation};

    const FILM: Dimension = Dimension::camera(Decision::Film);

    #[test]
    fn points_fill_the_square_evenly() {
        const N: u64 = 1 << 16;
        let mut counts = [0.0; 256];
        for i in 0..N {
            let [x, y]: [f32; 2] = Independent::at(3, [5, 6], i).sample_2d(FILM);
            counts[(x * 16.0) as usize * 16 + (y * 16.0) as usize] += 1.0;
        }
        let z = chi_squared_deviation(&counts, &[N as f64 / 256.0; 256]);
        // 5 standard deviations of a fixed seed, and not suspiciously even either.
        assert!(z.abs() < 5.0, "{z}");
    }

    #[test]
    fn neighbouring_addresses_are_uncorrelated() {
        const N: u64 = 10_000;
        let at = |seed, pixel, i, d| Independent::at(seed, pixel, i).sample_1d::<f64>(d);
        let base = |i| at(0, [8, 9], i, FILM);
        // The correlation of N independent pairs has a standard deviation of 1/√N = 0.01; 5 σ.
        let bound = 0.05;
        assert!(correlation(N, base, |i| at(1, [8, 9], i, FILM)).abs() < bound);
        assert!(correlation(N, base, |i| at(0, [9, 9], i, FILM)).abs() < bound);
        assert!(correlation(N, base, |i| at(0, [9, 8], i, FILM)).abs() < bound);
        assert!(correlation(N, base, |i| at(0, [8, 9], i + 1, FILM)).abs() < bound);
        let lens = Dimension::camera(Decision::Lens);
        assert!(correlation(N, base, |i| at(0, [8, 9], i, lens)).abs() < bound);
        let next = Dimension::vertex(1, Decision::Film);
        assert!(correlation(N, base, |i| at(0, [8, 9], i, next)).abs() < bound);
    }

    #[test]
    fn the_two_coordinates_are_uncorrelated_in_both_precisions() {
        const N: u64 = 10_000;
        let at = |i| Independent::at(0, [8, 9], i);
        let narrow = |i, axis: usize| f64::from(at(i).sample_2d::<f32>(FILM)[axis]);
        let wide = |i, axis: usize| at(i).sample_2d::<f64>(FILM)[axis];
        // 5 standard deviations, as above.
        assert!(correlation(N, |i| narrow(i, 0), |i| narrow(i, 1)).abs() < 0.05);
        assert!(correlation(N, |i| wide(i, 0), |i| wide(i, 1)).abs() < 0.05);
        // The lower bits of one coordinate and the upper ones of the other.
        let lower = |i| (wide(i, 0) * 4_294_967_296.0).fract();
        assert!(correlation(N, lower, |i| wide(i, 1)).abs() < 0.05);
    }

    #[test]
    fn double_precision_extends_the_first_coordinate() {
        for i in 0..1000 {
            let points = Independent::at(2, [1, 1], i);
            let (x, wide): (f32, f64) = (points.sample_1d(FILM), points.sample_1d(FILM));
            // The same leading 24 bits, truncated.
            assert!((0.0..f64::from(f32::EPSILON)).contains(&(wide - f64::from(x))));
        }
    }
}
