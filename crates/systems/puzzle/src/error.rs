//! Why a puzzle cannot be made.

/// Why a puzzle cannot be made as asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PuzzleError {
    /// A number of pieces that is none.
    #[error("{found} pieces are asked for; there must be at least 2 and at most {most}")]
    Pieces {
        /// Pieces asked for.
        found: usize,
        /// The most there can be.
        most: usize,
    },
    /// A size that is none.
    #[error("the {what} is {value}; {expected}")]
    Option {
        /// What it is.
        what: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// Cells so narrow that the lattice cannot tell their corners apart.
    #[error(
        "the cells are too narrow for the lattice of corners: piece {piece} has no area; ask for fewer pieces"
    )]
    Narrow {
        /// The piece.
        piece: usize,
    },
}
