//! Errors of the library as exceptions of the package, with the library's own sentences.

use pompeiu::complexity::{ComplexityError, ComplexityRequestError, RankingError};
use pompeiu::contact::request::CheckpointError as ContactCheckpointError;
use pompeiu::contact::{ContactError, ContactRequestError};
use pompeiu::core::MeshError;
use pompeiu::core::mesh::repair::RepairError;
use pompeiu::core::mesh::shapes::ShapeError;
use pompeiu::coupling::{CouplingError, SceneError};
use pompeiu::fields::DecomposeError;
use pompeiu::figures::FigureError;
use pompeiu::figures::page::PageError;
use pompeiu::flatten::{CutError, FlattenError};
use pompeiu::flow::FlowError;
use pompeiu::fluid::FluidError;
use pompeiu::fluid::request::{CheckpointError as FluidCheckpointError, FluidRequestError};
use pompeiu::hausdorff::certificate::CertificateError;
use pompeiu::hausdorff::{DeviationRequestError, OptionError, RepairRequestError};
use pompeiu::io::{AttributeError, ReadError, WriteError};
use pompeiu::matching::align::AlignError;
use pompeiu::matching::rank::RankError;
use pompeiu::matching::request::{MatrixRequestError, RequestError};
use pompeiu::medial::MedialError;
use pompeiu::neuron::{
    CheckpointError, FlowError as NeuronFlowError, MeshError as NeuronMeshError, NeuronRequestError,
    SwcError, TransportError,
};
use pompeiu::operators::{FieldSourceError, OperatorError};
use pompeiu::options::OptionsError;
use pompeiu::planar::picture::PictureError;
use pompeiu::planar::{FileError, OutlineError};
use pompeiu::puzzle::{PuzzleError, PuzzleRequestError};
use pompeiu::remesh::{CarryError, RemeshError, SimplifyError};
use pompeiu::surface::GeometryError;
use pyo3::PyErr;
use std::fmt::Display;
use std::io::ErrorKind;
use std::path::PathBuf;

/// The classes, which are in Python so that they can have two bases.
mod classes {
    pyo3::import_exception!(pompeiu.errors, FieldError);
    pyo3::import_exception!(pompeiu.errors, MeshError);
    pyo3::import_exception!(pompeiu.errors, MissingFileError);
    pyo3::import_exception!(pompeiu.errors, OptionError);
    pyo3::import_exception!(pompeiu.errors, OutlineError);
    pyo3::import_exception!(pompeiu.errors, ReadError);
    pyo3::import_exception!(pompeiu.errors, SurfaceError);
    pyo3::import_exception!(pompeiu.errors, WriteError);
}

/// An error of the library that has a class in Python.
pub(crate) trait Raise: Display {
    /// The exception with this sentence.
    fn exception(&self, sentence: String) -> PyErr;

    /// The exception to raise.
    fn raise(self) -> PyErr
    where
        Self: Sized,
    {
        self.exception(self.to_string())
    }
}

macro_rules! raise_as {
    ($($error:ty => $class:ident),* $(,)?) => {
        $(impl Raise for $error {
            fn exception(&self, sentence: String) -> PyErr {
                classes::$class::new_err(sentence)
            }
        })*
    };
}

raise_as! {
    AlignError => OptionError,
    ArrayError => MeshError,
    AttributeError => WriteError,
    ComplexityError => OptionError,
    ContactError => OptionError,
    DeviationRequestError => OptionError,
    FigureError => OptionError,
    CouplingError => OptionError,
    GeometryError => SurfaceError,
    InternalError => OptionError,
    MeshError => MeshError,
    NeuronFlowError => OptionError,
    NeuronMeshError => OptionError,
    OperatorError => FieldError,
    OptionError => OptionError,
    OutlineError => OutlineError,
    PageError => OptionError,
    PictureError => ReadError,
    PuzzleError => OptionError,
    RankingError => ReadError,
    ShapeError => OptionError,
    SwcError => ReadError,
    TransportError => OptionError,
    UnknownOption => OptionError,
    UnusableLimit => OptionError,
    OptionsError => OptionError,
    WriteError => WriteError,
}

impl Raise for FlowError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Connectivity(_)
            | Self::NoArea { .. }
            | Self::NothingMoves
            | Self::NeverStationary { .. }
            | Self::NoVolume { .. } => classes::SurfaceError::new_err(sentence),
            Self::Solve(_) => classes::FieldError::new_err(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for RepairRequestError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Repair(error) => error.exception(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for RankError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::NoneUsable { .. } => classes::ReadError::new_err(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for MatrixRequestError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::NoneUsable { .. } => classes::ReadError::new_err(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for RequestError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Mesh(error) => error.exception(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for RepairError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::NothingLeft { .. } => classes::SurfaceError::new_err(sentence),
            Self::Mesh(error) => error.exception(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for pompeiu::planar::ShapeError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Outline(error) => error.exception(sentence),
            Self::File { error: FileError::Io(error), .. } if error.kind() == ErrorKind::NotFound => {
                classes::MissingFileError::new_err(sentence)
            }
            _ => classes::ReadError::new_err(sentence),
        }
    }
}

/// A certificate that was not written or cannot be read, with its file.
#[derive(Debug, thiserror::Error)]
pub(crate) enum CertificateFileError {
    /// There is no certificate.
    #[error("{}: {error}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        error: CertificateError,
    },
    /// There is no file.
    #[error("{}: {error}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// It is no certificate.
    #[error("{}: {error}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        error: String,
    },
}

impl Raise for CertificateFileError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Open { error, .. } if error.kind() == ErrorKind::NotFound => {
                classes::MissingFileError::new_err(sentence)
            }
            Self::Open { .. } | Self::Read { .. } => classes::ReadError::new_err(sentence),
            Self::Write { error: CertificateError::Option(_), .. } => classes::OptionError::new_err(sentence),
            Self::Write { .. } => classes::WriteError::new_err(sentence),
        }
    }
}

/// A file that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{}: {error}", path.display())]
pub(crate) struct UnreadableFile {
    pub(crate) path: PathBuf,
    pub(crate) error: std::io::Error,
}

impl Raise for UnreadableFile {
    fn exception(&self, sentence: String) -> PyErr {
        match self.error.kind() {
            ErrorKind::NotFound => classes::MissingFileError::new_err(sentence),
            _ => classes::ReadError::new_err(sentence),
        }
    }
}

impl Raise for ContactCheckpointError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Syntax(_) => classes::ReadError::new_err(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for ContactRequestError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::File { error, .. } if error.kind() == ErrorKind::NotFound => {
                classes::MissingFileError::new_err(sentence)
            }
            Self::NoScene { .. } => classes::MissingFileError::new_err(sentence),
            Self::File { .. } | Self::Large { .. } | Self::Syntax { .. } => {
                classes::ReadError::new_err(sentence)
            }
            Self::Mesh(error) => error.exception(sentence),
            Self::Checkpoint(error) => error.exception(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for FluidCheckpointError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Syntax(_) => classes::ReadError::new_err(sentence),
            Self::State(error) => error.exception(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for FluidRequestError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Fluid(error) => error.exception(sentence),
            Self::Velocity(_) => classes::FieldError::new_err(sentence),
            Self::Checkpoint(error) => error.exception(sentence),
            Self::Mesh(error) => error.exception(sentence),
            Self::Picture { .. } => classes::ReadError::new_err(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for CheckpointError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Syntax(_) => classes::ReadError::new_err(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for NeuronRequestError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::File { error, .. } if error.kind() == ErrorKind::NotFound => {
                classes::MissingFileError::new_err(sentence)
            }
            Self::File { .. } => classes::ReadError::new_err(sentence),
            Self::Checkpoint { error, .. } => error.exception(sentence),
            Self::Skeleton(error) => error.exception(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for SceneError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::File { error, .. } if error.kind() == ErrorKind::NotFound => {
                classes::MissingFileError::new_err(sentence)
            }
            Self::File { .. } | Self::Large { .. } | Self::Syntax { .. } => {
                classes::ReadError::new_err(sentence)
            }
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for ComplexityRequestError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::NoShapes { .. } => classes::ReadError::new_err(sentence),
            Self::Ranking(error) => error.exception(sentence),
            Self::Shape(error) => error.exception(sentence),
            Self::Analysis(error) => error.exception(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for PuzzleRequestError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Shape(error) => error.exception(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for RemeshError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Connectivity(_) => classes::SurfaceError::new_err(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for FlattenError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Polygon { .. }
            | Self::FewVertices { .. }
            | Self::Option { .. }
            | Self::VirtualOwn
            | Self::Cut(CutError::Both { .. } | CutError::Curvature { .. } | CutError::Spread { .. }) => {
                classes::OptionError::new_err(sentence)
            }
            _ => classes::SurfaceError::new_err(sentence),
        }
    }
}

impl Raise for DecomposeError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::NoField
            | Self::Source(FieldSourceError::Expression { .. } | FieldSourceError::Harmonic { .. }) => {
                classes::OptionError::new_err(sentence)
            }
            _ => classes::FieldError::new_err(sentence),
        }
    }
}

impl Raise for MedialError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Tolerance { .. } => classes::OptionError::new_err(sentence),
            _ => classes::SurfaceError::new_err(sentence),
        }
    }
}

impl Raise for FluidError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Length { .. }
            | Self::NonFinite { .. }
            | Self::Harmonic { .. }
            | Self::BlewUp { .. }
            | Self::Operator(_)
            | Self::Solve(_) => classes::FieldError::new_err(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for SimplifyError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Connectivity(_) => classes::SurfaceError::new_err(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for CarryError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Connectivity(_) => classes::SurfaceError::new_err(sentence),
            _ => classes::OptionError::new_err(sentence),
        }
    }
}

impl Raise for ReadError {
    fn exception(&self, sentence: String) -> PyErr {
        match self {
            Self::Io { cause, .. } if cause.kind() == ErrorKind::NotFound => {
                classes::MissingFileError::new_err(sentence)
            }
            _ => classes::ReadError::new_err(sentence),
        }
    }
}

/// Why an array does not say what it should: the library has no words for what it cannot be handed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ArrayError {
    /// Not the rows and columns expected.
    #[error("{what} have shape {found}, expected {expected}")]
    Shape {
        /// What the array holds, in the plural.
        what: &'static str,
        /// Its shape.
        found: String,
        /// The shape it should have.
        expected: &'static str,
    },
    /// Not numbers of the kind expected.
    #[error("{what} are of type {found}, expected {expected}")]
    Kind {
        /// What the array holds, in the plural.
        what: &'static str,
        /// Its dtype.
        found: String,
        /// The kind it should have.
        expected: &'static str,
    },
    /// An index that no vertex can have.
    #[error("face {face} names vertex {index}, but there are {vertices} vertices (the first is 0)")]
    Index {
        /// The face.
        face: usize,
        /// The index it holds.
        index: i128,
        /// Number of vertices.
        vertices: usize,
    },
}

/// An option whose value means nothing.
#[derive(Debug, thiserror::Error)]
pub(crate) enum UnknownOption {
    /// Not one of the names.
    #[error("{option} is {found:?}, expected {expected}")]
    Name {
        /// The option.
        option: &'static str,
        /// Its value.
        found: String,
        /// The names there are.
        expected: &'static str,
    },
    /// Not a span of time.
    #[error("the time limit is {0} seconds; it must be a finite number that is not negative")]
    Time(f64),
}

/// A limit that a function does not obey.
#[derive(Debug, thiserror::Error)]
#[error("{function} has no {limit}")]
pub(crate) struct UnusableLimit {
    /// The function.
    pub(crate) function: &'static str,
    /// The limit.
    pub(crate) limit: &'static str,
}

/// The exception for an option that is none of the names there are.
pub(crate) fn unknown(option: &'static str, found: impl Into<String>, expected: &'static str) -> PyErr {
    UnknownOption::Name { option, found: found.into(), expected }.raise()
}

/// What only a mistake in the Python half, or a result that was tampered with, can cause.
#[derive(Debug, thiserror::Error)]
pub(crate) enum InternalError {
    /// Not the JSON expected.
    #[error("options, a task or a result cannot be read: {0}")]
    Parse(serde_json::Error),
    /// A mesh that is not there.
    #[error("mesh {found} does not exist, there are {count} (the first is 0)")]
    Mesh {
        /// Its place.
        found: usize,
        /// How many there are.
        count: usize,
    },
}
