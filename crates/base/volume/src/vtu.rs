//! VTK unstructured grids (`.vtu`), with raw appended arrays.

use crate::{BezierMesh, HexMesh};
use glam::DVec3;
use pompeiu_core::vtk::{DataSet, VtkFile};
use std::io::{self, Write};

/// A named array with one number or vector of three per cell.
#[derive(Clone, Copy, Debug)]
pub struct CellData<'d> {
    /// Its name.
    pub name: &'d str,
    /// Values, `components` for each cell.
    pub values: &'d [f64],
    /// 1 or 3.
    pub components: usize,
}

/// A named array with one number or vector of three per vertex.
pub type PointData<'d> = CellData<'d>;

/// The number of VTK's cell type "hexahedron".
const HEXAHEDRON: u8 = 12;

/// The number of VTK's cell type "Bézier hexahedron".
const BEZIER_HEXAHEDRON: u8 = 79;

/// A list of cells of one type.
struct Grid<'g> {
    version: &'g str,
    kind: u8,
    positions: &'g [DVec3],
    /// The vertices of all cells, cell by cell.
    corners: &'g mut dyn Iterator<Item = u32>,
    per_cell: usize,
    cells: usize,
}

/// Writes a mesh as a VTK XML unstructured grid, little-endian, with raw appended arrays.
///
/// # Errors
/// Those of the writer; [`io::ErrorKind::InvalidInput`] for an array of the wrong length or a name that needs escaping.
pub fn write_vtu(
    out: impl Write,
    mesh: &HexMesh,
    points: &[PointData<'_>],
    cells: &[CellData<'_>],
) -> io::Result<()> {
    let mut grid = Grid {
        version: "1.0",
        kind: HEXAHEDRON,
        positions: mesh.positions(),
        corners: &mut mesh.cells().iter().flatten().copied(),
        per_cell: 8,
        cells: mesh.cells().len(),
    };
    write(out, &mut grid, points, cells)
}

/// Writes a mesh of tricubic cells as Bézier hexahedra, exactly; point data are coefficients, as the control points are.
///
/// # Errors
/// Those of [`write_vtu`].
pub fn write_bezier_vtu(
    out: impl Write,
    mesh: &BezierMesh,
    points: &[PointData<'_>],
    cells: &[CellData<'_>],
) -> io::Result<()> {
    let order: Vec<usize> = {
        let mut order = vec![0; 64];
        for k in 0..64 {
            order[vtk_place([k % 4, k / 4 % 4, k / 16])] = k;
        }
        order
    };
    let mut grid = Grid {
        // Since this version of the format, the edges along the third axis are ordered around the cell.
        version: "2.2",
        kind: BEZIER_HEXAHEDRON,
        positions: mesh.points(),
        corners: &mut mesh.cells().iter().flat_map(|cell| order.iter().map(|&k| cell[k])),
        per_cell: 64,
        cells: mesh.cells().len(),
    };
    write(out, &mut grid, points, cells)
}

/// VTK's index of a control point in a cell of degree three: corners, edges, faces, inside.
fn vtk_place([i, j, k]: [usize; 3]) -> usize {
    let is_end = |x: usize| x == 0 || x == 3;
    let around = match (i > 0, j > 0) {
        (false, false) => 0,
        (true, false) => 1,
        (true, true) => 2,
        (false, true) => 3,
    };
    match (is_end(i), is_end(j), is_end(k)) {
        (true, true, true) => around + if k > 0 { 4 } else { 0 },
        (false, true, true) => 8 + (i - 1) + if j > 0 { 4 } else { 0 } + if k > 0 { 8 } else { 0 },
        (true, false, true) => 8 + (j - 1) + if i > 0 { 2 } else { 6 } + if k > 0 { 8 } else { 0 },
        (true, true, false) => 24 + (k - 1) + 2 * around,
        (true, false, false) => 32 + (j - 1) + 2 * (k - 1) + if i > 0 { 4 } else { 0 },
        (false, true, false) => 40 + (i - 1) + 2 * (k - 1) + if j > 0 { 4 } else { 0 },
        (false, false, true) => 48 + (i - 1) + 2 * (j - 1) + if k > 0 { 4 } else { 0 },
        (false, false, false) => 56 + (i - 1) + 2 * ((j - 1) + 2 * (k - 1)),
    }
}

fn write(
    out: impl Write,
    grid: &mut Grid<'_>,
    points: &[PointData<'_>],
    cells: &[CellData<'_>],
) -> io::Result<()> {
    let (n, m, per_cell) = (grid.positions.len(), grid.cells, grid.per_cell);
    for (list, count) in [(points, n), (cells, m)] {
        for data in list {
            let plain = data.name.chars().all(|c| !"<>&\"'".contains(c) && !c.is_control());
            if data.values.len() != count * data.components || !plain {
                let message = format!(
                    "the array {:?} has {} values, expected {count} times {}",
                    data.name,
                    data.values.len(),
                    data.components
                );
                return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
            }
        }
    }
    let counts = format!("NumberOfPoints=\"{n}\" NumberOfCells=\"{m}\"");
    let mut file = VtkFile::new(grid.version, DataSet::UnstructuredGrid, &counts);
    file.open("Points");
    file.array("Points", "Float64", 3, 24 * n as u64);
    file.close("Points");
    file.open("Cells");
    file.array("connectivity", "Int64", 1, 8 * (per_cell * m) as u64);
    file.array("offsets", "Int64", 1, 8 * m as u64);
    file.array("types", "UInt8", 1, m as u64);
    file.close("Cells");
    for (tag, list) in [("PointData", points), ("CellData", cells)] {
        file.open(tag);
        for data in list {
            file.array(data.name, "Float64", data.components, 8 * data.values.len() as u64);
        }
        file.close(tag);
    }
    let mut arrays = file.arrays(out)?;
    arrays.append(grid.positions.iter().flat_map(DVec3::to_array).map(f64::to_le_bytes))?;
    arrays.append((&mut *grid.corners).map(|v| u64::from(v).to_le_bytes()))?;
    arrays.append((1..=m as u64).map(|k| (per_cell as u64 * k).to_le_bytes()))?;
    arrays.append(std::iter::repeat_n([grid.kind], m))?;
    for data in points.iter().chain(cells) {
        arrays.append(data.values.iter().map(|x| x.to_le_bytes()))?;
    }
    arrays.finish()
}
