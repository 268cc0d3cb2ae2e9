//! The linear systems of one connectivity: numbered once, analysed once, factored at each step.

use super::moving::{Motion, MovingSurface};
use super::triangle::Triangle;
use glam::DVec3;
use pompeiu_solve::{
    Analysis, Cholesky, ElementPattern, FIXED, LinearSolver, Ordering, SolveError, SparseMatrix,
};

/// One unknown for each vertex that may move in a certain way.
pub(crate) struct Numbered {
    /// By vertex; [`FIXED`] where there is none.
    unknown: Vec<u32>,
    vertices: Vec<u32>,
    pattern: ElementPattern<3>,
    analysis: Option<Analysis>,
}

impl Numbered {
    fn new(surface: &MovingSurface, moves: impl Fn(Motion) -> bool) -> Result<Self, SolveError> {
        let mut vertices = Vec::new();
        let mut unknown = vec![FIXED; surface.motion.len()];
        let used = |v: usize| surface.mesh.has_faces(v as u32);
        for v in (0..surface.motion.len()).filter(|&v| used(v) && moves(surface.motion[v])) {
            unknown[v] = vertices.len() as u32;
            vertices.push(v as u32);
        }
        let elements: Vec<[u32; 3]> =
            surface.faces().iter().map(|face| face.map(|v| unknown[v as usize])).collect();
        let pattern = ElementPattern::new(vertices.len(), &elements)?;
        Ok(Self { unknown, vertices, pattern, analysis: None })
    }

    pub(crate) fn unknowns(&self) -> usize {
        self.vertices.len()
    }

    /// Values at the vertices of the unknowns.
    pub(crate) fn gather(&self, at: impl Fn(usize) -> f64) -> Vec<f64> {
        self.vertices.iter().map(|&v| at(v as usize)).collect()
    }

    /// The value of the unknown of a vertex, or 0.
    pub(crate) fn value(&self, solution: &[f64], v: usize) -> f64 {
        solution.get(self.unknown[v] as usize).copied().unwrap_or(0.0)
    }

    /// The matrix of elements, plus a value for each vertex on the diagonal.
    pub(crate) fn assemble(
        &self,
        diagonal: impl Fn(usize) -> f64,
        element: impl Fn(usize) -> [[f64; 3]; 3],
    ) -> Result<SparseMatrix, SolveError> {
        self.pattern.assemble(&self.gather(diagonal), element)
    }

    pub(crate) fn factor(&mut self, matrix: &SparseMatrix) -> Result<Cholesky, SolveError> {
        let analysis = prepared(&mut self.analysis, || Analysis::new(matrix, &Ordering::MinimumDegree))?;
        Cholesky::with(analysis, matrix)
    }
}

/// What was prepared before, or is prepared now.
pub(crate) fn prepared<T>(
    known: &mut Option<T>,
    prepare: impl FnOnce() -> Result<T, SolveError>,
) -> Result<&mut T, SolveError> {
    let value = match known.take() {
        Some(value) => value,
        None => prepare()?,
    };
    Ok(known.insert(value))
}

/// The systems of one connectivity.
pub(crate) struct Systems {
    /// One unknown for each vertex that may move at all.
    pub(crate) moving: Numbered,
    /// One for each vertex that may move along z, where these are fewer.
    free: Option<Numbered>,
}

impl Systems {
    pub(crate) fn new(surface: &MovingSurface) -> Result<Self, SolveError> {
        let free = surface.motion.contains(&Motion::InPlane);
        let of_z = |motion: Motion| motion.allows(2);
        Ok(Self {
            moving: Numbered::new(surface, |motion| motion.allows(0))?,
            free: free.then(|| Numbered::new(surface, of_z)).transpose()?,
        })
    }

    /// Solves `(M/δ + L) X = R` for each of several vector fields R, `inverse_step` being 1/δ, with the masses and the stiffness given.
    pub(crate) fn solve_implicit(
        &mut self,
        masses: &[f64],
        inverse_step: f64,
        stiffness: &[Triangle],
        right_hand_sides: &[&[DVec3]],
    ) -> Result<Vec<Vec<DVec3>>, SolveError> {
        let mut solved: Vec<Vec<DVec3>> =
            right_hand_sides.iter().map(|r| vec![DVec3::ZERO; r.len()]).collect();
        let mut solve = |numbered: &mut Numbered, coordinates: &[usize]| {
            if numbered.unknowns() == 0 {
                return Ok(());
            }
            let matrix = numbered.assemble(|v| masses[v] * inverse_step, |f| stiffness[f].stiffness())?;
            let factor = numbered.factor(&matrix)?;
            let mut columns = Vec::new();
            for side in right_hand_sides {
                for &k in coordinates {
                    columns.extend(numbered.gather(|v| side[v][k]));
                }
            }
            factor.solve_in_place(&mut columns)?;
            let mut parts = columns.chunks_exact(numbered.unknowns());
            for solution in &mut solved {
                for (&k, part) in coordinates.iter().zip(parts.by_ref()) {
                    for (v, x) in solution.iter_mut().enumerate() {
                        x[k] = numbered.value(part, v);
                    }
                }
            }
            Ok(())
        };
        match &mut self.free {
            Some(free) => {
                solve(&mut self.moving, &[0, 1])?;
                solve(free, &[2])?;
            }
            None => solve(&mut self.moving, &[0, 1, 2])?,
        }
        Ok(solved)
    }
}
