//! How far apart all pairs of meshes are.

use crate::matrix::{Matrix, MatrixOptions, Task, measure};
use crate::{Meshes, TaskObserver, Unusable};
use pompeiu_core::request::{Conclusion, Limit, Report, Request};
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_hausdorff::{OptionError, Tolerance, ToleranceKind};
use serde::{Deserialize, Serialize};

#[cfg(feature = "clap")]
use pompeiu_core::request::values::magnitude;

/// Enclose the distances between all pairs of meshes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct MatrixRequest {
    /// Give both directed distances of each pair instead of the greater one.
    #[cfg_attr(feature = "clap", arg(long))]
    pub directed: bool,
    /// Largest width of the proven intervals.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_parser = magnitude, allow_negative_numbers = true, value_name = "X")
    )]
    pub tolerance: f64,
    /// The unit of the tolerance.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub tolerance_kind: ToleranceKind,
}

impl Default for MatrixRequest {
    fn default() -> Self {
        Self {
            directed: false,
            tolerance: Tolerance::DEFAULT_FRACTION,
            tolerance_kind: ToleranceKind::default(),
        }
    }
}

impl Request for MatrixRequest {
    const NAME: &'static str = "matrix";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time, Limit::Memory];
    type Report = MatrixReport;
}

/// Bounds on the distances of all pairs of meshes. Lengths are in the unit of the meshes.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MatrixReport {
    /// The names of the meshes, in the order of rows and columns: paths of files.
    pub meshes: Vec<String>,
    /// Lower ends, of H(i, j), or of h(i, j) where directed distances were asked for; null where one of the two cannot be used, or
    /// was not measured.
    pub lower: Vec<Vec<Option<f64>>>,
    /// Upper ends; null as above.
    pub upper: Vec<Vec<Option<f64>>>,
    /// The reason for which the run ended: `tolerance` unless pairs are open.
    pub stop: StopReason,
    /// Directed distances that were not measured, or less narrowly than asked, by rows and columns.
    pub open: Vec<Task>,
    /// The inputs that cannot be used, and the reasons.
    pub failed: Vec<Unusable>,
    /// Point–triangle distances evaluated.
    pub distances: u64,
}

impl Report for MatrixReport {
    fn stop(&self) -> StopReason {
        self.stop
    }

    /// A pair that is open, or a mesh that cannot be used, leaves the matrix incomplete.
    fn conclusion(&self) -> Conclusion {
        if self.open.is_empty() && self.failed.is_empty() {
            Conclusion::AsAsked
        } else {
            Conclusion::Incomplete
        }
    }
}

/// Why there is no matrix.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MatrixRequestError {
    /// The tolerance cannot be used.
    #[error(transparent)]
    Option(#[from] OptionError),
    /// No mesh can be used.
    #[error("none of the {count} meshes can be used; the first: {first}")]
    NoneUsable {
        /// Number of meshes.
        count: usize,
        /// What is wrong with the first of them.
        first: String,
    },
}

impl MatrixRequest {
    /// The width of each enclosure.
    pub const fn tolerance(&self) -> Tolerance {
        self.tolerance_kind.of(self.tolerance)
    }

    /// Measures all pairs. The matrix has both directed distances, whatever was asked.
    ///
    /// # Errors
    /// [`MatrixRequestError`].
    pub fn run<M: Meshes>(
        &self,
        meshes: &M,
        context: &RunContext<'_>,
        observer: Option<&dyn TaskObserver>,
    ) -> Result<(MatrixReport, Matrix), MatrixRequestError> {
        let options = MatrixOptions { tolerance: self.tolerance(), limits: context.limits(), observer };
        let matrix = measure(meshes, &options)?;
        let names = (0..meshes.count()).map(|index| meshes.name(index)).collect();
        let failures: Vec<Option<String>> = (0..meshes.count()).map(|index| meshes.failure(index)).collect();
        if let (Some(Some(first)), true) = (failures.first(), failures.iter().all(Option::is_some)) {
            let (count, first) = (failures.len(), first.clone());
            return Err(MatrixRequestError::NoneUsable { count, first });
        }
        Ok((self.report(&matrix, names, &failures), matrix))
    }

    /// What is known of a matrix of meshes with these names, some of which cannot be used.
    pub fn report(&self, matrix: &Matrix, names: Vec<String>, failures: &[Option<String>]) -> MatrixReport {
        let is_usable = |index: usize| !failures.get(index).is_some_and(Option::is_some);
        let bounds = |i: usize, j: usize| {
            let known = if self.directed { matrix.directed(i, j) } else { matrix.symmetric(i, j) };
            known.filter(|_| is_usable(i))
        };
        let square = |end: usize| {
            let row = |i| (0..matrix.count()).map(|j| bounds(i, j).map(|ends| ends[end])).collect();
            (0..matrix.count()).map(row).collect()
        };
        let failed = names
            .iter()
            .zip(failures)
            .filter_map(|(path, message)| Some(Unusable { path: path.clone(), message: message.clone()? }));
        MatrixReport {
            failed: failed.collect(),
            meshes: names,
            lower: square(0),
            upper: square(1),
            stop: matrix.stop_reason(),
            open: matrix.open().filter(|task| is_usable(task.from) && is_usable(task.to)).collect(),
            distances: matrix.distances(),
        }
    }
}
