//! Errors of making puzzles.

/// Why a puzzle cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PuzzleError {
    /// The number of pieces is out of range.
    #[error("the number of pieces is {found}; it must be at least 2 and at most {most}")]
    Pieces {
        /// Requested number.
        found: usize,
        /// Largest number.
        most: usize,
    },
    /// An option is out of range.
    #[error("the {what} is {value}; {expected}")]
    Option {
        /// The option.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The valid range.
        expected: &'static str,
    },
    /// The outline crosses itself.
    #[error(
        "the outline crosses itself: side {} meets side {} near ({}, {}); it may not touch itself either: move its corners apart there",
        sides[0], sides[1], place[0], place[1]
    )]
    Crossing {
        /// The sides, each named by the corner that it starts from.
        sides: [usize; 2],
        /// Approximate place.
        place: [f64; 2],
    },
    /// The piece shape crosses itself.
    #[error(
        "the piece shape crosses itself: side {} meets side {} near ({}, {}); it may not touch itself either: move its corners apart there",
        sides[0], sides[1], place[0], place[1]
    )]
    PieceCrossing {
        /// The sides, each named by the corner that it starts from.
        sides: [usize; 2],
        /// Approximate place.
        place: [f64; 2],
    },
    /// Cells are so narrow that their corners coincide on the lattice.
    #[error(
        "the cells are too narrow for the lattice of corners: piece {piece} has no area; ask for fewer pieces"
    )]
    Narrow {
        /// The piece.
        piece: usize,
    },
    /// A new course of a border is invalid.
    #[error("border {border} cannot take this course: {why}")]
    Border {
        /// The border.
        border: usize,
        /// What is wrong.
        why: &'static str,
    },
    /// There is no room for a whimsy.
    #[error(
        "whimsy {index} finds no room of twice the area of a piece within the outline; ask for more pieces or fewer whimsies"
    )]
    Whimsy {
        /// Its index.
        index: usize,
    },
    /// Whole copies of the shape form no connected outline without holes.
    #[error(
        "whole copies of the shape make no outline of one part without holes here; ask for another number of pieces"
    )]
    Outline,
    /// A sheet has no room for all pieces.
    #[error(
        "the sheet of {width} × {height} holds {fits} of the {pieces} pieces, with {gap} between their paths: the pieces with half a cut around them need \
         an area of {:.0}, and it has {:.0}; take a sheet with half as much area again as they need, as layouts fill about two thirds, or a smaller puzzle", needed, width * height
    )]
    Sheet {
        /// Its width.
        width: f64,
        /// Its height.
        height: f64,
        /// The area of the pieces with half a cut around them.
        needed: f64,
        /// The least distance of paths.
        gap: f64,
        /// The most pieces that were placed.
        fits: usize,
        /// All of them.
        pieces: usize,
    },
    /// Time was up before any packing was found.
    #[error(
        "time was up when {placed} of the {pieces} pieces had a place on the sheet; allow more time, or pack without a limit"
    )]
    PackingStopped {
        /// The most pieces that were placed.
        placed: usize,
        /// All of them.
        pieces: usize,
    },
    /// The memory limit is too small.
    #[error("the pieces need {needed} bytes of memory, and {limit} are allowed")]
    Memory {
        /// Bytes needed.
        needed: usize,
        /// Bytes allowed.
        limit: usize,
    },
}
