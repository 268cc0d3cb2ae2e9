//! Deviation analysis: closed forms, and invariants that hold for any pair.

use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::shapes::{Diagonal, grid};
use pompeiu_hausdorff::{DeviationQuery, Enclosure, StopReason};

/// Rounding of statistics of size one.
const ROUNDING: f64 = 1e-12;

fn lifted(mesh: &TriMesh, height: impl Fn([f64; 3]) -> f64) -> TriMesh {
    let positions = mesh.positions().iter().map(|p| [p[0], p[1], p[2] + height(*p)]).collect();
    TriMesh::new(positions, mesh.faces().to_vec()).unwrap()
}

fn plate(cells: u32) -> TriMesh {
    grid([1.0, 1.0], [cells, cells], Diagonal::Rising).unwrap()
}

#[track_caller]
fn is_near(enclosure: Enclosure, value: f64, slack: f64) {
    assert!(
        enclosure.lower() <= value + ROUNDING && value <= enclosure.upper() + ROUNDING,
        "{value} is not in {enclosure}"
    );
    assert!(enclosure.gap() <= slack, "{enclosure} is wider than {slack}");
}

/// All statistics of parallel plates are their distance.
#[test]
fn parallel_plates() {
    for cells in [1, 5] {
        let report = DeviationQuery::new()
            .threshold(0.1)
            .unwrap()
            .symmetric(&plate(3), &lifted(&plate(cells), |_| 0.25));
        for direction in [&report.a_to_b, &report.b_to_a] {
            let statistics = direction.statistics.as_ref().unwrap();
            assert!((statistics.area - 1.0).abs() < ROUNDING);
            is_near(statistics.mean, 0.25, ROUNDING);
            is_near(statistics.rms, 0.25, ROUNDING);
            for percentile in &statistics.percentiles {
                is_near(percentile.distance, 0.25, ROUNDING);
            }
            is_near(statistics.above.unwrap().share, 1.0, ROUNDING);
            assert_eq!(direction.stop, StopReason::Tolerance);
            for face in &direction.faces {
                for enclosure in [face.min, face.mean, face.max] {
                    is_near(enclosure, 0.25, ROUNDING);
                }
            }
            assert!(direction.vertices.iter().all(|d| (d - 0.25).abs() < ROUNDING));
        }
    }
}

/// Over a plate that rises from 0 to h the distance from one beneath it is uniformly distributed.
#[test]
fn a_plate_that_leans() {
    let h = 0.3;
    let wide = lifted(&grid([3.0, 3.0], [2, 2], Diagonal::Falling).unwrap(), |_| 0.0);
    let plate = plate(7);
    let left = Aabb::of_faces(&plate).lower[0];
    let leaning = lifted(&plate, |p| h * (p[0] - left));
    let query = DeviationQuery::new().accuracy(1e-7).unwrap().threshold(0.4 * h).unwrap();
    let report = query.directed(&leaning, &wide);
    let statistics = report.statistics.unwrap();
    is_near(statistics.mean, h / 2.0, 1e-7);
    is_near(statistics.rms, h / 3.0_f64.sqrt(), 1e-7);
    for percentile in &statistics.percentiles {
        is_near(percentile.distance, percentile.share * h, 1e-7);
    }
    is_near(statistics.above.unwrap().share, 0.6, 1e-7);
    for (k, bin) in statistics.histogram.bins.iter().enumerate() {
        is_near(*bin, 1.0 / 64.0, 1e-6);
        is_near(statistics.histogram.cumulative[k], k as f64 / 64.0, 1e-6);
    }
}
