//! Subdivision.

use crate::mesh::edges::{EdgeTable, has_three_vertices};
use crate::mesh::{MeshError, TriMesh};

/// Splits every face into four at the midpoints of its edges; faces with an edge in common share its midpoint.
///
/// The surface stays, up to the rounding of the midpoints. A face that names a vertex twice stays as it is. The old
/// vertices come first, then the midpoints; the four parts of a face come together: three corners, then the middle.
///
/// # Errors
/// [`MeshError::TooMany`] beyond 32-bit indices.
pub fn subdivide(mesh: &TriMesh) -> Result<TriMesh, MeshError> {
    let count = mesh.faces().len() * 4;
    if count > u32::MAX as usize {
        return Err(MeshError::TooMany { what: "faces", count });
    }
    let mut positions = mesh.positions().to_vec();
    // The midpoint on the edge from each corner to the next.
    let mut midpoints = vec![[u32::MAX; 3]; mesh.faces().len()];
    for edge in EdgeTable::new(mesh).iter() {
        let midpoint = positions.len();
        if midpoint >= u32::MAX as usize {
            return Err(MeshError::TooMany { what: "vertices", count: midpoint + 1 });
        }
        let [a, b] = edge.ends.map(|v| positions[v as usize]);
        positions.push(std::array::from_fn(|i| f64::midpoint(a[i], b[i])));
        for f in edge.faces() {
            let face = mesh.faces()[f];
            for corner in 0..3 {
                let ends = [face[corner], face[(corner + 1) % 3]];
                if edge.ends == ends || edge.ends == [ends[1], ends[0]] {
                    midpoints[f][corner] = midpoint as u32;
                }
            }
        }
    }
    let mut faces = Vec::with_capacity(count);
    for (&face, &[ab, bc, ca]) in mesh.faces().iter().zip(&midpoints) {
        if has_three_vertices(face) {
            let [a, b, c] = face;
            faces.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        } else {
            faces.push(face);
        }
    }
    TriMesh::new(positions, faces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::measure::{area, assert_close, assert_solid, euler_characteristic};
    use crate::mesh::shapes::{cube, mobius_strip};

    #[test]
    fn the_surface_stays_and_edges_are_shared() {
        let mesh = subdivide(&cube(2.0, 3).unwrap()).unwrap();
        assert_eq!((mesh.positions().len(), mesh.faces().len()), (56 + 162, 432));
        assert_solid(&mesh, 8.0);
        assert_eq!(euler_characteristic(&mesh), 2);
        let strip = mobius_strip(2.0, 1.0, 5, 1).unwrap();
        let split = subdivide(&strip).unwrap();
        assert_eq!(euler_characteristic(&split), 0);
        assert_close(area(&split), area(&strip));
    }

    #[test]
    fn a_face_with_a_repeated_vertex_stays() {
        let mesh = TriMesh::new(vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], vec![[0, 0, 1], [0, 1, 2]]);
        let split = subdivide(&mesh.unwrap()).unwrap();
        assert_eq!(split.positions()[3..], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
        assert_eq!(split.faces(), [[0, 0, 1], [0, 3, 4], [3, 1, 5], [4, 5, 2], [3, 5, 4]]);
    }
}
