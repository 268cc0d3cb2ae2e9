//! Connectivity and geometry of known surfaces, and what is no surface.

use pompeiu_core::mesh::shapes::{self, Ends};
use pompeiu_core::{FaceId, MeshSummary, TriMesh, VertexId};
use pompeiu_surface::plane::rotate;
use pompeiu_surface::{
    EdgeData, EmbeddedSurface, GeometryError, HalfedgeId, Surface, SurfaceError, SurfaceMesh, flat_torus,
    orient,
};
use std::f64::consts::{PI, TAU};

fn meshes() -> Vec<TriMesh> {
    vec![
        shapes::icosphere(1.0, 2).unwrap(),
        shapes::torus(2.0, 0.7, 9, 7).unwrap(),
        shapes::cylinder(1.0, 1.0, 8, 3, Ends::Open).unwrap(),
        shapes::disk(1.0, 7, 3).unwrap(),
        shapes::perforated_plate(1.0, 2).unwrap(),
        TriMesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).unwrap(),
    ]
}

#[test]
fn halfedges_fit_together() {
    for mesh in meshes() {
        let surface = SurfaceMesh::new(&mesh).unwrap();
        for h in (0..surface.halfedges() as u32).map(HalfedgeId) {
            assert_eq!((h.next().next().next(), h.next().previous()), (h, h));
            assert_eq!(surface.head(h), surface.tail(h.next()));
            match surface.twin(h) {
                Some(twin) => {
                    assert_eq!(surface.twin(twin), Some(h));
                    assert_eq!([surface.tail(twin), surface.head(twin)], [surface.head(h), surface.tail(h)]);
                    assert_eq!(surface.edge(twin), surface.edge(h));
                    assert_ne!(surface.is_along(twin), surface.is_along(h));
                }
                None => assert!(surface.is_along(h) && surface.is_boundary_edge(surface.edge(h))),
            }
        }
        for v in surface.vertex_ids() {
            let around: Vec<HalfedgeId> = surface.outgoing(v).collect();
            let expected = mesh.faces().iter().filter(|face| face.contains(&v.0)).count();
            assert_eq!(around.len(), expected);
            assert!(around.iter().all(|&h| surface.tail(h) == v));
        }
    }
}

#[test]
fn counts_are_those_of_the_summary() {
    for mesh in meshes() {
        let surface = SurfaceMesh::new(&mesh).unwrap();
        let summary = MeshSummary::of(&mesh).connectivity;
        assert_eq!(surface.edges(), summary.edges);
        assert_eq!(surface.boundary_loops().len(), summary.boundary_loops);
        assert_eq!(surface.components(), summary.components);
        assert_eq!(surface.euler_characteristic(), summary.euler_characteristic);
        assert_eq!(Some(surface.genus()), summary.genus);
        let lengths: usize = surface.boundary_loops().iter().map(|&h| surface.boundary_loop(h).count()).sum();
        assert_eq!(lengths, summary.boundary_edges);
    }
}

#[test]
fn what_is_no_surface_is_named() {
    let faces = |faces: &[[u32; 3]]| SurfaceMesh::from_faces(5, faces).unwrap_err();
    assert_eq!(faces(&[]), SurfaceError::NoFaces);
    assert_eq!(
        faces(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]).to_string(),
        "the edge from vertex 0 to vertex 1 is in 3 faces, 0 and 1 among them, expected one or two; `pompeiu repair` splits such edges"
    );
    assert_eq!(
        faces(&[[0, 1, 2], [0, 1, 3], [2, 3, 4]]).to_string(),
        "faces 0 and 1 both run from vertex 0 to vertex 1: one of them is turned over; `pompeiu repair` turns it"
    );
    assert_eq!(
        faces(&[[0, 1, 2], [2, 3, 4]]).to_string(),
        "the 2 faces around vertex 2 form more than one fan; `pompeiu repair` splits such vertices"
    );
    assert_eq!(faces(&[[0, 1, 2]]).to_string(), "vertex 3 is in no face; remove it");
    assert_eq!(
        faces(&[[0, 1, 1]]).to_string(),
        "face 0 names vertex 1 more than once; `pompeiu repair` removes such faces"
    );
    assert_eq!(
        faces(&[[0, 1, 9]]).to_string(),
        "face 0 names vertex 9, but there are 5 vertices (the first is 0)"
    );
    let strip = shapes::mobius_strip(2.0, 1.0, 7, 1).unwrap();
    assert!(matches!(SurfaceMesh::new(&strip), Err(SurfaceError::NonOrientable { .. })));
}

#[test]
fn faces_without_a_shape_are_named() {
    let corner = |p: [f64; 3]| TriMesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], p], vec![[0, 1, 2]]).unwrap();
    let error = |p| EmbeddedSurface::new(&corner(p)).unwrap_err();
    assert!(matches!(error([0.5, 0.0, 0.0]), GeometryError::DegenerateFace { face: FaceId(0), .. }));
    assert!(matches!(error([0.5, 1e-13, 0.0]), GeometryError::DegenerateFace { .. }));
    assert!(matches!(error([0.0; 3]), GeometryError::DegenerateFace { .. }));
    assert!(matches!(error([0.0, 1e200, 0.0]), GeometryError::Scale { .. }));
    let message = |corners: [[f64; 3]; 3]| {
        EmbeddedSurface::new(&TriMesh::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap())
            .unwrap_err()
            .to_string()
    };
    let (p, q) = ([1.0; 3], [2.0; 3]);
    let advice =
        "; `pompeiu repair` drops faces without area, `pompeiu remesh` makes better ones of thin ones";
    assert_eq!(
        message([p, p, p]),
        format!("face 0 is degenerate: its corners are all at one position{advice}")
    );
    for corners in [[p, p, q], [q, p, p], [p, q, p]] {
        let expected = format!("face 0 is degenerate: two of its corners are at one position{advice}");
        assert_eq!(message(corners), expected);
    }
    assert!(EmbeddedSurface::new(&corner([0.5, 1e-9, 0.0])).is_ok());

    let mesh = SurfaceMesh::from_faces(3, &[[0, 1, 2]]).unwrap();
    let of = |lengths: &[f64]| {
        let lengths = EdgeData::new(lengths.len(), lengths.to_vec()).unwrap();
        Surface::from_edge_lengths(mesh.clone(), &lengths)
    };
    assert!(of(&[3.0, 4.0, 5.0]).is_ok());
    assert_eq!(of(&[3.0, 4.0]).unwrap_err(), GeometryError::LengthCount { found: 2, expected: 3 });
    for wrong in [[1.0, 1.0, 2.5], [1.0, 1.0, 2.0], [1.0, f64::NAN, 1.0], [0.0, 1.0, 1.0], [-3.0, 4.0, 5.0]] {
        assert!(matches!(of(&wrong), Err(GeometryError::DegenerateFace { .. })), "{wrong:?}");
    }
}

#[test]
fn lengths_alone_give_the_same_shape() {
    for mesh in meshes() {
        let embedded = EmbeddedSurface::new(&mesh).unwrap();
        let surface = embedded.surface();
        let again = Surface::from_edge_lengths(surface.mesh().clone(), &surface.edge_lengths()).unwrap();
        for f in surface.mesh().face_ids() {
            for (p, q) in surface.corners(f).iter().zip(again.corners(f)) {
                assert!((p[0] - q[0]).abs() < 1e-13 && (p[1] - q[1]).abs() < 1e-13, "{p:?} {q:?}");
            }
        }
    }
}

#[test]
fn areas_angles_and_frames_of_a_right_triangle() {
    // In the plane x = 1, with legs 3 along y and 4 along z.
    let mesh =
        TriMesh::new(vec![[1.0, 0.0, 0.0], [1.0, 3.0, 0.0], [1.0, 0.0, 4.0]], vec![[0, 1, 2]]).unwrap();
    let embedded = EmbeddedSurface::new(&mesh).unwrap();
    let surface = embedded.surface();
    let face = FaceId(0);
    assert_eq!(surface.corners(face), [[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]]);
    assert_eq!(surface.area(), 6.0);
    assert_eq!(surface.edge_lengths().as_slice(), [3.0, 5.0, 4.0]);
    assert_eq!(embedded.frame(face), &[[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]);
    let angles = [0, 1, 2].map(|i| surface.angles()[HalfedgeId::of(face, i)]);
    assert_eq!(angles, [0, 1, 2].map(|i| surface.angle(HalfedgeId::of(face, i))));
    assert_eq!(angles[0], PI / 2.0);
    assert!(
        (angles[1] - (4.0_f64 / 3.0).atan()).abs() < 1e-15 && (angles.iter().sum::<f64>() - PI).abs() < 1e-15
    );
    let cotangents = [0, 1, 2].map(|i| surface.cotangent(HalfedgeId::of(face, i)));
    assert!(cotangents[0] == 0.0 && (cotangents[1] - 0.75).abs() < 1e-15);
    assert_eq!(surface.vertex_areas().as_slice(), [2.0; 3]);
    assert_eq!(surface.edge_areas().as_slice(), [2.0; 3]);
    assert_eq!(embedded.to_tangent(face, [9.0, 2.0, 5.0]), [2.0, 5.0]);
    assert_eq!(embedded.to_space(face, [2.0, 5.0]), [0.0, 2.0, 5.0]);
    assert_eq!(surface.point(face, [0.5, 0.25, 0.25]), [0.75, 1.0]);
    let back = surface.barycentric(face, [0.75, 1.0]);
    assert!(back.iter().zip([0.5, 0.25, 0.25]).all(|(x, y)| (x - y).abs() < 1e-15), "{back:?}");
    assert_eq!(embedded.vertex_normals().as_slice(), [[1.0, 0.0, 0.0]; 3]);
}

#[test]
fn around_a_vertex_vectors_turn_by_the_angle_defect() {
    for mesh in meshes() {
        let embedded = EmbeddedSurface::new(&mesh).unwrap();
        let (surface, connectivity) = (embedded.surface(), embedded.mesh());
        let defects = surface.angle_defects();
        for v in connectivity.vertex_ids().filter(|&v| !connectivity.is_boundary_vertex(v)) {
            let turn = connectivity
                .outgoing(v)
                .filter_map(|h| surface.transport(h.previous()))
                .fold([1.0, 0.0], |sum, turn| rotate(turn, sum));
            let (sin, cos) = defects[v].sin_cos();
            assert!((turn[0] - cos).abs() <= 1e-12 && (turn[1] - sin).abs() <= 1e-12, "{turn:?}");
        }
    }
}

#[test]
fn transport_there_and_back_is_nothing() {
    let torus = flat_torus([3.0, 2.0], [5, 4]).unwrap();
    for h in (0..torus.mesh().halfedges() as u32).map(HalfedgeId) {
        let twin = torus.mesh().twin(h).unwrap();
        let both = rotate(torus.transport(twin).unwrap(), torus.transport(h).unwrap());
        assert!((both[0] - 1.0).abs() < 1e-15 && both[1].abs() < 1e-15);
    }
    assert!(torus.angle_defects().iter().all(|d| d.abs() < 1e-14));
    assert!((torus.total_angle(VertexId(0)) - TAU).abs() < 1e-14);
}

#[test]
fn turned_faces_are_turned_back() {
    let sphere = shapes::icosphere(1.0, 2).unwrap();
    let mut faces = sphere.faces().to_vec();
    for f in (1..faces.len()).step_by(3) {
        faces[f].swap(0, 1);
    }
    let mixed = TriMesh::new(sphere.positions().to_vec(), faces).unwrap();
    assert!(matches!(SurfaceMesh::new(&mixed), Err(SurfaceError::Misoriented { .. })));
    let oriented = orient(&mixed).unwrap();
    assert!(SurfaceMesh::new(&oriented).is_ok());
    assert_eq!(oriented.faces()[0], sphere.faces()[0]);
}

#[test]
fn one_sided_surfaces_stay_so() {
    let strip = shapes::mobius_strip(2.0, 1.0, 9, 2).unwrap();
    assert!(matches!(orient(&strip), Err(SurfaceError::NonOrientable { .. })));
    assert!(matches!(SurfaceMesh::new(&strip), Err(SurfaceError::NonOrientable { .. })));
}

#[test]
fn every_vertex_is_flat_and_frames_agree() {
    let torus = flat_torus([3.0, 2.0], [5, 4]).unwrap();
    assert!((torus.area() - 6.0).abs() < 1e-14);
    assert_eq!(torus.mesh().genus(), 1);
    assert!(torus.angle_defects().iter().all(|defect| defect.abs() < 1e-14));
    // The frame turns by half a turn from an even face to the odd one across its diagonal.
    let turn = torus.transport(HalfedgeId::of(FaceId(0), 2)).unwrap();
    assert!((turn[0] + 1.0).abs() < 1e-15 && turn[1].abs() < 1e-15, "{turn:?}");
}

#[test]
fn too_few_cells_and_no_size_are_refused() {
    assert!(matches!(flat_torus([1.0, 1.0], [2, 3]), Err(GeometryError::Surface(_))));
    assert!(matches!(flat_torus([0.0, 1.0], [3, 3]), Err(GeometryError::DegenerateFace { .. })));
    assert!(matches!(flat_torus([1.0, 1.0], [1 << 20, 1 << 20]), Err(GeometryError::Surface(_))));
}
