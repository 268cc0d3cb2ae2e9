//! Repairing a mesh: a sequence of operations that remove what algorithms on surfaces cannot handle.
//!
//! | operation | what it does |
//! |---|---|
//! | round | to [`Coordinates`] that a file can hold, where that is asked for |
//! | drop unreferenced vertices | those that no face names |
//! | [`Weld`] | one vertex for positions that are equal, or within a length |
//! | drop degenerate faces | area zero, decided exactly |
//! | drop duplicate faces | the three vertices of an earlier face, in whatever order |
//! | split | a vertex for every fan of faces around it, so that edges have two faces at most |
//! | orient | faces that share an edge agree on its direction |
//! | fill holes | triangles for boundary loops with few edges, of least area |
//! | open | a cut along edges through each component with one side only, such as a Möbius strip |
//!
//! The result is an oriented manifold with boundary. Positions change only by rounding and by welding within a length. Faces that are kept keep their
//! order.

mod degenerate;
mod duplicate;
mod holes;
mod orient;
mod parts;
mod report;
mod split;
mod weld;

pub use report::{Change, RepairReport};

use super::{Coordinates, MeshError, Rounding, TriMesh};
use crate::geom::Aabb;
use parts::Parts;

/// Which vertices become one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Weld {
    /// None.
    Never,
    /// Those at equal positions.
    #[default]
    Equal,
    /// Merges each vertex into the nearest earlier vertex that was kept, if that is at most this length away. So a vertex moves by
    /// at most this length, and vertices that are kept are farther apart.
    Within(f64),
}

/// Optional operations of [`repair`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RepairOptions {
    /// Which vertices become one.
    pub weld: Weld,
    /// The largest number of edges of boundary loops to fill, at most [`RepairOptions::MOST_HOLE_EDGES`]; 0 fills none. The rim of
    /// an open sheet is a boundary loop like any other: it is filled too if it has few edges.
    pub fill_holes: usize,
    /// The coordinates of the file that the result is for: rounded first, so that the result is sound as it is written.
    pub coordinates: Coordinates,
}

impl RepairOptions {
    /// The largest number of edges of a hole that can be filled: the search for the least area takes cubic time.
    pub const MOST_HOLE_EDGES: usize = 256;

    /// Checks that the options are valid.
    ///
    /// # Errors
    /// [`RepairError::WeldLength`] unless positive and finite; [`RepairError::HoleEdges`].
    pub fn check(&self) -> Result<(), RepairError> {
        if let Weld::Within(length) = self.weld
            && !(length > 0.0 && length.is_finite())
        {
            return Err(RepairError::WeldLength(length));
        }
        if self.fill_holes > Self::MOST_HOLE_EDGES {
            return Err(RepairError::HoleEdges(self.fill_holes));
        }
        Ok(())
    }
}

/// Why a mesh cannot be repaired.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RepairError {
    /// The welding length is not a positive number.
    #[error("the length to weld within is {0}, expected a positive number")]
    WeldLength(f64),
    /// The welding length is below the rounding of the coordinates.
    #[error(
        "the length to weld within, {length:e}, is below the rounding of coordinates of up to {largest:e}; \
         weld equal positions only"
    )]
    WeldBelowRounding {
        /// The length.
        length: f64,
        /// The largest coordinate in magnitude.
        largest: f64,
    },
    /// Too many edges for the search for the least area.
    #[error("holes of up to {0} edges cannot be filled; at most {max} edges can", max = RepairOptions::MOST_HOLE_EDGES)]
    HoleEdges(usize),
    /// No face is left.
    #[error("nothing is left: every face (of {faces}) is degenerate{}", if *.welded > 0 { " once vertices are welded" } else { "" })]
    NothingLeft {
        /// Number of faces there were.
        faces: usize,
        /// Number of vertices that became one with others.
        welded: usize,
    },
    /// Splitting made more vertices than indices can name.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

/// A repaired mesh, and what was done.
#[derive(Clone, Debug, PartialEq)]
pub struct Repaired {
    /// The mesh.
    pub mesh: TriMesh,
    /// What was done.
    pub report: RepairReport,
    /// What rounding did before anything else.
    pub rounding: Rounding,
}

/// Repairs a mesh; the table of operations is in [the documentation of the module](self), in the order in which they are done.
///
/// # Accuracy
/// Degenerate faces and equal positions are found exactly. Distances for [`Weld::Within`] are rounded: two vertices whose distance
/// is within 1e-15 of the length, relatively, may be welded or not.
///
/// # Limits
/// Repairing twice changes nothing the second time, unless holes were filled beside vertices that were split. Intersecting faces
/// stay. Removing a degenerate face whose corners are three different points on a line leaves a slit without area. Splitting
/// separates all faces at an edge with more than two faces, because nothing says which of them belong together. The cut through a component
/// with one side only is not the shortest there is: it lies where neighbours disagree, or where a breadth-first search over the faces meets
/// itself, along whichever of the two has fewer edges.
///
/// # Errors
/// [`RepairError`], with the numbers.
///
/// # Cost
/// O(n log n), plus the cube of the number of edges of each hole.
///
/// # Example
/// ```
/// use pompeiu_core::mesh::repair::{RepairOptions, repair};
/// use pompeiu_core::mesh::{MeshSummary, shapes, unweld};
///
/// let loose = unweld(&shapes::cube(1.0, 1)?)?;
/// let repaired = repair(&loose, &RepairOptions::default())?;
/// assert_eq!(repaired.report.welded.count, 36 - 8);
/// assert_eq!(MeshSummary::of(&repaired.mesh).connectivity.boundary_edges, 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn repair(mesh: &TriMesh, options: &RepairOptions) -> Result<Repaired, RepairError> {
    options.check()?;
    let grid = options.coordinates.within(&Aabb::of_faces(mesh));
    let rounding = grid.rounding(mesh);
    let (positions, faces) =
        if grid.holds_all() { mesh.clone() } else { grid.round_mesh(mesh)? }.into_parts();
    let mut parts = Parts { positions, faces };
    let unreferenced = parts.drop_unreferenced();
    let welded = match options.weld {
        Weld::Never => Change::default(),
        Weld::Equal => weld::equal(&mut parts),
        Weld::Within(length) => weld::within(&mut parts, length)?,
    };
    let degenerate = degenerate::drop_faces(&mut parts);
    if parts.faces.is_empty() {
        return Err(RepairError::NothingLeft { faces: mesh.faces().len(), welded: welded.count });
    }
    let duplicate = duplicate::drop_faces(&mut parts);
    parts.drop_unreferenced();
    let (split_edges, split_vertices) = split::split(&mut parts);
    let (turned, one_sided) = orient::orient(&mut parts);
    let holes = holes::fill(&mut parts, options.fill_holes);
    let opened = if one_sided.count > 0 { split::open_one_sided(&mut parts) } else { Change::default() };
    let report = RepairReport {
        unreferenced_vertices: unreferenced,
        welded,
        degenerate_faces: degenerate,
        duplicate_faces: duplicate,
        split_edges,
        split_vertices,
        turned_faces: turned,
        non_orientable_components: one_sided,
        opened_edges: opened,
        filled_holes: holes.filled,
        holes_left: holes.left,
        faces_added: holes.faces_added,
    };
    Ok(Repaired { mesh: TriMesh::new(parts.positions, parts.faces)?, report, rounding })
}

#[cfg(test)]
mod tests;
