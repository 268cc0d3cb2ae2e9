//! Named groups of faces.

use std::ops::Range;

/// Consecutive faces of a mesh that have a name in the file: a group or an object of OBJ, or a glTF node with its descendants.
/// Names may repeat, and a face may belong to several groups.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// Its name in the file.
    pub name: String,
    /// Its faces.
    pub faces: Range<usize>,
}

/// A statement of an OBJ file that assigns the faces after it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Mark {
    /// The faces belong to these groups, and no longer to earlier ones.
    Groups(Vec<String>),
    /// The faces belong to this object.
    Object(String),
}

/// Collects marks into groups.
#[derive(Debug, Default)]
pub(crate) struct Marks {
    groups: Vec<String>,
    groups_from: usize,
    object: Option<String>,
    object_from: usize,
    closed: Vec<Group>,
}

impl Marks {
    /// A mark before a face.
    pub(crate) fn mark(&mut self, face: usize, mark: Mark) {
        match mark {
            Mark::Groups(names) => {
                self.close_groups(face);
                (self.groups, self.groups_from) = (names, face);
            }
            Mark::Object(name) => {
                self.close_object(face);
                (self.object, self.object_from) = (Some(name), face);
            }
        }
    }

    /// All groups that have faces, in a mesh with this many faces.
    pub(crate) fn into_groups(mut self, faces: usize) -> Vec<Group> {
        self.close_object(faces);
        self.close_groups(faces);
        self.closed
    }

    fn close_groups(&mut self, face: usize) {
        let names = std::mem::take(&mut self.groups);
        if face > self.groups_from {
            let faces = self.groups_from..face;
            self.closed.extend(names.into_iter().map(|name| Group { name, faces: faces.clone() }));
        }
    }

    fn close_object(&mut self, face: usize) {
        let name = self.object.take();
        if face > self.object_from {
            self.closed.extend(name.map(|name| Group { name, faces: self.object_from..face }));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_end_where_the_next_begin_and_empty_ones_are_left_out() {
        let mut marks = Marks::default();
        let groups = |names: &[&str]| Mark::Groups(names.iter().map(|&name| name.to_owned()).collect());
        marks.mark(0, Mark::Object("part".to_owned()));
        marks.mark(2, groups(&["a", "b"]));
        marks.mark(5, groups(&["c"]));
        marks.mark(5, groups(&[]));
        marks.mark(7, groups(&["a"]));
        let found: Vec<(String, Range<usize>)> =
            marks.into_groups(9).into_iter().map(|group| (group.name, group.faces)).collect();
        let expected = [("a", 2..5), ("b", 2..5), ("part", 0..9), ("a", 7..9)];
        assert_eq!(found, expected.map(|(name, faces)| (name.to_owned(), faces)));
    }
}
