//! VTK XML polygonal data and unstructured grids, with raw appended arrays.

use super::attributes::COLORS;
use super::{Attributes, EncodeError};
use pompeiu_core::TriMesh;
use pompeiu_core::vtk::{DataSet, VtkFile};
use std::io::Write;

/// The number of VTK's cell type "triangle".
const TRIANGLE: u8 = 5;

pub(super) fn write(
    out: impl Write,
    data_set: DataSet,
    mesh: &TriMesh,
    attributes: &Attributes,
) -> Result<(), EncodeError> {
    let (cells, counts) = match data_set {
        DataSet::PolyData => {
            ("Polys", "NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys")
        }
        DataSet::UnstructuredGrid => ("Cells", "NumberOfCells"),
    };
    let (vertices, faces) = (mesh.positions().len(), mesh.faces().len());
    // The last offset, three per face, is the largest integer written, except perhaps a vertex index.
    let wide = i32::try_from(vertices).is_err() || i32::try_from(3 * faces as u64).is_err();
    let (integer, width) = if wide { ("Int64", 8) } else { ("Int32", 4) };
    let (n, m) = (vertices as u64, faces as u64);

    let counts = format!("NumberOfPoints=\"{vertices}\" {counts}=\"{faces}\"");
    let mut file = VtkFile::new("1.0", data_set, &counts);
    file.open("Points");
    file.array("Points", "Float64", 3, 24 * n);
    file.close("Points");
    file.open(cells);
    file.array("connectivity", integer, 1, 3 * width * m);
    file.array("offsets", integer, 1, width * m);
    if data_set == DataSet::UnstructuredGrid {
        file.array("types", "UInt8", 1, m);
    }
    file.close(cells);
    let vertex_scalars: Vec<_> = attributes.vertex_scalars().collect();
    let face_scalars: Vec<_> = attributes.face_scalars().collect();
    for (tag, count, colors, scalars) in [
        ("PointData", n, attributes.vertex_colors(), &vertex_scalars),
        ("CellData", m, attributes.face_colors(), &face_scalars),
    ] {
        // The array that programs show first.
        match (scalars.first(), colors) {
            (Some((name, _)), _) => file.open(&format!("{tag} Scalars=\"{name}\"")),
            (None, Some(_)) => file.open(&format!("{tag} Scalars=\"{COLORS}\"")),
            (None, None) => file.open(tag),
        }
        if colors.is_some() {
            file.array(COLORS, "UInt8", 3, 3 * count);
        }
        for (name, _) in scalars {
            file.array(name, "Float64", 1, 8 * count);
        }
        if tag == "CellData" {
            for (name, _) in attributes.face_vectors() {
                file.array(name, "Float64", 3, 24 * count);
            }
        }
        file.close(tag);
    }
    let mut arrays = file.arrays(out)?;
    arrays.append(mesh.positions().as_flattened().iter().map(|x| x.to_le_bytes()))?;
    let corners = mesh.faces().as_flattened();
    if wide {
        arrays.append(corners.iter().map(|&v| u64::from(v).to_le_bytes()))?;
        arrays.append((1..=m).map(|f| (3 * f).to_le_bytes()))?;
    } else {
        arrays.append(corners.iter().map(|v| v.to_le_bytes()))?;
        arrays.append((1..=m as u32).map(|f| (3 * f).to_le_bytes()))?;
    }
    if data_set == DataSet::UnstructuredGrid {
        arrays.append((0..m).map(|_| [TRIANGLE]))?;
    }
    for (colors, scalars) in
        [(attributes.vertex_colors(), &vertex_scalars), (attributes.face_colors(), &face_scalars)]
    {
        if let Some(colors) = colors {
            arrays.append(colors.iter().copied())?;
        }
        for (_, values) in scalars {
            arrays.append(values.iter().map(|x| x.to_le_bytes()))?;
        }
    }
    for (_, values) in attributes.face_vectors() {
        arrays.append(values.as_flattened().iter().map(|x| x.to_le_bytes()))?;
    }
    Ok(arrays.finish()?)
}
