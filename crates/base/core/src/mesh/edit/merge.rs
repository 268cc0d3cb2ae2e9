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

/// Leaves out the vertices that no face names; the others keep their order.
pub fn without_unreferenced(mesh: &TriMesh) -> TriMesh {
    const UNSEEN: u32 = u32::MAX;
    let mut new_index = vec![UNSEEN; mesh.positions().len()];
    for &v in mesh.faces().iter().flatten() {
        new_index[v as usize] = 0;
    }
    let mut positions = Vec::with_capacity(mesh.positions().len());
    for (index, &position) in new_index.iter_mut().zip(mesh.positions()) {
        if *index != UNSEEN {
            *index = positions.len() as u32;
            positions.push(position);
        }
    }
    let faces = mesh.faces().iter().map(|face| face.map(|v| new_index[v as usize])).collect();
    TriMesh::from_valid(positions, faces)
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

    #[test]
    fn unreferenced_vertices_go_and_the_rest_stays() {
        let positions = (0..6).map(|i| [f64::from(i), 0.0, 0.0]).collect();
        let mesh = TriMesh::new(positions, vec![[5, 1, 3], [1, 5, 4]]).unwrap();
        let compact = without_unreferenced(&mesh);
        let kept: Vec<f64> = compact.positions().iter().map(|p| p[0]).collect();
        assert_eq!(kept, [1.0, 3.0, 4.0, 5.0]);
        assert_eq!(compact.faces(), [[3, 0, 1], [0, 3, 2]]);
    }
}
