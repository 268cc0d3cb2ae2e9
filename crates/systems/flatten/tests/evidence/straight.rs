//! Straightened paths: lengths of known geodesics, the unchanged surface, the same components after the cut.

use super::{real_mesh, surface, zoo};
use pompeiu_core::mesh::{Random, displace_at_random, shapes};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_flatten::{
    CutOptions, CutStrategy, FlattenOptions, Straightened, choose_cut, flatten, open, straighten,
};
use pompeiu_surface::{EdgeData, EdgeDistances, EmbeddedSurface};

fn length(surface: &EmbeddedSurface, cut: &EdgeData<bool>) -> f64 {
    let edges = surface.mesh().edge_ids().filter(|&edge| cut[edge]);
    edges.map(|edge| surface.surface().edge_length(edge)).sum()
}

/// The shortest path along edges between the vertices nearest to two points.
fn path(surface: &EmbeddedSurface, ends: [[f64; 3]; 2]) -> EdgeData<bool> {
    let distance = |v: VertexId, p: [f64; 3]| -> f64 {
        (0..3).map(|k| (surface.positions()[v][k] - p[k]).powi(2)).sum()
    };
    let nearest = |p: [f64; 3]| {
        surface.mesh().vertex_ids().min_by(|&v, &w| distance(v, p).total_cmp(&distance(w, p))).unwrap()
    };
    let [from, to] = ends.map(nearest);
    let path = EdgeDistances::from(surface.surface(), &[from]).path_to(surface.surface(), to);
    EdgeData::from_fn(surface.mesh().edges(), |edge| path.contains(&edge))
}

/// Straightens, and checks that the surface is unchanged: each face is the sum of its parts.
fn checked(surface: &EmbeddedSurface, cut: &EdgeData<bool>) -> Straightened {
    let straight = straighten(surface, cut).unwrap();
    let mut parts = vec![0.0; surface.mesh().faces()];
    for face in straight.surface.mesh().face_ids() {
        parts[straight.faces[face].index()] += straight.surface.surface().face_area(face);
    }
    for (face, sum) in surface.mesh().face_ids().zip(parts) {
        let area = surface.surface().face_area(face);
        assert!((sum / area - 1.0).abs() < 1e-9, "{face}: {sum} {area}");
    }
    let counts = |surface: &EmbeddedSurface| {
        (surface.mesh().euler_characteristic(), surface.mesh().boundary_loops().len())
    };
    assert_eq!(counts(&straight.surface), counts(surface));
    let kept = straight.surface.positions().as_slice();
    assert!(kept[..surface.positions().len()] == surface.positions().as_slice()[..]);
    assert!(length(&straight.surface, &straight.cut) <= length(surface, cut) * (1.0 + 1e-12));
    straight
}

#[test]
fn geodesics_of_known_length_are_found() {
    let grid = surface(&shapes::grid([3.0, 2.0], [12, 9], shapes::Diagonal::Rising).unwrap());
    let [low, high] = [f64::min, f64::max]
        .map(|most| [0, 1].map(|k| grid.positions().iter().map(|p| p[k]).reduce(most).unwrap()));
    // Against the diagonals of the cells, a cell away from the boundary.
    let (x, y) = (3.0 / 12.0, 2.0 / 9.0);
    let across = path(&grid, [[low[0] + x, high[1] - y, 0.0], [high[0] - x, low[1] + y, 0.0]]);
    let straight = checked(&grid, &across);
    let (found, expected) = (length(&straight.surface, &straight.cut), (3.0 - 2.0 * x).hypot(2.0 - 2.0 * y));
    assert!((found - expected).abs() < 1e-12 && length(&grid, &across) > found + 0.3, "{found}");
    // From a corner of a cube to the opposite one, over two of its sides.
    let cube = surface(&shapes::cube(1.0, 5).unwrap());
    let ends =
        cube.positions().iter().copied().fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[a, b], p| {
            [[0, 1, 2].map(|k| f64::min(a[k], p[k])), [0, 1, 2].map(|k| f64::max(b[k], p[k]))]
        });
    let straight = checked(&cube, &path(&cube, ends));
    let found = length(&straight.surface, &straight.cut);
    assert!((found - 5_f64.sqrt()).abs() < 1e-12, "{found}");
    // Half round a prism of 24 sides and up: a straight line where it is unrolled.
    let tube = surface(&shapes::cylinder(1.0, 2.0, 24, 7, shapes::Ends::Open).unwrap());
    let [bottom, top] =
        [f64::min, f64::max].map(|most| tube.positions().iter().map(|p| p[2]).reduce(most).unwrap());
    let straight = checked(&tube, &path(&tube, [[1.0, 0.0, bottom], [0.0, 1.0, top]]));
    let around = 6.0 * 2.0 * (std::f64::consts::PI / 24.0).sin();
    let found = length(&straight.surface, &straight.cut);
    assert!((found - around.hypot(top - bottom)).abs() < 1e-12, "{found}");
}

#[test]
fn straightened_cuts_leave_the_same_pieces() {
    let mut meshes: Vec<TriMesh> = vec![zoo(0, 0), zoo(1, 2), zoo(3, 0)];
    meshes.push(displace_at_random(&shapes::icosphere(1.0, 3).unwrap(), 0.05, 3).unwrap());
    meshes.extend(real_mesh("cow.off"));
    let mut random = Random::new(8);
    for mesh in meshes {
        let surface = surface(&mesh);
        let through = (0..6).map(|_| VertexId(random.below(surface.mesh().vertices() as u32))).collect();
        for strategy in [CutStrategy::Tips, CutStrategy::Through(through)] {
            let cut = choose_cut(&surface, &CutOptions { strategy, ..CutOptions::default() }).unwrap();
            let straight = checked(&surface, &cut);
            open(straight.surface.mesh(), &straight.cut).unwrap().check_disks().unwrap();
            let [before, after] = [length(&surface, &cut), length(&straight.surface, &straight.cut)];
            println!("{before:.4} -> {after:.4}");
            assert!(after < 0.999 * before, "{before} {after}");
            // A second run finds nothing to shorten.
            let again = straighten(&straight.surface, &straight.cut).unwrap();
            let still = length(&again.surface, &again.cut);
            assert!((still / after - 1.0).abs() < 1e-4, "{after} {still}");
        }
    }
}

#[test]
fn a_straightened_cut_is_flattened_like_any_other() {
    let surface = surface(&displace_at_random(&shapes::icosphere(1.0, 3).unwrap(), 0.05, 3).unwrap());
    let options = |strategy| FlattenOptions {
        cut: CutOptions { strategy, ..CutOptions::default() },
        ..FlattenOptions::default()
    };
    let before = flatten(&surface, &options(CutStrategy::Tips)).unwrap();
    let straight = straighten(&surface, &before.cut).unwrap();
    let after = flatten(&straight.surface, &options(CutStrategy::Along(straight.paths()))).unwrap();
    assert!(after.report.is_one_to_one() && after.report.charts == 1);
    assert!(after.report.cut.length < 0.999 * before.report.cut.length);
    assert!(after.cut == straight.cut);
}
