//! What a solver must offer to be coupled.

/// Why a solver gives no answer for an input: a sentence for a person.
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

/// What flows into an enclosed region whose pressure is known up to a constant only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Imbalance {
    /// `−∮ u·n`, inflow minus outflow per time. An incompressible fluid needs it to be zero.
    pub net: f64,
    /// `∮ |u·n|`, by which `net` is judged.
    pub gross: f64,
}

/// A solver for one window in time, as the coupling sees it: data of the interface in, data of the interface out.
///
/// Every [`solve`](Self::solve) starts from the state of the last [`accept`](Self::accept), however many solves there were since.
pub trait Subproblem {
    /// Number of values that it takes.
    fn inputs(&self) -> usize;

    /// Number of values that it gives.
    fn outputs(&self) -> usize;

    /// Solves the window for an input.
    ///
    /// # Errors
    /// [`Refusal`] where the input has no answer, an inverted element for instance: the coupling then tries a shorter way.
    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), Refusal>;

    /// Makes the last solve the beginning of the next window.
    fn accept(&mut self);

    /// Forgets the solves since the last accepted one.
    fn reject(&mut self) {}

    /// What flows in for an input, where nothing else fixes the constant of the pressure; none where something does.
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

/// A function of its input without a state, as a solver.
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
    /// A function of so many values with so many values.
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
