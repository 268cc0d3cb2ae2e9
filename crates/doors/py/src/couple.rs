//! Coupling of two solvers that are functions or objects in Python.

use crate::arrays::{array_of, values};
use crate::ask::{Limited, limits_of};
use crate::errors::Raise;
use crate::json::{parsed, written};
use numpy::{IntoPyArray, PyArray1};
use pompeiu::core::request::{Answer, Timing};
use pompeiu::core::run::{Progress, ProgressObserver, RunContext};
use pompeiu::coupling::{CoupleRequest, CouplingError, Refusal, Subproblem};
use pompeiu::options::request_from;
use pyo3::exceptions::PyArithmeticError;
use pyo3::prelude::*;
use pyo3::types::PyBool;
use std::cell::RefCell;
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The answer as JSON, and the interface data of all windows, one after another.
type Coupled<'py> = (String, Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// A solver: a function, or an object with `solve` and, if it has a state, `accept` and `reject`.
struct Solver<'s, 'py> {
    object: Bound<'py, PyAny>,
    what: &'static str,
    inputs: usize,
    outputs: usize,
    /// The first exception, which ends the run.
    raised: &'s RefCell<Option<PyErr>>,
}

impl Solver<'_, '_> {
    fn call(&self, input: &[f64]) -> PyResult<Vec<f64>> {
        let py = self.object.py();
        py.check_signals()?;
        let input = input.to_vec().into_pyarray(py);
        let found = match self.object.getattr_opt("solve")? {
            Some(solve) => solve.call1((input,))?,
            None => self.object.call1((input,))?,
        };
        values(&found, self.what)
    }

    fn tell(&self, method: &str) {
        let told =
            self.object.getattr_opt(method).and_then(|found| found.map(|method| method.call0()).transpose());
        if let Err(error) = told {
            self.raised.borrow_mut().get_or_insert(error);
        }
    }
}

impl Subproblem for Solver<'_, '_> {
    fn inputs(&self) -> usize {
        self.inputs
    }

    fn outputs(&self) -> usize {
        self.outputs
    }

    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), Refusal> {
        if self.raised.borrow().is_some() {
            return Err(Refusal::new("a solver raised an exception"));
        }
        let error = match self.call(input) {
            Ok(found) if found.len() == output.len() => {
                output.copy_from_slice(&found);
                return Ok(());
            }
            Ok(found) => {
                let (what, found, expected) = (self.what, found.len(), output.len());
                CouplingError::Length { what, found, expected }.raise()
            }
            Err(error) => error,
        };
        let refusal = Refusal::new(error.to_string());
        // An input without a solution: the coupling tries a smaller change.
        if !error.is_instance_of::<PyArithmeticError>(self.object.py()) {
            self.raised.borrow_mut().get_or_insert(error);
        }
        Err(refusal)
    }

    fn accept(&mut self) {
        self.tell("accept");
    }

    fn reject(&mut self) {
        self.tell("reject");
    }
}

/// A callback that is told the share of windows that are done.
struct Told {
    callback: Py<PyAny>,
    raised: Mutex<Option<PyErr>>,
}

impl ProgressObserver for Told {
    fn progress(&self, progress: &Progress<'_>) -> ControlFlow<()> {
        let goes_on = Python::attach(|py| {
            let answer = self.callback.bind(py).call1((progress.share.unwrap_or(0.0),))?;
            Ok(!answer.is(PyBool::new(py, false)))
        });
        match goes_on {
            Ok(true) => ControlFlow::Continue(()),
            Ok(false) => ControlFlow::Break(()),
            Err(error) => {
                self.raised.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
                ControlFlow::Break(())
            }
        }
    }
}

/// Couples two solvers from the interface data x0.
#[pyfunction]
pub(crate) fn couple<'py>(
    py: Python<'py>,
    fluid: Bound<'py, PyAny>,
    solid: Bound<'py, PyAny>,
    x0: &Bound<'py, PyAny>,
    options: &str,
    limits: Limited,
    progress: Option<Py<PyAny>>,
) -> PyResult<Coupled<'py>> {
    let request: CoupleRequest = request_from(parsed(options)?).map_err(Raise::raise)?;
    let limits = limits_of::<CoupleRequest>(limits)?;
    let started = Instant::now();
    let x0 = values(x0, "the first input")?;
    let raised = RefCell::new(None);
    let solver = |object, what, inputs, outputs| Solver { object, what, inputs, outputs, raised: &raised };
    let mut fluid = solver(fluid, "output of the first solver", x0.len(), 0);
    // How many values the first solver gives is seen from a solve, which is then discarded.
    let y0 = fluid.call(&x0)?;
    fluid.tell("reject");
    fluid.outputs = y0.len();
    let solid = solver(solid, "output of the second solver", y0.len(), x0.len());
    let told = progress.map(|callback| Told { callback, raised: Mutex::default() });
    let context = RunContext::start(limits);
    let context = match &told {
        Some(told) => context.watched_by(told),
        None => context,
    };
    let (mut xs, mut ys) = (Vec::new(), Vec::new());
    let mut watch = |_: usize, x: &[f64], y: &[f64]| {
        xs.extend_from_slice(x);
        ys.extend_from_slice(y);
    };
    let found = request.run_pair((fluid, solid), &x0, &mut watch, &context);
    if let Some(error) = raised.take() {
        return Err(error);
    }
    if let Some(error) =
        told.and_then(|told| told.raised.into_inner().unwrap_or_else(PoisonError::into_inner))
    {
        return Err(error);
    }
    let report = found.map_err(Raise::raise)?;
    let timing = Timing { read: Duration::ZERO, total: started.elapsed() };
    let answer = written(&Answer::new(Vec::new(), request, report, timing))?;
    Ok((answer, array_of(py, xs)?, array_of(py, ys)?))
}
