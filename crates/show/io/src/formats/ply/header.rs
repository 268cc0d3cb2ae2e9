//! The header of a PLY file.

use crate::text::{Problem, is_blank, is_line_end, quoted};

/// Far more elements than any real file has; the limit keeps searches short.
const MOST_ELEMENTS: usize = 100;

/// How the body is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// A number type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

/// The type of a property.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Scalar),
    List { count: Scalar, item: Scalar },
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: Vec<u8>,
    pub(super) kind: Kind,
}

/// A table whose rows have the same properties.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: Vec<u8>,
    /// The number of rows according to the header.
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
    /// The offset of its declaration.
    pub(super) offset: usize,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Offset of the body.
    pub(super) body: usize,
}

impl Scalar {
    fn from_name(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::I8,
            b"uchar" | b"uint8" => Self::U8,
            b"short" | b"int16" => Self::I16,
            b"ushort" | b"uint16" => Self::U16,
            b"int" | b"int32" => Self::I32,
            b"uint" | b"uint32" => Self::U32,
            b"float" | b"float32" => Self::F32,
            b"double" | b"float64" => Self::F64,
            _ => return None,
        })
    }

    /// Bytes in a binary file.
    pub(super) const fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }
}

impl Element {
    pub(super) fn property(&self, names: &[&[u8]]) -> Option<usize> {
        self.properties.iter().position(|property| names.contains(&property.name.as_slice()))
    }

    /// The columns of the coordinates.
    pub(super) fn coordinates(&self) -> Result<[usize; 3], Problem> {
        let mut columns = [0; 3];
        for (column, name) in columns.iter_mut().zip(["x", "y", "z"]) {
            *column = self
                .property(&[name.as_bytes()])
                .filter(|&column| matches!(self.properties[column].kind, Kind::Scalar(_)))
                .ok_or_else(|| {
                    Problem::new(
                        self.offset,
                        format!("found no number {name} in element vertex, expected x, y and z"),
                    )
                })?;
        }
        Ok(columns)
    }

    /// The column of the list of vertex indices.
    pub(super) fn indices(&self) -> Result<usize, Problem> {
        self.property(&[b"vertex_indices", b"vertex_index"])
            .filter(|&column| matches!(self.properties[column].kind, Kind::List { .. }))
            .ok_or_else(|| {
                let name = quoted(&self.name);
                Problem::new(
                    self.offset,
                    format!(
                        "found no list of indices in element {name}, expected vertex_indices or vertex_index"
                    ),
                )
            })
    }
}

impl Header {
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, Problem> {
        let mut lines = Lines::new(bytes);
        let (offset, first) = lines.next_line()?;
        if first != b"ply" {
            return Err(Problem::new(offset, format!("found {}, expected \"ply\"", quoted(first))));
        }
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        loop {
            let (offset, line) = lines.next_line()?;
            let unexpected = |expected: &str| {
                Err(Problem::new(
                    offset,
                    format!("found {} in the header, expected {expected}", quoted(line)),
                ))
            };
            let words: Vec<&[u8]> = line.split(|&b| is_blank(b)).filter(|word| !word.is_empty()).collect();
            match words.as_slice() {
                [] | [b"comment" | b"obj_info", ..] => {}
                [b"format", name, b"1.0"] => {
                    encoding = Some(match *name {
                        b"ascii" => Encoding::Ascii,
                        b"binary_little_endian" => Encoding::LittleEndian,
                        b"binary_big_endian" => Encoding::BigEndian,
                        _ => return unexpected("format ascii, binary_little_endian or binary_big_endian"),
                    });
                }
                [b"format", ..] => return unexpected("a format and version 1.0"),
                [b"element", name, count] => {
                    let Some(count) = std::str::from_utf8(count).ok().and_then(|count| count.parse().ok())
                    else {
                        return unexpected("element, a name and a count");
                    };
                    if elements.len() == MOST_ELEMENTS {
                        return unexpected("at most 100 elements");
                    }
                    if elements.iter().any(|element| element.name == *name) {
                        return unexpected("each element once");
                    }
                    elements.push(Element { name: name.to_vec(), count, properties: Vec::new(), offset });
                }
                [b"property", rest @ ..] => {
                    let kind = match rest {
                        [b"list", count, item, _] => {
                            match (Scalar::from_name(count), Scalar::from_name(item)) {
                                (Some(count), Some(item)) if !matches!(count, Scalar::F32 | Scalar::F64) => {
                                    Kind::List { count, item }
                                }
                                _ => {
                                    return unexpected(
                                        "property list, a whole number type, a number type and a name",
                                    );
                                }
                            }
                        }
                        [scalar, _] => match Scalar::from_name(scalar) {
                            Some(scalar) => Kind::Scalar(scalar),
                            None => return unexpected("property, a number type such as float and a name"),
                        },
                        _ => return unexpected("property, a type and a name"),
                    };
                    let Some(element) = elements.last_mut() else {
                        return unexpected("element before property");
                    };
                    let name = rest[rest.len() - 1].to_vec();
                    element.properties.push(Property { name, kind });
                }
                [b"end_header"] => break,
                _ => return unexpected("format, comment, element, property or end_header"),
            }
        }
        let Some(encoding) = encoding else {
            return Err(Problem::new(offset, "found no format line in the header, expected one"));
        };
        Ok(Self { encoding, elements, body: lines.at })
    }

    /// The columns of a vector in element `face`.
    pub(super) fn face_vector(&self, wanted: Option<&str>) -> Result<[usize; 3], Problem> {
        let Some(element) = self.element(b"face") else {
            return Err(Problem::new(self.body, "found no element face, expected one with vectors"));
        };
        let columns_of = |stem: &[u8]| -> Option<[usize; 3]> {
            let column = |axis: &[u8]| {
                element
                    .property(&[&[stem, axis].concat()])
                    .filter(|&column| matches!(element.properties[column].kind, Kind::Scalar(_)))
            };
            Some([column(b"x")?, column(b"y")?, column(b"z")?])
        };
        if let Some(name) = wanted {
            let stems = [[name.as_bytes(), b"_"].concat(), name.as_bytes().to_vec()];
            return stems.iter().find_map(|stem| columns_of(stem)).ok_or_else(|| {
                let text = format!("found no properties {name}_x, {name}_y and {name}_z in element face");
                Problem::new(element.offset, text)
            });
        }
        // Normals are not vector fields.
        let stems =
            element.properties.iter().filter_map(|p| p.name.strip_suffix(b"x")).filter(|s| *s != b"n");
        let found: Vec<([usize; 3], &[u8])> =
            stems.filter_map(|stem| Some((columns_of(stem)?, stem))).collect();
        match found[..] {
            [(columns, _)] => Ok(columns),
            [] => Err(Problem::new(
                element.offset,
                "found no vectors in element face, such as u_x, u_y and u_z",
            )),
            _ => {
                let name = |stem: &[u8]| String::from_utf8_lossy(stem).trim_end_matches('_').to_owned();
                let names: Vec<_> = found.iter().map(|(_, stem)| name(stem)).collect();
                let text =
                    format!("found several vectors in element face ({}); name one of them", names.join(", "));
                Err(Problem::new(element.offset, text))
            }
        }
    }

    /// The columns of the colours in element `vertex`, and the greatest value of each.
    pub(super) fn vertex_colors(&self) -> Option<([usize; 3], [f64; 3])> {
        let element = self.element(b"vertex")?;
        let column = |name: &[u8]| {
            let column = element.property(&[name, &[b"diffuse_", name].concat()])?;
            let Kind::Scalar(scalar) = element.properties[column].kind else { return None };
            let most = match scalar {
                Scalar::I8 | Scalar::U8 | Scalar::I16 | Scalar::I32 | Scalar::U32 => 255.0,
                Scalar::U16 => 65535.0,
                Scalar::F32 | Scalar::F64 => 1.0,
            };
            Some((column, most))
        };
        let [red, green, blue] = [column(b"red")?, column(b"green")?, column(b"blue")?];
        Some(([red.0, green.0, blue.0], [red.1, green.1, blue.1]))
    }

    /// Properties and elements that are not read, in the plural.
    pub(super) fn left_out(&self) -> Vec<String> {
        let colors = self.vertex_colors().map(|(columns, _)| columns);
        let rest = self.elements.iter().filter(|element| element.count > 0).filter_map(|element| {
            let read: Vec<usize> = match &element.name[..] {
                b"vertex" => element.coordinates().ok().into_iter().chain(colors).flatten().collect(),
                b"face" | b"tristrips" => element.indices().ok().into_iter().collect(),
                name => return Some(format!("elements {}", quoted(name))),
            };
            let names = element.properties.iter().enumerate().filter(|(column, _)| !read.contains(column));
            let names: Vec<String> = names.map(|(_, property)| quoted(&property.name)).collect();
            let of = String::from_utf8_lossy(&element.name);
            (!names.is_empty()).then(|| format!("properties {} of element {of}", names.join(", ")))
        });
        rest.collect()
    }

    pub(super) fn element(&self, name: &[u8]) -> Option<&Element> {
        self.elements.iter().find(|element| element.name == name)
    }
}

/// The lines of the header. All end as the first one does, so that a body whose first byte is LF is not skipped.
struct Lines<'a> {
    bytes: &'a [u8],
    at: usize,
    end: &'static [u8],
}

impl<'a> Lines<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let end: &[u8] = match bytes.iter().position(|&b| is_line_end(b)).map(|at| &bytes[at..]) {
            Some([b'\r', b'\n', ..]) => b"\r\n",
            Some([b'\r', ..]) => b"\r",
            _ => b"\n",
        };
        Self { bytes, at: 0, end }
    }

    /// The offset and text of the next line, blanks around it removed.
    fn next_line(&mut self) -> Result<(usize, &'a [u8]), Problem> {
        let offset = self.at;
        let rest = &self.bytes[offset..];
        let Some(length) = memchr::memmem::find(rest, self.end) else {
            return Err(Problem::new(
                self.bytes.len(),
                "found the end of the file in the header, expected end_header",
            ));
        };
        self.at = offset + length + self.end.len();
        Ok((offset, rest[..length].trim_ascii()))
    }
}
