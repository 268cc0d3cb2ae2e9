//! Numbers on the command line and in answers for people.

pub(crate) use pompeiu::core::request::values::{counts, tuple};
use pompeiu::hausdorff::digits::MOST_DIGITS;
pub(crate) use pompeiu::hausdorff::digits::{agreed, between, brief, shortest};
use pompeiu::remesh::IntersectionCount;
use std::time::Duration;

/// Parses an amount of memory, such as `512MiB` or `2GB`.
pub(crate) fn memory(text: &str) -> Result<usize, String> {
    let size = text.parse::<bytesize::ByteSize>();
    let bytes =
        size.map_err(|_| "expected a number of bytes with a unit, such as 512MiB or 2GB".to_owned())?;
    Ok(usize::try_from(bytes.as_u64()).unwrap_or(usize::MAX))
}

/// Parses a span of time, such as `10s` or `2min`.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    humantime::parse_duration(text)
        .map_err(|_| "expected a span of time with a unit, such as 500ms, 10s or 2min".to_owned())
}

/// A number for people: at most fifteen digits, as a power of ten where it is far from one.
pub(crate) fn plain(x: f64) -> String {
    let rounded = format!("{:.*e}", MOST_DIGITS - 1, x).parse().unwrap_or(x);
    shortest(rounded)
}

/// A number with four digits, of what is not claimed to be exact.
pub(crate) fn few(x: f64) -> String {
    plain(rounded(x))
}

/// A number with six digits, of what is known to more than anybody reads.
pub(crate) fn six(x: f64) -> String {
    plain(format!("{x:.5e}").parse().unwrap_or(x))
}

/// A number rounded to four digits.
pub(crate) fn rounded(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

/// A span of time for people.
pub(crate) fn time(span: Duration) -> String {
    let seconds = span.as_secs_f64();
    if seconds < 1e-3 {
        format!("{:.0} µs", seconds * 1e6)
    } else if seconds < 0.1 {
        format!("{:.1} ms", seconds * 1e3)
    } else if seconds < 1.0 {
        format!("{:.0} ms", seconds * 1e3)
    } else {
        format!("{seconds:.2} s")
    }
}

/// A count with its digits in groups of three.
pub(crate) fn grouped(count: u64) -> String {
    let digits = count.to_string();
    let mut text = String::with_capacity(digits.len() * 4 / 3);
    for (i, digit) in digits.char_indices() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// A count with its noun, singular or plural.
pub(crate) fn counted(count: usize, noun: &str) -> String {
    const IRREGULAR: [[&str; 2]; 4] =
        [["vertex", "vertices"], ["body", "bodies"], ["hedron", "hedra"], ["branch", "branches"]];
    let irregular = IRREGULAR.iter().find_map(|[one, many]| Some((noun.strip_suffix(one)?, many)));
    let number = grouped(count as u64);
    match (count, irregular) {
        (1, _) => format!("{number} {noun}"),
        (_, Some((stem, many))) => format!("{number} {stem}{many}"),
        _ => format!("{number} {noun}s"),
    }
}

/// The size of a mesh.
pub(crate) fn vertices_and_faces(vertices: usize, faces: usize) -> String {
    format!("{}, {}", counted(vertices, "vertex"), counted(faces, "face"))
}

/// A point for people.
pub(crate) fn point(p: [f64; 3]) -> String {
    let [x, y, z] = p.map(plain);
    format!("({x}, {y}, {z})")
}

/// How many pairs of faces of a result intersect.
pub(crate) fn pairs_that_intersect(count: IntersectionCount) -> String {
    let before = match count.of_input {
        Some(before) => format!(", of the input {}", grouped(before as u64)),
        None => String::new(),
    };
    match (count.pairs, count.complete) {
        (0, true) => "no two faces".to_owned(),
        (pairs, true) => format!("{} of faces{before}", counted(pairs, "pair")),
        (pairs, false) => format!("more than {} of faces{before}", counted(pairs, "pair")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_have_their_nouns() {
        let of = |noun| [0, 1, 2000].map(|count| counted(count, noun));
        assert_eq!(of("face"), ["0 faces", "1 face", "2,000 faces"]);
        assert_eq!(of("seam vertex"), ["0 seam vertices", "1 seam vertex", "2,000 seam vertices"]);
        assert_eq!(of("tetrahedron"), ["0 tetrahedra", "1 tetrahedron", "2,000 tetrahedra"]);
    }

    #[test]
    fn memory_and_time_have_units_and_limits() {
        assert_eq!((memory("2GiB"), memory("3 MB"), memory("17")), (Ok(2 << 30), Ok(3_000_000), Ok(17)));
        assert!(memory("-1MB").is_err() && memory("lots").is_err());
        assert_eq!(duration("10s"), Ok(Duration::from_secs(10)));
        assert!(duration("10").is_err() && duration("-1s").is_err());
    }

    #[test]
    fn numbers_are_short_and_grouped() {
        assert_eq!([-0.0, 0.1 + 0.2, -1e20, 1e-5].map(plain), ["0", "0.3", "-1e20", "1e-5"]);
        assert_eq!([0, 999, 1000, 1_234_567].map(grouped), ["0", "999", "1,000", "1,234,567"]);
        assert_eq!(point([0.5, -1.0, 1e-9]), "(0.5, -1, 1e-9)");
        let spans = [5, 5_300, 120_000, 2_000_000].map(|us| time(Duration::from_micros(us)));
        assert_eq!(spans, ["5 µs", "5.3 ms", "120 ms", "2.00 s"]);
    }
}
