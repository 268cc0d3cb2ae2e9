//! A triangle of A cut along the edges of faces of B, until each part is within the limit of one face.
//!
//! The distance from a face is convex, so the corners of a part bound it on the part. That holds wherever the cuts are: they are
//! placed where a part leaves the face that it is compared with, seen along the normal of that face. Where few faces are
//! under a triangle this takes less than an overlay.

use super::feet::Feet;
use super::overlay::{Below, clamped};
use pompeiu_core::spatial::Slot;

/// Parts that are compared, and cuts, at most: beyond, an overlay takes less.
const MOST_COMPARED: usize = 16;
pub(super) const MOST_CUTS: u32 = 8;
/// A part that reaches beyond an edge by more than this many heights of its face lies over too many others.
const FARTHEST: f64 = 1.0;
/// Corners of a part at most, and of one that has just been cut.
const CORNERS: usize = 4;
const CORNERS_AFTER_CUT: usize = 5;

/// The parts of a triangle.
#[derive(Default)]
pub(super) struct CutParts {
    /// Those that are yet to be compared.
    open: Vec<Part>,
    /// Whether those within the limit are listed.
    pub(super) keep_all: bool,
    /// With bounds on their squared distances.
    pub(super) covered: Vec<(Part, f64)>,
}

/// A convex part of a triangle.
#[derive(Clone, Copy)]
pub(super) struct Part {
    /// The corners, coordinate by coordinate; the last one again where there are three.
    points: [[f64; CORNERS]; 3],
    count: usize,
    /// The face it is compared with.
    pub(super) slot: Slot,
}

/// The corners of what lies on one side of a cut.
#[derive(Default)]
struct Side {
    corners: [[f64; 3]; CORNERS_AFTER_CUT],
    count: usize,
}

impl CutParts {
    /// `keep_all`: list all parts within the limit.
    pub(super) fn new(keep_all: bool) -> Self {
        Self { keep_all, ..Self::default() }
    }

    /// A bound on the squared distances of a triangle, if all of its parts are within the limit of a face. `start` is a face near its
    /// centre. Counts the distances that are bounded.
    pub(super) fn cover(
        &mut self,
        corners: &[[f64; 3]; 3],
        below: &Below<'_>,
        start: Slot,
        feet: &mut Feet,
        distances: &mut u64,
    ) -> Option<f64> {
        let limit_sq = below.limit_sq;
        self.open.clear();
        self.covered.clear();
        self.open.push(Part::new(corners, start));
        let mut farthest = 0.0;
        let mut cuts = 0;
        for _ in 0..MOST_COMPARED {
            let Some(part) = self.open.pop() else { return Some(farthest) };
            let foot = feet.of(below.bvh, part.slot);
            let bounds = foot.bounds_sq(&part.points);
            *distances += part.count as u64;
            let apart = (1..CORNERS).fold(0, |apart, j| if bounds[j] > bounds[apart] { j } else { apart });
            if bounds[apart] <= limit_sq {
                farthest = if bounds[apart] > farthest { bounds[apart] } else { farthest };
                if self.keep_all {
                    self.covered.push((part, bounds[apart]));
                }
                continue;
            }
            let weights = foot.four_weights(&part.points);
            let opposite =
                (1..3).fold(0, |least, i| if weights[i][apart] < weights[least][apart] { i } else { least });
            let beyond = weights[opposite];
            if !(beyond[apart] < 0.0 && beyond[apart] > -FARTHEST) {
                return None;
            }
            // The edge opposite to a corner leads from the next one.
            let across = below.neighbours.across(part.slot, (opposite + 1) % 3)?;
            let leaves: [bool; CORNERS] = std::array::from_fn(|j| bounds[j] > limit_sq && beyond[j] < 0.0);
            if leaves[..part.count].iter().all(|leaves| *leaves) {
                self.open.push(Part { slot: across.slot, ..part });
                continue;
            }
            if cuts == MOST_CUTS {
                return None;
            }
            cuts += 1;
            for (side, slot) in part.cut(leaves, &beyond)?.iter().zip([part.slot, across.slot]) {
                self.open.extend(side.parts(slot));
            }
        }
        self.open.is_empty().then_some(farthest)
    }
}

impl Part {
    fn new(corners: &[[f64; 3]], slot: Slot) -> Self {
        let mut points = [[0.0; CORNERS]; 3];
        for j in 0..CORNERS {
            let corner = corners[if j < corners.len() { j } else { corners.len() - 1 }];
            for k in 0..3 {
                points[k][j] = corner[k];
            }
        }
        Self { points, count: corners.len(), slot }
    }

    /// The triangles around its first corner.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
        (2..self.count).map(|j| [self.corner(0), self.corner(j - 1), self.corner(j)])
    }

    fn corner(&self, j: usize) -> [f64; 3] {
        [self.points[0][j], self.points[1][j], self.points[2][j]]
    }

    /// What stays, and what leaves by an edge. None unless it is cut once.
    fn cut(&self, leaves: [bool; CORNERS], beyond: &[f64; CORNERS]) -> Option<[Side; 2]> {
        let mut sides = [Side::default(), Side::default()];
        let mut crossings = 0;
        for i in 0..self.count {
            let j = if i + 1 == self.count { 0 } else { i + 1 };
            let (p, q) = (self.corner(i), self.corner(j));
            sides[usize::from(leaves[i])].push(p)?;
            if leaves[i] != leaves[j] {
                crossings += 1;
                let t = clamped(beyond[i] / (beyond[i] - beyond[j]));
                let crossing = [0, 1, 2].map(|k| p[k] + t * (q[k] - p[k]));
                for side in &mut sides {
                    side.push(crossing)?;
                }
            }
        }
        (crossings == 2).then_some(sides)
    }
}

impl Side {
    fn push(&mut self, corner: [f64; 3]) -> Option<()> {
        *self.corners.get_mut(self.count)? = corner;
        self.count += 1;
        Some(())
    }

    /// One part, or two.
    fn parts(&self, slot: Slot) -> impl Iterator<Item = Part> {
        let [a, .., d, e] = self.corners;
        let whole = &self.corners[..self.count.min(CORNERS)];
        let rest = (self.count > CORNERS).then(|| Part::new(&[a, d, e], slot));
        std::iter::once(Part::new(whole, slot)).chain(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::super::overlay::{lattice, sheet};
    use super::*;
    use crate::Target;
    use pompeiu_core::spatial::Workspace;
    use pompeiu_testkit::effort::cases;
    use pompeiu_testkit::plain::point_triangles;
    use proptest::prelude::*;

    fn cover(t: &[[f64; 3]; 3], target: &Target, limit: f64) -> Option<f64> {
        let (bvh, neighbours) = (target.bvh(), target.neighbours().unwrap());
        let centre = [0, 1, 2].map(|k| (t[0][k] + t[1][k] + t[2][k]) / 3.0);
        let start = bvh.nearest(centre, bvh.any_slot(), &mut Workspace::default()).slot;
        let below = Below { bvh, neighbours, limit_sq: limit * limit };
        CutParts::default().cover(t, &below, start, &mut Feet::default(), &mut 0)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(cases(512)))]

        /// Over folds and the ends of a sheet: no point of a triangle that counts as covered is farther than what is said.
        #[test]
        fn parts_bound_the_distance(
            corners in [[0.0..1.0_f64, 0.0..1.0, -0.05..0.05], [0.0..1.0, 0.0..1.0, -0.05..0.05], [0.0..1.0, 0.0..1.0, -0.05..0.05]],
            cells in 1..4_u32, roughness in prop_oneof![Just(0.0), 0.0..0.2_f64], seed in 0..50_u64,
            missing in prop::collection::vec(0..50_usize, 0..3), limit in 0.01..0.4_f64,
        ) {
            let target = Target::new(&sheet(cells, roughness, seed, &missing));
            let t = corners.map(|[x, y, z]| target.frame().map([x - 0.5, y - 0.5, z]));
            let limit = target.frame().length_in(limit);
            if let Some(bound_sq) = cover(&t, &target, limit) {
                prop_assert!(bound_sq <= limit * limit);
                let triangles: Vec<_> = target.bvh().slots().map(|slot| target.bvh().corners(slot)).collect();
                for x in lattice(&t) {
                    let far = point_triangles(x, &triangles);
                    prop_assert!(far <= bound_sq.sqrt() + 1e-14, "{x:?}: {far} {bound_sq}");
                }
            }
        }
    }

    /// A triangle over two faces of a flat sheet, tilted, is as far as its farthest corner.
    #[test]
    fn two_faces_cover_what_neither_does() {
        let target = Target::new(&sheet(1, 0.0, 0, &[]));
        let place = |p| target.frame().map(p);
        let t = [place([-0.3, -0.2, 0.01]), place([0.2, -0.3, 0.02]), place([0.1, 0.3, 0.03])];
        let far = |limit| cover(&t, &target, target.frame().length_in(limit));
        let bound = target.frame().length_out(far(0.04).unwrap().sqrt());
        assert!((bound - 0.03).abs() < 1e-15, "{bound}");
        assert!(far(0.029).is_none());
    }
}
