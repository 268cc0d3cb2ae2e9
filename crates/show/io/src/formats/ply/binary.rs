//! The body of a binary PLY file.

use super::header::{Element, Header, Kind, Scalar};
use super::push_strips;
use crate::error::{FormatError, Location};
use crate::polygon::Polygon;
use crate::raw::RawMesh;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Reads the body; `BIG` is the byte order.
pub(super) fn read<const BIG: bool>(bytes: &[u8], header: &Header) -> Result<RawMesh, FormatError> {
    let mut mesh = RawMesh::default();
    let vertices = header.element(b"vertex").map_or(0, |element| element.count);
    let mut at = header.body;
    for element in &header.elements {
        let table = Table::<BIG>::new(element, bytes, at)?;
        at = match element.name.as_slice() {
            b"vertex" => table.positions(&mut mesh.positions)?,
            b"face" => match table.faces_of_one_size(&mut mesh, vertices)? {
                Some(end) => end,
                None => table.faces(&mut mesh, vertices, false)?,
            },
            b"tristrips" => table.faces(&mut mesh, vertices, true)?,
            _ => table.walk(|_, _, _, _| Ok(()))?,
        };
    }
    mesh.faces.shrink_to_fit();
    Ok(mesh)
}

/// Reads three columns of an element.
pub(super) fn read_columns<const BIG: bool>(
    bytes: &[u8],
    header: &Header,
    name: &[u8],
    columns: [usize; 3],
) -> Result<Vec<[f64; 3]>, FormatError> {
    let mut vectors = Vec::new();
    let mut at = header.body;
    for element in &header.elements {
        let table = Table::<BIG>::new(element, bytes, at)?;
        let wanted = element.name == name;
        if wanted {
            vectors.resize(table.rows, [0.0; 3]);
        }
        at = table.walk(|row, column, kind, at| {
            if let (Some(axis), Kind::Scalar(scalar)) =
                (columns.iter().position(|&c| wanted && c == column), kind)
            {
                vectors[row][axis] = scalar.value::<BIG>(bytes, at);
            }
            Ok(())
        })?;
    }
    Ok(vectors)
}

fn array<const N: usize>(bytes: &[u8], at: usize) -> [u8; N] {
    let mut array = [0; N];
    array.copy_from_slice(&bytes[at..at + N]);
    array
}

impl Scalar {
    /// A number of this type, converted exactly.
    #[inline]
    fn value<const BIG: bool>(self, bytes: &[u8], at: usize) -> f64 {
        match self {
            Self::F32 => f64::from(f32::from_bits(u32_at::<BIG>(bytes, at))),
            Self::F64 => f64::from_bits(if BIG {
                u64::from_be_bytes(array(bytes, at))
            } else {
                u64::from_le_bytes(array(bytes, at))
            }),
            _ => self.whole_number::<BIG>(bytes, at) as f64,
        }
    }

    /// An integer of this type. A number with a fraction becomes the smallest integer, which is never valid.
    #[inline]
    fn whole_number<const BIG: bool>(self, bytes: &[u8], at: usize) -> i64 {
        match self {
            Self::I8 => i64::from(bytes[at].cast_signed()),
            Self::U8 => i64::from(bytes[at]),
            Self::I16 => i64::from(u16_at::<BIG>(bytes, at).cast_signed()),
            Self::U16 => i64::from(u16_at::<BIG>(bytes, at)),
            Self::I32 => i64::from(u32_at::<BIG>(bytes, at).cast_signed()),
            Self::U32 => i64::from(u32_at::<BIG>(bytes, at)),
            Self::F32 | Self::F64 => {
                let value = self.value::<BIG>(bytes, at);
                if value.fract() == 0.0 { value as i64 } else { i64::MIN }
            }
        }
    }
}

#[inline]
fn u16_at<const BIG: bool>(bytes: &[u8], at: usize) -> u16 {
    let array = array(bytes, at);
    if BIG { u16::from_be_bytes(array) } else { u16::from_le_bytes(array) }
}

#[inline]
fn u32_at<const BIG: bool>(bytes: &[u8], at: usize) -> u32 {
    let array = array(bytes, at);
    if BIG { u32::from_be_bytes(array) } else { u32::from_le_bytes(array) }
}

/// An element and where its rows lie.
struct Table<'a, const BIG: bool> {
    element: &'a Element,
    /// The number of rows; the file is long enough for each at its shortest length.
    rows: usize,
    /// The length of a row with empty lists; if there are no lists, of every row.
    shortest_row: usize,
    bytes: &'a [u8],
    start: usize,
}

impl<'a, const BIG: bool> Table<'a, BIG> {
    /// Checks the number of rows in the header against the size of the file.
    fn new(element: &'a Element, bytes: &'a [u8], start: usize) -> Result<Self, FormatError> {
        let shortest_row = element
            .properties
            .iter()
            .map(|property| match property.kind {
                Kind::Scalar(scalar) | Kind::List { count: scalar, .. } => scalar.size(),
            })
            .sum::<usize>();
        let here = bytes.len() - start;
        if u128::from(element.count) * shortest_row as u128 > here as u128 {
            let (count, name) = (element.count, element.name.escape_ascii());
            return Err(FormatError::new(
                Location::Byte(start as u64),
                format!(
                    "found {here} bytes, expected {count} rows of element {name} of at least {shortest_row} bytes"
                ),
            ));
        }
        let rows = if shortest_row == 0 { 0 } else { element.count as usize };
        Ok(Self { element, rows, shortest_row, bytes, start })
    }

    /// Reads the vertices; returns where they end.
    fn positions(&self, positions: &mut Vec<[f64; 3]>) -> Result<usize, FormatError> {
        let columns = self.element.coordinates().map_err(|problem| problem.in_text(self.bytes))?;
        let properties = &self.element.properties;
        let axes = columns.map(|column| match properties[column].kind {
            Kind::Scalar(scalar) | Kind::List { item: scalar, .. } => scalar,
        });
        let Some(offsets) = self.fixed_offsets() else {
            positions.reserve_exact(self.rows);
            positions.resize(self.rows, [0.0; 3]);
            return self.walk(|row, column, kind, at| {
                if let (Some(axis), Kind::Scalar(scalar)) = (columns.iter().position(|&c| c == column), kind)
                {
                    positions[row][axis] = scalar.value::<BIG>(self.bytes, at);
                }
                Ok(())
            });
        };
        let offsets = columns.map(|column| offsets[column]);
        *positions = Vec::with_capacity(self.rows);
        match axes {
            [Scalar::F32, Scalar::F32, Scalar::F32] => {
                self.collect(positions, |row| offsets.map(|at| Scalar::F32.value::<BIG>(row, at)));
            }
            [Scalar::F64, Scalar::F64, Scalar::F64] => {
                self.collect(positions, |row| offsets.map(|at| Scalar::F64.value::<BIG>(row, at)));
            }
            _ => self.collect(positions, |row| {
                [0, 1, 2].map(|axis: usize| axes[axis].value::<BIG>(row, offsets[axis]))
            }),
        }
        Ok(self.start + self.rows * self.shortest_row)
    }

    /// The offset of each property in a row; `None` when the element has lists.
    fn fixed_offsets(&self) -> Option<Vec<usize>> {
        let mut end = 0;
        self.element
            .properties
            .iter()
            .map(|property| match property.kind {
                Kind::Scalar(scalar) => {
                    end += scalar.size();
                    Some(end - scalar.size())
                }
                Kind::List { .. } => None,
            })
            .collect()
    }

    fn collect(&self, positions: &mut Vec<[f64; 3]>, position: impl Fn(&[u8]) -> [f64; 3] + Sync + Send) {
        self.bytes[self.start..][..self.rows * self.shortest_row]
            .par_chunks_exact(self.shortest_row)
            .map(position)
            .collect_into_vec(positions);
    }

    /// Reads faces that all have as many corners as the first, in parallel. Returns where they end; or `None`, having read nothing,
    /// if they differ or have other lists.
    fn faces_of_one_size(&self, mesh: &mut RawMesh, vertices: u64) -> Result<Option<usize>, FormatError> {
        let column = self.element.indices().map_err(|problem| problem.in_text(self.bytes))?;
        let properties = &self.element.properties;
        let Kind::List { count, item } = properties[column].kind else { return Ok(None) };
        let mut before = 0;
        for (at, property) in properties.iter().enumerate() {
            match property.kind {
                Kind::Scalar(scalar) if at < column => before += scalar.size(),
                Kind::List { .. } if at != column => return Ok(None),
                _ => {}
            }
        }
        if self.rows == 0 {
            return Ok(None);
        }
        let corners = count.whole_number::<BIG>(self.bytes, self.start + before);
        let body = &self.bytes[self.start..];
        let Some((corners, row)) = usize::try_from(corners)
            .ok()
            .filter(|&corners| corners >= 3 && corners <= body.len())
            .map(|corners| (corners, self.shortest_row + corners * item.size()))
            .filter(|&(_, row)| row <= body.len() / self.rows)
        else {
            return Ok(None);
        };
        let (first, triangles) = (before + count.size(), corners - 2);
        let table = &body[..self.rows * row];
        let plain = AtomicBool::new(true);
        let mut faces = Vec::with_capacity(self.rows * triangles);
        let index = |row: &[u8], corner: usize| -> u32 {
            let at = first + corner * item.size();
            let index = match item {
                Scalar::I32 | Scalar::U32 => return u32_at::<BIG>(row, at),
                _ => item.whole_number::<BIG>(row, at),
            };
            u32::try_from(index).unwrap_or(u32::MAX)
        };
        let check = |row: &[u8], largest: u32| {
            let here = count.whole_number::<BIG>(row, before);
            if here != (corners as u64).cast_signed() || u64::from(largest) >= vertices {
                plain.store(false, Ordering::Relaxed);
            }
        };
        let rows = table.par_chunks_exact(row);
        if triangles == 1 {
            rows.map(|row| {
                let face = [index(row, 0), index(row, 1), index(row, 2)];
                check(row, face[0].max(face[1]).max(face[2]));
                face
            })
            .collect_into_vec(&mut faces);
        } else {
            faces.resize(self.rows * triangles, [0; 3]);
            faces.par_chunks_exact_mut(triangles).zip(rows).for_each(|(fan, row)| {
                let (start, mut previous) = (index(row, 0), index(row, 1));
                let mut largest = start.max(previous);
                for (at, triangle) in fan.iter_mut().enumerate() {
                    let corner = index(row, at + 2);
                    *triangle = [start, previous, corner];
                    previous = corner;
                    largest = largest.max(corner);
                }
                check(row, largest);
            });
        }
        if !plain.into_inner() {
            // Other sizes or an index out of range: the sequential reader handles and reports them.
            return Ok(None);
        }
        mesh.faces = faces;
        if triangles > 1 {
            mesh.polygons = (0..self.rows)
                .map(|face| Polygon { first: (face * triangles) as u32, corners: corners as u32 })
                .collect();
        }
        Ok(Some(self.start + table.len()))
    }

    /// Reads faces or strips of any size; returns where they end.
    fn faces(&self, mesh: &mut RawMesh, vertices: u64, strips: bool) -> Result<usize, FormatError> {
        let wanted = self.element.indices().map_err(|problem| problem.in_text(self.bytes))?;
        let mut indices = Vec::new();
        self.walk(|row, column, kind, at| {
            let (true, Kind::List { count, item }) = (column == wanted, kind) else { return Ok(()) };
            let corners = count.whole_number::<BIG>(self.bytes, at);
            indices.clear();
            for corner in 0..corners as usize {
                let index = item.whole_number::<BIG>(self.bytes, at + count.size() + corner * item.size());
                let separates = strips && index < 0 && index > i64::MIN;
                if !separates && !u64::try_from(index).is_ok_and(|index| index < vertices) {
                    return Err(FormatError::new(
                        Location::Face(row as u64),
                        if index == i64::MIN {
                            "found a vertex index with a fraction, expected a whole number".to_owned()
                        } else {
                            format!("found vertex index {index}, but there are only {vertices} vertices (the first is 0)")
                        },
                    ));
                }
                indices.push(index);
            }
            if strips {
                push_strips(mesh, &indices);
            } else {
                mesh.push_polygon(indices.iter().map(|&index| index as u32));
            }
            Ok(())
        })
    }

    /// Calls `visit` with row, column, kind and offset of every value, whose bytes are there; returns where they end.
    fn walk(
        &self,
        mut visit: impl FnMut(usize, usize, Kind, usize) -> Result<(), FormatError>,
    ) -> Result<usize, FormatError> {
        let mut at = self.start;
        for row in 0..self.rows {
            for (column, property) in self.element.properties.iter().enumerate() {
                let (fixed, items) = match property.kind {
                    Kind::Scalar(scalar) => (scalar.size(), None),
                    Kind::List { count, item } => (count.size(), Some((count, item))),
                };
                let mut length = fixed as u64;
                if let Some((count, item)) = items.filter(|_| fixed <= self.bytes.len() - at) {
                    let Ok(count) = u64::try_from(count.whole_number::<BIG>(self.bytes, at)) else {
                        return Err(self.broken(row, at, "a list count below 0", "0 or more"));
                    };
                    length += count * item.size() as u64;
                }
                if length > (self.bytes.len() - at) as u64 {
                    let found = format!("{} bytes", self.bytes.len() - at);
                    return Err(self.broken(row, at, &found, &format!("at least {length}")));
                }
                visit(row, column, property.kind, at)?;
                at += length as usize;
            }
        }
        Ok(at)
    }

    #[cold]
    fn broken(&self, row: usize, at: usize, found: &str, expected: &str) -> FormatError {
        let (count, name) = (self.element.count, self.element.name.escape_ascii());
        FormatError::new(
            Location::Byte(at as u64),
            format!("found {found} in row {row} of the {count} of element {name}, expected {expected}"),
        )
    }
}
