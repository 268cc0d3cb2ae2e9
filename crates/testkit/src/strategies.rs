//! Random meshes for property tests: few faces, and often the awkward kind.

use pompeiu_core::TriMesh;
use proptest::prelude::*;

type Point = [f64; 3];

/// A coordinate of size one, with all its bits or on a coarse grid, where ties and coplanar faces are common.
pub fn coordinate() -> impl Strategy<Value = f64> + Clone {
    prop_oneof![-1.0..1.0, (-4..5_i32).prop_map(|k| f64::from(k) * 0.25)]
}

/// A point with such coordinates.
pub fn point() -> impl Strategy<Value = Point> + Clone {
    [coordinate(), coordinate(), coordinate()]
}

fn soup_of(triangles: Vec<[Point; 3]>) -> TriMesh {
    let faces = (0..triangles.len() as u32).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
    TriMesh::new(triangles.into_iter().flatten().collect(), faces)
        .expect("small coordinates and valid indices")
}

/// Unrelated triangles with random corners.
pub fn soup(most: usize) -> impl Strategy<Value = TriMesh> + Clone {
    prop::collection::vec([point(), point(), point()], 1..=most).prop_map(soup_of)
}

/// A random height field over a grid of up to 3 x 3 cells: faces share vertices and edges.
pub fn terrain() -> impl Strategy<Value = TriMesh> + Clone {
    (1..4_u32, 1..4_u32, prop::collection::vec(-0.5..0.5_f64, 16)).prop_map(|(n, m, heights)| {
        let mut positions = Vec::new();
        for j in 0..=m {
            for i in 0..=n {
                let [x, y] = [f64::from(i) / f64::from(n), f64::from(j) / f64::from(m)];
                positions.push([x, y, heights[positions.len()]]);
            }
        }
        let mut faces = Vec::new();
        for v in (0..m).flat_map(|j| (0..n).map(move |i| j * (n + 1) + i)) {
            faces.extend([[v, v + 1, v + n + 2], [v, v + n + 2, v + n + 1]]);
        }
        TriMesh::new(positions, faces).expect("small coordinates and valid indices")
    })
}

/// Triangles in one of the planes z = -1/4, 0, 1/4: coplanar faces, overlaps, exact ties.
pub fn coplanar(most: usize) -> impl Strategy<Value = TriMesh> + Clone {
    let corner = || [coordinate(), coordinate()];
    let face = ([corner(), corner(), corner()], -1..2_i32);
    prop::collection::vec(face, 1..=most).prop_map(|faces| {
        let lift =
            |(corners, plane): ([[f64; 2]; 3], i32)| corners.map(|[x, y]| [x, y, 0.25 * f64::from(plane)]);
        soup_of(faces.into_iter().map(lift).collect())
    })
}

/// Triangles that are needles, caps, segments or points, some of them twice.
pub fn degenerate(most: usize) -> impl Strategy<Value = TriMesh> + Clone {
    let face = (point(), point(), point(), 0.0..1.0_f64, 0..16_i32, 0..6_u32);
    prop::collection::vec(face, 1..=most).prop_map(|faces| {
        let mut triangles: Vec<[Point; 3]> = Vec::new();
        for (p, q, r, t, digits, kind) in faces {
            let between = [0, 1, 2].map(|k| p[k] + t * (q[k] - p[k]));
            let width = 10.0_f64.powi(-digits);
            let beside = |s: Point| [0, 1, 2].map(|k| s[k] + width * (r[k] - s[k]));
            triangles.push(match kind {
                0 => [p, p, p],
                1 => [p, q, between],
                2 => [p, q, q],
                3 => [p, q, beside(q)],
                4 => [p, q, beside(between)],
                _ => triangles.last().copied().unwrap_or([p, q, r]),
            });
        }
        soup_of(triangles)
    })
}

/// A mesh of any of these kinds, of at most 12 faces in soups and 18 in terrains.
pub fn any_mesh() -> impl Strategy<Value = TriMesh> + Clone {
    prop_oneof![3 => soup(12), 2 => terrain(), 2 => coplanar(8), 2 => degenerate(8)].boxed()
}

/// Two meshes, somewhat apart in half of the cases.
pub fn pair() -> impl Strategy<Value = (TriMesh, TriMesh)> {
    let apart =
        prop_oneof![3 => Just([0.0; 3]), 2 => point(), 1 => point().prop_map(|p| p.map(|x| 1000.0 * x))];
    (any_mesh(), any_mesh(), apart).prop_map(|(a, b, by)| {
        let moved = b.positions().iter().map(|p| [0, 1, 2].map(|k| p[k] + by[k])).collect();
        let b = TriMesh::new(moved, b.faces().to_vec()).expect("small coordinates and valid indices");
        (a, b)
    })
}

/// The mesh with every coordinate multiplied by a power of two; none if one leaves the supported range.
pub fn scaled(mesh: &TriMesh, exponent: i32) -> Option<TriMesh> {
    let (s, t) = (2.0_f64.powi(exponent / 2), 2.0_f64.powi(exponent - exponent / 2));
    TriMesh::new(mesh.positions().iter().map(|p| p.map(|x| x * s * t)).collect(), mesh.faces().to_vec()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plain::area;
    use pompeiu_core::FaceId;
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;

    /// The strategies make what they promise.
    #[test]
    fn awkward_faces_are_common() {
        let mut runner = TestRunner::deterministic();
        let (mut without_area, mut twice) = (0, 0);
        for _ in 0..200 {
            let mesh = degenerate(8).new_tree(&mut runner).unwrap().current();
            let corners: Vec<_> = (0..mesh.faces().len() as u32).map(|f| mesh.corners(FaceId(f))).collect();
            without_area += corners.iter().filter(|t| area(**t) < 1e-12).count();
            twice += corners.windows(2).filter(|w| w[0] == w[1]).count();
        }
        assert!(without_area > 200 && twice > 50, "{without_area} {twice}");
    }
}
