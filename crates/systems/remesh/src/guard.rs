//! What is done about faces of a result that intersect.

use pompeiu_core::TriMesh;
use pompeiu_core::run::StopReason;
use pompeiu_core::spatial::{SelfIntersections, self_intersections};

/// Pairs that are counted at most.
pub(super) const MOST_PAIRS: usize = 1_000_000;

/// The treatment of faces of a result that intersect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Intersections {
    /// They are not looked for.
    #[default]
    Ignore,
    /// They are counted.
    Report,
    /// There is no result.
    Refuse,
    /// There is no result where the input has none that intersect; otherwise those of both are counted.
    RefuseNew,
}

impl Intersections {
    /// Whether a computation looks for a result without faces that intersect and did not before.
    pub(super) fn avoids(self) -> bool {
        matches!(self, Self::Refuse | Self::RefuseNew)
    }
}

/// The number of pairs of faces that intersect, as [`self_intersections`] finds them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct IntersectionCount {
    /// Number of pairs.
    pub pairs: usize,
    /// Whether these are all; otherwise there are more.
    pub complete: bool,
    /// Number of pairs of faces of the input that intersect; null where the result has none, for then they are not counted.
    pub of_input: Option<usize>,
}

impl IntersectionCount {
    pub(super) fn of(found: &SelfIntersections) -> Self {
        Self { pairs: found.pairs.len(), complete: found.complete, of_input: None }
    }

    /// Whether more pairs intersect than of the input.
    pub fn is_more(&self) -> bool {
        self.of_input.is_some_and(|before| self.pairs > before)
    }
}

/// Faces of the result intersect, and that was to be refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{} of the result intersect, the first near {place:?}; {}", pairs_of_faces(*.pairs), advice(*.touching))]
pub struct Intersects {
    /// Number of pairs.
    pub pairs: usize,
    /// A point near one of them.
    pub place: [f64; 3],
    /// Number of pairs of faces of the input that touch where each has a vertex of its own.
    pub touching: usize,
}

/// What can be done, where so many pairs of faces of the input touch.
fn advice(touching: usize) -> String {
    if touching == 0 {
        return "ask for shorter edges or a smaller distance, or let them be counted (intersections: report)"
            .to_owned();
    }
    format!(
        "of the input {} touch where each has a vertex of its own, as sheets do that were cut apart at a common edge: rounding new vertices there may \
         make them intersect; let them be counted (intersections: report)",
        pairs_of_faces(touching)
    )
}

fn pairs_of_faces(pairs: usize) -> String {
    if pairs == 1 { "two faces".to_owned() } else { format!("{pairs} pairs of faces") }
}

impl Intersections {
    /// What is done where a run has ended early: a result that is not finished is not refused for what the end would have mended,
    /// and looking takes time that is over.
    pub(super) fn after(self, stop: Option<StopReason>) -> Self {
        match (self, stop) {
            (Self::RefuseNew, Some(_)) => Self::Ignore,
            _ => self,
        }
    }

    /// Counts the pairs of faces of a result that intersect, if that is asked for; the input is what it was made from.
    ///
    /// # Errors
    /// [`Intersects`] if there are some and they are to be refused.
    /// # Cost
    /// That of [`self_intersections`]; nothing for [`Intersections::Ignore`].
    pub fn of(self, mesh: &TriMesh, input: &TriMesh) -> Result<Option<IntersectionCount>, Intersects> {
        if self == Self::Ignore {
            return Ok(None);
        }
        let found = self_intersections(mesh, MOST_PAIRS);
        let count = IntersectionCount::of(&found);
        let Some(first) = found.pairs.first() else { return Ok(Some(count)) };
        let before = self_intersections(input, MOST_PAIRS);
        let count = IntersectionCount { of_input: Some(before.pairs.len()), ..count };
        if !self.avoids() || self == Self::RefuseNew && !before.pairs.is_empty() {
            return Ok(Some(count));
        }
        Err(Intersects { pairs: count.pairs, place: first.place, touching: before.touching })
    }
}
