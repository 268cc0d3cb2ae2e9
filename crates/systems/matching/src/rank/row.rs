//! The result for a target as one row of a table.

use super::report::{Bound, Standing, Status};
use crate::Unusable;
use crate::align::Matrix;
use pompeiu_core::run::StopReason;
use serde::Serialize;

/// The result for a target.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Row {
    /// Its place among the targets, counted from 0; null for an input that led to no target.
    pub target: Option<usize>,
    /// Its name: the path if it is a file.
    pub path: String,
    /// The evidence that settled it.
    pub status: Kind,
    /// The first possible rank given the enclosures of all targets, counted from 1.
    pub rank_first: Option<usize>,
    /// The last possible rank given the enclosures of all targets, counted from 1.
    pub rank_last: Option<usize>,
    /// Proven lower bound on its distance.
    pub lower: Option<f64>,
    /// Proven upper bound on its distance.
    pub upper: Option<f64>,
    /// Number of vertices.
    pub vertices: Option<usize>,
    /// Number of faces.
    pub faces: Option<usize>,
    /// The method that proved that it is not among the best.
    pub discarded_by: Option<BoundKind>,
    /// The reason for which the ranking ended before it was decided whether the target is among the best.
    pub stop: Option<StopReason>,
    /// The reason for which it cannot be used.
    pub message: Option<String>,
    /// The map that aligned it to the template: four rows of four numbers, which act on columns `(x, y, z, 1)`.
    pub transform: Option<Matrix>,
}

/// The evidence that settled the place of a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// It is among the best, or tied with the last of them.
    Ranked,
    /// The ranking ended before that was decided.
    Open,
    /// It is proven not to be.
    Discarded,
    /// It cannot be used.
    Failed,
}

/// The method that proved a lower bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum BoundKind {
    /// Support functions in fixed directions.
    Supports,
    /// The distances of a few of its points.
    Probes,
    /// A search.
    Search,
}

impl Kind {
    /// The name in JSON.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ranked => "ranked",
            Self::Open => "open",
            Self::Discarded => "discarded",
            Self::Failed => "failed",
        }
    }
}

impl BoundKind {
    /// The name in JSON.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Supports => "supports",
            Self::Probes => "probes",
            Self::Search => "search",
        }
    }
}

impl Row {
    /// What cannot be used, and why, of a target that has failed.
    pub fn unusable(&self) -> Unusable {
        Unusable { path: self.path.clone(), message: self.message.clone().unwrap_or_default() }
    }

    /// The row of an input that could not be used, with the reason.
    pub fn failed(path: String, message: String) -> Self {
        Self {
            target: None,
            path,
            status: Kind::Failed,
            rank_first: None,
            rank_last: None,
            lower: None,
            upper: None,
            vertices: None,
            faces: None,
            discarded_by: None,
            stop: None,
            message: Some(message),
            transform: None,
        }
    }
}

impl From<Standing> for Row {
    fn from(standing: Standing) -> Self {
        let (status, discarded_by, stop, message) = match standing.status {
            Status::Ranked => (Kind::Ranked, None, None, None),
            Status::Open(reason) => (Kind::Open, None, Some(reason), None),
            Status::Discarded(bound) => (Kind::Discarded, Some(bound.kind()), None, None),
            Status::Failed(message) => (Kind::Failed, None, None, Some(message)),
        };
        Self {
            target: Some(standing.target),
            path: standing.name,
            status,
            rank_first: standing.ranks.map(|ranks| ranks[0]),
            rank_last: standing.ranks.map(|ranks| ranks[1]),
            lower: standing.lower,
            upper: standing.upper,
            vertices: standing.size.map(|size| size[0]),
            faces: standing.size.map(|size| size[1]),
            discarded_by,
            stop,
            message,
            transform: standing.transform,
        }
    }
}

impl Bound {
    /// The kind of the bound.
    pub const fn kind(self) -> BoundKind {
        match self {
            Self::Supports => BoundKind::Supports,
            Self::Probes => BoundKind::Probes,
            Self::Search(_) => BoundKind::Search,
        }
    }
}
