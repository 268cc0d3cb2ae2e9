//! Ascii STL: a statement per line.

use crate::raw::RawMesh;
use crate::text::{Problem, coordinate, is_blank, is_line_end, next_line, quoted, word};
use crate::weld::Welder;

/// How much of the file must look like text with facets.
const LOOK_AHEAD: usize = 1 << 12;

/// Whether the file begins with `solid` and continues as text.
pub(crate) fn looks_like_it(bytes: &[u8]) -> bool {
    let body = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    let head = &body[..body.len().min(LOOK_AHEAD)];
    word(head, 0).eq_ignore_ascii_case(b"solid") && !head.contains(&0)
}

/// The statements that may come next.
#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Outside,
    Solid,
    Facet,
    Loop,
    FacetEnd,
}

impl State {
    const fn expected(self) -> &'static str {
        match self {
            Self::Outside => "solid",
            Self::Solid => "facet or endsolid",
            Self::Facet => "outer loop",
            Self::Loop => "vertex or endloop",
            Self::FacetEnd => "endfacet",
        }
    }
}

pub(super) fn read(bytes: &[u8]) -> Result<RawMesh, Problem> {
    let mut mesh = RawMesh::default();
    let mut welder = Welder::default();
    let mut corners: Vec<u32> = Vec::new();
    let mut state = State::Outside;
    let mut at = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
    while let Some(&byte) = bytes.get(at) {
        if byte.is_ascii_whitespace() {
            at += 1;
            continue;
        }
        let start = at;
        let keyword = word(bytes, at);
        at += keyword.len();
        state = match (state, keyword.to_ascii_lowercase().as_slice()) {
            (State::Outside, b"solid") | (State::FacetEnd, b"endfacet") => State::Solid,
            (State::Solid, b"facet") => State::Facet,
            (State::Solid, b"endsolid") => State::Outside,
            (State::Facet, b"outer") => State::Loop,
            (State::Loop, b"vertex") => {
                let mut position = [0.0; 3];
                for x in &mut position {
                    at = skip_blanks(bytes, at);
                    (*x, at) = coordinate(bytes, at)?;
                }
                corners.push(welder.index(position));
                at = skip_blanks(bytes, at);
                if bytes.get(at).is_some_and(|&b| !is_line_end(b)) {
                    let found = quoted(word(bytes, at));
                    return Err(Problem::new(at, format!("found {found}, expected the end of the line")));
                }
                State::Loop
            }
            (State::Loop, b"endloop") => {
                if corners.len() < 3 {
                    let problem = format!("found {} vertices in the loop, expected 3", corners.len());
                    return Err(Problem::new(start, problem));
                }
                mesh.push_polygon(corners.drain(..));
                State::FacetEnd
            }
            _ => {
                let problem = format!("found {}, expected {}", quoted(keyword), state.expected());
                return Err(Problem::new(start, problem));
            }
        };
        at = next_line(bytes, at);
    }
    if state != State::Outside {
        let problem = format!("found the end of the file, expected {}", state.expected());
        return Err(Problem::new(bytes.len(), problem));
    }
    mesh.positions = welder.into_positions();
    mesh.faces.shrink_to_fit();
    Ok(mesh)
}

fn skip_blanks(bytes: &[u8], at: usize) -> usize {
    at + bytes[at..].iter().take_while(|&&b| is_blank(b)).count()
}
