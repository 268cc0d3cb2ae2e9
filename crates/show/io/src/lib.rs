//! Reading and writing triangle meshes.
//!
//! [`read`] reads a file into a validated [`TriMesh`](pompeiu_core::TriMesh):
//!
//! ```no_run
//! let bunny = pompeiu_io::read("bunny.ply.gz")?;
//! println!("{} faces, read as {}", bunny.mesh.faces().len(), bunny.format);
//! # Ok::<(), pompeiu_io::ReadError>(())
//! ```
//!
//! Formats are recognised by content; the suffix decides only where the content is ambiguous. Counts in headers are checked before
//! memory is allocated, and no input makes a reader panic: what cannot be read is a [`ReadError`] that names the file and the
//! place.

mod appearance;
mod error;
mod expansion;
mod face_vectors;
mod foreign;
mod format;
mod formats;
mod groups;
mod loops;
mod polygon;
mod raw;
mod read;
mod read_appearance;
mod read_solids;
mod sniff;
mod solids;
mod source;
mod text;
mod waves;
mod weld;
mod write;

pub use appearance::{Appearance, CornerValues, Descriptions, Materials};
pub use error::{FormatError, Location, ReadError};
pub use face_vectors::read_face_vectors;
pub use format::Format;
pub use groups::Group;
pub use loops::read_loops;
pub use read::{ReadMesh, read, read_bytes, read_bytes_of, read_mesh, read_mesh_or_points, referenced_files};
pub use read_appearance::read_appearance;
pub use read_solids::{SurfaceOrSolid, read_hexahedra, read_surface_or_solid, read_tetrahedra};
pub use solids::{Hexahedra, Solids, Tetrahedra};
pub use write::{
    AttributeError, Attributes, EncodeError, OutputFormat, WriteError, encode, write, write_as, write_stream,
    write_whole, write_with,
};
