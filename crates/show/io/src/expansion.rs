//! How much larger than its file a content may be that is compressed, or used more than once.
//!
//! A few bytes can stand for gigabytes: compressed zeros, an array that many pieces share, a mesh that many nodes show. A mesh that is
//! meant to be read is not like that, so content is refused beyond a size that follows from the size of the file.

/// Any file may hold this many bytes.
const FLOOR: u64 = 1 << 26;

/// Up to [`GENEROUS`] bytes, content may be this many times as large as its file: far more than text or coordinates of a mesh
/// shrink, a quarter of what a file made only to exhaust memory reaches.
const FACTOR_OF_SMALL: u64 = 256;

/// See [`FACTOR_OF_SMALL`].
const GENEROUS: u64 = 1 << 30;

/// Beyond [`GENEROUS`] bytes, content may be this many times as large as its file, several times what meshes of that size shrink.
const FACTOR_OF_LARGE: u64 = 32;

/// How often content that is not compressed may be used on average: pieces that share an array are rare.
const MOST_USES: u64 = 4;

/// The number of bytes that a file of `stored` bytes may hold.
pub(crate) fn most_bytes(stored: u64) -> u64 {
    let small = stored.saturating_mul(FACTOR_OF_SMALL).min(GENEROUS);
    FLOOR.max(small).max(stored.saturating_mul(FACTOR_OF_LARGE))
}

/// Bytes that may still be taken.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Allowance {
    most: u64,
    left: u64,
}

impl Allowance {
    /// That of a file with `stored` bytes.
    pub(crate) fn of_file(stored: u64) -> Self {
        let most = most_bytes(stored);
        Self { most, left: most }
    }

    /// That of content that is not compressed: each byte may be used a few times.
    pub(crate) fn of_content(bytes: u64) -> Self {
        let most = FLOOR.max(bytes.saturating_mul(MOST_USES));
        Self { most, left: most }
    }

    /// Takes bytes off what is left.
    ///
    /// # Errors
    /// The number of bytes there were at first, when fewer are left.
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
