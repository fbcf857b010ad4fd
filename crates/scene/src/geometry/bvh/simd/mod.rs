//! Eight floats at a time, on what the processor offers.
//!
//! [`Simd`] is the interface to which the tests of boxes and triangles are written, once. Every
//! implementation gives the same bits: each operation is one IEEE 754 operation, none is fused.
//! [`Backend::run`] instantiates a [`Kernel`] for the best one.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
pub(super) mod pages;
mod portable;
#[cfg(target_arch = "x86_64")]
mod sse2;
mod stack;

use super::LANES;

pub(super) use stack::{Memory, Stack};

#[cfg(target_arch = "x86_64")]
mod prefetch;

/// Operations on eight floats. A value of an implementing type is the proof that the processor has
/// the instructions.
pub(in crate::geometry) trait Simd: Copy {
    /// Eight floats.
    type F: Copy;
    /// A set of lanes.
    type M: Copy;

    /// Runs a kernel as a function of its own, with the instructions.
    fn call<K: Kernel>(self, kernel: K) -> K::Output;
    fn splat(self, x: f32) -> Self::F;
    fn load(self, x: &[f32; LANES]) -> Self::F;
    fn store(self, x: Self::F) -> [f32; LANES];
    fn add(self, a: Self::F, b: Self::F) -> Self::F;
    fn sub(self, a: Self::F, b: Self::F) -> Self::F;
    fn mul(self, a: Self::F, b: Self::F) -> Self::F;
    fn div(self, a: Self::F, b: Self::F) -> Self::F;
    /// `a < b ? a : b`: the second operand where one is NaN.
    fn min(self, a: Self::F, b: Self::F) -> Self::F;
    /// `a > b ? a : b`: the second operand where one is NaN.
    fn max(self, a: Self::F, b: Self::F) -> Self::F;
    /// The lanes where `a < b`; not those with a NaN.
    fn lt(self, a: Self::F, b: Self::F) -> Self::M;
    /// The lanes where `a ≤ b`; not those with a NaN.
    fn le(self, a: Self::F, b: Self::F) -> Self::M;
    /// Lanes of both.
    fn and(self, a: Self::M, b: Self::M) -> Self::M;
    /// Lanes of either.
    fn or(self, a: Self::M, b: Self::M) -> Self::M;
    /// The lanes as bits, the first the lowest.
    fn bits(self, a: Self::M) -> u32;
    /// Asks for an item to be brought to the nearest cache; nothing where there is none of that index.
    fn prefetch<T>(self, items: &[T], index: usize);
}

/// A computation written over [`Simd`]. Its `run` must be `#[inline(always)]`, and so must
/// everything that it passes vectors to.
pub(in crate::geometry) trait Kernel {
    type Output;
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

/// The implementations; found out once, when a geometry is built.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) enum Backend {
    #[cfg_attr(
        target_arch = "x86_64",
        allow(dead_code, reason = "tests compare it with the others")
    )]
    Portable,
    /// Part of the x86-64 baseline.
    #[cfg(target_arch = "x86_64")]
    Sse2(sse2::Sse2),
    #[cfg(target_arch = "x86_64")]
    Avx2(avx2::Avx2),
    #[cfg(target_arch = "x86_64")]
    Avx512(avx512::Avx512),
}

impl Backend {
    /// The best one on this processor.
    pub(in crate::geometry) fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            match (avx512::Avx512::detect(), avx2::Avx2::detect()) {
                (Some(simd), _) => Self::Avx512(simd),
                (None, Some(simd)) => Self::Avx2(simd),
                (None, None) => Self::Sse2(sse2::Sse2::new()),
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            Self::Portable
        }
    }

    /// All that this processor can run.
    #[cfg(test)]
    pub(in crate::geometry) fn all() -> alloc::vec::Vec<Self> {
        let mut all = alloc::vec![Self::Portable];
        #[cfg(target_arch = "x86_64")]
        {
            all.push(Self::Sse2(sse2::Sse2::new()));
            all.extend(avx2::Avx2::detect().map(Self::Avx2));
            all.extend(avx512::Avx512::detect().map(Self::Avx512));
        }
        all
    }

    #[inline]
    pub(in crate::geometry) fn run<K: Kernel>(self, kernel: K) -> K::Output {
        match self {
            Self::Portable => kernel.run(portable::Portable),
            #[cfg(target_arch = "x86_64")]
            Self::Sse2(simd) => kernel.run(simd),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(simd) => simd.run(kernel),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(simd) => simd.run(kernel),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every operation on every pair of two vectors of awkward numbers.
    struct Everything;

    impl Kernel for Everything {
        type Output = alloc::vec::Vec<u32>;
        #[inline(always)]
        fn run<S: Simd>(self, simd: S) -> Self::Output {
            let a = [0.0, -0.0, 1.0, f32::NAN, f32::INFINITY, 1e-40, 3e38, -7.25];
            let mut bits = alloc::vec::Vec::new();
            for shift in 0..LANES {
                let b: [f32; LANES] = core::array::from_fn(|i| a[(i + shift) % LANES]);
                let (x, y) = (simd.load(&a), simd.load(&b));
                let (less, at_most, reverse) = (simd.lt(x, y), simd.le(x, y), simd.le(y, x));
                let masks = [less, at_most, simd.and(at_most, reverse), simd.or(less, reverse)];
                bits.extend(masks.map(|mask| simd.bits(mask)));
                let results = [
                    simd.add(x, y),
                    simd.sub(x, y),
                    simd.mul(x, y),
                    simd.div(x, y),
                    simd.min(x, y),
                    simd.max(x, y),
                    simd.splat(b[0]),
                ];
                // Which NaN an operation gives is not fixed by IEEE 754, that it is one is.
                let canonical = |x: f32| if x.is_nan() { f32::NAN.to_bits() } else { x.to_bits() };
                bits.extend(results.iter().flat_map(|&r| simd.store(r).map(canonical)));
            }
            bits
        }
    }

    #[test]
    fn all_implementations_give_the_same_bits() {
        let want = Backend::Portable.run(Everything);
        for backend in Backend::all() {
            assert_eq!(backend.run(Everything), want, "{backend:?}");
        }
    }
}
