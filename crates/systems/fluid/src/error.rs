//! Errors of simulations.

use pompeiu_operators::OperatorError;
use pompeiu_solve::SolveError;

/// Why a fluid cannot be simulated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FluidError {
    /// A parameter is out of range.
    #[error("the {what} is {value}; it must be finite and {expected}")]
    Parameter {
        /// The parameter.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The valid range.
        expected: &'static str,
    },
    /// An array has the wrong length.
    #[error("the {what} has {found} values, expected {expected}, one for each {element}")]
    Length {
        /// The array.
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
        /// The quantity.
        what: &'static str,
        /// `"vertex"`, `"face"`, `"edge"` or `"cell"`.
        element: &'static str,
        /// The element.
        index: usize,
        /// The value.
        value: f64,
    },
    /// Inflow and outflow of a component do not balance.
    #[error(
        "{into} flows into component {component} and {out} out of it per time; as much must flow out as in"
    )]
    Imbalance {
        /// The component, from 0.
        component: usize,
        /// Inflow per time.
        into: f64,
        /// Outflow per time.
        out: f64,
    },
    /// Edge-length diffusion was chosen, but nothing is stored on faces.
    #[error(
        "diffusion by edge-length is for what is stored on faces; choose the scheme faces, the transport faces, or both"
    )]
    EdgeLength,
    /// The number of harmonic coefficients is not that of harmonic fields.
    #[error("found {found} harmonic coefficients; this surface has {expected} harmonic fields")]
    Harmonic {
        /// How many there are.
        found: usize,
        /// How many fields there are.
        expected: usize,
    },
    /// A step needs too many substeps.
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
        /// Number of substeps needed.
        substeps: f64,
        /// Largest number of substeps.
        most: usize,
    },
    /// An adaptive step would be too short.
    #[error(
        "step {step} would have to be shorter than {shortest:e} to keep the Courant number; the flow is too fast for it"
    )]
    StepTooShort {
        /// Number of the step, from 1.
        step: usize,
        /// The shortest step that is tried.
        shortest: f64,
    },
    /// The implicit midpoint rule did not converge.
    #[error(
        "step {step}: the implicit midpoint rule was not solved, its residual is {residual:e} of the solution"
    )]
    Midpoint {
        /// Number of the step, from 1.
        step: usize,
        /// The residual relative to the solution.
        residual: f64,
    },
    /// Velocities are no longer finite.
    #[error(
        "step {step}: the velocity is no longer finite; the flow was at most {speed:e} fast before; choose a shorter step"
    )]
    BlewUp {
        /// Number of the step, from 1.
        step: usize,
        /// The greatest speed before the step.
        speed: f64,
    },
    /// The viscous system is not positive definite.
    #[error(
        "the viscous system of viscosity times step {product:e} and of its parts cannot be factored, because faces are nearly degenerate; \
         even them out with `pompeiu remesh`, or choose the scheme faces with the diffusion edge-length, which needs no angles"
    )]
    Viscous {
        /// Viscosity times the length of the step.
        product: f64,
    },
    /// The number of grid cells is out of range.
    #[error("the square has {found} cells on a side; expected 2 to {most}")]
    Cells {
        /// How many there are.
        found: usize,
        /// Largest number.
        most: usize,
    },
    /// Stam's grid supports only walls or periodic edges.
    #[error("Stam's grid has neither obstacles nor a lid nor a channel; choose the scheme mac")]
    StamHasNone,
    /// An operator of the surface failed, or a field has no finite vector for each face.
    #[error(transparent)]
    Operator(#[from] OperatorError),
    /// A linear system failed.
    #[error(transparent)]
    Solve(#[from] SolveError),
}
