//! Vertices that lie at the same position.

use hashbrown::{DefaultHashBuilder, HashTable};
use std::hash::BuildHasher;

/// For each vertex the least vertex at the same position: +0 and −0 are one.
///
/// # Cost
/// O(n) time; 4 bytes per vertex, and about 10 more while they are found.
pub fn first_at_position(positions: &[[f64; 3]]) -> Vec<u32> {
    // Adding zero makes −0 equal to +0.
    let bits = |v: u32| positions[v as usize].map(|x| (x + 0.0).to_bits());
    let hasher = DefaultHashBuilder::default();
    let hash = |v: &u32| hasher.hash_one(bits(*v));
    let mut firsts = HashTable::with_capacity(positions.len());
    let first = |v: u32| *firsts.entry(hash(&v), |first| bits(*first) == bits(v), hash).or_insert(v).get();
    (0..positions.len() as u32).map(first).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_vertex_at_a_position_is_found() {
        let [p, q, r] = [[0.0, 1.0, 2.0], [-0.0, 1.0, 2.0], [0.0, 1.0, 2.0_f64.next_up()]];
        assert_eq!(first_at_position(&[r, p, q, r, p, [5.0; 3]]), [0, 1, 1, 0, 1, 5]);
        assert!(first_at_position(&[]).is_empty());
    }
}
