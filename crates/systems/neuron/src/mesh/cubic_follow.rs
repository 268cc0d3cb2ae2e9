//! Drawing the wall of a node with tricubic cells to the cones where it is too far from them.

use super::cubic_energy::{CubicEnergy, lagrange_table};
use super::follow::{NEAR, WEIGHTS, fitness, shapes};
use super::shape::Shape;
use super::skin::Skin;
use super::wall::Wall;
use glam::DVec3;

/// Parameters along each edge of a face at which its distance is measured: denser at the ends, because creases are between faces.
const PLACES: [f64; 13] = [0.0, 0.03, 0.08, 0.15, 0.25, 0.37, 0.5, 0.63, 0.75, 0.85, 0.92, 0.97, 1.0];

/// Weights of the distance of the wall while cells are not proven: they unfold first.
const UNFOLDING: [f64; 3] = [0.01, 0.1, 1.0];

/// Regularisation of the determinants of these cells.
const EPSILON: f64 = 1e-4;

/// Most steps of each minimisation.
const STEPS: usize = 30;

/// Proven scaled Jacobian below which mean ratios are minimised as well.
pub(super) const EVEN_BELOW: f64 = 0.65;

/// The weight of mean ratios then.
pub(super) const EVEN: f64 = 3.0;

/// The positions at thirds of the cells around a node, and what is known of them.
#[derive(Clone)]
pub(super) struct Bent {
    /// The positions, and the control points.
    pub(super) positions: Vec<DVec3>,
    pub(super) points: Vec<DVec3>,
    /// The least scaled Jacobian, and whether every cell is proven to have a positive Jacobian.
    pub(super) quality: f64,
    pub(super) certified: bool,
    /// The greatest distance of its wall from the cones of the tubes, in radii.
    pub(super) off: f64,
}

impl Bent {
    /// How good it is; those with a cell that is not proven are less fit than all others.
    pub(super) fn fitness(&self) -> f64 {
        if self.certified { fitness(self.quality, self.off) } else { f64::NEG_INFINITY }
    }

    /// Whether its least scaled Jacobian is larger, and its wall as near or near enough.
    pub(super) fn is_better(&self, other: &Self) -> bool {
        self.certified && self.quality > other.quality && self.off <= other.off.max(NEAR)
    }
}

/// The greatest distance of faces on the wall from cones, in radii.
pub(super) fn off(cones: &Wall, faces: &[[u32; 16]], positions: &[DVec3]) -> f64 {
    Skin::of_faces(cones, faces, bicubic(), positions, 0.0).off(positions)
}

/// Moves positions, those on the wall as well, with an increasing weight of the distance of faces from the cones, until the wall is near; returns
/// the fittest. `measured` tells what is known of positions.
///
/// Cells fold between the parameters at which their shape is measured more easily than at them: what is not proven any more is done again with more
/// parameters, those of the second energy.
pub(super) fn follow(
    bent: Bent,
    energies: [&CubicEnergy<'_>; 2],
    (cones, faces): (&Wall, &[[u32; 16]]),
    measured: impl Fn(Vec<DVec3>) -> Bent,
) -> Bent {
    let mut state = bent.clone();
    let (mut best, mut of_best) = (bent, WEIGHTS[0]);
    let step = |state: &Bent, energy: &CubicEnergy<'_>, (shape, weight): (Shape, f64)| {
        let skin = Skin::of_faces(cones, faces, bicubic(), &state.positions, weight);
        let mut positions = state.positions.clone();
        let energy = CubicEnergy { shape, wall: None, skin: Some(&skin), ..*energy };
        energy.minimise(&mut positions, STEPS);
        measured(positions)
    };
    let [few, many] = &energies;
    for weight in UNFOLDING {
        if !state.certified && !few.control.is_stopped() {
            state = step(&state, many, (Shape::MeanRatio { epsilon: EPSILON }, weight));
        }
    }
    for weight in WEIGHTS {
        let mut is_moved = false;
        for (shape, factor) in shapes() {
            let mut found = step(&state, few, (shape, weight * factor));
            if !found.certified {
                found = step(&state, many, (shape, weight * factor));
            }
            if few.control.is_stopped() {
                return best;
            }
            if found.certified {
                state = found;
                is_moved = true;
            }
            if state.fitness() > best.fitness() {
                (best, of_best) = (state.clone(), weight);
            }
        }
        // Cells that fold fold with a greater weight as well.
        if !is_moved || state.off <= NEAR {
            break;
        }
    }
    if best.certified && best.quality < EVEN_BELOW {
        let few = &CubicEnergy { even: EVEN, ..**few };
        let mut state = best.clone();
        for (shape, factor) in shapes() {
            state = step(&state, few, (shape, (1.0 + EVEN) * of_best * factor));
            if state.is_better(&best) {
                best = state.clone();
            }
        }
    }
    best
}

/// The weights of the positions at thirds of a bicubic face at the points.
fn bicubic() -> Vec<[f64; 16]> {
    let rows: Vec<[f64; 4]> = lagrange_table(&PLACES).into_iter().map(|(values, _)| values).collect();
    let at = |[u, v]: [&[f64; 4]; 2]| std::array::from_fn(|k| u[k / 4] * v[k % 4]);
    rows.iter().flat_map(|u| rows.iter().map(move |v| at([u, v]))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_faces_reproduce_cubics() {
        let cubic = |u: f64, v: f64| u * u * u - 2.0 * u * v * v + v;
        for (k, weights) in bicubic().iter().enumerate() {
            let [u, v] = [k / PLACES.len(), k % PLACES.len()].map(|i| PLACES[i]);
            let nodes = (0..16).map(|k| cubic(f64::from(k / 4) / 3.0, f64::from(k % 4) / 3.0));
            let found: f64 = nodes.zip(weights).map(|(value, weight)| value * weight).sum();
            assert!((found - cubic(u, v)).abs() < 1e-12);
        }
    }
}
