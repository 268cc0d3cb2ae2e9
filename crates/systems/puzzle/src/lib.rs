//! Jigsaw puzzles whose pieces tile exactly, and what holds them together.
//!
//! All corners lie on a lattice of integers, so that areas add up without rounding and the test of what can move is exact.
//!
//! | item | what it is |
//! |---|---|
//! | [`make`], [`PuzzleOptions`], [`Layout`], [`Tab`] | puzzles on a rectangle: squares, hexagons, Voronoi cells, with tabs |
//! | [`make_like`], [`PieceShape`], [`Method`], [`Like`] | pieces as near to a given shape as they can be, and how near they are |
//! | [`gauge`], [`Map`], [`register`] | the shape-matching metric, its table, the similarity that brings points onto others |
//! | [`Puzzle`], [`Border`] | the pieces, and each border between two of them once |
//! | [`lock`], [`Lock`], [`Proof`] | which pieces cannot be moved against each other, all motions at once, and how a puzzle comes apart |
//! | [`PuzzleReport`], [`report`] | what is said of a puzzle |
//! | [`pieces_svg`], [`cuts_svg`], [`pieces_dxf`], [`cuts_dxf`], [`page`] | what is cut, and what is played with |
//!
//! ```
//! use pompeiu_puzzle::{PuzzleOptions, Tab, lock, make};
//!
//! let puzzle = make(&PuzzleOptions { pieces: 12, ..PuzzleOptions::default() })?;
//! assert_eq!(puzzle.pieces(), 12);
//! assert!(lock(&puzzle).is_locked());
//!
//! let plain = make(&PuzzleOptions { pieces: 12, tab: Tab::None, ..PuzzleOptions::default() })?;
//! assert!(!lock(&plain).is_locked());
//! # Ok::<(), pompeiu_puzzle::PuzzleError>(())
//! ```

mod draw;
mod error;
mod lock;
mod make;
mod puzzle;
mod report;
mod shape;
mod space;

pub use draw::{cuts_dxf, cuts_svg, page, pieces_dxf, pieces_svg};
pub use error::PuzzleError;
pub use lock::{Escape, Lock, Proof, lock};
pub use make::{Layout, PuzzleOptions, Tab, make};
pub use puzzle::{Border, Puzzle};
pub use report::{AreaReport, PieceReport, PuzzleReport, Similarity, Timing, report, report_like};
pub use shape::{
    Answer, Fit, Like, LikeOptions, Map, Method, PieceName, PieceShape, Pose, Registered, Variant, gauge,
    make_like, meetings, register,
};
