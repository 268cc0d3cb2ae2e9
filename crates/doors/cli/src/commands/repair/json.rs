//! The outcome as one JSON object.

use super::run::Outcome;
use crate::json::line;
use crate::pair::File;
use pompeiu::core::mesh::repair;
use pompeiu::hausdorff::Enclosure;
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let found = &outcome.report;
    line(&Json {
        input: &outcome.input,
        output: &outcome.output,
        written: outcome.written,
        unreferenced_vertices: (&found.unreferenced_vertices).into(),
        welded_vertices: (&found.welded).into(),
        degenerate_faces: (&found.degenerate_faces).into(),
        duplicate_faces: (&found.duplicate_faces).into(),
        split_edges: (&found.split_edges).into(),
        split_vertices: (&found.split_vertices).into(),
        turned_faces: (&found.turned_faces).into(),
        non_orientable_components: (&found.non_orientable_components).into(),
        filled_holes: (&found.filled_holes).into(),
        holes_left: (&found.holes_left).into(),
        faces_added: found.faces_added,
        within: outcome.distance.map(|(within, _)| within),
        distance: outcome.distance.map(|(_, distance)| distance),
    })
}

/// How often something was changed, and where the first few times, in the coordinates of the file.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
struct Change<'o> {
    count: usize,
    places: &'o [[f64; 3]],
}

impl<'o> From<&'o repair::Change> for Change<'o> {
    fn from(change: &'o repair::Change) -> Self {
        Self { count: change.count, places: &change.places }
    }
}

/// The answer of `pompeiu repair --json`. Lengths are in the unit of the file.
#[derive(Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema), schemars(rename = "Repair"))]
pub(crate) struct Json<'o> {
    input: &'o File,
    output: &'o File,
    /// Whether the output was written: not where the distance asked for is not proven.
    written: bool,
    unreferenced_vertices: Change<'o>,
    welded_vertices: Change<'o>,
    degenerate_faces: Change<'o>,
    duplicate_faces: Change<'o>,
    split_edges: Change<'o>,
    split_vertices: Change<'o>,
    turned_faces: Change<'o>,
    non_orientable_components: Change<'o>,
    filled_holes: Change<'o>,
    holes_left: Change<'o>,
    faces_added: usize,
    /// The distance asked for; null without.
    within: Option<f64>,
    /// The Pompeiu–Hausdorff distance of input and output; null where none was asked for.
    distance: Option<Enclosure>,
}
