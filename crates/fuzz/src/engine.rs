//! The engine on small soups that bytes describe, beside an oracle in exact arithmetic.

use pompeiu::core::TriMesh;
use pompeiu::core::geom::Aabb;
use pompeiu::core::run::Limits;
use pompeiu::hausdorff::certificate::{CertificateOptions, Goal, write_certificate};
use pompeiu::hausdorff::{DeviationOptions, DirectedDeviation, Enclosure, HausdorffOptions, StopReason};
use pompeiu_testkit::certificate::is_true;
use pompeiu_testkit::oracle::directed;
use pompeiu_verify::{Soup, verify};

/// Triangles that the oracle splits.
const SPLITS: usize = 150;
/// Pieces that a deviation of some faces on a lattice or near one looks at, at most.
const MOST_LOOKS: u64 = 200_000;
/// The limit on pieces elsewhere: needles of any length beside each other can take millions.
const MOST_PIECES: usize = 50_000;

/// What coordinates are made of.
struct Source<'s> {
    bytes: std::slice::Iter<'s, u8>,
    kind: u8,
}

impl Source<'_> {
    fn byte(&mut self) -> Option<i8> {
        self.bytes.next().map(|byte| byte.cast_signed())
    }

    /// On a lattice, near it, of any magnitude, or with all bits of a single.
    fn coordinate(&mut self) -> Option<f64> {
        let first = f64::from(self.byte()?);
        Some(match self.kind {
            0 => 0.25 * first,
            1 => 0.25 * first + f64::from(self.byte()?) * 2_f64.powi(-48),
            2 => first * 2_f64.powi(i32::from(self.byte()? / 4)),
            _ => {
                let rest = [self.byte()?, self.byte()?, self.byte()?].map(i8::cast_unsigned);
                let number = f32::from_le_bytes([rest[0], rest[1], rest[2], (first as i8).cast_unsigned()]);
                if number.is_finite() && (1e-12..1e12).contains(&number.abs()) {
                    f64::from(number)
                } else {
                    0.0
                }
            }
        })
    }

    fn soup(&mut self, faces: u8) -> Option<TriMesh> {
        let mut positions = Vec::new();
        for _ in 0..3 * faces {
            positions.push([self.coordinate()?, self.coordinate()?, self.coordinate()?]);
        }
        let faces = (0..u32::from(faces)).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
        TriMesh::new(positions, faces).ok()
    }
}

/// Two soups of one to four faces: the kind of coordinates and the numbers of faces are in the first byte.
fn soups(bytes: &[u8]) -> Option<[TriMesh; 2]> {
    let (first, rest) = bytes.split_first()?;
    let mut source = Source { bytes: rest.iter(), kind: first & 3 };
    Some([source.soup(1 + (first >> 2 & 3))?, source.soup(1 + (first >> 4 & 3))?])
}

fn limits() -> Limits {
    Limits { threads: Limits::threads(1).ok(), ..Limits::default() }
}

/// The enclosures hold the exact distances, and their certificates are written, accepted and true.
pub(crate) fn distance(bytes: &[u8]) {
    let Some([a, b]) = soups(bytes) else { return };
    let options = HausdorffOptions { limits: limits(), ..HausdorffOptions::default() };
    let report = options.symmetric(&a, &b).expect("the default options");
    for (from, to, found) in [(&a, &b, &report.a_to_b), (&b, &a, &report.b_to_a)] {
        let exact = directed(from, to, SPLITS);
        let distance = found.distance;
        assert!(exact.allows_upper(distance.upper()), "{:?} {distance:?}", exact.rounded());
        assert!(exact.allows_lower(distance.lower()), "{:?} {distance:?}", exact.rounded());
        assert!(distance.gap() <= found.tolerance || found.stop == StopReason::Rounding, "{found:?}");
    }
    let slack = Goal::SLACK * Aabb::of_faces(&a).union(Aabb::of_faces(&b)).diagonal();
    let mut certificate = Vec::new();
    let written = write_certificate(
        &a,
        &b,
        Goal::of_both(&report, slack),
        &CertificateOptions { limits: limits() },
        &mut certificate,
    );
    assert!(written.is_ok(), "{written:?}");
    let soup = |mesh| -> Soup<'_> { soup_of(mesh) };
    let verdict = verify(&soup(&a), &soup(&b), &certificate[..], 1);
    assert!(verdict.is_ok(), "{verdict:?}");
    assert!(is_true(&a, &b, &certificate));
}

fn soup_of(mesh: &TriMesh) -> Soup<'_> {
    Soup::new(mesh.positions(), mesh.faces()).expect("a mesh is finite and has a face")
}

/// Statistics agree with each other and with the largest distance, and end, or say why they are wider than asked for.
pub(crate) fn deviation(bytes: &[u8]) {
    let Some([a, b]) = soups(bytes) else { return };
    let is_lattice = bytes[0] & 3 < 2;
    let pieces = (!is_lattice).then_some(MOST_PIECES);
    let options = DeviationOptions { limits: Limits { pieces, ..limits() }, ..DeviationOptions::default() };
    for (from, to) in [(&a, &b), (&b, &a)] {
        let found = options.directed(from, to).expect("the default options");
        assert!(!is_lattice || found.work.looks <= MOST_LOOKS, "{:?}", found.work);
        holds(&options, &found);
    }
}

fn holds(options: &DeviationOptions<'_>, found: &DirectedDeviation) {
    let Some(statistics) = &found.statistics else { return };
    let largest = found.distance.distance.upper();
    // No mean exceeds the root of the mean square, which does not exceed the largest value, beyond rounding.
    let room = 1e-9 * largest + found.floor;
    assert!(statistics.mean.lower() <= statistics.rms.upper() + room, "{statistics:?}");
    assert!(statistics.rms.lower() <= largest + room, "{statistics:?} {largest}");
    let mut before = 0.0;
    for percentile in &statistics.percentiles {
        assert!(percentile.distance.upper() >= before, "{statistics:?}");
        before = percentile.distance.lower();
    }
    let allowed = |ends: &Enclosure| options.accuracy * ends.lower() + found.floor;
    let all = statistics.percentiles.iter().map(|p| &p.distance).chain([&statistics.mean, &statistics.rms]);
    let is_narrow = all.into_iter().all(|ends| ends.gap() <= allowed(ends));
    assert!(is_narrow || found.stop != StopReason::Tolerance, "{:?} {statistics:?}", found.stop);
}
