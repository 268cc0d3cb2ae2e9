//! Where a piece is cut.

use super::super::candidates::Candidate;
use super::super::polygon::{MOST_CORNERS, Polygon};
use super::{Envelope, Look};

/// Corners that hang over a plane so little that this part of the allowed gap comes of it are no reason for a cut.
const OVERHANG: f64 = 0.125;
/// Where the functions of two faces cross so close to a corner, the middle is the better place.
const LEAST_CROSSING: f64 = 0.01;
/// A face that rises over the plane of its neighbour by less than this part of an edge forms no valley with it.
const LEAST_RISE: f64 = 1e-3;
/// Deeper pieces are only halved, which shrinks them for certain.
const HALVE_BELOW_DEPTH: u32 = 48;

impl Envelope<'_> {
    /// Cuts a piece where the nearest face ends, or where its plane is crossed, or the same for the face that is in the way; or where
    /// their distances are equal; or in the middle. `width` is what the piece should be cut to.
    pub(in super::super) fn cut(&self, polygon: &Polygon, look: &Look, width: f64) -> Option<[Polygon; 2]> {
        if polygon.outline.count == MOST_CORNERS {
            return polygon.cut_apart();
        }
        if polygon.outline.depth < HALVE_BELOW_DEPTH {
            // Beside a face at distance d by s, the distance from it is greater by about s^2 / 2d.
            let beside = OVERHANG * width;
            let beside = (beside * beside + 2.0 * beside * look.distance).sqrt();
            let nearest = &self.candidates[look.near as usize];
            if let Some((blocking, _)) = &look.blocking
                && let Some(parts) = cut_between(polygon, nearest, &self.candidates[*blocking as usize])
            {
                return Some(parts);
            }
            if let Some(parts) = cut_by_face(polygon, nearest, beside, OVERHANG * width) {
                return Some(parts);
            }
            if let Some((blocking, row)) = &look.blocking {
                if *blocking != look.near {
                    let blocking = &self.candidates[*blocking as usize];
                    if let Some(parts) = cut_by_face(polygon, blocking, beside, f64::INFINITY) {
                        return Some(parts);
                    }
                }
                for side in [std::array::from_fn(|j| row[j] - polygon.upper[j]), *row] {
                    if let Some([one, two]) = polygon.cut(&side) {
                        let (s, t) = (one.outline.share(), two.outline.share());
                        let lesser = if s < t { s } else { t };
                        if lesser > LEAST_CROSSING * (s + t) {
                            return Some([one, two]);
                        }
                    }
                }
            }
        }
        self.halve(polygon)
    }

    /// Cuts across the longest way between two corners.
    pub(in super::super) fn halve(&self, polygon: &Polygon) -> Option<[Polygon; 2]> {
        let (along, i, j) = polygon.outline.longest_way(&self.scale);
        if polygon.outline.count == 3 {
            return Some(polygon.halve(if i == 0 && j == 2 { 2 } else { i }));
        }
        let middle = [
            0.5 * (polygon.outline.v[i] + polygon.outline.v[j]),
            0.5 * (polygon.outline.w[i] + polygon.outline.w[j]),
        ];
        let side = std::array::from_fn(|k| {
            along.dot(self.scale.way([polygon.outline.v[k] - middle[0], polygon.outline.w[k] - middle[1]]))
        });
        polygon.cut(&side).or_else(|| polygon.cut_apart())
    }

    /// Length of the longest way between two corners.
    pub(in super::super) fn size(&self, polygon: &Polygon) -> f64 {
        let first = [polygon.outline.v[0], polygon.outline.w[0]];
        let away = |j: usize| {
            self.scale.way([polygon.outline.v[j] - first[0], polygon.outline.w[j] - first[1]]).length()
        };
        2.0 * (1..polygon.outline.count).map(away).fold(0.0, |m, x| if x > m { x } else { m })
    }
}

/// Cuts where the planes of two faces are equally far, if they meet in an edge and form a valley: then no other place is as near.
fn cut_between(polygon: &Polygon, one: &Candidate, other: &Candidate) -> Option<[Polygon; 2]> {
    if !(one.is_usable() && other.is_usable()) {
        return None;
    }
    let shared = one.corners.iter().filter(|p| other.corners.contains(p)).count();
    if shared != 2 {
        return None;
    }
    let at = polygon.outline.centre();
    let [one_below, other_below] = [one, other].map(|face| face.height.at(at) < 0.0);
    let g = if one_below { -one.normal } else { one.normal };
    let rise = other.reach_along(g, one.corners[0]);
    if rise <= LEAST_RISE * (one.corners[1] - one.corners[0]).length() {
        return None;
    }
    let (h, k) = (one.height.row(&polygon.outline), other.height.row(&polygon.outline));
    let same = one_below == other_below;
    let side = std::array::from_fn(|j| if same { h[j] - k[j] } else { h[j] + k[j] });
    let [one, two] = polygon.cut(&side)?;
    let (s, t) = (one.outline.share(), two.outline.share());
    let lesser = if s < t { s } else { t };
    (lesser > LEAST_CROSSING * (s + t)).then_some([one, two])
}

/// Cuts where a face ends, at the side that leaves most beyond it; or where its plane is crossed.
fn cut_by_face(polygon: &Polygon, face: &Candidate, beside: f64, height: f64) -> Option<[Polygon; 2]> {
    if !face.is_usable() {
        return None;
    }
    let mut best = (0.0, None);
    let sides = face.sides.each_ref().map(|side| (side.row(&polygon.outline), beside));
    for (row, least) in sides.into_iter().chain([(face.height.row(&polygon.outline), height)]) {
        let (mut low, mut high) = (row[0], row[0]);
        for x in &row[1..polygon.outline.count] {
            low = if *x < low { *x } else { low };
            high = if *x > high { *x } else { high };
        }
        let lesser = if high < -low { high } else { -low };
        if lesser > least && (best.1.is_none() || lesser > best.0) {
            best = (lesser, Some(row));
        }
    }
    polygon.cut(&best.1?)
}
