//! Eight floats in two SSE2 registers.
#![allow(unsafe_code, reason = "vector loads and stores go through pointers")]

use core::arch::x86_64::{
    __m128, _mm_add_ps, _mm_and_ps, _mm_cmple_ps, _mm_cmplt_ps, _mm_div_ps, _mm_loadu_ps,
    _mm_max_ps, _mm_min_ps, _mm_movemask_ps, _mm_mul_ps, _mm_or_ps, _mm_set1_ps, _mm_storeu_ps,
    _mm_sub_ps,
};

use super::prefetch::prefetch;
use super::{Kernel, LANES, Simd};

/// The baseline of x86-64.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct Sse2(());

impl Sse2 {
    pub(super) fn new() -> Self {
        Self(())
    }
}

type Pair = [__m128; 2];

/// One instruction on both halves.
macro_rules! both {
    ($instruction:ident, $a:ident, $b:ident) => {
        // SAFETY: SSE2 is part of the x86-64 baseline, the only target this file is compiled for.
        unsafe { [$instruction($a[0], $b[0]), $instruction($a[1], $b[1])] }
    };
}

impl Simd for Sse2 {
    type F = Pair;
    type M = Pair;

    #[inline(never)]
    fn call<K: Kernel>(self, kernel: K) -> K::Output {
        kernel.run(self)
    }
    #[inline(always)]
    fn splat(self, x: f32) -> Pair {
        // SAFETY: as in `both`.
        unsafe { [_mm_set1_ps(x); 2] }
    }
    #[inline(always)]
    fn load(self, x: &[f32; LANES]) -> Pair {
        // SAFETY: as in `both`; both loads of four floats lie within the eight of the array.
        unsafe { [_mm_loadu_ps(x.as_ptr()), _mm_loadu_ps(x.as_ptr().add(4))] }
    }
    #[inline(always)]
    fn store(self, x: Pair) -> [f32; LANES] {
        let mut out = [0.0; LANES];
        // SAFETY: as in `both`; both stores of four floats lie within the eight of the array.
        unsafe {
            _mm_storeu_ps(out.as_mut_ptr(), x[0]);
            _mm_storeu_ps(out.as_mut_ptr().add(4), x[1]);
        }
        out
    }
    #[inline(always)]
    fn add(self, a: Pair, b: Pair) -> Pair {
        both!(_mm_add_ps, a, b)
    }
    #[inline(always)]
    fn sub(self, a: Pair, b: Pair) -> Pair {
        both!(_mm_sub_ps, a, b)
    }
    #[inline(always)]
    fn mul(self, a: Pair, b: Pair) -> Pair {
        both!(_mm_mul_ps, a, b)
    }
    #[inline(always)]
    fn div(self, a: Pair, b: Pair) -> Pair {
        both!(_mm_div_ps, a, b)
    }
    #[inline(always)]
    fn min(self, a: Pair, b: Pair) -> Pair {
        both!(_mm_min_ps, a, b)
    }
    #[inline(always)]
    fn max(self, a: Pair, b: Pair) -> Pair {
        both!(_mm_max_ps, a, b)
    }
    #[inline(always)]
    fn lt(self, a: Pair, b: Pair) -> Pair {
        both!(_mm_cmplt_ps, a, b)
    }
    #[inline(always)]
    fn le(self, a: Pair, b: Pair) -> Pair {
        both!(_mm_cmple_ps, a, b)
    }
    #[inline(always)]
    fn and(self, a: Pair, b: Pair) -> Pair {
        both!(_mm_and_ps, a, b)
    }
    #[inline(always)]
    fn or(self, a: Pair, b: Pair) -> Pair {
        both!(_mm_or_ps, a, b)
    }
    #[inline(always)]
    fn bits(self, a: Pair) -> u32 {
        // SAFETY: as in `both`.
        let [low, high] = unsafe { [_mm_movemask_ps(a[0]), _mm_movemask_ps(a[1])] };
        (low | high << 4) as u32
    }
    #[inline(always)]
    fn prefetch<T>(self, items: &[T], index: usize) {
        prefetch(items, index);
    }
}
