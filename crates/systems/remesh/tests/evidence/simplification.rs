//! Simplified meshes are as near as they say, and smaller.

use crate::operations::topology;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{self, Diagonal, Ends};
use pompeiu_core::mesh::{
    Affine, Coordinates, Precision, VertexId, displace_at_random, merge, subdivide, transform,
};
use pompeiu_core::run::{Limits, StopReason};
use pompeiu_core::spatial::self_intersections;
use pompeiu_hausdorff::symmetric_hausdorff;
use pompeiu_remesh::{
    Effort, FeatureError, Features, Intersections, LengthError, RemeshError, RemeshOptions, Simplified,
    SimplifyError, SimplifyOptions, SimplifyTarget, Sizing, remesh, simplify_levels,
};
use std::num::NonZeroUsize;

fn simplify(mesh: &TriMesh, target: SimplifyTarget) -> Result<Simplified, SimplifyError> {
    pompeiu_remesh::simplify(mesh, &SimplifyOptions::new(target))
}

#[test]
fn a_sphere_within_a_distance() {
    let sphere = shapes::icosphere(1.0, 4).unwrap();
    let mut before = sphere.faces().len();
    for within in [1e-3, 1e-2, 5e-2] {
        let found = simplify(&sphere, SimplifyTarget::Within(within)).unwrap();
        let faces = found.mesh.faces().len();
        assert!(symmetric_hausdorff(&sphere, &found.mesh).distance.upper() <= within);
        assert!(faces < before, "{faces} faces within {within}");
        assert_eq!(topology(&found.mesh), topology(&sphere));
        before = faces;
    }
    // Faces of a sphere with sagitta s have a circumradius of about sqrt(2 s): fewer than 8 pi / (3 sqrt(3) s / 2) cannot do
    // where vertices may lie s/2 outside and faces s/2 inside; three times as many are enough.
    assert!(before <= 150, "{before} faces");
}

#[test]
fn flat_places_need_no_vertices() {
    let grid = shapes::grid([4.0, 3.0], [40, 30], Diagonal::Rising).unwrap();
    let found = simplify(&grid, SimplifyTarget::Within(1e-6)).unwrap();
    // Collapses are chosen greedily: a few more than the two that would do.
    assert!(found.mesh.faces().len() <= 16, "{} faces", found.mesh.faces().len());
    let cube = shapes::cube(2.0, 5).unwrap();
    let found = simplify(&cube, SimplifyTarget::Within(1e-6)).unwrap();
    assert_eq!(found.mesh.faces().len(), 12);
}

#[test]
fn open_rough_and_several_components() {
    let tube = shapes::cylinder(1.0, 3.0, 40, 30, Ends::Open).unwrap();
    let rough = displace_at_random(&shapes::torus(2.0, 0.7, 60, 40).unwrap(), 0.01, 3).unwrap();
    let parts = merge(&[&tube, &rough]).unwrap();
    for mesh in [&tube, &rough, &parts] {
        let found = simplify(mesh, SimplifyTarget::Within(0.05)).unwrap();
        assert!(found.distance.distance.upper() <= 0.05);
        assert!(found.mesh.faces().len() < mesh.faces().len() / 4);
        assert_eq!(topology(&found.mesh), topology(mesh));
    }
}

#[test]
fn a_number_of_faces_is_kept_to() {
    let sphere = shapes::icosphere(1.0, 4).unwrap();
    let found = simplify(&sphere, SimplifyTarget::Faces(200)).unwrap();
    assert!((190..=200).contains(&found.mesh.faces().len()));
    assert!(found.distance.distance.upper() < 0.1);
    // Nothing is smaller than a tetrahedron.
    let found = simplify(&sphere, SimplifyTarget::Faces(1)).unwrap();
    assert!(found.mesh.faces().len() >= 4);
}

#[test]
fn the_same_bits_at_any_number_of_threads() {
    let mesh = displace_at_random(&shapes::icosphere(1.0, 4).unwrap(), 0.01, 3).unwrap();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| simplify(&mesh, SimplifyTarget::Within(0.1)).unwrap().mesh)
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(8));
}

#[test]
fn what_cannot_be_asked_for() {
    let sphere = shapes::icosphere(1.0, 1).unwrap();
    let error = |target| simplify(&sphere, target).unwrap_err();
    let length = |within| match error(SimplifyTarget::Within(within)) {
        SimplifyError::Length(error) => error,
        other => panic!("{other}"),
    };
    assert_eq!(length(0.0), LengthError::NotPositive { what: "distance", length: 0.0 });
    assert!(matches!(length(f64::NAN), LengthError::NotPositive { .. }));
    assert!(matches!(length(1e-14), LengthError::BelowRounding { .. }));
    let with = |features: Features<'_>, repair| {
        let options =
            SimplifyOptions { features, repair, ..SimplifyOptions::new(SimplifyTarget::Within(0.1)) };
        pompeiu_remesh::simplify(&sphere, &options).unwrap_err()
    };
    let angle = Features { angle: Some(200.0), ..Features::default() };
    assert_eq!(with(angle, false), SimplifyError::Features(FeatureError::Angle(200.0)));
    let selected = Features { vertices: &[VertexId(3)], ..Features::default() };
    assert_eq!(with(selected, true), SimplifyError::Features(FeatureError::Repaired));
    assert_eq!(error(SimplifyTarget::Faces(0)), SimplifyError::NoFaces);
    let point = TriMesh::new(vec![[1.0; 3]; 3], vec![[0, 1, 2]]).unwrap();
    for target in [SimplifyTarget::Within(0.1), SimplifyTarget::Faces(1)] {
        assert_eq!(simplify(&point, target).unwrap_err(), SimplifyError::OnePosition);
    }
}

#[test]
fn the_scale_does_not_matter() {
    let sphere = shapes::icosphere(1.0, 3).unwrap();
    let one = simplify(&sphere, SimplifyTarget::Within(0.01)).unwrap().mesh;
    for scale in [1e-150_f64, 1e150] {
        // Powers of two, so that no coordinate is rounded.
        let scale = scale.log2().round().exp2();
        let positions = sphere.positions().iter().map(|p| p.map(|x| x * scale)).collect();
        let scaled = TriMesh::new(positions, sphere.faces().to_vec()).unwrap();
        let found = simplify(&scaled, SimplifyTarget::Within(0.01 * scale)).unwrap().mesh;
        assert_eq!(found.faces(), one.faces());
    }
}

#[test]
fn each_level_has_its_own_proof() {
    let mesh = displace_at_random(&shapes::icosphere(1.0, 4).unwrap(), 0.005, 3).unwrap();
    let options = SimplifyOptions::new(SimplifyTarget::Within(0.1));
    let levels = simplify_levels(&mesh, &options, 4).unwrap();
    let mut before = mesh.faces().len();
    for (level, within) in levels.iter().zip([0.0125, 0.025, 0.05, 0.1]) {
        assert_eq!(level.target, SimplifyTarget::Within(within));
        assert!(symmetric_hausdorff(&mesh, &level.mesh).distance.upper() <= within);
        assert!(level.mesh.faces().len() < before);
        before = level.mesh.faces().len();
    }
    // Going on from a finer level costs few faces.
    let at_once = simplify(&mesh, SimplifyTarget::Within(0.1)).unwrap().mesh.faces().len();
    assert!(before <= at_once + at_once / 4, "{before} and {at_once}");
    let by_faces = simplify_levels(&mesh, &SimplifyOptions::new(SimplifyTarget::Faces(300)), 3).unwrap();
    let counts: Vec<usize> = by_faces.iter().map(|level| level.mesh.faces().len()).collect();
    assert!(counts.iter().zip([1200, 600, 300]).all(|(n, most)| *n <= most && *n + 20 > most), "{counts:?}");
    assert_eq!(simplify_levels(&mesh, &options, 0).unwrap_err(), SimplifyError::NoLevels);
}

#[test]
fn creases_corners_and_boundaries_are_kept() {
    let with = |mesh: &TriMesh, within, features| {
        let options = SimplifyOptions { features, ..SimplifyOptions::new(SimplifyTarget::Within(within)) };
        pompeiu_remesh::simplify(mesh, &options).unwrap().mesh
    };
    let creases = Features { angle: Some(40.0), ..Features::default() };
    // A cube with waves much lower than the distance: its corners are the same points as before, and nothing else is needed.
    let cube = shapes::cube(2.0, 8).unwrap();
    let kept = with(&cube, 0.3, creases);
    assert_eq!(kept.faces().len(), 12);
    assert!(kept.positions().iter().flatten().all(|x| x.abs() == 1.0), "{:?}", kept.positions());
    // Without features corners are cut off within that distance.
    let free = with(&cube, 0.3, Features::default());
    assert!(free.positions().iter().any(|p| p.iter().any(|x| x.abs() != 1.0)));
    // The rims of a tube stay circles in their planes; a selected vertex stays a vertex.
    let tube = shapes::cylinder(1.0, 3.0, 48, 20, Ends::Open).unwrap();
    let chosen = VertexId(500);
    let options = Features { vertices: &[chosen], ..creases };
    let kept = with(&tube, 0.05, options);
    assert!(kept.faces().len() < 160);
    assert!(kept.positions().contains(&tube.positions()[chosen.index()]));
    assert_eq!(topology(&kept), topology(&tube));
    let heights: Vec<f64> = boundary(&kept).into_iter().map(|v| kept.positions()[v as usize][2]).collect();
    assert!(heights.len() >= 12 && heights.iter().all(|z| (z.abs() - 1.5).abs() < 1e-12), "{heights:?}");
}

/// The vertices of edges with one face.
fn boundary(mesh: &TriMesh) -> Vec<u32> {
    let edges = || mesh.faces().iter().flat_map(|f| [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]]);
    let all: std::collections::BTreeSet<[u32; 2]> = edges().collect();
    edges().filter(|[u, v]| !all.contains(&[*v, *u])).flatten().collect()
}

#[test]
fn what_is_no_manifold_is_repaired_and_measured_from_what_it_was() {
    // Three sheets that meet at one edge, each of many faces; the edge has three faces on each of its parts.
    let corners = [[0.0, 0.0, 0.0], [0.0, 0.0, 4.0], [3.0, 0.0, 0.0], [-3.0, 2.0, 0.0], [-3.0, -2.0, 0.0]];
    let mut fan = TriMesh::new(corners.to_vec(), vec![[0, 2, 1], [0, 3, 1], [0, 4, 1]]).unwrap();
    for _ in 0..4 {
        fan = subdivide(&fan).unwrap();
    }
    let options = SimplifyOptions::new(SimplifyTarget::Within(1e-3));
    let error = pompeiu_remesh::simplify(&fan, &options).unwrap_err();
    assert!(matches!(error, SimplifyError::Connectivity(_)), "{error}");
    let found = pompeiu_remesh::simplify(&fan, &SimplifyOptions { repair: true, ..options }).unwrap();
    assert!(found.mesh.faces().len() <= 9, "{} faces", found.mesh.faces().len());
    assert!(symmetric_hausdorff(&fan, &found.mesh).distance.upper() <= 1e-3);
}

#[test]
fn faces_that_intersect_are_counted_or_refused() {
    let ball = shapes::icosphere(1.0, 3).unwrap();
    let beside = transform(&ball, &Affine::translate([1.2, 0.1, 0.0])).unwrap();
    let both = merge(&[&ball, &beside]).unwrap();
    let with = |mesh: &TriMesh, intersections| {
        let options = SimplifyOptions { intersections, ..SimplifyOptions::new(SimplifyTarget::Within(0.05)) };
        pompeiu_remesh::simplify(mesh, &options)
    };
    assert_eq!(with(&both, Intersections::Ignore).unwrap().intersections, None);
    let count = with(&both, Intersections::Report).unwrap().intersections.unwrap();
    assert!(count.complete && count.pairs > 5, "{count:?}");
    assert_eq!(with(&ball, Intersections::Refuse).unwrap().intersections.unwrap().pairs, 0);
    let Err(SimplifyError::Intersects(error)) = with(&both, Intersections::Refuse) else {
        panic!("two balls intersect")
    };
    // Both spheres have centres 1.2 apart: their common circle lies in the plane x = 0.6.
    assert!(error.pairs == count.pairs && (error.place[0] - 0.6).abs() < 0.2, "{error}");
}

/// The same faces, seen from their other side.
fn reversed(mesh: &TriMesh) -> TriMesh {
    let faces = mesh.faces().iter().map(|&[a, b, c]| [a, c, b]).collect();
    TriMesh::new(mesh.positions().to_vec(), faces).unwrap()
}

/// A thin shell between two spheres, a ring of thin wall, a thin plate with many holes: coarse faces of both sides come near each other.
fn thin_walls() -> Vec<TriMesh> {
    let shell = |inner: f64, level: u32| {
        let hole = reversed(&shapes::icosphere(inner, level).unwrap());
        merge(&[&shapes::icosphere(1.0, level).unwrap(), &hole]).unwrap()
    };
    let ring = |inner: f64| {
        let hole = reversed(&shapes::torus(2.0, inner, 60, 40).unwrap());
        merge(&[&shapes::torus(2.0, 0.7, 60, 40).unwrap(), &hole]).unwrap()
    };
    let plate = subdivide(&subdivide(&shapes::perforated_plate(1.0, 5).unwrap()).unwrap()).unwrap();
    vec![shell(0.97, 4), shell(0.995, 3), ring(0.66), displace_at_random(&plate, 0.004, 5).unwrap()]
}

#[test]
fn faces_that_do_not_intersect_are_kept_apart() {
    let mut crossed = 0;
    for (i, mesh) in thin_walls().iter().enumerate() {
        assert!(self_intersections(mesh, 1).pairs.is_empty(), "mesh {i}");
        let few = SimplifyTarget::Faces(mesh.faces().len() / 50);
        let wide = SimplifyTarget::Within(0.1);
        for (target, effort) in [(few, Effort::Fast), (few, Effort::Best), (wide, Effort::Best)] {
            let with = |intersections| {
                let options = SimplifyOptions { intersections, effort, ..SimplifyOptions::new(target) };
                pompeiu_remesh::simplify(mesh, &options).unwrap()
            };
            let counted = with(Intersections::Report);
            crossed += usize::from(counted.intersections.unwrap().pairs > 0);
            let apart = with(Intersections::RefuseNew);
            assert!(self_intersections(&apart.mesh, 1).pairs.is_empty(), "mesh {i}, {target:?}, {effort:?}");
            assert_eq!(topology(&apart.mesh), topology(mesh));
            if counted.intersections.unwrap().pairs == 0 {
                assert_eq!(apart.mesh, counted.mesh);
            }
        }
    }
    assert!(crossed >= 8, "{crossed} results have faces that intersect without that");
}

#[test]
fn pairs_that_intersect_do_not_become_more() {
    let shell = thin_walls().swap_remove(0);
    let small = transform(&shapes::icosphere(0.1, 2).unwrap(), &Affine::translate([1.0, 0.1, 0.0])).unwrap();
    let both = merge(&[&shell, &small]).unwrap();
    let before = self_intersections(&both, usize::MAX).pairs.len();
    let options = SimplifyOptions {
        intersections: Intersections::RefuseNew,
        effort: Effort::Fast,
        ..SimplifyOptions::new(SimplifyTarget::Faces(250))
    };
    let found = pompeiu_remesh::simplify(&both, &options).unwrap().intersections.unwrap();
    assert!(found.pairs > 0 && found.pairs <= before, "{found:?} of {before}");
}

#[test]
fn a_number_of_faces_that_is_not_reached_is_said() {
    let plate = subdivide(&shapes::perforated_plate(1.0, 5).unwrap()).unwrap();
    for effort in [Effort::Fast, Effort::Best] {
        let with = |faces| {
            let options = SimplifyOptions { effort, ..SimplifyOptions::new(SimplifyTarget::Faces(faces)) };
            pompeiu_remesh::simplify(&plate, &options).unwrap()
        };
        let reached = with(plate.faces().len() / 2);
        assert_eq!((reached.stop, reached.refusals), (StopReason::Tolerance, None));
        let short = with(10);
        let why = short.refusals.unwrap();
        assert_eq!(short.stop, StopReason::Stalled);
        let faces = short.mesh.faces().len();
        assert!(why.least_faces > 10 && why.least_faces <= faces, "{why:?}, {faces} faces");
        assert_eq!(why.edges, 3 * faces / 2);
        assert_eq!(why.topology + why.features + why.normals + why.intersections, why.edges, "{why:?}");
        assert!(why.topology > 0 && why.intersections == 0, "{why:?}");
    }
}

#[test]
fn effort_makes_the_distance_small_at_the_same_number_of_faces() {
    let rough = displace_at_random(&shapes::torus(2.0, 0.7, 60, 40).unwrap(), 0.01, 3).unwrap();
    let far = transform(&rough, &Affine::translate([1e5, -2e5, 3e4])).unwrap();
    let tube = shapes::cylinder(1.0, 3.0, 40, 30, Ends::Open).unwrap();
    for mesh in [&rough, &far, &tube] {
        let by = |effort, faces| {
            let target = SimplifyTarget::Faces(faces);
            let options = SimplifyOptions { effort, ..SimplifyOptions::new(target) };
            let found = pompeiu_remesh::simplify(mesh, &options).unwrap();
            assert!(found.mesh.faces().len() <= faces, "{} of {faces}", found.mesh.faces().len());
            assert_eq!(topology(&found.mesh), topology(mesh));
            found.distance.distance.upper()
        };
        // Quadric errors come closer to the best where few faces are left.
        for (share, part) in [(10, 0.7), (30, 0.76)] {
            let faces = mesh.faces().len() / share;
            let [fast, best] = [Effort::Fast, Effort::Best].map(|effort| by(effort, faces));
            // Quadric errors alone are exact on the tube while there are enough faces.
            assert!(best <= part * fast || fast < 1e-9, "{best} within {fast} at {faces} faces");
            if faces == 160 {
                assert!(fast <= 0.12 && best <= 0.088, "{best}, {fast}");
            }
        }
    }
}

#[test]
fn effort_changes_nothing_with_the_number_of_threads() {
    let rough = displace_at_random(&shapes::torus(2.0, 0.7, 60, 40).unwrap(), 0.01, 3).unwrap();
    let on = |threads| {
        let limits = Limits { threads: NonZeroUsize::new(threads), ..Limits::default() };
        let options = SimplifyOptions { limits, ..SimplifyOptions::new(SimplifyTarget::Faces(300)) };
        pompeiu_remesh::simplify(&rough, &options).unwrap().mesh
    };
    let one = on(1);
    assert!([2, 8].iter().all(|&threads| on(threads) == one));
}

#[test]
fn vertices_are_where_single_precision_has_them() {
    let sphere =
        transform(&shapes::icosphere(10.0, 4).unwrap(), &Affine::translate([4e4, -7e4, 0.1])).unwrap();
    for (center, within) in [(false, 0.1), (true, 0.02), (true, 0.1)] {
        let coordinates = Coordinates { precision: Precision::Single, center };
        let options = SimplifyOptions { coordinates, ..SimplifyOptions::new(SimplifyTarget::Within(within)) };
        let found = pompeiu_remesh::simplify(&sphere, &options).unwrap();
        let written = found.rounding.written(&found.mesh).unwrap();
        assert!(written.positions().iter().flatten().all(|x| f64::from(*x as f32) == *x));
        assert!(symmetric_hausdorff(&sphere, &found.mesh).distance.upper() <= within);
        assert!(found.mesh.faces().len() < sphere.faces().len() / 2);
    }
    // Rounded to the half of a unit in the last place, faces turn over: that is no surface to count the intersections of.
    let far =
        transform(&shapes::icosphere(1.0, 4).unwrap(), &Affine::translate([5e5, 4.2e6, 120.0])).unwrap();
    let kept = |center| {
        let coordinates = Coordinates { precision: Precision::Single, center };
        let to_faces = SimplifyOptions { coordinates, ..SimplifyOptions::new(SimplifyTarget::Faces(500)) };
        let to_length = RemeshOptions { coordinates, ..RemeshOptions::new(Sizing::Length(0.2)) };
        (pompeiu_remesh::simplify(&far, &to_faces), remesh(&far, &to_length))
    };
    assert!(matches!(kept(true), (Ok(_), Ok(_))));
    assert!(matches!(kept(false), (Err(SimplifyError::TooCoarse(_)), Err(RemeshError::TooCoarse(_)))));
    let coordinates = Coordinates { precision: Precision::Single, center: false };
    let options = SimplifyOptions { coordinates, ..SimplifyOptions::new(SimplifyTarget::Within(1e-3)) };
    let refused = pompeiu_remesh::simplify(&sphere, &options).map(|found| found.distance);
    assert!(matches!(refused, Err(SimplifyError::TooCoarse(_))), "{refused:?}");
}
