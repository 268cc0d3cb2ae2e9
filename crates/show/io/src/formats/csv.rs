//! Vectors as text: three numbers on a line.

use crate::error::FormatError;
use crate::text::{Problem, number, quoted};

/// Reads one vector from each line: three numbers with commas, semicolons or blanks between them.
///
/// Empty lines, text after a `#`, and a first line whose words are not numbers are skipped.
pub(crate) fn read_vectors(bytes: &[u8]) -> Result<Vec<[f64; 3]>, FormatError> {
    let mut vectors = Vec::new();
    let mut first = true;
    let mut at = 0;
    while at < bytes.len() {
        let next = crate::text::next_line(bytes, at);
        let line = &bytes[at..next];
        let line = line.split(|&b| b == b'#').next().unwrap_or_default();
        let words: Vec<&[u8]> = line
            .split(|b| b.is_ascii_whitespace() || matches!(b, b',' | b';'))
            .filter(|word| !word.is_empty())
            .collect();
        let value =
            |word: &[u8]| number(word, 0).filter(|&(_, end)| end == word.len()).map(|(value, _)| value);
        let is_heading = first && words.iter().all(|word| value(word).is_none());
        if !words.is_empty() && !is_heading {
            let wrong = |text: String| Problem::new(at, text).in_text(bytes);
            let [x, y, z] = words[..] else {
                return Err(wrong(format!("found {} numbers, expected 3: a vector", words.len())));
            };
            let mut vector = [0.0; 3];
            for (component, word) in vector.iter_mut().zip([x, y, z]) {
                *component =
                    value(word).ok_or_else(|| wrong(format!("found {}, expected a number", quoted(word))))?;
            }
            vectors.push(vector);
        }
        first &= words.is_empty();
        at = next;
    }
    Ok(vectors)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separators_headings_and_comments() {
        let text = b"# made by hand\nx,y,z\n1,2,3\r\n\n4; 5;\t-6e-1 # the second\n7 8 nan";
        let vectors = read_vectors(text).unwrap();
        assert_eq!(vectors[..2], [[1.0, 2.0, 3.0], [4.0, 5.0, -0.6]]);
        assert!(vectors.len() == 3 && vectors[2][2].is_nan());
        assert!(read_vectors(b"").unwrap().is_empty());
    }

    #[test]
    fn wrong_lines_are_named() {
        let message = |text: &[u8]| read_vectors(text).unwrap_err().to_string();
        assert_eq!(message(b"1,2,3\n1,2"), "line 2: found 2 numbers, expected 3: a vector");
        assert_eq!(message(b"1,2,3\n1,2,x"), "line 2: found \"x\", expected a number");
        assert_eq!(message(b"1,2,x\n"), "line 1: found \"x\", expected a number");
    }
}
