//! Moving one mesh onto another, and how far it then is from it.

use super::RequestError;
use crate::align::{Fixed, Registration, RegistrationOptions, TransformSettings, register};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::{Coordinates, Rounding, transform};
use pompeiu_core::request::{Conclusion, Limit, Report, Request};
use pompeiu_core::run::Instant;
use pompeiu_core::run::{Limits, RunContext, StopReason};
use pompeiu_hausdorff::{DirectedReport, HausdorffOptions};
use serde::{Deserialize, Serialize};
use std::time::Duration;

#[cfg(feature = "clap")]
use pompeiu_core::request::values::share;

/// Move one mesh onto another, from any start, also if only parts match.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct AlignRequest {
    /// Find a factor of scale, too; the meshes must overlap nearly whole.
    #[cfg_attr(feature = "clap", arg(long))]
    pub scale: bool,
    /// The share of the moving surface's area that has a counterpart, such as 0.5; without it the spread of the distances tells.
    #[cfg_attr(feature = "clap", arg(long, alias = "robust", value_parser = share, value_name = "SHARE"))]
    pub overlap: Option<f64>,
    /// Prove how far the moved mesh is from the fixed one, and the other way round.
    #[cfg_attr(
        feature = "clap",
        arg(long = "no-measure", action = clap::ArgAction::SetFalse, help = "Leave out how far both meshes are from each other")
    )]
    pub measure: bool,
}

impl Default for AlignRequest {
    fn default() -> Self {
        Self { scale: false, overlap: None, measure: true }
    }
}

impl Request for AlignRequest {
    const NAME: &'static str = "align";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time, Limit::Memory];
    type Report = AlignReport;
}

/// A moved mesh.
#[derive(Clone, Debug)]
pub struct Aligned {
    /// The mesh as moved, in coordinates that its file can hold.
    pub mesh: TriMesh,
    /// What rounding to those did.
    pub rounding: Rounding,
    /// How it was moved, and how far it is from the fixed mesh.
    pub report: AlignReport,
}

/// Where a mesh belongs on another, how sure that is, and the proven distances there. Lengths are in the unit of the meshes.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AlignReport {
    /// The report.
    #[serde(flatten)]
    pub registration: Registration,
    /// Whether it fits, no other place that was tried fits nearly as well, and no motion is free.
    pub unique: bool,
    /// The map as `ParaView`'s filter Transform takes it.
    pub paraview: TransformSettings,
    /// The distance of the moved mesh from the fixed one; null where it was not to be measured.
    pub moved_to_fixed: Option<DirectedReport>,
    /// The distance of the fixed mesh from the moved one; null where it was not to be measured.
    pub fixed_to_moved: Option<DirectedReport>,
    /// Time spent on each part.
    #[serde(rename = "timing_ms")]
    pub timing: AlignTiming,
}

/// Time by the clock; milliseconds in JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AlignTiming {
    /// Finding the place.
    #[serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize")]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub align: Duration,
    /// Proving the distances.
    #[serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize")]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub distance: Duration,
}

impl Report for AlignReport {
    /// Of the alignment, or of a distance that a limit ended.
    fn stop(&self) -> StopReason {
        let measured = [&self.moved_to_fixed, &self.fixed_to_moved].into_iter().flatten().map(|one| one.stop);
        let stops = std::iter::once(self.registration.stop).chain(measured);
        stops.into_iter().find(|stop| stop.is_early()).unwrap_or(self.registration.stop)
    }

    /// Where nothing fits, the answer falls short.
    fn conclusion(&self) -> Conclusion {
        if self.stop().is_early() || !self.registration.fits {
            Conclusion::Incomplete
        } else {
            Conclusion::AsAsked
        }
    }
}

impl AlignRequest {
    /// Moves a mesh onto another; what is said of the distance is true of the mesh in these coordinates. The memory of the search for the place is not limited, that for the distances is.
    ///
    /// # Errors
    /// [`RequestError`].
    pub fn run(
        &self,
        moving: &TriMesh,
        fixed: &TriMesh,
        coordinates: Coordinates,
        context: &RunContext<'_>,
    ) -> Result<Aligned, RequestError> {
        let started = Instant::now();
        let options = RegistrationOptions {
            scale: self.scale,
            overlap: self.overlap,
            limits: Limits { memory: None, ..context.limits() },
            progress: context.progress(),
        };
        let found = register(moving, &Fixed::new(fixed)?, &options)?;
        let moved = transform(moving, &found.map())?;
        let grid = coordinates.within(&Aabb::of_faces(&moved));
        let (mesh, rounding) = (grid.round_mesh(&moved)?, grid.rounding(&moved));
        let align = started.elapsed();
        let options = HausdorffOptions { limits: context.limits(), ..HausdorffOptions::default() };
        let distances = self.measure.then(|| options.symmetric(&mesh, fixed)).transpose()?;
        let (moved_to_fixed, fixed_to_moved) = distances.map(|report| (report.a_to_b, report.b_to_a)).unzip();
        let report = AlignReport {
            unique: found.is_unique(),
            paraview: found.transform_settings(),
            registration: found,
            moved_to_fixed,
            fixed_to_moved,
            timing: AlignTiming { align, distance: started.elapsed().saturating_sub(align) },
        };
        Ok(Aligned { mesh, rounding, report })
    }
}
