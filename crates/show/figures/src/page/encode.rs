//! Encoding of arrays as text: little-endian, bytes grouped by significance, compressed, base64.

use crate::Image;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use serde_json::{Value, json};
use std::io::Write;

/// A compromise: higher levels take twice as long and more, and save three per cent.
const LEVEL: Compression = Compression::new(3);

/// Doubles, losslessly.
pub(super) fn doubles(values: impl ExactSizeIterator<Item = f64>) -> Value {
    array("f64", "plain", values.map(f64::to_le_bytes))
}

/// Coordinates, rounded to single precision.
pub(super) fn singles(values: impl ExactSizeIterator<Item = f32>) -> Value {
    array("f32", "plain", values.map(f32::to_le_bytes))
}

/// Unsigned integers.
pub(super) fn integers(values: impl ExactSizeIterator<Item = u32>) -> Value {
    array("u32", "plain", values.map(u32::to_le_bytes))
}

/// Indices whose first uses are in increasing order; each is encoded as its distance below the first unused number.
///
/// Neighbouring triangles share vertices, so the distances are small and compress well.
pub(super) fn first_use_indices(indices: &[u32]) -> Value {
    let mut unused = 0;
    let codes: Vec<u32> = indices
        .iter()
        .map(|&index| {
            let code = unused - index;
            unused += u32::from(code == 0);
            code
        })
        .collect();
    array("u32", "highwater", codes.into_iter().map(u32::to_le_bytes))
}

/// A picture as PNG; `None` if it cannot be encoded.
pub(super) fn png(image: &Image) -> Option<String> {
    let mut bytes = Vec::new();
    image.write_png(&mut bytes).ok().map(|()| STANDARD.encode(bytes))
}

fn array<const WIDTH: usize>(
    kind: &str,
    coding: &str,
    elements: impl ExactSizeIterator<Item = [u8; WIDTH]>,
) -> Value {
    let length = elements.len();
    // Bytes of equal significance are similar: first all lowest bytes, then the next ones.
    let mut planes = vec![0; WIDTH * length];
    for (i, bytes) in elements.enumerate() {
        for (plane, byte) in bytes.into_iter().enumerate() {
            planes[plane * length + i] = byte;
        }
    }
    json!({ "type": kind, "length": length, "coding": coding, "data": STANDARD.encode(compressed(&planes)) })
}

fn compressed(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), LEVEL);
    let written = encoder.write_all(bytes).and_then(|()| encoder.finish());
    written.expect("writing to memory does not fail")
}

#[cfg(test)]
mod tests {
    use super::*;
    use flate2::read::ZlibDecoder;
    use std::io::Read;

    /// Decodes as the browser does.
    fn decoded(array: &Value) -> Vec<u64> {
        let width = if array["type"] == "f64" { 8 } else { 4 };
        let length = array["length"].as_u64().unwrap() as usize;
        let bytes = STANDARD.decode(array["data"].as_str().unwrap()).unwrap();
        let mut planes = Vec::new();
        ZlibDecoder::new(&bytes[..]).read_to_end(&mut planes).unwrap();
        assert_eq!(planes.len(), width * length);
        let element = |i: usize| (0..width).map(|k| u64::from(planes[k * length + i]) << (8 * k)).sum();
        (0..length).map(element).collect()
    }

    #[test]
    fn numbers_come_back_to_the_bit() {
        let values = [0.0, -0.0, 0.1, f64::MIN_POSITIVE / 3.0, -1e300, std::f64::consts::PI];
        assert_eq!(decoded(&doubles(values.into_iter())), values.map(f64::to_bits));
        let values = [0.25_f32, -3.5e-30, 7.0];
        assert_eq!(decoded(&singles(values.into_iter())), values.map(|x| u64::from(x.to_bits())));
        assert_eq!(decoded(&integers([7, 0, u32::MAX].into_iter())), [7, 0, u64::from(u32::MAX)]);
        assert!(decoded(&doubles(std::iter::empty())).is_empty());
    }

    #[test]
    fn indices_are_distances_from_the_first_unused() {
        let codes = decoded(&first_use_indices(&[0, 1, 2, 2, 1, 3, 0]));
        assert_eq!(codes, [0, 0, 0, 1, 2, 0, 4]);
    }
}
