//! Long faces in several boxes.
//!
//! The box around a long thin face that does not lie along an axis is nearly empty, and the boxes around many such faces overlap: a tree
//! over them looks at most of them in each query. So these faces are left out of the boxes of the tree. Each is cut into slabs across the
//! longest side of its box, and a second tree is made over the boxes of the slabs, whose leaves hold the whole face again. Both trees hang
//! below one root.
//!
//! # What is proven
//! Every point of a long face lies in the box of a slab. The corners of a slab are corners of the face, which are exact, and points where an
//! edge crosses a plane across an axis. The coordinate along that axis is exact; with coordinates of at most M the others are off by less
//! than `16 u M` (a quotient of differences, a product, two sums; u = 2^-53), and boxes are wider by `32 u M` on each side.
//!
//! # Source
//! Boxes of parts of triangles: `ernst_early_2007`.

use crate::geom::Aabb;
use rayon::prelude::*;

/// Half the surface of a box, over the area of its face, above which the face is long; an equilateral triangle has at most 3.5.
const LONG: f64 = 12.0;
/// The same over the mean area of all faces, for each slab: smaller boxes are no larger than what is around them.
const OF_MEAN: f64 = 32.0;
/// Slabs of a face at most, and of all faces together: so many for each face, and so many besides.
const MOST_SLABS: f64 = 64.0;
const MOST_OF_FACE: usize = 4;
const MOST_BESIDES: usize = 1 << 10;
/// How much wider boxes are, as a part of the greatest coordinate: 32 units of rounding.
pub(super) const WIDER: f64 = 32.0 * 0.5 * f64::EPSILON;
/// Faces of a parallel part.
const PART: usize = 1 << 12;
/// Of more faces one of so many is looked at first: where none of these is long, few of the others are, and a query looks at those.
const SAMPLED: usize = 16;

/// The faces that are cut into slabs.
pub(super) struct Long {
    /// A bit for each face of the mesh.
    is_long: Vec<u64>,
    /// Faces and boxes of slabs.
    pub(super) slabs: Vec<(u32, Aabb)>,
}

impl Long {
    /// None where no face is long.
    pub(super) fn find(count: usize, corners: &(impl Fn(u32) -> [[f64; 3]; 3] + Sync)) -> Option<Self> {
        let faces = 0..count as u32;
        if count > PART && sum_and_long(faces.clone().step_by(SAMPLED), corners).1.is_empty() {
            return None;
        }
        let parts: Vec<(f64, Vec<(u32, f64)>)> = (0..count.div_ceil(PART))
            .into_par_iter()
            .map(|part| sum_and_long(faces.clone().skip(part * PART).take(PART), corners))
            .collect();
        let total: f64 = parts.iter().map(|part| part.0).sum();
        let mut found: Vec<(u32, f64)> = parts.into_iter().flat_map(|part| part.1).collect();
        let mut unit = OF_MEAN * total / count as f64;
        // Nothing is large beside faces that are all without area.
        if unit.is_nan() || unit < f64::MIN_POSITIVE {
            return None;
        }
        let slabs_of = |half: f64, unit: f64| (half / unit).min(MOST_SLABS) as usize;
        loop {
            found.retain(|&(_, half)| slabs_of(half, unit) >= 2);
            let all: usize = found.iter().map(|&(_, half)| slabs_of(half, unit)).sum();
            if all <= MOST_OF_FACE * count + MOST_BESIDES {
                break;
            }
            unit *= 2.0;
        }
        if found.is_empty() {
            return None;
        }
        let mut is_long = vec![0; count.div_ceil(64)];
        let mut slabs = Vec::new();
        for (face, half) in found {
            is_long[face as usize / 64] |= 1 << (face % 64);
            let boxes = Slabs::of(corners(face), slabs_of(half, unit));
            slabs.extend((0..boxes.count).map(|slab| (face, boxes.aabb(slab))));
        }
        Some(Self { is_long, slabs })
    }

    pub(super) fn contains(&self, face: u32) -> bool {
        self.is_long[face as usize / 64] >> (face % 64) & 1 != 0
    }
}

/// The area of some faces, and those whose boxes are much larger, with half of the surface of the box.
fn sum_and_long(
    faces: impl Iterator<Item = u32>,
    corners: &(impl Fn(u32) -> [[f64; 3]; 3] + Sync),
) -> (f64, Vec<(u32, f64)>) {
    let (mut total, mut long) = (0.0, Vec::new());
    for face in faces {
        let [a, b, c] = corners(face);
        let aabb = Aabb::of_points(&[a, b, c]);
        let side = [0, 1, 2].map(|k| aabb.upper[k] - aabb.lower[k]);
        let half = side[0] * side[1] + side[1] * side[2] + side[2] * side[0];
        let (p, q) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        let normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
        let area = 0.5 * normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        total += area;
        if half > LONG * area {
            long.push((face, half));
        }
    }
    (total, long)
}

/// A face cut by planes across the longest side of its box.
struct Slabs {
    corners: [[f64; 3]; 3],
    whole: Aabb,
    axis: usize,
    count: usize,
}

impl Slabs {
    fn of(corners: [[f64; 3]; 3], count: usize) -> Self {
        let whole = Aabb::of_points(&corners);
        let side = |k: usize| whole.upper[k] - whole.lower[k];
        let axis = (1..3).fold(0, |axis, k| if side(k) > side(axis) { k } else { axis });
        Self { corners, whole, axis, count }
    }

    /// Where a plane lies; the first and the last are the ends of the face.
    fn plane(&self, index: usize) -> f64 {
        let (first, last) = (self.whole.lower[self.axis], self.whole.upper[self.axis]);
        if index == self.count { last } else { first + (last - first) * (index as f64 / self.count as f64) }
    }

    /// The box of the points of the face between two planes.
    fn aabb(&self, slab: usize) -> Aabb {
        let axis = self.axis;
        let ends = [self.plane(slab), self.plane(slab + 1)];
        let mut aabb = Aabb::EMPTY;
        for k in 0..3 {
            let (p, q) = (self.corners[k], self.corners[(k + 1) % 3]);
            if p[axis] >= ends[0] && p[axis] <= ends[1] {
                aabb.add(p);
            }
            for end in ends {
                let (before, after) = (end - p[axis], end - q[axis]);
                if before != 0.0 && after != 0.0 && (before > 0.0) != (after > 0.0) {
                    let part = before / (q[axis] - p[axis]);
                    let mut met = [0, 1, 2].map(|j| p[j] + part * (q[j] - p[j]));
                    met[axis] = end;
                    aabb.add(met);
                }
            }
        }
        let far = self.corners.as_flattened().iter().fold(0.0, |far: f64, x| far.max(x.abs()));
        // Beyond the box of the face there is nothing of it.
        Aabb {
            lower: [0, 1, 2].map(|k| (aabb.lower[k] - WIDER * far).max(self.whole.lower[k])),
            upper: [0, 1, 2].map(|k| (aabb.upper[k] + WIDER * far).min(self.whole.upper[k])),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::geom::{Aabb, Frame};
    use crate::mesh::shapes::{Ends, cylinder, icosphere};
    use crate::mesh::{Affine, TriMesh, transform};
    use crate::spatial::bvh::{Bvh, Workspace};
    use proptest::prelude::*;
    use std::ops::ControlFlow;

    /// A tube of long faces, turned about an axis and moved.
    fn tube(sides: u32, radius: f64, (axis, degrees): ([f64; 3], f64), shift: f64) -> TriMesh {
        let upright = cylinder(radius, 1.0, sides, 1, Ends::Open).unwrap();
        let turned = transform(&upright, &Affine::rotate(axis, degrees).unwrap()).unwrap();
        transform(&turned, &Affine::translate([shift, -shift, shift])).unwrap()
    }

    fn tree(mesh: &TriMesh) -> Bvh {
        Bvh::build(mesh, &Frame::of(&Aabb::of_faces(mesh)))
    }

    #[test]
    fn faces_without_area_stay_whole() {
        let line = (0..9).map(|i| [f64::from(i * i), f64::from(i), 1.0]).collect();
        let mesh = TriMesh::new(line, vec![[0, 8, 8], [1, 7, 1], [2, 2, 6]]).unwrap();
        assert!(tree(&mesh).originals.is_empty());
    }

    #[test]
    fn faces_along_an_axis_and_those_of_round_shapes_stay_whole() {
        let along = cylinder(0.1, 9.0, 40, 1, Ends::Open).unwrap();
        let sphere = icosphere(1.0, 3).unwrap();
        assert!([along, sphere].iter().all(|mesh| tree(mesh).originals.is_empty()));
    }

    #[test]
    fn queries_over_long_oblique_faces_look_at_few() {
        /// On the average; a tree without slabs looks at all 200.
        const MOST: u64 = 120;
        let mesh = tube(100, 0.03, ([1.0, -1.0, 0.0], 55.0), 0.0);
        let bvh = tree(&mesh);
        let mut workspace = Workspace::default();
        for slot in bvh.slots().step_by(2) {
            let [a, b, c] = bvh.corners(slot);
            let near = [0, 1, 2].map(|k| 0.2 * a[k] + 0.3 * b[k] + 0.5 * c[k] + 1e-3);
            bvh.nearest(near, bvh.any_slot(), &mut workspace);
        }
        assert!(workspace.distances < 100 * MOST, "{}", workspace.distances);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]

        /// Each point of each face lies in a box of a leaf that holds the face, but for how far points here are off, and queries find what a search over all faces finds, each face once.
        #[test]
        fn slabs_hold_their_faces(
            axis in [0.5..1.0_f64, -1.0..-0.5, -0.2..0.2],
            degrees in 35.0..60.0_f64,
            at in prop::collection::vec([-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], 20),
            weights in prop::collection::vec([0.0..1.0_f64, 0.0..1.0], 8),
            shift in prop_oneof![Just(0.0), Just(1e6)],
        ) {
            let mesh = tube(60, 0.02, (axis, degrees), shift);
            let bvh = tree(&mesh);
            prop_assert!(!bvh.originals.is_empty());
            prop_assert_eq!(bvh.len(), mesh.faces().len());
            let twice = bvh.mapped(|p| p.map(|x| 2.0 * x - 0.7));
            for (bvh, slot) in [&bvh, &twice].into_iter().flat_map(|bvh| bvh.slots().map(move |slot| (bvh, slot))) {
                let [a, b, c] = bvh.corners(slot);
                let ends = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
                for [v, w] in weights.iter().map(|[v, w]| [v * (1.0 - w), *w]).chain(ends) {
                    let p = [0, 1, 2].map(|k| a[k] + v * (b[k] - a[k]) + w * (c[k] - a[k]));
                    let mut is_held = false;
                    let _ = bvh.walk(&mut Vec::new(), |aabb| aabb.distance_sq(p) <= 1e-30, |found| {
                        is_held |= found == slot;
                        if is_held { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                    });
                    prop_assert!(is_held, "{p:?}");
                }
            }
            let mut workspace = Workspace::default();
            for p in at {
                let exact = bvh.slots().map(|slot| bvh.distance_sq(p, slot)).fold(f64::INFINITY, f64::min);
                let nearest = bvh.nearest(p, bvh.any_slot(), &mut workspace);
                prop_assert!(nearest.slot.index() < bvh.len());
                prop_assert!(nearest.distance_sq <= exact * (1.0 + 1e-12), "{} {exact}", nearest.distance_sq);
                let mut all = Vec::new();
                bvh.all_nearest(p, nearest.slot, 0.05, &mut workspace, &mut all);
                let reach = (exact.sqrt() + 0.05).powi(2);
                let expected = bvh.slots().filter(|slot| bvh.distance_sq(p, *slot) < reach * (1.0 - 1e-9)).count();
                prop_assert!(all.len() >= expected);
                all.sort_unstable_by_key(|one| one.slot);
                prop_assert!(all.windows(2).all(|two| two[0].slot < two[1].slot));
                prop_assert!(bvh.some_near(p, &mut workspace).index() < bvh.len());
            }
        }
    }
}
