//! How far two surfaces deviate from each other, where, and over how much of the area.
//!
//! The Pompeiu–Hausdorff distance is one number for the worst point. [`DeviationOptions`] asks for the rest: mean, percentiles and
//! shares of the area beyond a threshold, each enclosed; distances by face and by vertex; the worst regions, told apart.
//!
//! Every number over an area is that of all its points, not of samples. Faces of A are cut into pieces, on each of which the
//! distance from B lies between two linear functions (`envelope`); integrals of those are formulas (`linear`), and sums are
//! rounded outwards. Pieces are cut until the numbers are as narrow as asked (`refine`).
//!
//! A report holds no pieces: whoever draws the surface cuts its faces again (`tessellation`).

mod across;
mod analysis;
mod area;
mod bands;
mod behind;
mod boundary;
mod bounds;
mod candidates;
mod cells;
mod clusters;
mod compare;
mod connected;
mod corners;
mod criterion;
#[cfg(feature = "serde")]
mod data;
mod distribution;
mod entry;
mod envelope;
mod face;
mod faces;
mod facets;
mod forecast;
mod frame;
mod fronts;
mod grid;
mod inside;
mod lanes;
mod linear;
mod maxima;
mod measure;
mod memory;
mod options;
mod outcome;
mod packed;
mod part;
mod passes;
mod patches;
mod percentiles;
mod pieces;
mod planes;
mod polygon;
mod portion;
mod refine;
mod regions;
mod report;
mod rough;
mod run;
mod select;
mod signed;
mod statistics;
mod tally;
mod task;
mod tessellation;
mod unknown;
mod walk;

pub(crate) use frame::frame_of;
pub(crate) use measure::VertexDistances;

pub use bands::{BandError, BandReport, Bands, DirectedBands, Extreme};
pub use options::DeviationOptions;
pub use part::{LeftOut, Part, component_shares};
pub use regions::Region;
pub use report::{Deviation, DeviationWork, DirectedDeviation, FaceDeviation, Sides};
pub use statistics::{Histogram, Percentile, ShareAbove, SignedStatistics, Statistics};
pub use tessellation::DisplayTriangle;
