//! Why a coupling cannot start or continue.

use crate::{AddedMass, Refusal};
use pompeiu_solve::SolveError;

/// Why two solvers cannot be coupled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CouplingError {
    /// A parameter is invalid.
    #[error("the {what} is {value}; it must be finite and {expected}")]
    Parameter {
        /// Its kind.
        what: &'static str,
        /// Its value.
        value: f64,
        /// What it should be.
        expected: &'static str,
    },
    /// The numbers of outputs of one solver and inputs of the other differ.
    #[error("the {what} has {found} values, expected {expected}")]
    Length {
        /// The data concerned.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// The interface has too many values for the dense matrix of the scheme.
    #[error(
        "the interface has {found} values; iqn-imvj keeps a dense matrix and takes {most} at most; choose iqn-ils"
    )]
    TooLarge {
        /// How many there are.
        found: usize,
        /// The largest number.
        most: usize,
    },
    /// The iteration did not converge.
    #[error("{}", not_converged(*.window, *.solves, *.change, *.tolerance, .added_mass.as_ref(), .refusal.as_ref()))]
    NotConverged {
        /// Number of the window, from 1.
        window: usize,
        /// Number of solves.
        solves: usize,
        /// The smallest relative change of the interface.
        change: f64,
        /// The requested change.
        tolerance: f64,
        /// The added-mass number, if there were enough solves to estimate it.
        added_mass: Option<AddedMass>,
        /// The last refusal of a solver, if any.
        refusal: Option<Refusal>,
    },
    /// An enclosed region whose walls do not conserve its volume.
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
    /// For no pressure constant does the displacement of the solid equal the inflow.
    #[error(
        "window {window}: no constant of the pressure lets the solid take in what flows into the enclosed fluid; \
         {net:e} of ∮u·n is left"
    )]
    ClosedUnsolved {
        /// Number of the window, from 1.
        window: usize,
        /// The remaining imbalance.
        net: f64,
    },
    /// A monolithic reference solution did not converge.
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
