//! Moving one mesh onto another before they are compared.
//!
//! [`Alignment`] says which maps are allowed; [`Fixed`] is the mesh that others are moved onto, prepared once. The map comes
//! out in double precision and is applied by [`transform`](pompeiu_core::mesh::transform): what is measured afterwards is
//! the mesh with its moved vertices *as rounded*, and a certified distance is certified for that mesh.

mod cholesky;
mod eigen;
mod equations;
mod error;
mod fixed;
mod moments;
mod pose;
mod register;
mod registration;
mod samples;

pub use error::AlignError;
pub use fixed::Fixed;
pub use register::{Alternative, FreeMotion, Registration, RegistrationOptions, TransformSettings, register};

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::Affine;
use serde::{Deserialize, Serialize};

/// A map of space as a matrix of four rows that acts on columns `(x, y, z, 1)`.
pub type Matrix = [[f64; 4]; 4];

/// Which maps may bring one mesh onto another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Alignment {
    /// None: coordinates are taken as they are.
    #[default]
    None,
    /// A translation that brings the area centroids together.
    Centroid,
    /// That, and a scale about the centroid that makes the root-mean-square distances from it equal.
    Scale,
    /// A rotation and a translation, found by iterated closest points from several starts: a local optimum.
    Rigid,
}

/// Finds the map that brings `moving` onto the fixed mesh; none for [`Alignment::None`], which moves nothing.
///
/// # Definition
/// Centroids and radii are those of the surface, weighted by area. [`Alignment::Rigid`] minimises the mean squared distance
/// of points spread evenly over `moving` from the fixed surface.
/// # Accuracy
/// Rounded, and deterministic at any number of threads. Nothing is claimed about it: a distance that is certified after
/// the move holds for the mesh as moved, not for the best possible place.
/// # Limits
/// A rigid alignment is the best local optimum that was found: from 26 starts, those of the principal axes among them, of
/// which the three most promising are followed to the end. A mesh of which only a part matches has its other part pull
/// it away. The mirror image of a shape is another shape. Distances are counted from `moving` alone, so that a part laid
/// anywhere on the whole is aligned.
/// # Errors
/// [`AlignError`], when a mesh has no area or the sizes of the two are too far apart.
/// # Cost
/// O(m) for centroids and radii; some 50,000 to 200,000 closest-point questions for a rigid alignment.
/// # Source
/// `besl_method_1992` and, for distances from the planes of faces, `chen_object_1992`; damped as in
/// `marquardt_algorithm_1963`, with closest points sought anew for every trial, so that no step makes it worse.
pub fn align(moving: &TriMesh, fixed: &Fixed, alignment: Alignment) -> Result<Option<Affine>, AlignError> {
    match alignment {
        Alignment::None => Ok(None),
        Alignment::Centroid => fixed.centroid_map(moving).map(Some),
        Alignment::Scale => fixed.scale_map(moving).map(Some),
        Alignment::Rigid => fixed.rigid_map(moving).map(Some),
    }
}

/// The map as a matrix.
pub fn matrix(map: &Affine) -> Matrix {
    let row = |i: usize| {
        let [a, b, c] = map.linear[i];
        [a, b, c, map.translation[i]]
    };
    [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]]
}

/// The map of a matrix whose last row is `(0, 0, 0, 1)`.
pub fn affine(matrix: &Matrix) -> Affine {
    let row = |i: usize| [matrix[i][0], matrix[i][1], matrix[i][2]];
    Affine { linear: [row(0), row(1), row(2)], translation: [matrix[0][3], matrix[1][3], matrix[2][3]] }
}
