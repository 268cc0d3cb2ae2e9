//! Loops and forms that generate the homology of surfaces whose handles and holes are known.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{self, Ends};
use pompeiu_core::mesh::{merge, subdivide};
use pompeiu_surface::{Chain, EdgeId, Relative, SurfaceMesh, tree_cotree};

fn annulus() -> TriMesh {
    shapes::cylinder(1.0, 1.0, 12, 3, Ends::Open).unwrap()
}

fn disk() -> TriMesh {
    shapes::disk(1.0, 11, 4).unwrap()
}

/// Names, meshes, and the dimensions of their first homology.
fn meshes() -> Vec<(String, SurfaceMesh, usize)> {
    let torus = || shapes::torus(2.0, 0.7, 9, 7).unwrap();
    let both = merge(&[&torus(), &annulus(), &shapes::icosphere(1.0, 1).unwrap()]).unwrap();
    let mut all = vec![
        ("sphere".to_owned(), shapes::icosphere(1.0, 2).unwrap(), 0),
        ("torus".to_owned(), torus(), 2),
        ("annulus".to_owned(), annulus(), 1),
        ("disk".to_owned(), disk(), 0),
        ("one face".to_owned(), TriMesh::new(vec![[0.0; 3]; 3], vec![[0, 1, 2]]).unwrap(), 0),
        ("three components".to_owned(), both, 3),
    ];
    for holes in 1..=3 {
        let plate = shapes::perforated_plate(1.0, holes).unwrap();
        all.push((format!("plate with {holes} holes"), plate, 2 * holes as usize));
    }
    // The same with some faces removed: one more boundary loop for each.
    let plate = subdivide(&shapes::perforated_plate(1.0, 2).unwrap()).unwrap();
    let (positions, mut faces) = plate.into_parts();
    // Subdivided middle faces that do not touch each other.
    for f in [303, 103, 3] {
        faces.remove(f);
    }
    all.push(("open plate".to_owned(), TriMesh::new(positions, faces).unwrap(), 4 + 2));
    all.into_iter().map(|(name, mesh, n)| (name, SurfaceMesh::new(&mesh).unwrap(), n)).collect()
}

fn value(form: &Chain, edge: EdgeId) -> i32 {
    form.iter().filter(|entry| entry.0 == edge).map(|entry| i32::from(entry.1)).sum()
}

fn check(name: &str, mesh: &SurfaceMesh, relative: Relative, expected: usize) {
    let generators = tree_cotree(mesh, relative);
    assert_eq!((generators.loops.len(), generators.forms.len()), (expected, expected), "{name}");
    for (i, form) in generators.forms.iter().enumerate() {
        let mut values = vec![0_i32; mesh.edges()];
        for &(edge, sign) in form {
            values[edge.index()] += i32::from(sign);
            assert!(relative == Relative::ToNothing || !mesh.is_boundary_edge(edge), "{name}");
        }
        for f in mesh.face_ids() {
            let around = SurfaceMesh::face_halfedges(f).map(|h| {
                let value = values[mesh.edge(h).index()];
                if mesh.is_along(h) { value } else { -value }
            });
            assert_eq!(around.iter().sum::<i32>(), 0, "{name}: form {i} around face {f}");
        }
        for (j, cycle) in generators.loops.iter().enumerate() {
            let crossings: i32 = cycle.iter().map(|&(e, sign)| i32::from(sign) * value(form, e)).sum();
            assert_eq!(crossings, i32::from(i == j), "{name}: form {i} on loop {j}");
        }
    }
    for cycle in &generators.loops {
        let mut ends = vec![0_i32; mesh.vertices()];
        for &(edge, sign) in cycle {
            let [tail, head] = mesh.ends(edge);
            ends[tail.index()] -= i32::from(sign);
            ends[head.index()] += i32::from(sign);
        }
        for v in mesh.vertex_ids() {
            let may_end = relative == Relative::ToBoundary && mesh.is_boundary_vertex(v);
            assert!(ends[v.index()] == 0 || may_end, "{name}: a loop ends at vertex {v}");
        }
    }
}

#[test]
fn there_are_as_many_as_handles_and_holes_say() {
    for (name, mesh, dimension) in meshes() {
        for relative in [Relative::ToNothing, Relative::ToBoundary] {
            check(&name, &mesh, relative, dimension);
        }
    }
}

#[test]
fn around_the_annulus_or_across_it() {
    let mesh = SurfaceMesh::new(&annulus()).unwrap();
    let around = tree_cotree(&mesh, Relative::ToNothing).loops.remove(0);
    let across = tree_cotree(&mesh, Relative::ToBoundary).loops.remove(0);
    assert!(around.len() > across.len(), "{} edges around, {} across", around.len(), across.len());
    let disk = SurfaceMesh::new(&disk()).unwrap();
    assert!(tree_cotree(&disk, Relative::ToNothing).loops.is_empty());
}
