//! How drawn distances are spread over the area.

use super::triangles::Triangles;
use pompeiu_core::geom::Frame;

/// The share of the area in each of so many equal parts of a range; what is outside of it counts into the first or the last one.
///
/// Between its corners a distance is linear, as it is drawn: the parts of triangles are exact but for rounding.
pub(super) fn shares(
    triangles: &Triangles,
    frame: &Frame,
    (low, high): (f64, f64),
    parts: usize,
) -> Vec<f64> {
    let width = (high - low) / parts as f64;
    // Casts of what is below zero give zero.
    let part_of = |value: f64| (((value - low) / width) as usize).min(parts - 1);
    let (mut shares, mut whole) = (vec![0.0; parts], 0.0);
    let positions: Vec<_> = triangles.positions.iter().map(|position| frame.map(*position)).collect();
    for (corners, distances) in triangles.corners.iter().zip(&triangles.distances) {
        let area = area(corners.map(|v| positions[v as usize]));
        let mut distances = *distances;
        distances.sort_by(f64::total_cmp);
        let [first, last] = [distances[0], distances[2]].map(part_of);
        let mut below = 0.0;
        for part in first..=last {
            let end = if part == last { 1.0 } else { part_below(distances, low + (part + 1) as f64 * width) };
            shares[part] += area * (end - below);
            below = end;
        }
        whole += area;
    }
    shares.iter().map(|share| share / whole).collect()
}

/// The part of a triangle where a linear function with these values at the corners, ascending, is below a level.
fn part_below([a, b, c]: [f64; 3], level: f64) -> f64 {
    if level <= a {
        0.0
    } else if level < b {
        (level - a) / (b - a) * ((level - a) / (c - a))
    } else if level < c {
        1.0 - (c - level) / (c - b) * ((c - level) / (c - a))
    } else {
        1.0
    }
}

fn area([p, q, r]: [[f64; 3]; 3]) -> f64 {
    let [u, v] = [q, r].map(|corner| [0, 1, 2].map(|k| corner[k] - p[k]));
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    0.5 * (normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::TriMesh;
    use pompeiu_core::geom::Aabb;

    /// A square over which the distance rises from side to side, and a second one of three times its area with one distance.
    #[test]
    fn parts_of_linear_distances_are_exact() {
        let (o, x, y, xy) = ([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]);
        let far = |p: [f64; 3]| [3.0 * p[0] + 5.0, p[1], p[2]];
        let mut triangles = Triangles::default();
        for (corners, distances) in [
            ([o, x, xy], [-0.5, 1.5, 1.5]),
            ([o, xy, y], [-0.5, 1.5, -0.5]),
            ([o, x, xy].map(far), [0.3; 3]),
            ([o, xy, y].map(far), [0.3; 3]),
        ] {
            let corners = corners.map(|corner| triangles.add(corner));
            triangles.push(0, corners, distances);
        }
        let mesh = TriMesh::new(triangles.positions.clone(), vec![[0, 1, 2]]).unwrap();
        let frame = Frame::of(&Aabb::of_faces(&mesh));
        let found = shares(&triangles, &frame, (0.0, 1.0), 4);
        for (share, expected) in
            found.iter().zip([0.25 * 0.375, 0.25 * 0.125 + 0.75, 0.25 * 0.125, 0.25 * 0.375])
        {
            assert!((share - expected).abs() < 1e-12, "{found:?}");
        }
        assert_eq!(shares(&triangles, &frame, (0.0, 0.0), 3).len(), 3);
    }
}
