//! What is asked of the system about memory: files mapped, and large pages behind large arrays.
//!
//! The only unsafe code of the crate is here.

use memmap2::Mmap;
use std::fs::File;
use std::io;

/// Maps a file that is not empty.
#[allow(
    unsafe_code,
    reason = "there is no safe way to map a file, and copying it costs as much as parsing it"
)]
pub(crate) fn map(file: &File) -> io::Result<Mmap> {
    // SAFETY: The map is read-only and private to this process, which writes no file it reads. What remains is a file
    // that another process changes during the read. If it writes, the bytes seen may be old or new; readers check
    // every value they use and take none as proof of another, so they return an error or a mesh that was never whole.
    // If it shortens the file, the system ends this process when a page behind the new end is touched. That is the
    // accepted risk, which every program that maps its input shares.
    unsafe { Mmap::map(file) }
}

/// An empty vector for `capacity` elements.
///
/// A page that is written first costs more than the numbers on it cost to parse; large pages, where the system has
/// them, make that a five-hundredth of the pages.
pub(crate) fn with_capacity<T>(capacity: usize) -> Vec<T> {
    let vector = Vec::with_capacity(capacity);
    prefer_large_pages(&vector);
    vector
}

/// A vector of zeros.
pub(crate) fn zeros(length: usize) -> Vec<u64> {
    let vector = vec![0; length];
    prefer_large_pages(&vector);
    vector
}

#[cfg(target_os = "linux")]
#[allow(unsafe_code, reason = "the standard library does not offer this advice")]
fn prefer_large_pages<T>(vector: &Vec<T>) {
    const LARGE_PAGE: usize = 1 << 21;
    let start = vector.as_ptr().cast::<libc::c_void>();
    let end = (start.addr() + vector.capacity() * size_of::<T>()) & !(LARGE_PAGE - 1);
    let first = start.addr().next_multiple_of(LARGE_PAGE);
    if first < end {
        // SAFETY: The range lies within memory that the vector owns. The advice changes the size of the pages behind
        // it, never what is on them; when the system does not take it, nothing happens.
        unsafe { libc::madvise(start.with_addr(first).cast_mut(), end - first, libc::MADV_HUGEPAGE) };
    }
}

#[cfg(not(target_os = "linux"))]
fn prefer_large_pages<T>(_: &Vec<T>) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn advice_leaves_the_content_alone() {
        let mut numbers: Vec<u32> = with_capacity(3_000_001);
        assert_eq!((numbers.len(), numbers.capacity()), (0, 3_000_001));
        numbers.extend(0..3_000_001);
        prefer_large_pages(&numbers);
        assert!(numbers.into_iter().eq(0..3_000_001));
        assert!(zeros(1 << 20).into_iter().all(|x| x == 0));
        assert!(with_capacity::<u8>(0).is_empty());
    }
}
