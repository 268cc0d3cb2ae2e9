//! Signed tolerance bands: closed forms, and points drawn at random.

use pompeiu_core::mesh::shapes::{Diagonal, cube, grid, icosphere};
use pompeiu_core::mesh::{Affine, displace_at_random, transform};
use pompeiu_core::run::Limits;
use pompeiu_core::spatial::Winding;
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_hausdorff::deviation::{BandReport, Bands, DirectedBands};
use pompeiu_hausdorff::{DeviationOptions, Enclosure, StopReason};
use pompeiu_testkit::plain::point_triangle;
use std::time::Duration;

fn bands(a: &TriMesh, b: &TriMesh, bands: &[[f64; 2]], limits: &Limits) -> BandReport {
    let deviation = DeviationOptions::default().symmetric(a, b).unwrap();
    deviation.bands(a, b, &Bands::new(bands).unwrap(), 0.005, limits, None)
}

#[track_caller]
fn check(found: &DirectedBands, shares: &[f64], ends: [f64; 2]) {
    let all = found.shares.as_ref().unwrap();
    assert_eq!(all.len(), shares.len());
    for (enclosure, share) in all.iter().zip(shares) {
        assert!(enclosure.lower() <= share + 1e-12 && share - 1e-12 <= enclosure.upper(), "{all:?}");
        assert!(enclosure.gap() <= 0.005, "{all:?}");
    }
    assert_eq!(found.stop, StopReason::Tolerance);
    for (extreme, end) in [found.lowest, found.highest].into_iter().zip(ends) {
        assert!(extreme.lower <= end + 1e-12 && end - 1e-12 <= extreme.upper, "{extreme:?} {end}");
        assert!(extreme.upper - extreme.lower < 0.01 * end.abs() + 1e-9, "{extreme:?} {end}");
    }
}

/// A cube of side 2 that was raised by 0.1: its lid stands out, its floor is inside, and its walls stand out along the lid. The
/// distance of the floor is less beside the walls.
#[test]
fn a_raised_cube() {
    let a = cube(2.0, 4).unwrap();
    let b = transform(&a, &Affine::translate([0.0, 0.0, 0.1])).unwrap();
    let found = bands(&a, &b, &[[-0.05, 0.05], [-0.08, 0.02]], &Limits::default());
    assert_eq!(found.edges, [-0.08, -0.05, 0.02, 0.05]);
    let square = |margin: f64| (2.0 - 2.0 * margin) * (2.0 - 2.0 * margin);
    let wall = |height: f64| 8.0 * height;
    let below = [square(0.08), square(0.05) - square(0.08)];
    let above = [wall(0.03), wall(0.05) + 4.0];
    let rest = 24.0 - below[0] - below[1] - above[0] - above[1];
    let share = |area: f64| area / 24.0;
    check(&found.b_to_a, &[below[0], below[1], rest, above[0], above[1]].map(share), [-0.1, 0.1]);
    // What stands out of A lies beyond the floor of B.
    let found = bands(&a, &b, &[[-0.05, 0.02]], &Limits::default());
    let (low, high) = (wall(0.05) + 4.0, square(0.02));
    check(&found.a_to_b, &[low, 24.0 - low - high, high].map(share), [-0.1, 0.1]);
    assert!(found.a_to_b.closed && found.b_to_a.closed);
}

/// Points drawn at random on a mesh, by area, with their signed distances by another way.
pub(crate) fn sampled(from: &TriMesh, to: &TriMesh, sign: f64, count: usize) -> Vec<f64> {
    let area = |face: u32| {
        let [p, q, r] = from.corners(FaceId(face)).map(glam::DVec3::from_array);
        (q - p).cross(r - p).length()
    };
    let mut sums = vec![0.0];
    for face in 0..from.faces().len() as u32 {
        sums.push(sums[face as usize] + area(face));
    }
    let winding = Winding::new(to);
    let total = sums[sums.len() - 1];
    (0..count)
        .map(|i| {
            // Weyl's sequence in three dimensions.
            let [x, y, z] =
                [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|step| (step * (i as f64 + 0.5)).fract());
            let face = sums.partition_point(|sum| *sum <= x * total) - 1;
            let (v, w) = if y + z > 1.0 { (1.0 - y, 1.0 - z) } else { (y, z) };
            let [p, q, r] = from.corners(FaceId(face as u32)).map(glam::DVec3::from_array);
            let point = (p + v * (q - p) + w * (r - p)).to_array();
            let distance = to
                .face_ids()
                .map(|f| point_triangle(point, to.corners(f)))
                .fold(f64::INFINITY, |a, b| if b < a { b } else { a });
            let inside = winding.about(point).is_inside();
            sign * if inside { -distance } else { distance }
        })
        .collect()
}

#[track_caller]
fn agrees(found: &DirectedBands, edges: &[f64], values: &[f64]) {
    let bands = Bands::new(&edges.windows(2).map(|e| [e[0], e[1]]).collect::<Vec<_>>()).unwrap();
    let mut counts = vec![0.0; edges.len() + 1];
    for value in values {
        counts[bands.class(*value)] += 1.0 / values.len() as f64;
        assert!(found.lowest.lower - 1e-12 <= *value && *value <= found.highest.upper + 1e-12);
    }
    let shares: &Vec<Enclosure> = found.shares.as_ref().unwrap();
    for (share, count) in shares.iter().zip(counts) {
        assert!(share.lower() - 0.03 <= count && count <= share.upper() + 0.03, "{count} {shares:?}");
    }
}

#[test]
fn shares_agree_with_points_drawn_at_random() {
    let a = displace_at_random(&icosphere(1.0, 2).unwrap(), 0.05, 3).unwrap();
    let b = displace_at_random(&icosphere(1.0, 2).unwrap(), 0.05, 4).unwrap();
    let edges = [-0.05, -0.01, 0.0, 0.03];
    let all = [[-0.05, -0.01], [-0.01, 0.0], [0.0, 0.03]];
    let found = bands(&a, &b, &all, &Limits::default());
    agrees(&found.b_to_a, &edges, &sampled(&b, &a, 1.0, 4000));
    agrees(&found.a_to_b, &edges, &sampled(&a, &b, -1.0, 4000));
    for found in [&found.a_to_b, &found.b_to_a] {
        assert!(found.shares.iter().flatten().all(|share| share.gap() < 0.02), "{found:?}");
    }
}

/// Beside the rim of an open surface sides are a choice that changes gradually; it is bounded all the same.
#[test]
fn a_surface_with_a_hole() {
    let whole = icosphere(1.0, 2).unwrap();
    let faces =
        whole.faces().iter().filter(|face| face.iter().any(|v| whole.positions()[*v as usize][2] < 0.8));
    let open = TriMesh::new(whole.positions().to_vec(), faces.copied().collect()).unwrap();
    let b = displace_at_random(&icosphere(0.98, 2).unwrap(), 0.05, 5).unwrap();
    let found = bands(&open, &b, &[[-0.04, 0.02], [0.02, 0.1]], &Limits::default());
    assert!(!found.b_to_a.closed && found.a_to_b.closed);
    agrees(&found.b_to_a, &found.edges, &sampled(&b, &open, 1.0, 4000));
    agrees(&found.a_to_b, &found.edges, &sampled(&open, &b, -1.0, 4000));
    assert!(found.a_to_b.shares.iter().flatten().all(|share| share.gap() < 0.005), "{found:?}");
    assert!(found.b_to_a.shares.iter().flatten().all(|share| share.gap() < 0.2), "{found:?}");
}

/// Of two reliefs over one square the upper one is in excess, whatever is below and above all of it.
#[test]
fn sheets_have_their_sides_by_their_normals() {
    let relief = |wave: f64, seed: u64| {
        let flat = grid([1.0, 1.0], [24, 24], Diagonal::Rising).unwrap();
        let raised = |p: &[f64; 3]| [p[0], p[1], wave * (9.0 * p[0]).sin() * (7.0 * p[1]).cos()];
        let raised = TriMesh::new(flat.positions().iter().map(raised).collect(), flat.faces().to_vec());
        displace_at_random(&raised.unwrap(), 2e-3, seed).unwrap()
    };
    let (a, b) = (relief(0.0, 6), relief(0.03, 7));
    let found = bands(&a, &b, &[[-0.01, 0.0], [0.0, 0.01]], &Limits::default());
    assert!(!found.b_to_a.closed && !found.a_to_b.closed);
    // On the same line upwards the other sheet lies below or above.
    let above = |point: [f64; 3], other: &TriMesh| {
        let under = other.face_ids().find_map(|face| height_in(other.corners(face), [point[0], point[1]]));
        under.map(|height| point[2] > height)
    };
    for (found, from, to, sign) in [(&found.b_to_a, &b, &a, 1.0), (&found.a_to_b, &a, &b, -1.0)] {
        let values = sampled(from, to, sign, 4000);
        agrees(found, &[-0.01, 0.0, 0.01], &values);
        assert!(found.shares.iter().flatten().all(|share| share.gap() < 0.13), "{found:?}");
        let of_points = from.positions().iter().filter_map(|p| Some((*p, above(*p, to)?)));
        let winding = Winding::new(to);
        let wrong = of_points.filter(|(p, above)| winding.about(*p).is_inside() == *above).count();
        assert!(wrong * 100 < from.positions().len(), "{wrong}");
    }
}

/// The height of a triangle over a point of the plane, if it is over it.
fn height_in(corners: [[f64; 3]; 3], [x, y]: [f64; 2]) -> Option<f64> {
    let [a, b, c] = corners;
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area;
    let w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
    (v >= 0.0 && w >= 0.0 && v + w <= 1.0).then(|| a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2]))
}

#[test]
fn without_time_shares_are_wide_and_hold() {
    let a = cube(2.0, 4).unwrap();
    let b = transform(&a, &Affine::translate([0.0, 0.0, 0.1])).unwrap();
    let limits = Limits { time: Some(Duration::ZERO), ..Limits::default() };
    let found = bands(&a, &b, &[[-0.05, 0.05]], &limits).b_to_a;
    assert_eq!(found.stop, StopReason::Time);
    let share = found.shares.unwrap()[0];
    assert!(share.contains(1.9 * 1.9 / 24.0) && share.gap() > 0.01, "{share:?}");
}
