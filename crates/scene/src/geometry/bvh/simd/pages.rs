//! Large pages for large arrays.
#![cfg_attr(
    all(feature = "std", target_os = "linux"),
    allow(unsafe_code, reason = "a call of the operating system")
)]

use alloc::vec::Vec;

/// An empty vector with room for so many items, in pages of two megabytes where the operating system has them: a ray touches
/// memory at so many places that the processor does not find the addresses of small pages in its tables.
pub(in crate::geometry::bvh) fn with_capacity<T>(capacity: usize) -> Vec<T> {
    let items = Vec::with_capacity(capacity);
    #[cfg(all(feature = "std", target_os = "linux"))]
    advise(&items);
    items
}

#[cfg(all(feature = "std", target_os = "linux"))]
fn advise<T>(items: &Vec<T>) {
    /// Advice is about whole pages; those are what it is for.
    const PAGE: usize = 1 << 21;
    let start = items.as_ptr().addr();
    let end = start + items.capacity() * size_of::<T>();
    let (from, to) = (start.next_multiple_of(PAGE), end / PAGE * PAGE);
    if from < to {
        let place = items.as_ptr().cast::<u8>().wrapping_add(from - start).cast_mut();
        // SAFETY: the pages lie within memory that the vector owns, and this advice changes nothing of what is read there. That it
        // is not followed is no error.
        let _ = unsafe { libc::madvise(place.cast(), to - from, libc::MADV_HUGEPAGE) };
    }
}
