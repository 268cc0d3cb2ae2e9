//! Fewer faces for a surface.

use crate::{
    Effort, Features, IntersectionCount, Intersections, Refusals, Simplified, SimplifyError, SimplifyOptions,
    SimplifyTarget, SimplifyTiming, simplify_levels,
};
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::{Coordinates, Rounding};
use pompeiu_core::request::{Conclusion, Count, Length, Limit, Report, Request};
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_hausdorff::SymmetricReport;
use pompeiu_hausdorff::certificate::CertificateAnswer;

#[cfg(feature = "clap")]
use pompeiu_core::request::values::{fraction, magnitude};

/// Reduce the number of faces within a distance that is proven.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SimplifyRequest {
    /// Largest distance from the input, such as 0.1, 0.1mm with the unit given, or 0.5% of the diagonal.
    #[cfg_attr(feature = "clap", arg(long, allow_negative_numbers = true, value_name = "LENGTH"))]
    pub within: Option<Length>,
    /// The unit of the coordinates, such as mm; files have none.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME"))]
    pub unit: String,
    /// Largest distance as a fraction of the diagonal of the bounding box.
    #[cfg_attr(feature = "clap", arg(long, value_parser = fraction, value_name = "FRACTION"))]
    pub relative: Option<f64>,
    /// Number of faces to reach, such as 1000, or 10% of those of the input; the distance follows.
    #[cfg_attr(feature = "clap", arg(long, value_name = "COUNT"))]
    pub faces: Option<Count>,
    /// The effort to make the distance small at a given number of faces.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub effort: Effort,
    /// Keep edges whose faces meet at more than this angle between their normals, in degrees, and boundaries: as curves with the same
    /// corners.
    #[cfg_attr(feature = "clap", arg(long, value_parser = magnitude, value_name = "ANGLE"))]
    pub features: Option<f64>,
    /// Repair the mesh first; the distance is measured from the mesh as it was.
    #[cfg_attr(feature = "clap", arg(long))]
    pub repair: bool,
    /// The treatment of faces of the result that intersect; where they are refused, no more pairs intersect than in the input.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "WHAT"))]
    pub intersections: Intersections,
    /// Number of levels of detail: each further one has half the distance, or twice the number of faces, of the one before.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=32)))]
    pub levels: u8,
    /// Coordinates of the result.
    #[cfg_attr(feature = "clap", command(flatten))]
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub coordinates: Coordinates,
}

impl Default for SimplifyRequest {
    fn default() -> Self {
        Self {
            within: None,
            unit: String::new(),
            relative: None,
            faces: None,
            effort: Effort::default(),
            features: None,
            repair: false,
            intersections: Intersections::RefuseNew,
            levels: 1,
            coordinates: Coordinates::default(),
        }
    }
}

impl Request for SimplifyRequest {
    const NAME: &'static str = "simplify";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time];
    type Report = SimplifyReport;
}

/// Levels of detail, and what is said of them.
#[derive(Clone, Debug)]
pub struct SimplifyAnswer {
    /// The level that was asked for, and then finer and finer ones.
    pub levels: Vec<Simplified>,
    /// What is said of them.
    pub report: SimplifyReport,
}

/// The report on a simplified mesh. Lengths are in the unit of the mesh.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LevelReport {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of faces.
    pub faces: usize,
    /// The distance that it keeps; null where a number of faces was asked for.
    pub within: Option<f64>,
    /// The Pompeiu–Hausdorff distance of input (A) and result (B), and both directed distances.
    pub distance: SymmetricReport,
    /// The number of pairs of faces that intersect; null where they were not sought.
    pub intersections: Option<IntersectionCount>,
    /// Number of edges that were collapsed.
    pub collapses: usize,
    /// Why the number of faces asked for was not reached; null where it was, or where a limit ended the computation.
    pub refusals: Option<Refusals>,
}

impl From<&Simplified> for LevelReport {
    fn from(found: &Simplified) -> Self {
        let within = match found.target {
            SimplifyTarget::Within(d) => Some(d),
            SimplifyTarget::Faces(_) => None,
        };
        Self {
            vertices: found.mesh.positions().len(),
            faces: found.mesh.faces().len(),
            within,
            distance: found.distance.clone(),
            intersections: found.intersections,
            collapses: found.collapses,
            refusals: found.refusals,
        }
    }
}

/// A simplified mesh, and finer ones where they were asked for. Lengths are in the unit of the mesh.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SimplifyReport {
    /// The level that was asked for.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub level: LevelReport,
    /// The effect on the input of rounding to the coordinates of the output.
    pub rounding: Rounding,
    /// The attributes that were carried over from the input.
    pub kept: Kept,
    /// The outcome of the certificate; absent if none was requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub certificate: Option<CertificateAnswer>,
    /// Other levels of detail, each finer than the one before; empty unless asked for.
    pub finer: Vec<LevelReport>,
    /// The reason for which it ended.
    pub stop: StopReason,
    /// Time spent, in milliseconds.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: SimplifyTiming,
}

/// The attributes that were carried over from the input with its [appearance](crate::Carrier).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Kept {
    /// Whether the result has texture coordinates.
    pub texture: bool,
    /// Number of edges of the input at which texture coordinates or materials change; they were kept as curves.
    pub seam_edges: usize,
    /// Number of materials.
    pub materials: usize,
    /// Whether the vertices of the result have colours.
    pub colors: bool,
}

impl Report for SimplifyReport {
    fn stop(&self) -> StopReason {
        self.stop
    }

    /// Whether it ended early, or without the certificate that was asked for.
    fn conclusion(&self) -> Conclusion {
        let is_unproven = self.certificate.as_ref().is_some_and(|answer| answer.written.is_none());
        if is_unproven || self.stop.is_early() { Conclusion::Incomplete } else { Conclusion::AsAsked }
    }
}

impl SimplifyRequest {
    /// Simplifies a mesh, and keeps edges, given by their ends, as curves. The time limit ends the collapses; a distance asked for is
    /// proven nevertheless.
    ///
    /// # Errors
    /// [`SimplifyError`].
    pub fn run(
        &self,
        mesh: &TriMesh,
        keep: &[[VertexId; 2]],
        context: &RunContext<'_>,
    ) -> Result<SimplifyAnswer, SimplifyError> {
        let options = SimplifyOptions {
            features: Features { angle: self.features, edges: keep, ..Features::default() },
            effort: self.effort,
            repair: self.repair,
            coordinates: self.coordinates,
            intersections: self.intersections,
            limits: context.limits(),
            progress: context.progress(),
            ..SimplifyOptions::new(self.target(mesh)?)
        };
        let mut levels = simplify_levels(mesh, &options, usize::from(self.levels))?;
        levels.reverse();
        let report = report(&levels)?;
        Ok(SimplifyAnswer { levels, report })
    }

    /// When it ends: exactly one way is given.
    fn target(&self, mesh: &TriMesh) -> Result<SimplifyTarget, SimplifyError> {
        let diagonal = Aabb::of_faces(mesh).diagonal();
        let target = match (&self.within, self.relative, self.faces) {
            (Some(length), None, None) => SimplifyTarget::Within(length.of(&self.unit, diagonal)?),
            (None, Some(share), None) => SimplifyTarget::Within(share * diagonal),
            (None, None, Some(faces)) => SimplifyTarget::Faces(faces.of(mesh.faces().len())),
            _ => return Err(SimplifyError::OneTarget),
        };
        match target {
            SimplifyTarget::Within(_) if self.effort != Effort::default() => Err(SimplifyError::EffortWithin),
            _ => Ok(target),
        }
    }
}

fn report(levels: &[Simplified]) -> Result<SimplifyReport, SimplifyError> {
    let (asked, finer) = levels.split_first().ok_or(SimplifyError::NoLevels)?;
    let mut timing = SimplifyTiming::default();
    for level in levels {
        timing.collapse += level.timing.collapse;
        timing.distance += level.timing.distance;
    }
    let early = levels.iter().map(|level| level.stop).find(|stop| stop.is_early());
    Ok(SimplifyReport {
        level: asked.into(),
        rounding: asked.rounding,
        kept: Kept::default(),
        certificate: None,
        finer: finer.iter().map(LevelReport::from).collect(),
        stop: early.unwrap_or(asked.stop),
        timing,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::icosphere;

    #[test]
    fn one_target_is_asked_for() {
        let sphere = icosphere(1.0, 2).expect("a sphere");
        let run = |request: &SimplifyRequest| request.run(&sphere, &[], &RunContext::default());
        let share = SimplifyRequest { faces: Count::percent(50.0).ok(), ..SimplifyRequest::default() };
        assert_eq!(run(&share).expect("a mesh").report.level.faces, 160);
        let faces = SimplifyRequest { faces: Some(200.into()), levels: 2, ..SimplifyRequest::default() };
        let found = run(&faces).expect("a mesh").report;
        assert!(found.level.faces <= 200 && found.finer.len() == 1 && found.finer[0].faces > 200);
        let both = SimplifyRequest { relative: Some(0.1), ..faces };
        for wrong in [SimplifyRequest::default(), both] {
            assert_eq!(run(&wrong).map(|answer| answer.report).unwrap_err(), SimplifyError::OneTarget);
        }
        let fast = SimplifyRequest {
            within: Length::new(0.1).ok(),
            effort: Effort::Fast,
            ..SimplifyRequest::default()
        };
        assert_eq!(run(&fast).map(|answer| answer.report).unwrap_err(), SimplifyError::EffortWithin);
    }
}
