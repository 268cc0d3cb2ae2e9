//! Planes of symmetry: cuts and maps are symmetric, bit for bit.

use super::{real_mesh, surface};
use pompeiu_core::mesh::{merge, shapes};
use pompeiu_core::run::RunContext;
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_flatten::{
    ConvexBoundary, CutError, CutOptions, CutRequest, CutStrategy, FlattenError, FlattenOptions,
    FlattenRequest, Flattening, Method, SymmetryError, SymmetryPlane, VirtualBoundary, Weights, flatten,
};
use pompeiu_surface::EmbeddedSurface;
use std::collections::BTreeSet;

fn across(axis: usize) -> SymmetryPlane {
    let mut normal = [0.0; 3];
    normal[axis] = 2.0;
    SymmetryPlane { normal, offset: 0.0 }
}

fn options(axis: usize, strategy: CutStrategy) -> FlattenOptions<'static> {
    let cut = CutOptions { strategy, symmetry: Some(across(axis)), ..CutOptions::default() };
    FlattenOptions { cut, pack: false, ..FlattenOptions::default() }
}

/// The vertex at the mirror image of each, found among all.
fn images(positions: &[[f64; 3]], axis: usize) -> Vec<u32> {
    let image = |p: &[f64; 3]| {
        let mut there = *p;
        there[axis] = -there[axis];
        let near = |q: &[f64; 3]| (0..3).all(|k| (q[k] - there[k]).abs() < 1e-6);
        positions.iter().position(near).unwrap() as u32
    };
    positions.iter().map(image).collect()
}

/// Checks that a cut and a map are symmetric, and returns the mean symmetric Dirichlet energy.
fn check(mesh: &TriMesh, axis: usize, options: &FlattenOptions<'_>) -> (Flattening, f64) {
    let surface = surface(mesh);
    let flat = flatten(&surface, options).unwrap();
    let energy = flat.report.distortion.symmetric_dirichlet.mean;
    are_symmetric(&surface, axis, &flat);
    (flat, energy)
}

/// Checks that a cut and a map are symmetric.
fn are_symmetric(surface: &EmbeddedSurface, axis: usize, flat: &Flattening) {
    assert!(flat.report.is_one_to_one());
    assert_eq!((flat.report.charts, flat.report.boundary_loops), (1, 1));
    let positions = surface.positions().as_slice();
    let images = images(positions, axis);
    let of = surface.mesh();
    let ends: BTreeSet<[u32; 2]> = of
        .edge_ids()
        .filter(|&edge| flat.cut[edge])
        .map(|edge| {
            let mut ends = of.ends(edge).map(|v| v.0);
            ends.sort_unstable();
            ends
        })
        .collect();
    for edge in &ends {
        let mut image = edge.map(|v| images[v as usize]);
        image.sort_unstable();
        assert!(ends.contains(&image), "edge {edge:?} is cut, {image:?} is not");
    }
    // The positions of all copies of a vertex are the mirror images of those of its mirror image.
    let mut places: Vec<Vec<[f64; 2]>> = vec![Vec::new(); positions.len()];
    for (copy, v) in flat.opened.vertex_map().iter().enumerate() {
        // No negative zeros.
        places[v.index()].push(flat.uv[VertexId(copy as u32)].map(|x| x + 0.0));
    }
    let sorted = |mut places: Vec<[f64; 2]>| {
        places.sort_by(|p, q| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
        places
    };
    for (v, here) in places.iter().enumerate() {
        let there = places[images[v] as usize].iter().map(|[x, y]| [0.0 - x, *y]).collect();
        assert_eq!(sorted(here.clone()), sorted(there), "vertex {v}");
    }
}

/// A ball with two arms, and two bumps where the plane x = 0 meets it.
fn doll() -> TriMesh {
    let ball = shapes::uv_sphere(1.0, 24, 16).unwrap();
    let moved = ball.positions().iter().map(|&[x, y, z]| {
        let bump = |towards: [f64; 3], size: f64| {
            let cosine = (x.abs() * towards[0] + y * towards[1] + z * towards[2]).max(0.0);
            size * cosine.powi(24)
        };
        let s = 1.0 + bump([0.8, 0.0, 0.6], 1.6) + bump([0.0, 0.8, 0.6], 0.8) + bump([0.0, 0.0, -1.0], 0.5);
        [s * x, s * y, s * z]
    });
    TriMesh::new(moved.collect(), ball.faces().to_vec()).unwrap()
}

#[test]
fn spheres_keep_their_plane() {
    let doll = doll();
    let (free, energy) = check(&doll, 0, &options(0, CutStrategy::Auto));
    assert!(
        energy < 4.5 && free.report.cut.relative_length < 5.0,
        "{energy} {}",
        free.report.cut.relative_length
    );
    let through = CutStrategy::Through(vec![VertexId(40), VertexId(200), VertexId(3)]);
    let circle =
        Method::Convex { boundary: ConvexBoundary::Circle, weights: Weights::MeanValue, around: None };
    check(&doll, 0, &FlattenOptions { method: circle, ..options(0, through) });
}

#[test]
fn handles_and_boundaries_keep_their_plane() {
    let torus = shapes::torus(2.0, 0.7, 24, 12).unwrap();
    // Two loops meet the plane across the ring; the plane of the ring meets it in two others.
    for axis in [0, 2] {
        let (_, energy) = check(&torus, axis, &options(axis, CutStrategy::Auto));
        assert!(energy < 4.5, "{axis}: {energy}");
    }
    let tube = shapes::cylinder(1.0, 2.0, 24, 6, shapes::Ends::Open).unwrap();
    let (flat, energy) = check(&tube, 0, &options(0, CutStrategy::Genus));
    assert!(energy - 4.0 < 1e-6 && flat.report.cut.edges == 6, "{energy}");
}

#[test]
fn a_real_animal_keeps_its_plane() {
    let Some(spot) = real_mesh("spot.obj") else { return };
    // Some of its faces are divided by other diagonals on the other side.
    let (flat, energy) = check(&spot, 0, &options(0, CutStrategy::Auto));
    println!("spot: {energy} {}", flat.report.cut.relative_length);
    assert!(energy < 4.5 && flat.report.cut.relative_length < 5.0, "{energy}");
}

/// A grid over [−1, 1] × [0, 2] with the diagonals of one half the mirror images of those of the other, moved up by a function of |x| and y.
fn arch(columns: u32, rows: u32) -> TriMesh {
    let width = 2 * columns + 1;
    let at = |i: u32, j: u32| {
        let (x, y) = (f64::from(i) / f64::from(columns) - 1.0, 2.0 * f64::from(j) / f64::from(rows));
        [x, y, 0.3 * libm::sin(3.0 * x * x) + 0.1 * y]
    };
    let positions = (0..=rows).flat_map(|j| (0..width).map(move |i| at(i, j))).collect();
    let cell = |i: u32, j: u32| {
        let [a, b, c, d] = [j * width + i, j * width + i + 1, (j + 1) * width + i, (j + 1) * width + i + 1];
        if i < columns { [[a, b, d], [a, d, c]] } else { [[a, b, c], [b, d, c]] }
    };
    TriMesh::new(positions, (0..rows).flat_map(|j| (0..2 * columns).flat_map(move |i| cell(i, j))).collect())
        .unwrap()
}

#[test]
fn squares_and_polygons_keep_their_plane() {
    let mut divided = 0;
    for (name, mesh) in [
        ("arch", arch(6, 5)),
        // Every vertex lies on the boundary.
        ("strip", arch(1, 9)),
        ("bow", arch(4, 1)),
    ] {
        for boundary in ["square", "polygon:-2,0;2,0;0,3", "polygon:-1,0;1,0;2,2;0,3;-2,2"] {
            let cut = CutRequest { symmetry: Some(across(0)), ..CutRequest::default() };
            let (shape, pack) = (boundary.parse().unwrap(), false);
            let request = FlattenRequest { boundary: shape, cut, pack, ..FlattenRequest::default() };
            let found = request.run(surface(&mesh), &RunContext::default());
            let found = found.unwrap_or_else(|error| panic!("{name}, {boundary}: {error}"));
            are_symmetric(&found.surface, 0, &found.flat);
            divided += found.divided;
        }
    }
    assert!(divided > 0);
}

#[test]
fn what_is_not_symmetric_is_named() {
    let error = |mesh: &TriMesh, options: &FlattenOptions<'_>| match flatten(&surface(mesh), options) {
        Err(FlattenError::Cut(CutError::Symmetry(error))) => error,
        other => panic!("{other:?}"),
    };
    let ball = shapes::uv_sphere(1.0, 24, 16).unwrap();
    let auto = |axis| options(axis, CutStrategy::Auto);
    let mut moved = ball.positions().to_vec();
    moved[30][1] += 0.01;
    let bent = TriMesh::new(moved, ball.faces().to_vec()).unwrap();
    let found = error(&bent, &auto(0));
    assert!(
        matches!(found, SymmetryError::NoImage { distance, .. } if (distance - 0.01).abs() < 1e-9),
        "{found}"
    );
    let found = error(&shapes::icosphere(1.0, 1).unwrap(), &auto(0));
    assert!(matches!(found, SymmetryError::Across { .. }), "{found}");
    let aside = |x: f64| {
        let positions = ball.positions().iter().map(|p| [p[0] + x, p[1], p[2]]).collect();
        TriMesh::new(positions, ball.faces().to_vec()).unwrap()
    };
    let pair = merge(&[&aside(2.0), &aside(-2.0)]).unwrap();
    assert_eq!(error(&pair, &auto(0)), SymmetryError::Parts { face: pompeiu_core::FaceId(0) });
    let euclidean = options(0, CutStrategy::Euclidean { cuts: 1 });
    assert_eq!(error(&ball, &euclidean), SymmetryError::Strategy { strategy: "euclidean" });
    let convex =
        |boundary: ConvexBoundary, around| Method::Convex { boundary, weights: Weights::MeanValue, around };
    let around = Some(VirtualBoundary::default());
    let virtual_square = FlattenOptions { method: convex(ConvexBoundary::Square, around), ..auto(0) };
    assert_eq!(error(&ball, &virtual_square), SymmetryError::Virtual);
    let scalene = ConvexBoundary::Polygon(vec![[0.0, 0.0], [5.0, 0.0], [1.0, 2.0]]);
    let scalene = FlattenOptions { method: convex(scalene, None), ..auto(0) };
    assert_eq!(error(&ball, &scalene), SymmetryError::Boundary);
    // Some of its faces are divided by other diagonals on the other side.
    let cut = CutRequest { symmetry: Some(across(0)), ..CutRequest::default() };
    let onto_square =
        FlattenRequest { boundary: "square".parse().unwrap(), cut, ..FlattenRequest::default() };
    let found = onto_square.run(surface(&doll()), &RunContext::default());
    assert!(matches!(found, Err(FlattenError::Cut(CutError::Symmetry(SymmetryError::Chord { .. })))));
    let mut none = auto(0);
    none.cut.symmetry = Some(SymmetryPlane { normal: [0.0; 3], offset: 1.0 });
    assert!(matches!(error(&ball, &none), SymmetryError::Plane { .. }));
}
