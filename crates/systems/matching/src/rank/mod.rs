//! Ranking meshes by their Pompeiu–Hausdorff distance from a template.
//!
//! Only what the ranking needs is computed. First every target is read once: its support function and a few of its points give a
//! first enclosure of its distance ([`look`]). Then distances are searched, coarsely first and in rounds ([`refine`]), and a target
//! is discarded as soon as its proven lower bound exceeds the k-th least proven upper bound. The k best and their ties remain, each
//! with the requested enclosure.
//!
//! The two halves are independent: **tasks** are pure functions of a template, a mesh and a small request ([`perform`]), whose
//! requests and results are plain serialisable values; [`Ranking`] is a state machine that selects the next tasks from the results
//! of the previous round. Where tasks run, and in which order those of a round end, has no effect: the same bits come out on one
//! thread and on a cluster.
//!
//! Limits and the observer of [`RankOptions`] can end a ranking at any time. Everything proven by then is reported: unsettled
//! targets are [open](Status::Open), with their bounds and the ranks that are still possible.
//!
//! # Accuracy
//! Ranks follow from proven enclosures alone. If these overlap at the finest tolerance, the rank stays a range ("2 to 3"). With an
//! [alignment](crate::align) the enclosures hold for the target as moved, with coordinates rounded to doubles.
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
pub use local::{rank, rank_meshes};
pub use options::{Measure, RankError, RankOptions};
pub use report::{Bound, Report, Standing, Status, Work};
pub use row::{BoundKind, Kind, Row};
pub use summary::Summary;
pub use task::{Action, Outcome, RefineError, Refined, Request, Sight, Task, look, perform, refine};
pub use template::Template;
