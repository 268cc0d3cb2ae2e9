//! Oriented manifold triangle surfaces.
//!
//! Three types describe a surface, each with more information than the one before:
//!
//! | type | knows |
//! |---|---|
//! | [`SurfaceMesh`] | connectivity: half-edges, boundary loops, components, genus |
//! | [`Surface`] | also intrinsic geometry: lengths, angles, areas, and parallel transport between faces |
//! | [`EmbeddedSurface`] | also the embedding in space: positions, normals, frames |
//!
//! All of them exist only for oriented manifolds, with or without boundary; anything else is an error that names the offending
//! element. Most algorithms need only a [`Surface`], so they also work without an embedding, on a flat torus for instance.
//!
//! ```
//! use pompeiu_core::mesh::shapes::icosphere;
//! use pompeiu_surface::EmbeddedSurface;
//!
//! let sphere = EmbeddedSurface::new(&icosphere(1.0, 3)?)?;
//! let defect: f64 = sphere.surface().angle_defects().iter().sum();
//! assert!((defect - 4.0 * std::f64::consts::PI).abs() < 1e-10);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A tangent vector of a face is a pair of coordinates in the frame of the face: its first axis runs along the face's first
//! edge, its second a quarter turn counter-clockwise from it.

mod build;
mod delaunay;
mod embedded;
mod error;
mod ids;
mod mesh;
mod path;
mod periodic;
pub mod plane;
mod surface;
mod topology;
mod trace;

pub use build::orient;
pub use delaunay::{IntrinsicDelaunay, intrinsic_delaunay};
pub use embedded::EmbeddedSurface;
pub use error::{GeometryError, SurfaceError};
pub use ids::{CornerData, EdgeData, EdgeId, HalfedgeId};
pub use mesh::SurfaceMesh;
pub use path::EdgeDistances;
pub use periodic::flat_torus;
pub use surface::Surface;
pub use topology::{Chain, Generators, Relative, tree_cotree};
pub use trace::{Ray, Trace, TraceEnd, TraceOptions, Tracer};
