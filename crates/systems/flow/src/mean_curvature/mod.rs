//! Mean curvature flow and minimal surfaces.

mod discs;
mod error;
mod existence;
mod gradient;
mod moving;
mod observer;
mod options;
mod pinch;
mod report;
mod run;
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
pub use options::{BoundaryCondition, FlowOptions, Remeshing, Scheme, Until};
pub use pinch::Neck;
pub use report::{Change, Flow, FlowRecord, FlowStop, FlowTiming, StepReason};
pub use run::mean_curvature_flow;
pub use stability::Stability;
