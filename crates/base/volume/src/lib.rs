//! Hexahedral meshes: certificates that no cell is folded, conformity, boundaries, and files.
//!
//! A cell is the image of the unit cube under the trilinear map that takes its corners to eight vertices, in the order of VTK: four
//! around the bottom, counter-clockwise seen from above, and the four above them.
//!
//! | item | what it is |
//! |---|---|
//! | [`HexMesh`] | vertices and cells |
//! | [`certify`], [`Jacobian`] | whether the Jacobian determinant is positive over a whole cell, proven by its Bernstein coefficients |
//! | [`scaled_jacobian`] | shape quality of a cell at points: 1 for a box |
//! | [`scaled_jacobian_bound`] | a proven lower bound on it over the whole cell |
//! | [`Faces`] | conformity, boundary, components |
//! | [`BezierMesh`], [`certify_bezier`] | tricubic cells, and the same certificate for them |
//! | [`SplineSpace`] | cubic splines on patches, continuous across them |
//! | [`HierarchicalSplines`] | truncated hierarchical splines, refined where elements are marked |
//! | [`UnstructuredSplines`], [`read_bzpt`], [`controlmesh`] | splines with one function per vertex, and the files of
//! `NeuronTransportIGA` |
//! | [`ExtractionFiles`] | these files, written cell by cell |
//! | [`partition`], [`epart`] | partitions of the cells for parallel processes, and their METIS files |
//! | [`Refinement`] | regular refinement of cells that stays conforming |
//! | [`write_vtu`], [`write_bezier_vtu`], [`CellData`] | VTK unstructured grids |
//!
//! ```
//! use pompeiu_volume::{Faces, HexMesh, Jacobian, certify};
//!
//! let mesh = HexMesh::grid([2, 1, 1], [2.0, 1.0, 1.0]);
//! assert!(mesh.cells().iter().all(|&cell| certify(&mesh.corners(cell)) == Jacobian::Positive));
//! let faces = Faces::new(&mesh)?;
//! assert_eq!((faces.inner().len(), faces.boundary().len(), faces.components()), (1, 10, 1));
//! # Ok::<(), pompeiu_volume::VolumeError>(())
//! ```

pub mod bernstein;
mod bezier;
mod bezier_jacobian;
mod error;
mod extraction_files;
mod faces;
mod hierarchy;
mod iga_files;
mod jacobian;
mod knots;
mod mesh;
mod parameter_box;
mod partition;
mod refinement;
mod scaled_bound;
mod spline;
mod text_rows;
mod unstructured;
mod vtu;

pub use bezier::{BezierMesh, CORNERS_OF_64, FACE_AXES, bezier_volume, face_flux, face_points, place_of_64};
pub use bezier_jacobian::{QUALITY_PLACES, certify_bezier, scaled_jacobian_bezier, slopes_at};
pub use error::VolumeError;
pub use extraction_files::ExtractionFiles;
pub use faces::{BoundaryFace, FACES, Faces, InnerFace};
pub use hierarchy::{BYTES_PER_FUNCTION, HierarchicalElement, HierarchicalSplines, MOST_LEVELS};
pub use iga_files::{IgaFileError, controlmesh, iga_units, read_bzmeshinfo, read_bzpt};
pub use jacobian::{Jacobian, certify, scaled_jacobian, volume};
pub use knots::Line;
pub use mesh::HexMesh;
pub use partition::{PartitionQuality, epart, partition, partition_quality};
pub use refinement::{CORNER_PLACES, Refinement, RefinementKey, key_weights};
pub use scaled_bound::{SCALED_JACOBIAN_GAP, scaled_jacobian_bound, scaled_jacobian_bound_bezier};
pub use spline::SplineSpace;
pub use unstructured::{CellKind, CellSplines, UnstructuredSplines};
pub use vtu::{CellData, PointData, write_bezier_vtu, write_vtu};
