//! Ordering faces along a space-filling curve.

use crate::geom::Aabb;
use crate::mesh::TriMesh;
use rayon::prelude::*;

/// The faces of a mesh with the given bounding box in the order of the Morton codes of their centroids, ties in index order.
///
/// Neighbours in this order are mostly neighbours in space, so the result for one face is a good start for the next.
///
/// # Cost
/// O(m) time for a radix sort of 30-bit codes; 16 bytes per face while it runs, 4 afterwards. Before it starts, 8 bytes per vertex.
/// # Source
/// The curve: `morton_geodetic_1966`.
pub fn morton_order(mesh: &TriMesh, aabb: &Aabb) -> Vec<u32> {
    sorted_keys(mesh, aabb).into_iter().map(|key| key as u32).collect()
}

/// The Morton code of each face in the upper half, its index in the lower one, in ascending order.
pub(super) fn sorted_keys(mesh: &TriMesh, aabb: &Aabb) -> Vec<u64> {
    let places = places(mesh.positions(), aabb);
    let spread = spread_table();
    let mut keyed: Vec<u64> = mesh
        .faces()
        .par_iter()
        .with_min_len(PART)
        .enumerate()
        .map(|(f, face)| {
            let [a, b, c] = face.map(|v| places[v as usize]);
            let sum = a + b + c;
            let cell = |k: u32| (sum >> (k * FIELD + SUM_BITS - CELL_BITS)) as usize & (CELLS - 1);
            let code = spread[cell(0)] | spread[cell(1)] << 1 | spread[cell(2)] << 2;
            (u64::from(code) << 32) | f as u64
        })
        .collect();
    drop(places);
    radix_sort_high_half(&mut keyed);
    keyed
}

/// Bits of a number of a cell, and cells along the longest axis.
const CELL_BITS: u32 = 10;
const CELLS: usize = 1 << CELL_BITS;
/// Bits of a word for each coordinate of a vertex, and those that the sum of three vertices takes.
const FIELD: u32 = 21;
const SUM_BITS: u32 = 19;
/// Steps of a coordinate of a vertex along the longest axis.
const STEPS: f64 = ((1 << SUM_BITS) / 3) as f64;

/// The coordinates of all vertices in steps from the lower end of a box, in one word each, so that one addition adds all three.
fn places(positions: &[[f64; 3]], aabb: &Aabb) -> Vec<u64> {
    // Cubic cells, so that ranges of codes are compact in any shape of the box.
    let extent =
        (0..3).map(|k| aabb.upper[k] - aabb.lower[k]).fold(0.0, |m: f64, x| if x > m { x } else { m });
    let scale = if extent > 0.0 { STEPS / extent } else { 0.0 };
    let place = |p: &[f64; 3]| {
        (0..3).fold(0, |word, k| {
            // A scale that overflowed gives NaN or infinity here, and vertices without a face may be outside; the cast saturates.
            let step = ((p[k] - aabb.lower[k]) * scale) as u32;
            word | u64::from(if step < STEPS as u32 { step } else { STEPS as u32 - 1 }) << (k as u32 * FIELD)
        })
    };
    positions.par_iter().with_min_len(PART).map(place).collect()
}

/// Numbers of cells with bit i moved to bit 3i.
fn spread_table() -> [u32; CELLS] {
    let mut table = [0; CELLS];
    for (x, spread) in (0..).zip(&mut table) {
        *spread = (0..CELL_BITS).fold(0, |bits, i| bits | (x >> i & 1) << (3 * i));
    }
    table
}

/// Smallest number of keys in a part that is sorted separately.
const PART: usize = 1 << 13;
/// Bits of a digit, and digits of a code.
const BITS: usize = 10;
const PASSES: usize = 3;

/// Stable sort by the upper 32 bits, of which the top two are zero: each thread sorts a range of codes.
fn radix_sort_high_half(keys: &mut Vec<u64>) {
    let mut other = vec![0; keys.len()];
    let parts = (keys.len() / PART).clamp(1, rayon::current_num_threads());
    if parts == 1 {
        radix_sort(keys, &mut other);
        std::mem::swap(keys, &mut other);
        return;
    }
    let ends = move_by_digit(keys, &mut other, PASSES - 1);
    let mut ranges = Vec::with_capacity(parts);
    let count = keys.len();
    let (mut from, mut to, mut start) = (&mut other[..], &mut keys[..], 0);
    for part in 1..=parts {
        let end = ends[ends.partition_point(|end| *end < count * part / parts)];
        let (these, those) = (from.split_at_mut(end - start), to.split_at_mut(end - start));
        ranges.push((these.0, those.0));
        (from, to, start) = (these.1, those.1, end);
    }
    ranges.into_par_iter().with_max_len(1).for_each(|(from, to)| radix_sort(from, to));
}

/// Leaves the keys of one slice in order in the other.
fn radix_sort<'k>(mut from: &'k mut [u64], mut to: &'k mut [u64]) {
    for pass in 0..PASSES {
        move_by_digit(from, to, pass);
        std::mem::swap(&mut from, &mut to);
    }
}

/// Distributes keys by one digit, and returns where those of each digit end.
fn move_by_digit(from: &[u64], to: &mut [u64], pass: usize) -> [usize; 1 << BITS] {
    let digit = |key: u64| (key >> (32 + BITS * pass)) as usize & ((1 << BITS) - 1);
    let mut places = [0; 1 << BITS];
    for &key in from {
        places[digit(key)] += 1;
    }
    let mut start = 0;
    for place in &mut places {
        (*place, start) = (start, start + *place);
    }
    for &key in from {
        let place = &mut places[digit(key)];
        to[*place] = key;
        *place += 1;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn spreads_bits() {
        let spread = spread_table();
        for bit in 0..10 {
            assert_eq!(spread[1 << bit], 1 << (3 * bit));
        }
        assert_eq!(spread[0x3ff], 0x0924_9249);
    }

    proptest! {
        #[test]
        fn radix_sort_agrees_with_the_standard_library(mut keys in prop::collection::vec(0_u64..1 << 62, 0..300)) {
            for (i, key) in keys.iter_mut().enumerate() {
                *key = (*key & !0xffff_ffff) | i as u64;
            }
            let mut expected = keys.clone();
            expected.sort_unstable();
            radix_sort_high_half(&mut keys);
            prop_assert_eq!(keys, expected);
        }

        #[test]
        fn is_a_permutation(points in prop::collection::vec([-1e300..1e300, -1.0..1.0, 0.0..1e-300], 3..60)) {
            let faces: Vec<_> = (0..points.len() as u32 - 2).map(|i| [i, i + 1, i + 2]).collect();
            let mesh = TriMesh::new(points, faces).unwrap();
            let mut order = morton_order(&mesh, &Aabb::of_faces(&mesh));
            order.sort_unstable();
            prop_assert_eq!(order, (0..mesh.faces().len() as u32).collect::<Vec<_>>());
        }
    }

    /// Several threads, and many keys that share a digit.
    #[test]
    fn parts_are_put_together_in_order() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
        for shift in [0, 5, 18, 29] {
            let mut state = 1_u64;
            let mut next = |i: u64| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                ((state >> 34) >> shift) << 32 | i
            };
            let mut keys: Vec<u64> = (0..5 * PART as u64).map(&mut next).collect();
            let mut expected = keys.clone();
            expected.sort_unstable();
            pool.install(|| radix_sort_high_half(&mut keys));
            assert!(keys == expected, "{shift}");
        }
    }
}
