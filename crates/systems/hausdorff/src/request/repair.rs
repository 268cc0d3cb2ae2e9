//! Repairing a mesh, with a proof of how far the result is from it.

use crate::certificate::CertificateAnswer;
use crate::{Enclosure, HausdorffOptions};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::repair::{RepairError, RepairOptions, RepairReport, Weld, repair};
use pompeiu_core::mesh::{Coordinates, Rounding};
use pompeiu_core::request::{Conclusion, Length, LengthError, Limit, Report, Request};
use pompeiu_core::run::{RunContext, StopReason};

/// Make a mesh an oriented manifold, and say what was done.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RepairRequest {
    /// Make one vertex of those within this length of each other, not only of those at one position.
    #[cfg_attr(feature = "clap", arg(long, allow_negative_numbers = true, value_name = "LENGTH"))]
    pub weld: Option<Length>,
    /// Leave vertices at one position apart.
    #[cfg_attr(feature = "clap", arg(long))]
    pub no_weld: bool,
    /// Fill boundary loops with at most this many edges.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub fill_holes: usize,
    /// Largest distance from the input, to be proven, such as 0.1, 0.1mm with the unit given, or 0.5% of the diagonal.
    #[cfg_attr(feature = "clap", arg(long, allow_negative_numbers = true, value_name = "LENGTH"))]
    pub within: Option<Length>,
    /// The unit of the coordinates, such as mm; files have none.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME"))]
    pub unit: String,
    /// Coordinates of the result.
    #[cfg_attr(feature = "clap", command(flatten))]
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub coordinates: Coordinates,
}

impl Request for RepairRequest {
    const NAME: &'static str = "repair";
    const LIMITS: &'static [Limit] = &[];
    type Report = ProvenRepairReport;
}

/// Why a mesh cannot be repaired as asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RepairRequestError {
    /// The mesh cannot be repaired.
    #[error(transparent)]
    Repair(#[from] RepairError),
    /// A length cannot be converted to the unit of the mesh.
    #[error(transparent)]
    Length(#[from] LengthError),
    /// Vertices are to be welded and not to be welded.
    #[error("weld and no_weld are both given; choose one")]
    Both,
}

/// A repaired mesh.
#[derive(Clone, Debug)]
pub struct ProvenRepair {
    /// The result.
    pub mesh: TriMesh,
    /// What was done, and how far the result is from the input.
    pub report: ProvenRepairReport,
}

/// What was done to a mesh, how often and where, and the proven distance of the result. Lengths are in the unit of the mesh.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ProvenRepairReport {
    /// Number of vertices of the result.
    pub vertices: usize,
    /// Number of faces of the result.
    pub faces: usize,
    /// Whether the result is as asked, and is written: not where the distance asked for is not proven.
    pub written: bool,
    /// What was done.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub repair: RepairReport,
    /// The effect of rounding to the coordinates of the output, which came first.
    pub rounding: Rounding,
    /// The distance asked for; null without.
    pub within: Option<f64>,
    /// The Pompeiu–Hausdorff distance of input and result; null where none was asked for.
    pub distance: Option<Enclosure>,
    /// The outcome of the certificate; absent if none was requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub certificate: Option<CertificateAnswer>,
    /// The reason for which the search for the distance ended.
    pub stop: StopReason,
}

impl Report for ProvenRepairReport {
    fn stop(&self) -> StopReason {
        self.stop
    }

    /// That the result is within the distance is proven, refuted, or neither.
    fn conclusion(&self) -> Conclusion {
        match self.within.zip(self.distance) {
            Some((within, distance)) if distance.lower() > within => Conclusion::Refuted,
            Some((within, distance)) if distance.upper() > within => Conclusion::Incomplete,
            _ if self.certificate.as_ref().is_some_and(|answer| answer.written.is_none()) => {
                Conclusion::Incomplete
            }
            _ => Conclusion::AsAsked,
        }
    }
}

impl RepairRequest {
    /// Repairs a mesh, and proves how far the result, in coordinates that its file can hold, is from it where that is asked for.
    ///
    /// # Errors
    /// [`RepairRequestError`].
    pub fn run(&self, mesh: &TriMesh, context: &RunContext<'_>) -> Result<ProvenRepair, RepairRequestError> {
        let diagonal = Aabb::of_faces(mesh).diagonal();
        let in_unit = |length: &Option<Length>| {
            length.as_ref().map(|length| length.of(&self.unit, diagonal)).transpose()
        };
        let within = in_unit(&self.within)?;
        let weld = match in_unit(&self.weld)? {
            Some(_) if self.no_weld => return Err(RepairRequestError::Both),
            Some(length) if length != 0.0 => Weld::Within(length),
            None if self.no_weld => Weld::Never,
            _ => Weld::Equal,
        };
        let (fill_holes, coordinates) = (self.fill_holes, self.coordinates);
        let found = repair(mesh, &RepairOptions { weld, fill_holes, coordinates })?;
        let options = HausdorffOptions { limits: context.limits(), ..HausdorffOptions::default() };
        let measured = within.map(|_| options.both_directions(mesh, &found.mesh));
        let stops = measured.iter().flat_map(|report| [report.a_to_b.stop, report.b_to_a.stop]);
        let mut report = ProvenRepairReport {
            vertices: found.mesh.positions().len(),
            faces: found.mesh.faces().len(),
            written: false,
            repair: found.report,
            rounding: found.rounding,
            within,
            stop: stops.into_iter().find(|stop| stop.is_early()).unwrap_or(StopReason::Tolerance),
            distance: measured.map(|report| report.distance),
            certificate: None,
        };
        report.written = report.conclusion() == Conclusion::AsAsked;
        Ok(ProvenRepair { mesh: found.mesh, report })
    }
}
