//! The XML formats `.vtp` and `.vtu`.

use super::cells::{self, CellArray, CellKind};
use super::markup;
use super::numbers::{ByteOrder, NumberType};
use super::stream::{Packing, Stream};
use crate::error::{FormatError, Location};
use crate::expansion::Allowance;
use crate::formats::Input;
use crate::raw::RawMesh;
use crate::solids::Solids;
use crate::text::line_of;
use memchr::memmem;
use roxmltree::{Document, Node};
use std::borrow::Cow;
use std::cell::Cell;
use std::collections::BTreeSet;

/// Reads `PolyData`.
pub(crate) fn read_poly_data(input: Input<'_>) -> Result<RawMesh, FormatError> {
    read(input, "PolyData", |file, piece, raw: &mut RawMesh| {
        let base = file.add_points(piece, raw)?;
        for (tag, number, kind) in [
            ("Verts", "NumberOfVerts", CellKind::NoSurface),
            ("Lines", "NumberOfLines", CellKind::NoSurface),
            ("Polys", "NumberOfPolys", CellKind::Polygon),
            ("Strips", "NumberOfStrips", CellKind::TriangleStrip),
        ] {
            let count = file.count(piece, number)?;
            if count > 0 {
                let cells = file.cells(child(file, piece, tag)?, count)?;
                cells::add(raw, base, &cells, |_| Ok(kind))?;
            }
        }
        Ok(())
    })
}

/// Reads the surface cells of an `UnstructuredGrid`.
pub(crate) fn read_unstructured_grid(input: Input<'_>) -> Result<RawMesh, FormatError> {
    read(input, "UnstructuredGrid", |file, piece, raw: &mut RawMesh| {
        let base = file.add_points(piece, raw)?;
        let count = file.count(piece, "NumberOfCells")?;
        if count == 0 {
            return Ok(());
        }
        let element = child(file, piece, "Cells")?;
        let cells = file.cells(element, count)?;
        let types = file.counts(array(file, element, "types")?, Some(count))?;
        cells::add(raw, base, &cells, |cell| CellKind::from_number(types[cell]))
    })
}

/// Reads the solid cells of an `UnstructuredGrid`, and the labels of its points.
pub(crate) fn read_solids<const N: usize>(input: Input<'_>) -> Result<Solids<N>, FormatError> {
    read(input, "UnstructuredGrid", |file, piece, grid: &mut Solids<N>| {
        let base = grid.positions.len();
        grid.positions.extend(file.points(piece)?);
        cells::check_point_count(grid.positions.len())?;
        let data = piece.children().find(|node| node.has_tag_name("PointData"));
        let label = |data: Node<'_, '_>| {
            data.children().find(|node| node.attribute("Name") == Some("label")).map(|node| node.id())
        };
        if let Some(label) = data.and_then(label).and_then(|id| piece.document().get_node(id)) {
            let points = (grid.positions.len() - base) as u64;
            grid.labels.get_or_insert_default().extend(file.reals(label, points)?);
        }
        let count = file.count(piece, "NumberOfCells")?;
        if count == 0 {
            return Ok(());
        }
        let element = child(file, piece, "Cells")?;
        let cells = file.cells(element, count)?;
        let types = file.counts(array(file, element, "types")?, Some(count))?;
        grid.add(base, (&cells.corners, &cells.ends), &types)
    })
}

/// The names of all arrays of points and cells, in order.
pub(crate) fn array_names(input: Input<'_>, kind: &str) -> Result<Vec<String>, FormatError> {
    let names: BTreeSet<String> = read(input, kind, |_, piece, names: &mut BTreeSet<String>| {
        let data =
            piece.children().filter(|node| node.has_tag_name("PointData") || node.has_tag_name("CellData"));
        let arrays = data.flat_map(|data| data.children()).filter(Node::is_element);
        names.extend(arrays.filter_map(|array| array.attribute("Name")).map(str::to_owned));
        Ok(())
    })?;
    Ok(names.into_iter().collect())
}

/// Reads the cell vectors with this name, or the only ones.
pub(crate) fn read_cell_vectors(
    input: Input<'_>,
    kind: &str,
    wanted: Option<&str>,
) -> Result<Vec<[f64; 3]>, FormatError> {
    read(input, kind, |file, piece, vectors: &mut Vec<[f64; 3]>| {
        for number in ["NumberOfVerts", "NumberOfLines", "NumberOfStrips"] {
            if file.count(piece, number)? > 0 {
                return Err(file
                    .wrong(piece, "cells beside polygons: which faces the vectors belong to is not known"));
            }
        }
        let cells = file.count(piece, if kind == "PolyData" { "NumberOfPolys" } else { "NumberOfCells" })?;
        if cells == 0 {
            return Ok(());
        }
        let data = child(file, piece, "CellData")?;
        let is_vector = |node: &Node<'_, '_>| {
            node.has_tag_name("DataArray") && node.attribute("NumberOfComponents").map(str::trim) == Some("3")
        };
        let floats =
            |node: &Node<'_, '_>| node.attribute("type").is_some_and(|name| name.starts_with("Float"));
        let found: Vec<_> = data
            .children()
            .filter(is_vector)
            .filter(|node| match wanted {
                Some(name) => node.attribute("Name") == Some(name),
                None => floats(node),
            })
            .collect();
        let array = match (&found[..], wanted) {
            (&[array], _) => array,
            ([], Some(name)) => {
                return Err(file.wrong(data, &format!("no DataArray {name:?} with three components")));
            }
            ([], None) => return Err(file.wrong(data, "no DataArray with three components")),
            (several, _) => {
                let names: Vec<_> = several.iter().filter_map(|node| node.attribute("Name")).collect();
                let names = names.join(", ");
                return Err(file.wrong(data, &format!("several vectors ({names}); name one of them")));
            }
        };
        vectors.extend_from_slice(file.reals(array, cells.saturating_mul(3))?.as_chunks().0);
        Ok(())
    })
}

fn read<T: Default>(
    input: Input<'_>,
    kind: &str,
    add_piece: impl Fn(&File<'_, '_>, Node<'_, '_>, &mut T) -> Result<(), FormatError>,
) -> Result<T, FormatError> {
    let bytes = input.bytes;
    let parts = Parts::of(bytes)?;
    markup::check(&parts.xml)?;
    let document = Document::parse(&parts.xml).map_err(|error| {
        let row = u64::from(error.pos().row);
        // The parser quotes the text it found, line ends included.
        let text = error.to_string().replace(char::is_control, " ");
        let what = &text[..text.rfind(" at ").unwrap_or(text.len())];
        FormatError::new(Location::Line(row), format!("not XML that can be read: {what}"))
    })?;
    let root = document.root_element();
    let appended = root.children().find(|node| node.has_tag_name("AppendedData"));
    let packing = packing(&document, root)?;
    let allowance = match packing.compressor {
        Some(_) => Allowance::of_file(input.stored_bytes),
        None => Allowance::of_content(bytes.len() as u64),
    };
    let file = File {
        bytes,
        packing,
        appended: parts.appended,
        allowance: Cell::new(allowance),
        is_raw: appended.and_then(|node| node.attribute("encoding")) == Some("raw"),
    };
    if root.attribute("type") != Some(kind) || !root.has_tag_name("VTKFile") {
        return Err(file.wrong(root, &format!("expected a VTKFile of the type {kind}")));
    }
    let mut raw = T::default();
    let data = child(&file, root, kind)?;
    for piece in data.children().filter(|node| node.has_tag_name("Piece")) {
        add_piece(&file, piece, &mut raw)?;
    }
    Ok(raw)
}

/// The XML of a file, and the appended data, which may be any bytes.
struct Parts<'a> {
    xml: Cow<'a, str>,
    appended: Option<&'a [u8]>,
}

impl<'a> Parts<'a> {
    fn of(bytes: &'a [u8]) -> Result<Self, FormatError> {
        let text = |bytes: &'a [u8], from: usize| {
            str::from_utf8(bytes).map_err(|error| {
                let line = line_of(bytes, from + error.valid_up_to());
                FormatError::new(Location::Line(line), "text that is not UTF-8")
            })
        };
        let Some(tag) = memmem::find(bytes, b"<AppendedData") else {
            return Ok(Self { xml: Cow::Borrowed(text(bytes, 0)?), appended: None });
        };
        let open = memchr::memchr(b'>', &bytes[tag..]).map(|length| tag + length + 1);
        let close =
            memmem::rfind(bytes, b"</AppendedData").filter(|&close| open.is_some_and(|open| open <= close));
        let (Some(open), Some(close)) = (open, close) else {
            let problem = "the appended data have no end: the file is truncated";
            return Err(FormatError::new(Location::Line(line_of(bytes, tag)), problem));
        };
        let xml = [text(&bytes[..open], 0)?, text(&bytes[close..], close)?].concat();
        let data = bytes[open..close].trim_ascii_start();
        let Some(data) = data.strip_prefix(b"_") else {
            let problem = "the appended data do not begin with \"_\"";
            return Err(FormatError::new(Location::Line(line_of(bytes, open)), problem));
        };
        Ok(Self { xml: Cow::Owned(xml), appended: Some(data) })
    }
}

fn packing<'a>(document: &'a Document<'_>, root: Node<'a, '_>) -> Result<Packing<'a>, FormatError> {
    let wrong = |what: &str, found: &str| {
        let row = document.text_pos_at(root.range().start).row;
        FormatError::new(Location::Line(row.into()), format!("unknown {what} {found:?}"))
    };
    let order = match root.attribute("byte_order") {
        None | Some("LittleEndian") => ByteOrder::Little,
        Some("BigEndian") => ByteOrder::Big,
        Some(other) => return Err(wrong("byte order", other)),
    };
    let header = match root.attribute("header_type") {
        None | Some("UInt32") => NumberType::U32,
        Some("UInt64") => NumberType::U64,
        Some(other) => return Err(wrong("header type", other)),
    };
    let compressor = root.attribute("compressor").filter(|name| !name.is_empty());
    Ok(Packing { header, order, compressor })
}

struct File<'a, 'x> {
    bytes: &'a [u8],
    packing: Packing<'x>,
    appended: Option<&'a [u8]>,
    is_raw: bool,
    /// Bytes of arrays that may still be unpacked; pieces may share an array.
    allowance: Cell<Allowance>,
}

impl File<'_, '_> {
    /// Adds the points of a piece; returns the index of the first.
    fn add_points(&self, piece: Node<'_, '_>, raw: &mut RawMesh) -> Result<usize, FormatError> {
        let base = raw.positions.len();
        raw.positions.extend(self.points(piece)?);
        cells::check_point_count(raw.positions.len())?;
        Ok(base)
    }

    /// The points of a piece.
    fn points(&self, piece: Node<'_, '_>) -> Result<Vec<[f64; 3]>, FormatError> {
        let count = self.count(piece, "NumberOfPoints")?;
        if count == 0 {
            return Ok(Vec::new());
        }
        let points = child(self, piece, "Points")?;
        let Some(array) = points.children().find(|node| node.has_tag_name("DataArray")) else {
            return Err(self.wrong(points, "no DataArray of points"));
        };
        Ok(self.reals(array, count.saturating_mul(3))?.as_chunks().0.to_vec())
    }

    fn cells(&self, element: Node<'_, '_>, count: u64) -> Result<CellArray, FormatError> {
        Ok(CellArray {
            corners: self.counts(array(self, element, "connectivity")?, None)?,
            ends: self.counts(array(self, element, "offsets")?, Some(count))?,
        })
    }

    fn reals(&self, array: Node<'_, '_>, expected: u64) -> Result<Vec<f64>, FormatError> {
        self.numbers(
            array,
            Some(expected),
            |word| fast_float2::parse(word).ok(),
            |number_type, bytes| Some(number_type.real(bytes, self.packing.order)),
        )
    }

    fn counts(&self, array: Node<'_, '_>, expected: Option<u64>) -> Result<Vec<u64>, FormatError> {
        self.numbers(
            array,
            expected,
            |word| word.parse().ok(),
            |number_type, bytes| number_type.count(bytes, self.packing.order),
        )
    }

    /// The numbers of a `DataArray`.
    fn numbers<T>(
        &self,
        array: Node<'_, '_>,
        expected: Option<u64>,
        from_text: impl Fn(&str) -> Option<T>,
        from_bytes: impl Fn(NumberType, &[u8]) -> Option<T>,
    ) -> Result<Vec<T>, FormatError> {
        let name = array.attribute("type").unwrap_or_default();
        let Some(number_type) = NumberType::from_xml_name(name) else {
            return Err(self.wrong(array, &format!("unknown type of numbers {name:?}")));
        };
        let unreadable = |i: usize, found: &str| self.wrong(array, &format!("number {i} is {found}"));
        let mut values = Vec::new();
        if array.attribute("format").is_none_or(|format| format == "ascii") {
            for (i, word) in text_of(array).split_ascii_whitespace().enumerate() {
                values.push(
                    from_text(word).ok_or_else(|| unreadable(i, &crate::text::quoted(word.as_bytes())))?,
                );
            }
        } else {
            let bytes = self.data(array)?;
            let numbers = bytes.chunks_exact(number_type.size());
            if !numbers.remainder().is_empty() {
                return Err(
                    self.wrong(array, &format!("{} bytes do not make whole {name} numbers", bytes.len()))
                );
            }
            values.reserve_exact(numbers.len());
            for (i, number) in numbers.enumerate() {
                values
                    .push(from_bytes(number_type, number).ok_or_else(|| unreadable(i, "no count or index"))?);
            }
        }
        match expected {
            Some(expected) if expected != values.len() as u64 => {
                Err(self.wrong(array, &format!("{} numbers, expected {expected}", values.len())))
            }
            _ => Ok(values),
        }
    }

    /// The bytes of an array that is not text.
    fn data(&self, array: Node<'_, '_>) -> Result<Vec<u8>, FormatError> {
        let wrong = |problem: String| self.wrong(array, &problem);
        if array.attribute("format") == Some("binary") {
            let text = text_of(array);
            return self.unpack(Stream::base64(text.as_bytes())).map_err(wrong);
        }
        let offset = array.attribute("offset").and_then(|offset| offset.trim().parse::<usize>().ok());
        let Some((offset, appended)) = offset.zip(self.appended) else {
            return Err(wrong("neither text, binary nor at an offset in appended data".into()));
        };
        let Some(data) = appended.get(offset..) else {
            return Err(wrong(format!("offset {offset} in {} bytes of appended data", appended.len())));
        };
        let stream = if self.is_raw { Stream::Raw(data) } else { Stream::base64(data) };
        self.unpack(stream).map_err(wrong)
    }

    fn unpack(&self, stream: Stream<'_>) -> Result<Vec<u8>, String> {
        let mut allowance = self.allowance.get();
        let bytes = stream.unpack(&self.packing, &mut allowance);
        self.allowance.set(allowance);
        bytes
    }

    /// An integer attribute; zero if it is missing.
    fn count(&self, node: Node<'_, '_>, attribute: &str) -> Result<u64, FormatError> {
        let Some(text) = node.attribute(attribute) else { return Ok(0) };
        text.trim()
            .parse()
            .map_err(|_| self.wrong(node, &format!("{attribute} is {text:?}, expected a number")))
    }

    fn wrong(&self, node: Node<'_, '_>, problem: &str) -> FormatError {
        let name = node.attribute("Name").map(|name| format!(" {name:?}")).unwrap_or_default();
        let line = line_of(self.bytes, node.range().start);
        FormatError::new(Location::Line(line), format!("{}{name}: {problem}", node.tag_name().name()))
    }
}

fn child<'a, 'i>(file: &File<'_, '_>, node: Node<'a, 'i>, tag: &str) -> Result<Node<'a, 'i>, FormatError> {
    let found = node.children().find(|child| child.has_tag_name(tag));
    found.ok_or_else(|| file.wrong(node, &format!("no {tag}")))
}

fn array<'a, 'i>(file: &File<'_, '_>, node: Node<'a, 'i>, name: &str) -> Result<Node<'a, 'i>, FormatError> {
    let found = node.children().find(|child| child.attribute("Name") == Some(name));
    found.ok_or_else(|| file.wrong(node, &format!("no DataArray {name:?}")))
}

/// All text in an element, without comments.
fn text_of<'a>(node: Node<'a, '_>) -> Cow<'a, str> {
    let mut parts = node.children().filter(Node::is_text).filter_map(|child| child.text());
    let first = parts.next().unwrap_or_default();
    parts.fold(Cow::Borrowed(first), |text, part| text + part)
}
