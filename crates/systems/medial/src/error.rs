//! Errors of medial balls.

use pompeiu_core::VertexId;

/// Why medial balls cannot be computed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MedialError {
    /// A surface with a boundary has no interior.
    #[error(
        "the surface has {loops} boundary loops, one of them through vertex {vertex}; balls fill closed surfaces only"
    )]
    Open {
        /// Its boundary loops.
        loops: usize,
        /// A vertex of the first one.
        vertex: VertexId,
    },
    /// No ball touches the surface at two points.
    #[error("none of {samples} balls fits into the surface; its faces may be turned inside out in part")]
    NoBall {
        /// Balls that were tried.
        samples: usize,
    },
    /// The tolerance is not positive.
    #[error("the tolerance is {value}; it must be above zero")]
    Tolerance {
        /// The tolerance.
        value: f64,
    },
}
