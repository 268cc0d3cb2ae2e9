//! The one mesh type that algorithms accept.

use super::error::{MAX_COORDINATE, MeshError};
use super::{FaceId, VertexId};
use rayon::prelude::*;

/// A triangle soup whose indices are in range and whose coordinates are finite.
///
/// Nothing else is promised: faces may be degenerate, duplicated, inconsistently oriented or non-manifold, and
/// vertices may be unreferenced. There is at least one face.
///
/// # Shapes and units
/// `positions`: n points in a length unit of the caller's; `faces`: m triples of indices below n.
#[derive(Clone, Debug, PartialEq)]
pub struct TriMesh {
    positions: Vec<[f64; 3]>,
    faces: Vec<[u32; 3]>,
}

impl TriMesh {
    /// Largest supported magnitude of a coordinate, 2^1000: beyond it a squared extent could not be scaled back into range.
    pub const MAX_COORDINATE: f64 = MAX_COORDINATE;

    /// Checks the arrays and takes ownership of them.
    ///
    /// # Errors
    /// The first offending element in index order, vertices before faces; see [`MeshError`].
    ///
    /// # Cost
    /// O(n + m), parallel.
    pub fn new(positions: Vec<[f64; 3]>, faces: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        for (what, count) in [("vertices", positions.len()), ("faces", faces.len())] {
            if count > u32::MAX as usize {
                return Err(MeshError::TooMany { what, count });
            }
        }
        if faces.is_empty() {
            return Err(MeshError::NoFaces { vertices: positions.len() });
        }
        let in_range = |x: &f64| x.abs() <= Self::MAX_COORDINATE;
        if let Some(v) = first_failing(&positions, |p| p.iter().all(in_range)) {
            let axis = positions[v].iter().position(|x| !in_range(x)).unwrap_or(0);
            let (vertex, value) = (VertexId(v as u32), positions[v][axis]);
            return Err(if value.is_finite() {
                MeshError::TooLarge { vertex, axis, value }
            } else {
                MeshError::NonFinite { vertex, axis, value }
            });
        }
        let vertices = positions.len();
        if let Some(f) = first_failing(&faces, |f| f.iter().all(|&i| (i as usize) < vertices)) {
            let index = faces[f].into_iter().find(|&i| i as usize >= vertices).unwrap_or(0);
            return Err(MeshError::IndexOutOfRange { face: FaceId(f as u32), index, vertices });
        }
        Ok(Self { positions, faces })
    }

    /// Takes ownership of arrays that are a rearrangement of those of a valid mesh.
    pub(super) fn from_valid(positions: Vec<[f64; 3]>, faces: Vec<[u32; 3]>) -> Self {
        debug_assert!(Self::new(positions.clone(), faces.clone()).is_ok());
        Self { positions, faces }
    }

    /// All vertex positions, unreferenced ones included.
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// All faces as vertex index triples.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    /// The faces by name, in order.
    pub fn face_ids(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.faces.len() as u32).map(FaceId)
    }

    /// The three corner positions of a face, in the order stored.
    ///
    /// # Panics
    /// If `face` is not a face of this mesh.
    #[inline]
    pub fn corners(&self, face: FaceId) -> [[f64; 3]; 3] {
        let [a, b, c] = self.faces[face.index()];
        [self.positions[a as usize], self.positions[b as usize], self.positions[c as usize]]
    }

    /// The arrays, without copying.
    pub fn into_parts(self) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        (self.positions, self.faces)
    }
}

/// The first item that fails a check.
fn first_failing<T: Sync>(items: &[T], check: impl Fn(&T) -> bool + Sync) -> Option<usize> {
    /// Items per chunk; the check of a chunk does not stop early, so that it can be vectorised.
    const CHUNK: usize = 4096;
    let chunk =
        items.par_chunks(CHUNK).position_first(|chunk| !chunk.iter().fold(true, |ok, x| ok & check(x)))?;
    let start = chunk * CHUNK;
    items[start..].iter().position(|item| !check(item)).map(|at| start + at)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one_face(p: [f64; 3]) -> Result<TriMesh, MeshError> {
        TriMesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], p], vec![[0, 1, 2]])
    }

    #[test]
    fn accepts_a_degenerate_face_and_gives_its_corners() {
        let mesh = one_face([0.5, 0.0, 0.0]).unwrap();
        assert_eq!(mesh.corners(FaceId(0))[2], [0.5, 0.0, 0.0]);
    }

    #[test]
    fn names_the_offending_element() {
        let vertex = VertexId(2);
        assert!(
            matches!(one_face([0.0, f64::NAN, 0.0]), Err(MeshError::NonFinite { vertex: v, axis: 1, .. }) if v == vertex)
        );
        assert!(matches!(
            one_face([0.0, 0.0, f64::NEG_INFINITY]),
            Err(MeshError::NonFinite { axis: 2, value: f64::NEG_INFINITY, .. })
        ));
        assert!(matches!(one_face([1e305, 0.0, 0.0]), Err(MeshError::TooLarge { axis: 0, .. })));
        assert_eq!(
            TriMesh::new(vec![[0.0; 3]], vec![[0, 0, 0], [0, 7, 0]]),
            Err(MeshError::IndexOutOfRange { face: FaceId(1), index: 7, vertices: 1 })
        );
        assert_eq!(TriMesh::new(vec![[0.0; 3]], vec![]), Err(MeshError::NoFaces { vertices: 1 }));
    }

    #[test]
    fn names_the_first_of_many() {
        let positions = vec![[0.0; 3]; 10_000];
        let faces = vec![[0, 9_999, 1]; 10_000];
        assert!(TriMesh::new(positions.clone(), faces.clone()).is_ok());
        for wrong in [0, 4095, 4096, 9000] {
            let (mut p, mut f) = (positions.clone(), faces.clone());
            for later in [wrong, 9_998] {
                p[later][1] = f64::NAN;
                f[later][2] = 10_000;
            }
            let named = FaceId(wrong as u32);
            assert!(matches!(
                TriMesh::new(positions.clone(), f),
                Err(MeshError::IndexOutOfRange { face, index: 10_000, .. }) if face == named
            ));
            let named = VertexId(wrong as u32);
            assert!(matches!(
                TriMesh::new(p, faces.clone()),
                Err(MeshError::NonFinite { vertex, axis: 1, .. }) if vertex == named
            ));
        }
    }

    #[test]
    fn errors_read_as_sentences() {
        let error = one_face([f64::NAN, 0.0, 0.0]).unwrap_err();
        assert_eq!(error.to_string(), "coordinate x of vertex 2 is NaN");
    }
}
