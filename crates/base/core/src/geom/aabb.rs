//! Axis-aligned bounding boxes.

use crate::mesh::TriMesh;
use rayon::prelude::*;

/// The smallest axis-aligned box that holds the points added to it; empty until the first one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// Least coordinates.
    pub lower: [f64; 3],
    /// Greatest coordinates.
    pub upper: [f64; 3],
}

/// Points whose coordinates are looked at together.
const TOGETHER: usize = 4;

impl Aabb {
    /// The box of no points.
    pub const EMPTY: Self = Self { lower: [f64::INFINITY; 3], upper: [f64::NEG_INFINITY; 3] };

    /// The box of some points.
    pub fn of_points<'p>(points: impl IntoIterator<Item = &'p [f64; 3]>) -> Self {
        let mut aabb = Self::EMPTY;
        for p in points {
            aabb.add(*p);
        }
        aabb
    }

    /// The box of the faces of a mesh. Unreferenced vertices do not count.
    pub fn of_faces(mesh: &TriMesh) -> Self {
        // A vertex belongs to several faces: all vertices are fewer, and mostly each of the outermost belongs to some face.
        const CHUNK: usize = 1 << 14;
        let of_all =
            mesh.positions().par_chunks(CHUNK).map(Self::of_many).reduce(|| Self::EMPTY, Self::union);
        if of_all.is_reached(mesh) { of_all } else { Self::of_used(mesh) }
    }

    /// [`Self::of_points`], four points at a time: so the loop over their coordinates is vectorised.
    fn of_many(points: &[[f64; 3]]) -> Self {
        let (fours, rest) = points.as_chunks::<TOGETHER>();
        let (mut lower, mut upper) = ([f64::INFINITY; 3 * TOGETHER], [f64::NEG_INFINITY; 3 * TOGETHER]);
        for four in fours {
            let four = four.as_flattened();
            for i in 0..3 * TOGETHER {
                lower[i] = if four[i] < lower[i] { four[i] } else { lower[i] };
                upper[i] = if four[i] > upper[i] { four[i] } else { upper[i] };
            }
        }
        lower
            .as_chunks()
            .0
            .iter()
            .zip(upper.as_chunks().0)
            .fold(Self::of_points(rest), |aabb, ends| aabb.union(Self { lower: *ends.0, upper: *ends.1 }))
    }

    /// Whether faces reach all sides of the box of all vertices. May say no where many vertices lie on its sides.
    fn is_reached(&self, mesh: &TriMesh) -> bool {
        /// Vertices on sides that are looked for, and how many of those of faces are compared with them at a time.
        const MOST: usize = 8;
        const COMPARED: usize = 256;
        let sides = |p: &[f64; 3]| {
            (0..3).fold(0, |sides, k| {
                sides
                    | u32::from(p[k] == self.lower[k]) << (2 * k)
                    | u32::from(p[k] == self.upper[k]) << (2 * k + 1)
            })
        };
        let (lower, upper) = ([self.lower; TOGETHER], [self.upper; TOGETHER]);
        let mut outermost = [(u32::MAX, 0); MOST];
        let mut count = 0;
        for (points, first) in mesh.positions().chunks(TOGETHER).zip((0..).step_by(TOGETHER)) {
            if points.first_chunk().is_some_and(|four| !any_equal(four, &lower) && !any_equal(four, &upper)) {
                continue;
            }
            for (p, vertex) in points.iter().zip(first..) {
                let sides = sides(p);
                if sides != 0 {
                    let Some(place) = outermost.get_mut(count) else { return false };
                    (*place, count) = ((vertex, sides), count + 1);
                }
            }
        }
        let mut reached = 0;
        for vertices in mesh.faces().as_flattened().chunks(COMPARED) {
            for (vertex, sides) in &outermost[..count] {
                // Without an end before the last: so it is vectorised.
                let found = vertices.iter().fold(0, |found, v| found | u32::from(v == vertex));
                reached |= if found == 1 { *sides } else { 0 };
            }
            if reached == 0b11_1111 {
                return true;
            }
        }
        false
    }

    /// The box of the vertices of all faces, one face after the other.
    fn of_used(mesh: &TriMesh) -> Self {
        let positions = mesh.positions();
        mesh.faces()
            .par_chunks(1 << 14)
            .map(|faces| Self::of_points(faces.iter().flatten().map(|&v| &positions[v as usize])))
            .reduce(|| Self::EMPTY, Self::union)
    }

    /// Grows to hold a point.
    #[inline]
    pub fn add(&mut self, p: [f64; 3]) {
        for k in 0..3 {
            self.lower[k] = if p[k] < self.lower[k] { p[k] } else { self.lower[k] };
            self.upper[k] = if p[k] > self.upper[k] { p[k] } else { self.upper[k] };
        }
    }

    /// The smallest box that holds both.
    #[inline]
    #[must_use]
    pub fn union(mut self, other: Self) -> Self {
        for k in 0..3 {
            self.lower[k] = if other.lower[k] < self.lower[k] { other.lower[k] } else { self.lower[k] };
            self.upper[k] = if other.upper[k] > self.upper[k] { other.upper[k] } else { self.upper[k] };
        }
        self
    }

    /// Whether no point was added.
    pub fn is_empty(&self) -> bool {
        (0..3).any(|k| self.lower[k] > self.upper[k])
    }

    /// Whether two boxes have a point in common.
    #[inline]
    pub fn meets(&self, other: &Self) -> bool {
        (0..3).all(|k| self.lower[k] <= other.upper[k] && other.lower[k] <= self.upper[k])
    }

    /// Squared distance of a point, rounded: 0 inside, infinite from an empty box. Each of the three terms is off by a part below 2^-51.
    #[inline]
    pub fn distance_sq(&self, p: [f64; 3]) -> f64 {
        let mut sum = 0.0;
        for k in 0..3 {
            let (below, above) = (self.lower[k] - p[k], p[k] - self.upper[k]);
            let outside = if below > above { below } else { above };
            let outside = if outside > 0.0 { outside } else { 0.0 };
            sum += outside * outside;
        }
        sum
    }

    /// Length of the diagonal, rounded; 0 for an empty box. Does not overflow before the result does.
    pub fn diagonal(&self) -> f64 {
        if self.is_empty() {
            return 0.0;
        }
        let extent = [0, 1, 2].map(|k| self.upper[k] - self.lower[k]);
        let longest = extent.into_iter().fold(0.0, |m: f64, x| if x > m { x } else { m });
        if longest == 0.0 {
            return 0.0;
        }
        longest * extent.iter().map(|x| (x / longest) * (x / longest)).sum::<f64>().sqrt()
    }

    /// Largest magnitude of a coordinate of the box.
    pub fn max_coordinate(&self) -> f64 {
        self.lower.iter().chain(&self.upper).fold(0.0, |m, x| if x.abs() > m { x.abs() } else { m })
    }
}

/// Whether any coordinate of four points equals that of another four, without an end before the last: so it is vectorised.
fn any_equal(four: &[[f64; 3]; TOGETHER], others: &[[f64; 3]; TOGETHER]) -> bool {
    let (four, others) = (four.as_flattened(), others.as_flattened());
    let mut equal = 0;
    for i in 0..3 * TOGETHER {
        equal |= u64::from(four[i] == others[i]);
    }
    equal != 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn diagonal_survives_extreme_scales() {
        for scale in [1e-300, 1e-150, 1.0, 1e150, 1e300] {
            let aabb = Aabb::of_points(&[[0.0, 0.0, 0.0], [3.0 * scale, -4.0 * scale, 12.0 * scale]]);
            assert!((aabb.diagonal() / (13.0 * scale) - 1.0).abs() < 1e-15);
        }
        assert_eq!(Aabb::EMPTY.diagonal(), 0.0);
    }

    /// Vertices of no face do not count, whether they lie outside, on a side beside others, or are many.
    #[test]
    fn the_box_of_faces_is_that_of_their_vertices() {
        let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 0.5]];
        let expected = Aabb { lower: [0.0; 3], upper: [1.0; 3] };
        for others in
            [vec![], vec![[2.0, 0.5, 0.5]], vec![[1.0, 0.5, 0.5]], vec![[0.0; 3]; 100], vec![[9.0; 3]; 100]]
        {
            let mesh = TriMesh::new(
                [&others[..], &triangle].concat(),
                vec![[0, 1, 2].map(|i| i + others.len() as u32)],
            )
            .unwrap();
            assert_eq!(Aabb::of_faces(&mesh), expected);
        }
    }

    #[test]
    fn boxes_meet_where_they_touch() {
        let aabb = Aabb { lower: [0.0; 3], upper: [1.0, 2.0, 3.0] };
        for (lower, meets) in
            [([1.0, 2.0, 3.0], true), ([0.5; 3], true), ([1.5, 0.0, 0.0], false), ([0.0, 0.0, 3.5], false)]
        {
            let other = Aabb { lower, upper: lower.map(|x| x + 1.0) };
            assert_eq!((aabb.meets(&other), other.meets(&aabb)), (meets, meets), "{lower:?}");
        }
        assert!(!aabb.meets(&Aabb::EMPTY) && !Aabb::EMPTY.meets(&aabb));
    }

    #[test]
    fn distances_are_from_sides_edges_corners_and_zero_inside() {
        let aabb = Aabb { lower: [0.0; 3], upper: [1.0, 2.0, 3.0] };
        for (p, expected) in [
            ([0.5, 1.0, 1.5], 0.0),
            ([1.0, 2.0, 3.0], 0.0),
            ([-2.0, 1.0, 1.0], 4.0),
            ([0.5, 5.0, 7.0], 25.0),
            ([3.0, 4.0, -1.0], 9.0),
        ] {
            assert_eq!(aabb.distance_sq(p), expected, "{p:?}");
        }
        assert_eq!(Aabb::EMPTY.distance_sq([0.0; 3]), f64::INFINITY);
    }

    #[test]
    fn unreferenced_vertices_do_not_count() {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [99.0; 3]];
        let mesh = TriMesh::new(positions, vec![[0, 1, 2]]).unwrap();
        assert_eq!(Aabb::of_faces(&mesh), Aabb { lower: [0.0; 3], upper: [1.0, 1.0, 0.0] });
    }
}
