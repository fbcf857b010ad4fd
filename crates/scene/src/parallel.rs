//! Loops over large arrays: on all cores with the feature `std`, on one without. The results do not depend on it.

use alloc::vec::Vec;

#[cfg(feature = "std")]
use rayon::prelude::*;

/// The fewest elements worth a task of their own.
#[cfg(feature = "std")]
const TASK: usize = 1 << 12;

/// What `f` makes of each element, in order.
pub(crate) fn map<T: Sync, U: Send>(items: &[T], f: impl Fn(&T) -> U + Sync + Send) -> Vec<U> {
    #[cfg(feature = "std")]
    return items.par_iter().with_min_len(TASK).map(f).collect();
    #[cfg(not(feature = "std"))]
    return items.iter().map(f).collect();
}

/// [`map`] for what takes a microsecond or more.
pub(crate) fn map_slowly<T: Sync, U: Send>(
    items: &[T],
    f: impl Fn(&T) -> U + Sync + Send,
) -> Vec<U> {
    #[cfg(feature = "std")]
    return items.par_iter().with_min_len(TASK >> 6).map(f).collect();
    #[cfg(not(feature = "std"))]
    return items.iter().map(f).collect();
}

/// Appends what `f` makes of each element, in order.
pub(crate) fn extend<T: Sync, U: Send>(
    to: &mut Vec<U>,
    items: &[T],
    f: impl Fn(&T) -> U + Sync + Send,
) {
    #[cfg(feature = "std")]
    to.par_extend(items.par_iter().with_min_len(TASK).map(f));
    #[cfg(not(feature = "std"))]
    to.extend(items.iter().map(f));
}

/// The first element that `f` is true of.
pub(crate) fn position<T: Sync>(
    items: &[T],
    f: impl Fn(&T) -> bool + Sync + Send,
) -> Option<usize> {
    // By blocks: whether another thread has found one is asked once for each.
    #[cfg(feature = "std")]
    return items
        .par_chunks(TASK)
        .enumerate()
        .find_map_first(|(number, block)| block.iter().position(&f).map(|at| number * TASK + at));
    #[cfg(not(feature = "std"))]
    return items.iter().position(f);
}

/// Puts what `f` makes of each element in the place of the same number, of which there are as many.
pub(crate) fn put<T: Sync, U: Send>(to: &mut [U], from: &[T], f: impl Fn(&T) -> U + Sync + Send) {
    #[cfg(feature = "std")]
    to.par_iter_mut().with_min_len(TASK).zip(from).for_each(|(to, from)| *to = f(from));
    #[cfg(not(feature = "std"))]
    to.iter_mut().zip(from).for_each(|(to, from)| *to = f(from));
}

/// Puts what `f` makes of each element in its place.
pub(crate) fn update<T: Copy + Send>(items: &mut [T], f: impl Fn(T) -> T + Sync + Send) {
    #[cfg(feature = "std")]
    items.par_iter_mut().with_min_len(TASK).for_each(|item| *item = f(*item));
    #[cfg(not(feature = "std"))]
    items.iter_mut().for_each(|item| *item = f(*item));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_elements_keep_their_order() {
        let numbers: Vec<usize> = (0..100_000).collect();
        let squares: Vec<usize> = numbers.iter().map(|n| n * n).collect();
        assert_eq!(map(&numbers, |n| n * n), squares);
        let mut places = numbers.clone();
        put(&mut places, &numbers, |n| n * n);
        assert_eq!(places, squares);
        update(&mut places, |n| n + 1);
        assert_eq!(places[99_999], 99_999 * 99_999 + 1);
        assert_eq!(position(&numbers, |n| n % 70_000 > 60_000), Some(60_001));
        assert_eq!(position(&numbers, |_| false), None);
    }
}
