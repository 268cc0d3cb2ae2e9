//! What is worked on: a skeleton, or a hexahedral mesh that was made elsewhere.

use crate::{
    CubicMesh, Ends, MeshError, MeshOptions, Meshability, NeuronMesh, Preparation, PreparedSkeleton, Side,
    Skeleton, SkeletonReport, SwcError, cubic_neuron, mesh_neuron, meshability, prepare,
};
use pompeiu_volume::HexMesh;

/// What is in a file: the bytes of a skeleton (SWC), or a mesh.
#[derive(Clone, Debug)]
pub struct NeuronSource {
    /// The bytes of the file, to which a checkpoint belongs.
    pub(crate) content: Vec<u8>,
    mesh: Option<(HexMesh, Option<Vec<f64>>)>,
}

impl NeuronSource {
    /// A skeleton.
    pub fn skeleton(content: Vec<u8>) -> Self {
        Self { content, mesh: None }
    }

    /// A mesh with the numbers of its ends at vertices: 1 at the inlet, 2 and more at others.
    pub fn mesh(content: Vec<u8>, mesh: HexMesh, labels: Option<Vec<f64>>) -> Self {
        Self { content, mesh: Some((mesh, labels)) }
    }

    /// Whether it is a mesh.
    pub fn is_mesh(&self) -> bool {
        self.mesh.is_some()
    }

    /// A skeleton is prepared as asked.
    pub(crate) fn prepared(self, preparation: &Preparation) -> Result<Prepared, SwcError> {
        if let Some((mesh, labels)) = self.mesh {
            return Ok(Prepared::Mesh(mesh, labels));
        }
        Ok(Prepared::Skeleton(Box::new(prepare(&self.content, preparation)?)))
    }
}

/// A prepared skeleton, or a mesh.
pub(crate) enum Prepared {
    Skeleton(Box<PreparedSkeleton>),
    Mesh(HexMesh, Option<Vec<f64>>),
}

impl Prepared {
    pub(crate) fn skeleton(&self) -> Option<&Skeleton> {
        match self {
            Self::Skeleton(prepared) => Some(&prepared.skeleton),
            Self::Mesh(..) => None,
        }
    }

    /// The skeleton before smoothing, if it was smoothed.
    pub(crate) fn original(&self) -> Option<&Skeleton> {
        match self {
            Self::Skeleton(prepared) => prepared.original.as_ref(),
            Self::Mesh(..) => None,
        }
    }

    pub(crate) fn report(&self) -> Option<&SkeletonReport> {
        match self {
            Self::Skeleton(prepared) => Some(&prepared.report),
            Self::Mesh(..) => None,
        }
    }

    /// Points that are read: samples, or vertices of a mesh.
    pub(crate) fn points(&self) -> usize {
        match self {
            Self::Skeleton(prepared) => prepared.skeleton.samples().len(),
            Self::Mesh(mesh, _) => mesh.positions().len(),
        }
    }

    /// Whether trilinear cells can be made; a mesh has them.
    pub(crate) fn meshability(&self, options: &MeshOptions<'_>) -> Result<Meshability, MeshError> {
        match self {
            Self::Skeleton(prepared) => meshability(&prepared.skeleton, &prepared.against_file(options)),
            Self::Mesh(..) => Ok(Meshability { meshable: Some(true), problems: Vec::new() }),
        }
    }

    /// Trilinear cells.
    pub(crate) fn hexahedra(
        &self,
        sides: &[Side],
        options: &MeshOptions<'_>,
    ) -> Result<NeuronMesh, MeshError> {
        match self {
            Self::Skeleton(prepared) => mesh_neuron(&prepared.skeleton, &prepared.against_file(options)),
            Self::Mesh(mesh, labels) => {
                NeuronMesh::from_hexahedra(mesh.clone(), ends(sides, labels.as_ref()), &options.limits)
            }
        }
    }

    /// Tricubic cells.
    pub(crate) fn patches(&self, sides: &[Side], options: &MeshOptions<'_>) -> Result<CubicMesh, MeshError> {
        match self {
            Self::Skeleton(prepared) => cubic_neuron(&prepared.skeleton, &prepared.against_file(options)),
            Self::Mesh(mesh, labels) => {
                CubicMesh::from_hexahedra(mesh, ends(sides, labels.as_ref()), &options.limits)
            }
        }
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
