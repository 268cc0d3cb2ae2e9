//! One vertex for equal positions.

use std::hash::{BuildHasher, RandomState};
use std::sync::LazyLock;

/// Gives equal positions the same index, in the order of first appearance. Zeros of either sign are equal.
#[derive(Default)]
pub(crate) struct Welder {
    table: Table,
    positions: Vec<[f64; 3]>,
}

impl Welder {
    /// The index of a position without NaN.
    pub(crate) fn index(&mut self, position: [f64; 3]) -> u32 {
        let position = without_negative_zeros(position);
        self.index_with_hash(position, self.table.hash(position))
    }

    /// As [`index`](Self::index), for what a [`LocalWelder`] has found.
    pub(crate) fn index_with_hash(&mut self, position: [f64; 3], hash: u32) -> u32 {
        let next = self.positions.len() as u32;
        let index = self.table.find_or_insert(hash, next, |index| self.positions[index as usize] == position);
        if index == next {
            self.positions.push(position);
        }
        index
    }

    pub(crate) fn into_positions(mut self) -> Vec<[f64; 3]> {
        self.positions.shrink_to_fit();
        self.positions
    }
}

/// Welds the corners of a few triangles, to pass on only what is new among them.
#[derive(Default)]
pub(crate) struct LocalWelder {
    table: Table,
    /// Positions in the order of first appearance, with their hashes.
    pub(crate) found: Vec<([f32; 3], u32)>,
}

impl LocalWelder {
    pub(crate) fn clear(&mut self) {
        self.table.clear();
        self.found.clear();
    }

    #[inline]
    pub(crate) fn index(&mut self, position: [f32; 3]) -> u32 {
        let position = position.map(|x| x + 0.0);
        let hash = self.table.hash(position.map(f64::from));
        let next = self.found.len() as u32;
        let index = self.table.find_or_insert(hash, next, |index| self.found[index as usize].0 == position);
        if index == next {
            self.found.push((position, hash));
        }
        index
    }
}

fn without_negative_zeros(position: [f64; 3]) -> [f64; 3] {
    position.map(|x| x + 0.0)
}

/// A hash table from positions, kept elsewhere, to indices: open addressing, at most half full.
///
/// The hash has a seed of its own in every process, so that no file can be made to collide; indices do not depend on
/// it.
struct Table {
    seed: u64,
    /// 0 where empty, else the hash in the upper half and the index plus 1 in the lower half.
    slots: Vec<u64>,
    used: usize,
}

/// What makes hashes differ from process to process.
static SEED: LazyLock<u64> = LazyLock::new(|| RandomState::new().hash_one(0));

impl Default for Table {
    fn default() -> Self {
        Self { seed: *SEED, slots: Vec::new(), used: 0 }
    }
}

impl Table {
    const SMALLEST: usize = 1 << 14;

    fn clear(&mut self) {
        if self.used > 0 {
            self.slots.fill(0);
            self.used = 0;
        }
    }

    #[inline]
    fn hash(&self, position: [f64; 3]) -> u32 {
        const ODD: [u64; 3] = [0x9E37_79B9_7F4A_7C15, 0xD1B5_4A32_D192_ED03, 0x8CB9_2BA7_2F3D_8DD7];
        let [x, y, z] = position.map(f64::to_bits);
        let first = fold(x ^ self.seed ^ ODD[0], y ^ ODD[1]);
        (fold(first ^ z, self.seed ^ ODD[2]) >> 32) as u32
    }

    /// The index that `is_same` accepts among those with this hash, or `next`, which is then entered.
    #[inline]
    fn find_or_insert(&mut self, hash: u32, next: u32, is_same: impl Fn(u32) -> bool) -> u32 {
        if 2 * self.used >= self.slots.len() {
            self.grow();
        }
        let mask = self.slots.len() - 1;
        let mut at = hash as usize & mask;
        loop {
            let slot = self.slots[at];
            if slot == 0 {
                self.slots[at] = u64::from(hash) << 32 | u64::from(next.wrapping_add(1));
                self.used += 1;
                return next;
            }
            let index = (slot as u32).wrapping_sub(1);
            if (slot >> 32) as u32 == hash && is_same(index) {
                return index;
            }
            at = (at + 1) & mask;
        }
    }

    #[cold]
    fn grow(&mut self) {
        let length = (4 * self.slots.len()).max(Self::SMALLEST);
        let old = std::mem::replace(&mut self.slots, vec![0; length]);
        for slot in old.into_iter().filter(|&slot| slot != 0) {
            let mut at = (slot >> 32) as usize & (length - 1);
            while self.slots[at] != 0 {
                at = (at + 1) & (length - 1);
            }
            self.slots[at] = slot;
        }
    }
}

/// Both halves of a product, mixed.
#[inline]
fn fold(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    (product >> 64) as u64 ^ product as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_share_an_index_in_the_order_of_appearance() {
        let mut welder = Welder::default();
        let position = |i: u32| [f64::from(i % 1000), f64::from(i / 1000), 0.5];
        for round in 0..2 {
            for i in 0..50_000 {
                assert_eq!(welder.index(position(i)), i, "round {round}");
            }
        }
        assert_eq!(welder.index([-0.0, 0.0, 0.5]), 0);
        assert_eq!(welder.index([-0.0, 0.0, -0.5]), 50_000);
        let positions = welder.into_positions();
        assert_eq!(positions.len(), 50_001);
        assert_eq!(positions[49_999], position(49_999));
        assert!(positions[0][0].is_sign_positive());
    }

    #[test]
    fn a_local_welder_starts_anew_when_cleared() {
        let mut local = LocalWelder::default();
        assert_eq!(
            [[1.0, 2.0, 3.0], [-0.0; 3], [1.0, 2.0, 3.0], [0.0; 3]].map(|p| local.index(p)),
            [0, 1, 0, 1]
        );
        local.clear();
        assert_eq!(local.index([0.0; 3]), 0);
        assert_eq!(local.found.len(), 1);
    }
}
