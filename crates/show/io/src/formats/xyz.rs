//! Points as text: three coordinates at the beginning of each line, separated by blanks, commas or semicolons.
//!
//! What follows on a line (colours, normals, intensities) is skipped, and so are lines that begin with `#` or `//`, and a first line that is
//! a single number of points, as in PTS files. There are no faces.

use crate::error::{FormatError, Location};
use crate::raw::RawMesh;

/// Reads the points of a text file.
pub(crate) fn read(bytes: &[u8]) -> Result<RawMesh, FormatError> {
    let body = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let mut mesh = RawMesh::default();
    for (line, number) in body.split(|&byte| byte == b'\n').zip(1..) {
        let line = line.trim_ascii();
        if line.is_empty() || line.starts_with(b"#") || line.starts_with(b"//") {
            continue;
        }
        let mut words = line
            .split(|byte| byte.is_ascii_whitespace() || matches!(byte, b',' | b';'))
            .filter(|word| !word.is_empty());
        let mut position = [0.0; 3];
        let mut found = 0;
        for x in &mut position {
            let Some(word) = words.next() else { break };
            *x = fast_float2::parse(word).map_err(|_| {
                let word = word[..word.len().min(40)].escape_ascii();
                FormatError::new(Location::Line(number), format!("found \"{word}\", expected a coordinate"))
            })?;
            found += 1;
        }
        match found {
            3 => mesh.positions.push(position),
            1 if mesh.positions.is_empty() && position[0].fract() == 0.0 => {}
            _ => {
                let problem = format!("found {found} numbers, expected three coordinates");
                return Err(FormatError::new(Location::Line(number), problem));
            }
        }
    }
    Ok(mesh)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_come_first_and_the_rest_is_skipped() {
        let found = read(b"# x y z\n3\n1 2 3\r\n  4,5,6,255,0,0\n\n-1e-3;.5;7 0.1\n").unwrap();
        assert_eq!(found.positions, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [-1e-3, 0.5, 7.0]]);
        assert!(found.faces.is_empty());
        for (text, problem) in [
            (&b"1 2 3\n4 5\n"[..], "line 2: found 2 numbers, expected three coordinates"),
            (b"1 2 3\n7\n", "line 2: found 1 numbers, expected three coordinates"),
            (b"x,y,z\n", "line 1: found \"x\", expected a coordinate"),
        ] {
            assert_eq!(read(text).unwrap_err().to_string(), problem);
        }
    }
}
