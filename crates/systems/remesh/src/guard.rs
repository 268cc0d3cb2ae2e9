//! What is done about faces of a result that intersect.

use pompeiu_core::TriMesh;
use pompeiu_core::spatial::self_intersections;

/// Pairs that are counted at most.
const MOST_PAIRS: usize = 1_000_000;

/// What is done about faces of a result that intersect.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Intersections {
    /// Nothing; they are not looked for.
    #[default]
    Ignore,
    /// They are counted.
    Report,
    /// There is no result.
    Refuse,
}

/// How many pairs of faces intersect, as [`self_intersections`] finds them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct IntersectionCount {
    /// Number of pairs.
    pub pairs: usize,
    /// Whether these are all; otherwise there are more.
    pub complete: bool,
}

/// Faces of the result intersect, and that was to be refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{} of the result intersect, the first near {place:?}", pairs_of_faces(*.pairs))]
pub struct Intersects {
    /// Number of pairs.
    pub pairs: usize,
    /// A point near one of them.
    pub place: [f64; 3],
}

fn pairs_of_faces(pairs: usize) -> String {
    if pairs == 1 { "two faces".to_owned() } else { format!("{pairs} pairs of faces") }
}

impl Intersections {
    /// Counts the pairs of faces of a result that intersect, if that is asked for.
    ///
    /// # Errors
    /// [`Intersects`] if there are some and they are to be refused.
    /// # Cost
    /// That of [`self_intersections`]; nothing for [`Intersections::Ignore`].
    pub fn of(self, mesh: &TriMesh) -> Result<Option<IntersectionCount>, Intersects> {
        if self == Self::Ignore {
            return Ok(None);
        }
        let found = self_intersections(mesh, MOST_PAIRS);
        match found.pairs.first() {
            Some(first) if self == Self::Refuse => {
                Err(Intersects { pairs: found.pairs.len(), place: first.place })
            }
            _ => Ok(Some(IntersectionCount { pairs: found.pairs.len(), complete: found.complete })),
        }
    }
}
