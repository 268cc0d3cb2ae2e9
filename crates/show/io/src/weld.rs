//! Merging equal positions into one vertex.

use std::hash::{BuildHasher, RandomState};
use std::hint::black_box;
use std::sync::LazyLock;

/// Assigns one index to equal positions, in the order of first appearance. +0 and −0 are equal.
#[derive(Default)]
pub(crate) struct Welder {
    table: Table,
    positions: Vec<[f64; 3]>,
}

impl Welder {
    /// Reserves memory for a number of different positions; the table grows if there are more.
    pub(crate) fn with_capacity(positions: usize) -> Self {
        let mut welder = Self { positions: Vec::with_capacity(positions), ..Self::default() };
        welder.table.slots = vec![0; (positions + positions / 3).next_power_of_two().max(Table::SMALLEST)];
        welder
    }

    /// The next index, for a position that no other is equal to, such as one with NaN.
    pub(crate) fn index_apart(&mut self, position: [f64; 3]) -> u32 {
        self.positions.push(position);
        (self.positions.len() - 1) as u32
    }

    /// Forgets all positions, and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.table.clear();
        self.positions.clear();
    }

    /// The index of a position without NaN.
    pub(crate) fn index(&mut self, position: [f64; 3]) -> u32 {
        let position = without_negative_zeros(position);
        let [x, y, z] = position.map(f64::to_bits);
        let hash = self.table.hash(fold(x ^ self.table.seed, y ^ ODD), z);
        self.index_with_hash(position, hash)
    }

    /// Appends to `indices` the indices of the positions found by a [`LocalWelder`].
    pub(crate) fn extend_indices(&mut self, found: &[([f32; 3], u32)], indices: &mut Vec<u32>) {
        self.table.fetch(found.iter().map(|&(_, hash)| hash));
        indices.extend(
            found.iter().map(|&(position, hash)| self.index_with_hash(position.map(f64::from), hash)),
        );
    }

    #[inline]
    fn index_with_hash(&mut self, position: [f64; 3], hash: u32) -> u32 {
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

/// Welds the corners of a few triangles at a time, so that only new positions are passed on.
#[derive(Default)]
pub(crate) struct LocalWelder {
    table: Table,
    /// Positions in the order of first appearance, with their hashes.
    pub(crate) found: Vec<([f32; 3], u32)>,
}

impl LocalWelder {
    pub(crate) fn clear(&mut self) {
        self.forget();
        self.found.clear();
    }

    /// Assigns new indices to the following positions, even if they equal earlier ones.
    pub(crate) fn forget(&mut self) {
        self.table.clear();
    }

    #[inline]
    pub(crate) fn index(&mut self, position: [f32; 3]) -> u32 {
        let position = position.map(|x| x + 0.0);
        let [x, y, z] = position.map(|x| u64::from(x.to_bits()));
        let hash = self.table.hash(x | y << 32, z);
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

/// A hash table from positions, which are stored elsewhere, to indices: open addressing, at most three quarters full.
///
/// The seed of the hash differs in every process, so that no file can provoke collisions; indices do not depend on it.
struct Table {
    seed: u64,
    /// 0 where empty, else the hash in the upper half and the index plus 1 in the lower half.
    slots: Vec<u64>,
    used: usize,
}

/// Makes hashes differ from process to process.
static SEED: LazyLock<u64> = LazyLock::new(|| RandomState::new().hash_one(0));

impl Default for Table {
    fn default() -> Self {
        Self { seed: *SEED, slots: Vec::new(), used: 0 }
    }
}

impl Table {
    const SMALLEST: usize = 1 << 11;

    fn clear(&mut self) {
        if self.used > 0 {
            self.slots.fill(0);
            self.used = 0;
        }
    }

    /// A hash of 128 bits.
    #[inline]
    fn hash(&self, low: u64, high: u64) -> u32 {
        (fold(low ^ self.seed, high ^ self.seed.rotate_left(32) ^ ODD) >> 32) as u32
    }

    /// The index that `is_same` accepts among those with this hash, or `next`, which is then entered.
    #[inline]
    fn find_or_insert(&mut self, hash: u32, next: u32, is_same: impl Fn(u32) -> bool) -> u32 {
        if 4 * self.used >= 3 * self.slots.len() {
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

    /// Makes room for new entries, and loads the slots of these hashes into the cache together instead of one after the other.
    fn fetch(&mut self, hashes: impl ExactSizeIterator<Item = u32>) {
        while 4 * (self.used + hashes.len()) >= 3 * self.slots.len() {
            self.grow();
        }
        let mask = self.slots.len() - 1;
        black_box(hashes.map(|hash| self.slots[hash as usize & mask]).fold(0, |all, slot| all | slot));
    }

    #[cold]
    fn grow(&mut self) {
        let length = (2 * self.slots.len()).max(Self::SMALLEST);
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

/// An odd number without a pattern: 2⁶⁴ divided by the golden ratio.
const ODD: u64 = 0x9E37_79B9_7F4A_7C15;

/// Mixes both halves of a product.
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
        local.forget();
        assert_eq!(local.index([0.0; 3]), 2);
        local.clear();
        assert_eq!(local.index([0.0; 3]), 0);
        assert_eq!(local.found.len(), 1);
    }
}
