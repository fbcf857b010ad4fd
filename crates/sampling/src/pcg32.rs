//! The PCG32 generator.

use core::convert::Infallible;

use etendue_math::Real;
use rand_core::{Rng, SeedableRng, TryRng, utils};

const MULTIPLIER: u64 = 6_364_136_223_846_793_005;

/// A PCG generator, XSH-RR 64/32: 64 bits of state, 2⁶³ streams, 32 bits a step, period 2⁶⁴.
///
/// ```text
/// state ← state · 6364136223846793005 + (2 stream + 1)
/// output = rotate_right₃₂(((state >> 18) ^ state) >> 27, state >> 59)      of the state before
/// ```
///
/// It implements the traits of [`rand_core`], by which it works with the `rand` ecosystem. Not for
/// cryptography.
///
/// # Source
/// M. O'Neill, "PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for
/// Random Number Generation", HMC-CS-2014-0905, 2014; seeding as in the reference `pcg32_srandom`.
///
/// # Examples
/// ```
/// use etendue_sampling::{Pcg32, uniform};
/// use etendue_sampling::rand_core::Rng;
/// let mut rng = Pcg32::new(42, 54);
/// assert_eq!(rng.next_u32(), 0xa15c_02b7);
/// let u: f32 = uniform(&mut rng);
/// assert!((0.0..1.0).contains(&u));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pcg32 {
    state: u64,
    increment: u64,
}

impl Pcg32 {
    /// The generator started at `seed` on `stream`; the top bit of `stream` is ignored.
    #[inline]
    pub const fn new(seed: u64, stream: u64) -> Self {
        let increment = stream << 1 | 1;
        // The reference's two steps around adding the seed, from state 0.
        let state = increment.wrapping_add(seed).wrapping_mul(MULTIPLIER).wrapping_add(increment);
        Self { state, increment }
    }

    /// The generator in a state that is already well mixed, such as a hash: its first output is
    /// that state's permutation, without the steps that [`Pcg32::new`] spends on mixing.
    #[inline]
    pub(crate) const fn from_hash(state: u64) -> Self {
        // Stream 0 of the reference: an increment of 1.
        Self { state, increment: 1 }
    }

    #[inline]
    const fn step(&mut self) -> u32 {
        let state = self.state;
        self.state = state.wrapping_mul(MULTIPLIER).wrapping_add(self.increment);
        let xor_shifted = (((state >> 18) ^ state) >> 27) as u32;
        xor_shifted.rotate_right((state >> 59) as u32)
    }
}

impl TryRng for Pcg32 {
    type Error = Infallible;

    #[inline]
    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok(self.step())
    }
    #[inline]
    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        utils::next_u64_via_u32(self)
    }
    #[inline]
    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        utils::fill_bytes_via_next_word(bytes, || Ok(self.step()))
    }
}

impl SeedableRng for Pcg32 {
    /// Seed, then stream, both little-endian.
    type Seed = [u8; 16];

    fn from_seed(seed: Self::Seed) -> Self {
        let [state, stream] = utils::read_words(&seed);
        Self::new(state, stream)
    }
}

/// A uniform number in `[0, 1)` with as many random bits as the significand has: 24 of one
/// `next_u32` for `f32`, 53 of one `next_u64` for `f64`. Never rounds up to 1.
#[inline]
pub fn uniform<T: Real>(rng: &mut impl Rng) -> T {
    let bits =
        if T::SIGNIFICAND_BITS <= 32 { u64::from(rng.next_u32()) << 32 } else { rng.next_u64() };
    T::from_random_bits(bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts down from `u32::MAX`, the hardest word to turn into a number below 1.
    struct Extreme(u32);
    impl TryRng for Extreme {
        type Error = Infallible;
        fn try_next_u32(&mut self) -> Result<u32, Infallible> {
            self.0 = self.0.wrapping_sub(1);
            Ok(self.0)
        }
        fn try_next_u64(&mut self) -> Result<u64, Infallible> {
            utils::next_u64_via_u32(self)
        }
        fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
            bytes.fill(0xff);
            Ok(())
        }
    }

    #[test]
    fn output_is_that_of_the_reference_demo() {
        let mut rng = Pcg32::new(42, 54);
        let want =
            [0xa15c_02b7, 0x7b47_f409, 0xba1d_3330, 0x83d2_f293, 0xbfa4_784b, 0xcbed_606e_u32];
        assert_eq!(want.map(|_| rng.next_u32()), want);
    }

    #[test]
    fn bytes_and_wide_words_are_the_same_stream() {
        let [mut words, mut wide, mut bytes] = [(); 3].map(|()| Pcg32::new(1, 2));
        let (low, high) = (words.next_u32(), words.next_u32());
        assert_eq!(wide.next_u64(), u64::from(high) << 32 | u64::from(low));
        let mut filled = [0; 5];
        bytes.fill_bytes(&mut filled);
        assert_eq!(filled[..4], low.to_le_bytes());
        assert_eq!(filled[4], high.to_le_bytes()[0]);
    }

    #[test]
    fn byte_seeds_are_seed_and_stream() {
        let mut seed = [0; 16];
        (seed[0], seed[8]) = (42, 54);
        assert_eq!(Pcg32::from_seed(seed), Pcg32::new(42, 54));
    }

    #[test]
    fn uniform_numbers_stay_below_one() {
        assert_eq!(uniform::<f32>(&mut Extreme(0)), f32::ONE_MINUS_EPSILON);
        assert!(uniform::<f64>(&mut Extreme(0)) < 1.0);
    }
}
