//! What a flow is asked for.

use super::FlowError;
use super::observer::FlowObserver;
use super::scheme::Scheme;
use pompeiu_core::mesh::Coordinates;
use pompeiu_core::run::Limits;
use pompeiu_remesh::Intersections;
use std::num::NonZeroUsize;

/// When a flow ends.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "String", into = "String"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "String"))]
pub enum Until {
    /// Once the gradient along the normal, a length, is nowhere greater than this part of the square root of the area.
    Stationary(f64),
    /// At this time, in squared lengths.
    Time(f64),
    /// After this many steps.
    Steps(usize),
}

impl Until {
    /// [`Until::Stationary`] to about 10 units of rounding of a vertex position.
    pub const STATIONARY: Self = Self::Stationary(1e-11);
}

/// What the boundary may do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BoundaryCondition {
    /// It stays.
    Fixed,
    /// Each vertex slides in the plane through it with this normal. The stationary surface meets these planes at right angles.
    Planes([f64; 3]),
}

/// Remeshing during a flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Remeshing {
    /// Length of edges.
    pub edge_length: f64,
    /// Steps between two remeshings.
    pub every: NonZeroUsize,
}

/// Options of [`mean_curvature_flow`](super::mean_curvature_flow).
#[derive(Clone)]
#[allow(clippy::struct_excessive_bools, reason = "each is a question of its own")]
pub struct FlowOptions<'o> {
    /// How to move; by default [`Scheme::NormalNewton`] to a stationary surface of given boundary, else [`Scheme::Implicit`].
    pub scheme: Option<Scheme>,
    /// When to end.
    pub until: Until,
    /// Length of a step in time; by default chosen step by step. [`f64::INFINITY`] for the implicit schemes drops M.
    pub time_step: Option<f64>,
    /// Whether steps in time are extrapolated from a whole one and two halves (Richardson), for [`Scheme::Implicit`]. A flow to
    /// a stationary surface has no use for it.
    pub extrapolate: bool,
    /// What the boundary may do.
    pub boundary: BoundaryCondition,
    /// Whether the enclosed volume is kept.
    pub keep_volume: bool,
    /// Whether edges are flipped towards Delaunay triangles and vertices moved within the surface while it flows to a stationary one.
    pub improve: bool,
    /// Remeshing on the way, every so many steps.
    pub remesh: Option<Remeshing>,
    /// Whether the surface is remeshed with edges as long as they are in the mean when its angles decay; not by schemes that keep the metric
    /// of the first surface.
    pub keep_angles: bool,
    /// The coordinates of the file that the result is for: the surface is rounded to them at the end.
    pub coordinates: Coordinates,
    /// What is done about faces of the result that intersect; on the way they are not looked for.
    pub intersections: Intersections,
    /// Whether the least eigenvalue of the Hessian is computed for a stationary surface.
    pub stability: bool,
    /// Time and threads. When the time is over, the surface reached so far is returned.
    pub limits: Limits,
    /// Is shown each step.
    pub observer: Option<&'o dyn FlowObserver>,
}

impl FlowOptions<'_> {
    /// Default options with this end.
    pub fn new(until: Until) -> Self {
        Self {
            scheme: None,
            until,
            time_step: None,
            extrapolate: matches!(until, Until::Time(_)),
            boundary: BoundaryCondition::Fixed,
            keep_volume: false,
            improve: matches!(until, Until::Stationary(_)),
            remesh: None,
            keep_angles: true,
            coordinates: Coordinates::default(),
            intersections: Intersections::Ignore,
            stability: true,
            limits: Limits::default(),
            observer: None,
        }
    }

    /// The scheme that is used.
    pub fn scheme(&self) -> Scheme {
        self.scheme.unwrap_or(match self.until {
            Until::Stationary(_) if !self.keep_volume => Scheme::NormalNewton,
            _ => Scheme::Implicit,
        })
    }

    pub(super) fn check(&self) -> Result<(), FlowError> {
        let scheme = self.scheme();
        let positive = |what: &'static str, value: f64| {
            if value > 0.0 { Ok(()) } else { Err(FlowError::NotPositive { what, value }) }
        };
        match self.until {
            Until::Stationary(tolerance) => positive("tolerance of the gradient", tolerance)?,
            Until::Time(time) => {
                positive("time", time)?;
                if !scheme.is_in_time() {
                    return Err(FlowError::NoTime { scheme });
                }
            }
            Until::Steps(_) => {}
        }
        if let Some(step) = self.time_step {
            positive("time step", step)?;
            if !scheme.is_in_time() {
                return Err(FlowError::NoTime { scheme });
            }
        }
        if let Some(remeshing) = self.remesh {
            positive("edge length of remeshing", remeshing.edge_length)?;
            if scheme.keeps_first_metric() {
                return Err(FlowError::KeepsFirstMetric { scheme });
            }
        }
        if self.keep_volume && scheme != Scheme::Implicit {
            return Err(FlowError::VolumeNotKept { scheme });
        }
        if let BoundaryCondition::Planes(normal) = self.boundary {
            let length = normal.iter().map(|x| x * x).sum::<f64>();
            if !(length > 0.0 && length.is_finite()) {
                return Err(FlowError::PlaneNormal { normal });
            }
            if self.keep_volume {
                return Err(FlowError::VolumeWithPlanes);
            }
        }
        Ok(())
    }
}
