//! Limits on the size of content that is compressed or used more than once, relative to the size of its file.
//!
//! A few bytes can stand for gigabytes: compressed zeros, an array shared by many pieces, a mesh shown by many nodes. Real meshes
//! do not expand that much, so content is refused beyond a size that follows from the size of the file.

/// Any file may expand to this many bytes.
const FLOOR: u64 = 1 << 26;

/// Up to [`GENEROUS`] bytes, content may be this many times as large as its file: far more than meshes in text or binary form
/// compress, and a quarter of the ratio that a file made to exhaust memory reaches.
const FACTOR_OF_SMALL: u64 = 256;

/// See [`FACTOR_OF_SMALL`].
const GENEROUS: u64 = 1 << 30;

/// Beyond [`GENEROUS`] bytes, content may be this many times as large as its file: several times the compression ratio of real
/// meshes of that size.
const FACTOR_OF_LARGE: u64 = 32;

/// How often uncompressed content may be used on average: pieces that share an array are rare.
const MOST_USES: u64 = 4;

/// The largest content, in bytes, of a file of `stored` bytes.
pub(crate) fn most_bytes(stored: u64) -> u64 {
    let small = stored.saturating_mul(FACTOR_OF_SMALL).min(GENEROUS);
    FLOOR.max(small).max(stored.saturating_mul(FACTOR_OF_LARGE))
}

/// The number of bytes that may still be used.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Allowance {
    most: u64,
    left: u64,
}

impl Allowance {
    /// The allowance of a file with `stored` bytes.
    pub(crate) fn of_file(stored: u64) -> Self {
        let most = most_bytes(stored);
        Self { most, left: most }
    }

    /// The allowance of uncompressed content: each byte may be used a few times.
    pub(crate) fn of_content(bytes: u64) -> Self {
        let most = FLOOR.max(bytes.saturating_mul(MOST_USES));
        Self { most, left: most }
    }

    /// Subtracts bytes from the allowance.
    ///
    /// # Errors
    /// The allowance at the start, if fewer bytes are left.
    pub(crate) fn take(&mut self, bytes: u64) -> Result<(), u64> {
        self.left = self.left.checked_sub(bytes).ok_or(self.most)?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_files_may_grow_less() {
        let most = [0, 1 << 18, 1 << 20, 1 << 22, 1 << 25, 1 << 30].map(most_bytes);
        assert_eq!(most, [1 << 26, 1 << 26, 1 << 28, 1 << 30, 1 << 30, 1 << 35]);
        assert!((0..64).map(|i| most_bytes(1 << i)).is_sorted());
        assert_eq!(most_bytes(u64::MAX), u64::MAX);
    }
}
