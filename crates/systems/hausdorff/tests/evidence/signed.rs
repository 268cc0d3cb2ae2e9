//! Statistics of signed distances: closed forms, points drawn at random, and surfaces that intersect themselves.

use crate::bands::sampled;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{Diagonal, cube, grid, icosphere};
use pompeiu_core::mesh::{Affine, displace_at_random, merge, transform, unweld};
use pompeiu_core::spatial::Winding;
use pompeiu_hausdorff::DeviationOptions;
use pompeiu_hausdorff::deviation::{Deviation, DirectedDeviation, Extreme};

fn signed(a: &TriMesh, b: &TriMesh) -> Deviation {
    DeviationOptions { signed: true, ..DeviationOptions::default() }.symmetric(a, b).unwrap()
}

fn by_default(a: &TriMesh, b: &TriMesh) -> Deviation {
    DeviationOptions { signed_where_closed: true, ..DeviationOptions::default() }.symmetric(a, b).unwrap()
}

#[track_caller]
fn holds(extreme: Extreme, value: f64, width: f64) {
    let Extreme { lower, upper } = extreme;
    assert!(
        lower - 1e-12 <= value && value <= upper + 1e-12 && upper - lower <= width,
        "{extreme:?} {value}"
    );
}

fn turned(mesh: &TriMesh) -> TriMesh {
    let faces = mesh.faces().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    TriMesh::new(mesh.positions().to_vec(), faces).unwrap()
}

/// A cube in a larger one is inside of it, and that one outside, with points in the planes of the faces of the other one; however faces are
/// turned, and whether they are welded.
#[test]
fn a_cube_in_a_cube() {
    let (small, large) = (cube(2.0, 3).unwrap(), cube(2.2, 3).unwrap());
    for large in [large.clone(), turned(&large), unweld(&large).unwrap()] {
        let found = by_default(&small, &large);
        let inside = found.a_to_b.signed.unwrap();
        for end in [inside.mean, inside.lowest, inside.highest] {
            holds(end, -0.1, 1e-2);
        }
        assert!(inside.standard_deviation.upper() < 0.02 && inside.standard_deviation.lower() == 0.0);
        let outside = found.b_to_a.signed.unwrap();
        let of_distance = found.b_to_a.statistics.unwrap();
        assert!(
            outside.mean.lower > 0.1 - 1e-9 && outside.mean.upper <= of_distance.mean.upper() * (1.0 + 1e-9)
        );
        holds(outside.lowest, 0.1, 1e-2);
        holds(outside.highest, 0.03_f64.sqrt(), 1e-2);
    }
}

#[track_caller]
fn agrees(found: &DirectedDeviation, values: &[f64], width: f64) {
    let signed = found.signed.unwrap();
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let variance = values.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / values.len() as f64;
    let error = 4.0 * found.statistics.as_ref().unwrap().rms.upper() / (values.len() as f64).sqrt();
    assert!(signed.mean.lower - error <= mean && mean <= signed.mean.upper + error, "{signed:?} {mean}");
    let deviation = signed.standard_deviation;
    assert!(deviation.lower() - error <= variance.sqrt() && variance.sqrt() <= deviation.upper() + error);
    for value in values {
        assert!(signed.lowest.lower - 1e-12 <= *value && *value <= signed.highest.upper + 1e-12, "{value}");
    }
    let of_distance = found.statistics.as_ref().unwrap().mean;
    assert!(
        signed.mean.upper - signed.mean.lower <= width * of_distance.upper(),
        "{signed:?} {of_distance:?}"
    );
    for extreme in [signed.lowest, signed.highest] {
        assert!(extreme.lower <= extreme.upper);
    }
}

/// The winding number about a vertex or a centroid is what it is by summing all faces.
#[track_caller]
pub(crate) fn sides_agree(found: &DirectedDeviation, from: &TriMesh, to: &TriMesh) {
    let winding = Winding::new(to);
    let sides = found.sides.as_ref().unwrap();
    for (p, number) in from.positions().iter().zip(&sides.vertex_winding) {
        assert_eq!(sides.is_inside(*number), winding.about(*p).is_inside(), "{p:?}");
    }
    for (f, number) in from.face_ids().zip(&sides.face_winding) {
        let centre = [0, 1, 2].map(|k| from.corners(f).iter().map(|p| p[k] / 3.0).sum());
        assert_eq!(sides.is_inside(*number), winding.about(centre).is_inside(), "{centre:?}");
    }
}

/// Surfaces that cross each other nearly everywhere, with few faces, whose pieces are kept, and with many, whose pieces are summed up.
#[test]
fn surfaces_that_cross_agree_with_points_drawn_at_random() {
    for (level, noise) in [(2, 0.05), (5, 0.002)] {
        let a = displace_at_random(&icosphere(1.0, level).unwrap(), noise, 3).unwrap();
        let b = displace_at_random(&icosphere(1.0, level).unwrap(), noise, 4).unwrap();
        let found = by_default(&a, &b);
        for (found, from, to) in [(&found.a_to_b, &a, &b), (&found.b_to_a, &b, &a)] {
            sides_agree(found, from, to);
            agrees(found, &sampled(from, to, 1.0, if level == 2 { 6000 } else { 600 }), 0.05);
        }
    }
}

/// Where a surface intersects itself, winding numbers decide: what is inside of two balls is inside.
#[test]
fn surfaces_that_intersect_themselves_agree_with_points_drawn_at_random() {
    let ball = icosphere(1.0, 3).unwrap();
    let moved = transform(&ball, &Affine::translate([0.6, 0.1, 0.2])).unwrap();
    let both = merge(&[&ball, &moved]).unwrap();
    let other = displace_at_random(&icosphere(1.2, 2).unwrap(), 0.1, 4).unwrap();
    let found = signed(&other, &both);
    sides_agree(&found.a_to_b, &other, &both);
    sides_agree(&found.b_to_a, &both, &other);
    agrees(&found.a_to_b, &sampled(&other, &both, 1.0, 6000), 0.1);
    agrees(&found.b_to_a, &sampled(&both, &other, 1.0, 6000), 0.1);
}

/// Thin wedges and needles: beyond a sharp edge points are behind one of the faces there and in front of the other.
#[test]
fn sharp_edges_agree_with_points_drawn_at_random() {
    let flat = |height: f64| {
        let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 1.0, 0.0], [0.4, 0.3, height]];
        TriMesh::new(positions, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]).unwrap()
    };
    let around = displace_at_random(&icosphere(0.8, 2).unwrap(), 0.03, 5).unwrap();
    for sharp in [flat(0.05), flat(6.0)] {
        let found = by_default(&around, &sharp);
        sides_agree(&found.a_to_b, &around, &sharp);
        agrees(&found.a_to_b, &sampled(&around, &sharp, 1.0, 6000), 0.1);
        agrees(&found.b_to_a, &sampled(&sharp, &around, 1.0, 6000), 0.1);
    }
}

/// Signs are given by default where both are closed and oriented; else, if they are asked for, sides alone.
#[test]
fn open_surfaces_have_no_signed_statistics() {
    let ball = icosphere(1.0, 2).unwrap();
    let sheet = grid([1.0, 1.0], [3, 3], Diagonal::Rising).unwrap();
    let unoriented = {
        let mut faces = ball.faces().to_vec();
        faces[0].swap(0, 1);
        TriMesh::new(ball.positions().to_vec(), faces).unwrap()
    };
    for other in [&sheet, &unoriented] {
        let found = by_default(&ball, other);
        for directed in [&found.a_to_b, &found.b_to_a] {
            assert!(directed.sides.is_none() && directed.signed.is_none());
        }
        let found = signed(&ball, other);
        assert!(found.a_to_b.sides.is_some() && found.a_to_b.signed.is_none());
        assert!(found.b_to_a.sides.is_some() && found.b_to_a.signed.is_some());
    }
}
