//! Jigsaw puzzles whose pieces tile exactly, and what holds them together.
//!
//! All corners lie on an integer lattice, so that areas add up without rounding and the test for motions is exact.
//!
//! | item | what it is |
//! |---|---|
//! | [`make`], [`PuzzleOptions`], [`Layout`], [`Tab`] | puzzles in a rectangle or outline: squares, hexagons, Voronoi cells, with
//! tabs |
//! | [`make_like`], [`PieceShape`], [`Method`], [`Like`] | pieces as similar to a given shape as possible, and their similarity |
//! | [`gauge`], [`Map`], [`register`] | the shape-matching metric, its table, registration of point sets by similarities |
//! | [`Puzzle`], [`Border`] | the pieces and their common borders, each stored once |
//! | [`lock`], [`Lock`], [`Proof`] | which pieces cannot move relative to each other in any joint motion, and a motion that takes a
//! puzzle apart |
//! | [`kerf`], [`Kerf`] | whether pieces still hold each other with the gap left by a cut |
//! | [`take_apart`], [`Motion`], [`shake`] | the motion by which a free puzzle comes apart, step by step; random shaking |
//! | [`PuzzleReport`], [`report`] | the report of a puzzle |
//! | [`pieces_svg`], [`cuts_svg`], [`pieces_dxf`], [`cuts_dxf`], [`pieces_png`], [`Print`] | drawings for cutting, and pieces with
//! a picture on them |
//! | [`pack`], [`Packing`] | where pieces lie on a sheet, a cut apart |
//! | [`PuzzleRequest`], [`PuzzleAnswer`] | all of this in one call, with options as every door offers them |
//! | [`motion_svg`], [`motion_png`], [`page`] | drawings of the motion, and an interactive page |
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
mod kerf;
mod lock;
mod make;
mod motion;
mod neck;
mod order;
mod pack;
mod puzzle;
mod report;
mod request;
mod shape;
mod space;

pub use draw::{
    PieceDrawing, Print, cuts_dxf, cuts_svg, motion_png, motion_svg, page, pieces_dxf, pieces_png, pieces_svg,
};
pub use error::PuzzleError;
pub use kerf::{Kerf, kerf};
pub use lock::{Escape, Lock, Proof, lock};
pub use make::{Layout, PuzzleOptions, Tab, make};
pub use motion::{Motion, shake, take_apart};
pub use neck::Neck;
pub use pack::{Packing, Place, pack};
pub use puzzle::{Border, Puzzle};
pub use report::{
    AreaReport, MotionReport, PieceReport, PuzzleReport, Similarity, Timing, report, report_like,
};
pub use request::{PieceSource, Placing, PuzzleAnswer, PuzzleRequest, PuzzleRequestError};
pub use shape::{
    Answer, Fit, Like, LikeOptions, Map, Method, PieceName, PieceShape, Pose, Registered, Variant, gauge,
    make_like, meetings, register,
};
