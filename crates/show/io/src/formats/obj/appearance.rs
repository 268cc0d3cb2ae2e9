//! Colours, texture coordinates and materials in an OBJ file, for a mesh that was read from it.

use crate::appearance::{Appearance, CornerValues, Materials, channel};
use crate::error::FormatError;
use crate::text::{Problem, is_blank, number, quoted, whole_number, word};
use pompeiu_core::TriMesh;
use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};

/// Reads the colours, texture coordinates and materials of the vertices and faces of a mesh.
pub(crate) fn read(bytes: &[u8], mesh: &TriMesh) -> Result<Appearance, FormatError> {
    let mut reader = Reader::default();
    let mut start = 0;
    while start < bytes.len() {
        let (line, after) = statement(bytes, start);
        reader.statement(&line, mesh).map_err(|text| Problem::new(start, text).in_text(bytes))?;
        start = after;
    }
    Ok(reader.finish(mesh))
}

/// The statement at `start` without its comment, with continued lines joined, and where the next one begins.
fn statement(bytes: &[u8], start: usize) -> (Cow<'_, [u8]>, usize) {
    let line = |from: usize| {
        let end = memchr::memchr2(b'\n', b'\r', &bytes[from..]).map_or(bytes.len(), |n| from + n);
        let text = &bytes[from..end];
        let comment = memchr::memchr(b'#', text);
        (&text[..comment.unwrap_or(text.len())], comment.is_some(), (end + 1).min(bytes.len()))
    };
    let (text, commented, mut after) = line(start);
    let (false, Some(first)) = (commented, text.strip_suffix(b"\\")) else {
        return (Cow::Borrowed(text), after);
    };
    let mut joined = first.to_vec();
    loop {
        // The LF of a CR LF.
        if bytes[after - 1] == b'\r' && bytes.get(after) == Some(&b'\n') {
            after += 1;
        }
        if after == bytes.len() {
            return (Cow::Owned(joined), after);
        }
        let (text, commented, next) = line(after);
        after = next;
        joined.push(b' ');
        let more = if commented { None } else { text.strip_suffix(b"\\") };
        joined.extend_from_slice(more.unwrap_or(text));
        if more.is_none() {
            return (Cow::Owned(joined), after);
        }
    }
}

#[derive(Default)]
struct Reader {
    vertices: usize,
    /// Colours as written, up to the first vertex without one.
    colors: Vec<[f64; 3]>,
    coordinates: Vec<[f64; 2]>,
    /// One for each face so far; [`NONE`] at corners without texture coordinates.
    corners: Vec<[u32; 3]>,
    library: Option<String>,
    names: Vec<String>,
    known: HashMap<String, u32>,
    material: u32,
    materials: Vec<u32>,
    has_normals: bool,
    has_smoothing: bool,
    groups: BTreeSet<Vec<u8>>,
}

/// No texture coordinates.
const NONE: u32 = u32::MAX;

impl Reader {
    fn statement(&mut self, line: &[u8], mesh: &TriMesh) -> Result<(), String> {
        let line = line.trim_ascii();
        let keyword = word(line, 0);
        let rest = line[keyword.len()..].trim_ascii();
        match keyword {
            b"v" => self.vertex(rest),
            b"vt" => return self.texture_vertex(rest),
            b"f" => return self.face(rest, mesh),
            b"mtllib" if self.library.is_none() => self.library = Some(String::from_utf8_lossy(rest).into()),
            b"vn" => self.has_normals = true,
            b"s" => self.has_smoothing |= !matches!(rest, b"off" | b"0"),
            b"g" | b"o" if !rest.is_empty() => {
                self.groups.insert(rest.to_vec());
            }
            b"usemtl" => self.use_material(&String::from_utf8_lossy(rest)),
            _ => {}
        }
        Ok(())
    }

    fn vertex(&mut self, rest: &[u8]) {
        let numbers: Vec<f64> = numbers(rest).collect();
        // With four or five numbers, the fourth is a weight.
        if let [_, _, _, red, green, blue, ..] = numbers[..]
            && self.colors.len() == self.vertices
        {
            self.colors.push([red, green, blue]);
        }
        self.vertices += 1;
    }

    fn texture_vertex(&mut self, rest: &[u8]) -> Result<(), String> {
        let mut numbers = numbers(rest);
        let u =
            numbers.next().ok_or_else(|| format!("found {}, expected a number", quoted(word(rest, 0))))?;
        self.coordinates.push([u, numbers.next().unwrap_or(0.0)]);
        Ok(())
    }

    fn use_material(&mut self, name: &str) {
        if self.names.is_empty() {
            self.names.push(String::new());
        }
        let next = self.names.len() as u32;
        self.material = *self.known.entry(name.to_owned()).or_insert(next);
        if self.material == next {
            self.names.push(name.to_owned());
        }
    }

    /// Finds the corners of the triangles made of a face.
    fn face(&mut self, rest: &[u8], mesh: &TriMesh) -> Result<(), String> {
        let mut polygon: Vec<(u32, u32)> = Vec::with_capacity(4);
        for corner in rest.split(|b| is_blank(*b)).filter(|corner| !corner.is_empty()) {
            let mut indices = corner.split(|b| *b == b'/');
            let vertex = index(indices.next().unwrap_or_default(), self.vertices, "vertex")?;
            let place = match indices.next().filter(|place| !place.is_empty()) {
                // Faces may refer to later coordinates; whether they exist is checked at the end.
                Some(place) => index(place, self.coordinates.len(), "texture")?,
                None => NONE,
            };
            polygon.push((vertex, place));
        }
        let triangles = polygon.len().saturating_sub(2);
        polygon.sort_unstable();
        polygon.dedup_by_key(|(vertex, _)| *vertex);
        for _ in 0..triangles {
            let Some(face) = mesh.faces().get(self.corners.len()) else {
                return Err("found more faces than before".into());
            };
            self.corners.push(face.map(|v| {
                let corner = polygon.binary_search_by_key(&v, |(vertex, _)| *vertex);
                corner.map_or(NONE, |corner| polygon[corner].1)
            }));
            self.materials.push(self.material);
        }
        Ok(())
    }

    fn finish(mut self, mesh: &TriMesh) -> Appearance {
        let colors = (self.colors.len() == mesh.positions().len()).then(|| {
            // Some programs write channels from 0 to 255.
            let most = if self.colors.iter().flatten().any(|x| *x > 1.0) { 255.0 } else { 1.0 };
            self.colors.iter().map(|color| color.map(|x| channel(x / most))).collect()
        });
        let of_mesh = self.corners.len() == mesh.faces().len();
        let given = self.coordinates.len();
        let mut missing = false;
        let mut named = false;
        for place in self.corners.as_flattened_mut() {
            named |= (*place as usize) < given;
            if *place as usize >= given {
                *place = given as u32;
                missing = true;
            }
        }
        if missing {
            self.coordinates.push([0.0; 2]);
        }
        let texture = (of_mesh && named)
            .then_some(CornerValues { values: self.coordinates, corners: self.corners })
            .into_iter()
            .collect();
        let materials = (of_mesh && !self.names.is_empty()).then_some(Materials {
            library: self.library,
            names: self.names,
            faces: self.materials,
            descriptions: None,
        });
        // Most programs give the only object a name.
        let left_out = [
            (self.has_normals, "normals"),
            (self.has_smoothing, "smoothing groups"),
            (self.groups.len() > 1, "names of groups"),
        ];
        let left_out =
            left_out.into_iter().filter(|(has, _)| *has).map(|(_, name)| name.to_owned()).collect();
        Appearance { colors, texture, materials, left_out, ..Appearance::default() }
    }
}

/// An index as written: from 1 on, or negative relative to the last one so far.
fn index(written: &[u8], so_far: usize, what: &str) -> Result<u32, String> {
    let wrong = || format!("found {}, expected a {what} index", quoted(written));
    let (value, _) = whole_number(written, 0).filter(|(_, end)| *end == written.len()).ok_or_else(wrong)?;
    let size = usize::try_from(value.unsigned_abs()).ok();
    let index = size.and_then(|size| if value < 0 { so_far.checked_sub(size) } else { size.checked_sub(1) });
    index.and_then(|index| u32::try_from(index).ok()).filter(|index| *index != NONE).ok_or_else(wrong)
}

/// The numbers at the start of a text.
fn numbers(text: &[u8]) -> impl Iterator<Item = f64> + '_ {
    let mut at = 0;
    std::iter::from_fn(move || {
        while text.get(at).is_some_and(|b| is_blank(*b)) {
            at += 1;
        }
        let (value, end) = number(text, at)?;
        at = end;
        Some(value)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Appearance {
        let mesh = crate::read_bytes(text.as_bytes(), Some(crate::Format::Obj)).unwrap().mesh;
        read(text.as_bytes(), &mesh).unwrap()
    }

    #[test]
    fn a_cut_polygon_keeps_the_coordinates_of_its_corners() {
        let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt .5 0\nvt .5 \\\n.5\nvt 0 .5\nmtllib a b.mtl\nf 1 2 3\n\
                      usemtl wood\nf 1/1 2/2 3/-2 4/4 # all\nf 1//1 3//1 4\nusemtl tin\nf 4/4 3/3 1/1\nusemtl wood\nf 1 2 3\n";
        let found = of(square);
        let [texture] = &found.texture[..] else { panic!("one set") };
        assert_eq!(texture.values[..4], [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]]);
        assert_eq!(texture.corners[0], [4; 3], "without coordinates");
        let mesh = crate::read_bytes(square.as_bytes(), None).unwrap().mesh;
        for f in [1, 2, 4] {
            assert_eq!(texture.corners[f], mesh.faces()[f], "vertex i has coordinates i");
        }
        let materials = found.materials.unwrap();
        assert_eq!(materials.library.as_deref(), Some("a b.mtl"));
        assert_eq!(materials.names, ["", "wood", "tin"]);
        assert_eq!(materials.faces, [0, 1, 1, 1, 2, 1]);
        assert_eq!(found.colors, None);
    }

    #[test]
    fn colours_behind_coordinates_in_both_ranges() {
        let shares = "v 0 0 0 1 0 .2\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n";
        let found = of(shares);
        assert_eq!(found.colors.unwrap(), [[255, 0, 51], [0, 255, 0], [0, 0, 255]]);
        assert!(found.texture.is_empty() && found.materials.is_none());
        let whole = "v 0 0 0 255 0 51\nv 1 0 0 0 300 nan\nv 0 1 0 0 0 -1\nf 1 2 3\n";
        assert_eq!(of(whole).colors.unwrap(), [[255, 0, 51], [0, 255, 0], [0, 0, 0]]);
        let some = "v 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0 0 0 1\nf 1 2 3\n";
        assert_eq!(of(some).colors, None);
        let weights = "v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n";
        assert_eq!(of(weights).colors, None);
    }

    #[test]
    fn what_is_no_index_is_named_with_its_line() {
        let start = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
        let mesh = crate::read_bytes(start.as_bytes(), None).unwrap().mesh;
        for (corner, line) in [("1/x", 5), ("1/0", 5), ("1/-1", 5), ("1/1.5", 5)] {
            let text = format!("{start}f {corner} 2 3\n");
            let error = read(text.as_bytes(), &mesh).unwrap_err();
            assert_eq!(error.location, crate::Location::Line(line), "{corner}: {error}");
        }
        assert!(read(b"f 1 2 3\nf 1 2 3\n", &mesh).is_err(), "more faces than the mesh has");
    }
}
