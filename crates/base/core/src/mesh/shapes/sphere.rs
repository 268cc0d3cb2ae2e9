//! Spheres.

use super::arrays::{Arrays, count, length, turn};
use super::{ShapeError, icosahedron};
use crate::mesh::TriMesh;
use crate::mesh::edit::subdivide;

/// Icosahedron whose faces are split into four `subdivisions` times, vertices pushed out to the sphere each time.
///
/// # Shapes and units
/// `10·4^s + 2` vertices, `20·4^s` faces, closed. Every vertex has the length `radius` up to rounding.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooMany`] (from 14 subdivisions on), [`ShapeError::NoMemory`].
pub fn icosphere(radius: f64, subdivisions: u32) -> Result<TriMesh, ShapeError> {
    length("radius", radius)?;
    let quadruples = 4_u128.saturating_pow(subdivisions);
    let (vertices, faces) = (quadruples.saturating_mul(10).saturating_add(2), quadruples.saturating_mul(20));
    drop(Arrays::with_capacity(vertices, faces)?);
    let mut mesh = icosahedron(1.0)?;
    for _ in 0..subdivisions {
        let (mut positions, faces) = subdivide(&mesh)?.into_parts();
        for p in &mut positions {
            *p = on_sphere(*p, 1.0);
        }
        mesh = TriMesh::new(positions, faces)?;
    }
    let (positions, faces) = mesh.into_parts();
    Ok(TriMesh::new(positions.into_iter().map(|p| on_sphere(p, radius)).collect(), faces)?)
}

/// `p` moved along its ray to this distance from the origin.
fn on_sphere(p: [f64; 3], radius: f64) -> [f64; 3] {
    let norm = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
    p.map(|x| x / norm * radius)
}

/// Sphere of meridians and circles of latitude.
///
/// # Shapes and units
/// `segments ≥ 3` around the axis, `rings ≥ 2` bands from pole to pole: `segments·(rings−1) + 2` vertices,
/// `2·segments·(rings−1)` faces, closed.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn uv_sphere(radius: f64, segments: u32, rings: u32) -> Result<TriMesh, ShapeError> {
    length("radius", radius)?;
    let (n, m) = (count("segments", segments, 3)?, count("rings", rings, 2)?);
    let mut arrays = Arrays::with_capacity(n * (m - 1) + 2, 2 * n * (m - 1))?;
    arrays.positions.push([0.0, 0.0, radius]);
    for ring in 1..rings {
        let [cos, sin] = turn(ring.into(), 2 * u64::from(rings));
        for segment in 0..segments {
            let [x, y] = turn(segment.into(), segments.into());
            arrays.positions.push([radius * sin * x, radius * sin * y, radius * cos]);
        }
    }
    arrays.positions.push([0.0, 0.0, -radius]);
    let south = arrays.positions.len() as u32 - 1;
    let vertex = |ring: u32, segment: u32| 1 + (ring - 1) * segments + segment % segments;
    for segment in 0..segments {
        arrays.faces.push([0, vertex(1, segment), vertex(1, segment + 1)]);
    }
    for ring in 1..rings - 1 {
        for s in 0..segments {
            arrays.quad([vertex(ring, s), vertex(ring + 1, s), vertex(ring + 1, s + 1), vertex(ring, s + 1)]);
        }
    }
    for segment in 0..segments {
        arrays.faces.push([vertex(rings - 1, segment + 1), vertex(rings - 1, segment), south]);
    }
    arrays.into_mesh()
}

#[cfg(test)]
mod tests {
    use super::super::measure::{area, edges, euler_characteristic, volume};
    use super::*;
    use crate::mesh::FaceId;
    use std::f64::consts::PI;

    fn assert_on_sphere(mesh: &TriMesh, radius: f64) {
        for p in mesh.positions() {
            let norm = p.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert!((norm / radius - 1.0).abs() < 1e-15, "{norm}");
        }
    }

    fn edge_ratio(mesh: &TriMesh) -> f64 {
        let length = |[a, b]: [[f64; 3]; 2]| (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
        let lengths = (0..mesh.faces().len() as u32).flat_map(|f| {
            let [a, b, c] = mesh.corners(FaceId(f));
            [[a, b], [b, c], [c, a]].map(length)
        });
        let (least, most) = lengths.fold((f64::INFINITY, 0.0_f64), |(l, m), x| (l.min(x), m.max(x)));
        most / least
    }

    #[test]
    fn icosphere_has_its_counts_and_converges_to_the_sphere() {
        let mut errors = Vec::new();
        for s in 0..5 {
            let mesh = icosphere(2.0, s).unwrap();
            let quadruples = 4_usize.pow(s);
            assert_eq!((mesh.positions().len(), mesh.faces().len()), (10 * quadruples + 2, 20 * quadruples));
            assert_on_sphere(&mesh, 2.0);
            assert_eq!((euler_characteristic(&mesh), edges(&mesh).1, edges(&mesh).2), (2, 0, true));
            let longest_to_shortest = edge_ratio(&mesh);
            assert!(longest_to_shortest < 1.2, "{longest_to_shortest}");
            errors.push(1.0 - area(&mesh) / (16.0 * PI));
            assert!(volume(&mesh) > 0.0 && volume(&mesh) < 32.0 / 3.0 * PI);
        }
        // Quadratic convergence: the error falls by four with each split.
        assert!(errors.windows(2).skip(1).all(|e| (e[0] / e[1] - 4.0).abs() < 0.3), "{errors:?}");
    }

    #[test]
    fn uv_sphere_is_closed_and_of_the_right_size() {
        for (segments, rings) in [(3, 2), (7, 5), (64, 33)] {
            let mesh = uv_sphere(3.0, segments, rings).unwrap();
            let (n, m) = (segments as usize, rings as usize);
            assert_eq!((mesh.positions().len(), mesh.faces().len()), (n * (m - 1) + 2, 2 * n * (m - 1)));
            assert_on_sphere(&mesh, 3.0);
            assert_eq!((euler_characteristic(&mesh), edges(&mesh).1, edges(&mesh).2), (2, 0, true));
            assert!(volume(&mesh) > 0.0);
        }
        let fine = uv_sphere(3.0, 400, 200).unwrap();
        assert!((volume(&fine) / (36.0 * PI) - 1.0).abs() < 2e-4);
    }

    #[test]
    fn unusable_parameters_are_refused() {
        assert!(matches!(icosphere(f64::NAN, 2), Err(ShapeError::Size { what: "radius", .. })));
        assert_eq!(icosphere(-1.0, 2), Err(ShapeError::Size { what: "radius", value: -1.0 }));
        assert_eq!(icosphere(1.0, 14), Err(ShapeError::TooMany { what: "faces", count: 20 << 28 }));
        assert!(matches!(icosphere(1.0, u32::MAX), Err(ShapeError::TooMany { .. })));
        assert_eq!(uv_sphere(1.0, 2, 9), Err(ShapeError::TooFew { what: "segments", count: 2, least: 3 }));
        assert!(matches!(uv_sphere(1.0, u32::MAX, u32::MAX), Err(ShapeError::TooMany { .. })));
        assert!(matches!(uv_sphere(1e302, 3, 2), Err(ShapeError::Mesh(_))));
    }
}
