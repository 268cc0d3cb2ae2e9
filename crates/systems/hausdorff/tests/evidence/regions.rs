//! The worst regions and the largest distance on each face, against slow and independent ways to find them.

use crate::pairs::load;
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_hausdorff::deviation::Region;
use pompeiu_hausdorff::{DeviationOptions, DirectedDeviation, directed_hausdorff};

/// Documented widths: of a peak, and of a face beside a level, as parts of themselves; of any face, as a part of the largest distance.
const OF_PEAK: f64 = 1e-3;
const OF_LEVEL: f64 = 1.0 / 256.0;
const OF_LARGEST: f64 = 1.0 / 256.0;

/// A rough sphere with spikes of different heights, and a smooth one.
fn spiked() -> (TriMesh, TriMesh) {
    let rough = displace_at_random(&icosphere(1.0, 3).unwrap(), 0.01, 7).unwrap();
    let mut positions = rough.positions().to_vec();
    for (vertex, height) in [(5, 0.31), (90, 0.3), (210, 0.12), (333, 0.3003), (480, 0.07), (612, 0.2)] {
        positions[vertex] = positions[vertex].map(|x| x * (1.0 + height));
    }
    (TriMesh::new(positions, rough.faces().to_vec()).unwrap(), icosphere(1.0, 2).unwrap())
}

/// The largest distance on each face, each by a search of its own.
fn values(a: &TriMesh, b: &TriMesh) -> Vec<f64> {
    let alone = |f| TriMesh::new(a.corners(f).to_vec(), vec![[0, 1, 2]]).unwrap();
    a.face_ids().map(|f| directed_hausdorff(&alone(f), b).distance.upper()).collect()
}

/// The faces that can be reached from one over faces of at least this value, in ascending order.
fn reached(mesh: &TriMesh, values: &[f64], from: FaceId, level: f64) -> Vec<FaceId> {
    let touch = |f: FaceId, g: FaceId| mesh.corners(f).iter().any(|p| mesh.corners(g).contains(p));
    let mut faces = vec![from];
    let mut left: Vec<FaceId> =
        mesh.face_ids().filter(|g| *g != from && values[g.index()] >= level).collect();
    let mut at = 0;
    while at < faces.len() {
        let face = faces[at];
        faces.extend(left.extract_if(.., |g| touch(face, *g)));
        at += 1;
    }
    faces.sort_unstable();
    faces
}

#[track_caller]
fn check_order(report: &DirectedDeviation) {
    let largest = report.distance.distance;
    for face in &report.faces {
        assert!(face.max.gap() <= OF_LARGEST * largest.upper(), "{face:?}");
    }
    for region in &report.regions {
        assert!(region.peak.gap() <= OF_PEAK * region.peak.upper(), "{:?}", region.peak);
        let highest = region.faces.iter().map(|f| report.faces[f.index()].max.upper()).fold(0.0, f64::max);
        assert_eq!(region.peak.upper(), highest);
    }
    for pair in report.regions.windows(2) {
        assert!(pair[0].peak.upper() >= pair[1].peak.upper());
    }
    let first = &report.regions[0].peak;
    assert!(first.lower() <= largest.upper() && largest.lower() <= first.upper(), "{first} {largest}");
}

#[test]
fn the_worst_regions_are_those_of_the_definition() {
    let (a, b) = spiked();
    let values = values(&a, &b);
    let count = 5;
    let mut by_value: Vec<FaceId> = a.face_ids().collect();
    by_value.sort_by(|f, g| values[g.index()].total_cmp(&values[f.index()]).then(f.cmp(g)));
    let mut peaks = Vec::new();
    for &face in &by_value {
        if peaks.len() == count {
            break;
        }
        let value = values[face.index()];
        let region = reached(&a, &values, face, Region::OF_PEAK * value);
        let first = |g: &FaceId| values[g.index()] < value || values[g.index()] == value && *g >= face;
        if region.iter().all(first) {
            peaks.push(face);
        }
    }
    // The wide ones of a hasty refinement must be told apart all the same.
    for accuracy in [0.3, 0.01] {
        let query = DeviationOptions { accuracy, regions: count, ..DeviationOptions::default() };
        let report = query.directed(&a, &b).unwrap();
        check_order(&report);
        for (face, value) in report.faces.iter().zip(&values) {
            assert!(face.max.lower() <= *value + 1e-11 && *value <= face.max.upper() + 1e-11);
        }
        assert_eq!(report.regions.len(), count);
        for (region, peak) in report.regions.iter().zip(&peaks) {
            let value = values[peak.index()];
            assert!(region.peak.lower() <= value + 1e-11 && value <= region.peak.upper() + 1e-11);
            let from = &region.witness.from;
            let apart = pompeiu_testkit::plain::point_point(from.position, region.witness.to.position);
            assert!(region.faces.contains(&from.face) && apart >= region.peak.lower() - 1e-12);
            let sure = reached(&a, &values, *peak, Region::OF_PEAK * value * (1.0 + 2.0 * OF_LEVEL));
            let possible = reached(&a, &values, *peak, Region::OF_PEAK * value * (1.0 - 2.0 * OF_LEVEL));
            assert!(sure.iter().all(|f| region.faces.contains(f)), "{sure:?} {:?}", region.faces);
            assert!(region.faces.iter().all(|f| possible.contains(f)), "{possible:?} {:?}", region.faces);
        }
    }
}

/// Both ways on a real pair whose faces differ in size.
#[test]
fn peaks_of_a_real_pair_are_narrow_and_in_order() {
    let Some((a, b)) = load("armadillo_dec10") else { return };
    let query =
        DeviationOptions { accuracy: 0.1, percentiles: [0.9].to_vec(), ..DeviationOptions::default() };
    let report = query.symmetric(&a, &b).unwrap();
    check_order(&report.a_to_b);
    check_order(&report.b_to_a);
    assert_eq!((report.a_to_b.regions.len(), report.b_to_a.regions.len()), (5, 5));
}

#[test]
fn the_points_of_a_region_are_as_far_apart_as_its_peak_at_any_scale() {
    let (a, b) = spiked();
    for scale in [1e-160, 1e-3, 1.0, 1e5, 1e160] {
        let scaled = |mesh: &TriMesh| {
            let positions = mesh.positions().iter().map(|p| p.map(|x| x * scale)).collect();
            TriMesh::new(positions, mesh.faces().to_vec()).unwrap()
        };
        let report = DeviationOptions::default().directed(&scaled(&a), &scaled(&b)).unwrap();
        assert!(!report.regions.is_empty());
        for Region { peak, witness, .. } in &report.regions {
            let apart = [0, 1, 2].map(|k| (witness.from.position[k] - witness.to.position[k]) / scale);
            let apart = apart.iter().map(|x| x * x).sum::<f64>().sqrt() * scale;
            assert!(
                peak.lower() * (1.0 - 1e-9) <= apart && apart <= peak.upper() * (1.0 + 1e-9),
                "{apart} of {peak:?} at scale {scale}"
            );
        }
    }
}
