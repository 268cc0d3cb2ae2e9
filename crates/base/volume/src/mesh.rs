//! The mesh type.

use crate::VolumeError;
use glam::DVec3;

/// Vertices and hexahedral cells. Every index names a vertex, no cell names a vertex twice, all coordinates are finite. Cells may
/// be folded, and faces may not conform: see [`certify`](crate::certify) and [`Faces`](crate::Faces).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct HexMesh {
    positions: Vec<DVec3>,
    cells: Vec<[u32; 8]>,
}

impl HexMesh {
    /// The mesh of these vertices and cells.
    ///
    /// # Errors
    /// [`VolumeError::Index`], [`VolumeError::Repeated`], [`VolumeError::NotFinite`].
    pub fn new(positions: Vec<DVec3>, cells: Vec<[u32; 8]>) -> Result<Self, VolumeError> {
        if let Some(vertex) = positions.iter().position(|p| !p.is_finite()) {
            return Err(VolumeError::NotFinite { vertex });
        }
        for (index, cell) in cells.iter().enumerate() {
            for (k, &corner) in cell.iter().enumerate() {
                if corner as usize >= positions.len() {
                    return Err(VolumeError::Index { cell: index, index: corner, vertices: positions.len() });
                }
                if cell[..k].contains(&corner) {
                    return Err(VolumeError::Repeated { cell: index, index: corner });
                }
            }
        }
        Ok(Self { positions, cells })
    }

    /// A box of the given size, one corner at the origin, with this many cells along each axis.
    pub fn grid(cells: [u32; 3], size: [f64; 3]) -> Self {
        let [nx, ny, nz] = cells;
        let vertex = |i: u32, j: u32, k: u32| i + (nx + 1) * (j + (ny + 1) * k);
        let mut positions = Vec::new();
        let mut list = Vec::new();
        for k in 0..=nz {
            for j in 0..=ny {
                for i in 0..=nx {
                    let at = |i: u32, n: u32, size: f64| size * f64::from(i) / f64::from(n);
                    positions.push(DVec3::new(at(i, nx, size[0]), at(j, ny, size[1]), at(k, nz, size[2])));
                    if i < nx && j < ny && k < nz {
                        let [a, b] = [k, k + 1].map(|k| {
                            [
                                vertex(i, j, k),
                                vertex(i + 1, j, k),
                                vertex(i + 1, j + 1, k),
                                vertex(i, j + 1, k),
                            ]
                        });
                        list.push([a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]]);
                    }
                }
            }
        }
        Self { positions, cells: list }
    }

    /// The vertices.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The cells.
    pub fn cells(&self) -> &[[u32; 8]] {
        &self.cells
    }

    /// The corners of a cell.
    ///
    /// # Panics
    /// If the cell names a vertex that does not exist; cells of this mesh never do.
    pub fn corners(&self, cell: [u32; 8]) -> [DVec3; 8] {
        cell.map(|vertex| self.positions[vertex as usize])
    }
}
