//! The mesh that the others are compared with.

use super::options::{Options, RankError};
use super::summary::Summary;
use crate::align::{Alignment, Fixed};
use pompeiu_core::TriMesh;
use pompeiu_hausdorff::Target;

/// The template and the options, prepared once for all tasks of a place where they run.
///
/// # Cost
/// O(m log m): two trees at most, one for distances and one, when the first rigid alignment asks for it, for that.
#[derive(Debug)]
pub struct Template {
    pub(super) mesh: TriMesh,
    pub(super) options: Options,
    pub(super) summary: Summary,
    /// Where distances of targets' points from the template count.
    pub(super) target: Option<Target>,
    /// Where targets are moved.
    pub(super) fixed: Option<Fixed>,
}

impl Template {
    /// Prepares a mesh.
    ///
    /// # Errors
    /// Those of [`Options::check`], and [`RankError::Template`] when nothing can be aligned to it.
    pub fn new(mesh: TriMesh, options: &Options) -> Result<Self, RankError> {
        options.check()?;
        let moves = options.alignment != Alignment::None;
        let fixed = moves.then(|| Fixed::new(&mesh)).transpose().map_err(RankError::Template)?;
        let target = options.measure.has_target_to_template().then(|| Target::new(&mesh));
        Ok(Self { summary: Summary::new(&mesh), mesh, options: options.clone(), target, fixed })
    }

    /// What was asked for.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The summary of the template.
    pub fn summary(&self) -> &Summary {
        &self.summary
    }
}
