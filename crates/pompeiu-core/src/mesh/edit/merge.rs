//! Putting meshes together and taking faces apart.

use crate::mesh::{MeshError, TriMesh};

/// All faces of all meshes in one; vertices are not welded.
///
/// # Errors
/// [`MeshError::TooMany`] beyond 32-bit indices, [`MeshError::NoFaces`] without meshes.
pub fn merge(meshes: &[&TriMesh]) -> Result<TriMesh, MeshError> {
    let vertices = meshes.iter().map(|m| m.positions().len()).sum();
    if vertices > u32::MAX as usize {
        return Err(MeshError::TooMany { what: "vertices", count: vertices });
    }
    let mut positions = Vec::with_capacity(vertices);
    let mut faces = Vec::with_capacity(meshes.iter().map(|m| m.faces().len()).sum());
    for mesh in meshes {
        let first = positions.len() as u32;
        positions.extend_from_slice(mesh.positions());
        faces.extend(mesh.faces().iter().map(|f| f.map(|v| first + v)));
    }
    TriMesh::new(positions, faces)
}

/// Gives every face three vertices of its own, in face order: a triangle soup. Unreferenced vertices are left out.
///
/// # Errors
/// [`MeshError::TooMany`] beyond 32-bit indices.
pub fn unweld(mesh: &TriMesh) -> Result<TriMesh, MeshError> {
    let count = mesh.faces().len() * 3;
    if count > u32::MAX as usize {
        return Err(MeshError::TooMany { what: "vertices", count });
    }
    let positions = mesh.faces().iter().flatten().map(|&v| mesh.positions()[v as usize]).collect();
    TriMesh::new(positions, (0..count as u32).step_by(3).map(|v| [v, v + 1, v + 2]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::measure::volume;
    use crate::mesh::shapes::{cube, tetrahedron};
    use crate::mesh::{Affine, FaceId, transform};

    #[test]
    fn merged_meshes_keep_their_faces() {
        let (a, b) = (cube(1.0, 2).unwrap(), tetrahedron(3.0).unwrap());
        let both = merge(&[&a, &b]).unwrap();
        assert_eq!(both.positions().len(), a.positions().len() + 4);
        for f in 0..b.faces().len() as u32 {
            assert_eq!(both.corners(FaceId(a.faces().len() as u32 + f)), b.corners(FaceId(f)));
        }
        assert_eq!(merge(&[]), Err(MeshError::NoFaces { vertices: 0 }));
    }

    #[test]
    fn unwelded_faces_stay_where_they_are() {
        let mesh = transform(&cube(2.0, 2).unwrap(), &Affine::translate([5.0, 0.0, 0.0])).unwrap();
        let soup = unweld(&mesh).unwrap();
        assert_eq!(soup.positions().len(), 3 * mesh.faces().len());
        for f in (0..mesh.faces().len() as u32).map(FaceId) {
            assert_eq!(soup.corners(f), mesh.corners(f));
        }
        assert_eq!(volume(&soup), volume(&mesh));
    }
}
