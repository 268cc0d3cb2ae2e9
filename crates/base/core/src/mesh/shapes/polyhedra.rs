//! Regular solids and boxes.

use super::ShapeError;
use super::arrays::{Arrays, centred, count, length};
use crate::mesh::TriMesh;

/// Regular tetrahedron with this edge length: 4 vertices, 4 faces, area `√3·a²`, volume `a³/(6√2)`.
///
/// # Errors
/// [`ShapeError::Size`], or [`ShapeError::Mesh`] beyond the largest coordinate.
pub fn tetrahedron(edge: f64) -> Result<TriMesh, ShapeError> {
    let c = length("edge", edge)? * (std::f64::consts::SQRT_2 / 4.0);
    let positions = vec![[c, c, c], [c, -c, -c], [-c, c, -c], [-c, -c, c]];
    Ok(TriMesh::new(positions, vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])?)
}

/// Regular icosahedron inscribed in a sphere: 12 vertices, 20 faces, edge `r/sin(2π/5)`.
///
/// # Errors
/// [`ShapeError::Size`], or [`ShapeError::Mesh`] beyond the largest coordinate.
pub fn icosahedron(radius: f64) -> Result<TriMesh, ShapeError> {
    let golden = f64::midpoint(1.0, 5.0_f64.sqrt());
    let norm = (1.0 + golden * golden).sqrt();
    let (s, l) = (length("radius", radius)? / norm, radius * (golden / norm));
    let positions = vec![
        [-s, l, 0.0],
        [s, l, 0.0],
        [-s, -l, 0.0],
        [s, -l, 0.0],
        [0.0, -s, l],
        [0.0, s, l],
        [0.0, -s, -l],
        [0.0, s, -l],
        [l, 0.0, -s],
        [l, 0.0, s],
        [-l, 0.0, -s],
        [-l, 0.0, s],
    ];
    let faces = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    Ok(TriMesh::new(positions, faces)?)
}

/// Cube of this side with `cells × cells` split squares on each of its sides; see [`cuboid`].
///
/// # Errors
/// As [`cuboid`].
pub fn cube(side: f64, cells: u32) -> Result<TriMesh, ShapeError> {
    cuboid([side; 3], cells)
}

/// Box with `cells × cells` split rectangles on each of its six sides.
///
/// # Shapes and units
/// `size`: extents along x, y, z. `6n² + 2` vertices, `12n²` faces, closed; area and volume of the box.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooFew`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn cuboid(size: [f64; 3], cells: u32) -> Result<TriMesh, ShapeError> {
    for extent in size {
        length("side", extent)?;
    }
    let n = count("cells", cells, 1)?;
    let mut arrays = Arrays::with_capacity(6 * n * n + 2, 12 * n * n)?;
    for k in 0..=cells {
        for j in 0..=cells {
            // Inside the box only the first and the last of a row lie on its surface.
            let inner = k % cells != 0 && j % cells != 0;
            let step = if inner { cells } else { 1 };
            for i in (0..=cells).step_by(step as usize) {
                arrays.positions.push([
                    centred(size[0], i, cells),
                    centred(size[1], j, cells),
                    centred(size[2], k, cells),
                ]);
            }
        }
    }
    for axis in 0..3 {
        for far in [false, true] {
            for u in 0..cells {
                for v in 0..cells {
                    let corner = |du: u32, dv: u32| {
                        let mut at = [0; 3];
                        at[axis] = if far { cells } else { 0 };
                        at[(axis + 1) % 3] = u + du;
                        at[(axis + 2) % 3] = v + dv;
                        surface_index(at, cells)
                    };
                    let quad = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                    arrays.quad(if far { quad } else { [quad[0], quad[3], quad[2], quad[1]] });
                }
            }
        }
    }
    arrays.into_mesh()
}

/// Index of the lattice point `[i, j, k]` among those on the surface of `[0, n]³`, in the order of [`cuboid`].
fn surface_index([i, j, k]: [u32; 3], n: u32) -> u32 {
    let (full_layer, hollow_layer) = ((n + 1) * (n + 1), 4 * n);
    let before = if k == 0 { 0 } else { full_layer + (k - 1) * hollow_layer };
    before
        + if k == 0 || k == n {
            j * (n + 1) + i
        } else if j == 0 {
            i
        } else if j == n {
            n + 1 + 2 * (n - 1) + i
        } else {
            n + 1 + 2 * (j - 1) + i / n
        }
}

#[cfg(test)]
mod tests {
    use super::super::measure::{area, assert_close, assert_solid, euler_characteristic};
    use super::*;

    #[test]
    fn regular_solids_follow_their_closed_forms() {
        let mesh = tetrahedron(2.0).unwrap();
        assert_solid(&mesh, 8.0 / (6.0 * 2.0_f64.sqrt()));
        assert_close(area(&mesh), 3.0_f64.sqrt() * 4.0);
        let edge = 3.0 / (std::f64::consts::TAU / 5.0).sin();
        let mesh = icosahedron(3.0).unwrap();
        assert_solid(&mesh, 5.0 / 12.0 * (3.0 + 5.0_f64.sqrt()) * edge.powi(3));
        assert_close(area(&mesh), 5.0 * 3.0_f64.sqrt() * edge * edge);
    }

    #[test]
    fn boxes_have_their_counts_area_and_volume() {
        for n in [1, 2, 3, 8] {
            let mesh = cuboid([1.0, 2.0, 4.0], n).unwrap();
            let cells = (n * n) as usize;
            assert_eq!((mesh.positions().len(), mesh.faces().len()), (6 * cells + 2, 12 * cells));
            assert_solid(&mesh, 8.0);
            assert_close(area(&mesh), 28.0);
            assert_eq!(euler_characteristic(&mesh), 2);
        }
        assert_eq!(cube(1.0, 1).unwrap().positions()[7], [0.5; 3]);
    }

    #[test]
    fn unusable_parameters_are_refused() {
        assert_eq!(cube(1.0, 0), Err(ShapeError::TooFew { what: "cells", count: 0, least: 1 }));
        assert_eq!(cuboid([1.0, -2.0, 1.0], 1), Err(ShapeError::Size { what: "side", value: -2.0 }));
        assert!(matches!(cube(1.0, 1 << 16), Err(ShapeError::TooMany { .. })));
        assert!(matches!(tetrahedron(f64::INFINITY), Err(ShapeError::Size { what: "edge", .. })));
    }
}
