//! Properties that hold for any two or three meshes.

use crate::support::{is_one_point, largest_coordinate, overlap};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::{Affine, merge, shuffle, subdivide, transform, unweld};
use pompeiu_hausdorff::{directed_hausdorff, symmetric_hausdorff};
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::strategies::{any_mesh, pair, point, scaled};
use proptest::prelude::*;

/// Rotating or moving a mesh rounds every coordinate a few times: three products, three sums and nine rounded matrix
/// entries, each by half a unit in the last place of the largest coordinate, in three coordinates of two meshes.
const MOTION: f64 = 32.0 * f64::EPSILON;
/// Midpoints of edges are rounded, each coordinate by half a unit in the last place.
const MIDPOINTS: f64 = 2.0 * f64::EPSILON;

/// The same surface, stored otherwise: faces and corners in another order, all vertices separate, or welded.
fn rearranged(mesh: &TriMesh, seed: u64) -> TriMesh {
    let mesh = if seed.is_multiple_of(2) { unweld(mesh).unwrap() } else { welded(mesh) };
    shuffle(&mesh, seed)
}

fn welded(mesh: &TriMesh) -> TriMesh {
    let mut points: Vec<[f64; 3]> = Vec::new();
    let mut place = |p: [f64; 3]| {
        points.iter().position(|q| *q == p).unwrap_or_else(|| {
            points.push(p);
            points.len() - 1
        }) as u32
    };
    let faces = mesh.faces().iter().map(|f| f.map(|v| place(mesh.positions()[v as usize]))).collect();
    TriMesh::new(points, faces).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(128)))]

    #[test]
    fn rigid_motions_keep_the_distance((a, b) in pair(), axis in point(), degrees in -180.0..180.0, by in point()) {
        let Some(rotation) = Affine::rotate(axis, degrees) else { return Ok(()) };
        let moved = |m| transform(&transform(m, &rotation).unwrap(), &Affine::translate(by)).unwrap();
        let (moved_a, moved_b) = (moved(&a), moved(&b));
        let slack = MOTION * largest_coordinate(&[&a, &b, &moved_a, &moved_b]);
        let (here, there) = (directed_hausdorff(&a, &b), directed_hausdorff(&moved_a, &moved_b));
        prop_assert!(overlap(here.distance, there.distance, slack), "{here:?} {there:?}");
    }

    #[test]
    fn powers_of_two_scale_every_bit((a, b) in pair(), exponent in -900..900_i32) {
        let (Some(small_a), Some(small_b)) = (scaled(&a, exponent), scaled(&b, exponent)) else { return Ok(()) };
        let (here, there) = (directed_hausdorff(&a, &b), directed_hausdorff(&small_a, &small_b));
        let by = |x: f64| x * 2.0_f64.powi(exponent / 2) * 2.0_f64.powi(exponent - exponent / 2);
        prop_assert_eq!(by(here.distance.lower()), there.distance.lower());
        prop_assert_eq!(by(here.distance.upper()), there.distance.upper());
        prop_assert_eq!(here.witness.from.barycentric, there.witness.from.barycentric);
        prop_assert_eq!(here.work, there.work);
    }

    #[test]
    fn storage_does_not_matter((a, b) in pair(), seed in any::<u64>()) {
        let here = directed_hausdorff(&a, &b);
        let there = directed_hausdorff(&rearranged(&a, seed), &rearranged(&b, seed / 2));
        prop_assert!(overlap(here.distance, there.distance, 0.0), "{here:?} {there:?}");
        // An unreferenced vertex and a second copy of every face change nothing either.
        let far = TriMesh::new(vec![[1e3; 3], [0.0; 3]], vec![[1, 1, 1]]).unwrap();
        let (mut positions, faces) = merge(&[&a, &a]).unwrap().into_parts();
        positions.extend_from_slice(far.positions());
        let twice = TriMesh::new(positions, faces).unwrap();
        let there = directed_hausdorff(&twice, &b);
        prop_assert!(overlap(here.distance, there.distance, 0.0), "{here:?} {there:?}");
    }

    #[test]
    fn subdividing_either_mesh_keeps_the_distance((a, b) in pair()) {
        let slack = MIDPOINTS * largest_coordinate(&[&a, &b]);
        let here = directed_hausdorff(&a, &b);
        let (fine_a, fine_b) = (subdivide(&a).unwrap(), subdivide(&b).unwrap());
        for (a, b) in [(&fine_a, &b), (&a, &fine_b), (&fine_a, &fine_b)] {
            let there = directed_hausdorff(a, b);
            prop_assert!(overlap(here.distance, there.distance, slack), "{here:?} {there:?}");
        }
        prop_assert!(directed_hausdorff(&fine_a, &a).distance.lower() <= slack);
    }

    #[test]
    fn triangle_inequality((a, b) in pair(), c in any_mesh()) {
        let direct = directed_hausdorff(&a, &c).distance.lower();
        let (first, second) = (directed_hausdorff(&a, &b).distance.upper(), directed_hausdorff(&b, &c).distance.upper());
        prop_assert!(direct <= (first + second) * (1.0 + f64::EPSILON), "{direct} {first} {second}");
    }

    #[test]
    fn the_symmetric_distance_is_the_greater_of_two_and_symmetric((a, b) in pair()) {
        let (ab, ba) = (symmetric_hausdorff(&a, &b), symmetric_hausdorff(&b, &a));
        prop_assert_eq!(ab.distance, ba.distance);
        prop_assert!(crate::support::same(&ab.a_to_b, &ba.b_to_a) && crate::support::same(&ab.b_to_a, &ba.a_to_b));
        prop_assert!(crate::support::same(&ab.a_to_b, &directed_hausdorff(&a, &b)));
        let h = ab.distance;
        let (x, y) = (ab.a_to_b.distance, ab.b_to_a.distance);
        prop_assert!(h.lower() >= x.lower() && h.lower() >= y.lower() && h.upper() >= x.upper() && h.upper() >= y.upper());
        prop_assert!((h.lower() == x.lower() || h.lower() == y.lower()) && (h.upper() == x.upper() || h.upper() == y.upper()));
    }

    #[test]
    fn more_of_a_is_farther_and_more_of_b_is_nearer((a, b) in pair(), c in any_mesh()) {
        let h = directed_hausdorff(&a, &b).distance;
        prop_assert!(h.lower() <= directed_hausdorff(&merge(&[&a, &c]).unwrap(), &b).distance.upper());
        prop_assert!(directed_hausdorff(&a, &merge(&[&b, &c]).unwrap()).distance.lower() <= h.upper());
    }

    #[test]
    fn a_mesh_is_at_distance_zero_from_itself_and_at_the_length_of_a_move_from_its_copy(
        a in any_mesh(), by in [-16..17_i32, -16..17_i32, -16..17_i32]
    ) {
        let itself = directed_hausdorff(&a, &a);
        prop_assert!(itself.distance.lower() == 0.0 && (itself.distance.upper() <= itself.tolerance || is_one_point(&a, &a)), "{itself:?}");
        let by = by.map(|x| f64::from(x) * 0.125);
        let moved = transform(&a, &Affine::translate(by)).unwrap();
        let length = by.iter().map(|x| x * x).sum::<f64>().sqrt();
        // Adding the move rounds the coordinates of one mesh.
        let slack = MIDPOINTS * largest_coordinate(&[&a, &moved]) + f64::EPSILON * length;
        let d = directed_hausdorff(&a, &moved).distance;
        prop_assert!(d.lower() - slack <= length && length <= d.upper() + slack, "{length} {d:?}");
    }
}
