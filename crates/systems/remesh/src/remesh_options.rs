//! What remeshing is asked for, and what it returns.

use super::connectivity::ConnectivityError;
use super::features::{FeatureError, Features};
use super::guard::{IntersectionCount, Intersections, Intersects};
use super::lengths::{LengthError, NotWithin, check_length};
use super::quality::Quality;
use super::sizing::Sizing;
use pompeiu_core::mesh::{Coordinates, Rounding, TooCoarse};
use pompeiu_core::run::{Limits, ProgressObserver, StopReason};
use pompeiu_core::{MeshError, TriMesh, VertexId};
use pompeiu_hausdorff::SymmetricReport;
use std::time::Duration;

/// Options of [`remesh`](super::remesh()).
#[derive(Clone)]
pub struct RemeshOptions<'o> {
    /// How long edges should be.
    pub sizing: Sizing<'o>,
    /// What is kept beside the boundary.
    pub features: Features<'o>,
    /// Rounds of splits, collapses, flips and moves.
    pub iterations: usize,
    /// The largest distance from the input, to be proven; edges are shorter where they must be.
    pub within: Option<f64>,
    /// Whether vertices are put back onto the input; where not, they move in the tangent plane only, and the surface shrinks a little.
    pub project: bool,
    /// Whether the distance from the input is measured where none is asked for.
    pub measure: bool,
    /// Most faces that the result may have.
    pub most_faces: usize,
    /// The coordinates of the file that the result is for: rounded to before anything is said of the result.
    pub coordinates: Coordinates,
    /// The treatment of faces of the result that intersect.
    pub intersections: Intersections,
    /// Time and threads. When the time is over, the mesh reached so far is returned.
    pub limits: Limits,
    /// Is told how far the computation has come.
    pub progress: Option<&'o dyn ProgressObserver>,
}

impl<'o> RemeshOptions<'o> {
    /// Rounds where none are asked for.
    pub const ITERATIONS: usize = 10;
    /// Most faces where nothing else is asked for.
    pub const MOST_FACES: usize = 20_000_000;

    /// Ten iterations, boundaries kept, vertices on the input, the distance measured, no limits.
    pub fn new(sizing: Sizing<'o>) -> Self {
        Self {
            sizing,
            features: Features::default(),
            iterations: Self::ITERATIONS,
            within: None,
            project: true,
            measure: true,
            most_faces: Self::MOST_FACES,
            coordinates: Coordinates::default(),
            intersections: Intersections::Ignore,
            limits: Limits::default(),
            progress: None,
        }
    }

    /// Whether the options make sense for a mesh with this diagonal and number of vertices.
    pub(super) fn check(&self, diagonal: f64, vertices: usize) -> Result<(), RemeshError> {
        if diagonal == 0.0 {
            return Err(RemeshError::OnePosition);
        }
        let length = |what, length| check_length(what, length, diagonal);
        match self.sizing {
            Sizing::Length(x) => {
                length("edge length", x)?;
                if x > diagonal {
                    return Err(RemeshError::TooLong { length: x, diagonal });
                }
            }
            Sizing::ChordHeight { tolerance, between: [shortest, longest] } => {
                length("chord height", tolerance)?;
                length("least edge length", shortest)?;
                length("greatest edge length", longest)?;
                if shortest > longest {
                    return Err(RemeshError::Between { shortest, longest });
                }
            }
            Sizing::Field(_) => {}
        }
        self.within.map_or(Ok(()), |x| length("distance", x))?;
        Ok(self.features.check(vertices)?)
    }
}

/// A mesh with new triangles.
#[derive(Clone, Debug)]
pub struct Remeshed {
    /// The mesh.
    pub mesh: TriMesh,
    /// The edges of the mesh that are on curves: boundaries, creases and selected edges of the input.
    pub kept: Vec<[VertexId; 2]>,
    /// The triangles of the input.
    pub before: Quality,
    /// The triangles of the result.
    pub after: Quality,
    /// Both directed distances, enclosed: A is the input, B the result. None where it was not measured.
    pub distance: Option<SymmetricReport>,
    /// The volume that the result encloses over that of the input, rounded; none for a surface with boundary, or around no volume.
    pub volume_share: Option<f64>,
    /// What rounding to the coordinates of the file does to the input.
    pub rounding: Rounding,
    /// How many pairs of faces intersect, where that was asked for.
    pub intersections: Option<IntersectionCount>,
    /// Number of iterations done, those that a distance asked for included.
    pub iterations: usize,
    /// Why it ended: [`StopReason::Tolerance`] after all iterations.
    pub stop: StopReason,
    /// The time that it took.
    pub timing: RemeshTiming,
}

/// Wall-clock times of remeshing; milliseconds in JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RemeshTiming {
    /// Changing triangles, preparation included.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub remesh: Duration,
    /// Measuring the distance of the result.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub distance: Duration,
}

/// Why a mesh was not remeshed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RemeshError {
    /// A length cannot be converted to the unit of the mesh.
    #[error(transparent)]
    Unit(#[from] pompeiu_core::request::LengthError),
    /// The faces are no oriented manifold.
    #[error(transparent)]
    Connectivity(#[from] ConnectivityError),
    /// A length makes no sense.
    #[error(transparent)]
    Length(#[from] LengthError),
    /// What is to be kept makes no sense.
    #[error(transparent)]
    Features(#[from] FeatureError),
    /// More than one size is asked for.
    #[error("the size of faces is given in more than one way: edge_length, relative or adaptive; choose one")]
    SeveralSizes,
    /// The mesh has no size.
    #[error("all vertices of faces are at one position, so there is no surface to remesh")]
    OnePosition,
    /// Edges would be longer than the mesh.
    #[error(
        "edges of length {length} are longer than the diagonal of the bounding box, {diagonal}; ask for less"
    )]
    TooLong {
        /// What was asked for.
        length: f64,
        /// The diagonal.
        diagonal: f64,
    },
    /// The least length is greater than the greatest.
    #[error("the least edge length {shortest} is greater than the greatest, {longest}")]
    Between {
        /// The least length.
        shortest: f64,
        /// The greatest length.
        longest: f64,
    },
    /// A field gives no length.
    #[error("the field gives the edge length {length} at {position:?}; it must be a positive finite number")]
    Field {
        /// What it gives.
        length: f64,
        /// Where.
        position: [f64; 3],
    },
    /// The result would be too large.
    #[error(
        "this would make about {faces:.0} faces, more than the {most} allowed; ask for longer edges, or allow more faces"
    )]
    TooManyFaces {
        /// Number of faces, estimated from the area.
        faces: f64,
        /// Most faces allowed.
        most: usize,
    },
    /// The distance asked for needs too many faces.
    #[error(
        "the distance {distance} cannot be reached with {most} faces; keep sharp edges as features, allow more faces, or ask for a \
         greater distance"
    )]
    TooManyFacesWithin {
        /// The distance asked for.
        distance: f64,
        /// Most faces allowed.
        most: usize,
    },
    /// The numbers of the file are too coarse for the distance.
    #[error(transparent)]
    TooCoarse(#[from] TooCoarse),
    /// The result is no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The distance of the result could not be confirmed.
    #[error(transparent)]
    NotWithin(#[from] NotWithin),
    /// Faces of the result intersect.
    #[error(transparent)]
    Intersects(#[from] Intersects),
}
