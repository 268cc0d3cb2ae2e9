//! Free-boundary maps: minimising the symmetric Dirichlet energy without flips and, on request, without overlaps.

use super::energy::{Elements, Local, moved};
use super::scaffold::Scaffold;
use crate::FlattenError;
use crate::check::{outline, outline_crossings};
use crate::watch::Watch;
use pompeiu_core::run::Instant;
use pompeiu_solve::{
    Analysis, Cholesky, ElementPattern, FIXED, LinearSolver, Ordering, SolveError, SparseMatrix,
};
use pompeiu_surface::EmbeddedSurface;
use pompeiu_surface::plane::Vec2;
use std::sync::OnceLock;
use std::time::Duration;

/// Stopping criteria of a minimisation.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Descent {
    /// Largest number of steps.
    pub(crate) steps: usize,
    /// Converged if the decrease predicted for a Newton step, relative to the distortion, is below this.
    pub(crate) tolerance: f64,
    /// Energy at which the minimisation stops; with `gives_up` it also stops when the energy is certain to stay above.
    pub(crate) enough: f64,
    pub(crate) gives_up: bool,
    /// Whether the outline must not cross itself.
    pub(crate) is_guarded: bool,
}

/// The result of a minimisation.
#[derive(Clone, Debug)]
pub(crate) struct Minimization {
    pub(crate) uv: Vec<Vec2>,
    pub(crate) energy: f64,
    pub(crate) steps: usize,
    pub(crate) factor: Duration,
}

/// Largest step, as a share of the step to the first flip.
const SAFE: f64 = 0.9;

/// Share of the predicted decrease that a step must achieve (Armijo).
const ARMIJO: f64 = 1e-4;

/// Longer step that is tried as well: where the Hessian was projected, the energy is flatter than its model.
const LONG: f64 = 2.0;

/// Largest number of halvings of a step.
const HALVINGS: usize = 40;

/// Weight of the scaffold relative to the surface, per unit of mean distortion.
const SCAFFOLD: f64 = 0.05 / 4.0;

/// Relative decrease of the energy that rounding hides.
const HIDDEN: f64 = 1e-13;

/// Positions are rounded to this part of the greatest coordinate to see whether an outline is clear of itself.
const CLEARANCE: f64 = 1.0 / (1_u64 << 36) as f64;

/// Regularisation of a Hessian's diagonal, relative to its mean: rigid motions do not change the energy.
const PROXIMAL: f64 = 1e-10;

/// Steps with one scaffold before the region between outline and box is triangulated again, unless it blocks progress earlier.
const KEEP: usize = 4;

/// For giving up: the possible further decrease of the energy as a multiple of the predicted decrease. Newton's model predicts half
/// of one; if steps are shortened, more of them follow.
const HOPE: f64 = 3.0;

/// A disk with everything that minimisations of its maps have in common.
pub(crate) struct Descender {
    vertices: usize,
    outline: Vec<[u32; 2]>,
    faces: Elements,
    system: System,
}

/// The linear system of Newton steps for some triangles.
struct System {
    pattern: ElementPattern<6>,
    order: Vec<usize>,
    analysis: OnceLock<Analysis>,
}

impl System {
    /// The system of triangles; vertices from `vertices` on are fixed.
    fn new(vertices: usize, groups: &[&[[u32; 3]]]) -> Result<Self, SolveError> {
        let unknown = |v: u32| if (v as usize) < vertices { v } else { FIXED };
        let elements: Vec<[u32; 3]> =
            groups.iter().flat_map(|group| group.iter()).map(|corners| corners.map(unknown)).collect();
        let pattern = ElementPattern::new(vertices, &elements)?;
        let scalar = pattern.assemble(&vec![0.0; vertices], |_| [[0.0; 3]; 3])?;
        // The ordering for one unknown per vertex is used for both coordinates.
        let scalar = Analysis::new(&scalar, &Ordering::MinimumDegree)?;
        let order = scalar.order().into_iter().flat_map(|v| [2 * v, 2 * v + 1]).collect();
        Ok(Self { pattern: pattern.doubled(), order, analysis: OnceLock::new() })
    }

    /// The Newton step for these derivatives, and the predicted decrease.
    fn step(&self, locals: &[Local], gradient: &[f64]) -> Result<(Vec<f64>, f64), SolveError> {
        let n = gradient.len();
        let mut diagonal = 0.0;
        for local in locals {
            diagonal += (0..6).map(|i| local.hessian[i][i]).sum::<f64>();
        }
        let mut extra = PROXIMAL * diagonal / n as f64;
        loop {
            let matrix: SparseMatrix = self.pattern.assemble(&vec![extra; n], |m| locals[m].hessian)?;
            let analysis = if let Some(analysis) = self.analysis.get() {
                analysis
            } else {
                let analysis = Analysis::new(&matrix, &Ordering::Given(self.order.clone()))?;
                self.analysis.get_or_init(|| analysis)
            };
            match Cholesky::with(analysis, &matrix) {
                Ok(factor) => {
                    let mut step: Vec<f64> = gradient.iter().map(|g| -g).collect();
                    factor.solve_in_place(&mut step)?;
                    let decrease = -step.iter().zip(gradient).map(|(d, g)| d * g).sum::<f64>();
                    return Ok((step, decrease));
                }
                Err(SolveError::NotPositiveDefinite { .. }) if extra < diagonal => extra *= 100.0,
                Err(error) => return Err(error),
            }
        }
    }
}

impl Descender {
    pub(crate) fn new(surface: &EmbeddedSurface) -> Result<Self, FlattenError> {
        let mesh = surface.mesh();
        let faces = Elements::of_surface(surface.surface());
        let system = System::new(mesh.vertices(), &[&faces.corners])?;
        Ok(Self { vertices: mesh.vertices(), outline: outline(mesh), faces, system })
    }

    /// Whether the outline of a map is simple.
    pub(crate) fn is_simple(&self, x: &[Vec2]) -> bool {
        outline_crossings(&self.outline, x).is_empty()
    }

    /// Whether the outline stays simple when positions are rounded, as they are when the chart is turned and packed.
    ///
    /// Both sides of a cut through a flat part come ever closer to each other.
    pub(crate) fn is_clear(&self, x: &[Vec2]) -> bool {
        let greatest =
            x.iter().flatten().fold(0.0, |most: f64, c| if c.abs() > most { c.abs() } else { most });
        let unit = CLEARANCE * greatest;
        if !self.is_simple(x) || unit == 0.0 {
            return false;
        }
        let rounded: Vec<Vec2> = x.iter().map(|p| p.map(|c| (c / unit).round() * unit)).collect();
        self.is_simple(&rounded)
    }

    /// Minimises the symmetric Dirichlet energy from a map without flips, by projected Newton steps that never flip a face. If the
    /// outline is guarded, it must be simple at the start; as soon as a step would make it cross itself, the minimisation continues
    /// with a scaffold around the disk.
    ///
    /// # Definition
    /// The mean over the area of σ1² + σ2² + σ1⁻² + σ2⁻²; with a scaffold, plus the same for its triangles relative to their shapes
    /// before the step, with a small weight.
    ///
    /// # Source
    /// `smith_bijective_2015` for the energy and the longest step, `jiang_simplicial_2017` for the scaffold.
    pub(crate) fn descend(
        &self,
        start: Vec<Vec2>,
        descent: &Descent,
        watch: &Watch<'_>,
    ) -> Result<Minimization, FlattenError> {
        let mut has_scaffold = false;
        // An outline that is never clear of itself is to be simple at least.
        let starts_clear = descent.is_guarded && self.is_clear(&start);
        let mut guard: Option<(Scaffold, System, usize)> = None;
        let mut x = start;
        let mut energy = self.faces.value(&x);
        let (mut steps, mut factor, mut last) = (0, Duration::ZERO, Duration::ZERO);
        while steps < descent.steps
            && energy > descent.enough
            && !watch.is_stopped()
            && !watch.is_over_after(last)
        {
            steps += 1;
            let began = Instant::now();
            let mut places = x.clone();
            let mut around = Elements::default();
            if has_scaffold && guard.as_ref().is_none_or(|(_, _, age)| *age >= KEEP) {
                let Some(scaffold) = Scaffold::around(&self.outline, &x) else { break };
                let system = System::new(self.vertices, &[&self.faces.corners, &scaffold.triangles])?;
                guard = Some((scaffold, system, 0));
            }
            if let Some((scaffold, _, age)) = &mut guard {
                *age += 1;
                places.extend(&scaffold.on_box);
                let weight = SCAFFOLD * (energy - 4.0).max(0.0);
                around = Elements::of_triangles(&scaffold.triangles, &places, weight);
            }
            let system = guard.as_ref().map_or(&self.system, |(_, system, _)| system);
            let (step, decrease) = self.newton_step(system, &around, &places)?;
            factor += began.elapsed();
            if descent.gives_up && energy - HOPE * decrease > descent.enough {
                break;
            }
            let mut direction: Vec<Vec2> = step.chunks_exact(2).map(|d| [d[0], d[1]]).collect();
            direction.resize(places.len(), [0.0; 2]);
            let flips = self.faces.longest_step(&places, &direction);
            let of_scaffold = around.longest_step(&places, &direction);
            let longest = SAFE * flips.min(of_scaffold);
            let total = |p: &[Vec2]| self.faces.value(p) + around.value(p);
            let before = total(&places);
            let mut t = if longest < 1.0 { longest } else { 1.0 };
            if longest >= LONG
                && total(&moved(&places, LONG, &direction)) < total(&moved(&places, 1.0, &direction))
            {
                t = LONG;
            }
            let mut found = None;
            let mut crosses = false;
            for _ in 0..HALVINGS {
                let candidate = moved(&places, t, &direction);
                let after = total(&candidate);
                let is_hidden = decrease <= HIDDEN * before && after <= before * (1.0 + HIDDEN);
                if after <= before - ARMIJO * t * decrease || is_hidden {
                    let flat = &candidate[..self.vertices];
                    let is_apart = |x| if starts_clear { self.is_clear(x) } else { self.is_simple(x) };
                    if !descent.is_guarded || is_apart(flat) {
                        found = Some(candidate);
                        break;
                    }
                    crosses = true;
                }
                t *= 0.5;
            }
            has_scaffold |= crosses;
            if crosses || of_scaffold < 1.0 {
                guard = None;
            }
            let Some(mut candidate) = found else { break };
            candidate.truncate(self.vertices);
            x = candidate;
            energy = self.faces.value(&x);
            last = began.elapsed();
            let is_least = decrease <= descent.tolerance * (energy - 4.0);
            if (is_least && !crosses) || decrease <= f64::EPSILON * f64::EPSILON {
                break;
            }
        }
        Ok(Minimization { uv: x, energy, steps, factor })
    }

    /// The Newton step of the disk with its scaffold, and the predicted decrease.
    fn newton_step(
        &self,
        system: &System,
        around: &Elements,
        places: &[Vec2],
    ) -> Result<(Vec<f64>, f64), SolveError> {
        let n = self.vertices;
        let mut locals = self.faces.derivatives(places);
        locals.extend(around.derivatives(places));
        let mut gradient = vec![0.0; 2 * n];
        let corners = self.faces.corners.iter().chain(&around.corners);
        for (corners, local) in corners.zip(&locals) {
            for (i, &v) in corners.iter().enumerate().filter(|(_, v)| (**v as usize) < n) {
                for k in 0..2 {
                    gradient[2 * v as usize + k] += local.gradient[2 * i + k];
                }
            }
        }
        system.step(&locals, &gradient)
    }
}
