//! Why a simulation cannot start or go on.

use pompeiu_core::mesh::{FaceId, MeshError};
use pompeiu_core::spatial::IntersectingPair;
use pompeiu_solve::SolveError;

/// Why bodies cannot be simulated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ContactError {
    /// A number makes no sense.
    #[error("the {what} is {value}; it must be finite and {expected}")]
    Parameter {
        /// Its kind.
        what: &'static str,
        /// Its value.
        value: f64,
        /// What it should be.
        expected: &'static str,
    },
    /// An index is too large.
    #[error("{what} {index} has the vertex {vertex}, but there are {count} vertices")]
    NoVertex {
        /// `"face"`, `"tetrahedron"` or `"handle"`.
        what: &'static str,
        /// Its index.
        index: usize,
        /// The vertex.
        vertex: usize,
        /// How many there are.
        count: usize,
    },
    /// A position is NaN or infinite.
    #[error("vertex {index} is not at a finite position")]
    NonFinite {
        /// The vertex.
        index: usize,
    },
    /// An element has no area or volume, or is turned inside out.
    #[error("{what} {index} has the {measure} {value:e} at rest, expected more than 0")]
    Degenerate {
        /// `"face"` or `"tetrahedron"`.
        what: &'static str,
        /// Its index.
        index: usize,
        /// `"area"` or `"volume"`.
        measure: &'static str,
        /// Its value.
        value: f64,
    },
    /// Nothing can move.
    #[error("no vertex can move: there are only obstacles")]
    NothingMoves,
    /// Surfaces intersect at the start.
    #[error(
        "the start intersects: faces {} and {} near ({:.6}, {:.6}, {:.6}){}; move the bodies apart", .pairs[0].faces[0].0, .pairs[0].faces[1].0,
        .pairs[0].place[0], .pairs[0].place[1], .pairs[0].place[2], others(.pairs)
    )]
    StartIntersects {
        /// The pairs of faces, the first hundred.
        pairs: Vec<IntersectingPair>,
    },
    /// Surfaces touch at the start, or an obstacle has no distance from a vertex.
    #[error(
        "the start touches: the least distance is 0, and barriers need one above 0; move the bodies apart"
    )]
    StartTouches,
    /// Surfaces start so close that forces between them exceed double precision.
    #[error(
        "surfaces start {gap:.3e} apart; forces at less than {least:.3e}, 2^-24 of the distance of contact, are too stiff for \
         double precision: move the bodies apart, or shorten the distance of contact"
    )]
    StartTooClose {
        /// The least distance.
        gap: f64,
        /// The least that is accepted.
        least: f64,
    },
    /// A vertex is inside of an analytic obstacle.
    #[error("vertex {vertex} starts {depth:e} inside of obstacle {obstacle}; move it out")]
    StartInside {
        /// The vertex.
        vertex: usize,
        /// The obstacle.
        obstacle: usize,
        /// How deep it is.
        depth: f64,
    },
    /// The exact test found an intersection in a step that was accepted: a defect of this program.
    #[error("step {step}: the exact test finds faces {} and {} intersecting; please report this", .pair.faces[0].0, .pair.faces[1].0)]
    Intersects {
        /// Number of the step, from 1.
        step: usize,
        /// The pair.
        pair: IntersectingPair,
    },
    /// Two obstacles that move, or one and a fixed one, run into each other.
    #[error(
        "step {step}: faces {} and {} of obstacles run into each other near ({:.6}, {:.6}, {:.6}); change their motion, or end before",
        .pair.faces[0].0, .pair.faces[1].0, .pair.place[0], .pair.place[1], .pair.place[2]
    )]
    ObstaclesMeet {
        /// Number of the step, from 1.
        step: usize,
        /// The pair.
        pair: IntersectingPair,
    },
    /// Newton's method does not come closer.
    #[error(
        "step {step}: Newton's method stopped after {iterations} iterations while vertices still move at {speed:e}, asked for {tolerance:e}; \
         choose a shorter step or a greater tolerance"
    )]
    NotConverged {
        /// Number of the step, from 1.
        step: usize,
        /// Iterations.
        iterations: usize,
        /// The greatest speed of the last one.
        speed: f64,
        /// The speed asked for.
        tolerance: f64,
    },
    /// The surfaces make no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A linear system failed.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

fn others(pairs: &[IntersectingPair]) -> String {
    let named: Vec<String> = pairs
        .iter()
        .skip(1)
        .take(4)
        .map(|pair| {
            let [a, b]: [FaceId; 2] = pair.faces;
            format!("{} and {}", a.0, b.0)
        })
        .collect();
    match pairs.len() {
        1 => String::new(),
        n => format!(", and {} more pairs ({}{})", n - 1, named.join(", "), if n > 5 { ", …" } else { "" }),
    }
}
