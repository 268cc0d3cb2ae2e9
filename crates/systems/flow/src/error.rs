//! Why a flow cannot start or go on.

use super::scheme::Scheme;
use pompeiu_core::MeshError;
use pompeiu_core::request::LengthError;
use pompeiu_remesh::{ConnectivityError, Intersects, RemeshError};
use pompeiu_solve::SolveError;

/// Why a surface cannot flow.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlowError {
    /// The faces are no oriented manifold.
    #[error(transparent)]
    Connectivity(#[from] ConnectivityError),
    /// A length cannot be converted to the unit of the coordinates.
    #[error(transparent)]
    Unit(#[from] LengthError),
    /// A face has no area.
    #[error(
        "face {face} has no area, so it has no normal; `pompeiu repair` removes such faces ({count} in all)"
    )]
    NoArea {
        /// The first such face.
        face: u32,
        /// How many there are.
        count: usize,
    },
    /// A number must be greater than zero.
    #[error("the {what} is {value}; it must be greater than 0")]
    NotPositive {
        /// Its kind.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// The steps of the scheme have no length in time.
    #[error("the scheme {} has no time: choose explicit, fixed-laplacian, implicit or conformalized", scheme.name())]
    NoTime {
        /// The scheme.
        scheme: Scheme,
    },
    /// The scheme uses the first surface all the time.
    #[error("the scheme {} uses the faces of the first surface, so it cannot be remeshed; choose implicit", scheme.name())]
    KeepsFirstMetric {
        /// The scheme.
        scheme: Scheme,
    },
    /// Only the implicit scheme keeps the volume.
    #[error("the scheme {} does not keep the volume; choose implicit", scheme.name())]
    VolumeNotKept {
        /// The scheme.
        scheme: Scheme,
    },
    /// The volume over a boundary that slides is not defined.
    #[error("the volume cannot be kept while the boundary slides in planes; fix the boundary")]
    VolumeWithPlanes,
    /// The normal of the planes of the boundary is no direction.
    #[error("the normal of the planes of the boundary is {normal:?}; it must be finite and not zero")]
    PlaneNormal {
        /// The normal.
        normal: [f64; 3],
    },
    /// Nothing can move.
    #[error("every vertex lies on the fixed boundary, so nothing can move; subdivide the mesh")]
    NothingMoves,
    /// No closed surface is minimal.
    #[error(
        "the component with vertex {vertex} has no boundary, so it shrinks until it vanishes: no closed surface is minimal; flow until a \
         time or for some steps, or keep the volume"
    )]
    NeverStationary {
        /// A vertex of the first such component.
        vertex: u32,
    },
    /// Keeping the volume: there is none.
    #[error("the surface encloses the volume {volume}, too little to be kept")]
    NoVolume {
        /// The volume.
        volume: f64,
    },
    /// A linear system failed.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The result is no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The surface could not be remeshed.
    #[error(transparent)]
    Remesh(#[from] RemeshError),
    /// Faces of the result intersect.
    #[error(transparent)]
    Intersects(#[from] Intersects),
}
