use super::*;
use crate::mesh::shapes::{cube, icosphere, mobius_strip, torus};
use crate::mesh::{Affine, MeshSummary, Random, merge, shuffle, transform, unweld, without_unreferenced};

fn mesh(positions: &[[f64; 3]], faces: &[[u32; 3]]) -> TriMesh {
    TriMesh::new(positions.to_vec(), faces.to_vec()).unwrap()
}

fn repaired(mesh: &TriMesh, options: RepairOptions) -> Repaired {
    let repaired = repair(mesh, &options).unwrap();
    let summary = MeshSummary::of(&repaired.mesh);
    let topology = summary.connectivity;
    assert_eq!(topology.non_manifold_edges, 0);
    assert_eq!(topology.non_manifold_vertices, 0);
    assert_eq!([summary.degenerate_faces, summary.duplicate_faces, summary.unreferenced_vertices], [0; 3]);
    assert_eq!(topology.inconsistent_edges, 0);
    let one_sided = repaired.report.non_orientable_components.count;
    assert_eq!(repaired.report.opened_edges.count > 0, one_sided > 0);
    if repaired.report.filled_holes.count == 0 {
        let again = repair(&repaired.mesh, &options).unwrap();
        assert_eq!(again.mesh, repaired.mesh, "repaired twice");
        assert_eq!(again.report.turned_faces.count, 0);
    }
    repaired
}

const CORNERS: [[f64; 3]; 5] =
    [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];

#[test]
fn a_sound_mesh_stays_as_it_is() {
    for mesh in [icosphere(1.0, 2).unwrap(), torus(2.0, 0.7, 9, 7).unwrap(), cube(1.0, 2).unwrap()] {
        let found =
            repaired(&mesh, RepairOptions { weld: Weld::Equal, fill_holes: 10, ..RepairOptions::default() });
        assert!(found.report.is_unchanged(), "{:?}", found.report);
        assert_eq!(found.mesh, mesh);
    }
}

#[test]
fn loose_triangles_become_the_surface_they_came_from() {
    let torus = torus(2.0, 0.7, 9, 7).unwrap();
    let found = repaired(&unweld(&torus).unwrap(), RepairOptions::default());
    assert_eq!(found.report.welded.count, 3 * torus.faces().len() - torus.positions().len());
    assert_eq!(found.report.welded.places.len(), Change::MOST_PLACES);
    let [summary, expected] = [&found.mesh, &torus].map(MeshSummary::of);
    assert_eq!((summary.connectivity, summary.area), (expected.connectivity, expected.area));
    // +0 and −0 are the same position.
    let signed = mesh(
        &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-0.0, 0.0, -0.0], [1.0, -0.0, 0.0], [0.0, -1.0, 0.0]],
        &[[0, 1, 2], [4, 3, 5]],
    );
    assert_eq!(repaired(&signed, RepairOptions::default()).report.welded.count, 2);
    let never =
        repaired(&signed, RepairOptions { weld: Weld::Never, fill_holes: 0, ..RepairOptions::default() });
    assert_eq!(never.mesh, signed);
}

#[test]
fn vertices_within_a_length_become_one_and_no_others() {
    let sphere = icosphere(1.0, 3).unwrap();
    let loose = unweld(&sphere).unwrap();
    let mut random = Random::new(5);
    let shaken = loose.positions().iter().map(|p| p.map(|x| x + 1e-4 * random.signed_unit())).collect();
    let shaken = TriMesh::new(shaken, loose.faces().to_vec()).unwrap();
    for scale in [1e-150, 1.0, 1e150] {
        let scaled = transform(&shaken, &Affine::scale([scale; 3])).unwrap();
        let found = repaired(
            &scaled,
            RepairOptions { weld: Weld::Within(1e-3 * scale), fill_holes: 0, ..RepairOptions::default() },
        );
        assert_eq!(found.mesh.positions().len(), sphere.positions().len());
        assert_eq!(MeshSummary::of(&found.mesh).connectivity, MeshSummary::of(&sphere).connectivity);
        let exact = repaired(&scaled, RepairOptions::default());
        assert_eq!(exact.report.welded.count, 0);
    }
    let far = transform(&sphere, &Affine::translate([1e10; 3])).unwrap();
    let options = RepairOptions { weld: Weld::Within(1e-9), fill_holes: 0, ..RepairOptions::default() };
    assert!(matches!(repair(&far, &options), Err(RepairError::WeldBelowRounding { .. })));
}

#[test]
fn faces_that_do_not_count_are_dropped() {
    let positions = [CORNERS[0], CORNERS[1], CORNERS[2], [0.5, 0.0, 0.0], [9.0; 3]];
    let faces = [[0, 1, 2], [2, 0, 1], [0, 3, 1], [0, 0, 2], [2, 1, 0]];
    let report = repaired(&mesh(&positions, &faces), RepairOptions::default()).report;
    assert_eq!((report.degenerate_faces.count, report.duplicate_faces.count), (2, 2));
    assert_eq!(report.unreferenced_vertices.places, [[9.0; 3]]);
    let flat = mesh(&positions, &[[0, 3, 1], [0, 0, 2]]);
    let error = repair(&flat, &RepairOptions::default()).unwrap_err();
    assert_eq!(error, RepairError::NothingLeft { faces: 2, welded: 0 });
    assert_eq!(error.to_string(), "nothing is left: every face (of 2) is degenerate");
}

#[test]
fn edges_with_three_faces_and_vertices_of_two_fans_are_split() {
    let fins = mesh(&CORNERS, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
    let found = repaired(&fins, RepairOptions::default());
    assert_eq!((found.report.split_edges.count, found.report.split_vertices.count), (1, 2));
    assert_eq!(found.mesh.positions().len(), 9);
    let opposite = CORNERS.map(|p| if p[2] < 0.0 { [-1.0, 0.0, 0.0] } else { p });
    let bow_tie = mesh(&opposite, &[[0, 1, 2], [0, 3, 4]]);
    let found = repaired(&bow_tie, RepairOptions::default());
    assert_eq!((found.report.split_edges.count, found.report.split_vertices.places), (0, vec![[0.0; 3]]));
    // Two tetrahedra with a common edge are separated as wholes.
    let positions = [CORNERS[0], CORNERS[1], CORNERS[2], CORNERS[3], [0.0, -1.0, 0.0], [0.0, -1.0, -1.0]];
    let pair = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2], [0, 4, 1], [0, 1, 5], [1, 4, 5], [0, 5, 4]];
    let found = repaired(&mesh(&positions, &pair), RepairOptions::default());
    let topology = MeshSummary::of(&found.mesh).connectivity;
    assert_eq!((topology.components, topology.boundary_edges, topology.genus), (2, 0, Some(0)));
}

#[test]
fn the_fewest_faces_are_turned() {
    let sphere = icosphere(1.0, 2).unwrap();
    let far = transform(&sphere, &Affine::translate([9.0, 0.0, 0.0])).unwrap();
    let both = merge(&[&sphere, &far]).unwrap();
    let (positions, mut faces) = both.clone().into_parts();
    // Reverses most faces of the first sphere and few of the second: the first ends up inside out.
    let count = sphere.faces().len();
    for face in (10..count).chain([count + 3, count + 8]) {
        faces[face].swap(1, 2);
    }
    let found = repaired(&TriMesh::new(positions, faces).unwrap(), RepairOptions::default());
    assert_eq!(found.report.turned_faces.count, 12);
    assert!(MeshSummary::of(&found.mesh).connectivity.encloses_volume);
}

#[test]
fn surfaces_with_one_side_are_cut_open() {
    let strip = mobius_strip(2.0, 0.3, 12, 3).unwrap();
    let summary = MeshSummary::of(&strip);
    assert!(!summary.connectivity.orientable);
    let found = repaired(&strip, RepairOptions::default());
    assert_eq!(found.report.non_orientable_components.count, 1);
    let opened = MeshSummary::of(&found.mesh);
    // A disk: the strip, whose Euler characteristic is 0, cut once from side to side.
    assert_eq!((opened.connectivity.boundary_loops, opened.connectivity.genus), (1, Some(0)));
    assert_eq!((found.mesh.faces().len(), opened.area), (strip.faces().len(), summary.area));
    assert_eq!(found.report.opened_edges.count, 3);

    // The projective plane of six vertices has no boundary; a cut along a curve with one side makes a disk of it.
    let corners =
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 2.0], [2.0, 1.0, 1.0]];
    let faces = [
        [0, 1, 2],
        [0, 2, 3],
        [0, 3, 4],
        [0, 4, 5],
        [0, 5, 1],
        [1, 2, 4],
        [2, 3, 5],
        [3, 4, 1],
        [4, 5, 2],
        [5, 1, 3],
    ];
    let plane = mesh(&corners, &faces);
    for fill_holes in [0, 256] {
        let found = repaired(&plane, RepairOptions { fill_holes, ..RepairOptions::default() });
        let opened = MeshSummary::of(&found.mesh).connectivity;
        assert_eq!((opened.boundary_loops, opened.genus, found.report.faces_added), (1, Some(0), 0));
    }
}

#[test]
fn small_holes_are_filled_and_large_ones_are_not() {
    let sphere = icosphere(1.0, 2).unwrap();
    let (positions, faces) = sphere.clone().into_parts();
    // Without the faces around two vertices: holes of five and of six edges.
    let kept = faces.into_iter().filter(|face| !face.contains(&0) && !face.contains(&100)).collect();
    let open = without_unreferenced(&TriMesh::new(positions, kept).unwrap());
    assert_eq!(MeshSummary::of(&open).connectivity.boundary_loops, 2);
    for (most, filled, faces) in [(0, 0, 0), (4, 0, 0), (5, 1, 3), (6, 2, 7)] {
        let found = repaired(
            &open,
            RepairOptions { weld: Weld::Equal, fill_holes: most, ..RepairOptions::default() },
        );
        assert_eq!((found.report.filled_holes.count, found.report.faces_added), (filled, faces), "{most}");
        let topology = MeshSummary::of(&found.mesh).connectivity;
        assert_eq!((topology.boundary_loops, topology.genus), (2 - filled, Some(0)));
    }
    // The boundary of an isolated face has three edges; filling it would duplicate the face.
    let alone = mesh(&CORNERS[..3], &[[0, 1, 2]]);
    let found =
        repaired(&alone, RepairOptions { weld: Weld::Equal, fill_holes: 3, ..RepairOptions::default() });
    assert_eq!((found.report.holes_left.count, found.mesh), (1, alone));
}

#[test]
fn random_triangles_on_few_vertices_become_a_manifold() {
    let mut random = Random::new(11);
    for round in 0..400 {
        let vertices = 4 + random.below(6);
        let positions: Vec<_> = (0..vertices).map(|_| [0; 3].map(|_| f64::from(random.below(3)))).collect();
        let count = 1 + random.below(24);
        let faces: Vec<_> = (0..count).map(|_| [0; 3].map(|_| random.below(vertices))).collect();
        let mesh = mesh(&positions, &faces);
        for fill_holes in [0, 6] {
            let options = RepairOptions { weld: Weld::Equal, fill_holes, ..RepairOptions::default() };
            match repair(&mesh, &options) {
                Err(error) => assert!(matches!(error, RepairError::NothingLeft { .. }), "{error}"),
                Ok(_) => drop(repaired(&mesh, options)),
            }
        }
        if let Ok(found) = repair(&mesh, &RepairOptions::default()) {
            // The order of faces decides which duplicate is kept, not how many.
            let other = repair(&shuffle(&mesh, round), &RepairOptions::default()).unwrap();
            assert_eq!(other.mesh.faces().len(), found.mesh.faces().len());
        }
    }
}

#[test]
fn options_are_checked() {
    let cube = cube(1.0, 1).unwrap();
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = RepairOptions { weld: Weld::Within(length), fill_holes: 0, ..RepairOptions::default() };
        assert!(matches!(repair(&cube, &options), Err(RepairError::WeldLength(_))), "{length}");
    }
    let options = RepairOptions { weld: Weld::Equal, fill_holes: 257, ..RepairOptions::default() };
    assert_eq!(repair(&cube, &options), Err(RepairError::HoleEdges(257)));
}
