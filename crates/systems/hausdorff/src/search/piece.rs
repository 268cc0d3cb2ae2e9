//! A triangular piece of a face of A, and how it is cut.

use glam::DVec3;
use pompeiu_core::spatial::Slot;

/// Faces of B that a piece inherits from the one it was cut from.
pub(crate) const INHERITED: usize = 4;

/// A piece that was not yet discarded.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// Corners in the frame of the search.
    pub(crate) corners: [[f64; 3]; 3],
    /// Proven bound on the distance from B, rounding included.
    pub(crate) bound: f64,
    /// Faces of B believed to be near: the nearest first.
    pub(crate) near: [Slot; INHERITED],
    pub(crate) near_count: u8,
    /// Whether the first of those is known to be nearest to the centroid.
    pub(crate) nearest_known: bool,
    /// Whether an overlay may still settle it: it lies over too many faces, or is part of such a piece.
    pub(crate) overlay: bool,
    /// Cuts between the face and this piece.
    pub(crate) depth: u32,
    /// The face of A.
    pub(crate) face: u32,
}

impl Piece {
    /// A whole face of A, of which nothing is known but some face of B.
    pub(crate) fn whole(face: u32, corners: [[f64; 3]; 3], hint: Slot) -> Self {
        Self {
            corners,
            bound: f64::INFINITY,
            near: [hint; INHERITED],
            near_count: 1,
            nearest_known: false,
            overlay: false,
            depth: 0,
            face,
        }
    }

    pub(crate) fn near(&self) -> &[Slot] {
        &self.near[..self.near_count as usize]
    }

    /// Adds a face of B that may be near where there is room.
    pub(crate) fn also_near(&mut self, slot: Option<Slot>) {
        if let Some(slot) = slot
            && (self.near_count as usize) < INHERITED
            && !self.near().contains(&slot)
        {
            self.near[self.near_count as usize] = slot;
            self.near_count += 1;
        }
    }

    /// Cuts the longest edge in the middle.
    pub(crate) fn bisect(&self) -> Parts {
        bisect(&self.corners.map(DVec3::from_array))
    }

    /// Cuts where the nearest face of B ends, if that leaves a fraction of the piece on both sides.
    pub(crate) fn prism_cut(&self, nearest: [[f64; 3]; 3], reach: f64, least_part: f64) -> Option<Parts> {
        if self.depth >= BISECT_BELOW_DEPTH {
            return None;
        }
        let corners = self.corners.map(DVec3::from_array);
        let crossing = best_prism_plane(&corners, nearest, LEAST_OVERHANG * reach)?;
        (crossing.lesser_part() > least_part).then(|| crossing.parts(&corners))
    }

    pub(crate) fn area(&self) -> f64 {
        let [a, b, c] = self.corners.map(DVec3::from_array);
        0.5 * (b - a).cross(c - a).length()
    }

    /// Length of the longest edge.
    pub(crate) fn size(&self) -> f64 {
        longest_edge(&self.corners)
    }
}

pub(crate) fn longest_edge(corners: &[[f64; 3]; 3]) -> f64 {
    let [a, b, c] = corners.map(DVec3::from_array);
    a.distance(b).max(b.distance(c)).max(c.distance(a))
}

/// Cuts by planes must leave this fraction of the piece on both sides; a smaller part is not worth a piece.
pub(crate) const LEAST_PART: f64 = 1e-12;
/// Corners that hang over a plane by less than this part of the tolerance do not keep a face from covering the piece.
pub(crate) const LEAST_OVERHANG: f64 = 0.125;
/// Deeper pieces are only bisected, which shrinks them for certain.
pub(crate) const BISECT_BELOW_DEPTH: u32 = 64;

/// Up to three triangles.
pub(crate) struct Parts {
    triangles: [[[f64; 3]; 3]; 3],
    count: usize,
}

impl Parts {
    fn push(&mut self, triangle: [DVec3; 3]) {
        self.triangles[self.count] = triangle.map(|p| p.to_array());
        self.count += 1;
    }

    pub(crate) fn as_slice(&self) -> &[[[f64; 3]; 3]] {
        &self.triangles[..self.count]
    }
}

/// A line across a triangle: corner `apex` lies alone on one side; the line meets the edges from it to the next and to the
/// one after at these fractions.
pub(crate) struct Crossing {
    pub(crate) apex: usize,
    pub(crate) next: f64,
    pub(crate) after: f64,
}

impl Crossing {
    /// Fraction of the area on the lesser side.
    pub(crate) fn lesser_part(&self) -> f64 {
        let part = self.next * self.after;
        if part < 0.5 { part } else { 1.0 - part }
    }

    fn parts(&self, corners: &[DVec3; 3]) -> Parts {
        let [p, q, r] = [0, 1, 2].map(|i| corners[(self.apex + i) % 3]);
        let mut parts = Parts { triangles: [[[0.0; 3]; 3]; 3], count: 0 };
        // A line through a corner, nearly: let it be exactly. But not through two, which would leave the piece whole.
        let (at_next, at_after) = (self.next > 1.0 - LEAST_PART, self.after > 1.0 - LEAST_PART);
        let (at_next, at_after) = (at_next && !at_after, at_after && !at_next);
        let s = if at_next { q } else { p + self.next * (q - p) };
        let t = if at_after { r } else { p + self.after * (r - p) };
        parts.push([p, s, t]);
        if at_next {
            parts.push([q, r, t]);
        } else if at_after {
            parts.push([s, q, r]);
        } else if s.distance_squared(r) < q.distance_squared(t) {
            parts.push([s, q, r]);
            parts.push([s, r, t]);
        } else {
            parts.push([q, r, t]);
            parts.push([q, t, s]);
        }
        parts
    }
}

/// Where the side plane of the prism over a triangle that leaves most on its lesser side crosses the piece.
pub(crate) fn best_prism_plane(
    corners: &[DVec3; 3],
    triangle: [[f64; 3]; 3],
    least: f64,
) -> Option<Crossing> {
    let t = triangle.map(DVec3::from_array);
    let normal = (t[1] - t[0]).cross(t[2] - t[0]);
    let mut best: Option<Crossing> = None;
    for i in 0..3 {
        let (from, to) = (t[i], t[(i + 1) % 3]);
        let across = normal.cross(to - from);
        let side = corners.map(|c| across.dot(c - from));
        let least = least * across.length();
        if !(side.iter().any(|s| *s > least) && side.iter().any(|s| *s < -least)) {
            continue;
        }
        let Some(crossing) = crossing(side) else { continue };
        let part = crossing.lesser_part();
        if part > LEAST_PART && best.as_ref().is_none_or(|b| part > b.lesser_part()) {
            best = Some(crossing);
        }
    }
    best
}

/// The line on which a linear function with these values at the corners vanishes, if it crosses the triangle.
pub(crate) fn crossing(side: [f64; 3]) -> Option<Crossing> {
    for apex in 0..3 {
        let [p, q, r] = [0, 1, 2].map(|i| side[(apex + i) % 3]);
        if p > 0.0 && q <= 0.0 && r <= 0.0 || p < 0.0 && q >= 0.0 && r >= 0.0 {
            return Some(Crossing { apex, next: p / (p - q), after: p / (p - r) });
        }
    }
    None
}

fn bisect(corners: &[DVec3; 3]) -> Parts {
    let length = |i: usize| corners[i].distance_squared(corners[(i + 1) % 3]);
    let longest = (1..3).fold(0, |l, i| if length(i) > length(l) { i } else { l });
    let [p, q, r] = [0, 1, 2].map(|i| corners[(longest + i) % 3]);
    let middle = p + 0.5 * (q - p);
    let mut parts = Parts { triangles: [[[0.0; 3]; 3]; 3], count: 0 };
    parts.push([p, middle, r]);
    parts.push([middle, q, r]);
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn area(t: &[[f64; 3]; 3]) -> f64 {
        let [a, b, c] = t.map(DVec3::from_array);
        0.5 * (b - a).cross(c - a).length()
    }

    proptest! {
        /// Inside a plane, parts lie in the piece and their areas add up: they partition it.
        #[test]
        fn parts_cover_the_piece(
            corners in [[-1.0..1.0_f64, -1.0..1.0], [-1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0]],
            nearest in [[-1.0..1.0, -1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0, -1.0..1.0], [-1.0..1.0, -1.0..1.0, -1.0..1.0]],
            depth in 0..100_u32,
        ) {
            let corners = corners.map(|[x, y]| [x, y, 0.0]);
            let piece = Piece { depth, ..Piece::whole(0, corners, first_slot()) };
            let parts = cut(&piece, nearest);
            let total: f64 = parts.as_slice().iter().map(area).sum();
            prop_assert!((total - area(&corners)).abs() < 1e-14);
            for corner in parts.as_slice().iter().flatten() {
                let beta = pompeiu_core::geom::point_triangle::closest_barycentric(*corner, corners);
                let q: [f64; 3] = [0, 1, 2].map(|k| (0..3).map(|i| beta[i] * corners[i][k]).sum());
                prop_assert!((DVec3::from_array(q) - DVec3::from_array(*corner)).length() < 1e-14);
            }
        }
    }

    /// Cuts where the face ends, or else in the middle.
    fn cut(piece: &Piece, nearest: [[f64; 3]; 3]) -> Parts {
        piece.prism_cut(nearest, 0.0, LEAST_PART).unwrap_or_else(|| piece.bisect())
    }

    fn first_slot() -> Slot {
        let mesh = pompeiu_core::TriMesh::new(vec![[0.0; 3]], vec![[0, 0, 0]]).unwrap();
        crate::Target::new(&mesh).bvh().any_slot()
    }

    #[test]
    fn cuts_where_the_nearest_face_ends() {
        let corners = [[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
        let piece = Piece::whole(0, corners, first_slot());
        let parts = cut(&piece, [[0.0, -5.0, 0.0], [0.0, 5.0, 0.0], [-9.0, 0.0, 0.0]]);
        let mut xs: Vec<f64> = parts.as_slice().iter().flatten().map(|c| c[0]).collect();
        xs.sort_by(f64::total_cmp);
        assert_eq!(parts.as_slice().len(), 2);
        assert_eq!(xs, [-1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    }

    /// A plane just inside an edge leaves a strip too thin for its corners to be told from those of the piece, though not
    /// for its area; a cut that leaves the piece whole would be made again and again.
    #[test]
    fn every_part_of_a_cut_is_less_than_the_piece() {
        let corners = [[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
        let piece = Piece::whole(0, corners, first_slot());
        for thickness in [0.1, 0.4, 0.6, 0.7, 0.9, 1.1, 10.0, 1e6].map(|x| x * LEAST_PART) {
            let parts = cut(&piece, [[-9.0, thickness, 0.0], [9.0, thickness, 0.0], [0.0, 9.0, 0.0]]);
            for part in parts.as_slice() {
                assert!(area(part) < 1.0 - 0.5 * LEAST_PART, "{thickness:e} {part:?}");
            }
        }
    }
}
