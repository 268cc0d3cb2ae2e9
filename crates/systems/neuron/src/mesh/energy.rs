//! The shape energy of cells, and its minimisation.

use super::energy_lanes::{Corners, LANES, Lanes, costs};
use super::shape::Shape;
use super::skin::Skin;
use super::wall::{Middle, NearWalls, Wall};
use glam::DVec3;
use pompeiu_core::run::Control;

/// The objective over the vertices around a node.
pub(super) struct Energy<'e> {
    pub(super) cells: &'e [[u32; 8]],
    /// Vertices that may move.
    pub(super) free: &'e [u32],
    /// Parameters along each axis of a cell at which its shape is measured.
    pub(super) places: &'e [f64],
    pub(super) shape: Shape,
    /// The wall, the vertices on it, and the weight of leaving it.
    pub(super) wall: Option<(&'e Wall, &'e [u32], f64)>,
    /// Middles of faces and edges on the wall, and the weight of their distance from it.
    pub(super) middles: (&'e [Middle], f64),
    /// Faces on the wall whose distance from it counts, not only that of their vertices.
    pub(super) skin: Option<&'e Skin<4>>,
    /// The size of the node, which makes steps and distances dimensionless.
    pub(super) scale: f64,
    /// The size of each cell, which makes its energy dimensionless: regularisation is relative to it.
    pub(super) sizes: &'e [f64],
    /// May end the minimisation early.
    pub(super) control: &'e Control,
}

/// What an energy keeps from one evaluation to the next.
pub(super) struct Scratch {
    /// The gradient with respect to all vertices.
    at: Vec<DVec3>,
    /// The parts of the wall near the vertices on it, near the middles, and near the points of faces.
    near: [NearWalls; 3],
    /// Some cells, their costs at points, and the derivatives of their sum.
    corners: Corners,
    values: Vec<Lanes>,
    by_corner: Corners,
}

impl Energy<'_> {
    /// For evaluations with this many vertices.
    pub(super) fn scratch(&self, vertices: usize) -> Scratch {
        let on_wall = self.wall.map_or(0, |(_, on_wall, _)| on_wall.len());
        let points = self.skin.map_or(0, Skin::points);
        let near = [on_wall, self.middles.0.len(), points].map(NearWalls::new);
        let corners = [[[0.0; LANES]; 3]; 8];
        Scratch { at: vec![DVec3::ZERO; vertices], near, corners, values: Vec::new(), by_corner: corners }
    }

    /// The energy; writes its gradient with respect to the free vertices to `gradient`.
    pub(super) fn value(&self, positions: &[DVec3], gradient: &mut [DVec3], scratch: &mut Scratch) -> f64 {
        let Scratch { at, near: [near_vertices, near_middles, near_points], corners, values, by_corner } =
            scratch;
        at.fill(DVec3::ZERO);
        let mut total = 0.0;
        let per_point = 1.0 / (self.places.len().pow(3) as f64);
        for (cells, sizes) in self.cells.chunks(LANES).zip(self.sizes.chunks(LANES)) {
            for lane in 0..LANES {
                // Places without a cell repeat the last one.
                let (cell, size) = (cells[lane.min(cells.len() - 1)], sizes[lane.min(cells.len() - 1)]);
                for (corner, v) in corners.iter_mut().zip(cell) {
                    let p = positions[v as usize] / size;
                    (corner[0][lane], corner[1][lane], corner[2][lane]) = (p.x, p.y, p.z);
                }
            }
            costs(corners, self.places, self.shape, values, by_corner);
            for (lane, (cell, size)) in cells.iter().zip(sizes).enumerate() {
                for cost in values.iter().map(|costs| costs[lane]) {
                    if !cost.is_finite() {
                        return f64::INFINITY;
                    }
                    total += cost * per_point;
                }
                for (&v, slopes) in cell.iter().zip(&*by_corner) {
                    let slope = DVec3::new(slopes[0][lane], slopes[1][lane], slopes[2][lane]);
                    at[v as usize] += slope * (per_point / size);
                }
            }
        }
        if let Some((wall, vertices, weight)) = self.wall {
            wall.add_cost((vertices, weight), self.scale, (positions, near_vertices), &mut total, at);
            wall.add_middles(self.middles, (positions, near_middles), &mut total, at);
        }
        if let Some(skin) = self.skin {
            skin.add_cost((positions, near_points), &mut total, at);
        }
        for (g, &v) in gradient.iter_mut().zip(self.free) {
            *g = at[v as usize];
        }
        total
    }

    /// The least determinant at the corners of cells, relative to their sizes.
    pub(super) fn least_determinant(&self, positions: &[DVec3]) -> f64 {
        let mut least = f64::INFINITY;
        for (cell, &size) in self.cells.iter().zip(self.sizes) {
            let p = cell.map(|v| positions[v as usize] / size);
            for corner in CORNERS {
                let [o, a, b, c] = corner.map(|k| p[k]);
                least = least.min((a - o).dot((b - o).cross(c - o)));
            }
        }
        least
    }

    /// Minimises the energy over the free vertices.
    pub(super) fn minimise(&self, positions: &mut [DVec3], steps: usize) -> f64 {
        let mut scratch = self.scratch(positions.len());
        minimise((self.free, self.scale), positions, (steps, self.control), |positions, gradient| {
            self.value(positions, gradient, &mut scratch)
        })
    }
}

/// Minimises a function of the free vertices, given its value and gradient, by the limited-memory BFGS method with a backtracking
/// line search.
pub(super) fn minimise(
    (free, scale): (&[u32], f64),
    positions: &mut [DVec3],
    (steps, control): (usize, &Control),
    mut energy: impl FnMut(&[DVec3], &mut [DVec3]) -> f64,
) -> f64 {
    let n = free.len();
    let mut gradient = vec![DVec3::ZERO; n];
    let mut value = energy(positions, &mut gradient);
    if !value.is_finite() {
        return value;
    }
    let mut memory: Vec<(Vec<DVec3>, Vec<DVec3>, f64)> = Vec::new();
    let mut next = positions.to_vec();
    let mut next_gradient = gradient.clone();
    for _ in 0..steps {
        if control.is_stopped() {
            break;
        }
        let mut direction: Vec<DVec3> = gradient.iter().map(|g| -*g).collect();
        let mut alphas = Vec::with_capacity(memory.len());
        for (s, y, rho) in memory.iter().rev() {
            let alpha = rho * dot(s, &direction);
            direction.iter_mut().zip(y).for_each(|(d, y)| *d -= *y * alpha);
            alphas.push(alpha);
        }
        if let Some((s, y, _)) = memory.last() {
            let factor = dot(s, y) / dot(y, y);
            for d in &mut direction {
                *d *= factor;
            }
        } else {
            // At most a tenth of the size.
            let greatest = gradient.iter().map(|g| g.length()).fold(0.0, f64::max);
            if greatest == 0.0 {
                return value;
            }
            for d in &mut direction {
                *d *= 0.02 * scale / greatest;
            }
        }
        for ((s, y, rho), alpha) in memory.iter().zip(alphas.iter().rev()) {
            let beta = rho * dot(y, &direction);
            direction.iter_mut().zip(s).for_each(|(d, s)| *d += *s * (alpha - beta));
        }
        let mut slope = dot(&gradient, &direction);
        if slope >= 0.0 {
            memory.clear();
            direction = gradient.iter().map(|g| -*g).collect();
            let greatest = gradient.iter().map(|g| g.length()).fold(f64::MIN_POSITIVE, f64::max);
            for d in &mut direction {
                *d *= 0.01 * scale / greatest;
            }
            slope = dot(&gradient, &direction);
        }
        let greatest = direction.iter().map(|d| d.length()).fold(0.0, f64::max);
        let mut step = if greatest > 0.3 * scale { 0.3 * scale / greatest } else { 1.0 };
        let mut moved = false;
        for _ in 0..30 {
            next.copy_from_slice(positions);
            for (d, &v) in direction.iter().zip(free) {
                next[v as usize] += *d * step;
            }
            let found = energy(&next, &mut next_gradient);
            if found.is_finite() && found <= value + 1e-4 * step * slope {
                let s: Vec<DVec3> = direction.iter().map(|d| *d * step).collect();
                let y: Vec<DVec3> = next_gradient.iter().zip(&gradient).map(|(a, b)| *a - *b).collect();
                let product = dot(&s, &y);
                if product > 1e-12 * dot(&y, &y).sqrt() * dot(&s, &s).sqrt() {
                    if memory.len() == MEMORY {
                        memory.remove(0);
                    }
                    memory.push((s, y, 1.0 / product));
                }
                moved = value - found > 1e-7 * value.abs();
                value = found;
                positions.copy_from_slice(&next);
                std::mem::swap(&mut gradient, &mut next_gradient);
                break;
            }
            step *= 0.5;
        }
        if !moved {
            break;
        }
    }
    value
}

/// Number of stored pairs of steps.
const MEMORY: usize = 8;

/// A corner of a cell and its neighbours along the three axes, right-handed.
const CORNERS: [[usize; 4]; 8] = [
    [0, 1, 3, 4],
    [1, 2, 0, 5],
    [2, 3, 1, 6],
    [3, 0, 2, 7],
    [4, 7, 5, 0],
    [5, 4, 6, 1],
    [6, 5, 7, 2],
    [7, 6, 4, 3],
];

fn dot(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::RoundCone;

    #[test]
    fn gradients_are_differences() {
        let mut positions: Vec<DVec3> = (0..8_u32)
            .map(|k| {
                let [x, y, z] =
                    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
                        [k as usize]
                        .map(f64::from);
                DVec3::new(
                    x + 0.1 * libm::sin(f64::from(7 * k)),
                    y + 0.1 * libm::cos(f64::from(5 * k)),
                    z * 1.3,
                )
            })
            .collect();
        let cells = [[0, 1, 2, 3, 4, 5, 6, 7]];
        let free = [2, 4, 6];
        let groups = vec![
            vec![RoundCone { ends: [DVec3::ZERO, DVec3::X], radii: [0.5, 0.7] }],
            vec![RoundCone { ends: [DVec3::ZERO, DVec3::Y], radii: [0.4, 0.3] }],
        ];
        let wall = Wall::new(groups, 0.1);
        for shape in [Shape::MeanRatio { epsilon: 0.3 }, Shape::Scaled { power: 3 }] {
            let at_first = positions.clone();
            let skin = Skin::new(&wall, &[[1, 2, 6, 5], [4, 5, 6, 7]], &at_first, 0.01);
            let energy = Energy {
                cells: &cells,
                free: &free,
                places: &[0.0, 0.5, 1.0],
                shape,
                wall: Some((&wall, &[6, 2], 3.0)),
                skin: Some(&skin),
                middles: (&[Middle { vertices: [1, 2, 6, 5], radius: 0.5 }], 2.0),
                scale: 0.8,
                sizes: &[0.7],
                control: &Control::default(),
            };
            let (mut gradient, mut other) = (vec![DVec3::ZERO; 3], vec![DVec3::ZERO; 3]);
            let mut scratch = energy.scratch(8);
            energy.value(&positions, &mut gradient, &mut scratch);
            for (k, &v) in free.iter().enumerate() {
                for axis in 0..3 {
                    let mut at = |shift: f64| {
                        positions[v as usize][axis] += shift;
                        let value = energy.value(&positions, &mut other, &mut scratch);
                        positions[v as usize][axis] -= shift;
                        value
                    };
                    let difference = (at(1e-6) - at(-1e-6)) / 2e-6;
                    assert!(
                        (difference - gradient[k][axis]).abs() < 1e-6 * (1.0 + difference.abs()),
                        "{difference} {:?}",
                        gradient[k]
                    );
                }
            }
        }
    }
}
