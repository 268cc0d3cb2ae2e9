//! Closed curves in the plane: read from pictures and drawings, resampled, compared, checked for crossings.
//!
//! | item | what it is |
//! |---|---|
//! | [`Outline`] | a closed polygon, counter-clockwise, with length, area and centroid |
//! | [`Region`] | an outline with holes |
//! | [`orientation`], [`segments_meet`] | exact predicates on doubles |
//! | [`first_crossing`] | whether a closed polygon crosses itself, and where |
//! | [`resample`], [`catmull_rom`] | resampling at equal arc lengths, smooth curves through points |
//! | [`SideTree`] | the sides of an outline in a tree, for the distances of many points from it, and which of them lie inside |
//! | [`hausdorff`], [`intersection_area`] | distance and common area of two outlines |
//! | [`offset`] | outlines at a distance from an outline |
//! | [`picture`], [`contour`], [`silhouette`], [`fill`] | pictures, their contours at a level, the shape in them; rasterised
//! outlines |
//! | [`svg`], [`dxf`] | drawings |
//! | [`regions`] | the regions that closed curves enclose together, by a fill rule |
//! | [`ShapeSource`], [`read_region`], [`read_shapes`], [`read_outlines`], [`shapes_in`] | shapes in files of all these kinds, or given by their
//! corners |
//!
//! ```
//! use pompeiu_planar::{Outline, resample};
//!
//! let square = Outline::new(vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])?;
//! assert_eq!((square.area(), square.length()), (4.0, 8.0));
//! assert_eq!(resample(&square, 8, 0)[1], [1.0, 0.0]);
//! # Ok::<(), pompeiu_planar::OutlineError>(())
//! ```

pub mod contour;
mod coverage;
mod crossing;
mod curve;
mod distance;
pub mod dxf;
mod fairing;
mod file;
mod filling;
mod joined;
mod offset;
mod outline;
mod overlap;
pub mod picture;
mod predicates;
mod raster;
mod shape_source;
mod side_tree;
pub mod silhouette;
mod strips;
pub mod svg;

pub use crossing::{Crossing, first_crossing};
pub use curve::{catmull_rom, resample, resample_points};
pub use distance::{distance_sq_to_segment, distance_to_outline, from_segment, hausdorff};
pub use file::{
    DrawnShape, FileError, LeftOut, is_picture, is_shape, read_outlines, read_region, read_shapes, shapes_in,
};
pub use filling::{FillRule, regions};
pub use offset::offset;
pub use outline::{Outline, OutlineError, Region, bounds};
pub use overlap::intersection_area;
pub use predicates::{Turn, orientation, segments_meet};
pub use raster::fill;
pub use shape_source::{ShapeError, ShapeSource};
pub use side_tree::SideTree;

/// A point or a vector in the plane.
pub type Point = [f64; 2];
