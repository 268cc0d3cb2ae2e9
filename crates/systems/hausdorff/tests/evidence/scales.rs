//! Meshes of very different sizes, and one target for all of them.

use crate::support::check_report;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::cube;
use pompeiu_core::mesh::{Affine, transform};
use pompeiu_hausdorff::{HausdorffOptions, StopReason, Target, Tolerance, directed_hausdorff};
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::strategies::{any_mesh, scaled};
use proptest::prelude::*;

fn scaled_cube(side: f64) -> TriMesh {
    transform(&cube(1.0, 2).unwrap(), &Affine::scale([side; 3])).unwrap()
}

fn point(p: [f64; 3]) -> TriMesh {
    TriMesh::new(vec![p], vec![[0, 0, 0]]).unwrap()
}

#[test]
fn one_target_serves_meshes_of_any_size() {
    let b = cube(1.0, 3).unwrap();
    let target = Target::new(&b);
    for side in [1e-300, 1e-160, 1e-30, 1e-6, 0.5, 1.0, 1.5, 1e4, 1e13, 1e30, 1e160, 1e300] {
        let a = scaled_cube(side);
        let report = HausdorffOptions::default().directed_to(&a, &target).unwrap();
        check_report(&a, &b, &report);
        assert_eq!(report.stop, StopReason::Tolerance, "{side:e} {report:?}");
        let h = if side > 1.0 { 3.0_f64.sqrt() * (0.5 * side - 0.5) } else { 0.5 - 0.5 * side };
        // The sides of both cubes are rounded, and so is the formula.
        let slack = 4.0 * f64::EPSILON * if side > 1.0 { side } else { 1.0 };
        let d = report.distance;
        assert!(d.lower() - slack <= h && h <= d.upper() + slack, "{side:e} {h:e} {d:?}");
    }
}

#[test]
fn giants_against_dwarfs() {
    for (large, small) in [(1e160, 1e-160), (1e300, 1e-300), (1e300, 1.0), (1.0, 1e-300)] {
        let (giant, dwarf) = (scaled_cube(large), scaled_cube(small));
        let to_dwarf = directed_hausdorff(&giant, &dwarf);
        let to_giant = directed_hausdorff(&dwarf, &giant);
        for (a, b, report, h) in
            [(&giant, &dwarf, to_dwarf, 0.75_f64.sqrt() * large), (&dwarf, &giant, to_giant, 0.5 * large)]
        {
            check_report(a, b, &report);
            let d = report.distance;
            let slack = 4.0 * f64::EPSILON * large;
            assert!(d.lower() - slack <= h && h <= d.upper() + slack, "{large:e} {small:e} {h:e} {d:?}");
            assert_eq!(report.stop, StopReason::Tolerance, "{report:?}");
        }
    }
}

#[test]
fn the_distance_from_a_single_point() {
    let ball = [0.0, 0.0, 0.0];
    for (p, size) in
        [(ball, 1.0), (ball, 1e-300), (ball, 1e300), ([1.0, 1.0, 1.0], 1.0), ([1e9, 0.0, 0.0], 1.0)]
    {
        let a = transform(&scaled_cube(size), &Affine::translate(p)).unwrap();
        let b = point(p);
        let report = directed_hausdorff(&a, &b);
        check_report(&a, &b, &report);
        let h = 0.75_f64.sqrt() * size;
        let slack = 4.0 * f64::EPSILON * size;
        assert!(report.distance.lower() - slack <= h && h <= report.distance.upper() + slack, "{report:?}");
        assert_eq!(report.stop, StopReason::Tolerance, "{p:?} {size:e} {report:?}");
    }
}

/// A target that is one point, or tiny, far from the origin beside a larger mesh there: the digits that matter are kept.
#[test]
fn a_small_target_far_from_the_origin() {
    for offset in [10.0, 1e3, 1e9] {
        for size in [0.0, 1e-3] {
            let b =
                TriMesh::new(vec![[offset; 3], [offset + size, offset, offset]], vec![[0, 1, 1]]).unwrap();
            let a = transform(&scaled_cube(1.0), &Affine::translate([offset; 3])).unwrap();
            let report = directed_hausdorff(&a, &b);
            check_report(&a, &b, &report);
            assert!(report.distance.gap() <= 1e-12, "{offset:e} {size:e} {report:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(96)))]

    /// Each mesh at its own scale: the enclosure is valid, and the reused target gives what a new one gives.
    #[test]
    fn any_two_scales((a, b) in (any_mesh(), any_mesh()), p in -1000..980_i32, q in -1000..980_i32, coarse in any::<bool>()) {
        let (Some(a), Some(b)) = (scaled(&a, p), scaled(&b, q)) else { return Ok(()) };
        let tolerance = if coarse { 1e-3 } else { 1e-12 };
        let query = HausdorffOptions { tolerance: Tolerance::RelativeToDiagonal(tolerance), ..HausdorffOptions::default() };
        let target = Target::new(&b);
        let report = query.directed_to(&a, &target).unwrap();
        check_report(&a, &b, &report);
        let oracle = pompeiu_testkit::oracle::directed(&a, &b, 40);
        prop_assert!(oracle.allows_upper(report.distance.upper()), "{:?} {report:?}", oracle.rounded());
        prop_assert!(oracle.allows_lower(report.distance.lower()), "{:?} {report:?}", oracle.rounded());
        prop_assert!(crate::support::same(&report, &query.directed(&a, &b).unwrap()));
    }
}

/// Far away for the size of its faces, where a new target does without neighbours and a prepared one has them already.
#[test]
fn a_triangle_that_is_lost_beside_the_other_mesh() {
    let positions =
        (0..16).map(|i| [f64::from(i % 4) * (1.0 / 3.0), f64::from(i / 4) * (1.0 / 3.0), 0.0]).collect();
    let quads = (0..3).flat_map(|j| (0..3).map(move |i| 4 * j + i));
    let grid = TriMesh::new(positions, quads.flat_map(|v| [[v, v + 1, v + 5], [v, v + 5, v + 4]]).collect())
        .unwrap();
    let triangle = TriMesh::new(
        vec![[0.828_338_754_305_03, 0.0, 0.0], [0.0; 3], [0.0, 0.220_627_172_252_232_83, 0.0]],
        vec![[0, 1, 2]],
    )
    .unwrap();
    let (a, b) = (scaled(&grid, -691).unwrap(), scaled(&triangle, -745).unwrap());
    let query = HausdorffOptions::default();
    let reused = query.directed_to(&a, &Target::new(&b)).unwrap();
    assert!(crate::support::same(&reused, &query.directed(&a, &b).unwrap()));
}
