//! Pictures of meshes and of what was found on them.
//!
//! This crate draws what it is given: it measures no distance and reads no file, and it returns bytes.
//!
//! ```
//! use pompeiu_figures::{ColorMap, Scale};
//!
//! let scale = Scale::new(ColorMap::Viridis, 0.0, 0.2)?.with_limit(0.15);
//! assert_eq!(scale.color(0.0), ColorMap::Viridis.table()[0]);
//! assert_eq!(scale.color(0.18), ColorMap::Viridis.contrast());
//! # Ok::<(), pompeiu_figures::ScaleError>(())
//! ```

pub mod colormap;

pub use colormap::{ColorMap, Rgb, Scale, ScaleError};
