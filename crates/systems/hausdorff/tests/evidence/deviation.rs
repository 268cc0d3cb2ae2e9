//! Deviation analysis: closed forms, and invariants that hold for any pair.

use crate::support::largest_coordinate;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::shapes::{Diagonal, grid, icosphere};
use pompeiu_core::mesh::{displace_at_random, unweld};
use pompeiu_core::run::Limits;
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_hausdorff::{DeviationOptions, DirectedDeviation, Enclosure, StopReason, directed_hausdorff};
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::plain::{area, point_point, point_triangles};
use pompeiu_testkit::strategies::pair;
use proptest::prelude::*;
use std::num::NonZeroUsize;

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

/// A thin face, as discs of CAD models have, over a hundred times as many faces as it is wide is cut into the cells of their overlay: it crosses
/// about 240 faces, and distances change their side in half of them.
#[test]
fn a_thin_face_over_many_small_ones_is_cut_into_their_cells() {
    let scan = displace_at_random(&plate(80), 1e-4, 1).unwrap();
    let Aabb { lower, .. } = Aabb::of_faces(&scan);
    let corners = [[0.05, 0.05], [0.94, 0.95], [0.95, 0.94]].map(|[x, y]| [lower[0] + x, lower[1] + y, 0.0]);
    let thin = TriMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap();
    let found = DeviationOptions::default().directed(&thin, &scan).unwrap();
    assert_eq!(found.stop, StopReason::Tolerance);
    assert!(found.work.pieces < 2000, "{:?}", found.work);
}

/// A large face begins over the face nearest to its first corner, whose plane is far from its centre where that face is tilted.
#[test]
fn a_large_face_over_tilted_ones_is_cut_into_their_cells() {
    let scan = displace_at_random(&plate(80), 1.5e-3, 1).unwrap();
    let Aabb { lower, .. } = Aabb::of_faces(&scan);
    let corners = [[0.05, 0.05], [0.94, 0.85], [0.85, 0.94]].map(|[x, y]| [lower[0] + x, lower[1] + y, 0.0]);
    let whole = |first: usize| {
        TriMesh::new(corners.to_vec(), vec![[first, first + 1, first + 2].map(|v| (v % 3) as u32)]).unwrap()
    };
    for first in 0..3 {
        let options = DeviationOptions { accuracy: 1e-4, ..DeviationOptions::default() };
        let found = options.directed(&whole(first), &scan).unwrap();
        assert_eq!(found.stop, StopReason::Tolerance);
        assert!(found.work.pieces < 50_000, "{:?}", found.work);
    }
}

/// Small faces over the point where hundreds of thin ones meet are cut into the cells of their overlay.
#[test]
fn small_faces_over_a_fan_are_cut_into_its_cells() {
    let scan = displace_at_random(&plate(40), 1e-5, 1).unwrap();
    let Aabb { lower, upper } = Aabb::of_faces(&scan);
    let at =
        |x: f64, y: f64| [lower[0] + x * (upper[0] - lower[0]), lower[1] + y * (upper[1] - lower[1]), 0.0];
    let count = 500_u32;
    let mut positions = vec![at(0.41, 0.42)];
    positions.extend((0..count).map(|i| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(count)).sin_cos();
        at(0.41 + cos, 0.42 + sin)
    }));
    let fan = (0..count).map(|i| [0, i + 1, (i + 1) % count + 1]).collect();
    let fan = TriMesh::new(positions, fan).unwrap();
    let found = DeviationOptions::default().directed(&scan, &fan).unwrap();
    assert_eq!(found.stop, StopReason::Tolerance);
    assert!(found.work.distances < 500_000, "{:?}", found.work);
}

/// All statistics of parallel plates are their distance.
#[test]
fn parallel_plates() {
    for cells in [1, 5] {
        let report = DeviationOptions { accuracy: 1e-6, threshold: Some(0.1), ..DeviationOptions::default() }
            .symmetric(&plate(3), &lifted(&plate(cells), |_| 0.25))
            .unwrap();
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

/// Where there are many faces, statistics are kept in fewer digits; what is said of them holds, and sums lose nothing. The accuracy is too high for
/// faces that are bounded by the distances of their corners.
#[test]
fn a_plate_of_many_faces_that_leans() {
    let report = DeviationOptions { accuracy: 1e-4, threshold: Some(0.1), ..DeviationOptions::default() }
        .directed(&lifted(&plate(48), |[x, _, _]| 0.4 * (x + 0.5)), &plate(1))
        .unwrap();
    assert!(report.faces.len() > 4096);
    let statistics = report.statistics.unwrap();
    is_near(statistics.mean, 0.2, 1e-11);
    is_near(statistics.rms, 0.4 / 3.0_f64.sqrt(), 1e-11);
    for percentile in &statistics.percentiles {
        let exact = 0.4 * percentile.share;
        assert!(percentile.distance.contains(exact) && percentile.distance.gap() < 0.01 * exact);
    }
    is_near(statistics.above.unwrap().share, 0.75, 1e-6);
}

/// Over a plate that rises from 0 to h the distance from one beneath it is uniformly distributed.
#[test]
fn a_plate_that_leans() {
    let h = 0.3;
    let wide = lifted(&grid([3.0, 3.0], [2, 2], Diagonal::Falling).unwrap(), |_| 0.0);
    let plate = plate(7);
    let left = Aabb::of_faces(&plate).lower[0];
    let leaning = lifted(&plate, |p| h * (p[0] - left));
    let query = DeviationOptions { accuracy: 1e-7, threshold: Some(0.4 * h), ..DeviationOptions::default() };
    let report = query.directed(&leaning, &wide).unwrap();
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

/// Samples of a face with their distances, and of all faces with area weights.
fn samples(a: &TriMesh, b: &TriMesh, n: u32) -> Vec<(FaceId, f64, f64)> {
    let triangles: Vec<_> = b.face_ids().map(|f| b.corners(f)).collect();
    let mut out = Vec::new();
    for face in a.face_ids() {
        let [p, q, r] = a.corners(face);
        let weight = area([p, q, r]) / f64::from(n * n);
        let mut add = |s: f64, t: f64| {
            let x = [0, 1, 2].map(|k| p[k] + s * (q[k] - p[k]) + t * (r[k] - p[k]));
            out.push((face, point_triangles(x, &triangles), weight));
        };
        for i in 0..n {
            for j in 0..n - i {
                let at =
                    |s: f64, t: f64| ((f64::from(i) + s) / f64::from(n), (f64::from(j) + t) / f64::from(n));
                let (s, t) = at(1.0 / 3.0, 1.0 / 3.0);
                add(s, t);
                if i + j + 1 < n {
                    let (s, t) = at(2.0 / 3.0, 2.0 / 3.0);
                    add(s, t);
                }
            }
        }
    }
    out
}

/// The centre of a small triangle stands for all its points, which are no farther from it than two thirds of its longest edge.
fn covering_radius(a: &TriMesh, n: u32) -> f64 {
    let edges = a.face_ids().flat_map(|f| {
        let [p, q, r] = a.corners(f);
        [point_point(p, q), point_point(q, r), point_point(r, p)]
    });
    edges.fold(0.0, f64::max) * (2.0 / 3.0) / f64::from(n)
}

/// Everything that a directed report claims, against samples: exactly where a sample is a witness, within what lies between
/// samples for numbers over the area.
pub(crate) fn check(a: &TriMesh, b: &TriMesh, report: &DirectedDeviation, threshold: f64, n: u32) {
    let slack = 1e-13 * largest_coordinate(&[a, b]);
    let samples = samples(a, b, n);
    for (face, distance, _) in &samples {
        let of_face = &report.faces[face.index()];
        assert!(*distance <= of_face.max.upper() + slack, "{distance} on {face}: {of_face:?}");
        assert!(*distance >= of_face.min.lower() - slack, "{distance} on {face}: {of_face:?}");
    }
    let radius = covering_radius(a, n) + slack;
    for face in a.face_ids() {
        let of_face = &report.faces[face.index()];
        let here = || samples.iter().filter(|s| s.0 == face).map(|s| s.1);
        assert!(of_face.max.lower() <= here().fold(0.0, f64::max) + radius, "{of_face:?}");
        assert!(of_face.min.upper() >= here().fold(f64::INFINITY, f64::min) - radius, "{of_face:?}");
        let mean = here().sum::<f64>() / here().count() as f64;
        assert!(
            of_face.mean.lower() <= mean + radius && mean - radius <= of_face.mean.upper(),
            "{mean} {of_face:?}"
        );
        assert!(of_face.max.upper() <= report.distance.distance.upper() + slack);
    }
    assert!(report.statistics.is_some() || samples.iter().all(|s| s.2 < 1e-12));
    let Some(statistics) = &report.statistics else { return };
    let total: f64 = samples.iter().map(|s| s.2).sum();
    if total < 1e-6 {
        // The plain areas of faces that are all in line but for rounding are rounding themselves.
        return;
    }
    let near = |e: Enclosure, low: f64, high: f64| {
        assert!(e.lower() <= high + slack && low - slack <= e.upper(), "[{low}, {high}] {e:?} {report:?}");
    };
    let mean = samples.iter().map(|s| s.1 * s.2).sum::<f64>() / total;
    near(statistics.mean, mean - radius, mean + radius);
    let rms = (samples.iter().map(|s| s.1 * s.1 * s.2).sum::<f64>() / total).sqrt();
    near(statistics.rms, rms - radius, rms + radius);
    let share_up_to = |t: f64| samples.iter().filter(|s| s.1 <= t).map(|s| s.2).sum::<f64>() / total;
    let around = |t: f64| (share_up_to(t - radius) - 1e-9, share_up_to(t + radius) + 1e-9);
    let (low, high) = around(threshold);
    near(statistics.above.unwrap().share, 1.0 - high, 1.0 - low);
    for percentile in &statistics.percentiles {
        // Up to the upper end lies at least the share, below the lower end less.
        assert!(around(percentile.distance.upper()).1 >= percentile.share, "{percentile:?}");
        assert!(around(percentile.distance.lower()).0 <= percentile.share, "{percentile:?}");
    }
    let histogram = &statistics.histogram;
    for (edge, share) in histogram.edges.iter().zip(&histogram.cumulative) {
        let (low, high) = around(*edge);
        near(*share, low, high);
    }
    for (v, distance) in report.vertices.iter().enumerate() {
        let referenced = a.faces().iter().flatten().any(|w| *w as usize == v);
        assert_eq!(distance.is_nan(), !referenced);
        let triangles: Vec<_> = b.face_ids().map(|f| b.corners(f)).collect();
        let plain = point_triangles(a.positions()[v], &triangles);
        assert!(!referenced || (distance - plain).abs() <= report.vertex_error + slack);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(96)))]

    #[test]
    fn random_meshes_hold_their_samples((a, b) in pair(), part in 0.0..1.2_f64, accuracy in 1..5_i32) {
        let threshold = part * directed_hausdorff(&a, &b).distance.upper();
        let query = DeviationOptions { accuracy: 10.0_f64.powi(-accuracy), threshold: Some(threshold), limits: Limits { pieces: Some(20_000), ..Limits::default() }, ..DeviationOptions::default() };
        let report = query.symmetric(&a, &b).unwrap();
        check(&a, &b, &report.a_to_b, threshold, 12);
        check(&b, &a, &report.b_to_a, threshold, 12);
    }
}

/// A small sphere inside a large one lies inside of it, however its faces are turned; the large one lies outside of the small one.
#[test]
fn sides_of_spheres() {
    let (small, large) = (icosphere(0.5, 2).unwrap(), icosphere(1.0, 2).unwrap());
    let turned = large.faces().iter().map(|[a, b, c]| [*a, *c, *b]).collect();
    let turned = TriMesh::new(large.positions().to_vec(), turned).unwrap();
    for outer in [large, turned] {
        let report = DeviationOptions { signed: true, ..DeviationOptions::default() }
            .symmetric(&small, &outer)
            .unwrap();
        let inside = report.a_to_b.signed_vertices().unwrap();
        assert!(inside.iter().zip(&report.a_to_b.vertices).all(|(signed, d)| *signed == -d && *d > 0.3));
        let outside = report.b_to_a.signed_vertices().unwrap();
        assert!(outside.iter().zip(&report.b_to_a.vertices).all(|(signed, d)| signed == d && *d > 0.3));
        let sides = report.a_to_b.sides.unwrap();
        assert!(sides.face_winding.iter().all(|w| sides.is_inside(*w)));
    }
}

/// Everything in a report but for the time it took.
fn bits(report: &DirectedDeviation) -> String {
    let DirectedDeviation {
        statistics, signed, sides, faces, vertices, regions, beyond_threshold, stop, ..
    } = report;
    let counts = (report.pieces(), report.work.looks, report.work.distances, report.work.rounds);
    format!(
        "{statistics:?} {signed:?} {sides:?} {faces:?} {vertices:?} {regions:?} {beyond_threshold:?} {stop:?} {counts:?}"
    )
}

#[test]
fn one_two_and_eight_threads_give_the_same_bits() {
    // Few faces, whose pieces are kept, and many, whose pieces are summed up.
    for (levels, noise) in [([3, 2], [0.02, 0.05]), ([5, 5], [0.01, 0.005])] {
        let [a, b] = [0, 1].map(|i| {
            displace_at_random(&icosphere(1.0, levels[i]).unwrap(), noise[i], 3 + i as u64).unwrap()
        });
        let query = DeviationOptions {
            threshold: Some(0.02),
            signed_where_closed: true,
            ..DeviationOptions::default()
        };
        let reports = [1, 2, 8].map(|threads| {
            let limits = Limits { threads: NonZeroUsize::new(threads), ..Limits::default() };
            DeviationOptions { limits, ..query.clone() }.symmetric(&a, &b).unwrap()
        });
        let bits = reports.map(|r| (bits(&r.a_to_b), bits(&r.b_to_a), format!("{:?}", r.pooled)));
        assert!(bits[0] == bits[1] && bits[0] == bits[2]);
    }
}

#[test]
fn a_mesh_and_itself() {
    let mesh = displace_at_random(&icosphere(1.0, 2).unwrap(), 0.05, 1).unwrap();
    let report = DeviationOptions::default().directed(&mesh, &mesh).unwrap();
    let statistics = report.statistics.unwrap();
    assert!(statistics.mean.upper() < ROUNDING && statistics.percentiles[3].distance.upper() < ROUNDING);
    assert!(report.vertices.iter().all(|d| *d == 0.0));
    assert!(report.regions.is_empty());
}

/// Points and segments have a largest distance, and no area to have a mean over.
#[test]
fn faces_without_area_count_in_the_maximum_alone() {
    let flat =
        TriMesh::new(vec![[0.0, 0.0, 1.0], [0.5, 0.0, 1.0], [0.25, 0.0, 1.0]], vec![[0, 1, 2], [0, 0, 0]])
            .unwrap();
    let report = DeviationOptions::default().symmetric(&flat, &plate(2)).unwrap();
    assert!(report.a_to_b.statistics.is_none() && report.greater_percentiles.is_none());
    is_near(report.a_to_b.faces[0].max, 1.0, ROUNDING);
    assert!(report.b_to_a.statistics.is_some() && report.pooled.is_some());
}

/// Two hills of different heights on a plate are two regions, the higher first.
#[test]
fn hills_are_told_apart() {
    let hill = |p: [f64; 3], x: f64, height: f64| {
        let r = ((p[0] - x) * (p[0] - x) + p[1] * p[1]).sqrt();
        if r < 0.15 { height * (1.0 - r / 0.15) } else { 0.0 }
    };
    let flat = plate(40);
    let hills = lifted(&flat, |p| hill(p, -0.25, 0.2) + hill(p, 0.25, 0.1));
    for mesh in [hills.clone(), unweld(&hills).unwrap()] {
        let report = DeviationOptions { threshold: Some(0.05), ..DeviationOptions::default() }
            .directed(&mesh, &flat)
            .unwrap();
        assert_eq!(report.regions.len(), 2, "{:?}", report.regions);
        assert_eq!(report.beyond_threshold.len(), 2);
        for (region, (x, height)) in report.regions.iter().zip([(-0.25, 0.2), (0.25, 0.1)]) {
            is_near(region.peak, height, 0.01 * height);
            assert!((region.centre[0] - x).abs() < 0.02 && region.centre[1].abs() < 0.02, "{region:?}");
            assert!((region.witness.from.position[0] - x).abs() < 0.02);
            assert!(region.level <= 0.501 * height);
        }
    }
}

/// The triangles to draw cover the surface, and show the distance as exactly as they say.
#[test]
fn drawn_triangles_show_the_distance() {
    let a = displace_at_random(&icosphere(1.0, 1).unwrap(), 0.1, 3).unwrap();
    let b = icosphere(1.0, 2).unwrap();
    let report = DeviationOptions::default().directed(&a, &b).unwrap();
    let targets: Vec<_> = b.face_ids().map(|f| b.corners(f)).collect();
    let whole: f64 = a.face_ids().map(|f| area(a.corners(f))).sum();
    for (tolerance, most) in [(1e-3, 1_000_000), (1e-3, 200), (1.0, 1_000_000)] {
        let drawn = report.tessellation(&a, &b, tolerance, most);
        let total: f64 = drawn.iter().map(|t| area(t.corners)).sum();
        assert!((total - whole).abs() < 1e-9 * whole && drawn.len() <= most.max(a.faces().len()));
        for triangle in drawn {
            for weights in [[1.0, 0.0, 0.0], [0.2, 0.3, 0.5], [0.6, 0.1, 0.3]] {
                let at = |k: usize| (0..3).map(|i| weights[i] * triangle.corners[i][k]).sum::<f64>();
                let shown: f64 = (0..3).map(|i| weights[i] * triangle.distances[i]).sum();
                let d = point_triangles([0, 1, 2].map(at), &targets);
                assert!((d - shown).abs() <= triangle.error + ROUNDING, "{d} {shown} {triangle:?}");
            }
        }
    }
}
