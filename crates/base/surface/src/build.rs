//! Building half-edges from vertex triples, and orienting faces consistently.

use crate::SurfaceError;
use pompeiu_core::{FaceId, TriMesh, VertexId};

pub(crate) const NONE: u32 = u32::MAX;

/// The half-edges of one undirected edge.
pub(crate) struct Pairs {
    /// Ends, the lesser first, then the half-edge; sorted.
    uses: Vec<([u32; 2], u32)>,
}

impl Pairs {
    /// Groups half-edges by their ends.
    ///
    /// # Cost
    /// O(F log F) at worst, O(F) at bounded valence.
    pub(crate) fn new(vertices: usize, faces: &[[u32; 3]]) -> Result<Self, SurfaceError> {
        if faces.is_empty() {
            return Err(SurfaceError::NoFaces);
        }
        if faces.len() > (u32::MAX / 3) as usize {
            return Err(SurfaceError::TooManyFaces { faces: faces.len() });
        }
        let mut starts = vec![0_usize; vertices + 1];
        for (f, face) in faces.iter().enumerate() {
            for i in 0..3 {
                let (id, vertex) = (FaceId(f as u32), VertexId(face[i]));
                if vertex.index() >= vertices {
                    return Err(SurfaceError::NoSuchVertex { face: id, vertex, vertices });
                }
                if face[i] == face[(i + 1) % 3] {
                    return Err(SurfaceError::RepeatedVertex { face: id, vertex });
                }
            }
            for [a, b] in sides(*face) {
                starts[a.min(b) as usize + 1] += 1;
            }
        }
        for v in 1..starts.len() {
            starts[v] += starts[v - 1];
        }
        let mut next = starts.clone();
        let mut uses = vec![([0; 2], 0); 3 * faces.len()];
        for (f, face) in faces.iter().enumerate() {
            for (i, [a, b]) in sides(*face).into_iter().enumerate() {
                let place = &mut next[a.min(b) as usize];
                uses[*place] = ([a.min(b), a.max(b)], (3 * f + i) as u32);
                *place += 1;
            }
        }
        for group in starts.windows(2) {
            uses[group[0]..group[1]].sort_unstable();
        }
        Ok(Self { uses })
    }

    /// The half-edges of each edge.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[([u32; 2], u32)]> {
        self.uses.chunk_by(|a, b| a.0 == b.0)
    }

    /// Checks that no edge has more than two faces.
    pub(crate) fn check_two_faces(&self) -> Result<(), SurfaceError> {
        match self.iter().find(|edge| edge.len() > 2) {
            Some(edge) => Err(SurfaceError::NonManifoldEdge {
                ends: edge[0].0.map(VertexId),
                faces: edge.len(),
                first: [edge[0].1, edge[1].1].map(|h| FaceId(h / 3)),
            }),
            None => Ok(()),
        }
    }
}

/// The directed sides of a face.
pub(crate) fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Reverses faces so that neighbours agree; the first face of each component keeps its orientation.
///
/// # Errors
/// [`SurfaceError::NonOrientable`], and the errors of edges and faces; vertices are not checked.
///
/// # Cost
/// O(F log F) at worst, O(F) at bounded valence.
pub fn orient(mesh: &TriMesh) -> Result<TriMesh, SurfaceError> {
    let faces = mesh.faces();
    let turned = turns(mesh.positions().len(), faces)?;
    let faces = faces.iter().zip(turned).map(|(&[a, b, c], turn)| if turn { [a, c, b] } else { [a, b, c] });
    let (positions, faces) = (mesh.positions().to_vec(), faces.collect());
    // The same vertices in another order, so the mesh stays valid.
    TriMesh::new(positions, faces).map_err(|_| SurfaceError::NoFaces)
}

/// Which faces must be reversed for all to agree.
pub(crate) fn turns(vertices: usize, faces: &[[u32; 3]]) -> Result<Vec<bool>, SurfaceError> {
    let pairs = Pairs::new(vertices, faces)?;
    pairs.check_two_faces()?;
    // Across each half-edge: the neighbour, and whether both run in the same direction.
    let mut across = vec![(NONE, false); 3 * faces.len()];
    let direction = |h: u32| sides(faces[h as usize / 3])[h as usize % 3];
    for edge in pairs.iter() {
        if let [(_, g), (_, h)] = *edge {
            let same = direction(g) == direction(h);
            across[g as usize] = (h / 3, same);
            across[h as usize] = (g / 3, same);
        }
    }
    let mut turned: Vec<Option<bool>> = vec![None; faces.len()];
    let mut open = Vec::new();
    for seed in 0..faces.len() {
        if turned[seed].is_some() {
            continue;
        }
        turned[seed] = Some(false);
        open.push(seed);
        while let Some(f) = open.pop() {
            let here = turned[f] == Some(true);
            for i in 0..3 {
                let (neighbour, same) = across[3 * f + i];
                if neighbour == NONE {
                    continue;
                }
                let wanted = here != same;
                match turned[neighbour as usize] {
                    None => {
                        turned[neighbour as usize] = Some(wanted);
                        open.push(neighbour as usize);
                    }
                    Some(turn) if turn != wanted => {
                        let ends = direction((3 * f + i) as u32).map(VertexId);
                        return Err(SurfaceError::NonOrientable {
                            faces: [FaceId(f as u32), FaceId(neighbour)],
                            ends,
                        });
                    }
                    Some(_) => {}
                }
            }
        }
    }
    Ok(turned.into_iter().map(|turn| turn == Some(true)).collect())
}
