//! Jigsaw puzzles whose pieces tile exactly, and what holds them together.
//!
//! All corners lie on a lattice of integers, so that areas add up without rounding and the test of what can move is exact.
//!
//! | item | what it is |
//! |---|---|
//! | [`make`], [`PuzzleOptions`], [`Layout`], [`Tab`] | puzzles on a rectangle: squares, hexagons, Voronoi cells, with tabs |
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

pub use draw::{cuts_dxf, cuts_svg, page, pieces_dxf, pieces_svg};
pub use error::PuzzleError;
pub use lock::{Escape, Lock, Proof, lock};
pub use make::{Layout, PuzzleOptions, Tab, make};
pub use puzzle::{Border, Puzzle};
pub use report::{AreaReport, PieceReport, PuzzleReport, Timing, report};
