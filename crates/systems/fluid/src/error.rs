//! Why a simulation cannot start or go on.

use pompeiu_operators::OperatorError;
use pompeiu_solve::SolveError;

/// Why a fluid cannot be simulated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FluidError {
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
    /// There are too many or too few values.
    #[error("the {what} has {found} values, expected {expected}, one for each {element}")]
    Length {
        /// What has them.
        what: &'static str,
        /// `"vertex"`, `"face"`, `"edge"` or `"cell"`.
        element: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A value is NaN or infinite.
    #[error("the {what} is {value} at {element} {index}, expected a finite number")]
    NonFinite {
        /// What it is.
        what: &'static str,
        /// `"vertex"`, `"face"`, `"edge"` or `"cell"`.
        element: &'static str,
        /// The element.
        index: usize,
        /// The value.
        value: f64,
    },
    /// More flows into a component than out of it, or less.
    #[error(
        "{into} flows into component {component} and {out} out of it per time; as much must flow out as in"
    )]
    Imbalance {
        /// The component, from 0.
        component: usize,
        /// What flows in.
        into: f64,
        /// What flows out.
        out: f64,
    },
    /// Weights for faces where nothing is stored on faces.
    #[error(
        "diffusion by edge-length is for what is stored on faces; choose the scheme faces, the transport faces, or both"
    )]
    EdgeLength,
    /// There are more harmonic coefficients than fields, or fewer.
    #[error("found {found} harmonic coefficients; this surface has {expected} harmonic fields")]
    Harmonic {
        /// How many there are.
        found: usize,
        /// How many fields there are.
        expected: usize,
    },
    /// A step is too long for substeps.
    #[error(
        "step {step} of length {length:e} has the Courant number {cfl:.3e} and would take {substeps:.3e} substeps, more than {most}; \
         choose a shorter step, or the scheme any-step"
    )]
    StepTooLong {
        /// Number of the step, from 1.
        step: usize,
        /// Its length in time.
        length: f64,
        /// The Courant number of dual cells.
        cfl: f64,
        /// How many substeps it would take.
        substeps: f64,
        /// How many there may be.
        most: usize,
    },
    /// A step that is chosen would have to be too short.
    #[error(
        "step {step} would have to be shorter than {shortest:e} to keep the Courant number; the flow is too fast for it"
    )]
    StepTooShort {
        /// Number of the step, from 1.
        step: usize,
        /// The shortest step that is tried.
        shortest: f64,
    },
    /// The implicit midpoint rule was not solved.
    #[error(
        "step {step}: the implicit midpoint rule was not solved, its residual is {residual:e} of the solution"
    )]
    Midpoint {
        /// Number of the step, from 1.
        step: usize,
        /// The residual relative to the solution.
        residual: f64,
    },
    /// Velocities left the range of doubles.
    #[error(
        "step {step}: the velocity is no longer finite; the flow was at most {speed:e} fast before; choose a shorter step"
    )]
    BlewUp {
        /// Number of the step, from 1.
        step: usize,
        /// The greatest speed before.
        speed: f64,
    },
    /// The viscous system is not positive definite.
    #[error(
        "the viscous system cannot be factored: viscosity times step is {product:e}; choose a smaller viscosity or a shorter step"
    )]
    Viscous {
        /// Viscosity times the length of the step.
        product: f64,
    },
    /// A grid of too few or too many cells.
    #[error("the square has {found} cells on a side; expected 2 to {most}")]
    Cells {
        /// How many there are.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// Stam's grid has walls or is periodic, and nothing else.
    #[error("Stam's grid has neither obstacles nor a lid nor a channel; choose the scheme mac")]
    StamHasNone,
    /// An operator of the surface failed, or a field has no finite vector for each face.
    #[error(transparent)]
    Operator(#[from] OperatorError),
    /// A linear system failed.
    #[error(transparent)]
    Solve(#[from] SolveError),
}
