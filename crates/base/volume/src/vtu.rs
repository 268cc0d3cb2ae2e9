//! Unstructured grids of VTK (`.vtu`), with arrays appended as they are.

use crate::HexMesh;
use std::io::{self, Write};

/// A named value for each cell, or a vector of three.
#[derive(Clone, Copy, Debug)]
pub struct CellData<'d> {
    /// Its name.
    pub name: &'d str,
    /// Values, `components` for each cell.
    pub values: &'d [f64],
    /// 1 or 3.
    pub components: usize,
}

/// A named value for each vertex, or a vector of three.
pub type PointData<'d> = CellData<'d>;

/// The number of VTK's cell type "hexahedron".
const HEXAHEDRON: u8 = 12;

/// Writes a mesh as a VTK XML unstructured grid, little-endian, arrays appended without encoding.
///
/// # Errors
/// Those of the writer; [`io::ErrorKind::InvalidInput`] for an array of the wrong length or a name that needs escaping.
pub fn write_vtu(
    mut out: impl Write,
    mesh: &HexMesh,
    points: &[PointData<'_>],
    cells: &[CellData<'_>],
) -> io::Result<()> {
    let (n, m) = (mesh.positions().len(), mesh.cells().len());
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
    let mut offset = 0_u64;
    let mut array = |kind: &str, name: &str, components: usize, bytes: usize| {
        let line = format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" offset=\"{offset}\"/>\n"
        );
        offset += 8 + bytes as u64;
        line
    };
    let mut header = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n",
    );
    header.extend([
        "<Piece NumberOfPoints=\"",
        &n.to_string(),
        "\" NumberOfCells=\"",
        &m.to_string(),
        "\">\n<Points>\n",
    ]);
    header += &array("Float64", "Points", 3, 24 * n);
    header += "</Points>\n<Cells>\n";
    header += &array("Int64", "connectivity", 1, 64 * m);
    header += &array("Int64", "offsets", 1, 8 * m);
    header += &array("UInt8", "types", 1, m);
    header += "</Cells>\n";
    for (tag, list) in [("PointData", points), ("CellData", cells)] {
        header.extend(["<", tag, ">\n"]);
        for data in list {
            header += &array("Float64", data.name, data.components, 8 * data.values.len());
        }
        header.extend(["</", tag, ">\n"]);
    }
    header += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
    out.write_all(header.as_bytes())?;
    let mut block = |length: usize, bytes: &mut dyn Iterator<Item = [u8; 8]>| -> io::Result<()> {
        let mut buffer = Vec::with_capacity(length + 8);
        buffer.extend_from_slice(&(length as u64).to_le_bytes());
        bytes.for_each(|word| buffer.extend_from_slice(&word));
        out.write_all(&buffer)
    };
    block(24 * n, &mut mesh.positions().iter().flat_map(glam::DVec3::to_array).map(f64::to_le_bytes))?;
    block(64 * m, &mut mesh.cells().iter().flatten().map(|&v| u64::from(v).to_le_bytes()))?;
    block(8 * m, &mut (1..=m as u64).map(|k| (8 * k).to_le_bytes()))?;
    out.write_all(&(m as u64).to_le_bytes())?;
    out.write_all(&vec![HEXAHEDRON; m])?;
    let mut block = |values: &[f64]| -> io::Result<()> {
        out.write_all(&(8 * values.len() as u64).to_le_bytes())?;
        out.write_all(&values.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>())
    };
    for data in points.iter().chain(cells) {
        block(data.values)?;
    }
    out.write_all(b"\n</AppendedData>\n</VTKFile>\n")
}
