//! The deviation of two meshes.

use super::moved::{MovedFirst, RequestError, moved};
use crate::align::{Fixed, Gain, Registration};
use pompeiu_core::geom::Aabb;
use pompeiu_core::request::{Conclusion, Limit, Report, Request};
use pompeiu_core::run::{Control, RunContext, StopReason};
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
    /// The motion that aligned B with A before; absent if none was requested.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alignment: Option<Registration>,
    /// The gain of aligning B to A; absent if B was aligned, or lies well by a quick estimate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub misplaced: Option<Gain>,
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
        let misplaced = if alignment.is_none() { misplaced(&pair, &measured, context) } else { None };
        Ok((pair, AlignedDeviationReport { alignment, misplaced, measured }))
    }
}

/// The part of the size of B as its mean and median distance below which nobody asks whether it lies where it should.
const NEAR: f64 = 3e-4;
/// The part of the median distance that is left after aligning, from which on B lies well.
const LITTLE: f64 = 1.0 / 3.0;

/// Whether B would lie much nearer to A if it was moved.
fn misplaced(pair: &PreparedPair<'_>, found: &DeviationReport, context: &RunContext<'_>) -> Option<Gain> {
    let mean = found.deviation.b_to_a.statistics.as_ref()?.mean.lower();
    let near = NEAR * Aabb::of_faces(pair.b()).diagonal();
    if mean <= near || Control::start(&context.limits()).is_stopped() || found.stop().is_early() {
        return None;
    }
    let gain = Fixed::new(pair.a()).and_then(|fixed| fixed.gain(pair.b())).ok()?;
    (gain.as_it_lies > near && gain.aligned < LITTLE * gain.as_it_lies).then_some(gain)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::TriMesh;
    use pompeiu_core::mesh::shapes::{icosphere, torus};
    use pompeiu_core::mesh::{Affine, displace_at_random, transform};

    fn gain(a: &TriMesh, b: &TriMesh) -> Option<Gain> {
        let request = AlignedDeviationRequest::default();
        let pair = PreparedPair::new(a, b);
        request.run(pair, [&[], &[]], &RunContext::default(), None).unwrap().1.misplaced
    }

    #[test]
    fn a_part_that_lies_elsewhere_is_noticed() {
        let ring = torus(1.0, 0.4, 40, 20).unwrap();
        let scan = displace_at_random(&ring, 0.002, 5).unwrap();
        assert_eq!(gain(&ring, &scan), None);
        let turned = Affine::rotate([1.0, 2.0, 0.5], 70.0).unwrap();
        let moves = [Affine::translate([151.0, 0.0, 0.0]), Affine::translate([0.0, 0.0, 0.02]), turned];
        for moved in moves {
            let found = gain(&ring, &transform(&scan, &moved).unwrap()).unwrap();
            assert!(found.aligned < 0.004 && found.as_it_lies > 0.005, "{found:?}");
        }
        // Other shapes lie no better elsewhere.
        assert_eq!(gain(&ring, &icosphere(1.2, 3).unwrap()), None);
    }
}
