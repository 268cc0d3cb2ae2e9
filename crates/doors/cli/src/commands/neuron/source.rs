//! What is worked on: a skeleton, or a hexahedral mesh that was made elsewhere.

use super::args::{Blocks, SkeletonChoice};
use crate::files;
use anyhow::{Context, bail};
use pompeiu::core::run::{Limits, ProgressObserver};
use pompeiu::neuron::{
    CubicMesh, Ends, MeshError, MeshOptions, NeuronMesh, Preparation, Side, Skeleton, SkeletonReport,
    SmoothOptions, cubic_neuron, mesh_neuron, prepare,
};
use pompeiu::volume::HexMesh;
use std::path::Path;

/// A skeleton, or a mesh with the numbers of its ends at vertices.
pub(super) enum Source {
    Skeleton(Skeleton),
    Mesh(HexMesh, Option<Vec<f64>>),
}

impl Source {
    /// Reads a file, and does what is asked to a skeleton.
    pub(super) fn read(choice: &SkeletonChoice) -> anyhow::Result<(Self, Option<SkeletonReport>)> {
        if !is_mesh(&choice.skeleton) {
            let (skeleton, report) = skeleton(choice)?;
            return Ok((Self::Skeleton(skeleton), Some(report)));
        }
        let shown = || choice.skeleton.display().to_string();
        if choice.repair || choice.smooth > 0 || choice.spacing.is_some() {
            bail!("{}: is a mesh; --repair, --smooth and --spacing are for skeletons", shown());
        }
        files::check_readable(&choice.skeleton)?;
        let read = pompeiu::io::read_hexahedra(&choice.skeleton)?;
        let positions = read.positions.into_iter().map(Into::into).collect();
        let mesh = HexMesh::new(positions, read.cells).with_context(shown)?;
        Ok((Self::Mesh(mesh, read.labels), None))
    }

    /// The skeleton, unless it is a mesh.
    pub(super) fn skeleton(&self) -> Option<&Skeleton> {
        match self {
            Self::Skeleton(skeleton) => Some(skeleton),
            Self::Mesh(..) => None,
        }
    }

    /// Where a mesh has its ends: at sides that are named, or where its vertices say so.
    fn ends<'e>(sides: &'e [Side], labels: Option<&'e Vec<f64>>) -> Ends<'e> {
        match labels {
            _ if !sides.is_empty() => Ends::Sides(sides),
            Some(labels) => Ends::Labels(labels),
            None => Ends::None,
        }
    }

    /// Trilinear cells.
    pub(super) fn hexahedra(
        self,
        blocks: &Blocks,
        sides: &[Side],
        limits: Limits,
        progress: &dyn ProgressObserver,
    ) -> Result<NeuronMesh, MeshError> {
        match self {
            Self::Skeleton(skeleton) => {
                let options = MeshOptions {
                    parts: blocks.parts.into(),
                    layer: blocks.layer,
                    limits,
                    progress: Some(progress),
                    ..MeshOptions::default()
                };
                mesh_neuron(&skeleton, &options)
            }
            Self::Mesh(mesh, labels) => {
                NeuronMesh::from_hexahedra(mesh, Self::ends(sides, labels.as_ref()), &limits)
            }
        }
    }

    /// Tricubic cells.
    pub(super) fn patches(
        self,
        layer: f64,
        sides: &[Side],
        limits: Limits,
        progress: &dyn ProgressObserver,
    ) -> Result<CubicMesh, MeshError> {
        match self {
            Self::Skeleton(skeleton) => {
                let options =
                    MeshOptions { layer, limits, progress: Some(progress), ..MeshOptions::default() };
                cubic_neuron(&skeleton, &options)
            }
            Self::Mesh(mesh, labels) => {
                CubicMesh::from_hexahedra(&mesh, Self::ends(sides, labels.as_ref()), &limits)
            }
        }
    }
}

/// Whether a file is a mesh by its name.
pub(super) fn is_mesh(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let name = name.strip_suffix(".gz").unwrap_or(&name);
    [".vtk", ".vtu"].iter().any(|suffix| name.ends_with(suffix))
}

/// Reads a skeleton and does what is asked to it.
pub(super) fn skeleton(choice: &SkeletonChoice) -> anyhow::Result<(Skeleton, SkeletonReport)> {
    let shown = || choice.skeleton.display().to_string();
    files::check_readable(&choice.skeleton)?;
    let bytes = std::fs::read(&choice.skeleton).with_context(shown)?;
    prepare(&bytes, &choice.preparation()).with_context(shown)
}

impl SkeletonChoice {
    /// What is done to a skeleton.
    pub(super) fn preparation(&self) -> Preparation {
        let smooth = SmoothOptions { steps: self.smooth as usize, spacing: self.spacing };
        Preparation { repair: self.repair, smooth }
    }
}
