//! Independent uniform numbers.

use etendue_math::{Real, mix_u64};

use crate::sampler::address;
use crate::{Dimension, Pcg32, Sampler, uniform};

/// Independent uniform numbers: a [`Pcg32`] keyed by a hash of the address.
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
        uniform(&mut self.rng(dimension))
    }

    #[inline]
    fn sample_2d<T: Real>(&self, dimension: Dimension) -> [T; 2] {
        let mut rng = self.rng(dimension);
        [uniform(&mut rng), uniform(&mut rng)]
    }

    #[inline]
    fn rng(&self, dimension: Dimension) -> Pcg32 {
        Pcg32::from_hash(mix_u64(self.address, dimension.id() as u64))
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
    fn numbers_are_those_of_the_generator_at_the_address() {
        let points = Independent::at(1, [2, 3], u64::MAX);
        let mut rng = points.rng(FILM);
        let [x, y]: [f32; 2] = points.sample_2d(FILM);
        assert_eq!([x, y], [uniform(&mut rng), uniform(&mut rng)]);
        assert_eq!(x, points.sample_1d::<f32>(FILM));
    }
}
