//! Maps with a free boundary: the least symmetric Dirichlet energy without flips and without overlaps.

use super::energy::{Elements, Local, moved};
use super::scaffold::Scaffold;
use crate::FlattenError;
use crate::check::{outline, outline_crossings};
use crate::watch::Watch;
use pompeiu_solve::{
    Analysis, Cholesky, ElementPattern, FIXED, LinearSolver, Ordering, SolveError, SparseMatrix,
};
use pompeiu_surface::EmbeddedSurface;
use pompeiu_surface::plane::Vec2;
use std::time::{Duration, Instant};

/// When a descent stops.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Descent {
    /// Most steps.
    pub(crate) steps: usize,
    /// The decrease that a Newton step promises, over the distortion, below which the energy counts as least.
    pub(crate) tolerance: f64,
    /// An energy at which the descent stops.
    pub(crate) enough: f64,
}

/// Where a descent ended.
#[derive(Clone, Debug)]
pub(crate) struct Minimization {
    pub(crate) uv: Vec<Vec2>,
    pub(crate) energy: f64,
    pub(crate) steps: usize,
    pub(crate) factor: Duration,
}

/// Share of the way to the first flip that a step may go.
const SAFE: f64 = 0.9;

/// Share of the promised decrease that a step must keep (Armijo).
const ARMIJO: f64 = 1e-4;

/// Weight of the scaffold over that of the surface, for each unit of mean distortion.
const SCAFFOLD: f64 = 0.05 / 4.0;

/// A decrease that rounding hides, over the energy.
const HIDDEN: f64 = 1e-13;

/// What is added to the diagonal of a Hessian, over its mean: moving and turning everything costs nothing otherwise.
const PROXIMAL: f64 = 1e-10;

/// Steps that a scaffold serves before what lies between outline and box is triangulated anew, unless it stands in the way.
const KEEP: usize = 4;

/// A system whose pattern is kept while the triangles are the same.
struct System {
    pattern: ElementPattern<6>,
    order: Vec<usize>,
    analysis: Option<Analysis>,
}

impl System {
    fn new(vertices: usize, groups: &[&[[u32; 3]]]) -> Result<Self, SolveError> {
        let unknown = |v: u32| if (v as usize) < vertices { [2 * v, 2 * v + 1] } else { [FIXED; 2] };
        let elements: Vec<[u32; 6]> = groups
            .iter()
            .flat_map(|group| group.iter())
            .map(|corners| {
                let [[a, b], [c, d], [e, f]] = corners.map(unknown);
                [a, b, c, d, e, f]
            })
            .collect();
        // The order for one unknown at each vertex serves both of its coordinates.
        let at_vertices: Vec<[u32; 3]> = groups
            .iter()
            .flat_map(|group| group.iter())
            .map(|corners| corners.map(|v| if (v as usize) < vertices { v } else { FIXED }))
            .collect();
        let scalar =
            ElementPattern::new(vertices, &at_vertices)?.assemble(&vec![0.0; vertices], |_| [[0.0; 3]; 3])?;
        let scalar = Analysis::new(&scalar, &Ordering::MinimumDegree)?;
        let order = scalar.order().into_iter().flat_map(|v| [2 * v, 2 * v + 1]).collect();
        Ok(Self { pattern: ElementPattern::new(2 * vertices, &elements)?, order, analysis: None })
    }

    /// The Newton step for these derivatives, and the decrease that it promises.
    fn step(&mut self, locals: &[Local], gradient: &[f64]) -> Result<(Vec<f64>, f64), SolveError> {
        let n = gradient.len();
        let mut diagonal = 0.0;
        for local in locals {
            diagonal += (0..6).map(|i| local.hessian[i][i]).sum::<f64>();
        }
        let mut extra = PROXIMAL * diagonal / n as f64;
        loop {
            let matrix: SparseMatrix = self.pattern.assemble(&vec![extra; n], |m| locals[m].hessian)?;
            let analysis = match &self.analysis {
                Some(analysis) => analysis,
                None => self.analysis.insert(Analysis::new(&matrix, &Ordering::Given(self.order.clone()))?),
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

/// Descends from a map without flips and overlaps to one of less symmetric Dirichlet energy, by projected Newton steps that never
/// flip a face. As soon as a step would make the outline cross itself, the descent goes on with a scaffold around the disk.
///
/// # Definition
/// The mean over the area of σ1² + σ2² + σ1⁻² + σ2⁻², and with a scaffold the same for its triangles, measured from the shape that
/// each has before the step, by a small weight.
///
/// # Source
/// `smith_bijective_2015` for the energy and the longest step, `jiang_simplicial_2017` for the scaffold.
pub(crate) fn minimize(
    surface: &EmbeddedSurface,
    start: Vec<Vec2>,
    descent: &Descent,
    watch: &Watch<'_>,
) -> Result<Minimization, FlattenError> {
    let mesh = surface.mesh();
    let n = mesh.vertices();
    let outline = outline(mesh);
    let faces = Elements::of_surface(surface.surface());
    let mut plain: Option<System> = None;
    let mut around: Option<(Scaffold, System, usize)> = None;
    let mut is_guarded = false;
    let mut x = start;
    let mut energy = faces.value(&x);
    let (mut steps, mut factor) = (0, Duration::ZERO);
    while steps < descent.steps && energy > descent.enough && !watch.is_stopped() {
        steps += 1;
        let began = Instant::now();
        let mut scaffold_elements = Elements::default();
        let mut places = x.clone();
        if is_guarded {
            let is_worn = around.as_ref().is_none_or(|(_, _, age)| *age >= KEEP);
            if is_worn {
                let Some(scaffold) = Scaffold::around(&outline, &x) else { break };
                let system = System::new(n, &[&faces.corners, &scaffold.triangles])?;
                around = Some((scaffold, system, 0));
            }
            if let Some((scaffold, _, age)) = &mut around {
                *age += 1;
                places.extend(&scaffold.on_box);
                let weight = SCAFFOLD * (energy - 4.0).max(0.0);
                scaffold_elements = Elements::of_triangles(&scaffold.triangles, &places, weight);
            }
        }
        let mut locals = faces.derivatives(&places);
        locals.extend(scaffold_elements.derivatives(&places));
        let gradient = gradient(n, &[&faces, &scaffold_elements], &locals);
        let system = match &mut around {
            Some((_, system, _)) if is_guarded => system,
            _ => match &mut plain {
                Some(system) => system,
                None => plain.insert(System::new(n, &[&faces.corners])?),
            },
        };
        let (step, decrease) = system.step(&locals, &gradient)?;
        factor += began.elapsed();
        let mut direction: Vec<Vec2> = step.chunks_exact(2).map(|d| [d[0], d[1]]).collect();
        direction.resize(places.len(), [0.0; 2]);
        let of_scaffold = scaffold_elements.longest_step(&places, &direction);
        let longest = SAFE * faces.longest_step(&places, &direction).min(of_scaffold);
        let total = |p: &[Vec2]| faces.value(p) + scaffold_elements.value(p);
        let before = total(&places);
        let mut t = if longest < 1.0 { longest } else { 1.0 };
        let mut found = None;
        for _ in 0..40 {
            let candidate = moved(&places, t, &direction);
            let after = total(&candidate);
            let is_hidden = decrease <= HIDDEN * before && after <= before * (1.0 + HIDDEN);
            if after <= before - ARMIJO * t * decrease || is_hidden {
                found = Some(candidate);
                break;
            }
            t *= 0.5;
        }
        let Some(mut candidate) = found else { break };
        candidate.truncate(n);
        if !outline_crossings(&outline, &candidate).is_empty() {
            if is_guarded && around.as_ref().is_some_and(|(_, _, age)| *age == 1) {
                // A scaffold that is new has been passed by rounding.
                break;
            }
            (is_guarded, around) = (true, None);
            continue;
        }
        if of_scaffold < 1.0 {
            around = None;
        }
        x = candidate;
        energy = faces.value(&x);
        if decrease <= descent.tolerance * (energy - 4.0) || decrease <= f64::EPSILON * f64::EPSILON {
            break;
        }
    }
    Ok(Minimization { uv: x, energy, steps, factor })
}

fn gradient(n: usize, groups: &[&Elements], locals: &[Local]) -> Vec<f64> {
    let mut gradient = vec![0.0; 2 * n];
    let corners = groups.iter().flat_map(|group| &group.corners);
    for (corners, local) in corners.zip(locals) {
        for (i, &v) in corners.iter().enumerate().filter(|(_, v)| (**v as usize) < n) {
            for k in 0..2 {
                gradient[2 * v as usize + k] += local.gradient[2 * i + k];
            }
        }
    }
    gradient
}
