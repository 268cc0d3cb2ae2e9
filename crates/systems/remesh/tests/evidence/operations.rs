//! Random flips, splits and collapses keep a valid surface.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{self, Ends};
use pompeiu_core::mesh::{MeshSummary, Random, subdivide};
use pompeiu_remesh::{ConnectivityError, DynamicMesh, Illegal};
use pompeiu_surface::HalfedgeId;

fn surfaces() -> Vec<TriMesh> {
    vec![
        shapes::icosphere(1.0, 2).unwrap(),
        shapes::torus(2.0, 0.7, 24, 16).unwrap(),
        shapes::cylinder(1.0, 1.5, 17, 6, Ends::Open).unwrap(),
        shapes::disk(1.0, 20, 6).unwrap(),
        subdivide(&shapes::perforated_plate(1.0, 3).unwrap()).unwrap(),
    ]
}

fn dynamic(mesh: &TriMesh) -> DynamicMesh {
    DynamicMesh::new(mesh.positions(), mesh.faces()).unwrap()
}

/// What no operation may change.
pub(crate) fn topology(mesh: &TriMesh) -> (usize, isize, usize, bool) {
    let connectivity = MeshSummary::of(mesh).connectivity;
    (
        connectivity.components,
        connectivity.euler_characteristic,
        connectivity.boundary_loops,
        connectivity.orientable,
    )
}

fn midpoint([p, q]: [[f64; 3]; 2]) -> [f64; 3] {
    [0, 1, 2].map(|k| 0.5 * (p[k] + q[k]))
}

#[test]
fn random_operations_keep_a_valid_surface_of_the_same_topology() {
    // Together 10^6 operations, of which many are illegal.
    for (seed, mesh) in surfaces().into_iter().enumerate() {
        let mut surface = dynamic(&mesh);
        let mut random = Random::new(seed as u64);
        let size = surface.face_count();
        let mut halfedges: Vec<HalfedgeId> = surface.halfedges().collect();
        let mut done = [0_u32; 3];
        for step in 0..200_000 {
            if step % 500 == 0 {
                halfedges = surface.halfedges().collect();
            }
            let h = halfedges[random.below(halfedges.len() as u32) as usize];
            if !surface.has_halfedge(h) {
                continue;
            }
            let kind = if surface.face_count() > 2 * size { 2 } else { random.below(3) as usize };
            let legal = match kind {
                0 => surface.flip_edge(h).is_ok(),
                1 => {
                    surface.split_edge(h, midpoint(surface.ends(h)));
                    true
                }
                _ => surface.collapse_edge(h, surface.ends(h)[1]).is_ok(),
            };
            done[kind] += u32::from(legal);
            if step % 20_000 == 0 {
                surface.assert_valid();
            }
        }
        surface.assert_valid();
        assert!(done.iter().all(|n| *n > 5_000), "{done:?}");
        assert_eq!(topology(&surface.to_mesh().unwrap()), topology(&mesh));
    }
}

#[test]
fn four_flips_give_the_mesh_back_bit_for_bit() {
    for mesh in surfaces() {
        let mut surface = dynamic(&mesh);
        let halfedges: Vec<HalfedgeId> = surface.halfedges().collect();
        let mut flipped = 0;
        for h in halfedges {
            if surface.flip_edge(h).is_ok() {
                assert!((1..4).all(|_| surface.flip_edge(h).is_ok()), "{h:?}");
                assert_eq!(surface.to_mesh().unwrap(), mesh, "four flips of {h:?}");
                flipped += 1;
            }
        }
        assert!(flipped > mesh.faces().len());
        surface.assert_valid();
    }
}

#[test]
fn a_split_undone_by_a_collapse_gives_the_mesh_back_bit_for_bit() {
    for mesh in surfaces() {
        let mut surface = dynamic(&mesh);
        let halfedges: Vec<HalfedgeId> = surface.halfedges().collect();
        for h in halfedges {
            let [p, q] = surface.ends(h);
            let from_middle = surface.split_edge(h, midpoint([p, q]));
            assert_eq!(surface.ends(from_middle), [midpoint([p, q]), q]);
            surface.collapse_edge(from_middle, q).unwrap();
            assert_eq!(surface.to_mesh().unwrap(), mesh, "a split of {h:?}");
        }
        surface.assert_valid();
    }
}

#[test]
fn collapses_that_would_pinch_the_surface_are_refused() {
    // A double pyramid over a triangle: the three vertices of the triangle are joined, but no face fills it.
    let ring = [[1.0, 0.0, 0.0], [-0.5, 0.8, 0.0], [-0.5, -0.8, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    let faces = [[0, 1, 3], [1, 2, 3], [2, 0, 3], [1, 0, 4], [2, 1, 4], [0, 2, 4]];
    let mut surface = DynamicMesh::new(&ring, &faces).unwrap();
    let first = surface.clone();
    assert_eq!(surface.collapse_edge(HalfedgeId(0), ring[1]), Err(Illegal::Link));
    assert_eq!(surface, first);
    let mut tetrahedron =
        DynamicMesh::new(&ring[..4], &[[0, 1, 3], [1, 2, 3], [2, 0, 3], [1, 0, 2]]).unwrap();
    assert_eq!(tetrahedron.collapse_edge(HalfedgeId(0), ring[1]), Err(Illegal::TooFewFaces));
    // A strip of two faces: its diagonal joins two boundary vertices.
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let mut strip = DynamicMesh::new(&square, &[[0, 1, 2], [0, 2, 3]]).unwrap();
    assert_eq!(strip.collapse_edge(HalfedgeId(2), square[0]), Err(Illegal::JoinsBoundary));
    assert_eq!(strip.flip_edge(HalfedgeId(0)), Err(Illegal::Boundary));
}

#[test]
fn what_is_no_oriented_manifold_is_named() {
    let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]];
    let of = |faces: &[[u32; 3]]| DynamicMesh::new(&points, faces).unwrap_err();
    assert_eq!(of(&[[0, 1, 2], [3, 4, 4]]), ConnectivityError::RepeatedVertex { face: 1, vertex: 4 });
    assert_eq!(
        of(&[[0, 1, 2], [0, 1, 3]]),
        ConnectivityError::SharedHalfedge { faces: [0, 1], from: 0, to: 1 }
    );
    let three = of(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
    assert_eq!(three, ConnectivityError::SharedHalfedge { faces: [0, 2], from: 0, to: 1 });
    let points = [points, points].concat();
    let fans = DynamicMesh::new(&points, &[[0, 1, 2], [0, 5, 6]]).unwrap_err();
    assert_eq!(fans, ConnectivityError::SeveralFans { vertex: 0 });
}
