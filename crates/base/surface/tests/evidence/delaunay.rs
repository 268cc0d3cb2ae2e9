//! Intrinsic Delaunay triangulations: angles, energies, and what must not change.

use pompeiu_core::mesh::shapes::{self, Diagonal};
use pompeiu_core::mesh::{Random, displace_at_random};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_surface::{EdgeData, EmbeddedSurface, Surface, SurfaceMesh, intrinsic_delaunay};

fn surface(mesh: &TriMesh) -> Surface {
    EmbeddedSurface::new(mesh).unwrap().surface().clone()
}

/// The sum of the cotangents opposite each inner edge.
fn weights(surface: &Surface) -> Vec<f64> {
    let mesh = surface.mesh();
    let inner = mesh.edge_ids().map(|edge| mesh.edge_halfedge(edge));
    inner
        .filter_map(|h| Some((h, mesh.twin(h)?)))
        .map(|(h, twin)| surface.cotangent(h.previous()) + surface.cotangent(twin.previous()))
        .collect()
}

fn energy(surface: &Surface, values: &[f64]) -> f64 {
    let mesh = surface.mesh();
    let halfedges = mesh.face_ids().flat_map(SurfaceMesh::face_halfedges);
    halfedges
        .map(|h| {
            let step = values[mesh.head(h).index()] - values[mesh.tail(h).index()];
            0.5 * surface.cotangent(h.previous()) * step * step
        })
        .sum()
}

fn cases() -> Vec<Surface> {
    let torus = shapes::torus(2.0, 0.7, 24, 16).unwrap();
    vec![
        surface(&displace_at_random(&torus, 0.2, 1).unwrap()),
        surface(&displace_at_random(&shapes::icosphere(1.0, 3).unwrap(), 0.1, 2).unwrap()),
        surface(&shapes::schwarz_lantern(1.0, 2.0, 6, 40).unwrap()),
        surface(&shapes::uv_sphere(1.0, 40, 5).unwrap()),
        surface(&shapes::cuboid([1.0, 0.01, 5.0], 3).unwrap()),
    ]
}

#[test]
fn all_edges_become_delaunay_and_the_surface_stays() {
    let mut flips = Vec::new();
    for before in cases() {
        let after = intrinsic_delaunay(&before).unwrap();
        flips.push(after.flips);
        assert_eq!(after.left, 0);
        let worst = weights(&after.surface).into_iter().fold(f64::INFINITY, f64::min);
        assert!(worst >= -1e-9, "{worst:e}");
        assert!((after.surface.area() / before.area() - 1.0).abs() < 1e-10);
        let (mesh, old) = (after.surface.mesh(), before.mesh());
        assert_eq!((mesh.edges(), mesh.faces()), (old.edges(), old.faces()));
        assert_eq!(mesh.genus(), old.genus());
        for (a, b) in after.surface.angle_defects().iter().zip(before.angle_defects()) {
            assert!((a - b).abs() < 1e-9, "{a} {b}");
        }
        // The result is Delaunay: a second run flips nothing.
        assert_eq!(intrinsic_delaunay(&after.surface).unwrap().flips, 0);
    }
    assert!(flips.iter().filter(|&&n| n > 0).count() >= 3, "{flips:?}");
}

#[test]
fn energies_do_not_grow() {
    for before in cases() {
        let after = intrinsic_delaunay(&before).unwrap().surface;
        let mut random = Random::new(5);
        for _ in 0..20 {
            let values: Vec<f64> = (0..before.mesh().vertices()).map(|_| random.signed_unit()).collect();
            let (old, new) = (energy(&before, &values), energy(&after, &values));
            assert!(new <= old * (1.0 + 1e-12), "{old} {new}");
        }
    }
}

#[test]
fn an_edge_may_come_back_to_its_vertex() {
    // A triangle covered twice, with an obtuse angle at vertex 2.
    let mesh = SurfaceMesh::from_faces(3, &[[0, 1, 2], [1, 0, 2]]).unwrap();
    let length = |edge| if mesh.ends(edge).iter().all(|v| v.0 < 2) { 1.8 } else { 1.0 };
    let lengths = EdgeData::from_fn(mesh.edges(), length);
    let before = Surface::from_edge_lengths(mesh, &lengths).unwrap();
    let after = intrinsic_delaunay(&before).unwrap();
    assert_eq!((after.flips, after.left), (1, 0));
    let mesh = after.surface.mesh();
    let loops = mesh.edge_ids().filter(|&edge| mesh.ends(edge) == [VertexId(2); 2]).count();
    assert_eq!((loops, mesh.edges(), mesh.euler_characteristic()), (1, 3, 2));
    assert!((after.surface.area() - before.area()).abs() < 1e-15);
    for (a, b) in after.surface.angle_defects().iter().zip(before.angle_defects()) {
        assert!((a - b).abs() < 1e-14, "{a} {b}");
    }
}

#[test]
fn a_plane_stays_a_plane() {
    // The long diagonal of each sheared cell becomes the short one.
    let grid = shapes::grid([4.0, 4.0], [4, 4], Diagonal::Rising).unwrap();
    let sheared = grid.positions().iter().map(|&[x, y, z]| [x + 0.5 * y, y, z]).collect();
    let mesh = TriMesh::new(sheared, grid.faces().to_vec()).unwrap();
    let after = intrinsic_delaunay(&surface(&mesh)).unwrap();
    assert_eq!((after.flips, after.left), (16, 0));
    let longest = after.surface.edge_lengths().into_iter().fold(0.0, f64::max);
    assert!((longest - 1.25_f64.sqrt()).abs() < 1e-14, "{longest}");
    // Right angles need no flip.
    assert_eq!(intrinsic_delaunay(&surface(&grid)).unwrap().flips, 0);
}
