//! What is left of A at each stage.

use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::{icosphere, torus};
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_hausdorff::{
    Direction, HausdorffOptions, Method, Observer, Stage, Tolerance, directed_hausdorff,
};
use pompeiu_testkit::plain::{area, point_triangle, point_triangles};
use std::sync::Mutex;

#[derive(Default)]
struct Stages(Mutex<Vec<Stage>>);

impl Observer for Stages {
    fn stage(&self, stage: &Stage) {
        self.0.lock().unwrap().push(stage.clone());
    }
}

/// Corners of pieces are shown in rounded coordinates; distances of samples are rounded too.
const ROUNDING: f64 = 1e-13;

fn check(a: &TriMesh, b: &TriMesh, method: Method, stages: &[f64], last: f64) {
    let seen = Stages::default();
    let options = HausdorffOptions {
        tolerance: Tolerance::RelativeToDiagonal(last),
        stages: stages.to_vec(),
        method,
        observer: Some(&seen),
        ..HausdorffOptions::default()
    };
    let report = options.directed(a, b).unwrap();
    let full = directed_hausdorff(a, b).distance;
    assert!(crate::support::overlap(report.distance, full, 0.0));
    crate::support::check_report(a, b, &report);
    let stages = seen.0.into_inner().unwrap();

    let whole: f64 = (0..a.faces().len() as u32).map(|f| area(a.corners(FaceId(f)))).sum();
    let triangles: Vec<_> = (0..b.faces().len() as u32).map(|f| b.corners(FaceId(f))).collect();
    let mut left = whole * (1.0 + ROUNDING);
    let (mut lower, mut upper, mut distances) = (0.0, f64::INFINITY, 0);
    for stage in &stages {
        assert_eq!(stage.direction, Direction::AToB);
        assert!(
            stage.lower <= stage.upper && stage.upper - stage.lower <= stage.tolerance + ROUNDING,
            "{stage:?}"
        );
        assert!(
            stage.lower >= lower && stage.upper <= upper * (1.0 + ROUNDING),
            "{} {}",
            stage.lower,
            stage.upper
        );
        assert!(full.lower() <= stage.upper && stage.lower <= full.upper() + ROUNDING);
        assert!(stage.distances >= distances);
        (lower, upper, distances) = (stage.lower, stage.upper, stage.distances);
        assert!(stage.remaining.iter().all(|piece| piece.bound > stage.lower && piece.bound <= stage.upper));
        let area: f64 = stage.remaining.iter().map(|piece| area(piece.corners)).sum();
        assert!(area <= left * (1.0 + ROUNDING), "{area} after {left}");
        left = area;
        // Nothing was lost: every sample of A that is farther than the lower bound lies in a piece that remains, and is no
        // farther than the bound of one of them.
        for f in 0..a.faces().len() as u32 {
            let [p, q, r] = a.corners(FaceId(f));
            for (s, t) in [(0.0, 0.0), (0.5, 0.5), (0.21, 0.33), (0.6, 0.1), (0.1, 0.7)] {
                let x = [0, 1, 2].map(|k| p[k] + s * (q[k] - p[k]) + t * (r[k] - p[k]));
                let d = point_triangles(x, &triangles);
                if d > stage.lower + ROUNDING {
                    let mut holding = stage.remaining.iter().filter(|piece| {
                        piece.face == FaceId(f) && point_triangle(x, piece.corners) <= ROUNDING
                    });
                    assert!(
                        holding.any(|piece| d <= piece.bound + ROUNDING),
                        "face {f}, {d} > {}",
                        stage.lower
                    );
                }
            }
        }
    }
    assert!(stages.len() >= 3, "{} stages", stages.len());
    assert!(left < 0.5 * whole, "{left} of {whole}");
}

fn pair() -> (TriMesh, TriMesh) {
    let b = torus(1.0, 0.3, 14, 9).unwrap();
    (displace_at_random(&torus(1.0, 0.35, 20, 12).unwrap(), 0.03, 2).unwrap(), b)
}

#[test]
fn what_remains_shrinks_and_holds_the_maximum() {
    let (a, b) = pair();
    check(&a, &b, Method::Fast, &[1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-9], 1e-12);
    check(&b, &a, Method::Fast, &[0.3, 1e-2, 1e-5], 1e-12);
}

#[test]
fn the_textbook_method_shows_the_same_kind_of_rows() {
    let (a, b) =
        (displace_at_random(&icosphere(1.0, 1).unwrap(), 0.1, 1).unwrap(), icosphere(0.9, 1).unwrap());
    check(&a, &b, Method::Classic, &[1e-1, 3e-2, 1e-2], 5e-3);
}
