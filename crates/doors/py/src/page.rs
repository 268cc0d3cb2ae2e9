//! Pages of runs, made when somebody asks for them.

use crate::errors::Raise;
use pompeiu::figures::page::PageError;
use pyo3::prelude::*;

/// Makes a page of what a run left.
type Make = Box<dyn Fn() -> Result<String, PageError> + Send + Sync>;

/// The page of a run.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct RunPage(Make);

impl RunPage {
    pub(crate) fn new(make: impl Fn() -> Result<String, PageError> + Send + Sync + 'static) -> Self {
        Self(Box::new(make))
    }
}

#[pymethods]
impl RunPage {
    /// The page as an HTML file.
    fn html(&self, py: Python<'_>) -> PyResult<String> {
        py.detach(|| (self.0)()).map_err(Raise::raise)
    }
}
