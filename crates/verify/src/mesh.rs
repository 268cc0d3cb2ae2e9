//! Small readers of OBJ, STL and PLY: triangles as the file states them, nothing else. Polygons with more than three corners are
//! refused, for they are not one surface.

use crate::kernel::Point;

/// Positions and faces of a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions in the order of the file; of STL, three for each face.
    pub positions: Vec<Point>,
    /// Triangles in the order of the file.
    pub faces: Vec<[u32; 3]>,
}

type Read<T> = Result<T, String>;

/// Reads a file by its content: PLY and STL say what they are, OBJ is what else has vertices and faces.
///
/// # Errors
/// A sentence that says what was found.
pub fn read(bytes: &[u8]) -> Read<Mesh> {
    let binary_length =
        bytes.get(80..84).map(|n| 84 + 50 * u64::from(u32::from_le_bytes([n[0], n[1], n[2], n[3]])));
    let mesh = if bytes.starts_with(b"ply") {
        ply(bytes)?
    } else if binary_length == Some(bytes.len() as u64) {
        stl_binary(&bytes[84..])
    } else if bytes.trim_ascii_start().starts_with(b"solid") {
        stl_text(bytes)?
    } else {
        obj(bytes)?
    };
    if mesh.faces.is_empty() {
        return Err("the file has no triangles; OBJ, STL and PLY are read".to_owned());
    }
    Ok(mesh)
}

fn number<T: std::str::FromStr>(word: Option<&[u8]>) -> Read<T> {
    let text = word.and_then(|word| std::str::from_utf8(word).ok()).unwrap_or("nothing");
    text.parse().map_err(|_| format!("found {text}, expected a number"))
}

fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

fn point<'t>(words: &mut impl Iterator<Item = &'t [u8]>) -> Read<Point> {
    Ok([number(words.next())?, number(words.next())?, number(words.next())?])
}

fn lines(bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    bytes.split(|b| matches!(b, b'\n' | b'\r'))
}

fn obj(bytes: &[u8]) -> Read<Mesh> {
    let mut mesh = Mesh::default();
    for line in lines(bytes) {
        let mut words = words(line);
        match words.next() {
            Some(b"v") => mesh.positions.push(point(&mut words)?),
            Some(b"f") => {
                let mut corners = words.take_while(|word| word[0] != b'#').map(|word| {
                    let index: i64 = number(word.split(|b| *b == b'/').next())?;
                    let from_one =
                        if index < 0 { mesh.positions.len().cast_signed() as i64 + index + 1 } else { index };
                    u32::try_from(from_one - 1).map_err(|_| format!("found vertex {index} in a face"))
                });
                let mut corner =
                    || corners.next().unwrap_or_else(|| Err("found a face with few corners".into()));
                mesh.faces.push([corner()?, corner()?, corner()?]);
                if corners.next().is_some() {
                    return Err("found a face with more than three corners, which is not one surface".into());
                }
            }
            Some(_) if line.ends_with(b"\\") && !line.starts_with(b"#") => {
                return Err("found a statement that goes on in the next line".into());
            }
            _ => {}
        }
    }
    Ok(mesh)
}

fn push_triangle(mesh: &mut Mesh, corners: [Point; 3]) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(corners);
    mesh.faces.push([first, first + 1, first + 2]);
}

fn stl_binary(body: &[u8]) -> Mesh {
    let mut mesh = Mesh::default();
    for triangle in body.chunks_exact(50) {
        let number = |i: usize| {
            let at = 12 + 4 * i;
            f64::from(f32::from_le_bytes([
                triangle[at],
                triangle[at + 1],
                triangle[at + 2],
                triangle[at + 3],
            ]))
        };
        push_triangle(&mut mesh, [0, 3, 6].map(|i| [number(i), number(i + 1), number(i + 2)]));
    }
    mesh
}

fn stl_text(bytes: &[u8]) -> Read<Mesh> {
    let (mut mesh, mut corners) = (Mesh::default(), Vec::new());
    for line in lines(bytes) {
        let mut words = words(line);
        let keyword = words.next().map(<[u8]>::to_ascii_lowercase);
        match keyword.as_deref() {
            Some(b"vertex") => corners.push(point(&mut words)?),
            Some(b"endloop") => {
                let triangle = corners.as_slice().try_into();
                push_triangle(&mut mesh, triangle.map_err(|_| "found a loop without three vertices")?);
                corners.clear();
            }
            _ => {}
        }
    }
    if corners.is_empty() { Ok(mesh) } else { Err("found vertices outside of a loop".into()) }
}

/// The body of a PLY file: text, or numbers in one order of bytes.
struct Body<'b> {
    bytes: &'b [u8],
    format: &'b [u8],
}

impl Body<'_> {
    fn scalar(&mut self, kind: &[u8]) -> Read<f64> {
        if self.format == b"ascii" {
            self.bytes = self.bytes.trim_ascii_start();
            let end = self.bytes.iter().position(u8::is_ascii_whitespace).unwrap_or(self.bytes.len());
            let (word, rest) = self.bytes.split_at(end);
            self.bytes = rest;
            return number(Some(word));
        }
        let size = match kind {
            b"char" | b"int8" | b"uchar" | b"uint8" => 1,
            b"short" | b"int16" | b"ushort" | b"uint16" => 2,
            b"int" | b"int32" | b"uint" | b"uint32" | b"float" | b"float32" => 4,
            b"double" | b"float64" => 8,
            _ => return Err(format!("found the type {}", String::from_utf8_lossy(kind))),
        };
        let (word, rest) = self.bytes.split_at_checked(size).ok_or("found an early end of the file")?;
        self.bytes = rest;
        let mut raw = [0; 8];
        raw[..size].copy_from_slice(word);
        if self.format == b"binary_big_endian" {
            raw[..size].reverse();
        }
        let bits = u64::from_le_bytes(raw);
        Ok(match kind {
            b"float" | b"float32" => f64::from(f32::from_bits(bits as u32)),
            b"double" | b"float64" => f64::from_bits(bits),
            // Whole numbers: of the signed ones the sign is spread from the highest bit.
            [b'u', ..] => bits as f64,
            _ => ((bits << (64 - 8 * size)).cast_signed() >> (64 - 8 * size)) as f64,
        })
    }
}

/// Name, number of rows, and the words of each property.
type Element<'h> = (&'h [u8], u64, Vec<Vec<&'h [u8]>>);

fn ply(bytes: &[u8]) -> Read<Mesh> {
    let (mut mesh, mut rest) = (Mesh::default(), bytes);
    let mut elements: Vec<Element> = Vec::new();
    let mut format: &[u8] = b"";
    loop {
        let end = rest.iter().position(|b| *b == b'\n').ok_or("found no end of the header")?;
        let statement: Vec<&[u8]> = words(&rest[..end]).collect();
        rest = &rest[end + 1..];
        match statement.as_slice() {
            [b"end_header"] => break,
            [b"format", name, ..] => format = name,
            [b"element", name, count] => elements.push((name, number(Some(count))?, Vec::new())),
            [b"property", property @ ..] if property.len() >= 2 => {
                elements.last_mut().ok_or("found a property of no element")?.2.push(property.to_vec());
            }
            _ => {}
        }
    }
    if !matches!(format, b"ascii" | b"binary_little_endian" | b"binary_big_endian") {
        return Err("found no format of PLY".into());
    }
    let mut body = Body { bytes: rest, format };
    for (element, count, properties) in elements.iter().filter(|element| !element.2.is_empty()) {
        for _ in 0..*count {
            let (mut position, mut face) = ([f64::NAN; 3], Vec::new());
            for property in properties {
                if let [b"list", size, item, name] = property.as_slice() {
                    let size = body.scalar(size)?;
                    let is_face = matches!(*name, b"vertex_indices" | b"vertex_index");
                    if is_face && size != 3.0 {
                        return Err("found a face without exactly three corners".into());
                    }
                    for _ in 0..size as u64 {
                        let x = body.scalar(item)?;
                        face.extend(is_face.then_some(x));
                    }
                } else {
                    let x = body.scalar(property[0])?;
                    if let Some(axis) = [b"x", b"y", b"z"].iter().position(|axis| property[1] == *axis) {
                        position[axis] = x;
                    }
                }
            }
            if *element == b"vertex" {
                mesh.positions.push(position);
            } else if let [i, j, k] = face[..] {
                let is_index = [i, j, k].iter().all(|x| *x >= 0.0 && *x < f64::from(u32::MAX));
                if !is_index || *element != b"face" {
                    return Err("found a face with an index that is none".into());
                }
                mesh.faces.push([i as u32, j as u32, k as u32]);
            }
        }
    }
    Ok(mesh)
}
