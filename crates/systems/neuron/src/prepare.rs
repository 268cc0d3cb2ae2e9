//! From the bytes of a file to the skeleton that is worked on.

use crate::{Skeleton, SkeletonReport, SmoothOptions, SwcError, read_swc, smooth};

/// What is done to a skeleton before anything else.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Preparation {
    /// Whether what can be repaired is repaired.
    pub repair: bool,
    /// Smoothing and resampling; neither without steps and spacing.
    pub smooth: SmoothOptions,
}

impl Preparation {
    /// These options and those of a mesh in one line: what cells depend on besides the file.
    pub fn line(&self, stage: &str, parts: usize, layer: f64) -> String {
        let (repair, smooth) = (self.repair, &self.smooth);
        format!("{stage} {parts} {layer:?} {repair} {} {:?}", smooth.steps, smooth.spacing)
    }
}

/// Reads a skeleton, repairs and smooths it as asked, and looks at it.
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
