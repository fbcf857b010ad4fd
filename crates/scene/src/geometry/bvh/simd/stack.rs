//! A stack that is not zeroed.
#![allow(unsafe_code, reason = "zeroing the memory would cost as much as a tenth of a ray")]

use core::mem::MaybeUninit;

/// Up to `N` entries, in memory of its own: together with the length they would keep that in memory
/// as well, and every push and pop would wait for the one before.
pub(in crate::geometry::bvh) struct Stack<'m, T, const N: usize> {
    /// The first `length` are initialised.
    entries: &'m mut [MaybeUninit<T>; N],
    length: usize,
}

/// Memory for `N` entries.
pub(in crate::geometry::bvh) struct Memory<T, const N: usize>([MaybeUninit<T>; N]);

impl<T: Copy, const N: usize> Memory<T, N> {
    #[inline(always)]
    pub(in crate::geometry::bvh) fn new() -> Self {
        Self([const { MaybeUninit::uninit() }; N])
    }
}

impl<'m, T: Copy, const N: usize> Stack<'m, T, N> {
    #[inline(always)]
    pub(in crate::geometry::bvh) fn new(memory: &'m mut Memory<T, N>) -> Self {
        Self { entries: &mut memory.0, length: 0 }
    }

    #[inline(always)]
    pub(in crate::geometry::bvh) fn len(&self) -> usize {
        self.length
    }

    /// # Panics
    /// When it is full.
    #[inline(always)]
    pub(in crate::geometry::bvh) fn push(&mut self, entry: T) {
        self.entries[self.length].write(entry);
        self.length += 1;
    }

    #[inline(always)]
    pub(in crate::geometry::bvh) fn pop(&mut self) -> Option<T> {
        self.length = self.length.checked_sub(1)?;
        // SAFETY: the entry is below the former length.
        Some(unsafe { self.entries[self.length].assume_init() })
    }

    #[inline(always)]
    pub(in crate::geometry::bvh) fn as_mut_slice(&mut self) -> &mut [T] {
        let pushed = &mut self.entries[..self.length];
        // SAFETY: entries below the length are initialised, and so may be read as `T`.
        unsafe { &mut *(core::ptr::from_mut(pushed) as *mut [T]) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_pushed_last_is_popped_first() {
        let mut memory = Memory::<u32, 3>::new();
        let mut stack = Stack::new(&mut memory);
        assert_eq!(stack.pop(), None);
        for entry in [1, 2, 3] {
            stack.push(entry);
        }
        stack.as_mut_slice().swap(0, 2);
        assert_eq!(
            [stack.pop(), stack.pop(), stack.pop(), stack.pop()],
            [Some(1), Some(2), Some(3), None]
        );
        assert_eq!(stack.len(), 0);
    }
}
