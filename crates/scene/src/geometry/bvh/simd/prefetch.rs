//! Bringing memory to the nearest cache before it is asked for.
#![allow(unsafe_code, reason = "an instruction that has no safe function")]

use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};

/// The length of a cache line in bytes.
const LINE: usize = 64;

/// Prefetches all lines of an item.
#[inline(always)]
pub(super) fn prefetch<T>(items: &[T], index: usize) {
    let start = items.as_ptr().wrapping_add(index).cast::<i8>();
    for line in 0..size_of::<T>().div_ceil(LINE) {
        // SAFETY: SSE is part of the x86-64 baseline; a prefetch of any address at all reads nothing that a program could
        // notice and never faults.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(start.wrapping_add(line * LINE)) };
    }
}
