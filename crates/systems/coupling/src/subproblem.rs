//! The interface that a solver must implement to be coupled.

/// Why a solver has no solution for an input: a sentence for users.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{reason}")]
pub struct Refusal {
    /// The sentence, without a full stop.
    pub reason: String,
}

impl Refusal {
    /// A refusal for a reason.
    pub fn new(reason: impl Into<String>) -> Self {
        Self { reason: reason.into() }
    }
}

/// The net inflow of an enclosed region whose pressure is determined only up to a constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Imbalance {
    /// `−∮ u·n`, inflow minus outflow per time. An incompressible fluid requires zero.
    pub net: f64,
    /// `∮ |u·n|`, the scale for `net`.
    pub gross: f64,
}

/// A solver for one time window as a map of interface data to interface data.
///
/// Every [`solve`](Self::solve) starts from the state of the last [`accept`](Self::accept), however many solves there were since.
pub trait Subproblem {
    /// Number of input values.
    fn inputs(&self) -> usize;

    /// Number of output values.
    fn outputs(&self) -> usize;

    /// Solves the window for an input.
    ///
    /// # Errors
    /// [`Refusal`] if the input has no solution, for instance due to an inverted element: the coupling then tries a smaller change.
    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), Refusal>;

    /// Makes the result of the last solve the initial state of the next window.
    fn accept(&mut self);

    /// Discards the solves since the last accepted one.
    fn reject(&mut self) {}

    /// The inflow for an input, if nothing else determines the pressure constant; otherwise none.
    fn imbalance(&self, _input: &[f64]) -> Option<Imbalance> {
        None
    }
}

impl<T: Subproblem + ?Sized> Subproblem for Box<T> {
    fn inputs(&self) -> usize {
        (**self).inputs()
    }

    fn outputs(&self) -> usize {
        (**self).outputs()
    }

    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), Refusal> {
        (**self).solve(input, output)
    }

    fn accept(&mut self) {
        (**self).accept();
    }

    fn reject(&mut self) {
        (**self).reject();
    }

    fn imbalance(&self, input: &[f64]) -> Option<Imbalance> {
        (**self).imbalance(input)
    }
}

/// A stateless function as a solver.
///
/// # Example
/// ```
/// use pompeiu_coupling::{Function, Subproblem};
///
/// let mut half = Function::new(1, 1, |x: &[f64], y: &mut [f64]| {
///     y[0] = 0.5 * x[0];
///     Ok(())
/// });
/// let mut y = [0.0];
/// half.solve(&[3.0], &mut y)?;
/// assert_eq!(y, [1.5]);
/// # Ok::<(), pompeiu_coupling::Refusal>(())
/// ```
#[derive(Debug)]
pub struct Function<G> {
    inputs: usize,
    outputs: usize,
    call: G,
}

impl<G: FnMut(&[f64], &mut [f64]) -> Result<(), Refusal>> Function<G> {
    /// A function with these numbers of inputs and outputs.
    pub fn new(inputs: usize, outputs: usize, function: G) -> Self {
        Self { inputs, outputs, call: function }
    }
}

impl<G: FnMut(&[f64], &mut [f64]) -> Result<(), Refusal>> Subproblem for Function<G> {
    fn inputs(&self) -> usize {
        self.inputs
    }

    fn outputs(&self) -> usize {
        self.outputs
    }

    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), Refusal> {
        (self.call)(input, output)
    }

    fn accept(&mut self) {}
}
