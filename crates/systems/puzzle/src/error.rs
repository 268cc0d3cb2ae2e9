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
    /// An outline that crosses itself.
    #[error("the outline crosses itself: side {} meets side {} near ({}, {})", sides[0], sides[1], place[0], place[1])]
    Crossing {
        /// The sides, each named by the corner that it starts from.
        sides: [usize; 2],
        /// About where it is.
        place: [f64; 2],
    },
    /// A piece shape that crosses itself.
    #[error("the piece shape crosses itself: side {} meets side {} near ({}, {})", sides[0], sides[1], place[0], place[1])]
    PieceCrossing {
        /// The sides, each named by the corner that it starts from.
        sides: [usize; 2],
        /// About where it is.
        place: [f64; 2],
    },
    /// Cells so narrow that the lattice cannot tell their corners apart.
    #[error(
        "the cells are too narrow for the lattice of corners: piece {piece} has no area; ask for fewer pieces"
    )]
    Narrow {
        /// The piece.
        piece: usize,
    },
    /// A border that cannot take another course.
    #[error("border {border} cannot take this course: {why}")]
    Border {
        /// The border.
        border: usize,
        /// What is wrong.
        why: &'static str,
    },
    /// A whimsy without room.
    #[error(
        "whimsy {index} finds no room of twice the area of a piece within the outline; ask for more pieces or fewer whimsies"
    )]
    Whimsy {
        /// Its place in the list.
        index: usize,
    },
    /// Pieces that leave no outline in one part.
    #[error(
        "whole copies of the shape make no outline of one part without holes here; ask for another number of pieces"
    )]
    Outline,
    /// More memory than there may be.
    #[error("the pieces need {needed} bytes of memory, and {limit} are allowed")]
    Memory {
        /// What is needed.
        needed: usize,
        /// What is allowed.
        limit: usize,
    },
}
