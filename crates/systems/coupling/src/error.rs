//! Why a coupling cannot start or go on.

use crate::{AddedMass, Refusal};
use pompeiu_solve::SolveError;

/// Why two solvers are not coupled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CouplingError {
    /// A number makes no sense.
    #[error("the {what} is {value}; it must be finite and {expected}")]
    Parameter {
        /// What it is.
        what: &'static str,
        /// Its value.
        value: f64,
        /// What it should be.
        expected: &'static str,
    },
    /// What one gives is not what the other takes.
    #[error("the {what} has {found} values, expected {expected}")]
    Length {
        /// What has them.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// There are more values at the interface than the scheme can keep a dense matrix for.
    #[error(
        "the interface has {found} values; iqn-imvj keeps a dense matrix and takes {most} at most; choose iqn-ils"
    )]
    TooLarge {
        /// How many there are.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// The solvers did not agree.
    #[error("{}", not_converged(*.window, *.solves, *.change, *.tolerance, .added_mass.as_ref(), .refusal.as_ref()))]
    NotConverged {
        /// Number of the window, from 1.
        window: usize,
        /// Solves that were spent on it.
        solves: usize,
        /// The least relative change of the interface that was reached.
        change: f64,
        /// The change that was asked for.
        tolerance: f64,
        /// What the solves say about plain iteration, where there were enough.
        added_mass: Option<AddedMass>,
        /// What a solver said last, if one refused.
        refusal: Option<Refusal>,
    },
    /// An enclosed region whose walls do not keep its volume.
    #[error(
        "window {window}: the fluid is enclosed and -∮u·n is {net:e}, must be 0: as much must flow in as out, and the pressure is known \
         up to a constant only; let the coupling choose the constant (closed: project), or free the pressure on one side"
    )]
    Closed {
        /// Number of the window, from 1.
        window: usize,
        /// Inflow minus outflow.
        net: f64,
    },
    /// No constant of the pressure lets the solid take in what flows in.
    #[error(
        "window {window}: no constant of the pressure lets the solid take in what flows into the enclosed fluid; \
         {net:e} of ∮u·n is left"
    )]
    ClosedUnsolved {
        /// Number of the window, from 1.
        window: usize,
        /// What is left.
        net: f64,
    },
    /// A reference that is solved at once did not converge.
    #[error("window {window}: Newton's method for both solvers at once did not converge")]
    Monolithic {
        /// Number of the window, from 1.
        window: usize,
    },
    /// A linear system failed.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

fn not_converged(
    window: usize,
    solves: usize,
    change: f64,
    tolerance: f64,
    added_mass: Option<&AddedMass>,
    refusal: Option<&Refusal>,
) -> String {
    let mut text = format!(
        "window {window}: the solvers do not agree after {solves} solves; the interface still changes by {change:.1e} of itself, \
         asked for {tolerance:.1e}"
    );
    if let Some(refusal) = refusal {
        text.push_str("; a solver said: ");
        text.push_str(&refusal.reason);
    }
    if let Some(added_mass) = added_mass {
        text.push_str("; ");
        text.push_str(&added_mass.to_string());
    }
    text
}
