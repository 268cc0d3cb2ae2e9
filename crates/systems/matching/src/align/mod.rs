//! Aligning one mesh to another before they are compared.
//!
//! [`Alignment`] selects the allowed maps; [`Fixed`] is the mesh that others are aligned to, prepared once. The map is computed in
//! double precision and applied by [`transform`](pompeiu_core::mesh::transform). Distances computed afterwards, certified ones
//! included, are those of the mesh with moved and *rounded* vertices.

mod cholesky;
mod equations;
mod error;
mod fixed;
mod moments;
mod pose;
mod register;
mod registration;
mod samples;

pub use error::AlignError;
pub use fixed::{Fixed, Gain};
pub use register::{Alternative, FreeMotion, Registration, RegistrationOptions, TransformSettings, register};

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::Affine;
use serde::{Deserialize, Serialize};

/// A map of space as a matrix of four rows that acts on columns `(x, y, z, 1)`.
pub type Matrix = [[f64; 4]; 4];

/// The maps allowed for aligning one mesh to another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Alignment {
    /// Coordinates stay.
    #[default]
    None,
    /// A translation that makes the area centroids coincide.
    Centroid,
    /// That translation, and a scaling about the centroid that makes the root-mean-square distances from it equal.
    Scale,
    /// A rotation and a translation, found by iterated closest points from several starts: a local optimum.
    Rigid,
}

/// Finds the map that aligns `moving` to the fixed mesh; `None` for [`Alignment::None`].
///
/// # Definition
/// Centroids and radii are those of the surface, weighted by area. [`Alignment::Rigid`] minimises the mean squared distance from
/// the fixed surface of points distributed evenly over `moving`.
/// # Accuracy
/// Rounded, and deterministic at any number of threads. Nothing is proven about the map: a distance certified after the move holds
/// for the mesh as moved, not for the best possible pose.
/// # Limits
/// A rigid alignment is the best local optimum found from 26 starts, including those of the principal axes; the three most
/// promising ones are followed to convergence. If only a part of a mesh has a counterpart, the rest biases the result. Mirror
/// images are not matched. Distances are measured from `moving` only, so that a part laid anywhere on the whole counts as aligned.
/// # Errors
/// [`AlignError`] if a mesh has no area or the sizes of the two differ too much.
/// # Cost
/// O(m) for centroids and radii; some 50,000 to 200,000 closest-point queries for a rigid alignment.
/// # Source
/// `besl_method_1992` and, for point-to-plane distances, `chen_object_1992`; damped as in `marquardt_algorithm_1963`, with new
/// closest points for every trial, so that no step increases the error.
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
