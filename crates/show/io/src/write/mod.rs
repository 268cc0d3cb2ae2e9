//! Writing triangle meshes, with the attributes that each format can store.

mod attributes;
mod error;
mod format;
mod glb;
mod normals;
mod obj;
mod off;
mod ply;
mod replace;
mod stl;
mod text;
mod three_mf;
mod vtk_xml;

use flate2::{Compression, write::GzEncoder};
use pompeiu_core::TriMesh;
use pompeiu_core::vtk::DataSet;
use std::io::{self, Write};
use std::path::Path;

pub use attributes::{AttributeError, Attributes};
pub use error::{EncodeError, WriteError};
pub use format::OutputFormat;

/// Bytes collected per write to the operating system.
const BLOCK: usize = 1 << 16;

/// Writes a mesh, in the format of the suffix of `path`; a final `.gz` compresses.
///
/// # Accuracy
/// See [`OutputFormat`]: every bit of every coordinate is kept, except in the single-precision formats STL and GLB.
///
/// # Errors
/// [`WriteError`]. The file appears, or is replaced, only once all of it is written; after an error a file that existed before is
/// unchanged.
pub fn write(path: impl AsRef<Path>, mesh: &TriMesh) -> Result<(), WriteError> {
    write_with(path, mesh, &Attributes::for_mesh(mesh))
}

/// Writes a mesh with attributes, in the format of the suffix of `path`; a final `.gz` compresses.
///
/// # Errors
/// As [`write()`]; also if the format cannot store one of the attributes, see [`OutputFormat`].
///
/// # Example
/// ```no_run
/// # fn write_heights(mesh: &pompeiu_core::TriMesh) -> Result<(), Box<dyn std::error::Error>> {
/// let heights = mesh.positions().iter().map(|position| position[2]).collect();
/// let attributes = pompeiu_io::Attributes::for_mesh(mesh).with_vertex_scalar("height", heights)?;
/// pompeiu_io::write_with("heights.vtp", mesh, &attributes)?;
/// # Ok(())
/// # }
/// ```
pub fn write_with(path: impl AsRef<Path>, mesh: &TriMesh, attributes: &Attributes) -> Result<(), WriteError> {
    let path = path.as_ref();
    match OutputFormat::from_path(path) {
        Some(format) => write_as(path, format, mesh, attributes),
        None => Err(WriteError::UnknownFormat { path: path.to_owned() }),
    }
}

/// Writes a mesh with attributes in the given format, whatever the suffix of `path`, except that a final `.gz` compresses.
///
/// # Errors
/// As [`write_with`].
pub fn write_as(
    path: impl AsRef<Path>,
    format: OutputFormat,
    mesh: &TriMesh,
    attributes: &Attributes,
) -> Result<(), WriteError> {
    let path = path.as_ref();
    let compressed = format::is_gzip(path);
    let encoded = replace::replace_file(path, |out| {
        if compressed {
            let mut gzip = GzEncoder::new(out, Compression::default());
            encode(&mut gzip, format, mesh, attributes)?;
            gzip.finish()?;
            Ok(())
        } else {
            encode(out, format, mesh, attributes)
        }
    });
    encoded.map_err(|error| in_file(path, error))
}

fn in_file(path: &Path, error: EncodeError) -> WriteError {
    let path = path.to_owned();
    match error {
        EncodeError::Io(source) => WriteError::Io { path, source },
        source => WriteError::Encode { path, source },
    }
}

/// Writes a file of any kind, such as a picture or a page, atomically: it appears, or is replaced, only once all of it is written.
///
/// # Errors
/// [`WriteError::Io`]; a file that existed before is unchanged.
pub fn write_whole(path: impl AsRef<Path>, content: &[u8]) -> Result<(), WriteError> {
    let path = path.as_ref();
    replace::replace_file(path, |file| Ok(file.write_all(content)?))
        .map_err(|error: EncodeError| in_file(path, error))
}

/// Writes a file of any kind piece by piece, atomically: it appears, or is replaced, only once `fill` has succeeded. Writes of any size are
/// collected to blocks.
///
/// # Errors
/// Those of `fill`, and of the file as they become one of these; a file that existed before is unchanged.
pub fn write_stream<R, E: From<io::Error>>(
    path: impl AsRef<Path>,
    fill: impl FnOnce(&mut (dyn Write + Send)) -> Result<R, E>,
) -> Result<R, E> {
    replace::replace_file(path.as_ref(), |file| {
        let mut out = io::BufWriter::with_capacity(BLOCK, file);
        let filled = fill(&mut out)?;
        out.flush()?;
        Ok(filled)
    })
}

/// Encodes a mesh with attributes into any writer, uncompressed; flushes at the end.
///
/// Writes come in blocks, so `out` needs no buffer of its own.
///
/// # Errors
/// Errors of `out`; [`EncodeError`] before the first byte if the format cannot store the mesh or an attribute.
pub fn encode(
    out: impl Write,
    format: OutputFormat,
    mesh: &TriMesh,
    attributes: &Attributes,
) -> Result<(), EncodeError> {
    attributes.check_fits(mesh)?;
    check_holds(format, attributes)?;
    let mut out = io::BufWriter::with_capacity(BLOCK, out);
    match format {
        OutputFormat::Obj => obj::write(&mut out, mesh, attributes),
        OutputFormat::Ply => ply::write(&mut out, mesh, attributes),
        OutputFormat::Stl => stl::write(&mut out, mesh),
        OutputFormat::Off => off::write(&mut out, mesh, attributes),
        OutputFormat::Vtp => vtk_xml::write(&mut out, DataSet::PolyData, mesh, attributes),
        OutputFormat::Vtu => vtk_xml::write(&mut out, DataSet::UnstructuredGrid, mesh, attributes),
        OutputFormat::ThreeMf => three_mf::write(&mut out, mesh),
        OutputFormat::Glb => glb::write(&mut out, mesh, attributes),
    }?;
    Ok(out.flush()?)
}

/// Whether a format can store the attributes.
fn check_holds(format: OutputFormat, attributes: &Attributes) -> Result<(), EncodeError> {
    let no_room = |attribute| Err(EncodeError::Unsupported { format, attribute });
    if attributes.vertex_colors().is_some() && !format.holds_vertex_colors() {
        return no_room("vertex colours");
    }
    if attributes.face_colors().is_some() && !format.holds_face_colors() {
        return no_room("face colours");
    }
    if attributes.vertex_scalars().next().is_some() && !format.holds_scalars() {
        return no_room("vertex scalars");
    }
    if attributes.face_scalars().next().is_some() && !format.holds_scalars() {
        return no_room("face scalars");
    }
    if attributes.texture().len() > format.texture_sets() {
        return no_room(match format.texture_sets() {
            0 => "texture coordinates",
            _ => "further sets of texture coordinates",
        });
    }
    if attributes.image().is_some() && format != OutputFormat::Glb {
        return no_room("texture images");
    }
    if attributes.normals().is_some() && !format.holds_normals() {
        return no_room("normals");
    }
    if attributes.linear_colors().is_some() && format != OutputFormat::Glb {
        return no_room("linear colours");
    }
    if attributes.materials().is_some() && !format.holds_materials() {
        return no_room("materials");
    }
    if attributes.materials().is_some_and(|materials| materials.descriptions.is_some())
        && format != OutputFormat::Glb
    {
        return no_room("descriptions of materials");
    }
    if attributes.face_vectors().next().is_some() && !format.holds_scalars() {
        return no_room("face vectors");
    }
    Ok(())
}
