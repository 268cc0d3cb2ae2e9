//! The deviation of two meshes.

use super::moved::{MovedFirst, RequestError, moved};
use crate::align::Registration;
use pompeiu_core::request::{Conclusion, Limit, Report, Request};
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_hausdorff::{DeviationReport, DeviationRequest, NamedFaces, Observer, PreparedPair};
use serde::{Deserialize, Serialize};

/// Show how far two meshes deviate: where, on which side, over how much of the area.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default)]
pub struct AlignedDeviationRequest {
    /// Move B onto A first, from any start; parts of either may have no counterpart.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "HOW"))]
    pub align: Option<MovedFirst>,
    /// The deviation.
    #[cfg_attr(feature = "clap", command(flatten))]
    #[serde(flatten)]
    pub deviation: DeviationRequest,
}

impl Request for AlignedDeviationRequest {
    const NAME: &'static str = DeviationRequest::NAME;
    const LIMITS: &'static [Limit] = DeviationRequest::LIMITS;
    type Report = AlignedDeviationReport;
}

/// How far two meshes deviate from each other, and whether that is within a tolerance. Lengths are in the unit of the meshes; faces have the
/// numbers that they have in the files, though parts were left out.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct AlignedDeviationReport {
    /// How B was moved onto A before; absent if that was not asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alignment: Option<Registration>,
    /// The deviation.
    #[serde(flatten)]
    pub measured: DeviationReport,
}

impl Report for AlignedDeviationReport {
    fn stop(&self) -> StopReason {
        self.measured.stop()
    }

    fn conclusion(&self) -> Conclusion {
        self.measured.conclusion()
    }
}

impl AlignedDeviationRequest {
    /// Measures how far two meshes deviate. The pair is given back as it was measured, with B as moved, the parts that were chosen and the trees
    /// that were made, for figures. `groups` are the named faces of A and of B, if their files name some.
    ///
    /// # Errors
    /// [`RequestError`].
    pub fn run<'m>(
        &self,
        pair: PreparedPair<'m>,
        groups: [&[NamedFaces]; 2],
        context: &RunContext<'_>,
        observer: Option<&dyn Observer>,
    ) -> Result<(PreparedPair<'m>, AlignedDeviationReport), RequestError> {
        self.deviation.check()?;
        let (pair, alignment) = match moved(self.align, [pair.a(), pair.b()], context)? {
            Some((b, alignment)) => (pair.with_b(b), Some(alignment)),
            None => (pair, None),
        };
        let (pair, measured) = self.deviation.run(pair, groups, context, observer)?;
        Ok((pair, AlignedDeviationReport { alignment, measured }))
    }
}
