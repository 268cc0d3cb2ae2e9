//! A piece of A cut along the bisectors of faces of B that are near it, into cells of which each is nearest to one face.
//!
//! The points that are equally far from two vertices lie in a plane. The distance from any other face is linear around a point up to terms of
//! second order, so that cutting again doubles the digits. So where the maximum is a peak between faces, the cells that meet
//! there are each covered by their face, and where it is attained along a line between two faces they are long and thin beside it; parts
//! of equal sides would be as many as the line is longer than they are.
//!
//! The distance from a face is convex, so the corners of a cell bound it on the cell, wherever the cuts are.

use glam::DVec3;
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::spatial::{Bvh, Slot};

/// Corners of a cell, and cells of a piece, at most: where there are more, the cells are those before the face that makes them.
const MOST_CORNERS: usize = 8;
pub(super) const MOST_CELLS: usize = 16;

/// A convex part of a piece.
#[derive(Clone, Copy)]
pub(super) struct Cell {
    corners: [DVec3; MOST_CORNERS],
    count: usize,
    /// The place of the face that it is nearest to.
    pub(super) face: usize,
    /// Cuts between the piece and this cell.
    pub(super) cuts: u32,
}

impl Cell {
    /// All of a piece, with the first face.
    fn whole(corners: &[[f64; 3]; 3]) -> Self {
        let mut cell = Self::new(0, 0);
        for (place, corner) in cell.corners.iter_mut().zip(corners) {
            *place = DVec3::from_array(*corner);
        }
        cell.count = corners.len();
        cell
    }

    fn new(face: usize, cuts: u32) -> Self {
        Self { corners: [DVec3::ZERO; MOST_CORNERS], count: 0, face, cuts }
    }

    /// None where there is no room.
    fn push(&mut self, corner: DVec3) -> Option<()> {
        *self.corners.get_mut(self.count)? = corner;
        self.count += 1;
        Some(())
    }

    pub(super) fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    /// The triangles around its first corner.
    pub(super) fn triangles(&self) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
        self.corners()
            .windows(2)
            .skip(1)
            .map(|edge| [self.corners[0], edge[0], edge[1]].map(|p| p.to_array()))
    }

    /// What lies where a function is not negative and where it is, given its values at the corners. None unless it changes its sign
    /// twice around the cell, or where there is no room.
    fn cut(&self, values: &[f64; MOST_CORNERS]) -> Option<[Self; 2]> {
        let mut sides = [Self::new(self.face, self.cuts + 1), Self::new(self.face, self.cuts + 1)];
        let mut crossings = 0;
        for i in 0..self.count {
            let j = if i + 1 == self.count { 0 } else { i + 1 };
            sides[usize::from(values[i] < 0.0)].push(self.corners[i])?;
            if (values[i] < 0.0) != (values[j] < 0.0) {
                crossings += 1;
                let t = values[i] / (values[i] - values[j]);
                let crossing = self.corners[i] + t * (self.corners[j] - self.corners[i]);
                for side in &mut sides {
                    side.push(crossing)?;
                }
            }
        }
        (crossings == 2).then_some(sides)
    }
}

/// The distance from a face as seen from a point.
struct Seen {
    /// The point of the face that is nearest.
    foot: DVec3,
    is_vertex: bool,
    distance: f64,
    slope: DVec3,
}

impl Seen {
    fn new(x: DVec3, face: [[f64; 3]; 3]) -> Self {
        let weights = closest_barycentric(x.to_array(), face);
        let [a, b, c] = face.map(DVec3::from_array);
        let foot = weights[0] * a + weights[1] * b + weights[2] * c;
        let away = x - foot;
        let is_vertex = weights.contains(&1.0);
        let slope = slope(away, &weights, [a, b, c]);
        Self { foot, is_vertex, distance: away.length(), slope }
    }

    /// A linear function that is about as great as the other face is farther than this one: its value at the point, and its gradient.
    /// Its sign is exact where the nearest points of both are vertices everywhere.
    fn farther(&self, other: &Self) -> (f64, DVec3) {
        if self.is_vertex && other.is_vertex && self.distance + other.distance > 0.0 {
            let inverse_mean = 2.0 / (self.distance + other.distance);
            (other.distance - self.distance, inverse_mean * (self.foot - other.foot))
        } else {
            (other.distance - self.distance, other.slope - self.slope)
        }
    }
}

/// The gradient of the distance from a face with these corners, given what leads to a point from the nearest point of the face and that one's
/// weights. Inside a face it is a normal of the face: beside a distance of 1e-10 the nearest point's rounding turns `away` by 1e-6.
fn slope(away: DVec3, weights: &[f64; 3], [a, b, c]: [DVec3; 3]) -> DVec3 {
    let direction = away.normalize_or_zero();
    if weights.contains(&0.0) {
        return direction;
    }
    let normal = (b - a).cross(c - a).normalize_or_zero();
    if normal == DVec3::ZERO { direction } else { normal * normal.dot(away).signum() }
}

/// Memory that cuts reuse: the faces, the distances from them, and the cells of the last piece.
#[derive(Default)]
pub(super) struct Bisectors {
    pub(super) slots: Vec<Slot>,
    seen: Vec<Seen>,
    pub(super) cells: Vec<Cell>,
}

impl Bisectors {
    /// Cuts a piece between faces of B, as seen from the point `around`; false where it stays whole. Faces that differ by no more than `least` on
    /// one side of a cut are not told apart.
    pub(super) fn cut(
        &mut self,
        corners: &[[f64; 3]; 3],
        around: [f64; 3],
        bvh: &Bvh,
        slots: impl Iterator<Item = Slot>,
        least: f64,
    ) -> bool {
        let x = DVec3::from_array(around);
        self.slots.clear();
        self.slots.extend(slots);
        self.seen.clear();
        self.seen.extend(self.slots.iter().map(|slot| Seen::new(x, bvh.corners(*slot))));
        self.cells.clear();
        self.cells.push(Cell::whole(corners));
        for other in 1..self.seen.len() {
            for at in 0..self.cells.len() {
                self.cut_cell(at, other, x, least);
            }
        }
        self.cells.len() > 1
    }

    /// Gives the part of a cell that is nearer to another face to that.
    fn cut_cell(&mut self, at: usize, other: usize, x: DVec3, least: f64) {
        let cell = &mut self.cells[at];
        let (at_x, gradient) = self.seen[cell.face].farther(&self.seen[other]);
        let mut values = [0.0; MOST_CORNERS];
        let (mut nearer, mut farther) = (0.0, 0.0);
        for (value, corner) in values.iter_mut().zip(cell.corners()) {
            *value = at_x + gradient.dot(*corner - x);
            nearer = if *value < nearer { *value } else { nearer };
            farther = if *value > farther { *value } else { farther };
        }
        if nearer >= -least {
            return;
        }
        if farther <= least {
            cell.face = other;
        } else if self.cells.len() < MOST_CELLS
            && let Some([stays, leaves]) = self.cells[at].cut(&values)
        {
            self.cells[at] = stays;
            self.cells.push(Cell { face: other, ..leaves });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::TriMesh;
    use pompeiu_core::geom::{Aabb, Frame};
    use proptest::prelude::*;

    /// A tree over points, each a face at three equal corners, and over the triangles of given corners.
    fn tree(points: &[[f64; 3]], triangles: &[[[f64; 3]; 3]]) -> Bvh {
        let positions: Vec<[f64; 3]> =
            points.iter().copied().chain(triangles.iter().flatten().copied()).collect();
        let (ends, count) = (points.len() as u32, positions.len() as u32);
        let faces = (0..ends).map(|i| [i; 3]).chain((ends..count).step_by(3).map(|i| [i, i + 1, i + 2]));
        let mesh = TriMesh::new(positions, faces.collect()).unwrap();
        Bvh::build(&mesh, &Frame::of(&Aabb::EMPTY))
    }

    fn area(corners: &[[f64; 3]; 3]) -> f64 {
        let [a, b, c] = corners.map(DVec3::from_array);
        0.5 * (b - a).cross(c - a).length()
    }

    fn coordinate() -> impl Strategy<Value = f64> {
        -1.0..1.0_f64
    }

    fn point() -> impl Strategy<Value = [f64; 3]> {
        [coordinate(), coordinate(), coordinate()]
    }

    proptest! {
        /// Cells lie in the piece, and their areas add up to its own.
        #[test]
        fn cells_partition_the_piece(
            corners in [[coordinate(), coordinate()], [coordinate(), coordinate()], [coordinate(), coordinate()]],
            points in prop::collection::vec(point(), 1..6),
            triangles in prop::collection::vec([point(), point(), point()], 0..3),
            weights in [0.01..1.0_f64, 0.01..1.0, 0.01..1.0],
        ) {
            let corners = corners.map(|[x, y]| [x, y, 0.0]);
            let sum: f64 = weights.iter().sum();
            let around = [0, 1, 2].map(|k| (0..3).map(|i| weights[i] / sum * corners[i][k]).sum());
            let bvh = tree(&points, &triangles);
            let mut bisectors = Bisectors::default();
            bisectors.cut(&corners, around, &bvh, bvh.slots(), 0.0);
            let parts: Vec<_> = bisectors.cells.iter().flat_map(Cell::triangles).collect();
            let total: f64 = parts.iter().map(area).sum();
            prop_assert!((total - area(&corners)).abs() < 1e-13, "{total}");
            for corner in parts.iter().flatten() {
                let beta = closest_barycentric(*corner, corners);
                let q: [f64; 3] = [0, 1, 2].map(|k| (0..3).map(|i| beta[i] * corners[i][k]).sum());
                prop_assert!(DVec3::from_array(q).distance(DVec3::from_array(*corner)) < 1e-14);
            }
        }

        /// Among vertices, a cell is as near to its own as to any other.
        #[test]
        fn cells_of_points_are_nearest_to_them(
            corners in [point(), point(), point()], points in prop::collection::vec(point(), 2..6),
        ) {
            let bvh = tree(&points, &[]);
            let around = [0, 1, 2].map(|k| (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0);
            let mut bisectors = Bisectors::default();
            bisectors.cut(&corners, around, &bvh, bvh.slots(), 0.0);
            for cell in &bisectors.cells {
                for corner in cell.corners() {
                    let distance = |slot| bvh.distance_sq(corner.to_array(), slot).sqrt();
                    let own = distance(bisectors.slots[cell.face]);
                    let least = bvh.slots().map(distance).fold(f64::INFINITY, f64::min);
                    prop_assert!(own < least + 1e-12, "{own} {least}");
                }
            }
        }
    }

    /// Four vertices at the corners of a square: the cells meet in the middle, and none reaches beyond it.
    #[test]
    fn cells_meet_at_a_peak() {
        let bvh = tree(&[[1.0, 1.0, 0.5], [-1.0, 1.0, 0.5], [-1.0, -1.0, 0.5], [1.0, -1.0, 0.5]], &[]);
        let corners = [[-0.3, -0.2, 0.0], [0.5, -0.1, 0.0], [0.0, 0.4, 0.0]];
        let mut bisectors = Bisectors::default();
        assert!(bisectors.cut(&corners, [0.1, 0.05, 0.0], &bvh, bvh.slots(), 1e-9));
        assert!(bisectors.cells.len() >= 4);
        let mut farthest = 0.0_f64;
        for cell in &bisectors.cells {
            for corner in cell.corners() {
                farthest =
                    farthest.max(bvh.distance_sq(corner.to_array(), bisectors.slots[cell.face]).sqrt());
            }
        }
        assert!((farthest - 1.5).abs() < 1e-15, "{farthest}");
    }
}
