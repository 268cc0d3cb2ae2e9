//! Charts that are divided: their number, their distortion, that they lie apart, and where the seam goes.

use super::{real_mesh, surface, zoo};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::UnionFind;
use pompeiu_core::mesh::shapes::{self, Diagonal, Ends};
use pompeiu_core::run::{Limits, Progress, RunContext, StopReason};
use pompeiu_flatten::{
    Charts, ConvexBoundary, CutRequest, FlattenError, FlattenOptions, FlattenRequest, Flattening, Method,
    Weights, flatten,
};
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

fn count(charts: usize) -> FlattenOptions<'static> {
    FlattenOptions { charts: Charts::Count(NonZeroUsize::new(charts).unwrap()), ..FlattenOptions::default() }
}

fn auto(max_distortion: f64) -> FlattenOptions<'static> {
    FlattenOptions { charts: Charts::Auto, max_distortion: Some(max_distortion), ..FlattenOptions::default() }
}

/// The chart of each face, by faces that share a vertex of the opened surface.
fn chart_of_faces(flat: &Flattening) -> Vec<usize> {
    let faces = flat.opened.faces();
    let mut same = UnionFind::new(flat.uv.len());
    for [a, b, c] in faces {
        same.union(*a as usize, *b as usize);
        same.union(*b as usize, *c as usize);
    }
    faces.iter().map(|face| same.find(face[0] as usize)).collect()
}

/// Checks that the map is proven, that charts are disks within boxes that lie apart, and that every face is in the chart said.
fn check(flat: &Flattening) {
    let report = &flat.report;
    assert_eq!((report.flipped, report.overlapping, report.outline_crossings), (0, 0, 0));
    flat.opened.check_disks().unwrap();
    let of_faces = chart_of_faces(flat);
    let mut names = of_faces.clone();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), report.charts);
    assert_eq!(report.parts.iter().map(|part| part.faces).sum::<usize>(), of_faces.len());
    for part in &report.parts {
        let own = of_faces[part.first_face as usize];
        assert_eq!(of_faces.iter().filter(|name| **name == own).count(), part.faces);
    }
    let corners = flat.corner_uv();
    let bounds = names.iter().map(|name| {
        let own = corners.iter().zip(&of_faces).filter(|(_, of)| *of == name);
        own.flat_map(|(corners, _)| corners).fold([1.0, 1.0, 0.0, 0.0], |[l, b, r, t]: [f64; 4], [x, y]| {
            [l.min(*x), b.min(*y), r.max(*x), t.max(*y)]
        })
    });
    let boxes: Vec<[f64; 4]> = bounds.collect();
    for (i, p) in boxes.iter().enumerate() {
        assert!(p[0] >= 0.0 && p[1] >= 0.0 && p[2] <= 1.0 && p[3] <= 1.0, "{p:?}");
        for q in &boxes[..i] {
            assert!(p[2] < q[0] || q[2] < p[0] || p[3] < q[1] || q[3] < p[1], "{p:?} {q:?}");
        }
    }
}

#[test]
fn charts_are_divided_until_the_distortion_is_low_enough() {
    let mut divided = 0;
    for (genus, loops, most) in [(0, 0, 4.005), (1, 0, 4.01), (2, 1, 4.02), (0, 3, 4.01)] {
        let surface = surface(&zoo(genus, loops));
        let one = flatten(&surface, &FlattenOptions::default()).unwrap().report;
        let flat = flatten(&surface, &auto(most)).unwrap();
        check(&flat);
        let mean = |report: &pompeiu_flatten::FlattenReport| report.distortion.symmetric_dirichlet.mean;
        assert!(mean(&one) > most && mean(&flat.report) <= most, "genus {genus}: {}", mean(&flat.report));
        assert!(!flat.report.stop.is_early(), "genus {genus}");
        divided += usize::from(flat.report.charts > 1);
    }
    // Cuts alone do not serve them all.
    assert!(divided >= 2, "{divided}");
}

#[test]
fn as_many_charts_are_made_as_are_asked_for() {
    for (genus, loops) in [(0, 0), (1, 0), (0, 2)] {
        let surface = surface(&zoo(genus, loops));
        for charts in [1, 2, 7] {
            let flat = flatten(&surface, &count(charts)).unwrap();
            check(&flat);
            assert_eq!(flat.report.charts, charts, "genus {genus}, loops {loops}");
        }
    }
}

#[test]
fn few_faces_stay_one_chart() {
    let tetrahedron = surface(&shapes::tetrahedron(1.0).unwrap());
    let flat = flatten(&tetrahedron, &count(5)).unwrap();
    check(&flat);
    assert_eq!(flat.report.charts, 1);
}

#[test]
fn a_long_tube_is_divided_across() {
    let (radius, height, segments) = (1.0, 12.0, 24);
    let tube = shapes::cylinder(radius, height, segments, 48, Ends::Open).unwrap();
    let flat = flatten(&surface(&tube), &count(2)).unwrap();
    check(&flat);
    // A ring across, which may run half a row beside the middle of its edges, and a generator cut in each half.
    let ring = f64::from(segments) * 2.0 * radius * (std::f64::consts::PI / f64::from(segments)).sin();
    let length = flat.report.cut.length;
    assert!(length > ring + height - 1e-9 && length < 1.1 * (ring + height), "{length} of {}", ring + height);
    assert!((flat.report.distortion.symmetric_dirichlet.mean - 4.0).abs() < 1e-3);
}

#[test]
fn parts_that_are_not_connected_stay_apart() {
    let ball = shapes::icosphere(1.0, 2).unwrap();
    let far = ball.positions().iter().map(|[x, y, z]| [x + 5.0, *y, *z]).collect();
    let both =
        pompeiu_core::mesh::merge(&[&ball, &TriMesh::new(far, ball.faces().to_vec()).unwrap()]).unwrap();
    let flat = flatten(&surface(&both), &count(3)).unwrap();
    check(&flat);
    assert_eq!(flat.report.charts, 3);
}

#[test]
fn charts_of_real_meshes_have_short_seams() {
    // Energy and seam of xatlas 0.0.11, in units of the square root of the area, by bench/flatten.
    for (name, energy, seam) in
        [("spot.obj", 4.033, 12.29), ("bunny.off", 4.126, 15.30), ("3holes.off", 4.007, 13.91)]
    {
        let Some(mesh) = real_mesh(name) else { return };
        let options = FlattenOptions { most_cuts: FlattenOptions::MOST_CUTS_OF_MANY, ..auto(energy) };
        let flat = flatten(&surface(&mesh), &options).unwrap();
        check(&flat);
        let report = &flat.report;
        assert!(report.distortion.symmetric_dirichlet.mean <= energy, "{name}");
        assert!(report.cut.relative_length < 0.5 * seam, "{name}: {}", report.cut.relative_length);
    }
}

#[test]
fn what_needs_whole_charts_is_refused() {
    let ball = surface(&shapes::icosphere(1.0, 2).unwrap());
    let circle =
        Method::Convex { boundary: ConvexBoundary::Circle, weights: Weights::MeanValue, around: None };
    let wrong = flatten(&ball, &FlattenOptions { method: circle, ..count(2) }).unwrap_err();
    assert_eq!(wrong, FlattenError::Whole { option: "the boundary or the energy" });
    assert!(matches!(flatten(&ball, &auto(4.0)).unwrap_err(), FlattenError::Option { .. }));
    assert!(matches!(flatten(&ball, &auto(f64::NAN)).unwrap_err(), FlattenError::Option { .. }));
    let straight = FlattenRequest {
        cut: CutRequest { straighten: true, ..CutRequest::default() },
        max_distortion: Some(4.1),
        ..FlattenRequest::default()
    };
    let wrong = straight.run(ball, &RunContext::default()).unwrap_err();
    assert_eq!(wrong, FlattenError::Whole { option: "the straightened cut" });
}

/// Where maps have much more energy than short seams promise, few are made in vain: on a sphere with spikes, on which the steps of all maps
/// are counted.
#[test]
fn seams_that_keep_no_promise_are_given_up_soon() {
    const MOST_STEPS: usize = 10_000;
    let sphere = shapes::icosphere(1.0, 2).unwrap();
    let spike =
        |(i, p): (usize, &[f64; 3])| if i.wrapping_mul(7) % 11 == 0 { p.map(|x| 4.0 * x) } else { *p };
    let positions = sphere.positions().iter().enumerate().map(spike).collect();
    let spikes = surface(&TriMesh::new(positions, sphere.faces().to_vec()).unwrap());
    let steps = AtomicUsize::new(0);
    let count = |_: &Progress<'_>| {
        let is_more = steps.fetch_add(1, Ordering::Relaxed) >= MOST_STEPS;
        if is_more { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let flat = flatten(&spikes, &FlattenOptions { progress: Some(&count), ..auto(4.02) }).unwrap();
    println!("{} steps, {} of them for the result", steps.load(Ordering::Relaxed), flat.report.steps);
    check(&flat);
    assert_eq!(flat.report.stop, StopReason::Tolerance);
    assert!(flat.report.distortion.symmetric_dirichlet.mean <= 4.02);
}

/// Sixteen towers on a square need more cuts than a large surface is given.
#[test]
fn small_surfaces_get_the_cuts_that_they_need() {
    let (mut positions, faces) = shapes::grid([24.0, 24.0], [24, 24], Diagonal::Rising).unwrap().into_parts();
    for [x, y, z] in &mut positions {
        let is_high = |x: f64| (2.5..4.5).contains(&x.rem_euclid(6.0));
        *z = if is_high(*x + 12.0) && is_high(*y + 12.0) { 2.0 } else { 0.0 };
    }
    let towers = TriMesh::new(positions, faces).unwrap();
    let run = |most_cuts| {
        let request = FlattenRequest { most_cuts, ..FlattenRequest::default() };
        request.run(surface(&towers), &RunContext::start(Limits::default())).unwrap().flat.report
    };
    let [few, found] = [Some(FlattenOptions::MOST_CUTS), None].map(run);
    assert_eq!([few.stop, found.stop], [StopReason::Steps, StopReason::Tolerance], "{few:?} {found:?}");
    assert!(found.is_one_to_one());
    assert_eq!([10_000, 40_000, 86_482].map(FlattenOptions::most_cuts_of), [32, 12, 6]);
}

/// The map of a flat part that was cut may be an isometry, with both sides of the cut at the same place.
#[test]
fn both_sides_of_a_cut_through_a_flat_part_stay_apart() {
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for (ring, segments) in (12..36).enumerate() {
        let first = positions.len() as u32;
        for k in 0..segments {
            let angle = f64::from(k) * std::f64::consts::TAU / f64::from(segments);
            for radius in [0.5, 1.0] {
                positions.push([3.0 * ring as f64 + radius * angle.cos(), radius * angle.sin(), 0.0]);
            }
        }
        for k in 0..segments {
            let [a, b] = [k, (k + 1) % segments].map(|k| first + 2 * k);
            faces.extend([[a, a + 1, b + 1], [a, b + 1, b]]);
        }
    }
    let flat = flatten(&surface(&TriMesh::new(positions, faces).unwrap()), &auto(4.01)).unwrap();
    check(&flat);
    assert_eq!(flat.report.charts, 24);
}

/// A gear of so many sides, four to each tooth and each gap, of this height.
fn gear(sides: u32, height: f64) -> TriMesh {
    let at = |i: u32| {
        let angle = f64::from(i) * std::f64::consts::TAU / f64::from(sides);
        let radius = if (i / 4).is_multiple_of(2) { 1.15 } else { 1.0 };
        [radius * angle.cos(), radius * angle.sin()]
    };
    let ring = |z: f64| (0..sides).map(move |i| [at(i)[0], at(i)[1], z]);
    let ends = [[0.0, 0.0, 0.0], [0.0, 0.0, height]];
    let positions = ring(0.0).chain(ring(height)).chain(ends).collect();
    let faces = (0..sides).flat_map(|i| {
        let j = (i + 1) % sides;
        let [k, l] = [i + sides, j + sides];
        [[i, j, l], [i, l, k], [j, i, 2 * sides], [k, l, 2 * sides + 1]]
    });
    TriMesh::new(positions, faces.collect()).unwrap()
}

/// Its flanks form one strip, which joins both ends: only their rims are seams, but for an edge of each. The cut that makes a disk of it, from
/// which seams would grow, is so long that the disk is too crowded on a circle.
#[test]
fn a_gear_is_divided_along_its_rims() {
    let (sides, height) = (256, 0.3);
    let gear = gear(sides, height);
    let flat = flatten(&surface(&gear), &auto(4.1)).unwrap();
    check(&flat);
    let side = |i: usize| {
        let [p, q] = [i, (i + 1) % sides as usize].map(|i| gear.positions()[i]);
        libm::hypot(p[0] - q[0], p[1] - q[1])
    };
    let rim: f64 = (0..sides as usize).map(side).sum();
    let (report, area) = (&flat.report, surface(&gear).surface().area());
    assert!(
        report.distortion.symmetric_dirichlet.mean < 4.1,
        "{}",
        report.distortion.symmetric_dirichlet.mean
    );
    let length = report.cut.relative_length * area.sqrt();
    assert!(
        report.charts <= 3 && length < 2.0 * rim + 1.1 * height,
        "{} charts, {length} of {rim}",
        report.charts
    );
}
