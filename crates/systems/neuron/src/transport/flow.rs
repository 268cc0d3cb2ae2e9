//! The velocity field of motors: potential flow from the inlet to the tips.

use super::discretisation::Discretisation;
use super::error::TransportError;
use super::factor::cholesky;
use pompeiu_core::run::Control;
use pompeiu_solve::{LinearSolver, SparseMatrix};

/// Fluxes through faces, in µm³/s for a mean speed of 1 µm/s at the inlet; they balance in each cell.
#[derive(Clone, Debug)]
pub struct FlowField {
    /// For each link the flux from its first cell to its second.
    pub through: Vec<f64>,
    /// For each face on a flat end the outflow.
    pub out: Vec<f64>,
    /// The greatest imbalance of a cell, relative to the inlet.
    pub imbalance: f64,
}

impl FlowField {
    /// No flux at all.
    pub(super) fn at_rest(mesh: &Discretisation) -> Self {
        Self { through: vec![0.0; mesh.links.len()], out: vec![0.0; mesh.ends.len()], imbalance: 0.0 }
    }
}

/// Potential flow: unit speed at the inlet, the same potential at all tips, nothing through the wall.
///
/// # Definition
/// Fluxes are conductances times differences of the potential, whose sum over the faces of each cell vanishes.
/// # Errors
/// [`TransportError::NoOutlet`], [`TransportError::Solve`], [`TransportError::Stopped`].
pub fn potential_flow(
    mesh: &Discretisation,
    inlet: u32,
    control: &Control,
) -> Result<FlowField, TransportError> {
    let n = mesh.volumes.len();
    let mut entries = Vec::with_capacity(4 * mesh.links.len() + mesh.ends.len());
    for &([a, b], conductance) in &mesh.links {
        let (a, b) = (a as usize, b as usize);
        entries.extend([
            (a, a, conductance),
            (b, b, conductance),
            (a, b, -conductance),
            (b, a, -conductance),
        ]);
    }
    let mut right = vec![0.0; n];
    let mut has_outlet = false;
    let mut entering = 0.0;
    for end in &mesh.ends {
        let cell = end.cell as usize;
        if end.cap == inlet {
            right[cell] += end.area;
            entering += end.area;
        } else {
            entries.push((cell, cell, end.conductance));
            has_outlet = true;
        }
    }
    if !has_outlet {
        return Err(TransportError::NoOutlet);
    }
    let (solver, matrix) = cholesky(SparseMatrix::from_triplets(n, n, &entries)?, control)?;
    let mut potential = solver.solve(&right)?;
    // One step of iterative refinement: fluxes are differences of large numbers in a long tree.
    let rest: Vec<f64> = matrix.multiply(&potential).iter().zip(&right).map(|(a, b)| b - a).collect();
    let correction = solver.solve(&rest)?;
    potential.iter_mut().zip(correction).for_each(|(p, c)| *p += c);
    let through: Vec<f64> =
        mesh.links.iter().map(|&([a, b], c)| c * (potential[a as usize] - potential[b as usize])).collect();
    let out: Vec<f64> = mesh
        .ends
        .iter()
        .map(|end| if end.cap == inlet { -end.area } else { end.conductance * potential[end.cell as usize] })
        .collect();
    let mut net = vec![0.0; n];
    for (&([a, b], _), q) in mesh.links.iter().zip(&through) {
        net[a as usize] += q;
        net[b as usize] -= q;
    }
    for (end, q) in mesh.ends.iter().zip(&out) {
        net[end.cell as usize] += q;
    }
    let imbalance = net.iter().fold(0.0, |most: f64, x| most.max(x.abs())) / entering;
    Ok(FlowField { through, out, imbalance })
}
