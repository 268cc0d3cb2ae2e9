//! Geomview object file format, ascii.
//!
//! Reads files that begin with `OFF` after any of the prefixes `ST`, `C` and `N`, or directly with the counts if the suffix is
//! `.off`. Every vertex and every face is on a line of its own; anything after the three coordinates or the corners (normals,
//! colours, texture coordinates) is skipped. `#` begins a comment.

use crate::error::FormatError;
use crate::raw::RawMesh;
use crate::text::{Problem, coordinate, is_blank, next_line, quoted, whole_number, word};

/// Bytes of the shortest line of a vertex or face: three digits, two blanks and a line end.
const SHORTEST_LINE: usize = 6;

/// Whether `word` is `OFF` after any of the prefixes `ST`, `C`, `N`, `4` and `n`.
pub(crate) fn is_keyword(word: &[u8]) -> bool {
    prefix(word).is_some()
}

/// The prefixes `4` and `n`, which change the number of coordinates; `None` when `word` is not a keyword.
fn prefix(word: &[u8]) -> Option<&[u8]> {
    let mut rest = word.strip_suffix(b"OFF")?;
    for part in [&b"ST"[..], b"C", b"N"] {
        rest = rest.strip_prefix(part).unwrap_or(rest);
    }
    matches!(rest, b"" | b"4" | b"n" | b"4n").then_some(rest)
}

/// Reads an OFF file.
pub(crate) fn read(bytes: &[u8]) -> Result<RawMesh, FormatError> {
    read_text(bytes).map_err(|problem| problem.in_text(bytes))
}

fn read_text(text: &[u8]) -> Result<RawMesh, Problem> {
    let mut lines = Lines { text, at: if text.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 } };
    lines.keyword()?;
    let vertices = lines.count("a number of vertices")?;
    let faces = lines.count("a number of faces")?;
    lines.end_line();

    let mut mesh = RawMesh::default();
    let most = |promised: u64, at: usize| promised.min(((text.len() - at) / SHORTEST_LINE) as u64) as usize;
    mesh.positions.reserve_exact(most(vertices, lines.at));
    for vertex in 0..vertices {
        lines
            .next_row(|| format!("found the end of the file after {vertex} vertices, expected {vertices}"))?;
        let mut position = [0.0; 3];
        for x in &mut position {
            lines.skip_blanks();
            (*x, lines.at) = coordinate(text, lines.at)?;
        }
        mesh.positions.push(position);
        lines.end_line();
    }
    mesh.faces.reserve(most(faces, lines.at));
    let mut corners = Vec::new();
    for face in 0..faces {
        lines.next_row(|| format!("found the end of the file after {face} faces, expected {faces}"))?;
        corners.clear();
        for _ in 0..lines.count("a number of corners")? {
            let start = lines.at;
            let index = lines.count("a vertex index")?;
            if index >= vertices {
                let problem = format!(
                    "found vertex index {index}, but there are only {vertices} vertices (the first is 0)"
                );
                return Err(Problem::new(start, problem));
            }
            corners.push(index as u32);
        }
        mesh.push_polygon(corners.iter().copied());
        lines.end_line();
    }
    mesh.faces.shrink_to_fit();
    Ok(mesh)
}

/// What the file has besides its surface.
pub(crate) fn left_out(bytes: &[u8]) -> Result<Vec<String>, FormatError> {
    named(bytes).map_err(|problem| problem.in_text(bytes))
}

fn named(text: &[u8]) -> Result<Vec<String>, Problem> {
    let mut lines = Lines { text, at: if text.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 } };
    lines.next_row(|| "found the end of the file, expected OFF".into())?;
    let keyword = word(text, lines.at).to_vec();
    lines.keyword()?;
    let vertices = lines.count("a number of vertices")?;
    let faces = lines.count("a number of faces")?;
    lines.end_line();
    for _ in 0..vertices {
        lines.next_row(|| "found the end of the file, expected a vertex".into())?;
        lines.end_line();
    }
    let mut has_face_colors = false;
    for _ in 0..faces {
        lines.next_row(|| "found the end of the file, expected a face".into())?;
        for _ in 0..lines.count("a number of corners")? {
            lines.count("a vertex index")?;
        }
        lines.skip_blanks();
        has_face_colors |= text.get(lines.at).is_some_and(|b| !b.is_ascii_whitespace() && *b != b'#');
        lines.end_line();
    }
    let before = keyword.strip_suffix(b"OFF").unwrap_or_default();
    let parts = [
        (before.contains(&b'C'), "colours of vertices"),
        (before.contains(&b'N'), "normals"),
        (before.starts_with(b"ST"), "texture coordinates"),
        (has_face_colors, "colours of faces"),
    ];
    Ok(parts.into_iter().filter(|(has, _)| *has).map(|(_, name)| name.to_owned()).collect())
}

struct Lines<'a> {
    text: &'a [u8],
    at: usize,
}

impl Lines<'_> {
    /// Reads the keyword, if there is one, up to the counts.
    fn keyword(&mut self) -> Result<(), Problem> {
        self.next_row(|| "found the end of the file, expected OFF".into())?;
        let keyword = word(self.text, self.at);
        match prefix(keyword) {
            Some(b"") => {}
            Some(_) => {
                let problem = format!(
                    "found {}, expected a keyword for three coordinates, such as OFF",
                    quoted(keyword)
                );
                return Err(Problem::new(self.at, problem));
            }
            None if keyword[0].is_ascii_digit() => return Ok(()),
            None => return Err(Problem::new(self.at, format!("found {}, expected OFF", quoted(keyword)))),
        }
        self.at += keyword.len();
        self.skip_blanks();
        if word(self.text, self.at) == b"BINARY" {
            return Err(Problem::new(
                self.at,
                "found a binary OFF file, expected an ascii one: binary OFF is not read",
            ));
        }
        self.next_row(|| "found the end of the file, expected a number of vertices".into())
    }

    /// Goes to the next word, skipping blank lines and comments.
    fn next_row(&mut self, at_end: impl FnOnce() -> String) -> Result<(), Problem> {
        while let Some(&byte) = self.text.get(self.at) {
            match byte {
                b'#' => self.end_line(),
                byte if byte.is_ascii_whitespace() => self.at += 1,
                _ => return Ok(()),
            }
        }
        Err(Problem::new(self.at, at_end()))
    }

    fn skip_blanks(&mut self) {
        while self.text.get(self.at).is_some_and(|&b| is_blank(b)) {
            self.at += 1;
        }
    }

    fn end_line(&mut self) {
        self.at = next_line(self.text, self.at);
    }

    /// A nonnegative integer on this line.
    fn count(&mut self, what: &str) -> Result<u64, Problem> {
        self.skip_blanks();
        match whole_number(self.text, self.at) {
            Some((value, end)) if value >= 0 => {
                self.at = end;
                Ok(value.cast_unsigned())
            }
            _ => {
                let found = quoted(word(self.text, self.at));
                Err(Problem::new(self.at, format!("found {found}, expected {what}")))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0]];

    #[test]
    fn keywords_colours_comments_and_layouts() {
        for text in [
            "OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 .1\n0 1 0\n3 0 1 2\n4 0 1 2 3\n2 0 1\n",
            "OFF 4 3 0\n0 0 0\n1 0 0\n1 1 .1\n0 1 0\n3 0 1 2\n4 0 1 2 3\n2 0 1",
            "# c\nCOFF # c\n# c\n\n4 3\n0 0 0 1 1 1 1\n1 0 0 9 # c\n\n# c\n1 1 .1 0 0\n0 1 0\n3 0 1 2 255 0 0\n4 0 1 2 3 .1 .2 .3 1\n2 0 1 7\n",
            "STCNOFF\r\n4 3 5 # c\r\n 0\t0 0 1 0 0\r\n1 0 0\r\n1 1 1d-1\r\n0 1 0\r\n3 0 1 2\r\n4 0 1 2 3 # c\r\n2 0 1\r\n",
            "\u{feff}4 3 0\r0 0 0\r1 0 0\r1 1 .1\r0 1 0\r3 0 1 2\r4 0 1 2 3\r2 0 1\rtrailer",
        ] {
            let mesh = read(text.as_bytes()).unwrap();
            assert_eq!(mesh.positions, SQUARE, "{text:?}");
            assert_eq!(mesh.faces, [[0, 1, 2], [0, 1, 2], [0, 2, 3]], "{text:?}");
            assert_eq!((mesh.polygons.len(), mesh.faces_dropped), (1, 1), "{text:?}");
        }
    }

    #[test]
    fn keywords_are_told_from_other_words() {
        for keyword in ["OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCN4nOFF", "4OFF", "nOFF"] {
            assert!(is_keyword(keyword.as_bytes()), "{keyword}");
        }
        for word in ["", "off", "OF", "XOFF", "NCOFF", "OFFX"] {
            assert!(!is_keyword(word.as_bytes()), "{word}");
        }
    }

    #[test]
    fn errors_name_the_line() {
        for (text, expected) in [
            ("", "line 1: found the end of the file, expected OFF"),
            ("solid", "line 1: found \"solid\", expected OFF"),
            ("4OFF\n", "line 1: found \"4OFF\", expected a keyword for three coordinates"),
            ("OFF BINARY\n", "line 1: found a binary OFF file"),
            ("OFF\n", "line 2: found the end of the file, expected a number of vertices"),
            ("OFF\n4 x", "line 2: found \"x\", expected a number of faces"),
            ("OFF\n-4 1", "line 2: found \"-4\", expected a number of vertices"),
            ("OFF\n2 1 0\n0 0 0\n0 NaN 0\n", "line 4: found \"NaN\", expected a finite coordinate"),
            ("OFF\n2 1 0\n0 0 0\n0 0\n", "line 4: found the end of the line, expected a coordinate"),
            ("OFF\n2 1 0\n0 0 0\n", "line 4: found the end of the file after 1 vertices, expected 2"),
            ("OFF\n1 1 0\n0 0 0\n3 0 0 1\n", "line 4: found vertex index 1, but there are only 1 vertices"),
            ("OFF\n1 1 0\n0 0 0\n3 0 0 -1\n", "line 4: found \"-1\", expected a vertex index"),
            ("OFF\n1 1 0\n0 0 0\n3 0 0\n", "line 4: found the end of the line, expected a vertex index"),
            ("OFF\n1 2 0\n0 0 0\n3 0 0 0\n", "line 5: found the end of the file after 1 faces, expected 2"),
            ("OFF\n99999999999 9 0\n0 0 0\n", "line 4: found the end of the file after 1 vertices"),
        ] {
            let found = read(text.as_bytes()).unwrap_err().to_string();
            assert!(found.starts_with(expected), "{text:?} gave {found}");
        }
    }
}
