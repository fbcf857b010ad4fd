//! Eight floats in an array.

use super::{Kernel, LANES, Simd};

/// Works everywhere; compilers turn most of it into vector instructions.
#[derive(Clone, Copy, Debug)]
pub(in crate::geometry) struct Portable;

type Array = [f32; LANES];

#[inline(always)]
fn map(a: Array, b: Array, f: impl Fn(f32, f32) -> f32) -> Array {
    core::array::from_fn(|i| f(a[i], b[i]))
}

#[inline(always)]
fn mask(a: Array, b: Array, f: impl Fn(f32, f32) -> bool) -> u32 {
    (0..LANES).fold(0, |mask, i| mask | u32::from(f(a[i], b[i])) << i)
}

impl Simd for Portable {
    type F = Array;
    type M = u32;

    #[inline(never)]
    fn call<K: Kernel>(self, kernel: K) -> K::Output {
        kernel.run(self)
    }
    #[inline(always)]
    fn splat(self, x: f32) -> Array {
        [x; LANES]
    }
    #[inline(always)]
    fn load(self, x: &Array) -> Array {
        *x
    }
    #[inline(always)]
    fn store(self, x: Array) -> Array {
        x
    }
    #[inline(always)]
    fn add(self, a: Array, b: Array) -> Array {
        map(a, b, |a, b| a + b)
    }
    #[inline(always)]
    fn sub(self, a: Array, b: Array) -> Array {
        map(a, b, |a, b| a - b)
    }
    #[inline(always)]
    fn mul(self, a: Array, b: Array) -> Array {
        map(a, b, |a, b| a * b)
    }
    #[inline(always)]
    fn div(self, a: Array, b: Array) -> Array {
        map(a, b, |a, b| a / b)
    }
    #[inline(always)]
    fn min(self, a: Array, b: Array) -> Array {
        map(a, b, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn max(self, a: Array, b: Array) -> Array {
        map(a, b, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn lt(self, a: Array, b: Array) -> u32 {
        mask(a, b, |a, b| a < b)
    }
    #[inline(always)]
    fn le(self, a: Array, b: Array) -> u32 {
        mask(a, b, |a, b| a <= b)
    }
    #[inline(always)]
    fn and(self, a: u32, b: u32) -> u32 {
        a & b
    }
    #[inline(always)]
    fn or(self, a: u32, b: u32) -> u32 {
        a | b
    }
    #[inline(always)]
    fn bits(self, a: u32) -> u32 {
        a
    }
    #[inline(always)]
    fn prefetch<T>(self, _: &[T], _: usize) {}
}
