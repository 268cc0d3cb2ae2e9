//! Solids of revolution whose ends are fans: thin faces in one plane, turned or not, of which those of one mesh cross all of the other.

use crate::deviation::check;
use crate::discards;
use crate::signed::sides_agree;
use crate::support::check_report;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::{Affine, merge, transform};
use pompeiu_hausdorff::{DeviationOptions, Enclosure, HausdorffOptions, StopReason, SurfacePoint, Target};
use std::f64::consts::TAU;

/// Ends of n corners at height zero and one, the first of them at an angle.
fn cylinder(n: u32, angle: f64, by: &Affine) -> TriMesh {
    let corner = |i: u32, height: f64| {
        let angle = angle + TAU * f64::from(i) / f64::from(n);
        [angle.cos(), angle.sin(), height]
    };
    let positions = (0..n).map(|i| corner(i, 0.0)).chain((0..n).map(|i| corner(i, 1.0))).collect();
    let sides = (0..n).flat_map(|i| {
        let j = (i + 1) % n;
        [[i, j, n + j], [i, n + j, n + i]]
    });
    let ends = (1..n - 1).flat_map(|i| [[0, i + 1, i], [n, n + i, n + i + 1]]);
    let mesh = TriMesh::new(positions, sides.chain(ends).collect()).unwrap();
    transform(&mesh, by).unwrap()
}

fn placements() -> [Affine; 3] {
    let turned = Affine::rotate([0.3, -0.5, 0.8], 71.0).unwrap();
    let far = Affine { translation: [40.0, -3.0, 7.0], ..turned };
    [Affine::translate([0.0; 3]), turned, far]
}

/// Also of a prepared target, and with proofs that name the faces of the mesh.
#[test]
fn distances_hold_exactly() {
    for by in placements() {
        let (a, b) = (cylinder(40, 0.0, &by), cylinder(64, 0.1, &by));
        for (a, b) in [(&a, &b), (&b, &a)] {
            let report = HausdorffOptions::default().directed(a, b).unwrap();
            assert_eq!(report.stop, StopReason::Tolerance);
            check_report(a, b, &report);
            let prepared = HausdorffOptions::default().directed_to(a, &Target::new(b)).unwrap();
            assert_eq!((prepared.distance, prepared.witness), (report.distance, report.witness));
        }
        discards::check(&a, &b);
    }
}

/// Of the ends of one each face crosses up to 2,398 of the other, for which more than 3,700,000 distances were computed.
#[test]
fn what_fans_cross_is_little() {
    for by in placements() {
        let (a, b) = (cylinder(100, 0.0, &by), cylinder(2400, 0.01, &by));
        for (a, b) in [(&a, &b), (&b, &a)] {
            let report = HausdorffOptions::default().directed(a, b).unwrap();
            assert!(report.work.distances < 1_000_000, "{:?}", report.work);
        }
    }
}

#[test]
fn deviations_and_sides_hold() {
    for by in placements() {
        // Points in the plane of an end are on neither side of it.
        let beside = cylinder(48, 0.1, &Affine::translate([0.0, 0.0, 0.01]));
        let (a, b) = (cylinder(40, 0.0, &by), transform(&beside, &by).unwrap());
        let query = DeviationOptions {
            signed: true,
            threshold: Some(1e-3),
            regions: 2,
            ..DeviationOptions::default()
        };
        let found = query.symmetric(&a, &b).unwrap();
        check(&a, &b, &found.a_to_b, 1e-3, 12);
        check(&b, &a, &found.b_to_a, 1e-3, 12);
        sides_agree(&found.a_to_b, &a, &b);
        sides_agree(&found.b_to_a, &b, &a);
        for (found, to) in [(&found.a_to_b, &b), (&found.b_to_a, &a)] {
            for region in &found.regions {
                let nearest = region.witness.to;
                let corners = to.corners(nearest.face);
                let at =
                    [0, 1, 2].map(|k| (0..3).map(|i| nearest.barycentric[i] * corners[i][k]).sum::<f64>());
                assert!((0..3).all(|k| (at[k] - nearest.position[k]).abs() < 1e-13), "{nearest:?}");
            }
        }
    }
}

/// Faces of so many sides overlap by the hundreds along the axes: these are compared in a turned frame (`deviation/frame.rs`).
#[test]
fn deviations_of_turned_solids_are_those_of_the_solids() {
    let query =
        DeviationOptions { signed: true, threshold: Some(1e-3), regions: 2, ..DeviationOptions::default() };
    let found = placements().map(|by| {
        // Points in the plane of an end are on neither side of it.
        let above = Affine::translate([0.0, 0.0, 0.01]);
        let beside = cylinder(200, 0.1, &above);
        let (a, b) = (cylinder(120, 0.0, &by), transform(&beside, &by).unwrap());
        let found = query.symmetric(&a, &b).unwrap();
        for (directed, from, to) in [(&found.a_to_b, &a, &b), (&found.b_to_a, &b, &a)] {
            check(from, to, directed, 1e-3, 4);
            sides_agree(directed, from, to);
            for region in &directed.regions {
                let of = |point: &SurfacePoint, mesh: &TriMesh| {
                    let corners = mesh.corners(point.face);
                    let at =
                        [0, 1, 2].map(|k| (0..3).map(|i| point.barycentric[i] * corners[i][k]).sum::<f64>());
                    assert!((0..3).all(|k| (at[k] - point.position[k]).abs() < 1e-13), "{point:?}");
                };
                of(&region.witness.from, from);
                of(&region.witness.to, to);
            }
        }
        found
    });
    let [upright, turned, far] = found.each_ref().map(|found| [&found.a_to_b, &found.b_to_a]);
    for (i, direction) in upright.into_iter().enumerate() {
        let [mean, largest] = [direction.statistics.as_ref().unwrap().mean, direction.distance.distance];
        for other in [turned[i], far[i]] {
            // Coordinates of the others are rounded.
            let meets =
                |x: Enclosure, y: Enclosure| x.lower() <= y.upper() + 1e-13 && y.lower() <= x.upper() + 1e-13;
            assert!(meets(mean, other.statistics.as_ref().unwrap().mean));
            assert!(meets(largest, other.distance.distance));
        }
    }
}

/// The numbers on both sides of a face are those of its own connected part, however faces are numbered.
#[test]
fn a_void_has_sides_of_its_own() {
    let half =
        Affine { linear: [[0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]], translation: [0.0, 0.0, 0.2] };
    for by in placements() {
        let inner = transform(&cylinder(40, 0.2, &half), &by).unwrap();
        let turned = inner.faces().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        let inner = TriMesh::new(inner.positions().to_vec(), turned).unwrap();
        let hollow = merge(&[&inner, &cylinder(48, 0.1, &by)]).unwrap();
        let between = Affine { translation: [0.1, 0.0, 0.41], ..half };
        let other = transform(&cylinder(40, 0.0, &between), &by).unwrap();
        let query = DeviationOptions { signed: true, ..DeviationOptions::default() };
        let found = query.symmetric(&other, &hollow).unwrap();
        sides_agree(&found.a_to_b, &other, &hollow);
        sides_agree(&found.b_to_a, &hollow, &other);
    }
}
