//! The body of an ascii PLY file.

use super::header::{Element, Header, Kind};
use super::push_strips;
use crate::raw::RawMesh;
use crate::text::{
    Problem, coordinate, is_blank, is_line_end, next_line, number, quoted, whole_number, word,
};

/// Bytes of the shortest row with three numbers: digits, blanks and a line end.
const SHORTEST_ROW: usize = 6;

pub(super) fn read(bytes: &[u8], header: &Header) -> Result<RawMesh, Problem> {
    let mut mesh = RawMesh::default();
    let mut rows = Rows { text: bytes, at: header.body };
    let vertices = header.element(b"vertex").map_or(0, |element| element.count);
    let mut indices = Vec::new();
    for element in &header.elements {
        let most = (element.count.min(u64::MAX >> 1) as usize).min((bytes.len() - rows.at) / SHORTEST_ROW);
        match element.name.as_slice() {
            b"vertex" => {
                let columns = element.coordinates()?;
                mesh.positions.reserve_exact(most);
                rows.each(element, |row| {
                    let mut position = [0.0; 3];
                    for (column, property) in element.properties.iter().enumerate() {
                        match columns.iter().position(|&c| c == column) {
                            Some(axis) => position[axis] = row.coordinate()?,
                            None => row.skip(property.kind)?,
                        }
                    }
                    mesh.positions.push(position);
                    Ok(())
                })?;
            }
            b"face" | b"tristrips" => {
                let column = element.indices()?;
                let strips = element.name == b"tristrips";
                mesh.faces.reserve(if strips { 0 } else { most });
                rows.each(element, |row| {
                    for (at, property) in element.properties.iter().enumerate() {
                        if at == column {
                            row.indices(&mut indices, vertices, strips)?;
                        } else {
                            row.skip(property.kind)?;
                        }
                    }
                    if strips {
                        push_strips(&mut mesh, &indices);
                    } else {
                        mesh.push_polygon(indices.iter().map(|&index| index as u32));
                    }
                    Ok(())
                })?;
            }
            _ => rows.each(element, |row| {
                element.properties.iter().try_for_each(|property| row.skip(property.kind))
            })?,
        }
    }
    mesh.faces.shrink_to_fit();
    Ok(mesh)
}

/// Reads three columns of an element.
pub(super) fn read_columns(
    bytes: &[u8],
    header: &Header,
    name: &[u8],
    columns: [usize; 3],
) -> Result<Vec<[f64; 3]>, Problem> {
    let mut rows = Rows { text: bytes, at: header.body };
    let mut vectors = Vec::new();
    for element in &header.elements {
        let wanted = element.name == name;
        rows.each(element, |row| {
            let mut vector = [0.0; 3];
            for (column, property) in element.properties.iter().enumerate() {
                match columns.iter().position(|&c| wanted && c == column) {
                    Some(axis) => vector[axis] = row.number()?,
                    None => row.skip(property.kind)?,
                }
            }
            if wanted {
                vectors.push(vector);
            }
            Ok(())
        })?;
    }
    Ok(vectors)
}

/// A position in the body.
struct Rows<'a> {
    text: &'a [u8],
    at: usize,
}

impl Rows<'_> {
    /// Calls `read` at the start of each row of an element and checks that it reads the whole row.
    fn each(
        &mut self,
        element: &Element,
        mut read: impl FnMut(&mut Self) -> Result<(), Problem>,
    ) -> Result<(), Problem> {
        if element.properties.is_empty() {
            return Ok(());
        }
        for row in 0..element.count {
            while self.text.get(self.at).is_some_and(u8::is_ascii_whitespace) {
                self.at += 1;
            }
            if self.at == self.text.len() {
                let name = element.name.escape_ascii();
                return Err(Problem::new(
                    self.at,
                    format!(
                        "found the end of the file after {row} rows of element {name}, expected {}",
                        element.count
                    ),
                ));
            }
            read(self)?;
            self.skip_blanks();
            if self.text.get(self.at).is_some_and(|&b| !is_line_end(b)) {
                let found = quoted(word(self.text, self.at));
                return Err(Problem::new(self.at, format!("found {found}, expected the end of the line")));
            }
            self.at = next_line(self.text, self.at);
        }
        Ok(())
    }

    fn skip_blanks(&mut self) {
        while self.text.get(self.at).is_some_and(|&b| is_blank(b)) {
            self.at += 1;
        }
    }

    fn coordinate(&mut self) -> Result<f64, Problem> {
        self.skip_blanks();
        let (value, end) = coordinate(self.text, self.at)?;
        self.at = end;
        Ok(value)
    }

    /// Any number, NaN and infinities included.
    fn number(&mut self) -> Result<f64, Problem> {
        self.skip_blanks();
        let Some((value, end)) = number(self.text, self.at) else {
            let found = quoted(word(self.text, self.at));
            return Err(Problem::new(self.at, format!("found {found}, expected a number")));
        };
        self.at = end;
        Ok(value)
    }

    fn skip(&mut self, kind: Kind) -> Result<(), Problem> {
        let values = match kind {
            Kind::Scalar(_) => 1,
            Kind::List { .. } => self.whole_number(0, "a count")?,
        };
        for _ in 0..values {
            self.skip_blanks();
            let skipped = word(self.text, self.at);
            if skipped.is_empty() {
                return Err(Problem::new(self.at, "found the end of the line, expected another number"));
            }
            self.at += skipped.len();
        }
        Ok(())
    }

    /// A list of vertex indices; in strips a negative index is a separator.
    fn indices(&mut self, indices: &mut Vec<i64>, vertices: u64, strips: bool) -> Result<(), Problem> {
        indices.clear();
        for _ in 0..self.whole_number(0, "a number of corners")? {
            let lowest = if strips { i64::MIN } else { 0 };
            let index = self.whole_number(lowest, "a vertex index")?;
            if index >= 0 && index.cast_unsigned() >= vertices {
                return Err(Problem::new(
                    self.at,
                    format!(
                        "found vertex index {index}, but there are only {vertices} vertices (the first is 0)"
                    ),
                ));
            }
            indices.push(index);
        }
        Ok(())
    }

    fn whole_number(&mut self, lowest: i64, what: &str) -> Result<i64, Problem> {
        self.skip_blanks();
        match whole_number(self.text, self.at) {
            Some((value, end)) if value >= lowest => {
                self.at = end;
                Ok(value)
            }
            _ => {
                let found = quoted(word(self.text, self.at));
                Err(Problem::new(self.at, format!("found {found}, expected {what}")))
            }
        }
    }
}
