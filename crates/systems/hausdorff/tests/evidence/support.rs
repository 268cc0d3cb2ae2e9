//! What every report must satisfy, checked in exact arithmetic.

use pompeiu_core::geom::Aabb;
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_hausdorff::{DirectedReport, Enclosure, SurfacePoint, SymmetricReport, Timing};
use pompeiu_testkit::exact::{Lattice, Point, point_point_sq, point_triangle_sq};
use std::cmp::Ordering;

/// How far the rounded position of a surface point may be from the exact one, relative to the largest coordinate: three
/// products and two sums per coordinate, weights that sum to one within two roundings, and for a point on B once more the
/// frame, whose coordinates are up to 4.5 times those of the mesh.
pub(crate) const POSITION: f64 = 16.0 * f64::EPSILON;
/// How far the two points of a witness may be apart beyond the upper bound, relative to the largest coordinate: the point
/// on B is the nearest one up to rounding.
pub(crate) const NEAREST: f64 = 32.0 * f64::EPSILON;
/// Sum of barycentric coordinates: within this of one.
pub(crate) const WEIGHTS: f64 = 4.0 * f64::EPSILON;

/// Largest magnitude of a coordinate of a vertex that belongs to a face.
pub(crate) fn largest_coordinate(meshes: &[&TriMesh]) -> f64 {
    let used = meshes.iter().flat_map(|m| m.faces().iter().flatten().map(|&v| m.positions()[v as usize]));
    used.flatten().fold(0.0, |m: f64, x| if x.abs() > m { x.abs() } else { m })
}

/// Checks everything that a report of `h(A, B)` claims, but for its upper bound:
/// * the point of A is what its weights say, and its exact distance from every face of B is at least the lower bound;
/// * the point of B likewise, and it is as near as a nearest point must be;
/// * the upper bound is at least the distance of that point of A from B;
/// * the enclosure is as narrow as asked if the report says so.
#[track_caller]
pub(crate) fn check_report(a: &TriMesh, b: &TriMesh, report: &DirectedReport) {
    let lattice = Lattice::of(&[a, b]);
    let x = exact(lattice, a, &report.witness.from);
    let y = exact(lattice, b, &report.witness.to);
    let size = largest_coordinate(&[a, b]);
    for (mesh_point, exact) in [(&report.witness.from, &x), (&report.witness.to, &y)] {
        let off = lattice.length(&point_point_sq(&lattice.point(mesh_point.position), exact));
        assert!(off <= POSITION * size + f64::from_bits(4), "position off by {off:e}: {mesh_point:?}");
    }
    let (lower, upper) = (report.distance.lower(), report.distance.upper());
    let (lower_sq, upper_sq) = (lattice.length_sq(lower), lattice.length_sq(upper));
    let faces = (0..b.faces().len() as u32).map(|f| lattice.triangle(b.corners(FaceId(f))));
    let nearest = faces.map(|t| point_triangle_sq(&x, &t)).min().expect("a mesh has a face");
    assert!(nearest >= lower_sq, "the witness is only {:e} from B: {report:?}", lattice.length(&nearest));
    assert!(nearest <= upper_sq, "the witness is {:e} from B: {report:?}", lattice.length(&nearest));
    let between = lattice.length(&point_point_sq(&x, &y));
    assert!(between <= upper + NEAREST * size, "{between:e} {report:?}");
    if report.stop == pompeiu_hausdorff::StopReason::Tolerance {
        assert!(report.distance.gap() <= report.tolerance, "{report:?}");
    }
}

#[track_caller]
fn exact(lattice: Lattice, mesh: &TriMesh, point: &SurfacePoint) -> Point {
    let weights = point.barycentric;
    assert!(point.face.index() < mesh.faces().len(), "no such face: {point:?}");
    assert!(weights.iter().all(|w| *w >= 0.0), "{point:?}");
    assert!((weights.iter().sum::<f64>() - 1.0).abs() <= WEIGHTS, "{point:?}");
    lattice.mean(&lattice.triangle(mesh.corners(point.face)), weights)
}

/// Both directions of a symmetric report.
#[track_caller]
pub(crate) fn check_both(a: &TriMesh, b: &TriMesh, report: &SymmetricReport) {
    check_report(a, b, &report.a_to_b);
    check_report(b, a, &report.b_to_a);
}

/// Whether two enclosures can be of values no farther apart than `slack`.
pub(crate) fn overlap(x: Enclosure, y: Enclosure, slack: f64) -> bool {
    x.lower() <= y.upper() + slack && y.lower() <= x.upper() + slack
}

/// Reports are equal in all but the time they took.
pub(crate) fn same(x: &DirectedReport, y: &DirectedReport) -> bool {
    let without_time = |r: &DirectedReport| DirectedReport { timing: Timing::default(), ..r.clone() };
    let bits = |r: &DirectedReport| {
        let mut numbers = vec![r.distance.lower(), r.distance.upper(), r.tolerance];
        for p in [&r.witness.from, &r.witness.to] {
            numbers.extend(p.barycentric.iter().chain(&p.position));
        }
        numbers.into_iter().map(f64::to_bits).collect::<Vec<_>>()
    };
    without_time(x) == without_time(y) && bits(x).cmp(&bits(y)) == Ordering::Equal
}

/// Whether all points of both meshes are one: then any tolerance relative to their size is zero, and rounding ends the
/// search.
pub(crate) fn is_one_point(a: &TriMesh, b: &TriMesh) -> bool {
    Aabb::of_faces(a).union(Aabb::of_faces(b)).diagonal() == 0.0
}
