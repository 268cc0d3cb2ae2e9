//! Planes in front of faces of B as seen from a cell, eight faces at a time.
//!
//! # What is proven
//! With c the centre of the cell and g no longer than one, `g . (x - c) - max_j g . (t_j - c)` is no greater than the distance of x from the
//! triangle with corners t: it lies behind that plane. Up to three directions are tried: that from its nearest point to c, its own normal, and that
//! across the longest way on the cell and its longest edge, for long faces that pass beside long cells. How far it
//! reaches along them is computed, so that any direction will do. Errors are those of planes in front of boxes and triangles (`planes`).

use super::lanes::{
    Lanes, Seen, Vectors, broadcast, cross, dot, from_point, inverse_length, longer, minus, reach, seen,
    times,
};
use super::polygon::{MOST_CORNERS, Row};
use glam::DVec3;
use multiversion::multiversion;
use pompeiu_core::geom::point_triangle::{LANES, TriangleBlock, set_lane};
use pompeiu_core::spatial::{Bvh, Slot};

/// A cell as faces are compared with it.
pub(super) struct Front {
    centre: [f64; 3],
    /// From there to the corners, coordinate by coordinate.
    ways: [Row; 3],
    /// The longest way between two of them.
    along: [f64; 3],
    /// Values at the corners that planes should reach, and how far below them is enough.
    wanted: Row,
    enough: f64,
}

/// What eight faces say of a cell.
pub(super) struct Fronts {
    /// Values at the corners of the cell of the better one of the planes of each face.
    rows: [Lanes; MOST_CORNERS],
    /// How far these lie below what is wanted, at most.
    pub(super) deficits: Lanes,
    /// From the nearest points of the faces to the centre.
    ways: Vectors,
}

impl Front {
    pub(super) fn new(centre: DVec3, points: &[Row; 3], along: DVec3, wanted: &Row, enough: f64) -> Self {
        let centre = centre.to_array();
        let mut ways = *points;
        for k in 0..3 {
            for j in 0..MOST_CORNERS {
                ways[k][j] -= centre[k];
            }
        }
        Self { centre, ways, along: along.to_array(), wanted: *wanted, enough }
    }

    /// Looks at up to eight faces; lanes without one repeat the first.
    pub(super) fn look(&self, bvh: &Bvh, slots: &[Slot]) -> Fronts {
        let mut block = [[[0.0; LANES]; 3]; 3];
        for lane in 0..LANES {
            set_lane(&mut block, lane, bvh.corners(*slots.get(lane).unwrap_or(&slots[0])));
        }
        look(self, &block)
    }
}

impl Fronts {
    /// Values at the corners of the cell of the better plane of a face.
    pub(super) fn row(&self, lane: usize) -> Row {
        self.rows.map(|values| values[lane])
    }

    /// From the nearest point of a face to the centre.
    pub(super) fn way(&self, lane: usize) -> DVec3 {
        DVec3::from_array(self.ways.map(|values| values[lane]))
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl", "x86_64+avx2", "aarch64+neon"))]
fn look(front: &Front, block: &TriangleBlock) -> Fronts {
    let corners = from_point(front.centre, block);
    let Seen { way, distances_sq, normal } = seen(&corners);
    let mut best = plane(&times(&inverse_length(&distances_sq), &way), &corners, front);
    better(&mut best, &plane(&normal, &corners, front));
    if best.1.iter().any(|deficit| *deficit > front.enough) {
        better(&mut best, &plane(&across(&corners, &way, front), &corners, front));
    }
    let (rows, deficits) = best;
    Fronts { rows, deficits, ways: way }
}

/// The better planes of eight faces.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn better(best: &mut ([Lanes; MOST_CORNERS], Lanes), other: &([Lanes; MOST_CORNERS], Lanes)) {
    for l in 0..LANES {
        for j in 0..MOST_CORNERS {
            best.0[j][l] = if other.1[l] < best.1[l] { other.0[j][l] } else { best.0[j][l] };
        }
    }
    for l in 0..LANES {
        best.1[l] = if other.1[l] < best.1[l] { other.1[l] } else { best.1[l] };
    }
}

/// Directions across the longest way on a cell and the longest edges of triangles, towards the cell.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn across([a, b, c]: &[Vectors; 3], way: &Vectors, front: &Front) -> Vectors {
    let edge = longer(&longer(&minus(b, a), &minus(c, a)), &minus(c, b));
    let across = cross(&broadcast(front.along), &edge);
    let (square, side) = (dot(&across, &across), dot(&across, way));
    let length = inverse_length(&square);
    let mut towards = [0.0; LANES];
    for l in 0..LANES {
        towards[l] = if side[l] < 0.0 { -length[l] } else { length[l] };
    }
    times(&towards, &across)
}

/// Values at the corners of a cell of the planes that touch triangles along directions, and how far they lie below what is wanted at most.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn plane(g: &Vectors, [a, b, c]: &[Vectors; 3], front: &Front) -> ([Lanes; MOST_CORNERS], Lanes) {
    let reach = reach(g, [a, b, c]);
    let mut rows = [[0.0; LANES]; MOST_CORNERS];
    let mut deficits = [f64::NEG_INFINITY; LANES];
    for j in 0..MOST_CORNERS {
        let way = [front.ways[0][j], front.ways[1][j], front.ways[2][j]];
        for l in 0..LANES {
            let value = g[0][l] * way[0] + g[1][l] * way[1] + g[2][l] * way[2] - reach[l];
            rows[j][l] = value;
            let deficit = front.wanted[j] - value;
            deficits[l] = if deficit > deficits[l] { deficit } else { deficits[l] };
        }
    }
    (rows, deficits)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Target;
    use pompeiu_core::TriMesh;
    use pompeiu_testkit::effort::cases;
    use pompeiu_testkit::plain::point_triangle;
    use proptest::prelude::*;

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![-1.0..1.0_f64, (-2..3_i32).prop_map(|k| 0.25 * f64::from(k)), Just(1e-9)]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(cases(400)))]

        /// No face is nearer to a corner than its plane says, thin ones and points included, and deficits are those of the values.
        #[test]
        fn faces_lie_behind_their_planes(
            points in prop::collection::vec([coordinate(), coordinate(), coordinate()], 3..30),
            cell in prop::array::uniform8([coordinate(), coordinate(), coordinate()]),
            above in 0.0..2.0_f64,
            wanted in 0.0..2.0_f64,
        ) {
            let faces: Vec<[u32; 3]> = (0..points.len() as u32 - 2).map(|i| [i, i + 1, i + 2]).collect();
            let mesh = TriMesh::new(points, faces).unwrap();
            let target = Target::new(&mesh);
            let bvh = target.bvh();
            let slots: Vec<Slot> = bvh.slots().collect();
            let corner = |j: usize| target.frame().map([cell[j][0], cell[j][1], cell[j][2] + above]);
            let corners: [[f64; 3]; MOST_CORNERS] = std::array::from_fn(corner);
            let rows = [0, 1, 2].map(|k| std::array::from_fn(|j| corners[j][k]));
            let centre = corners.iter().map(|p| DVec3::from_array(*p)).sum::<DVec3>() / MOST_CORNERS as f64;
            let along = DVec3::from_array(corners[1]) - DVec3::from_array(corners[0]);
            let front = Front::new(centre, &rows, along, &[wanted; MOST_CORNERS], 0.0);
            for some in slots.chunks(LANES) {
                let fronts = front.look(bvh, some);
                for (lane, slot) in some.iter().enumerate() {
                    let row = fronts.row(lane);
                    let mut deficit = f64::NEG_INFINITY;
                    for j in 0..MOST_CORNERS {
                        let exact = point_triangle(corners[j], bvh.corners(*slot));
                        prop_assert!(row[j] <= exact + 1e-14, "{} {exact}", row[j]);
                        deficit = f64::max(deficit, wanted - row[j]);
                    }
                    prop_assert_eq!(deficit, fronts.deficits[lane]);
                }
            }
        }

        /// What lies over the inside of a face is as far as its plane says, and so is what lies before its nearest point.
        #[test]
        fn nothing_is_lost_over_a_face(height in 0.01..2.0_f64, v in 0.0..0.5_f64, w in 0.0..0.5_f64, aside in 0.0..1.0_f64) {
            let mesh = TriMesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).unwrap();
            let target = Target::new(&mesh);
            let slots: Vec<Slot> = target.bvh().slots().collect();
            for p in [[v, w, height], [-aside, w, height], [-aside, -aside, height]] {
                let p = target.frame().map(p);
                let cell = p.map(|x| [x; MOST_CORNERS]);
                let front = Front::new(DVec3::from_array(p), &cell, DVec3::X, &[0.0; MOST_CORNERS], f64::INFINITY);
                let fronts = front.look(target.bvh(), &slots[..1]);
                let exact = point_triangle(p, target.bvh().corners(slots[0]));
                prop_assert!((fronts.row(0)[0] - exact).abs() < 1e-14, "{} {exact}", fronts.row(0)[0]);
                prop_assert!((fronts.way(0).length() - exact).abs() < 1e-14);
            }
        }
    }
}
