//! One face that reaches into several classes, cut until little of it is in doubt.

use super::super::criterion::Criterion;
use super::super::entry::Entry;
use super::super::face::Cutter;
use super::super::inside::Scratch;
use super::super::linear::{greater, lesser};
use super::super::polygon::Polygon;
use super::super::task::Faces;
use super::Bands;
use super::share::{Reach, Sign, Tally};
use super::side::{Side, SideOf};
use glam::DVec3;
use pompeiu_core::spatial::Slot;

/// The first width of pieces at an edge, as a part of the range of distances on the face and of the doubt that is allowed.
const FIRST: f64 = 0.25;
/// How much finer each attempt is, and how many there are.
const FINER: f64 = 0.1;
const ATTEMPTS: u32 = 6;
/// An attempt must leave no more than this part of the doubt, or it was the last.
const LEAST_PROGRESS: f64 = 0.8;
/// Pieces of a face at most.
const MOST_PIECES: usize = 1 << 14;
/// How often a piece is halved whose side is not known as a whole, and the least part of the doubt that is allowed for which it is.
const HALVINGS: u32 = 3;
const LEAST_DOUBT: f64 = 1e-2;

/// What faces are cut for. Lengths are in the frame.
pub(super) struct Cutting<'c> {
    pub(super) faces: &'c Faces<'c>,
    pub(super) sides: &'c SideOf<'c>,
    pub(super) bands: &'c Bands,
    /// Whether the deviation is positive inside of the other mesh.
    pub(super) inside_is_positive: bool,
    /// Distances that are no greater may be zero.
    pub(super) touching: f64,
    /// The part of the area of a face that may stay in doubt.
    pub(super) allowed: f64,
    /// Widths that never matter.
    pub(super) floor: f64,
}

/// A face that is cut, and what is known of it.
#[derive(Clone, Copy)]
struct Part<'p> {
    cutter: &'p Cutter<'p>,
    area: (f64, f64),
    of_face: &'p Reach,
    of_all: Sign,
    /// A face of the other mesh that is believed to be near.
    near: Slot,
}

impl Cutting<'_> {
    pub(super) fn sign_of(&self, inside: Option<bool>) -> Sign {
        match inside {
            Some(inside) if inside == self.inside_is_positive => Sign::Positive,
            Some(_) => Sign::Negative,
            None => Sign::Unknown,
        }
    }

    /// The classes of a face with a sign that may be known.
    pub(super) fn face(&self, cutter: &mut Cutter<'_>, face: u32, reach: &Reach, sign: Sign) -> Tally {
        let (start, area) = self.faces.start(face);
        let allowed = self.allowed * start.area;
        let range = greater(reach.greatest.1 - reach.least.0, self.floor);
        // At zero signs change.
        let focus =
            self.bands.edges().iter().map(|edge| edge.abs()).chain([0.0]).map(|at| (at, at)).collect();
        let mut criterion = Criterion {
            mass: f64::INFINITY,
            focus,
            focus_mass: FIRST * self.allowed * range * start.area,
            floor: self.floor,
        };
        let mut scratch = Scratch::default();
        let mut best: Option<Tally> = None;
        for _ in 0..ATTEMPTS {
            cutter.cut(&start, &criterion, MOST_PIECES);
            let mut tally = Tally::new(self.bands);
            for piece in &cutter.pieces {
                let part = Part { cutter, area, of_face: reach, of_all: sign, near: piece.near };
                self.piece(&part, &piece.polygon, HALVINGS, &mut scratch, &mut tally);
            }
            let before = best.as_ref().map_or(f64::INFINITY, |best| best.doubt);
            let stuck = tally.doubt > LEAST_PROGRESS * before;
            if tally.doubt < before || best.is_none() {
                best = Some(tally);
            }
            let doubt = best.as_ref().map_or(0.0, |best| best.doubt);
            if doubt <= allowed || stuck || self.faces.control.is_stopped() {
                break;
            }
            criterion.focus_mass *= FINER;
        }
        best.unwrap_or_else(|| Tally::new(self.bands))
    }

    fn piece(
        &self,
        part: &Part<'_>,
        polygon: &Polygon,
        halvings: u32,
        scratch: &mut Scratch,
        tally: &mut Tally,
    ) {
        let Part { cutter, area, of_face, of_all, .. } = *part;
        let count = polygon.outline.count;
        let fold =
            |row: &[f64], from: f64, of: fn(f64, f64) -> f64| row[..count].iter().copied().fold(from, of);
        let (least, most) = (of_face.least.0, of_face.greatest.1);
        let inside = |x: f64| lesser(greater(x, least), most);
        let mut reach = Reach {
            least: (
                inside(fold(&polygon.lower, f64::INFINITY, lesser)),
                inside(fold(&polygon.upper, f64::INFINITY, lesser)),
            ),
            greatest: (
                inside(fold(&polygon.lower, 0.0, greater)),
                inside(fold(&polygon.upper, 0.0, greater)),
            ),
            unsigned: 0.0,
        };
        let mut sign = of_all;
        if sign == Sign::Unknown
            && reach.class(sign, self.bands).is_none()
            && reach.greatest.0 > self.touching
        {
            // Where the function below is positive is convex, for it is concave: a part that does not meet the other surface, which so
            // lies on one side of it. Elsewhere the distance is at most by how much the two functions differ.
            let side = self.side_of_positive_part(part, polygon, scratch);
            sign = self.sign_of(side.known());
            let least = LEAST_DOUBT * self.allowed;
            if side == Side::OfCentre
                && halvings > 0
                && polygon.outline.share() > least
                && let Some(halves) = cutter.halve(polygon)
            {
                for half in &halves {
                    self.piece(part, half, halvings - 1, scratch, tally);
                }
                return;
            }
            if reach.least.0 <= self.touching {
                let widths = (0..count).map(|j| polygon.upper[j] - polygon.lower[j]);
                reach.unsigned = lesser(self.touching + widths.fold(0.0, greater), reach.greatest.1);
            }
        }
        tally.reach(&reach, sign);
        let class = reach.class(sign, self.bands);
        for triangle in polygon.outline.fan() {
            let entry = Entry::new(polygon, triangle, area);
            match class {
                Some(class) => tally.whole(class, entry.area()),
                None => tally.entry(&entry, sign, self.touching, self.bands),
            }
        }
    }

    /// Whether the part of a piece where its lower function is positive is inside of the other mesh.
    fn side_of_positive_part(&self, part: &Part<'_>, polygon: &Polygon, scratch: &mut Scratch) -> Side {
        let (cutter, outline) = (part.cutter, &polygon.outline);
        let (mut sum, mut at) = (0.0, [0.0; 2]);
        for j in 0..outline.count {
            let weight = greater(polygon.lower[j] - self.touching, 0.0);
            sum += weight;
            at = [at[0] + weight * outline.v[j], at[1] + weight * outline.w[j]];
        }
        let centre = cutter.point(at.map(|x| x / sum));
        let away = |j: usize| {
            let corner = cutter.point([outline.v[j], outline.w[j]]);
            DVec3::from_array(corner).distance(DVec3::from_array(centre))
        };
        let radius = (0..outline.count).map(away).fold(self.touching, greater);
        self.sides.side(centre, radius, part.near, scratch)
    }
}
