//! Reading and writing SWC files.

use crate::SwcError;
use std::fmt::Write;

/// A row of an SWC file: one sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SwcRow {
    /// Line of the file, from 1.
    pub line: usize,
    /// Its number.
    pub id: i64,
    /// The structure: 1 soma, 2 axon, 3 and 4 dendrites, others by the file's author.
    pub kind: i64,
    /// Position in micrometres.
    pub position: [f64; 3],
    /// Radius in micrometres; 0 or less if unknown.
    pub radius: f64,
    /// The parent's number; `None` for a root.
    pub parent: Option<i64>,
}

/// Columns of a row.
const FIELDS: [&str; 7] = ["id", "type", "x", "y", "z", "radius", "parent"];

/// Reads the rows of an SWC file.
///
/// Comments begin with `#`, at the start of a line or after the fields. Fields are separated by blanks, tabs, commas or semicolons;
/// lines end with LF, CR LF or CR. Integers may be written as `2.0`. Columns after the seventh are ignored. Any negative parent
/// means a root.
///
/// # Errors
/// [`SwcError`] with the line: too few fields, a field that is not a number, a number that is not finite, or no samples.
pub fn read_swc(bytes: &[u8]) -> Result<Vec<SwcRow>, SwcError> {
    let text = String::from_utf8_lossy(bytes);
    let text = text.trim_start_matches('\u{feff}');
    let mut rows = Vec::new();
    for (index, line) in lines(text).enumerate() {
        let line_number = index + 1;
        let content = line.split('#').next().unwrap_or("");
        let fields: Vec<&str> = content
            .split(|c: char| c.is_whitespace() || c == ',' || c == ';')
            .filter(|field| !field.is_empty())
            .collect();
        if fields.is_empty() {
            continue;
        }
        if fields.len() < FIELDS.len() {
            return Err(SwcError::Fields { line: line_number, found: fields.len() });
        }
        let mut numbers = [0.0; 7];
        for ((number, field), name) in numbers.iter_mut().zip(&fields).zip(FIELDS) {
            *number = parse(field, name, line_number)?;
        }
        let whole = |column: usize| {
            let value = numbers[column];
            // Beyond this, doubles cannot represent every integer.
            if value.fract() == 0.0 && value.abs() < 9e15 {
                Ok(value as i64)
            } else {
                Err(SwcError::Number {
                    line: line_number,
                    field: FIELDS[column],
                    found: fields[column].chars().take(SHOWN).collect(),
                })
            }
        };
        let parent = whole(6)?;
        rows.push(SwcRow {
            line: line_number,
            id: whole(0)?,
            kind: whole(1)?,
            position: [numbers[2], numbers[3], numbers[4]],
            radius: numbers[5],
            parent: (parent >= 0).then_some(parent),
        });
    }
    if rows.is_empty() { Err(SwcError::Empty) } else { Ok(rows) }
}

/// Characters of an invalid field shown in a message.
const SHOWN: usize = 24;

/// Largest coordinate and radius, in micrometres: a metre is 10⁶, and squares and cubes must stay finite.
const LARGEST: f64 = 1e12;

fn parse(field: &str, name: &'static str, line: usize) -> Result<f64, SwcError> {
    let wrong = || SwcError::Number { line, field: name, found: field.chars().take(SHOWN).collect() };
    let value: f64 = field.parse().map_err(|_| wrong())?;
    if value.is_finite() && value.abs() <= LARGEST {
        Ok(value)
    } else {
        Err(SwcError::NotFinite { line, field: name, value })
    }
}

/// Lines that end with LF, CR LF or CR.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let now = rest?;
        if let Some(at) = now.find(['\n', '\r']) {
            let skip = if now[at..].starts_with("\r\n") { 2 } else { 1 };
            rest = Some(&now[at + skip..]);
            Some(&now[..at])
        } else {
            rest = None;
            Some(now)
        }
    })
}

/// Writes rows as an SWC file, with the shortest decimals that read back to the same doubles.
pub fn write_swc<'r>(rows: impl IntoIterator<Item = &'r SwcRow>) -> String {
    let mut text = String::from("# id type x y z radius parent; micrometres\n");
    for row in rows {
        let [x, y, z] = row.position;
        let parent = row.parent.unwrap_or(-1);
        let _ = writeln!(text, "{} {} {x} {y} {z} {} {parent}", row.id, row.kind, row.radius);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dialects_read_alike() {
        let plain = "1 1 0 0 0 2 -1\n2 3 5 0 0 1 1\n";
        let rows = read_swc(plain.as_bytes()).unwrap();
        let others = [
            "\u{feff}# made by hand\r\n 1 1 0 0 0 2 -1\r\n2 3 5 0 0 1 1\r\n",
            "1,1,0,0,0,2,-1\r2;3;5;0;0;1;1 # tip\r",
            "1.0 1 0.0 0 0 2e0 -1 77 88\n\t2\t3\t5\t0\t0\t1\t1",
            "1 1 0 0 0 2 -2\n2 3 5 0 0 1 1\n",
        ];
        for other in others {
            let read = read_swc(other.as_bytes()).unwrap();
            let strip = |rows: &[SwcRow]| rows.iter().map(|r| SwcRow { line: 0, ..*r }).collect::<Vec<_>>();
            assert_eq!(strip(&read), strip(&rows), "{other:?}");
        }
        assert_eq!(read_swc(write_swc(&rows).as_bytes()).unwrap().len(), 2);
    }

    #[test]
    fn what_is_wrong_is_located() {
        let error = |text: &str| read_swc(text.as_bytes()).unwrap_err().to_string();
        assert_eq!(error("# nothing\n"), "there is no sample in the file");
        assert_eq!(
            error("1 1 0 0 0 2\n"),
            "line 1: found 6 fields, expected 7: id, type, x, y, z, radius, parent"
        );
        assert_eq!(
            error("\n1 1 0 zero 0 2 -1\n"),
            "line 2: the y of the sample is \"zero\", which is not a number"
        );
        assert!(error("1 1 0 nan 0 2 -1").contains("line 1: the y of the sample is NaN"));
        assert!(error("1 1 0 0 inf 2 -1").contains("inf"));
        assert!(error("1.5 1 0 0 0 2 -1").contains("id"));
    }
}
