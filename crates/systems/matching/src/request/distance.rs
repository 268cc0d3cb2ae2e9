//! The distance of two meshes.

use super::moved::{MovedFirst, RequestError, moved};
use crate::align::Registration;
use pompeiu_core::TriMesh;
use pompeiu_core::request::{Conclusion, Limit, Report, Request};
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_hausdorff::{DistanceReport, DistanceRequest, Observer};
use serde::{Deserialize, Serialize};

/// Enclose the distance between two meshes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default)]
pub struct AlignedDistanceRequest {
    /// Move B onto A first, from any start; parts of either may have no counterpart.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "HOW"))]
    pub align: Option<MovedFirst>,
    /// The distance.
    #[cfg_attr(feature = "clap", command(flatten))]
    #[serde(flatten)]
    pub distance: DistanceRequest,
}

impl Request for AlignedDistanceRequest {
    const NAME: &'static str = DistanceRequest::NAME;
    const LIMITS: &'static [Limit] = DistanceRequest::LIMITS;
    type Report = AlignedDistanceReport;
}

/// Both directed distances with the points that prove them. Lengths are in the unit of the meshes.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AlignedDistanceReport {
    /// The motion that aligned B with A before; absent if none was requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alignment: Option<Registration>,
    /// The distance.
    #[serde(flatten)]
    pub distance: DistanceReport,
}

impl Report for AlignedDistanceReport {
    fn stop(&self) -> StopReason {
        self.distance.stop()
    }

    fn conclusion(&self) -> Conclusion {
        self.distance.conclusion()
    }
}

impl AlignedDistanceRequest {
    /// Encloses the distance of two meshes.
    ///
    /// # Errors
    /// [`RequestError`].
    pub fn run(
        &self,
        a: &TriMesh,
        b: &TriMesh,
        context: &RunContext<'_>,
        observer: Option<&dyn Observer>,
    ) -> Result<AlignedDistanceReport, RequestError> {
        let (moved, alignment) = moved(self.align, [a, b], context)?.unzip();
        let distance = self.distance.run(a, moved.as_ref().unwrap_or(b), context, observer)?;
        Ok(AlignedDistanceReport { alignment, distance })
    }
}
