//! Defects of a skeleton that would harm a mesh.

mod meshing;
mod overlap;
mod shape;

pub use meshing::{Meshability, meshability};

use crate::Skeleton;

/// A defect of the skeleton that deserves attention before it is meshed.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Problem {
    /// Its kind.
    pub kind: ProblemKind,
    /// The branch, from 0, for defects of a branch.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub branch: Option<usize>,
    /// The number of the sample in the file.
    pub sample: i64,
    /// Its line in the file, from 1.
    pub line: usize,
    /// The other branch of an overlap.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub other_branch: Option<usize>,
    /// The sample of the other branch.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub other_sample: Option<i64>,
    /// The value that is out of range: a depth or length in micrometres, an angle in degrees, a radius, a count; of a mesh the distance of its
    /// wall from the cones in radii, or a scaled Jacobian.
    pub value: f64,
    /// The limit: an upper limit for angles, depths, distances and counts, a lower limit for lengths, radii and scaled Jacobians.
    pub limit: f64,
    /// A description in a sentence.
    pub message: String,
}

/// The kinds of defects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum ProblemKind {
    /// Several trees in one file.
    SeveralRoots,
    /// A sample without a radius.
    ZeroRadius,
    /// A sample at the position of its parent.
    Coincident,
    /// A branch that is shorter than the balls of its nodes.
    TooShort,
    /// A branch that ends inside an adjacent one.
    Inside,
    /// Branches that intersect where they should not.
    Overlap,
    /// A branch that turns too much within a radius, or more sharply than its mesh follows.
    SharpTurn,
    /// A node whose branches are too close together, or of too different radii, for its mesh.
    Node,
    /// A place at which the wall of the mesh is too far from the cones, without one of the other kinds.
    Wall,
    /// Cells of the mesh that are not proven valid.
    Cells,
    /// No branch at all that could be meshed.
    NoBranch,
}

impl ProblemKind {
    /// Whether it is a defect of the file, not of the shape.
    pub const fn is_of_file(self) -> bool {
        matches!(self, Self::SeveralRoots | Self::ZeroRadius | Self::Coincident)
    }

    /// The kind in words.
    pub const fn name(self) -> &'static str {
        match self {
            Self::SeveralRoots => "several roots",
            Self::ZeroRadius => "no radius",
            Self::Coincident => "coincident samples",
            Self::TooShort => "too short",
            Self::Inside => "inside another branch",
            Self::Overlap => "overlap",
            Self::SharpTurn => "sharp turn",
            Self::Node => "node",
            Self::Wall => "wall",
            Self::Cells => "cells",
            Self::NoBranch => "no branch",
        }
    }
}

/// Largest turn of a branch, in degrees, within one radius either way. From 60° on, the circle through the three points is narrower
/// than the tube, so that the tube intersects itself.
pub const MOST_TURN: f64 = 60.0;

/// Finds all defects, ordered by kind and place.
///
/// # Definition
/// - *several roots*: more than one tree.
/// - *no radius*: radius 0.
/// - *coincident*: a sample exactly at the position of its parent.
/// - *too short*: a branch to a tip that ends inside the ball of its node, or a branch between furcations whose balls overlap.
/// - *inside*: all samples of a branch beyond its node lie inside one adjacent branch.
/// - *overlap*: tubes of branches without a common node overlap; tubes of branches with one overlap again after they have
///   separated; parts of one branch overlap that are further apart along it than π times the sum of their radii. The deepest place
///   of each pair is reported.
/// - *sharp turn*: the chords from a point of a branch to those one radius before and behind it enclose more than [`MOST_TURN`]. Of
///   consecutive samples the worst is reported.
///
/// # Cost
/// O(n log n) for tubes that are sparse in space: a sweep over bounding boxes of the cones.
pub fn problems(skeleton: &Skeleton) -> Vec<Problem> {
    let branches = skeleton.branches();
    let mut found = shape::problems(skeleton, &branches);
    found.extend(overlap::problems(skeleton, &branches));
    found.sort_by_key(|problem| (problem.kind, problem.branch, problem.other_branch, problem.line));
    found
}
