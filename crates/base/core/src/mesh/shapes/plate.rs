//! Plates with holes: closed surfaces of any genus.

use super::ShapeError;
use super::arrays::{Arrays, count, length};
use crate::mesh::TriMesh;

/// Plate with a row of square holes through it: a closed surface whose genus is the number of holes.
///
/// It is made of cubes with this edge, `2 holes + 1` along x, three along y and one along z, of which every other one in the
/// middle row is missing; one corner is at the origin.
///
/// # Shapes and units
/// `16 (holes + 1)` vertices, `36 holes + 28` faces, volume `(5 holes + 3) edge³`.
/// # Errors
/// [`ShapeError::Size`], [`ShapeError::TooMany`], [`ShapeError::NoMemory`].
pub fn perforated_plate(edge: f64, holes: u32) -> Result<TriMesh, ShapeError> {
    length("edge", edge)?;
    let n = count("holes", holes, 0)?;
    let mut arrays = Arrays::with_capacity(16 * (n + 1), 36 * n + 28)?;
    let cubes = 2 * i64::from(holes) + 1;
    for k in 0..2 {
        for j in 0..4 {
            for i in 0..=cubes {
                arrays.positions.push([i as f64 * edge, f64::from(j) * edge, f64::from(k) * edge]);
            }
        }
    }
    let vertex = |[i, j, k]: [i64; 3]| ((k * 4 + j) * (cubes + 1) + i) as u32;
    let filled = |[i, j, k]: [i64; 3]| {
        let inside = (0..cubes).contains(&i) && (0..3).contains(&j) && k == 0;
        inside && !(j == 1 && i % 2 == 1)
    };
    for j in 0..3 {
        for i in 0..cubes {
            let cube = [i, j, 0];
            if !filled(cube) {
                continue;
            }
            for axis in 0..3 {
                for far in [0, 1] {
                    let mut neighbour = cube;
                    neighbour[axis] += 2 * far - 1;
                    if filled(neighbour) {
                        continue;
                    }
                    let corner = |u: i64, v: i64| {
                        let mut at = cube;
                        at[axis] += far;
                        at[(axis + 1) % 3] += u;
                        at[(axis + 2) % 3] += v;
                        vertex(at)
                    };
                    let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                    arrays.quad(if far == 1 { [a, b, c, d] } else { [a, d, c, b] });
                }
            }
        }
    }
    arrays.into_mesh()
}

#[cfg(test)]
mod tests {
    use super::super::measure::{assert_solid, euler_characteristic};
    use super::*;
    use crate::mesh::MeshSummary;

    #[test]
    fn each_hole_is_a_handle() {
        for holes in 0..4_u32 {
            let mesh = perforated_plate(0.5, holes).unwrap();
            let n = holes as usize;
            assert_eq!((mesh.positions().len(), mesh.faces().len()), (16 * (n + 1), 36 * n + 28));
            assert_solid(&mesh, f64::from(5 * holes + 3) / 8.0 * 1.0);
            assert_eq!(euler_characteristic(&mesh), 2 - 2 * i128::from(holes));
            assert_eq!(MeshSummary::of(&mesh).connectivity.genus, Some(n));
        }
    }

    #[test]
    fn unusable_parameters_are_refused() {
        assert!(matches!(perforated_plate(0.0, 1), Err(ShapeError::Size { .. })));
        assert!(matches!(perforated_plate(1.0, u32::MAX), Err(ShapeError::TooMany { .. })));
    }
}
