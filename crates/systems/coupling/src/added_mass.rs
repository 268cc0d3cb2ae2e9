//! Why fixed-point iteration does not converge, estimated from the solves.

use crate::columns::{Model, Pair};
use std::fmt;

/// The effect of fixed-point iteration between two solvers on the least stable mode of the interface.
///
/// # Definition
/// The composition of both solvers has a Jacobian whose most negative eigenvalue is `−μ`, with μ the added-mass number: the ratio of
/// the inertia of the fluid that a wall moves to that of the wall, in the simplest cases. Relaxed iteration multiplies errors by
/// `1 − ω(1 + μ)`.
/// # Accuracy
/// The eigenvalue is that of the Jacobian restricted to the inputs that were tried (a Ritz value): μ is underestimated until they contain
/// the least stable mode.
/// # Source
/// `causin_added_2005`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AddedMass {
    /// μ; not positive if no eigenvalue is negative.
    pub number: f64,
    /// Relaxed iteration converges for ω below this, as estimated from the solves.
    pub relaxation_below: f64,
}

impl fmt::Display for AddedMass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { number, relaxation_below } = *self;
        if number >= 1.0 {
            write!(
                f,
                "these solvers cannot agree by plain iteration: added-mass number {number:.3}, ω must be below {relaxation_below:.3}"
            )
        } else {
            write!(f, "added-mass number {:.3}: plain iteration converges", number.max(0.0))
        }
    }
}

/// Columns that depend linearly on others up to this share are not used for eigenvalues.
const FILTER: f64 = 1e-3;

impl AddedMass {
    /// From pairs of inputs and outputs of both solvers, applied in sequence; none if there are no pairs.
    pub(crate) fn of<'a>(pairs: impl Iterator<Item = &'a Pair>) -> Option<Self> {
        let model = Model::new(pairs, FILTER);
        if model.is_empty() {
            return None;
        }
        let values = pompeiu_solve::eigenvalues(model.len(), &model.projected()).ok()?;
        let least = values.iter().map(|value| value[0]).fold(f64::INFINITY, |m, x| if x < m { x } else { m });
        least.is_finite().then(|| Self { number: -least, relaxation_below: 2.0 / (1.0 - least).max(1.0) })
    }
}
