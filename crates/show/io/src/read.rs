//! Entry points: a path or bytes in, a validated mesh out.

use crate::error::{FormatError, Location, ReadError};
use crate::format::Format;
use crate::formats::{self, Input};
use crate::groups::Group;
use crate::polygon::{self, Polygon};
use crate::raw::RawMesh;
use crate::{foreign, sniff, source};
use pompeiu_core::{MeshError, TriMesh};
use std::path::{Path, PathBuf};

/// A mesh read from a file, with remarks.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ReadMesh {
    /// The mesh.
    pub mesh: TriMesh,
    /// The format it was read as.
    pub format: Format,
    /// Whether the file was gzip data.
    pub compressed: bool,
    /// Faces of the file with more than three corners, which were triangulated.
    pub polygons_triangulated: u64,
    /// Faces of the file with fewer than three corners, which were omitted.
    pub faces_dropped: u64,
    /// Named groups: groups and objects of OBJ, nodes of glTF, items of 3MF.
    pub groups: Vec<Group>,
    /// Whether the file has points and no faces: each face of the mesh is one of the points, with it as all three corners
    /// ([`read_mesh_or_points`]).
    pub is_cloud: bool,
}

/// Reads a triangle mesh from a file.
///
/// The format is recognised by the content; the suffix decides only where the content is ambiguous. Files may be compressed with
/// gzip. Coordinates in double precision or in text become the nearest doubles. Faces with more than three corners, concave ones
/// too, are triangulated between their own corners. Only STL has no shared vertices: there equal positions become one vertex, in
/// the order of their first use.
///
/// # Errors
/// [`ReadError::Io`] when the file cannot be opened or read, [`ReadError::Format`] when it does not hold a mesh: each
/// displays as one line that names the file, the line, byte, face or vertex, what was found and what was expected.
///
/// # Cost
/// O(bytes). OBJ, binary PLY and binary STL files are mapped into memory and parsed in parallel on the current rayon thread pool;
/// the result is the same for any number of threads. Memory holds only the mesh, buffers of a few MiB per thread, and the
/// decompressed content of a gzip file.
///
/// # Limits
/// Normals, texture coordinates, colours and materials are not read. Faces that touch or cross themselves may have at most 16 384
/// corners. Content that is compressed, or shared by pieces or nodes, may grow to 64 MiB (instances in glTF: 256 MiB), to 256 times
/// the size of the file as long as that is at most 1 GiB, or to 32 times its size, whichever is more. An element of XML has at most
/// 256 attributes, a document at most 64 namespaces. No other process may shorten a file while it is read.
pub fn read(path: impl AsRef<Path>) -> Result<ReadMesh, ReadError> {
    read_path(path.as_ref(), Points::Refused)
}

/// [`read`], also of files with points and no faces: PLY, XYZ and others. Each point becomes a face without extent, so that every distance
/// from the points to a surface is that of the mesh ([`ReadMesh::is_cloud`]).
///
/// XYZ, ASC and PTS are text: three coordinates at the beginning of each line.
///
/// # Errors
/// Those of [`read`].
pub fn read_mesh_or_points(path: impl AsRef<Path>) -> Result<ReadMesh, ReadError> {
    read_path(path.as_ref(), Points::Taken)
}

/// What becomes of a file without faces.
#[derive(Clone, Copy, PartialEq)]
enum Points {
    Refused,
    Taken,
}

fn read_path(path: &Path, points: Points) -> Result<ReadMesh, ReadError> {
    let bytes = source::open(path).map_err(|cause| ReadError::Io { path: path.to_owned(), cause })?;
    let promised = Format::from_path(path);
    let format = |content: &[u8]| sniff::format(content).or(promised);
    read_content(&bytes, path.parent(), points, format)
        .map_err(|cause| ReadError::Format { path: path.to_owned(), cause })
}

/// [`read`] without the remarks.
///
/// # Errors
/// Those of [`read`].
pub fn read_mesh(path: impl AsRef<Path>) -> Result<TriMesh, ReadError> {
    read(path).map(|read| read.mesh)
}

/// The other files that hold geometry of a file: the buffers beside a glTF file. Empty if the file cannot be read.
///
/// # Cost
/// Opens the file and, if it is glTF, parses its document.
pub fn referenced_files(path: impl AsRef<Path>) -> Vec<PathBuf> {
    let path = path.as_ref();
    let Ok(bytes) = source::open(path) else { return Vec::new() };
    let Ok((content, _)) = source::decompressed(&bytes) else { return Vec::new() };
    match sniff::format(&content).or(Format::from_path(path)) {
        Some(format) => {
            let input = Input { bytes: &content, folder: path.parent(), stored_bytes: bytes.len() as u64 };
            formats::referenced_files(format, input)
        }
        None => Vec::new(),
    }
}

/// Reads a triangle mesh from bytes in memory, compressed or not.
///
/// Like [`read`]; if a `format` is given, the bytes are read as that format. References to other files are errors here.
///
/// # Errors
/// If the bytes do not hold a mesh.
pub fn read_bytes(bytes: &[u8], format: Option<Format>) -> Result<ReadMesh, FormatError> {
    read_content(bytes, None, Points::Refused, |content| format.or_else(|| sniff::format(content)))
}

/// Reads a triangle mesh from the bytes of a file that is not at hand, compressed or not.
///
/// Like [`read`]: the suffix of the name decides where the content is ambiguous. References to other files are errors here.
///
/// # Errors
/// If the bytes do not hold a mesh.
pub fn read_bytes_of(name: impl AsRef<Path>, bytes: &[u8]) -> Result<ReadMesh, FormatError> {
    let promised = Format::from_path(name);
    read_content(bytes, None, Points::Refused, |content| sniff::format(content).or(promised))
}

fn read_content(
    bytes: &[u8],
    folder: Option<&Path>,
    points: Points,
    choose: impl FnOnce(&[u8]) -> Option<Format>,
) -> Result<ReadMesh, FormatError> {
    let (content, compressed) = source::decompressed(bytes)?;
    if content.is_empty() {
        return Err(FormatError::new(Location::File, "the file is empty, expected a mesh"));
    }
    if let Some(advice) = foreign::advice(&content) {
        return Err(FormatError::new(Location::File, advice));
    }
    let format = choose(&content).ok_or_else(|| unrecognised(&content))?;
    let raw = formats::read(format, Input { bytes: &content, folder, stored_bytes: bytes.len() as u64 })?;
    drop(content);
    finish(raw, points, (format, compressed))
}

/// Triangulates and validates the output of a format reader.
fn finish(
    mut raw: RawMesh,
    points: Points,
    (format, compressed): (Format, bool),
) -> Result<ReadMesh, FormatError> {
    // Places of polygons are 32-bit indices, which are invalid for more faces.
    if u32::try_from(raw.faces.len()).is_ok() {
        polygon::triangulate(&raw.positions, &mut raw.faces, &raw.polygons)
            .map_err(|polygon| too_many_corners(polygon, &raw.polygons))?;
    }
    let polygons_triangulated = raw.polygons.len() as u64;
    drop(raw.polygons);
    let is_cloud = points == Points::Taken && raw.faces.is_empty() && !raw.positions.is_empty();
    // More points than indices are an error of validation.
    if is_cloud && let Ok(count) = u32::try_from(raw.positions.len()) {
        raw.faces = (0..count).map(|v| [v; 3]).collect();
        raw.faces_dropped = 0;
    }
    let (faces_dropped, groups) = (raw.faces_dropped, raw.groups);
    let mesh = TriMesh::new(raw.positions, raw.faces).map_err(|error| invalid(&error, faces_dropped))?;
    Ok(ReadMesh { mesh, format, compressed, polygons_triangulated, faces_dropped, groups, is_cloud })
}

#[cold]
fn unrecognised(content: &[u8]) -> FormatError {
    let start = content[..content.len().min(16)].escape_ascii();
    FormatError::new(
        Location::File,
        format!("begins with \"{start}\", expected OBJ, PLY, STL, OFF, glTF, GLB, VTK, VTP, VTU or 3MF"),
    )
}

#[cold]
fn too_many_corners(polygon: Polygon, polygons: &[Polygon]) -> FormatError {
    let triangles_more: u64 =
        polygons.iter().take_while(|p| p.first < polygon.first).map(|p| u64::from(p.corners) - 3).sum();
    FormatError::new(
        Location::Face(u64::from(polygon.first) - triangles_more),
        format!(
            "found a face with {} corners that touches or crosses itself, expected at most {}",
            polygon.corners,
            polygon::MOST_CORNERS_TO_CLIP
        ),
    )
}

/// The error for elements that only validation rejects; their only place in the file is their index.
#[cold]
fn invalid(error: &MeshError, faces_dropped: u64) -> FormatError {
    match error {
        MeshError::NoFaces { vertices } => {
            let dropped = match faces_dropped {
                0 => String::new(),
                n => format!(" and {n} faces with fewer than three corners"),
            };
            let advice = match (faces_dropped, *vertices) {
                (0, 0) => "; check that it is the file you mean and that its name ends in its format",
                (0, _) => "; `pompeiu distance` measures clouds of points",
                _ => "",
            };
            let problem = format!("found {vertices} vertices{dropped}, expected at least one face{advice}");
            FormatError::new(Location::File, problem)
        }
        MeshError::NonFinite { vertex, .. } | MeshError::TooLarge { vertex, .. } => {
            FormatError::new(Location::Vertex(u64::from(vertex.0)), error.to_string())
        }
        MeshError::IndexOutOfRange { face, .. } => {
            FormatError::new(Location::Face(u64::from(face.0)), error.to_string())
        }
        _ => FormatError::new(Location::File, error.to_string()),
    }
}
