//! Normals for shading: those of faces, smoothed where faces meet at small angles.

use crate::appearance::CornerValues;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::UnionFind;

/// The cosine of the largest angle between the normals of faces that are shaded as one surface: 30 degrees, the usual angle of modellers.
const SMOOTH: f64 = 0.866_025_403_784_438_6;

/// The sum of the normals of the faces around each vertex, weighted by area, as far as they meet at angles of at most 30 degrees across
/// edges with two faces of one orientation. Unit vectors, also at faces without area.
///
/// # Cost
/// O(m log m) for m faces.
pub(super) fn smooth(mesh: &TriMesh) -> CornerValues<3> {
    let areas = face_normals(mesh);
    let mut fans = UnionFind::new(3 * mesh.faces().len());
    for [h, t] in smooth_edges(mesh, &areas) {
        let next = |h: usize| if h % 3 == 2 { h - 2 } else { h + 1 };
        fans.union(h, next(t));
        fans.union(next(h), t);
    }
    let corners = 3 * mesh.faces().len();
    let mut number = vec![u32::MAX; corners];
    let mut found = CornerValues { values: Vec::new(), corners: vec![[0; 3]; mesh.faces().len()] };
    for corner in 0..corners {
        let fan = fans.find(corner);
        if number[fan] == u32::MAX {
            number[fan] = found.values.len() as u32;
            found.values.push([0.0; 3]);
        }
        found.corners[corner / 3][corner % 3] = number[fan];
        let sum = &mut found.values[number[fan] as usize];
        *sum = std::array::from_fn(|i| sum[i] + areas[corner / 3][i]);
    }
    for normal in &mut found.values {
        *normal = unit(*normal).unwrap_or([0.0, 0.0, 1.0]);
    }
    found
}

/// A vector divided by its length, if that is a positive number.
pub(super) fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let largest = vector.iter().fold(0.0, |most: f64, x| if x.abs() > most { x.abs() } else { most });
    let scaled = vector.map(|x| x / largest);
    let length = dot(scaled, scaled).sqrt();
    (length > 0.0 && length.is_finite()).then(|| scaled.map(|x| x / length))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Normals whose lengths are in proportion to the areas.
fn face_normals(mesh: &TriMesh) -> Vec<[f64; 3]> {
    // Divided by the largest coordinate, so that products do not overflow.
    let coordinates = mesh.positions().as_flattened().iter();
    let largest = coordinates.fold(0.0, |most: f64, x| if x.abs() > most { x.abs() } else { most });
    let unit = if largest > 0.0 { largest } else { 1.0 };
    let of = |face: &[u32; 3]| {
        let [p, q, r] = face.map(|v| mesh.positions()[v as usize].map(|x| x / unit));
        let [a, b] = [q, r].map(|to| [to[0] - p[0], to[1] - p[1], to[2] - p[2]]);
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    mesh.faces().iter().map(of).collect()
}

/// The two halfedges of each edge across which faces are shaded as one surface. Halfedge 3 f + i begins at corner i of face f.
fn smooth_edges(mesh: &TriMesh, areas: &[[f64; 3]]) -> impl Iterator<Item = [usize; 2]> {
    let units: Vec<Option<[f64; 3]>> = areas.iter().map(|normal| unit(*normal)).collect();
    let ends = |h: usize| {
        let face = mesh.faces()[h / 3];
        [face[h % 3], face[(h + 1) % 3]]
    };
    let mut edges: Vec<([u32; 2], usize)> = (0..3 * mesh.faces().len())
        .map(|h| {
            let [u, v] = ends(h);
            ([u.min(v), u.max(v)], h)
        })
        .collect();
    edges.sort_unstable();
    let pairs: Vec<[usize; 2]> = edges
        .chunk_by(|a, b| a.0 == b.0)
        .filter_map(|edge| match *edge {
            [(_, h), (_, t)] if ends(h) != ends(t) => Some([h, t]),
            _ => None,
        })
        .collect();
    pairs.into_iter().filter(move |[h, t]| match (units[h / 3], units[t / 3]) {
        (Some(a), Some(b)) => dot(a, b) >= SMOOTH,
        // A face without area would join both sides of a crease.
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::{cube, icosphere};

    #[test]
    fn a_cube_is_flat_and_a_sphere_is_round() {
        let cube = cube(2.0, 3).unwrap();
        let normals = smooth(&cube);
        for (face, corners) in normals.corners.iter().enumerate() {
            let expected = unit(face_normals(&cube)[face]).unwrap();
            for &corner in corners {
                let found = normals.values[corner as usize];
                assert!((dot(found, expected) - 1.0).abs() < 1e-12, "{found:?} {expected:?}");
            }
        }
        let sphere = icosphere(1.0, 3).unwrap();
        let normals = smooth(&sphere);
        assert_eq!(normals.values.len(), sphere.positions().len());
        for (v, corner) in sphere.faces().as_flattened().iter().zip(normals.corners.as_flattened()) {
            assert!(dot(sphere.positions()[*v as usize], normals.values[*corner as usize]) > 0.999);
        }
    }

    #[test]
    fn every_normal_has_length_one() {
        let huge = 1e300;
        let positions = vec![[0.0; 3], [huge, 0.0, 0.0], [0.0, huge, 0.0], [0.0, 0.0, 1e-300]];
        let mesh = TriMesh::new(positions, vec![[0, 1, 2], [0, 0, 0], [0, 1, 3], [1, 0, 2]]).unwrap();
        let normals = smooth(&mesh);
        assert!(normals.values.iter().all(|normal| (dot(*normal, *normal) - 1.0).abs() < 1e-12));
    }
}
