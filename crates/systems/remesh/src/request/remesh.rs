//! New triangles for a surface.

use crate::{
    Features, IntersectionCount, Intersections, Quality, RemeshError, RemeshOptions, RemeshTiming, Remeshed,
    Sizing, remesh,
};
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::{Coordinates, Rounding, area};
use pompeiu_core::request::{Conclusion, Length, Limit, Report, Request};
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_hausdorff::SymmetricReport;
use pompeiu_hausdorff::certificate::CertificateAnswer;

#[cfg(feature = "clap")]
use pompeiu_core::request::values::{fraction, magnitude};

/// A result farther from the input than this many edge lengths, or that encloses less or more than the volume of the input by this share, is
/// said to be far from it: something there is narrower than edges are long.
const FAR_IN_EDGES: f64 = 0.5;
const FAR_IN_VOLUME: f64 = 0.1;

/// Triangles are said to be uneven where a smaller share of edges is near its target length, or an angle is below the first of these, in
/// degrees, or the mean of the least angles of faces below the second; that of equilateral faces is 60.
const ENOUGH_NEAR_TARGET: f64 = 0.5;
const TINY_ANGLE: f64 = 1.0;
const SMALL_MEAN_ANGLE: f64 = 20.0;

/// Where no length is asked for, edges are as long as those of the mesh in the mean, but at most this many times as long as those of as many
/// equilateral faces with its area. This shortens them where faces are long and thin only: of scans and models measured, the mean is 1 to 1.2
/// times as long.
const MOST_OF_EQUILATERAL: f64 = 4.0 / 3.0;

/// Nor are they shorter than this share of the mean: faces without area would ask for any number of faces.
const LEAST_OF_MEAN: f64 = 0.01;

/// Least and greatest length of edges that follow curvature, as fractions of the diagonal.
const ADAPTIVE_BETWEEN: [f64; 2] = [1e-4, 0.1];

/// Give a mesh nearly equilateral faces of a wanted size.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RemeshRequest {
    /// Length of edges, such as 2, 2mm with the unit given, or 1% of the diagonal; by default the mean of those of the mesh,
    /// at most 4/3 of those of as many equilateral faces with its area.
    #[cfg_attr(feature = "clap", arg(long, allow_negative_numbers = true, value_name = "LENGTH"))]
    pub edge_length: Option<Length>,
    /// Length of edges as a fraction of the diagonal of the bounding box.
    #[cfg_attr(feature = "clap", arg(long, value_parser = fraction, value_name = "FRACTION"))]
    pub relative: Option<f64>,
    /// Height of chords: edges are as long as the curvature allows.
    #[cfg_attr(feature = "clap", arg(long, allow_negative_numbers = true, value_name = "LENGTH"))]
    pub adaptive: Option<Length>,
    /// Largest distance from the input, to be proven, such as 0.1, 0.1mm with the unit given, or 0.5% of the diagonal.
    #[cfg_attr(feature = "clap", arg(long, allow_negative_numbers = true, value_name = "LENGTH"))]
    pub within: Option<Length>,
    /// The unit of the coordinates, such as mm; files have none.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME"))]
    pub unit: String,
    /// Keep edges whose faces meet at more than this angle between their normals, in degrees; boundaries are always kept.
    #[cfg_attr(feature = "clap", arg(long, value_parser = magnitude, value_name = "ANGLE"))]
    pub features: Option<f64>,
    /// Rounds of splits, collapses, flips and moves.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub iterations: usize,
    /// Most faces that the result may have.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub most_faces: usize,
    /// The treatment of faces of the result that intersect.
    #[cfg_attr(feature = "clap", arg(long, value_enum, value_name = "WHAT"))]
    pub intersections: Intersections,
    /// Coordinates of the result.
    #[cfg_attr(feature = "clap", command(flatten))]
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub coordinates: Coordinates,
}

impl Default for RemeshRequest {
    fn default() -> Self {
        Self {
            edge_length: None,
            relative: None,
            adaptive: None,
            within: None,
            unit: String::new(),
            features: None,
            iterations: RemeshOptions::ITERATIONS,
            most_faces: RemeshOptions::MOST_FACES,
            intersections: Intersections::RefuseNew,
            coordinates: Coordinates::default(),
        }
    }
}

impl Request for RemeshRequest {
    const NAME: &'static str = "remesh";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time];
    type Report = RemeshReport;
}

/// A remeshed surface, and what is said of it.
#[derive(Clone, Debug)]
pub struct RemeshAnswer {
    /// The surface.
    pub found: Remeshed,
    /// What is said of it.
    pub report: RemeshReport,
}

/// Triangles before and after, and how far both surfaces are apart. Lengths are in the unit of the mesh.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RemeshReport {
    /// The length of edges asked for; null where a chord height was.
    pub edge_length: Option<f64>,
    /// The chord height asked for; null where a length of edges was.
    pub chord_height: Option<f64>,
    /// The distance that is proven; null where none was asked for.
    pub within: Option<f64>,
    /// The triangles of the input.
    pub before: Quality,
    /// The triangles of the result.
    pub after: Quality,
    /// The Pompeiu–Hausdorff distance of input (A) and result (B), and both directed distances.
    pub distance: Option<SymmetricReport>,
    /// The volume that the result encloses over that of the input; null for a surface with boundary, or around no volume.
    pub volume_share: Option<f64>,
    /// Whether the result is far from the input though no distance was asked for: by more than half of the length of edges, or the
    /// chord height, or by a tenth of the volume. Something there is narrower than edges are long.
    pub is_far: bool,
    /// Whether triangles are not as asked for: fewer than half of the edges are between 4/5 and 4/3 of their target length, an angle is
    /// below 1°, or the mean of the least angles of faces below 20°. So it is where edges of the input stay, for a distance, or because sheets would intersect that are nearer to each other
    /// than edges are long. Never of a run that ended early.
    pub is_uneven: bool,
    /// The effect on the input of rounding to the coordinates of the output.
    pub rounding: Rounding,
    /// The number of pairs of faces of the result that intersect; null where they were not sought.
    pub intersections: Option<IntersectionCount>,
    /// The outcome of the certificate; absent if none was requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub certificate: Option<CertificateAnswer>,
    /// Number of rounds of splits, collapses, flips and moves, those that a distance asked for included.
    pub iterations: usize,
    /// The reason for which it ended.
    pub stop: StopReason,
    /// Time spent, in milliseconds.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: RemeshTiming,
}

impl Report for RemeshReport {
    fn stop(&self) -> StopReason {
        self.stop
    }

    /// Whether it ended early, or without the certificate that was asked for.
    fn conclusion(&self) -> Conclusion {
        let is_unproven = self.certificate.as_ref().is_some_and(|answer| answer.written.is_none());
        if is_unproven || self.stop.is_early() { Conclusion::Incomplete } else { Conclusion::AsAsked }
    }
}

impl RemeshRequest {
    /// Remeshes a surface. The time limit ends the rounds; a distance asked for is proven nevertheless.
    ///
    /// # Errors
    /// [`RemeshError`].
    pub fn run(&self, mesh: &TriMesh, context: &RunContext<'_>) -> Result<RemeshAnswer, RemeshError> {
        self.run_keeping(mesh, &[], context)
    }

    /// The same, with edges of the mesh that are kept as curves, by their ends, such as the seams of a texture.
    ///
    /// # Errors
    /// [`RemeshError`].
    pub fn run_keeping(
        &self,
        mesh: &TriMesh,
        edges: &[[VertexId; 2]],
        context: &RunContext<'_>,
    ) -> Result<RemeshAnswer, RemeshError> {
        let diagonal = Aabb::of_faces(mesh).diagonal();
        let in_unit = |length: &Option<Length>| {
            length.as_ref().map(|length| length.of(&self.unit, diagonal)).transpose()
        };
        let within = in_unit(&self.within)?;
        let sizing = match (in_unit(&self.edge_length)?, self.relative, in_unit(&self.adaptive)?) {
            (None, None, None) => Sizing::Length(usual_length(mesh)?),
            (Some(length), None, None) => Sizing::Length(length),
            (None, Some(share), None) => Sizing::Length(share * diagonal),
            (None, None, Some(tolerance)) => {
                Sizing::ChordHeight { tolerance, between: ADAPTIVE_BETWEEN.map(|share| share * diagonal) }
            }
            _ => return Err(RemeshError::SeveralSizes),
        };
        let (edge_length, chord_height) = match sizing {
            Sizing::Length(length) => (Some(length), None),
            Sizing::ChordHeight { tolerance, .. } => (None, Some(tolerance)),
            Sizing::Field(_) => (None, None),
        };
        let options = RemeshOptions {
            features: Features { angle: self.features, edges, ..Features::default() },
            iterations: self.iterations,
            within,
            most_faces: self.most_faces,
            coordinates: self.coordinates,
            intersections: self.intersections,
            limits: context.limits(),
            progress: context.progress(),
            ..RemeshOptions::new(sizing)
        };
        let found = remesh(mesh, &options)?;
        let report = RemeshReport {
            edge_length,
            chord_height,
            within,
            before: found.before,
            after: found.after,
            distance: found.distance.clone(),
            volume_share: found.volume_share,
            is_far: within.is_none()
                && is_far(&found, edge_length.map(|length| FAR_IN_EDGES * length).or(chord_height)),
            is_uneven: found.is_uneven(),
            rounding: found.rounding,
            intersections: found.intersections,
            certificate: None,
            iterations: found.iterations,
            stop: found.stop,
            timing: found.timing,
        };
        Ok(RemeshAnswer { found, report })
    }
}

/// The length of edges where none is asked for: their mean, unless that of as many equilateral faces with the same area is much less.
///
/// Long thin faces, such as those of tessellated cylinders, have edges whose mean says nothing of the size of the faces: 1,020 faces of a
/// cylinder would become 22.
fn usual_length(mesh: &TriMesh) -> Result<f64, RemeshError> {
    let quality = Quality::of(mesh)?;
    let mean = quality.edge_length.mean;
    let area_of_face = area(mesh) / quality.faces as f64;
    let equilateral = (area_of_face * 4.0 / 3.0_f64.sqrt()).sqrt();
    let most = MOST_OF_EQUILATERAL * equilateral;
    let least = LEAST_OF_MEAN * mean;
    Ok(if most < least {
        least
    } else if most < mean {
        most
    } else {
        mean
    })
}

impl Remeshed {
    fn is_uneven(&self) -> bool {
        let few = self.after.near_target.is_some_and(|share| share < ENOUGH_NEAR_TARGET);
        let angle = self.after.least_angle;
        !self.stop.is_early() && (few || angle.least < TINY_ANGLE || angle.mean < SMALL_MEAN_ANGLE)
    }
}

/// Whether a result is farther from the input than a length, or encloses another volume.
fn is_far(found: &Remeshed, length: Option<f64>) -> bool {
    let distance = found.distance.as_ref().map(|report| report.distance.lower());
    let is_away = distance.zip(length).is_some_and(|(distance, length)| distance > length);
    is_away || found.volume_share.is_some_and(|share| (share - 1.0).abs() > FAR_IN_VOLUME)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::{Ends, cuboid, cylinder, icosphere};

    #[test]
    fn at_most_one_size_is_asked_for() {
        let sphere = icosphere(1.0, 1).expect("a sphere");
        let run = |request: RemeshRequest| request.run(&sphere, &RunContext::default());
        let one = RemeshRequest { relative: Some(0.2), ..RemeshRequest::default() };
        assert!(run(one.clone()).is_ok_and(|answer| answer.report.edge_length > Some(0.6)));
        let both = RemeshRequest { edge_length: Length::new(0.5).ok(), ..one.clone() };
        let adaptive = RemeshRequest { adaptive: Length::new(0.1).ok(), ..one };
        for wrong in [both, adaptive] {
            assert_eq!(run(wrong).map(|answer| answer.report).unwrap_err(), RemeshError::SeveralSizes);
        }
        let default = run(RemeshRequest::default()).expect("a sphere of about as many faces").report;
        assert_eq!(default.edge_length, Some(default.before.edge_length.mean));
        assert_eq!(default.after.near_target, Some(1.0));
    }

    #[test]
    fn long_thin_faces_become_about_as_many() {
        let run =
            |mesh: &TriMesh| RemeshRequest::default().run(mesh, &RunContext::default()).map(|a| a.report);
        for segments in [64, 256, 1000] {
            let rod = cylinder(1.0, 3.0, segments, 1, Ends::Capped).expect("a rod");
            let report = run(&rod).expect("a mesh");
            let share = report.after.faces as f64 / report.before.faces as f64;
            assert!((0.4..1.0).contains(&share) && !report.is_far, "{segments}: {report:?}");
        }
        // A strip without area: edges are no shorter than a hundredth of the mean.
        let strip = TriMesh::new(
            vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.0, 0.0], [2.0, 0.0, 0.0]],
            vec![[0, 1, 2], [1, 0, 3]],
        );
        let found = usual_length(&strip.expect("a mesh")).expect("a length");
        assert!((found - 0.01).abs() < 1e-12, "{found}");
    }

    #[test]
    fn triangles_that_are_not_as_asked_for_are_said() {
        let report = |mesh: &TriMesh, request: RemeshRequest| {
            request.run(mesh, &RunContext::default()).expect("a mesh").report
        };
        let asked = RemeshRequest { relative: Some(0.1), ..RemeshRequest::default() };
        assert!(!report(&icosphere(1.0, 3).expect("a sphere"), asked.clone()).is_uneven);
        // Within a small distance the long edges of a fine rod stay.
        let rod = cylinder(1.0, 3.0, 200, 1, Ends::Capped).expect("a rod");
        let within = RemeshRequest { within: Length::new(1e-5).ok(), ..asked };
        let found = report(&rod, within);
        assert!(found.is_uneven, "{found:?}");
    }

    #[test]
    fn a_result_far_from_the_input_is_said() {
        let far = |mesh: &TriMesh, within: Option<Length>| {
            let request = RemeshRequest { relative: Some(0.1), within, ..RemeshRequest::default() };
            request.run(mesh, &RunContext::default()).expect("a mesh").report
        };
        let sphere = icosphere(1.0, 3).expect("a sphere");
        assert!(!far(&sphere, None).is_far);
        // A rod a seventh as wide as edges are long.
        let rod = cuboid([20.0, 0.3, 0.3], 4).expect("a rod");
        let report = far(&rod, None);
        assert!(report.is_far && report.volume_share.is_some_and(|share| share < 0.9), "{report:?}");
        assert!(!far(&rod, Length::new(0.1).ok()).is_far, "what was asked for is not too far");
    }
}
