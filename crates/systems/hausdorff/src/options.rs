//! The options of a distance.

use crate::observer::Observer;
use crate::tolerance::{OptionError, Tolerance, check_threshold};
use pompeiu_core::run::Limits;

/// The search method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Method {
    /// Cover, generate and cut.
    #[default]
    Fast,
    /// The textbook branch and bound: a baseline, slow at small tolerances.
    Classic,
}

/// The options of a distance; the default asks for [`Tolerance::DEFAULT_FRACTION`] of the joint diagonal, without limits.
///
/// # Errors
/// Every method that takes a mesh returns the error of [`HausdorffOptions::check`], before it looks at the mesh.
/// # Example
/// ```
/// use pompeiu_core::TriMesh;
/// use pompeiu_hausdorff::{HausdorffOptions, Target, Tolerance};
///
/// let triangle = |z| TriMesh::new(vec![[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]], vec![[0, 1, 2]]);
/// let target = Target::new(&triangle(0.0)?);
/// let options = HausdorffOptions { tolerance: Tolerance::Absolute(1e-9), ..HausdorffOptions::default() };
/// for z in [1.0, 2.0, 3.0] {
///     assert!(options.directed_to(&triangle(z)?, &target)?.distance.contains(z));
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct HausdorffOptions<'o> {
    /// How narrow the enclosure should be.
    pub tolerance: Tolerance,
    /// Asks only whether the distance is at most this length: the search ends with the first proof of either answer, which
    /// is read off the enclosure. Undecided when both ends lie within the tolerance.
    pub threshold: Option<f64>,
    /// Tolerances to reach on the way, as fractions of the joint diagonal in descending order; at each the observer is shown
    /// what is left of A. Those not coarser than the tolerance asked for are passed over; the search then goes on to
    /// that tolerance, and shows that last stage too. Costs memory for every piece that may still hold the maximum, and a
    /// query for each.
    pub stages: Vec<f64>,
    /// Which search to use.
    pub method: Method,
    /// Time, memory and threads. When a limit is reached, the enclosure is wider than asked; a tree that is not built by then is
    /// given up, and the enclosure is found in linear time without one. The limit on pieces applies to those that are open at a
    /// time.
    pub limits: Limits,
    /// Watches the search.
    pub observer: Option<&'o dyn Observer>,
}

impl<'o> HausdorffOptions<'o> {
    /// Whether the options make sense.
    ///
    /// # Errors
    /// [`OptionError::Tolerance`] and [`OptionError::Threshold`] unless finite and not negative; [`OptionError::Stage`] unless
    /// stages are positive, finite and descending.
    pub fn check(&self) -> Result<(), OptionError> {
        self.tolerance.check()?;
        self.threshold.map_or(Ok(()), check_threshold)?;
        let mut before = f64::INFINITY;
        for (index, &tolerance) in self.stages.iter().enumerate() {
            if !(0.0 < tolerance && tolerance < before) {
                return Err(OptionError::Stage { index, tolerance });
            }
            before = tolerance;
        }
        Ok(())
    }

    /// The observer, or one that does nothing.
    pub(crate) fn observer(&self) -> &'o dyn Observer {
        self.observer.unwrap_or(&())
    }
}
