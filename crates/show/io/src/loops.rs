//! Closed polygons, read from a file.

use crate::error::{FormatError, Location, ReadError};
use crate::source;
use crate::text::quoted;
use pompeiu_core::TriMesh;
use std::path::Path;

/// Reads closed polygons: the lines (`l`) of an OBJ file, or a text with one point per line and an empty line between polygons.
///
/// In a text the three coordinates are separated by commas, semicolons or blanks, and `#` begins a comment. A last point that
/// repeats the first is dropped.
///
/// # Errors
/// [`ReadError`] names the file, the place, what was found and what was expected.
/// # Limits
/// Polygons may have fewer than three points.
pub fn read_loops(path: impl AsRef<Path>) -> Result<Vec<Vec<[f64; 3]>>, ReadError> {
    let path = path.as_ref();
    let bytes = source::open(path).map_err(|cause| ReadError::Io { path: path.to_owned(), cause })?;
    from_bytes(&bytes).map_err(|cause| ReadError::Format { path: path.to_owned(), cause })
}

fn from_bytes(bytes: &[u8]) -> Result<Vec<Vec<[f64; 3]>>, FormatError> {
    let (content, _) = source::decompressed(bytes)?;
    let mut reader = Reader::default();
    for (i, line) in content.split(|b| *b == b'\n').enumerate() {
        let line = line.split(|b| *b == b'#').next().unwrap_or_default();
        let separates = |b: &u8| b.is_ascii_whitespace() || matches!(b, b',' | b';');
        let words: Vec<&[u8]> = line.split(separates).filter(|word| !word.is_empty()).collect();
        reader.line(&words).map_err(|problem| FormatError::new(Location::Line(i as u64 + 1), problem))?;
    }
    let mut loops = reader.loops;
    for polygon in &mut loops {
        if polygon.len() > 1 && polygon.first() == polygon.last() {
            polygon.pop();
        }
    }
    loops.retain(|polygon| !polygon.is_empty());
    if loops.is_empty() {
        return Err(FormatError::new(
            Location::File,
            "found no polygon, expected points or the lines of an OBJ file",
        ));
    }
    Ok(loops)
}

#[derive(Default)]
struct Reader {
    loops: Vec<Vec<[f64; 3]>>,
    /// The vertices of an OBJ file.
    vertices: Vec<[f64; 3]>,
    /// Whether the previous line was a point of a text.
    in_polygon: bool,
}

impl Reader {
    fn line(&mut self, words: &[&[u8]]) -> Result<(), String> {
        match words {
            [] => self.in_polygon = false,
            [b"v", coordinates @ ..] if coordinates.len() >= 3 => {
                self.vertices.push(point(&coordinates[..3])?);
            }
            [b"l", indices @ ..] => {
                let polygon: Result<_, _> = indices.iter().map(|word| self.vertex(word)).collect();
                self.loops.push(polygon?);
            }
            // Other statements of OBJ.
            [first, ..] if first[0].is_ascii_alphabetic() && !self.vertices.is_empty() => {}
            [first, ..] if matches!(*first, b"o" | b"g" | b"s" | b"mtllib" | b"usemtl") => {}
            coordinates => {
                let p = point(coordinates)?;
                if !std::mem::replace(&mut self.in_polygon, true) {
                    self.loops.push(Vec::new());
                }
                if let Some(polygon) = self.loops.last_mut() {
                    polygon.push(p);
                }
            }
        }
        Ok(())
    }

    /// The vertex with an OBJ index, from 1 on or negative from the last one back.
    fn vertex(&self, word: &[u8]) -> Result<[f64; 3], String> {
        let name = word.split(|b| *b == b'/').next().unwrap_or_default();
        let index = std::str::from_utf8(name).ok().and_then(|text| text.parse::<i64>().ok());
        let place = match index {
            Some(i) if i > 0 => usize::try_from(i - 1).ok(),
            Some(i) if i < 0 => {
                usize::try_from(i.unsigned_abs()).ok().and_then(|i| self.vertices.len().checked_sub(i))
            }
            _ => None,
        };
        let found = place.and_then(|i| self.vertices.get(i));
        let count = self.vertices.len();
        found
            .copied()
            .ok_or_else(|| format!("found {}, expected the number of one of {count} vertices", quoted(word)))
    }
}

fn point(words: &[&[u8]]) -> Result<[f64; 3], String> {
    let [x, y, z] = words else {
        return Err(format!("found {} words, expected the three coordinates of a point", words.len()));
    };
    let coordinate = |word: &[u8]| match fast_float2::parse::<f64, _>(word) {
        Ok(value) if value.abs() <= TriMesh::MAX_COORDINATE => Ok(value),
        _ => Err(format!("found {}, expected a finite coordinate", quoted(word))),
    };
    Ok([coordinate(x)?, coordinate(y)?, coordinate(z)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_and_lines_of_obj() {
        let square = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.5]];
        let other = vec![[0.0, 0.0, 3.0], [1.0, 0.0, 3.0], [0.0, 2.0, 3.0]];
        let text = b"# two wires\n0 0 0\n1,0,0\n1; 1; .5 # high\n0 0 0\n\n\n0 0 3\r\n1 0 3\r\n0 2 3\r\n";
        assert_eq!(from_bytes(text), Ok(vec![square.clone(), other]));
        let obj = b"o wire\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 1 1 .5\ns off\nl 1 2/2 -1 1\n";
        assert_eq!(from_bytes(obj), Ok(vec![square]));
    }

    #[test]
    fn what_is_no_polygon_is_named_with_its_line() {
        for (text, says) in [
            (&b""[..], "found no polygon"),
            (b"0 0 0\n1 2\n", "line 2: found 2 words"),
            (b"0 0 x\n", "line 1: found \"x\""),
            (b"0 0 nan\n", "line 1: found \"nan\""),
            (b"v 0 0 0\nl 1 2\n", "line 2: found \"2\", expected the number of one of 1 vertices"),
            (b"v 0 0 0\nl 0\n", "line 2: found \"0\""),
            (b"v 0 0 0\nl -9223372036854775808\n", "line 2: found"),
            (b"\xff\xfe 0 0\n", "line 1: found"),
        ] {
            let error = from_bytes(text).unwrap_err().to_string();
            assert!(error.starts_with(says), "{error}");
        }
    }
}
