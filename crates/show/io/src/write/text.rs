//! Formatting numbers without `std::fmt`, which is slower.

use super::BLOCK;
use std::io::{self, Write};

/// Collects the lines of a text file and writes them in blocks.
pub(super) struct TextWriter<W: Write> {
    out: W,
    pending: Vec<u8>,
    integer: itoa::Buffer,
    real: zmij::Buffer,
}

impl<W: Write> TextWriter<W> {
    pub(super) fn new(out: W) -> Self {
        let pending = Vec::with_capacity(BLOCK + 1024);
        Self { out, pending, integer: itoa::Buffer::new(), real: zmij::Buffer::new() }
    }

    pub(super) fn text(&mut self, text: &str) {
        self.pending.extend_from_slice(text.as_bytes());
    }

    pub(super) fn integer(&mut self, value: impl itoa::Integer) {
        self.pending.extend_from_slice(self.integer.format(value).as_bytes());
    }

    /// The shortest decimal that reads back to the same double, without a trailing `.0`.
    pub(super) fn real(&mut self, value: f64) {
        let digits = self.real.format(value);
        self.pending.extend_from_slice(digits.strip_suffix(".0").unwrap_or(digits).as_bytes());
    }

    pub(super) fn end_line(&mut self) -> io::Result<()> {
        self.pending.push(b'\n');
        if self.pending.len() >= BLOCK { self.flush() } else { Ok(()) }
    }

    pub(super) fn flush(&mut self) -> io::Result<()> {
        self.out.write_all(&self.pending)?;
        self.pending.clear();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn written(value: f64) -> String {
        let mut bytes = Vec::new();
        let mut text = TextWriter::new(&mut bytes);
        text.real(value);
        text.flush().unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn short_numbers_are_short() {
        let expected = [(1.0, "1"), (-0.0, "-0"), (0.1, "0.1"), (-2.5e-7, "-2.5e-7"), (1e300, "1e+300")];
        for (value, text) in expected {
            assert_eq!(written(value), text);
        }
    }

    proptest! {
        #[test]
        fn reals_read_back_to_the_same_bits(bits: u64) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            prop_assert_eq!(written(value).parse::<f64>().unwrap().to_bits(), bits);
        }
    }
}
