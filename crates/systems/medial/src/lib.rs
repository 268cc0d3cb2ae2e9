//! Medial balls: few balls that fill a closed surface and show its limbs and joints.
//!
//! [`medial_balls`] shrinks balls inside the surface until they touch it at two points, and merges them until as many are left as
//! were asked for. [`Deviation`] bounds the distance between the balls and the surface, in both directions.
//!
//! | item | what it is |
//! |---|---|
//! | [`MedialRequest`] | all that can be asked, as the command and Python offer it |
//! | [`medial_balls`], [`MedialOptions`], [`Medial`] | the computation, its options, the balls with their edges |
//! | [`Deviation`] | bounds of the distance between balls and surface |
//!
//! ```
//! use pompeiu_core::mesh::shapes::torus;
//! use pompeiu_medial::{MedialOptions, medial_balls};
//! use pompeiu_surface::EmbeddedSurface;
//!
//! let torus = EmbeddedSurface::new(&torus(2.0, 0.7, 48, 32)?)?;
//! let medial = medial_balls(&torus, &MedialOptions::default())?;
//! assert!(medial.balls.iter().all(|ball| (ball.radius - 0.7).abs() < 0.05));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod ball;
mod balls;
mod cover;
mod error;
mod graph;
mod quadric;
mod request;
mod sample;
#[cfg(feature = "figures")]
pub mod show;
mod shrink;
mod simplify;
mod write;

pub use ball::Ball;
pub use balls::{Medial, MedialOptions, medial_balls};
pub use cover::Deviation;
pub use error::MedialError;
pub use request::{MedialReport, MedialRequest, MedialTiming};
