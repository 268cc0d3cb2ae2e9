//! The statements in one piece of an OBJ file.

use crate::groups::Mark;
use crate::polygon::Polygon;
use crate::text::{Problem, coordinate, is_blank, is_line_end, next_line, past_line_end, quoted, word};

/// Vertices and faces of one piece. Relative indices are resolved when the pieces are joined.
#[derive(Default)]
pub(super) struct Piece {
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) faces: Vec<[u32; 3]>,
    /// See [`RawMesh::polygons`](crate::raw::RawMesh::polygons); `first` counts within the piece.
    pub(super) polygons: Vec<Polygon>,
    /// Corners with negative indices, which can be resolved once the number of vertices before the piece is known.
    pub(super) relative: Vec<RelativeCorner>,
    pub(super) faces_dropped: u64,
    /// Names of groups and objects, each with the number of the first face after it.
    pub(super) marks: Vec<(usize, Mark)>,
    /// The largest index that is not relative.
    pub(super) largest_index: u32,
}

/// A triangle's corner whose index counts back from the last vertex.
#[derive(Clone, Copy)]
pub(super) struct RelativeCorner {
    pub(super) face: usize,
    pub(super) corner: usize,
    /// The index as written, below 0.
    pub(super) written: i64,
    /// The number of vertices in this piece before the face.
    pub(super) vertices_before: usize,
    /// Where it is written.
    pub(super) offset: usize,
}

#[derive(Clone, Copy, Default)]
struct Corner {
    index: u32,
    /// The index as written and its offset if it is negative, otherwise (0, 0).
    relative: (i64, usize),
}

impl Piece {
    pub(super) fn clear(&mut self) {
        self.positions.clear();
        self.faces.clear();
        self.polygons.clear();
        self.relative.clear();
        self.faces_dropped = 0;
        self.marks.clear();
        self.largest_index = 0;
    }

    /// Reads the statements of `text`, which ends at the end of a statement. Absolute indices must be at most `vertices`.
    pub(super) fn parse(&mut self, text: &[u8], vertices: u32) -> Result<(), Problem> {
        let mut at = 0;
        while let Some(&byte) = text.get(at) {
            at = match byte {
                b' ' | b'\t' | b'\n' | b'\r' => at + 1,
                b'v' if ends_keyword(text, at + 1) => self.vertex(text, at + 1)?,
                b'f' if ends_keyword(text, at + 1) => self.face(text, at + 1, vertices)?,
                b'#' => next_line(text, at),
                b'g' | b'o' if ends_keyword(text, at + 1) => self.mark(text, at),
                _ => skipped_statement(text, at)?,
            };
        }
        Ok(())
    }

    #[inline]
    fn vertex(&mut self, text: &[u8], mut at: usize) -> Result<usize, Problem> {
        let mut position = [0.0; 3];
        for x in &mut position {
            at = skip_blanks(text, at);
            (*x, at) = coordinate(text, at)?;
        }
        self.positions.push(position);
        // A weight or a colour may follow.
        Ok(if text.get(at) == Some(&b'\n') { at + 1 } else { end_of_statement(text, at) })
    }

    /// A statement that assigns the faces after it to groups or an object.
    #[cold]
    fn mark(&mut self, text: &[u8], at: usize) -> usize {
        let end = end_of_statement(text, at);
        let statement = String::from_utf8_lossy(&text[at + 1..end]);
        let statement = statement.split('#').next().unwrap_or_default();
        // A continued line also ends a word.
        let mut words =
            statement.split(|c: char| c.is_whitespace() || c == '\\').filter(|word| !word.is_empty());
        let mark = if text[at] == b'g' {
            Mark::Groups(words.map(str::to_owned).collect())
        } else {
            let first = words.next().unwrap_or_default().to_owned();
            Mark::Object(words.fold(first, |name, word| name + " " + word))
        };
        self.marks.push((self.faces.len(), mark));
        end
    }

    #[inline]
    fn face(&mut self, text: &[u8], mut at: usize, vertices: u32) -> Result<usize, Problem> {
        let (mut first, mut previous) = (Corner::default(), Corner::default());
        let mut corners: u32 = 0;
        loop {
            at = skip_blanks(text, at);
            match text.get(at) {
                None => break,
                Some(&end) if is_line_end(end) => {
                    at = past_line_end(text, at);
                    break;
                }
                Some(b'#') => {
                    at = next_line(text, at);
                    break;
                }
                _ => {}
            }
            let corner;
            (corner, at) = self.corner(text, at, vertices)?;
            corners += 1;
            match corners {
                1 => first = corner,
                2 => previous = corner,
                _ => {
                    self.push_triangle([first, previous, corner]);
                    previous = corner;
                }
            }
        }
        match corners {
            0..=2 => self.faces_dropped += 1,
            3 => {}
            _ => self.polygons.push(Polygon { first: self.faces.len() as u32 - (corners - 2), corners }),
        }
        Ok(at)
    }

    #[inline]
    fn push_triangle(&mut self, corners: [Corner; 3]) {
        if corners.iter().any(|corner| corner.relative.0 != 0) {
            self.note_relative(corners);
        }
        self.faces.push(corners.map(|corner| corner.index));
    }

    fn note_relative(&mut self, corners: [Corner; 3]) {
        for (corner, Corner { relative: (written, offset), .. }) in corners.into_iter().enumerate() {
            if written != 0 {
                self.relative.push(RelativeCorner {
                    face: self.faces.len(),
                    corner,
                    written,
                    vertices_before: self.positions.len(),
                    offset,
                });
            }
        }
    }

    /// One corner of a face: a vertex index, and further indices separated by slashes.
    #[inline]
    fn corner(&mut self, text: &[u8], start: usize, vertices: u32) -> Result<(Corner, usize), Problem> {
        /// Digits of an index that cannot overflow.
        const MOST_DIGITS: usize = 18;
        let negative = text[start] == b'-';
        let digits = start + usize::from(negative);
        let mut at = digits;
        let mut value: u64 = 0;
        while let Some(digit) = text.get(at).map(|b| b.wrapping_sub(b'0')).filter(|&digit| digit <= 9) {
            value = value.wrapping_mul(10).wrapping_add(u64::from(digit));
            at += 1;
        }
        let whole = at > digits && at - digits <= MOST_DIGITS && value > 0;
        match text.get(at) {
            _ if !whole => return Err(unusable_index(text, start)),
            Some(b'/') => {
                while text.get(at).is_some_and(|&b| b > b' ' && b != b'\\' && b != b'#') {
                    at += 1;
                }
            }
            None | Some(b' ' | b'\t' | b'\n' | b'\r' | b'\\' | b'#') => {}
            _ => return Err(unusable_index(text, start)),
        }
        if negative {
            return Ok((Corner { index: 0, relative: (-value.cast_signed(), start) }, at));
        }
        if value > u64::from(vertices) {
            return Err(Problem::new(
                start,
                format!("found vertex index {value}, but there are only {vertices} vertices"),
            ));
        }
        let index = (value - 1) as u32;
        self.largest_index = self.largest_index.max(index);
        Ok((Corner { index, relative: (0, 0) }, at))
    }
}

#[cold]
fn unusable_index(text: &[u8], at: usize) -> Problem {
    let word = quoted(word(text, at));
    Problem::new(
        at,
        format!("found {word}, expected a vertex index (the first vertex is 1, the last one -1)"),
    )
}

fn ends_keyword(text: &[u8], at: usize) -> bool {
    text.get(at).is_none_or(|&b| is_blank(b) || is_line_end(b) || b == b'\\')
}

/// Skips blanks and continued line ends.
#[inline]
fn skip_blanks(text: &[u8], mut at: usize) -> usize {
    loop {
        match text.get(at) {
            Some(b' ' | b'\t') => at += 1,
            Some(b'\\') => match text.get(at + 1) {
                None => return at + 1,
                Some(&end) if is_line_end(end) => at = past_line_end(text, at + 1),
                _ => return at,
            },
            _ => return at,
        }
    }
}

/// The offset after the statement at `at`, including continued lines.
fn end_of_statement(text: &[u8], mut at: usize) -> usize {
    loop {
        let end = memchr::memchr2(b'\n', b'\r', &text[at..]).map_or(text.len(), |n| at + n);
        let rest = &text[at..end];
        at = if end < text.len() { past_line_end(text, end) } else { end };
        if at == text.len() || !rest.ends_with(b"\\") || rest.contains(&b'#') {
            return at;
        }
    }
}

/// Skips a statement that does not affect the surface; rejects anything that is no statement.
fn skipped_statement(text: &[u8], at: usize) -> Result<usize, Problem> {
    let keyword = word(text, at);
    let keyword = keyword.strip_suffix(b"\\").unwrap_or(keyword);
    if keyword == b"curv2" || keyword.iter().all(|b| b.is_ascii_alphabetic() || *b == b'_') {
        Ok(end_of_statement(text, at))
    } else {
        Err(Problem::new(at, format!("found {}, expected an OBJ statement such as v or f", quoted(keyword))))
    }
}
