//! Surfaces that are their own mirror images: cuts and maps that keep the plane.

mod cut;
mod images;
mod places;

pub(crate) use cut::{SymmetricCut, first_cut};
pub(crate) use images::Images;
pub(crate) use places::{partners, symmetrized};

use pompeiu_core::{FaceId, VertexId};

/// A plane in which a surface is its own mirror image: all points p with normal · p = offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryPlane {
    /// A vector across the plane, of any length.
    pub normal: [f64; 3],
    /// What the product of a point of the plane with it is.
    pub offset: f64,
}

/// Why a cut or a map cannot keep a plane of symmetry.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SymmetryError {
    /// The numbers give no plane.
    #[error("the normal {normal:?} and the offset {offset} give no plane of symmetry")]
    Plane {
        /// The vector across it.
        normal: [f64; 3],
        /// The product with it.
        offset: f64,
    },
    /// A vertex has no mirror image among the vertices.
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
    /// The plane exchanges two parts.
    #[error(
        "the mirror image of the part that holds face {face} is another part; flatten such parts on their own"
    )]
    Parts {
        /// One of its faces.
        face: FaceId,
    },
    /// The cut has no mirror image, because edges of the part have none.
    #[error("the part that holds face {face} has no cut that is its own mirror image: edges of it have none")]
    NoCut {
        /// One of its faces.
        face: FaceId,
    },
    /// The strategy knows nothing of planes.
    #[error("the strategy {strategy} keeps no plane of symmetry; choose auto, genus, tips or through")]
    Strategy {
        /// Its name.
        strategy: &'static str,
    },
    /// A boundary whose corners need not be symmetric.
    #[error("a map onto a square or a polygon keeps no plane of symmetry; choose free, circle or own")]
    Boundary,
}
