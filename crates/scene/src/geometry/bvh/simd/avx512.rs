//! Eight floats in one AVX register, and lanes in a mask register.
#![allow(unsafe_code, reason = "vector instructions beyond the baseline")]

use core::arch::x86_64::{__m256, __mmask8, _CMP_LE_OQ, _CMP_LT_OQ, _mm256_cmp_ps_mask};

use super::avx2::Avx2;
use super::{Kernel, LANES, Simd};

/// Proof that the processor has AVX-512 F, VL, DQ and BW: only [`detect`](Self::detect) makes one.
///
/// Vectors stay at 256 bits: what it brings is twice the registers, and comparisons whose result is
/// a mask at once.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct Avx512(Avx2);

impl Avx512 {
    /// `None` on a processor without; without `std`, what the target promises decides.
    pub(super) fn detect() -> Option<Self> {
        #[cfg(feature = "std")]
        let present = std::arch::is_x86_feature_detected!("avx512f")
            && std::arch::is_x86_feature_detected!("avx512vl")
            && std::arch::is_x86_feature_detected!("avx512dq")
            && std::arch::is_x86_feature_detected!("avx512bw");
        #[cfg(not(feature = "std"))]
        let present = cfg!(all(
            target_feature = "avx512f",
            target_feature = "avx512vl",
            target_feature = "avx512dq",
            target_feature = "avx512bw"
        ));
        if present { Avx2::detect().map(Self) } else { None }
    }

    /// Compiles and runs a kernel with the instructions.
    #[inline]
    pub(super) fn run<K: Kernel>(self, kernel: K) -> K::Output {
        // SAFETY: `self` proves that the processor has the features.
        unsafe { run(self, kernel) }
    }
}

// These features include `fma`, which AVX2's do not: products and sums stay apart all the same, because
// Rust lets no compiler contract them. A test compares the bits.
#[inline]
#[target_feature(enable = "avx2,bmi1,bmi2,avx512f,avx512vl,avx512dq,avx512bw")]
fn run<K: Kernel>(simd: Avx512, kernel: K) -> K::Output {
    kernel.run(simd)
}

impl Simd for Avx512 {
    type F = __m256;
    type M = __mmask8;

    #[inline(never)]
    fn call<K: Kernel>(self, kernel: K) -> K::Output {
        self.run(kernel)
    }
    #[inline(always)]
    fn splat(self, x: f32) -> __m256 {
        self.0.splat(x)
    }
    #[inline(always)]
    fn load(self, x: &[f32; LANES]) -> __m256 {
        self.0.load(x)
    }
    #[inline(always)]
    fn store(self, x: __m256) -> [f32; LANES] {
        self.0.store(x)
    }
    #[inline(always)]
    fn add(self, a: __m256, b: __m256) -> __m256 {
        self.0.add(a, b)
    }
    #[inline(always)]
    fn sub(self, a: __m256, b: __m256) -> __m256 {
        self.0.sub(a, b)
    }
    #[inline(always)]
    fn mul(self, a: __m256, b: __m256) -> __m256 {
        self.0.mul(a, b)
    }
    #[inline(always)]
    fn div(self, a: __m256, b: __m256) -> __m256 {
        self.0.div(a, b)
    }
    #[inline(always)]
    fn min(self, a: __m256, b: __m256) -> __m256 {
        self.0.min(a, b)
    }
    #[inline(always)]
    fn max(self, a: __m256, b: __m256) -> __m256 {
        self.0.max(a, b)
    }
    #[inline(always)]
    fn lt(self, a: __m256, b: __m256) -> __mmask8 {
        // SAFETY: `self` proves that the processor has AVX-512 F and VL.
        unsafe { _mm256_cmp_ps_mask::<_CMP_LT_OQ>(a, b) }
    }
    #[inline(always)]
    fn le(self, a: __m256, b: __m256) -> __mmask8 {
        // SAFETY: `self` proves that the processor has AVX-512 F and VL.
        unsafe { _mm256_cmp_ps_mask::<_CMP_LE_OQ>(a, b) }
    }
    #[inline(always)]
    fn and(self, a: __mmask8, b: __mmask8) -> __mmask8 {
        a & b
    }
    #[inline(always)]
    fn or(self, a: __mmask8, b: __mmask8) -> __mmask8 {
        a | b
    }
    #[inline(always)]
    fn bits(self, a: __mmask8) -> u32 {
        u32::from(a)
    }
    #[inline(always)]
    fn prefetch<T>(self, items: &[T], index: usize) {
        self.0.prefetch(items, index);
    }
}
