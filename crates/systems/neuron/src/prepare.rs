//! From the bytes of a file to a prepared skeleton.

use crate::{Skeleton, SkeletonReport, SmoothOptions, SwcError, read_swc, smooth};

/// Options for preparing a skeleton.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Preparation {
    /// Whether to repair defects.
    pub repair: bool,
    /// Smoothing and resampling; neither without steps and spacing.
    pub smooth: SmoothOptions,
}

impl Preparation {
    /// These options and those of a mesh in one line: together with the file they determine the cells.
    pub fn line(&self, stage: &str, parts: usize, layer: f64) -> String {
        let (repair, smooth) = (self.repair, &self.smooth);
        format!("{stage} {parts} {layer:?} {repair} {} {:?}", smooth.steps, smooth.spacing)
    }
}

/// Reads a skeleton, repairs and smooths it as requested, and reports on it.
///
/// # Errors
/// [`SwcError`].
pub fn prepare(bytes: &[u8], preparation: &Preparation) -> Result<(Skeleton, SkeletonReport), SwcError> {
    let rows = read_swc(bytes)?;
    let (mut skeleton, repairs) = if preparation.repair {
        let (skeleton, repairs) = Skeleton::repaired(&rows)?;
        (skeleton, Some(repairs))
    } else {
        (Skeleton::new(&rows)?, None)
    };
    let mut deviation = None;
    if preparation.smooth.steps > 0 || preparation.smooth.spacing.is_some() {
        let (smoothed, moved) = smooth(&skeleton, &preparation.smooth);
        (skeleton, deviation) = (smoothed, Some(moved));
    }
    let report = SkeletonReport::new(&skeleton, repairs.as_deref(), deviation);
    Ok((skeleton, report))
}
