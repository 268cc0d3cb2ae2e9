//! Faces along a space-filling curve.

use crate::geom::Aabb;
use crate::mesh::TriMesh;
use rayon::prelude::*;

/// The faces of a mesh with the given bounding box in the order of the Morton codes of their box centres, ties in index order.
///
/// Neighbours in this order are mostly neighbours in space, so what was found for one face is a good start for the next.
///
/// # Cost
/// O(m) time for a radix sort of 30-bit codes; 16 bytes per face while it runs, 4 afterwards.
/// # Source
/// The curve: `morton_geodetic_1966`.
pub fn morton_order(mesh: &TriMesh, aabb: &Aabb) -> Vec<u32> {
    sorted_keys(mesh, aabb).into_iter().map(|key| key as u32).collect()
}

/// The Morton code of each face in the upper half, its index in the lower one, in ascending order.
pub(super) fn sorted_keys(mesh: &TriMesh, aabb: &Aabb) -> Vec<u64> {
    let positions = mesh.positions();
    // Cells are cubes, so that ranges of codes are about as long as wide whatever the shape of the box.
    let extent =
        (0..3).map(|k| aabb.upper[k] - aabb.lower[k]).fold(0.0, |m: f64, x| if x > m { x } else { m });
    let scale = if extent > 0.0 { CELLS / extent } else { 0.0 };
    let mut keyed: Vec<u64> = mesh
        .faces()
        .par_iter()
        .enumerate()
        .map(|(f, face)| {
            let corners = face.map(|v| positions[v as usize]);
            let mut code = 0;
            for k in 0..3 {
                let (mut low, mut high) = (corners[0][k], corners[0][k]);
                for corner in &corners[1..] {
                    low = if corner[k] < low { corner[k] } else { low };
                    high = if corner[k] > high { corner[k] } else { high };
                }
                let centre = 0.5 * low + 0.5 * high;
                // A scale that overflowed gives NaN or infinity here; the cast saturates.
                let cell = ((centre - aabb.lower[k]) * scale) as u32;
                code |= spread(if cell < CELLS as u32 { cell } else { CELLS as u32 - 1 }) << k;
            }
            (u64::from(code) << 32) | f as u64
        })
        .collect();
    radix_sort_high_half(&mut keyed);
    keyed
}

/// Cells along the longest axis.
const CELLS: f64 = 1024.0;

/// Moves bit i of a 10-bit number to bit 3i.
fn spread(x: u32) -> u32 {
    let x = (x | (x << 16)) & 0x0300_00ff;
    let x = (x | (x << 8)) & 0x0300_f00f;
    let x = (x | (x << 4)) & 0x030c_30c3;
    (x | (x << 2)) & 0x0924_9249
}

/// Stable sort by the upper 32 bits, of which the top two are zero: each thread sorts a range of codes.
fn radix_sort_high_half(keys: &mut Vec<u64>) {
    let parts = (keys.len() / PART).clamp(1, rayon::current_num_threads());
    if parts == 1 {
        return radix_sort(keys);
    }
    let mut counts = vec![0_usize; 1 << BITS];
    for &key in keys.iter() {
        counts[digit(key, PASSES - 1)] += 1;
    }
    // The first digits of the parts.
    let mut firsts = vec![0];
    let mut before = 0;
    for (first, count) in counts.iter().enumerate() {
        if before >= keys.len() * firsts.len() / parts {
            firsts.push(first);
        }
        before += count;
    }
    firsts.push(1 << BITS);
    let of_part = |ends: &[usize]| {
        let size = counts[ends[0]..ends[1]].iter().sum();
        let mut part = Vec::with_capacity(size);
        part.extend(keys.iter().filter(|key| (ends[0]..ends[1]).contains(&digit(**key, PASSES - 1))));
        radix_sort(&mut part);
        part
    };
    let sorted: Vec<Vec<u64>> = firsts.par_windows(2).with_max_len(1).map(of_part).collect();
    keys.clear();
    keys.extend(sorted.iter().flatten());
}

/// Keys of a part that is sorted by itself, at least.
const PART: usize = 1 << 13;
/// Bits of a digit, and digits of a code.
const BITS: usize = 10;
const PASSES: usize = 3;

fn digit(key: u64, pass: usize) -> usize {
    (key >> (32 + BITS * pass)) as usize & ((1 << BITS) - 1)
}

fn radix_sort(keys: &mut Vec<u64>) {
    let mut counts = vec![[0_usize; 1 << BITS]; PASSES];
    for &key in keys.iter() {
        for (pass, count) in counts.iter_mut().enumerate() {
            count[digit(key, pass)] += 1;
        }
    }
    let mut other = vec![0; keys.len()];
    for (pass, count) in counts.iter_mut().enumerate() {
        let mut start = 0;
        for c in count.iter_mut() {
            (*c, start) = (start, start + *c);
        }
        for &key in keys.iter() {
            let place = &mut count[digit(key, pass)];
            other[*place] = key;
            *place += 1;
        }
        std::mem::swap(keys, &mut other);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn spreads_bits() {
        for bit in 0..10 {
            assert_eq!(spread(1 << bit), 1 << (3 * bit));
        }
        assert_eq!(spread(0x3ff), 0x0924_9249);
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
    /// On several threads, where many keys share a digit, too.
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
