//! Small surfaces for the tests of this crate.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

use crate::SurfaceMesh;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{self, Ends};
use pompeiu_core::mesh::{merge, subdivide};

pub(crate) fn annulus() -> TriMesh {
    shapes::cylinder(1.0, 1.0, 12, 3, Ends::Open).unwrap()
}

pub(crate) fn disk() -> TriMesh {
    shapes::disk(1.0, 11, 4).unwrap()
}

/// Names, meshes, and the dimensions of their first homology.
pub(crate) fn meshes() -> Vec<(String, SurfaceMesh, usize)> {
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
