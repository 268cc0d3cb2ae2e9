//! Bodies for scenes: boxes of tetrahedra, rods, sheets.

use glam::DVec3;

/// A box of `cells` cells along each axis, each of six tetrahedra; positions and tetrahedra.
pub fn tetrahedral_box(low: DVec3, high: DVec3, cells: [usize; 3]) -> (Vec<DVec3>, Vec<[u32; 4]>) {
    let cells = cells.map(|n| n.max(1));
    let points = cells.map(|n| n + 1);
    let index = |i: usize, j: usize, k: usize| ((k * points[1] + j) * points[0] + i) as u32;
    let mut positions = Vec::with_capacity(points.iter().product());
    for k in 0..points[2] {
        for j in 0..points[1] {
            for i in 0..points[0] {
                let share = DVec3::new(
                    i as f64 / cells[0] as f64,
                    j as f64 / cells[1] as f64,
                    k as f64 / cells[2] as f64,
                );
                positions.push(low + (high - low) * share);
            }
        }
    }
    // Kuhn's six: a path along the axes in each order.
    let orders = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
    let mut tetrahedra = Vec::with_capacity(6 * cells.iter().product::<usize>());
    for k in 0..cells[2] {
        for j in 0..cells[1] {
            for i in 0..cells[0] {
                for (number, order) in orders.iter().enumerate() {
                    let mut at = [i, j, k];
                    let mut path = [index(i, j, k); 4];
                    for (step, &axis) in order.iter().enumerate() {
                        at[axis] += 1;
                        path[step + 1] = index(at[0], at[1], at[2]);
                    }
                    if number >= 3 {
                        path.swap(2, 3);
                    }
                    tetrahedra.push(path);
                }
            }
        }
    }
    (positions, tetrahedra)
}

/// A flat sheet from `corner` along two sides, with diagonals in turns; positions and faces.
pub fn sheet(corner: DVec3, sides: [DVec3; 2], cells: [usize; 2]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let [nx, ny] = cells.map(|n| n.max(1));
    let mut positions = Vec::with_capacity((nx + 1) * (ny + 1));
    for j in 0..=ny {
        for i in 0..=nx {
            positions.push(corner + sides[0] * (i as f64 / nx as f64) + sides[1] * (j as f64 / ny as f64));
        }
    }
    let index = |i: usize, j: usize| (j * (nx + 1) + i) as u32;
    let mut faces = Vec::with_capacity(2 * nx * ny);
    for j in 0..ny {
        for i in 0..nx {
            let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i, j + 1), index(i + 1, j + 1)];
            if (i + j) % 2 == 0 {
                faces.extend([[a, b, d], [a, d, c]]);
            } else {
                faces.extend([[a, b, c], [b, d, c]]);
            }
        }
    }
    (positions, faces)
}
