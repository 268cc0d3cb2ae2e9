//! Signed distances: negative inside the other surface, positive outside.
//!
//! On the part of a piece where the function below the distance is positive the sign is constant: that part is convex, for the function is
//! concave, and does not meet the other surface. Elsewhere on the piece the distance is at most by how much the two functions differ, and counts
//! with both signs. So the mean of the signed distance is hardly less narrow than that of the distance.

use super::bands::Extreme;
use super::corners::Start;
use super::entry::{LESS, MORE, Moments};
use super::face::Cutter;
use super::inside::{Inside, Scratch};
use super::linear::{greater, lesser};
use super::measure::VertexDistances;
use super::polygon::Piece;
use super::report::{Sides, unreferenced};
use super::statistics::{SignedStatistics, Statistics};
use crate::report::Enclosure;
use glam::DVec3;
use pompeiu_core::exact::Interval;
use pompeiu_core::geom::Frame;
use pompeiu_core::run::Control;
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;

/// Signed distances of one face, in the frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct SignedFace {
    /// Their integral.
    sum: (f64, f64),
    lowest: (f64, f64),
    highest: (f64, f64),
}

/// What tells on which side of the other surface faces and their parts lie.
pub(super) struct Signs<'s> {
    pub(super) inside: Inside<'s>,
    /// Winding numbers about the vertices; NaN where these are not known.
    pub(super) of_vertices: Vec<f64>,
}

/// What is kept while a face is cut, and from face to face.
#[derive(Default)]
pub(super) struct Recorded {
    /// Bounds on the integral of the distance over each entry of a face.
    integrals: Vec<(f64, f64)>,
    /// Corners of parts of the face of which it is known whether they are inside.
    known: Vec<Free>,
    scratch: Scratch,
}

/// A point of a face by its weights, about which nothing of the other surface is within a radius.
struct Free {
    at: [f64; 2],
    radius: f64,
    inside: bool,
}

impl Free {
    /// Whether another such point is on the same side for certain: one of them is in the ball about the other. `sides` are the lengths of
    /// the sides that weights count.
    fn reaches(&self, at: [f64; 2], radius: f64, sides: [f64; 2]) -> bool {
        let [v, w] = [0, 1].map(|k| (self.at[k] - at[k]).abs() * sides[k]);
        (v + w) * MORE < greater(self.radius, radius)
    }
}

impl Recorded {
    pub(super) fn push(&mut self, integral: (f64, f64)) {
        self.integrals.push(integral);
    }

    pub(super) fn clear(&mut self) {
        self.integrals.clear();
    }
}

/// Corners of parts of a face of which it is known whether they are inside, at most.
const REMEMBERED: usize = 48;
/// Vertices of a task.
const TASK: usize = 256;

impl<'s> Signs<'s> {
    /// Looks at all vertices of a mesh, whose distances are known. `to` is the other one. `None` if the control stops meanwhile.
    pub(super) fn new(
        mut inside: Inside<'s>,
        (from, to): (&TriMesh, &TriMesh),
        frame: &Frame,
        vertices: &VertexDistances,
        control: &Control,
    ) -> Option<Self> {
        let mut of_vertices = about_vertices(&inside, from, frame, vertices, control);
        let is_unknown = |(number, distance): (&f64, &f64)| number.is_nan() && *distance > inside.touching;
        if of_vertices.iter().zip(&vertices.distances).any(is_unknown) {
            inside.with_winding(to);
            of_vertices = about_vertices(&inside, from, frame, vertices, control);
        }
        (!control.is_stopped()).then_some(Self { inside, of_vertices })
    }

    /// The signed distances of the face that a cutter has cut last.
    pub(super) fn of_face(
        &self,
        cutter: &Cutter<'_>,
        corners: [u32; 3],
        start: &Start,
        sums: &Moments,
        recorded: &mut Recorded,
    ) -> SignedFace {
        let mut found = SignedFace::EMPTY;
        let area = start.area * MORE;
        let meets = |piece: &Piece| least_lower(piece) <= self.inside.touching;
        if !cutter.pieces.iter().any(meets) {
            let inside = self.of_corner(corners, start, 0);
            let all = sums.first.enclosure();
            for piece in &cutter.pieces {
                found.reach(piece, inside, false, self.inside.touching);
            }
            found.sum = signed((all.lower(), all.upper()), inside);
            return found;
        }
        let Recorded { integrals, known, scratch } = recorded;
        known.clear();
        for (corner, at) in [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].into_iter().enumerate() {
            let inside = self.of_corner(corners, start, corner);
            let radius = start.distances[corner] - self.inside.touching;
            known.extend(inside.map(|inside| Free { at, radius, inside }));
        }
        let [a, b, c] = start.corners.map(DVec3::from_array);
        let sides = [b.distance(a) * MORE, c.distance(a) * MORE];
        let mut sum = Interval::point(0.0);
        let mut next = 0;
        for piece in &cutter.pieces {
            let entries = next..next + piece.polygon.outline.fan().count();
            next = entries.end;
            let inside = self.of_piece(cutter, piece, sides, known, scratch);
            let meets = meets(piece);
            found.reach(piece, inside, meets, self.inside.touching);
            let (low, high) = integrals[entries]
                .iter()
                .fold((0.0, 0.0), |(low, high), more| ((low + more.0) * LESS, (high + more.1) * MORE));
            // Where the distance may be zero it is no more than what the functions differ by, and what counts as touching.
            let slack = 4.0 * self.inside.touching * area;
            let least = if meets { 2.0 * low - high * MORE - slack } else { low };
            let (low, high) = signed((lesser(least, low), high), inside);
            sum = sum + Interval::spanning(low, high);
        }
        found.sum = (sum.lower(), sum.upper());
        found
    }

    /// Whether a corner of a face is inside, if it is certain.
    fn of_corner(&self, corners: [u32; 3], start: &Start, corner: usize) -> Option<bool> {
        let number = self.of_vertices[corners[corner] as usize];
        let is_known = start.distances[corner] > self.inside.touching && !number.is_nan();
        is_known.then(|| Inside::is_inside(number))
    }

    /// Whether the part of a piece where the function below is positive is inside, if it is certain.
    fn of_piece(
        &self,
        cutter: &Cutter<'_>,
        piece: &Piece,
        sides: [f64; 2],
        known: &mut Vec<Free>,
        scratch: &mut Scratch,
    ) -> Option<bool> {
        let polygon = &piece.polygon;
        let outline = &polygon.outline;
        let at = |j: usize| [outline.v[j], outline.w[j]];
        let free = || (0..outline.count).filter(|j| polygon.lower[*j] > self.inside.touching);
        let radius = |j: usize| polygon.lower[j] - self.inside.touching;
        let reaching = |known: &&Free| free().any(|j| known.reaches(at(j), radius(j), sides));
        let inside = if let Some(known) = known.iter().rev().take(REMEMBERED).find(reaching) {
            known.inside
        } else {
            let farthest = free().reduce(|i, j| if polygon.lower[j] > polygon.lower[i] { j } else { i })?;
            Inside::is_inside(self.inside.about(cutter.point(at(farthest)), piece.near, scratch)?)
        };
        known.extend(free().map(|j| Free { at: at(j), radius: radius(j), inside }));
        Some(inside)
    }

    /// Winding numbers about vertices and about centroids of faces. No point of a face is nearer than `least` says.
    pub(super) fn sides(
        &self,
        from: &TriMesh,
        frame: &Frame,
        vertices: &VertexDistances,
        least: impl Fn(usize) -> f64 + Sync,
    ) -> Sides {
        let of_face = |(f, corners): (usize, &[u32; 3])| {
            let known = corners.map(|v| self.of_vertices[v as usize]);
            if least(f) > self.inside.touching && !known[0].is_nan() {
                return known[0];
            }
            let p = from.corners(FaceId(f as u32)).map(|p| DVec3::from_array(frame.map(p)));
            let centre = (p[0] + p[1] + p[2]) * (1.0 / 3.0);
            // Nothing of the other surface is as near to a corner as the centroid.
            let is_free = |corner: &usize| {
                let distance = vertices.distances[corners[*corner] as usize];
                !known[*corner].is_nan()
                    && p[*corner].distance(centre) * MORE < distance - self.inside.touching
            };
            if let Some(corner) = (0..3).find(is_free) {
                return known[corner];
            }
            let near = vertices.near[corners[0] as usize];
            let number = self.inside.about(centre.to_array(), near, &mut Scratch::default());
            number.or_else(|| known.into_iter().find(|number| !number.is_nan())).unwrap_or(0.0)
        };
        let mut vertex_winding: Vec<f64> =
            self.of_vertices.par_iter().map(|number| if number.is_nan() { 0.0 } else { *number }).collect();
        for v in unreferenced(from) {
            vertex_winding[v] = f64::NAN;
        }
        let face_winding = from.faces().par_iter().enumerate().map(of_face).collect();
        Sides { vertex_winding, face_winding, of_sheet: false }
    }
}

fn about_vertices(
    inside: &Inside<'_>,
    from: &TriMesh,
    frame: &Frame,
    vertices: &VertexDistances,
    control: &Control,
) -> Vec<f64> {
    let of_task = |(task, positions): (usize, &[[f64; 3]])| {
        let is_stopped = control.is_stopped();
        let mut scratch = Scratch::default();
        let of_vertex = |(i, p): (usize, &[f64; 3])| {
            let v = task * TASK + i;
            let is_free = vertices.distances[v] > inside.touching && !is_stopped;
            let number =
                if is_free { inside.about(frame.map(*p), vertices.near[v], &mut scratch) } else { None };
            number.unwrap_or(f64::NAN)
        };
        positions.iter().enumerate().map(of_vertex).collect::<Vec<_>>()
    };
    from.positions().par_chunks(TASK).enumerate().flat_map_iter(of_task).collect()
}

fn least_lower(piece: &Piece) -> f64 {
    let polygon = &piece.polygon;
    polygon.lower[..polygon.outline.count].iter().copied().fold(f64::INFINITY, lesser)
}

/// Bounds on a number with a sign; `low` may be negative.
fn signed((low, high): (f64, f64), inside: Option<bool>) -> (f64, f64) {
    match inside {
        Some(false) => (low, high),
        Some(true) => (-high, -low),
        None => (-high, high),
    }
}

impl SignedFace {
    const EMPTY: Self = Self {
        sum: (0.0, 0.0),
        lowest: (f64::INFINITY, f64::INFINITY),
        highest: (f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// Takes in what a piece reaches; one that meets the other surface may lie on both sides, where the functions differ.
    fn reach(&mut self, piece: &Piece, inside: Option<bool>, meets: bool, touching: f64) {
        let polygon = &piece.polygon;
        let count = polygon.outline.count;
        let fold =
            |row: &[f64], from: f64, of: fn(f64, f64) -> f64| row[..count].iter().copied().fold(from, of);
        let least = greater(fold(&polygon.lower, f64::INFINITY, lesser), 0.0);
        let least_at_most = fold(&polygon.upper, f64::INFINITY, lesser);
        let greatest = greater(fold(&polygon.lower, 0.0, greater), 0.0);
        let most = fold(&polygon.upper, 0.0, greater);
        let widest = (0..count).map(|j| polygon.upper[j] - polygon.lower[j]).fold(0.0, greater);
        let least = if meets { -lesser((widest + touching) * MORE, most) } else { least };
        let (lowest, highest) = match inside {
            Some(false) => ((least, least_at_most), (greatest, most)),
            Some(true) => ((-most, -greatest), (-least_at_most, -least)),
            None => ((-most, least_at_most), (-least_at_most, most)),
        };
        self.widen(lowest, highest);
    }

    fn widen(&mut self, lowest: (f64, f64), highest: (f64, f64)) {
        self.lowest = (lesser(self.lowest.0, lowest.0), lesser(self.lowest.1, lowest.1));
        self.highest = (greater(self.highest.0, highest.0), greater(self.highest.1, highest.1));
    }
}

/// The statistics of a direction from those of its faces, with what is known of the distance; none without an area.
pub(super) fn statistics(
    faces: impl Iterator<Item = Option<SignedFace>>,
    area: Interval,
    of_distance: &Statistics,
    largest: f64,
    frame: &Frame,
) -> Option<SignedStatistics> {
    let mut all = SignedFace::EMPTY;
    let mut sum = Interval::point(0.0);
    for face in faces {
        let face = face?;
        sum = sum + Interval::spanning(face.sum.0, face.sum.1);
        all.widen(face.lowest, face.highest);
    }
    if area.lower() <= 0.0 || all.lowest.0 == f64::INFINITY {
        return None;
    }
    let within = |(low, high): (f64, f64)| {
        let out = |x: f64| frame.length_out(greater(lesser(x, largest), -largest));
        Extreme { lower: out(low), upper: out(high) }
    };
    let mean = sum.divide_by_positive(area);
    let rms = Interval::spanning(of_distance.rms.lower(), of_distance.rms.upper());
    // No mean has a magnitude above that of the root of the mean square.
    let most = of_distance.rms.upper();
    let mean = within((mean.lower(), mean.upper()));
    let mean = Extreme { lower: greater(mean.lower, -most), upper: lesser(mean.upper, most) };
    let deviation = (rms.square() - Interval::spanning(mean.lower, mean.upper).square()).sqrt();
    let standard_deviation =
        Enclosure::new(lesser(deviation.lower(), most), lesser(deviation.upper(), most))?;
    Some(SignedStatistics {
        mean,
        standard_deviation,
        lowest: within(all.lowest),
        highest: within(all.highest),
    })
}
