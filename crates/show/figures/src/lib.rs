//! Pictures and interactive pages of meshes and of results on them.
//!
//! This crate draws its input: it computes no distances, reads no files, and returns pixels or bytes.
//!
//! A [`Figure`] has [panels](Panel) that share a camera and a colour [`Scale`]; a panel shows a mesh, coloured by
//! [`Values`], and [marks](Mark) on it. No graphics card is needed, and the same figure has the same pixels on every
//! machine. A [`page::Page`] is interactive instead: one HTML file, composed by each system from [shared parts](page). A
//! [`paper::Document`] is for printing.
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
mod error;
mod figure;
mod film;
mod image;
mod labels;
mod legend;
pub mod names;
mod normals;
pub mod page;
mod palette;
mod panel;
pub mod paper;
mod raster;
mod text;
mod theme;
mod ticks;
mod view;

pub use colormap::{ColorMap, Rgb, Scale, ScaleError};
pub use error::FigureError;
pub use figure::Figure;
pub use film::{FilmFormat, write_film};
pub use image::Image;
pub use legend::LegendSide;
pub use normals::vertex_normals;
pub use panel::{Mark, Panel, Values};
pub use theme::Theme;
pub use view::{Projection, View};
