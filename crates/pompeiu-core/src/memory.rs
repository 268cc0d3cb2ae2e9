//! Large pages behind large arrays.
//!
//! The first write to a page costs more than most work done on what it holds: above a microsecond for 4 KiB on a virtual
//! machine. Large pages, where the system has them, are a five-hundredth as many.

/// An empty vector for `capacity` elements.
pub fn with_capacity<T>(capacity: usize) -> Vec<T> {
    let vector = Vec::with_capacity(capacity);
    prefer_large_pages(&vector);
    vector
}

/// A vector of equal elements. Zeros take no memory before they are written to.
pub fn filled<T: Clone>(element: T, length: usize) -> Vec<T> {
    let vector = vec![element; length];
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
        assert!(filled(0_u64, 1 << 20).into_iter().all(|x| x == 0));
        assert!(filled(7_u8, 1 << 23).into_iter().all(|x| x == 7));
        assert!(with_capacity::<u8>(0).is_empty());
    }
}
