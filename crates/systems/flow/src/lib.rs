//! Flow of triangle surfaces to least area.
//!
//! | item | what it is |
//! |---|---|
//! | [`mean_curvature_flow`] | flow in time, and to minimal surfaces |
//! | [`FlowOptions`] | the scheme, the end, what the boundary may do, remeshing on the way |
//! | [`Flow`] | the surface, why the flow ended, whether it is a minimum, every step |

mod discs;
mod error;
mod existence;
mod gradient;
mod moving;
mod observer;
mod options;
mod pinch;
mod report;
mod request;
mod run;
mod scheme;
#[cfg(feature = "figures")]
pub mod show;
mod stability;
mod step;
mod systems;
mod time;
mod triangle;

pub use discs::Discs;
pub use error::FlowError;
pub use existence::Cone;
pub use gradient::GradientNorm;
pub use observer::{FlowObserver, FlowStep};
pub use options::{BoundaryCondition, FlowOptions, Remeshing, Until};
pub use pinch::Neck;
pub use report::{Change, Flow, FlowRecord, FlowStop, FlowTiming, StepReason};
pub use request::{FlowRequest, Volume};
pub use run::mean_curvature_flow;
pub use scheme::Scheme;
pub use stability::Stability;
