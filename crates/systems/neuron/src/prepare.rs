//! From the bytes of a file to a prepared skeleton.

use crate::{MeshOptions, Skeleton, SkeletonReport, SmoothOptions, SwcError, read_swc, smooth};

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

/// A prepared skeleton.
#[derive(Clone, Debug)]
pub struct PreparedSkeleton {
    /// The skeleton, smoothed and resampled as requested.
    pub skeleton: Skeleton,
    /// The skeleton of the file, repaired if requested, but not smoothed; omitted if it is the same.
    pub original: Option<Skeleton>,
    /// What is said of it.
    pub report: SkeletonReport,
}

impl PreparedSkeleton {
    /// Options with which the mesh is compared with the cones of the file.
    pub fn against_file<'o>(&'o self, options: &MeshOptions<'o>) -> MeshOptions<'o> {
        MeshOptions { reference: self.original.as_ref(), ..options.clone() }
    }
}

/// Reads a skeleton, repairs and smooths it as requested, and reports on it.
///
/// # Errors
/// [`SwcError`].
pub fn prepare(bytes: &[u8], preparation: &Preparation) -> Result<PreparedSkeleton, SwcError> {
    let rows = read_swc(bytes)?;
    let (mut skeleton, repairs) = if preparation.repair {
        let (skeleton, repairs) = Skeleton::repaired(&rows)?;
        (skeleton, Some(repairs))
    } else {
        (Skeleton::new(&rows)?, None)
    };
    let (mut deviation, mut original) = (None, None);
    if preparation.smooth.steps > 0 || preparation.smooth.spacing.is_some() {
        let (smoothed, moved) = smooth(&skeleton, &preparation.smooth);
        original = Some(std::mem::replace(&mut skeleton, smoothed));
        deviation = Some(moved);
    }
    let report = SkeletonReport::new(&skeleton, repairs.as_deref(), deviation);
    Ok(PreparedSkeleton { skeleton, original, report })
}
