//! VTK XML polygonal data and unstructured grids, with raw appended arrays.

use super::attributes::COLORS;
use super::{Attributes, EncodeError};
use pompeiu_core::TriMesh;
use std::io::{self, Write};

/// Size of the byte count that precedes each appended array, by `header_type="UInt64"`.
const LENGTH_BYTES: u64 = 8;

/// The VTK data set that holds the triangles.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum DataSet {
    PolyData,
    UnstructuredGrid,
}

/// The number of VTK's cell type "triangle".
const TRIANGLE: u8 = 5;

pub(super) fn write(
    mut out: impl Write,
    data_set: DataSet,
    mesh: &TriMesh,
    attributes: &Attributes,
) -> Result<(), EncodeError> {
    let (name, cells, counts) = match data_set {
        DataSet::PolyData => (
            "PolyData",
            "Polys",
            "NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys",
        ),
        DataSet::UnstructuredGrid => ("UnstructuredGrid", "Cells", "NumberOfCells"),
    };
    let (vertices, faces) = (mesh.positions().len(), mesh.faces().len());
    // The last offset, three per face, is the largest integer written, except perhaps a vertex index.
    let wide = i32::try_from(vertices).is_err() || i32::try_from(3 * faces as u64).is_err();
    let (integer, width) = if wide { ("Int64", 8) } else { ("Int32", 4) };
    let (n, m) = (vertices as u64, faces as u64);

    let mut xml = Declarations { xml: Vec::new(), end: 0 };
    writeln!(
        xml.xml,
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"{name}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <{name}>\n\
         <Piece NumberOfPoints=\"{vertices}\" {counts}=\"{faces}\">"
    )?;
    xml.open("Points")?;
    xml.array("Points", "Float64", 3, 24 * n)?;
    xml.close("Points")?;
    xml.open(cells)?;
    xml.array("connectivity", integer, 1, 3 * width * m)?;
    xml.array("offsets", integer, 1, width * m)?;
    if data_set == DataSet::UnstructuredGrid {
        xml.array("types", "UInt8", 1, m)?;
    }
    xml.close(cells)?;
    let vertex_scalars: Vec<_> = attributes.vertex_scalars().collect();
    let face_scalars: Vec<_> = attributes.face_scalars().collect();
    for (tag, count, colors, scalars) in [
        ("PointData", n, attributes.vertex_colors(), &vertex_scalars),
        ("CellData", m, attributes.face_colors(), &face_scalars),
    ] {
        // The array that programs show first.
        match (scalars.first(), colors) {
            (Some((name, _)), _) => xml.open(&format!("{tag} Scalars=\"{name}\""))?,
            (None, Some(_)) => xml.open(&format!("{tag} Scalars=\"{COLORS}\""))?,
            (None, None) => xml.open(tag)?,
        }
        if colors.is_some() {
            xml.array(COLORS, "UInt8", 3, 3 * count)?;
        }
        for (name, _) in scalars {
            xml.array(name, "Float64", 1, 8 * count)?;
        }
        if tag == "CellData" {
            for (name, _) in attributes.face_vectors() {
                xml.array(name, "Float64", 3, 24 * count)?;
            }
        }
        xml.close(tag)?;
    }
    out.write_all(&xml.xml)?;
    writeln!(out, "</Piece>\n</{name}>\n<AppendedData encoding=\"raw\">")?;
    out.write_all(b"_")?;

    append(&mut out, 24 * n, mesh.positions().as_flattened(), |x| x.to_le_bytes())?;
    let corners = mesh.faces().as_flattened();
    if wide {
        append(&mut out, 24 * m, corners, |&v| u64::from(v).to_le_bytes())?;
        append_iter(&mut out, 8 * m, (1..=m).map(|f| (3 * f).to_le_bytes()))?;
    } else {
        append(&mut out, 12 * m, corners, |v| v.to_le_bytes())?;
        append_iter(&mut out, 4 * m, (1..=m as u32).map(|f| (3 * f).to_le_bytes()))?;
    }
    if data_set == DataSet::UnstructuredGrid {
        append_iter(&mut out, m, (0..m).map(|_| [TRIANGLE]))?;
    }
    for (colors, scalars) in
        [(attributes.vertex_colors(), &vertex_scalars), (attributes.face_colors(), &face_scalars)]
    {
        if let Some(colors) = colors {
            append(&mut out, 3 * colors.len() as u64, colors, |&color| color)?;
        }
        for (_, values) in scalars {
            append(&mut out, 8 * values.len() as u64, values, |x| x.to_le_bytes())?;
        }
    }
    for (_, values) in attributes.face_vectors() {
        append(&mut out, 24 * m, values.as_flattened(), |x| x.to_le_bytes())?;
    }
    Ok(out.write_all(b"\n</AppendedData>\n</VTKFile>\n")?)
}

/// The arrays declared so far; each begins where the previous one ends.
struct Declarations {
    xml: Vec<u8>,
    end: u64,
}

impl Declarations {
    fn open(&mut self, tag: &str) -> io::Result<()> {
        writeln!(self.xml, "<{tag}>")
    }

    fn close(&mut self, tag: &str) -> io::Result<()> {
        writeln!(self.xml, "</{tag}>")
    }

    fn array(&mut self, name: &str, kind: &str, components: u32, bytes: u64) -> io::Result<()> {
        let offset = self.end;
        self.end += LENGTH_BYTES + bytes;
        writeln!(
            self.xml,
            "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" \
             format=\"appended\" offset=\"{offset}\"/>"
        )
    }
}

fn append<T, const N: usize>(
    out: &mut impl Write,
    bytes: u64,
    values: &[T],
    encode: impl Fn(&T) -> [u8; N],
) -> io::Result<()> {
    append_iter(out, bytes, values.iter().map(encode))
}

fn append_iter<const N: usize>(
    out: &mut impl Write,
    bytes: u64,
    values: impl Iterator<Item = [u8; N]>,
) -> io::Result<()> {
    out.write_all(&bytes.to_le_bytes())?;
    for value in values {
        out.write_all(&value)?;
    }
    Ok(())
}
