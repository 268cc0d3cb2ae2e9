//! Which of these meshes is most like that one? Targets ranked by their Pompeiu–Hausdorff distance from a template.
//!
//! Only as much is computed as the ranking needs. Every target is looked at once: support functions and a few points of it
//! give a first enclosure of its distance ([`look`]). Then distances are searched for, coarsely first and in rounds
//! ([`refine`]), and a target is discarded as soon as its proven lower bound exceeds the k-th least proven upper bound. What is
//! left are the k best, and whatever ties with them: each with the enclosure that was asked for.
//!
//! Two halves that know nothing of each other's place: **tasks**, pure functions of a template, a mesh and a small request
//! ([`perform`]), whose requests and results are plain serialisable values; and [`Ranking`], a state machine that says which
//! tasks come next, given the results of the round before. Where tasks run, and in which order those of a round end, changes
//! nothing: the same bits come out on one thread and on a cluster.
//!
//! Limits and the observer of [`RankOptions`] end a ranking at any time. What is proven by then is reported: targets that were
//! not settled are [open](Status::Open), with their bounds and with the ranks that are still possible.
//!
//! # Accuracy
//! Ranks follow from proven enclosures alone. Where these overlap at the finest tolerance the rank stays a range ("2 to 3").
//! With an [alignment](crate::align) the enclosures hold for the target as moved, its coordinates rounded to doubles.
//!
//! # Example
//! ```
//! use pompeiu_core::mesh::shapes::icosphere;
//! use pompeiu_matching::rank::{RankOptions, Status, rank_meshes};
//!
//! let template = icosphere(1.0, 2)?;
//! let targets = [icosphere(1.5, 2)?, icosphere(1.01, 2)?, icosphere(9.0, 2)?];
//! let report = rank_meshes(&template, &targets, &RankOptions { top: 1, ..RankOptions::default() })?;
//! let best = &report.standings[0];
//! assert_eq!((best.target, best.ranks, &best.status), (1, Some([1, 1]), &Status::Ranked));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bounds;
mod driver;
mod local;
mod options;
mod report;
mod row;
mod summary;
mod task;
mod template;

pub use bounds::{box_upper_bound, support_lower_bound};
pub use driver::Ranking;
pub use local::{rank_meshes, run};
pub use options::{Measure, RankError, RankOptions};
pub use report::{Bound, Report, Standing, Status, Work};
pub use row::{BoundKind, Kind, Row};
pub use summary::Summary;
pub use task::{Action, Outcome, RefineError, Refined, Request, Sight, Task, look, perform, refine};
pub use template::Template;
