//! Faces of cells: conformity, boundary, components.

use crate::{HexMesh, VolumeError};
use pompeiu_core::mesh::UnionFind;
use rayon::prelude::*;

/// The corners of the six faces of a cell, counter-clockwise seen from outside.
pub const FACES: [[usize; 4]; 6] =
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

/// A face between two cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InnerFace {
    /// Its vertices, counter-clockwise seen from the second cell.
    pub vertices: [u32; 4],
    /// The two cells, the lower first.
    pub cells: [u32; 2],
    /// Which face it is of each, in the order of [`FACES`].
    pub places: [u8; 2],
}

/// A face of one cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundaryFace {
    /// Its vertices, counter-clockwise seen from outside.
    pub vertices: [u32; 4],
    /// The cell.
    pub cell: u32,
    /// Which face it is of the cell, in the order of [`FACES`].
    pub place: u8,
}

/// The faces of a conforming mesh: each belongs to one cell, or to two on different sides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faces {
    inner: Vec<InnerFace>,
    boundary: Vec<BoundaryFace>,
    components: usize,
}

impl Faces {
    /// Finds the faces, in order of cells.
    ///
    /// # Errors
    /// [`VolumeError::NotConforming`] where more than two cells share a face, or two on the same side.
    /// # Cost
    /// O(n log n): one sort.
    pub fn new(mesh: &HexMesh) -> Result<Self, VolumeError> {
        let cells = mesh.cells();
        let mut all: Vec<([u32; 4], u32, u8)> = cells
            .iter()
            .enumerate()
            .flat_map(|(index, cell)| {
                FACES.iter().enumerate().map(move |(place, corners)| {
                    let mut key = corners.map(|k| cell[k]);
                    key.sort_unstable();
                    (key, index as u32, place as u8)
                })
            })
            .collect();
        all.par_sort_unstable();
        let vertices = |cell: u32, place: u8| FACES[place as usize].map(|k| cells[cell as usize][k]);
        let (mut inner, mut boundary) = (Vec::new(), Vec::new());
        let mut joined = UnionFind::new(cells.len());
        let mut components = cells.len();
        for run in all.chunk_by(|a, b| a.0 == b.0) {
            match *run {
                [(_, cell, place)] => {
                    boundary.push(BoundaryFace { vertices: vertices(cell, place), cell, place });
                }
                [(_, a, p), (_, b, q)] if are_opposite(vertices(a, p), vertices(b, q)) => {
                    inner.push(InnerFace { vertices: vertices(a, p), cells: [a, b], places: [p, q] });
                    components -= usize::from(joined.union(a as usize, b as usize));
                }
                _ => {
                    return Err(VolumeError::NotConforming { cells: [run[0].1 as usize, run[1].1 as usize] });
                }
            }
        }
        inner.sort_unstable_by_key(|face| (face.cells[0], face.places[0]));
        boundary.sort_unstable_by_key(|face| (face.cell, face.place));
        Ok(Self { inner, boundary, components })
    }

    /// Faces between two cells.
    pub fn inner(&self) -> &[InnerFace] {
        &self.inner
    }

    /// Faces of one cell.
    pub fn boundary(&self) -> &[BoundaryFace] {
        &self.boundary
    }

    /// Number of parts that are connected through faces.
    pub fn components(&self) -> usize {
        self.components
    }
}

/// Whether two cycles of the same four vertices run in opposite directions.
fn are_opposite(a: [u32; 4], b: [u32; 4]) -> bool {
    b.iter().position(|&v| v == a[0]).is_some_and(|k| (0..4).all(|i| a[i] == b[(k + 4 - i) % 4]))
}
