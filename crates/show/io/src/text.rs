//! Parsing shared by the text formats: numbers, blanks, and the line of an offset.

use crate::error::{FormatError, Location};
use pompeiu_core::TriMesh;

/// A problem at a byte offset of a text; converted to a [`FormatError`] with the line.
#[derive(Debug)]
pub(crate) struct Problem {
    pub(crate) offset: usize,
    pub(crate) text: String,
}

impl Problem {
    pub(crate) fn new(offset: usize, text: impl Into<String>) -> Self {
        Self { offset, text: text.into() }
    }

    /// The same problem in a text that begins `start` bytes earlier.
    pub(crate) fn after(self, start: usize) -> Self {
        Self { offset: start + self.offset, ..self }
    }

    /// The error for the whole text.
    pub(crate) fn in_text(self, text: &[u8]) -> FormatError {
        FormatError::new(Location::Line(line_of(text, self.offset)), self.text)
    }
}

/// The line that holds `offset`, counted from 1; lines end with LF, CR LF or a lone CR.
pub(crate) fn line_of(text: &[u8], offset: usize) -> u64 {
    let before = &text[..offset.min(text.len())];
    let ends = memchr::memchr2_iter(b'\n', b'\r', before)
        .filter(|&at| before[at] == b'\n' || text.get(at + 1) != Some(&b'\n'));
    1 + ends.count() as u64
}

/// The offset after the line end at or after `at`, or the end of the text.
pub(crate) fn next_line(text: &[u8], at: usize) -> usize {
    match memchr::memchr2(b'\n', b'\r', &text[at..]) {
        None => text.len(),
        Some(n) => past_line_end(text, at + n),
    }
}

/// The offset after the line end that begins at `at`.
pub(crate) fn past_line_end(text: &[u8], at: usize) -> usize {
    if text[at] == b'\r' && text.get(at + 1) == Some(&b'\n') { at + 2 } else { at + 1 }
}

pub(crate) const fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t')
}

pub(crate) const fn is_line_end(byte: u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

/// The word at `at`, up to a blank or line end; empty at a line end or the end of the text.
pub(crate) fn word(text: &[u8], at: usize) -> &[u8] {
    let rest = text.get(at..).unwrap_or_default();
    let end = rest.iter().position(|&b| is_blank(b) || is_line_end(b)).unwrap_or(rest.len());
    &rest[..end]
}

/// A word for messages: quoted, shortened, and without control characters.
pub(crate) fn quoted(word: &[u8]) -> String {
    const LONGEST: usize = 24;
    if word.is_empty() {
        return "the end of the line".into();
    }
    let shown = word[..word.len().min(LONGEST)].escape_ascii();
    format!("\"{shown}{}\"", if word.len() > LONGEST { "…" } else { "" })
}

/// The number at `at` and the offset after it; `None` if there is none.
///
/// The nearest double. Accepts decimal numbers with an optional sign, digits on either side of the point, and an optional exponent
/// after `e`, `E`, `d` or `D`; numbers too small for a double become 0. NaN and infinities are accepted, and numbers too large
/// become infinite: [`coordinate`] refuses both.
#[inline]
pub(crate) fn number(text: &[u8], at: usize) -> Option<(f64, usize)> {
    let (value, length) = fast_float2::parse_partial::<f64, _>(text.get(at..)?).ok()?;
    let end = at + length;
    match text.get(end) {
        None | Some(b' ' | b'\t' | b'\n' | b'\r' | b'#' | b'\\') => Some((value, end)),
        Some(b'd' | b'D') => fortran_number(text, at),
        _ => None,
    }
}

#[cold]
fn fortran_number(text: &[u8], at: usize) -> Option<(f64, usize)> {
    let word = word(text, at);
    let plain: Vec<u8> = word.iter().map(|b| if matches!(b, b'd' | b'D') { b'e' } else { *b }).collect();
    Some((fast_float2::parse(plain).ok()?, at + word.len()))
}

/// The integer at `at` and the offset after it; `1e3` and `3.0` are accepted too.
pub(crate) fn whole_number(text: &[u8], at: usize) -> Option<(i64, usize)> {
    /// Up to here every integer is a double.
    const LARGEST: f64 = (1_u64 << f64::MANTISSA_DIGITS) as f64;
    number(text, at)
        .filter(|(value, _)| value.fract() == 0.0 && value.abs() <= LARGEST)
        .map(|(value, end)| (value as i64, end))
}

/// A number that is a valid coordinate of a [`TriMesh`].
#[inline]
pub(crate) fn coordinate(text: &[u8], at: usize) -> Result<(f64, usize), Problem> {
    match number(text, at) {
        Some((value, end)) if value.abs() <= TriMesh::MAX_COORDINATE => Ok((value, end)),
        found => Err(unusable_coordinate(text, at, found)),
    }
}

#[cold]
fn unusable_coordinate(text: &[u8], at: usize, found: Option<(f64, usize)>) -> Problem {
    let word = quoted(word(text, at));
    Problem::new(
        at,
        match found {
            None => format!("found {word}, expected a coordinate"),
            Some((value, _)) if value.is_nan() => format!("found {word}, expected a finite coordinate"),
            Some(_) => format!(
                "found {word}, expected a finite coordinate of at most {:e} in magnitude",
                TriMesh::MAX_COORDINATE
            ),
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_all_their_spellings() {
        for (text, value) in [
            ("1", 1.0),
            ("+1", 1.0),
            ("-.5", -0.5),
            ("1.", 1.0),
            ("1e-400", 0.0),
            ("0.1", 0.1),
            ("1D3", 1000.0),
            ("-2.5d-1", -0.25),
            ("123456789012345678901234567890", 1.234_567_890_123_456_8e29),
            ("9007199254740993", 9_007_199_254_740_992.0),
            ("2.2250738585072011e-308", 2.225_073_858_507_201e-308),
        ] {
            let written = format!("{text} 7\n");
            assert_eq!(number(written.as_bytes(), 0), Some((value, text.len())), "{text}");
        }
        for text in ["", "x", "1,5", "0x10", "1e", "1..2", "-", "1d", "--1"] {
            assert_eq!(number(text.as_bytes(), 0), None, "{text}");
        }
    }

    #[test]
    fn coordinates_are_finite() {
        for text in ["nan", "NaN", "-inf", "Infinity", "1e400", "1e305"] {
            let problem = coordinate(text.as_bytes(), 0).unwrap_err();
            assert!(problem.text.contains("finite"), "{}", problem.text);
        }
    }

    #[test]
    fn lines_end_three_ways() {
        let text = b"a\nb\r\nc\rd";
        let lines: Vec<u64> = [0, 2, 5, 7].into_iter().map(|at| line_of(text, at)).collect();
        assert_eq!(lines, [1, 2, 3, 4]);
    }
}
