//! Why a request cannot be answered.

use crate::{CheckpointError, FlowError, MeshError, SwcError, TransportError};
use pompeiu_core::run::StopReason;
use std::path::PathBuf;

/// Why a request cannot be answered.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NeuronRequestError {
    /// A number is out of range.
    #[error("{option} is {value}; expected {least} to {most}")]
    Range {
        /// The option.
        option: &'static str,
        /// Its value.
        value: usize,
        /// The least one.
        least: usize,
        /// The greatest one.
        most: usize,
    },
    /// The distance of new samples is no length.
    #[error("the spacing is {0}; it must be a finite length above 0")]
    Spacing(f64),
    /// The tolerated distance is no length.
    #[error("within is {0}; it must be a finite number of radii above 0")]
    Within(f64),
    /// An option that the stage does not use.
    #[error("{option} is not for the stage {stage}, only for {names}")]
    Stage {
        /// The option.
        option: &'static str,
        /// The stage.
        stage: &'static str,
        /// The stages that use it.
        names: String,
    },
    /// Levels of refinement without a place to refine.
    #[error("levels is for places that are refined; name them with refine")]
    LevelsWithoutPlaces,
    /// Preparation of a mesh.
    #[error("it is a mesh; repair, smooth and spacing are for skeletons")]
    OfSkeletons,
    /// A mesh has no skeleton to check.
    #[error("it is a mesh; the stage mesh checks it")]
    CheckOfMesh,
    /// Parameters in a file and in tables.
    #[error("parameters come from a file or from tables, not from both; leave out one of them")]
    TwoParameters,
    /// A file cannot be read.
    #[error("{}: {error}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: std::io::Error,
    },
    /// A file of parameters cannot be used.
    #[error("{}: {error}", path.display())]
    Parameters {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: TransportError,
    },
    /// A table of parameters cannot be used.
    #[error(transparent)]
    Table(TransportError),
    /// A checkpoint cannot be used.
    #[error("{}: {error}", path.display())]
    Checkpoint {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: CheckpointError,
    },
    /// The skeleton cannot be used.
    #[error(transparent)]
    Skeleton(#[from] SwcError),
    /// The neuron cannot be meshed.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The flow cannot be computed.
    #[error(transparent)]
    Flow(#[from] FlowError),
    /// Transport cannot be computed.
    #[error(transparent)]
    Transport(#[from] TransportError),
}

impl NeuronRequestError {
    /// The limit that ended a stage.
    pub(super) fn stop(&self) -> Option<StopReason> {
        match self {
            Self::Mesh(MeshError::Stopped(stop))
            | Self::Flow(FlowError::Stopped(stop))
            | Self::Transport(TransportError::Stopped(stop)) => Some(*stop),
            Self::Mesh(MeshError::Memory { .. })
            | Self::Flow(FlowError::Memory { .. })
            | Self::Transport(TransportError::Memory { .. }) => Some(StopReason::Memory),
            _ => None,
        }
    }
}
