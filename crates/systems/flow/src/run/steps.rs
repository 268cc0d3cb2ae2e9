//! Which step comes next.

use super::{Done, Outcome, Runner};
use crate::FlowError;
use crate::gradient::Derivatives;
use crate::moving::Motion;
use crate::report::StepReason;
use crate::scheme::Scheme;
use crate::step::{self, FullSystem, MOST_HALVINGS};
use crate::systems::{Systems, prepared};

/// Implicit steps that may smooth the surface before Newton's method is blended.
const SMOOTHINGS: usize = 3;
/// Blended Newton steps before the surface flows in time, where no minimal surface is known to exist.
const BLENDED_STEPS: usize = 3;
/// A step that moves no vertex by more than this part of the square root of the area is none.
const LEAST_MOVE: f64 = 1e-15;

impl Runner<'_> {
    /// The next step, as the scheme has it or as it must be.
    pub(super) fn step(&mut self, derivatives: &Derivatives) -> Result<Outcome, FlowError> {
        let no_minimal_surface = self.cone.is_some() && self.blended >= BLENDED_STEPS;
        match self.scheme {
            Scheme::NormalNewton if no_minimal_surface => {
                self.in_time(derivatives, Scheme::Implicit, StepReason::NoMinimalSurface)
            }
            Scheme::NormalNewton => self.normal_newton(derivatives),
            Scheme::Newton | Scheme::NewtonOrGradient => self.newton(derivatives),
            scheme => self.in_time(derivatives, scheme, StepReason::Scheme),
        }
    }

    /// A step with a length in time.
    fn in_time(
        &mut self,
        derivatives: &Derivatives,
        scheme: Scheme,
        reason: StepReason,
    ) -> Result<Outcome, FlowError> {
        if scheme == Scheme::Explicit {
            return Ok(self.explicit(derivatives, reason));
        }
        let left = self.time_left();
        let first = match scheme {
            Scheme::FixedLaplacian => Some((&self.first, true)),
            Scheme::Conformalized => Some((&self.first, false)),
            _ => None,
        };
        let systems = prepared(&mut self.systems, || Systems::new(&self.surface))?;
        let made = self.time_step.advance(&mut self.surface, derivatives, systems, first, left)?;
        let Some((to, by)) = made else { return Ok(Outcome::Stalled) };
        Ok(self.unless_still(
            derivatives,
            Done { to, time: Some(by).filter(|by| by.is_finite()), scheme, reason },
        ))
    }

    /// Nothing more is to be expected of a scheme that moves no vertex.
    fn unless_still(&self, derivatives: &Derivatives, done: Done) -> Outcome {
        if self.longest_move(&done.to) <= LEAST_MOVE * derivatives.area.sqrt() {
            Outcome::Stalled
        } else {
            Outcome::Moved(done)
        }
    }

    fn explicit(&mut self, derivatives: &Derivatives, reason: StepReason) -> Outcome {
        let down = step::steepest_descent(derivatives);
        let left = self.time_left();
        let longest = self.time_step.explicit(left);
        match step::line_search(&self.surface, derivatives, &down, longest, MOST_HALVINGS) {
            Some((by, to)) => {
                self.time_step.accept_explicit(by);
                self.unless_still(derivatives, Done { to, time: Some(by), scheme: Scheme::Explicit, reason })
            }
            None => Outcome::Stalled,
        }
    }

    fn normal_newton(&mut self, derivatives: &Derivatives) -> Result<Outcome, FlowError> {
        let systems = prepared(&mut self.systems, || Systems::new(&self.surface))?;
        // With a boundary a few implicit steps without mass bring a rough surface near a minimal one.
        let may_smooth = self.smoothings < SMOOTHINGS && self.surface.motion.contains(&Motion::Fixed);
        let found = step::normal_newton(&self.surface, derivatives, systems, !may_smooth)?;
        let searched = found.and_then(|(step, blended)| {
            let (by, to) = step::line_search(&self.surface, derivatives, &step, 1.0, MOST_HALVINGS)?;
            Some((by, to, blended))
        });
        let done = |to, scheme, reason| Outcome::Moved(Done { to, time: None, scheme, reason });
        match searched {
            Some((by, to, blended)) if !may_smooth || by == 1.0 => {
                self.blended += usize::from(blended);
                self.newton_steps += 1;
                let reason = if blended { StepReason::NotDefinite } else { StepReason::Scheme };
                Ok(done(to, Scheme::NormalNewton, reason))
            }
            _ if may_smooth => {
                self.smoothings += 1;
                let step = step::implicit(&self.surface, derivatives, systems, 0.0, None)?;
                Ok(done(step::moved(&self.surface, &step, 1.0), Scheme::Implicit, StepReason::Smoothing))
            }
            _ => Ok(self.explicit(derivatives, StepReason::AreaWouldRise)),
        }
    }

    fn newton(&mut self, derivatives: &Derivatives) -> Result<Outcome, FlowError> {
        let clamp = self.scheme == Scheme::Newton;
        let full = prepared(&mut self.full, || FullSystem::new(&self.surface))?;
        let Some(step) = full.newton(derivatives, clamp)? else {
            return Ok(self.explicit(derivatives, StepReason::NotFactored));
        };
        // The source's rule takes a whole step or none.
        let halvings = if clamp { MOST_HALVINGS } else { 0 };
        match step::line_search(&self.surface, derivatives, &step, 1.0, halvings) {
            Some((_, to)) => {
                let done = Done { to, time: None, scheme: self.scheme, reason: StepReason::Scheme };
                Ok(self.unless_still(derivatives, done))
            }
            None => Ok(self.explicit(derivatives, StepReason::AreaWouldRise)),
        }
    }
}
