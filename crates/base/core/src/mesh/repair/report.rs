//! What a repair did.

/// The number of times that an operation was applied or a defect was found, with the first places.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Change {
    /// The number of times.
    pub count: usize,
    /// A point at each of the first occurrences, at most [`Change::MOST_PLACES`]. Places are kept because a repair renumbers
    /// vertices and faces.
    pub places: Vec<[f64; 3]>,
}

impl Change {
    /// The most places that are kept.
    pub const MOST_PLACES: usize = 10;

    pub(super) fn add(&mut self, place: [f64; 3]) {
        self.count += 1;
        if self.places.len() < Self::MOST_PLACES {
            self.places.push(place);
        }
    }

    pub(super) fn of(places: impl IntoIterator<Item = [f64; 3]>) -> Self {
        let mut change = Self::default();
        places.into_iter().for_each(|place| change.add(place));
        change
    }
}

/// What [`repair`](super::repair) did, in the order of the operations.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RepairReport {
    /// Vertices that no face names, dropped.
    pub unreferenced_vertices: Change,
    /// Vertices that became one with an earlier one.
    #[cfg_attr(feature = "serde", serde(rename = "welded_vertices"))]
    pub welded: Change,
    /// Faces of area zero, dropped.
    pub degenerate_faces: Change,
    /// Faces with the vertices of an earlier face, dropped.
    pub duplicate_faces: Change,
    /// Edges that had more than two faces.
    pub split_edges: Change,
    /// Vertices whose faces formed more than one fan, and have one vertex for each fan now.
    pub split_vertices: Change,
    /// Faces whose orientation was reversed: the fewest in each component.
    pub turned_faces: Change,
    /// Components with one side only, which have no orientation before they are cut open.
    pub non_orientable_components: Change,
    /// Edges along which these components were cut open.
    pub opened_edges: Change,
    /// Boundary loops that were filled.
    pub filled_holes: Change,
    /// Boundary loops with few enough edges that could not be filled: every triangulation has a degenerate face or an edge that is
    /// there already.
    pub holes_left: Change,
    /// Faces that fill holes; the last of the mesh.
    pub faces_added: usize,
}

impl RepairReport {
    /// Whether the mesh is as it was.
    pub fn is_unchanged(&self) -> bool {
        [
            &self.unreferenced_vertices,
            &self.welded,
            &self.degenerate_faces,
            &self.duplicate_faces,
            &self.split_vertices,
            &self.turned_faces,
            &self.opened_edges,
            &self.filled_holes,
        ]
        .into_iter()
        .all(|change| change.count == 0)
    }
}
