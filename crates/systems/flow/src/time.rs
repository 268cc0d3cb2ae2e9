//! Steps in time, and how long they should be.

use super::gradient::Derivatives;
use super::moving::{Motion, MovingSurface};
use super::options::{FlowOptions, Until};
use super::scheme::Scheme;
use super::step::{self, FirstMetric, keeps_faces, moved};
use super::systems::Systems;
use glam::DVec3;
use pompeiu_solve::SolveError;

/// By how much a whole step and two halves may differ at a vertex, as a part of its radius of curvature.
const LOCAL_ERROR: f64 = 3e-4;
/// The first step, as a part of the area.
const FIRST: f64 = 1e-3;
/// The error makes no step shorter than this part of the area: where faces are rough, one vertex would stop all others.
const LEAST_BY_ERROR: f64 = 1e-6;
/// How much longer a step may be than the one before.
const GROWTH: f64 = 1.5;
/// Room between the error expected and that allowed.
const SAFETY: f64 = 0.8;
/// Steps shorter than this part of the area are no progress: the triangles are too bad.
const SHORTEST: f64 = 1e-8;
/// Tries of a step, each half as long as the one before.
const TRIES: usize = 40;
/// Steps to a stationary surface of kept volume, as a part of the area.
const OF_AREA: f64 = 0.05;

/// How long steps are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TimeStep {
    /// The next one.
    next: f64,
    /// The next gradient step.
    descent: f64,
    /// No step is longer.
    longest: f64,
    /// Whether the error decides.
    adaptive: bool,
    extrapolate: bool,
}

impl TimeStep {
    pub(crate) fn new(options: &FlowOptions<'_>, surface: &MovingSurface, area: f64) -> Self {
        let held = surface.motion.contains(&Motion::Fixed);
        let scheme = options.scheme();
        let to_the_end = !matches!(options.until, Until::Time(_)) && scheme != Scheme::Explicit;
        let (next, adaptive) = match options.time_step {
            Some(step) => (step, false),
            None if to_the_end && options.keep_volume => (OF_AREA * area, false),
            None if to_the_end && held => (f64::INFINITY, false),
            None => (FIRST * area, true),
        };
        let extrapolate = options.extrapolate && scheme == Scheme::Implicit && !options.keep_volume;
        let longest = options.time_step.unwrap_or(f64::INFINITY);
        let descent = if longest.is_finite() { longest } else { FIRST * area };
        Self { next, descent, longest, adaptive, extrapolate }
    }

    /// How long a gradient step may be.
    pub(crate) fn explicit(&self, left: f64) -> f64 {
        self.descent.min(left)
    }

    pub(crate) fn accept_explicit(&mut self, by: f64) {
        self.descent = (2.0 * by).min(self.longest);
    }

    /// Positions after a step of an implicit scheme, and its length; none if even a short one raises the area.
    pub(crate) fn advance(
        &mut self,
        surface: &mut MovingSurface,
        derivatives: &Derivatives,
        systems: &mut Systems,
        first: Option<(&FirstMetric, bool)>,
        left: f64,
    ) -> Result<Option<(Vec<DVec3>, f64)>, SolveError> {
        let mut by = self.next.min(left);
        let least_by_error = LEAST_BY_ERROR * derivatives.area;
        for _ in 0..TRIES {
            if self.adaptive && by < SHORTEST * derivatives.area && by < left {
                return Ok(None);
            }
            let shorter = if by.is_finite() { 0.5 * by } else { FIRST * derivatives.area };
            let Some((to, error)) = self.attempt(surface, derivatives, systems, first, by)? else {
                by = shorter;
                continue;
            };
            // Schemes with the metric of the first surface minimise something else.
            let falls =
                first.is_some() || surface.area_at(&to) <= derivatives.area * (1.0 + 4.0 * f64::EPSILON);
            if !falls {
                by = shorter;
            } else if self.adaptive && error > LOCAL_ERROR && by > least_by_error {
                let shorter = by * (SAFETY * (LOCAL_ERROR / error).sqrt()).clamp(0.1, 0.9);
                by = shorter.max(least_by_error);
            } else {
                if self.adaptive {
                    let growth = SAFETY * (LOCAL_ERROR / error).sqrt();
                    let next = by * if growth < GROWTH { growth } else { GROWTH };
                    self.next = next.max(least_by_error);
                }
                return Ok(Some((to, by)));
            }
        }
        Ok(None)
    }

    /// Positions after a step, and its error; none if a face would turn over on the way.
    fn attempt(
        &self,
        surface: &mut MovingSurface,
        derivatives: &Derivatives,
        systems: &mut Systems,
        first: Option<(&FirstMetric, bool)>,
        by: f64,
    ) -> Result<Option<(Vec<DVec3>, f64)>, SolveError> {
        let whole = moved(surface, &step::implicit(surface, derivatives, systems, 1.0 / by, first)?, 1.0);
        if !(self.adaptive || self.extrapolate) {
            return Ok(Some((whole, 0.0)));
        }
        let mut half = moved(surface, &step::implicit(surface, derivatives, systems, 2.0 / by, first)?, 1.0);
        // The surface stands there for the second half.
        half.swap_with_slice(surface.mesh.positions_mut());
        let there = Derivatives::of(surface, derivatives.pressure.is_some());
        let second = step::implicit(surface, &there, systems, 2.0 / by, first);
        half.swap_with_slice(surface.mesh.positions_mut());
        let to: Vec<DVec3> = half.iter().zip(second?).map(|(p, step)| *p + step).collect();
        let mut error = 0.0;
        for (v, (p, q)) in whole.iter().zip(&to).enumerate() {
            let curvature = derivatives.gradient[v].length() / derivatives.masses[v];
            let here = p.distance(*q) * curvature;
            if here > error {
                error = here;
            }
        }
        let to = if self.extrapolate {
            to.iter().zip(&whole).map(|(two, one)| 2.0 * *two - *one).collect()
        } else {
            to
        };
        Ok((first.is_some() || keeps_faces(surface, derivatives, &to)).then_some((to, error)))
    }
}
