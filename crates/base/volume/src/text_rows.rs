//! Rows of numbers as text, most of them zeros or repeated.

use crate::CellSplines;
use crate::unstructured::nonzero;
use glam::DVec3;

/// Lines of the files of `NeuronTransportIGA`.
#[derive(Default)]
pub(crate) struct TextRows {
    text: Vec<u8>,
    integer: itoa::Buffer,
    real: zmij::Buffer,
    decimals: Decimals,
}

/// As many zeros as a function has coefficients, each with a space after it.
const ZEROS: [u8; 128] = {
    let mut zeros = [b' '; 128];
    let mut k = 0;
    while k < 128 {
        zeros[k] = b'0';
        k += 2;
    }
    zeros
};

impl TextRows {
    /// A file that begins with a count.
    pub(crate) fn new(count: usize) -> Self {
        let mut text = Self::default();
        text.integer(count);
        text.end_line();
        text
    }

    pub(crate) fn clear(&mut self) {
        self.text.clear();
    }

    pub(crate) fn bytes(&self) -> &[u8] {
        &self.text
    }

    pub(crate) fn into_string(self) -> String {
        String::from_utf8(self.text).unwrap_or_default()
    }

    /// A number and a space.
    fn integer(&mut self, number: impl itoa::Integer) {
        self.text.extend_from_slice(self.integer.format(number).as_bytes());
        self.text.push(b' ');
    }

    /// Ends a line instead of the last space.
    fn end_line(&mut self) {
        if self.text.last() == Some(&b' ') {
            self.text.pop();
        }
        self.text.push(b'\n');
    }

    /// The functions of a cell, numbered from 1.
    pub(crate) fn functions(&mut self, cell: &CellSplines) {
        cell.functions.iter().for_each(|v| self.integer(v + 1));
        self.end_line();
    }

    /// The number of a cell, its functions and their coefficients.
    pub(crate) fn coefficients(&mut self, index: usize, cell: &CellSplines) {
        self.integer(index);
        self.integer(cell.functions.len());
        self.integer(cell.kind.number());
        self.end_line();
        cell.functions.iter().for_each(|v| self.integer(*v));
        self.end_line();
        for list in &cell.coefficients {
            let mut from = 0;
            for k in nonzero(list) {
                self.text.extend_from_slice(&ZEROS[..2 * (k - from)]);
                self.decimals.push(list[k], &mut self.real, &mut self.text);
                from = k + 1;
            }
            self.text.extend_from_slice(&ZEROS[..2 * (list.len() - from)]);
            self.end_line();
        }
    }

    /// A line for each point.
    pub(crate) fn points(&mut self, points: &[DVec3]) {
        for point in points {
            for number in point.to_array() {
                self.text.extend_from_slice(shortest(&mut self.real, number).as_bytes());
                self.text.push(b' ');
            }
            self.end_line();
        }
    }
}

/// The shortest decimal that reads back to the same double, without a trailing `.0`.
fn shortest(buffer: &mut zmij::Buffer, number: f64) -> &str {
    let digits = buffer.format(number);
    digits.strip_suffix(".0").unwrap_or(digits)
}

/// Number of remembered decimals, a power of two.
const REMEMBERED: usize = 1 << 10;

/// Most bytes of a remembered decimal, with the space after it.
const WIDTH: usize = 23;

/// A number with its decimal and the length of this.
#[derive(Clone, Copy)]
struct Decimal {
    bits: u64,
    text: [u8; WIDTH],
    length: u8,
}

/// Decimals of numbers that were written before: coefficients are products of few small fractions.
struct Decimals(Vec<Decimal>);

impl Default for Decimals {
    fn default() -> Self {
        Self(vec![Decimal { bits: 0, text: *b"0                      ", length: 2 }; REMEMBERED])
    }
}

impl Decimals {
    /// Writes a number and a space.
    fn push(&mut self, number: f64, buffer: &mut zmij::Buffer, text: &mut Vec<u8>) {
        let bits = number.to_bits();
        // The upper bits of the product depend on all bits of the number.
        let place = bits.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - REMEMBERED.trailing_zeros());
        let known = &mut self.0[place as usize];
        if known.bits != bits {
            let digits = shortest(buffer, number).as_bytes();
            if digits.len() >= WIDTH {
                text.extend_from_slice(digits);
                text.push(b' ');
                return;
            }
            known.text[..digits.len()].copy_from_slice(digits);
            known.text[digits.len()] = b' ';
            (known.bits, known.length) = (bits, digits.len() as u8 + 1);
        }
        // All bytes, because a constant length is copied faster.
        text.extend_from_slice(&known.text);
        text.truncate(text.len() - WIDTH + usize::from(known.length));
    }
}
