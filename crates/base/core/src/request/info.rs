//! Describing a mesh.

use super::{Limit, Report, Request};
use crate::run::StopReason;
use crate::spatial::{SelfIntersections, self_intersections};
use crate::{MeshSummary, TriMesh};

/// Pairs of intersecting faces that are counted, and those of them that are listed.
const MOST_PAIRS: usize = 10_000_000;
const MOST_LISTED: usize = 1000;

/// Describe a mesh: counts, size, area, volume, topology, oddities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct InfoRequest {
    /// Find pairs of faces that intersect, decided exactly.
    #[cfg_attr(feature = "clap", arg(long))]
    pub intersections: bool,
}

impl Request for InfoRequest {
    const NAME: &'static str = "info";
    const LIMITS: &'static [Limit] = &[];
    type Report = InfoReport;
}

/// The report on a mesh. Lengths are in its unit.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct InfoReport {
    /// The format and the steps of reading the file; null for a mesh that is in no file.
    pub file: Option<FileFacts>,
    /// Counts, measures and connectivity.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub summary: MeshSummary,
    /// Pairs of faces that intersect; null unless asked for.
    pub self_intersections: Option<IntersectingFaces>,
}

/// The format and the steps of reading a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FileFacts {
    /// The format by content.
    pub format: String,
    /// Whether the file is compressed.
    pub compressed: bool,
    /// Number of faces with more than three corners, which were cut into triangles.
    pub polygons_triangulated: u64,
    /// Number of faces with fewer than three corners, which were left out.
    pub faces_dropped: u64,
}

/// Pairs of faces with a common point beside the corners and edges that neighbours share.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct IntersectingFaces {
    /// Number of pairs.
    pub count: usize,
    /// Number of further pairs that only touch, where different vertices are at one position.
    pub touching: usize,
    /// Whether these are all; otherwise counting ended at ten million.
    pub complete: bool,
    /// The first thousand pairs in the order of their faces.
    pub first: Vec<IntersectingFacePair>,
}

/// Two faces that intersect.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct IntersectingFacePair {
    /// Both faces.
    pub faces: [u32; 2],
    /// A point of both, rounded.
    pub place: [f64; 3],
}

impl From<SelfIntersections> for IntersectingFaces {
    fn from(found: SelfIntersections) -> Self {
        let listed = found.pairs.iter().take(MOST_LISTED);
        Self {
            count: found.pairs.len(),
            touching: found.touching,
            complete: found.complete,
            first: listed
                .map(|pair| IntersectingFacePair { faces: pair.faces.map(|f| f.0), place: pair.place })
                .collect(),
        }
    }
}

impl Report for InfoReport {
    fn stop(&self) -> StopReason {
        StopReason::Tolerance
    }
}

impl InfoRequest {
    /// Describes a mesh; the file that it was read from is the caller's to add.
    pub fn run(&self, mesh: &TriMesh) -> InfoReport {
        InfoReport {
            file: None,
            summary: MeshSummary::of(mesh),
            self_intersections: self.intersections.then(|| self_intersections(mesh, MOST_PAIRS).into()),
        }
    }
}
