//! Mesh files: told apart, read, and looked at for what deserves a warning.

use crate::interrupt::while_writing;
use crate::numbers::{counted, grouped, vertices_and_faces};
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::{Context, bail};
use pompeiu::core::TriMesh;
use pompeiu::core::mesh::{Precision, Rounding};
use pompeiu::core::request::hexadecimal;
use pompeiu::io::{Attributes, OutputFormat, ReadMesh, WriteError};
use sha2::{Digest, Sha256};
use std::fs::{File, Metadata};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Refuses, before anything is read, what cannot be a mesh file.
pub(crate) fn check_readable(path: &Path) -> anyhow::Result<()> {
    let metadata = check_file(path, "a mesh file")?;
    if metadata.is_file() && metadata.len() == 0 {
        bail!("{}: the file is empty; give a file with a mesh in it", path.display())
    }
    Ok(())
}

/// Refuses, before anything is read, what cannot be a file of this kind, empty or not.
pub(crate) fn check_file(path: &Path, kind: &str) -> anyhow::Result<Metadata> {
    let shown = path.display();
    match path.metadata() {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            bail!("{shown}: there is no such file; check the name and the folder")
        }
        Err(error) => Err(error).with_context(|| shown.to_string()),
        Ok(metadata) if metadata.is_dir() => bail!("{shown}: is a folder; name {kind} in it"),
        Ok(metadata) => Ok(metadata),
    }
}

/// Whether both paths lead to one existing file.
pub(crate) fn are_same(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

/// Reads a mesh.
pub(crate) fn read(path: &Path) -> anyhow::Result<ReadMesh> {
    check_readable(path)?;
    Ok(pompeiu::io::read(path)?)
}

/// Reads a mesh, or points without faces.
pub(crate) fn read_or_points(path: &Path) -> anyhow::Result<ReadMesh> {
    check_readable(path)?;
    Ok(pompeiu::io::read_mesh_or_points(path)?)
}

/// Reads a mesh while somebody waits, and warns of what its file has that a mesh has not.
pub(crate) fn read_shown(path: &Path, wait: &Wait, printer: &Printer) -> anyhow::Result<TriMesh> {
    wait.show(format!("reading {}", path.display()));
    let read = read(path)?;
    wait.suspend(|| warn_of_changes(path, &read, printer));
    Ok(read.mesh)
}

/// Refuses, before any work is done, what cannot become a file, or would replace one that is read.
pub(crate) fn check_place(path: &Path, inputs: &[&Path]) -> anyhow::Result<()> {
    if path.is_dir() {
        bail!("{}: is a folder; name a file in it", path.display());
    }
    if let Some(folder) = path.parent().filter(|f| !f.as_os_str().is_empty() && !f.is_dir()) {
        bail!("{}: there is no folder {}; make it first", path.display(), folder.display());
    }
    if inputs.iter().any(|input| are_same(path, input)) {
        bail!("{}: is both input and output; give the output another name", path.display());
    }
    Ok(())
}

/// The same for several outputs, of which no two may be one file.
pub(crate) fn check_places<'p>(
    outputs: impl IntoIterator<Item = &'p Path>,
    inputs: &[&Path],
) -> anyhow::Result<()> {
    let mut places: Vec<PathBuf> = Vec::new();
    for path in outputs {
        check_place(path, inputs)?;
        let place = place(path);
        if places.contains(&place) {
            bail!("{}: is named for two outputs; give one of them another name", path.display());
        }
        places.push(place);
    }
    Ok(())
}

/// Where a file is, or would be, whatever the name.
fn place(path: &Path) -> PathBuf {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new(".")).canonicalize();
    match (path.canonicalize(), folder, path.file_name()) {
        (Ok(place), ..) => place,
        (_, Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_owned(),
    }
}

/// Refuses, before any work is done, what cannot become a mesh file.
pub(crate) fn check_writable(path: &Path) -> anyhow::Result<()> {
    check_place(path, &[])?;
    match OutputFormat::from_path(path) {
        Some(_) => Ok(()),
        None => Err(WriteError::UnknownFormat { path: path.to_owned() }.into()),
    }
}

/// Writes a mesh in the format that the suffix names, and says so.
pub(crate) fn write(path: &Path, mesh: &TriMesh, printer: &Printer) -> anyhow::Result<()> {
    write_with(path, mesh, &Attributes::for_mesh(mesh), printer)
}

/// The same with attributes.
pub(crate) fn write_with(
    path: &Path,
    mesh: &TriMesh,
    attributes: &Attributes,
    printer: &Printer,
) -> anyhow::Result<()> {
    check_writable(path)?;
    while_writing(|| pompeiu::io::write_with(path, mesh, attributes))?;
    let shown = path.display();
    let is_rounded = |x: &f64| f64::from(*x as f32) != *x;
    if let Some(format) = OutputFormat::from_path(path)
        && format.precision() == Precision::Single
        && mesh.positions().iter().flatten().any(is_rounded)
    {
        printer.warning(format_args!(
            "{shown}: {} holds single precision, so coordinates were rounded; PLY and OBJ keep every bit",
            format.name()
        ));
    }
    warn_of(
        path,
        joined(path, mesh) as u64,
        printer,
        [
            "vertex lies where another one does; readers of STL make one vertex of them, and PLY and OBJ keep them apart",
            "vertices lie where others do; readers of STL make one vertex of those at a place, and PLY and OBJ keep them apart",
        ],
    );
    let size = vertices_and_faces(mesh.positions().len(), mesh.faces().len());
    printer.note(format_args!("{shown}: {size}"));
    Ok(())
}

/// How many vertices of a mesh lie at the position of an earlier one, if that joins them for whoever reads the file: STL stores corners of
/// faces without saying which are one vertex. Zero for other formats.
pub(crate) fn joined(path: &Path, mesh: &TriMesh) -> usize {
    if OutputFormat::from_path(path) != Some(OutputFormat::Stl) {
        return 0;
    }
    // As stored; adding zero makes one of both zeros.
    let mut places: Vec<[u32; 3]> =
        mesh.positions().iter().map(|p| p.map(|x| (x as f32 + 0.0).to_bits())).collect();
    places.sort_unstable();
    places.dedup();
    mesh.positions().len() - places.len()
}

/// Refuses to write to STL what its readers would join again.
pub(crate) fn refuse_joined(path: &Path, mesh: &TriMesh) -> anyhow::Result<()> {
    match joined(path, mesh) {
        0 => Ok(()),
        count => bail!(
            "{}: STL holds no shared vertices, so its readers would join {} with others at the same position, and undo the result; write PLY \
             or OBJ",
            path.display(),
            counted(count, "vertex")
        ),
    }
}

/// Writes a mesh whose coordinates were rounded to those of the format, moved by the shift that goes with them.
pub(crate) fn write_shifted(
    path: &Path,
    mesh: &TriMesh,
    attributes: &Attributes,
    rounding: &Rounding,
    printer: &Printer,
) -> anyhow::Result<()> {
    write_with(path, &rounding.written(mesh)?, attributes, printer)
}

/// Writes a file, whole or not at all, and says so.
pub(crate) fn write_whole(path: &Path, content: &[u8], printer: &Printer) -> anyhow::Result<()> {
    while_writing(|| pompeiu::io::write_whole(path, content))?;
    note_size(path, content.len() as u64, printer);
    Ok(())
}

/// Says how large a file is that was written.
pub(crate) fn note_size(path: &Path, bytes: u64, printer: &Printer) {
    printer.note(format_args!("{}: {}", path.display(), bytesize::ByteSize(bytes)));
}

/// The SHA-256 sum of a file in hexadecimal digits; not of a pipe, which can be read only once.
pub(crate) fn sha256(path: &Path) -> std::io::Result<String> {
    if !path.metadata()?.is_file() {
        return Err(ErrorKind::InvalidInput.into());
    }
    let mut hasher = Sha256::new();
    std::io::copy(&mut File::open(path)?, &mut hasher)?;
    Ok(hexadecimal(&hasher.finalize()))
}

/// Warns of what was changed between the file and the mesh.
pub(crate) fn warn_of_changes(path: &Path, read: &ReadMesh, printer: &Printer) {
    warn_of(
        path,
        read.polygons_triangulated,
        printer,
        [
            "face with more than three corners was cut into triangles",
            "faces with more than three corners were cut into triangles",
        ],
    );
    warn_of(
        path,
        read.faces_dropped,
        printer,
        [
            "face with fewer than three corners was left out",
            "faces with fewer than three corners were left out",
        ],
    );
}

/// Warns of vertices that are left out.
pub(crate) fn warn_of_unreferenced(path: &Path, count: usize, printer: &Printer) {
    warn_of(
        path,
        count as u64,
        printer,
        [
            "vertex belongs to no face and is left out; the others are numbered anew, in their order",
            "vertices belong to no face and are left out; the others are numbered anew, in their order",
        ],
    );
}

fn warn_of(path: &Path, count: u64, printer: &Printer, [one, many]: [&str; 2]) {
    let shown = path.display();
    match count {
        0 => (),
        1 => printer.warning(format_args!("{shown}: 1 {one}")),
        n => printer.warning(format_args!("{shown}: {} {many}", grouped(n))),
    }
}
