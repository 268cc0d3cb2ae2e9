//! Typed arrays in buffers.

use super::buffers::Buffers;
use super::document::{Accessor, wrong};
use crate::error::FormatError;

/// The type of one component, by its number in the specification.
#[derive(Clone, Copy)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn from_number(number: u32) -> Option<Self> {
        Some(match number {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => return None,
        })
    }

    const fn size(self) -> u64 {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// The number stored in `bytes`, which holds [`size`](Self::size) bytes.
    fn number(self, bytes: &[u8], normalized: bool) -> f64 {
        let word = bytes.iter().rev().fold(0_u32, |word, &byte| word << 8 | u32::from(byte));
        let (value, most): (f64, f64) = match self {
            Self::I8 => ((word as u8).cast_signed().into(), 127.0),
            Self::U8 => (word.into(), 255.0),
            Self::I16 => ((word as u16).cast_signed().into(), 32767.0),
            Self::U16 => (word.into(), 65535.0),
            Self::U32 => (word.into(), f64::from(u32::MAX)),
            Self::F32 => return f32::from_bits(word).into(),
        };
        let fraction = value / most;
        match (normalized, fraction < -1.0) {
            (false, _) => value,
            (true, false) => fraction,
            (true, true) => -1.0,
        }
    }
}

/// Elements at equal strides in the bytes of a buffer view.
struct Elements<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
    count: usize,
}

impl<'a> Elements<'a> {
    fn of_view(
        buffers: &'a Buffers<'_>,
        view: usize,
        offset: u64,
        count: u64,
        size: u64,
    ) -> Result<Self, String> {
        let (bytes, view) = buffers.view(view).map_err(|error| error.problem)?;
        let stride = view.byte_stride.unwrap_or(size);
        if stride < size {
            return Err(format!("elements of {size} bytes, but one every {stride} bytes"));
        }
        let end = match count.checked_sub(1) {
            Some(last) => last.checked_mul(stride).and_then(|start| start.checked_add(size)),
            None => Some(0),
        };
        let end = end.and_then(|end| end.checked_add(offset));
        match end {
            Some(end) if end <= bytes.len() as u64 => Ok(Self {
                bytes: &bytes[offset as usize..],
                stride: stride as usize,
                size: size as usize,
                count: count as usize,
            }),
            _ => Err(format!(
                "{count} elements of {size} bytes, one every {stride} bytes from byte {offset} on, \
                 but the buffer view has {} bytes",
                bytes.len()
            )),
        }
    }

    fn iter(&self) -> impl ExactSizeIterator<Item = &'a [u8]> {
        let (bytes, stride, size) = (self.bytes, self.stride, self.size);
        (0..self.count).map(move |i| &bytes[i * stride..i * stride + size])
    }
}

/// The positions in an accessor.
pub(super) fn positions(
    buffers: &Buffers<'_>,
    accessor: &Accessor,
    index: usize,
) -> Result<Vec<[f64; 3]>, FormatError> {
    let component = Component::from_number(accessor.component_type);
    let (Some(component), "VEC3") = (component, accessor.shape.as_str()) else {
        return Err(wrong(format!("accessor {index} does not hold positions, which are VEC3 of numbers")));
    };
    let size = component.size() as usize;
    read(buffers, accessor, 3 * component.size(), |bytes| {
        [0, 1, 2].map(|axis| component.number(&bytes[axis * size..(axis + 1) * size], accessor.normalized))
    })
    .map_err(|problem| wrong(format!("accessor {index}: {problem}")))
}

/// The vectors of `N` numbers in an accessor, or of `N` − 1 whose last number is 1.
pub(super) fn vectors<const N: usize>(
    buffers: &Buffers<'_>,
    accessor: &Accessor,
    index: usize,
) -> Result<Vec<[f64; N]>, FormatError> {
    let component = Component::from_number(accessor.component_type);
    let numbers = match accessor.shape.as_str() {
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        _ => 0,
    };
    let (Some(component), true) = (component, numbers == N || numbers + 1 == N && N == 4) else {
        return Err(wrong(format!("accessor {index} does not hold VEC{N} of numbers")));
    };
    let size = component.size() as usize;
    read(buffers, accessor, numbers as u64 * component.size(), |bytes| {
        let number = |i: usize| component.number(&bytes[i * size..(i + 1) * size], accessor.normalized);
        std::array::from_fn(|i| if i < numbers { number(i) } else { 1.0 })
    })
    .map_err(|problem| wrong(format!("accessor {index}: {problem}")))
}

/// Whether an accessor holds two unsigned shorts for each element.
pub(super) fn holds_pairs_of_shorts(accessor: &Accessor) -> bool {
    let component = Component::from_number(accessor.component_type);
    matches!(component, Some(Component::U16)) && accessor.shape == "VEC2" && !accessor.normalized
}

/// The vertex indices in an accessor.
pub(super) fn indices(
    buffers: &Buffers<'_>,
    accessor: &Accessor,
    index: usize,
) -> Result<Vec<u32>, FormatError> {
    let component = Component::from_number(accessor.component_type);
    let (Some(component @ (Component::U8 | Component::U16 | Component::U32)), "SCALAR") =
        (component, accessor.shape.as_str())
    else {
        return Err(wrong(format!(
            "accessor {index} does not hold indices, which are SCALAR unsigned integers"
        )));
    };
    read(buffers, accessor, component.size(), |bytes| component.number(bytes, false) as u32)
        .map_err(|problem| wrong(format!("accessor {index}: {problem}")))
}

fn read<T: Copy>(
    buffers: &Buffers<'_>,
    accessor: &Accessor,
    size: u64,
    decode: impl Fn(&[u8]) -> T,
) -> Result<Vec<T>, String> {
    // The specification allows at most as many sparse values as values; more would cost time that the file does not account for.
    if let Some(sparse) = &accessor.sparse
        && sparse.count > accessor.count
    {
        return Err(format!("{} sparse values for {}", sparse.count, accessor.count));
    }
    let mut values: Vec<T> = match (accessor.buffer_view, &accessor.sparse) {
        (Some(view), _) => {
            let elements = Elements::of_view(buffers, view, accessor.byte_offset, accessor.count, size)?;
            elements.iter().map(&decode).collect()
        }
        (None, None) => return Err("no buffer view".into()),
        // All zeros except for the sparse values. More values than one per sparse value would be a count without data.
        (None, Some(sparse)) if accessor.count == sparse.count => {
            // Checked to exist before memory for them is allocated.
            let values = &sparse.values;
            Elements::of_view(buffers, values.buffer_view, values.byte_offset, sparse.count, size)?;
            vec![decode(&vec![0; size as usize]); accessor.count as usize]
        }
        (None, Some(sparse)) => {
            return Err(format!("no buffer view, and {} sparse values for {}", sparse.count, accessor.count));
        }
    };
    let Some(sparse) = &accessor.sparse else { return Ok(values) };
    let component = sparse.indices.component_type.and_then(Component::from_number);
    let Some(component @ (Component::U8 | Component::U16 | Component::U32)) = component else {
        return Err("sparse indices are not unsigned integers".into());
    };
    let (at, by) = (&sparse.indices, &sparse.values);
    let places = Elements::of_view(buffers, at.buffer_view, at.byte_offset, sparse.count, component.size())?;
    let substitutes = Elements::of_view(buffers, by.buffer_view, by.byte_offset, sparse.count, size)?;
    let count = values.len();
    for (place, substitute) in places.iter().zip(substitutes.iter()) {
        let place = component.number(place, false) as usize;
        *values.get_mut(place).ok_or_else(|| format!("sparse index {place} of {count} values"))? =
            decode(substitute);
    }
    Ok(values)
}
