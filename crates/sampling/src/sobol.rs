//! The Owen-scrambled Sobol' sequence, two dimensions at a time.

use etendue_math::{Real, hash_u64, mix_u64};

use crate::owen::scramble_reversed;
use crate::sampler::address;
use crate::{Dimension, Pcg32, Sampler};

/// Owen-scrambled Sobol' points, padded: every dimension of a path gets its own shuffled and
/// scrambled copy of the two-dimensional Sobol' sequence.
///
/// ```text
/// i' = reverse(scramble(reverse(i), k₀))            index, shuffled within powers of two
/// x  = reverse(scramble(i', k₁)) · 2⁻³²             reverse(x) of the first dimension is i' itself
/// y  = reverse(scramble(P i', k₂)) · 2⁻³²           P: Pascal's triangle mod 2
/// ```
///
/// The keys are hashes of (seed, pixel, dimension). Within one dimension, the samples of a pixel
/// whose indices fill an aligned block of 2ᵏ form a (0, k, 2)-net: every elementary interval of
/// area 2⁻ᵏ holds exactly one. Different dimensions and pixels are independent.
///
/// Sample indices have 64 bits: each run of 2³² samples has keys of its own.
///
/// # Precision
/// Points have 32 scrambled bits: `f32` uses the upper 24. `f64` uses all 32 and fills the lower 21
/// with hashed bits, so that every number of the grid can occur.
///
/// # Source
/// B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020. The second dimension by
/// shifts instead of a loop over 32 direction numbers: A. G. M. Ahmed, "An Implementation Algorithm
/// of 2D Sobol Sequence Fast, Elegant, and Compact", EGSR 2024. Departure: reversals that cancel
/// are left out.
///
/// # Examples
/// ```
/// use etendue_sampling::{Decision, Dimension, Sampler, Sobol};
/// let film = Dimension::camera(Decision::Film);
/// let mut quadrants = [0; 4];
/// for i in 0..4 {
///     let [x, y]: [f32; 2] = Sobol::at(0, [0, 0], i).sample_2d(film);
///     quadrants[2 * (x * 2.0) as usize + (y * 2.0) as usize] += 1;
/// }
/// assert_eq!(quadrants, [1; 4]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sobol {
    address: u64,
    reversed_index: u32,
}

impl Sobol {
    /// The shuffled index and the keys of the two coordinates.
    #[inline]
    fn shuffle(&self, dimension: Dimension) -> (u32, [u32; 2]) {
        let keys = mix_u64(self.address, dimension.id() as u64);
        let index = scramble_reversed(self.reversed_index, keys as u32).reverse_bits();
        // A third key out of 64 hashed bits: the upper half of a product depends on all of them.
        let third = keys.wrapping_mul(0xd134_2543_de82_ef95) >> 32;
        (index, [(keys >> 32) as u32, third as u32])
    }
}

impl Sampler for Sobol {
    #[inline]
    fn at(seed: u64, pixel: [u32; 2], sample: u64) -> Self {
        Self {
            address: address(seed, pixel, sample >> 32),
            reversed_index: (sample as u32).reverse_bits(),
        }
    }

    #[inline]
    fn sample_1d<T: Real>(&self, dimension: Dimension) -> T {
        let (index, [key, _]) = self.shuffle(dimension);
        coordinate(index, key)
    }

    #[inline]
    fn sample_2d<T: Real>(&self, dimension: Dimension) -> [T; 2] {
        let (index, [key_x, key_y]) = self.shuffle(dimension);
        [coordinate(index, key_x), coordinate(pascal(index), key_y)]
    }

    #[inline]
    fn rng(&self, dimension: Dimension) -> Pcg32 {
        let keys = mix_u64(self.address, dimension.id() as u64);
        Pcg32::from_hash(mix_u64(keys, self.reversed_index as u64))
    }
}

/// Scrambles a reversed Sobol' coordinate and makes it a number in `[0, 1)`.
#[inline]
fn coordinate<T: Real>(reversed: u32, key: u32) -> T {
    let bits = scramble_reversed(reversed, key).reverse_bits();
    // The lower half reaches f64 only; for f32 the compiler drops it.
    let lower = hash_u64((key as u64) << 32 | bits as u64) as u32;
    T::from_random_bits((bits as u64) << 32 | lower as u64)
}

/// The second Sobol' coordinate of an index, bits reversed: the product with Pascal's triangle
/// modulo 2. Bit k of the result is the parity of the bits j of `x` with `C(j, k)` odd, that is
/// with k a sub-mask of j: a sum over supersets, done one bit of j at a time.
#[inline]
const fn pascal(mut x: u32) -> u32 {
    x ^= (x >> 16) & 0x0000_ffff;
    x ^= (x >> 8) & 0x00ff_00ff;
    x ^= (x >> 4) & 0x0f0f_0f0f;
    x ^= (x >> 2) & 0x3333_3333;
    x ^ (x >> 1) & 0x5555_5555
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{chi_squared_deviation, correlation};
    use crate::{Decision, Independent};

    const FILM: Dimension = Dimension::camera(Decision::Film);
    const LENS: Dimension = Dimension::camera(Decision::Lens);

    /// The second Sobol' dimension from its direction numbers, primitive polynomial x + 1.
    fn second_dimension_by_direction_numbers(index: u32) -> u32 {
        let (mut direction, mut sum) = (1_u32 << 31, 0);
        for bit in 0..32 {
            if index >> bit & 1 == 1 {
                sum ^= direction;
            }
            direction ^= direction >> 1;
        }
        sum
    }

    #[test]
    fn shifts_give_the_same_points_as_direction_numbers() {
        let hashed = (0..10_000).map(etendue_math::hash_u32);
        for index in (0..1000).chain(hashed).chain([u32::MAX]) {
            let want = second_dimension_by_direction_numbers(index);
            assert_eq!(pascal(index).reverse_bits(), want, "{index}");
        }
    }

    #[test]
    fn every_elementary_interval_holds_exactly_one_point() {
        for (log_n, start) in [(0, 0), (4, 0), (7, 1 << 7), (8, 3 << 8), (10, 5 << 32)] {
            for dimension in [FILM, LENS, Dimension::vertex(7, Decision::Direction)] {
                let n = 1_u64 << log_n;
                for log_x in 0..=log_n {
                    let mut hit = [false; 1 << 10];
                    for i in 0..n {
                        let points = Sobol::at(9, [3, 4], start + i);
                        let [x, y]: [f32; 2] = points.sample_2d(dimension);
                        let column = (x * (1_u32 << log_x) as f32) as usize;
                        let row = (y * (1_u32 << (log_n - log_x)) as f32) as usize;
                        let cell = column << (log_n - log_x) | row;
                        assert!(!hit[cell], "2^{log_n} points, 2^{log_x} columns");
                        hit[cell] = true;
                    }
                }
            }
        }
    }

    #[test]
    fn single_numbers_are_stratified_too() {
        let mut hit = [false; 256];
        for i in 0..256 {
            let u: f64 = Sobol::at(1, [0, 1], i).sample_1d(LENS);
            hit[(u * 256.0) as usize] = true;
        }
        assert_eq!(hit, [true; 256]);
    }

    #[test]
    fn the_same_sample_of_many_pixels_fills_the_square_evenly() {
        // Here nothing is stratified: evenness shows that the keys are uniform and independent.
        const SIDE: u32 = 128;
        for sample in [0, 1, 1 << 40] {
            let mut counts = [0.0; 256];
            let mut mean = 0.0;
            for (column, row) in (0..SIDE).flat_map(|x| (0..SIDE).map(move |y| (x, y))) {
                let [x, y]: [f32; 2] = Sobol::at(0, [column, row], sample).sample_2d(LENS);
                counts[(x * 16.0) as usize * 16 + (y * 16.0) as usize] += 1.0;
                mean += f64::from(x + y) / f64::from(2 * SIDE * SIDE);
            }
            let z = chi_squared_deviation(&counts, &[f64::from(SIDE * SIDE) / 256.0; 256]);
            // 5 standard deviations of a fixed seed, and not suspiciously even either; the mean of
            // 2·128² uniform numbers has a standard deviation of 0.0016.
            assert!(z.abs() < 5.0, "{z}");
            assert!((mean - 0.5).abs() < 0.008, "{mean}");
        }
    }

    #[test]
    fn pixels_and_dimensions_are_uncorrelated() {
        const N: u64 = 1 << 12;
        let at = |seed, pixel, i, d| Sobol::at(seed, pixel, i).sample_2d::<f64>(d);
        let base = |i| at(0, [8, 9], i, FILM)[0];
        // Shuffled stratified pairs vary less than independent ones, whose correlation has a
        // standard deviation of 1/√N = 0.016; 5 σ.
        let bound = 0.08;
        assert!(correlation(N, base, |i| at(0, [8, 9], i, FILM)[1]).abs() < bound);
        assert!(correlation(N, base, |i| at(1, [8, 9], i, FILM)[0]).abs() < bound);
        assert!(correlation(N, base, |i| at(0, [9, 9], i, FILM)[0]).abs() < bound);
        assert!(correlation(N, base, |i| at(0, [9, 8], i, FILM)[0]).abs() < bound);
        assert!(correlation(N, base, |i| at(0, [8, 9], i, LENS)[0]).abs() < bound);
        assert!(correlation(N, base, |i| at(0, [8, 9], i + (1 << 32), FILM)[0]).abs() < bound);
    }

    /// Root mean square error over 64 pixels of the mean of x·y (exactly 1/4) over 256 samples.
    fn error_of_product<S: Sampler>() -> f64 {
        let mean = |pixel| {
            let product = |i| {
                let [x, y] = S::at(0, [pixel, 0], i).sample_2d::<f64>(FILM);
                x * y
            };
            (0..256).map(product).sum::<f64>() / 256.0
        };
        ((0..64).map(|pixel| (mean(pixel) - 0.25).sqr()).sum::<f64>() / 64.0).sqrt()
    }

    #[test]
    fn a_smooth_integral_is_far_better_than_with_independent_points() {
        let (sobol, independent) = (error_of_product::<Sobol>(), error_of_product::<Independent>());
        // Independent: σ(xy)/√256 = 0.0138. Scrambled nets converge as N^-1.5 for smooth f.
        assert!((0.011..0.017).contains(&independent), "{independent}");
        assert!(sobol < independent / 20.0, "{sobol} {independent}");
    }

    #[test]
    fn generators_differ_between_samples_and_dimensions() {
        let rng = |sample, dimension| Sobol::at(0, [1, 2], sample).rng(dimension);
        assert_eq!(rng(3, FILM), rng(3, FILM));
        assert_ne!(rng(3, FILM), rng(4, FILM));
        assert_ne!(rng(3, FILM), rng(3 + (1 << 32), FILM));
        assert_ne!(rng(3, FILM), rng(3, LENS));
    }

    #[test]
    fn double_precision_extends_single_precision() {
        for i in 0..1000 {
            let points = Sobol::at(2, [1, 1], i);
            let [x, y]: [f32; 2] = points.sample_2d(LENS);
            let [wide_x, wide_y]: [f64; 2] = points.sample_2d(LENS);
            // The same leading 24 bits, truncated.
            assert!((0.0..f64::from(f32::EPSILON)).contains(&(wide_x - f64::from(x))));
            assert!((0.0..f64::from(f32::EPSILON)).contains(&(wide_y - f64::from(y))));
        }
    }
}
