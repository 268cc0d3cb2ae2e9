//! The template of a ranking.

use super::options::{Measure, RankError, RankOptions};
use super::summary::Summary;
use crate::align::{Alignment, Fixed};
use crate::tasks::bytes_of;
use pompeiu_core::TriMesh;
use pompeiu_hausdorff::Target;

/// The template and the options, prepared once for all tasks of a process.
///
/// # Cost
/// O(m log m): at most two trees, one for distances and one for rigid alignment, which the first such alignment builds.
#[derive(Debug)]
pub struct Template {
    pub(super) mesh: TriMesh,
    pub(super) measure: Measure,
    pub(super) alignment: Alignment,
    pub(super) summary: Summary,
    /// Present if the direction from targets to the template is required.
    pub(super) target: Option<Target>,
    /// Present if targets are aligned.
    pub(super) fixed: Option<Fixed>,
}

impl Template {
    /// Prepares a mesh.
    ///
    /// # Errors
    /// Those of [`RankOptions::check`], and [`RankError::Template`] if no mesh can be aligned to it.
    pub fn new(mesh: TriMesh, options: &RankOptions<'_>) -> Result<Self, RankError> {
        options.check()?;
        let moves = options.alignment != Alignment::None;
        let fixed = moves.then(|| Fixed::new(&mesh)).transpose().map_err(RankError::Template)?;
        let target = options.measure.has_target_to_template().then(|| Target::new(&mesh));
        let (measure, alignment) = (options.measure, options.alignment);
        Ok(Self { summary: Summary::new(&mesh), mesh, measure, alignment, target, fixed })
    }

    /// Bytes of memory without its trees.
    pub(super) fn bytes(&self) -> usize {
        bytes_of(&self.mesh)
    }

    /// The summary of the template.
    pub fn summary(&self) -> &Summary {
        &self.summary
    }
}
