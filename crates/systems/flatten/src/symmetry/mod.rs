//! Symmetric cuts and maps of surfaces with a plane of symmetry.

mod cut;
mod images;
mod places;
mod plane;

pub(crate) use cut::{SymmetricCut, first_cut};
pub(crate) use images::Images;
pub(crate) use places::{partners, symmetrized, symmetrized_about};
pub use plane::SymmetryPlane;

use pompeiu_core::{FaceId, VertexId};

/// Why a cut or a map cannot be symmetric.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SymmetryError {
    /// The numbers do not define a plane.
    #[error("the normal {normal:?} and the offset {offset} give no plane of symmetry")]
    Plane {
        /// The normal.
        normal: [f64; 3],
        /// The offset.
        offset: f64,
    },
    /// The mirror image of a vertex is no vertex.
    #[error(
        "the surface is not symmetric: the mirror image of vertex {vertex} is {distance:e} away from the nearest vertex, expected at \
         most {most:e}"
    )]
    NoImage {
        /// The vertex.
        vertex: VertexId,
        /// Distance of its mirror image from the nearest vertex, in the unit of the mesh.
        distance: f64,
        /// Greatest distance allowed.
        most: f64,
    },
    /// A face lies on both sides of the plane.
    #[error("face {face} lies across the plane of symmetry; edges must run along it")]
    Across {
        /// The face.
        face: FaceId,
    },
    /// The plane exchanges two components.
    #[error(
        "the mirror image of the part that holds face {face} is another part; flatten such parts on their own"
    )]
    Parts {
        /// One of its faces.
        face: FaceId,
    },
    /// There is no symmetric cut, because mirror images of edges are missing.
    #[error("the part that holds face {face} has no cut that is its own mirror image: edges of it have none")]
    NoCut {
        /// One of its faces.
        face: FaceId,
    },
    /// The strategy does not support planes of symmetry.
    #[error("the strategy {strategy} keeps no plane of symmetry; choose auto, genus, tips or through")]
    Strategy {
        /// Its name.
        strategy: &'static str,
    },
    /// The boundary curve has no axis of symmetry, or not one that fits the outline.
    #[error(
        "a map onto this polygon keeps no plane of symmetry, because it has no axis of symmetry; choose a polygon that has one, square, \
         circle, own or free"
    )]
    Boundary,
    /// Virtual boundaries do not support planes of symmetry where the curve has corners.
    #[error(
        "a virtual boundary around a square or a polygon keeps no plane of symmetry; leave out the virtual layers, or choose circle or free"
    )]
    Virtual,
    /// An edge between two vertices of a straight side has no mirror image.
    #[error(
        "the edge from vertex {} to vertex {} joins two vertices of one straight side and has no mirror image; flip it, or choose circle, \
         own or free",
        ends[0], ends[1]
    )]
    Chord {
        /// Its ends.
        ends: [VertexId; 2],
    },
}
