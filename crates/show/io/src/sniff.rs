//! Recognising a format by content.

use crate::format::Format;
use crate::formats::{off, stl};
use crate::text::{is_blank, is_line_end, next_line, word};

/// How much text is searched for statements that distinguish formats.
const LOOK_AHEAD: usize = 1 << 16;

/// The format that the content determines; `None` if it is ambiguous.
pub(crate) fn format(bytes: &[u8]) -> Option<Format> {
    let body = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    if bytes.starts_with(b"glTF") {
        return Some(Format::Glb);
    }
    if bytes.starts_with(b"PK\x03\x04") {
        return Some(Format::ThreeMf);
    }
    if bytes.starts_with(b"ply") && bytes.get(3).is_some_and(|&b| is_blank(b) || is_line_end(b)) {
        return Some(Format::Ply);
    }
    if starts_with_ignoring_case(body, b"# vtk DataFile") {
        return Some(Format::VtkLegacy);
    }
    if stl::is_binary(bytes) {
        return Some(Format::Stl);
    }
    let head = &body[..body.len().min(LOOK_AHEAD)];
    let start = head.iter().position(|b| !b.is_ascii_whitespace()).unwrap_or(head.len());
    let head = &head[start..];
    match head.first() {
        Some(b'<') => return xml(head),
        Some(b'{') => return Some(Format::Gltf),
        _ => {}
    }
    if stl::is_ascii(head) {
        return Some(Format::Stl);
    }
    text(head)
}

fn starts_with_ignoring_case(bytes: &[u8], prefix: &[u8]) -> bool {
    bytes.get(..prefix.len()).is_some_and(|start| start.eq_ignore_ascii_case(prefix))
}

fn xml(head: &[u8]) -> Option<Format> {
    for (mark, format) in [(&b"PolyData"[..], Format::Vtp), (b"UnstructuredGrid", Format::Vtu)] {
        if memchr::memmem::find(head, b"VTKFile").is_some() && memchr::memmem::find(head, mark).is_some() {
            return Some(format);
        }
    }
    None
}

/// OFF by its keyword, OBJ by its first statement.
fn text(head: &[u8]) -> Option<Format> {
    let mut at = 0;
    while let Some(&byte) = head.get(at) {
        if byte.is_ascii_whitespace() {
            at += 1;
            continue;
        }
        if byte == b'#' {
            at = next_line(head, at);
            continue;
        }
        let keyword = word(head, at);
        if off::is_keyword(keyword) {
            return Some(Format::Off);
        }
        return match keyword {
            b"v" | b"vt" | b"vn" | b"vp" | b"f" | b"mtllib" | b"usemtl" | b"o" | b"g" | b"s" => {
                Some(Format::Obj)
            }
            _ => None,
        };
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_decides() {
        let mut stl = b"solid but binary".to_vec();
        stl.resize(84, 0);
        stl[80] = 1;
        stl.resize(134, 7);
        for (bytes, expected) in [
            (&b"ply\nformat"[..], Some(Format::Ply)),
            (b"glTF\x02", Some(Format::Glb)),
            (b"PK\x03\x04\x14", Some(Format::ThreeMf)),
            (b"# vtk DataFile Version 3.0", Some(Format::VtkLegacy)),
            (&stl, Some(Format::Stl)),
            (b"solid x\n facet normal", Some(Format::Stl)),
            (b"# c\n\nSTCN4OFF\n", Some(Format::Off)),
            (b"COFF 3 1 0", Some(Format::Off)),
            (b"<?xml version='1'?><VTKFile type=\"PolyData\"", Some(Format::Vtp)),
            (b"{\"asset\"", Some(Format::Gltf)),
            (b"\xEF\xBB\xBF# c\nmtllib a\nv 0 0 0", Some(Format::Obj)),
            (b"8 6 12\n", None),
            (b"hello", None),
            (b"", None),
        ] {
            assert_eq!(format(bytes), expected, "{}", bytes.escape_ascii());
        }
    }
}
