//! What a mesh of the skeleton would suffer from, located.

mod overlap;
mod shape;

use crate::Skeleton;

/// Something about the skeleton that deserves attention before it is meshed.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Problem {
    /// What it is.
    pub kind: ProblemKind,
    /// The branch, from 0, where it is one of a branch.
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
    /// The quantity that is wrong: a depth or length in micrometres, an angle in degrees, a radius, a count.
    pub value: f64,
    /// What it should be at most (angles, depths, counts) or more than (lengths, radii).
    pub limit: f64,
    /// The same in a sentence.
    pub message: String,
}

/// The kinds of problems.
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
    /// A sample at the place of its parent.
    Coincident,
    /// A branch that is shorter than the balls of its nodes.
    TooShort,
    /// A branch that ends inside a neighbour.
    Inside,
    /// Branches that meet where they should not.
    Overlap,
    /// A branch that turns too much within a radius.
    SharpTurn,
}

impl ProblemKind {
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
        }
    }
}

/// Degrees that a branch may turn within one radius either way. From 60° on, the circle through the three points is narrower than
/// the tube, so that the tube runs into itself.
pub const MOST_TURN: f64 = 60.0;

/// Finds all problems, in order of kind and place.
///
/// # Definition
/// - *several roots*: more than one tree.
/// - *no radius*: radius 0.
/// - *coincident*: a sample exactly at the place of its parent.
/// - *too short*: a branch to a tip that ends inside the ball of its node, or a branch between furcations whose balls overlap.
/// - *inside*: all samples of a branch beyond its node lie inside one neighbour.
/// - *overlap*: tubes of branches without a common node overlap; of branches with one, they overlap again after they have parted; of
///   one branch, parts further apart along it than π times the sum of their radii do. The deepest place of each pair is given.
/// - *sharp turn*: the chords from a point of a branch to those one radius before and behind it enclose more than
///   [`MOST_TURN`]. Where several samples in a row do, the worst is given.
///
/// # Cost
/// O(n log n) for tubes that are sparse in space: a sweep over boxes around the cones.
pub fn problems(skeleton: &Skeleton) -> Vec<Problem> {
    let branches = skeleton.branches();
    let mut found = shape::problems(skeleton, &branches);
    found.extend(overlap::problems(skeleton, &branches));
    found.sort_by_key(|problem| (problem.kind, problem.branch, problem.other_branch, problem.line));
    found
}
