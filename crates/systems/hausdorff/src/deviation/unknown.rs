//! What is said where limits leave no room to look at faces: what is known from a few points, or that no distance exceeds the largest.

use super::area;
use super::clusters::Clusters;
use super::distribution::Distribution;
use super::entry::{Entry, MORE, Moments};
use super::linear::greater;
use super::options::DeviationOptions;
use super::outcome::Outcome;
use super::packed::Entries;
use super::pieces::Pieces;
use super::portion::Portion;
use super::report::{DeviationWork, DirectedDeviation, FaceDeviation};
use super::statistics::{StatisticsQuery, Summary, length_out};
use crate::report::{DirectedReport, Direction, StopReason};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;
use rayon::prelude::*;

/// What is known of a direction when limits end it.
pub(super) struct Known {
    pub(super) distance: DirectedReport,
    pub(super) clusters: Option<Clusters>,
    pub(super) stop: StopReason,
}

/// The outcome of a direction of which the largest distance is enclosed and nothing else known, or what a few points say.
pub(super) fn unknown(
    query: &DeviationOptions<'_>,
    from: &TriMesh,
    frame: &Frame,
    direction: Direction,
    floor: f64,
    Known { distance, clusters, stop }: Known,
) -> Outcome {
    let farthest = clusters.as_ref().map(|clusters| frame.length_out(clusters.largest).next_up());
    let distance = distance.at_most(farthest);
    let largest = frame.length_in(distance.distance.upper()).next_up();
    let (portions, ends) = match clusters {
        Some(Clusters { portions, faces, .. }) => (portions, faces),
        None => (vec![of_all(from, frame, largest)], vec![(0.0, largest); from.faces().len()]),
    };
    let asked = StatisticsQuery::of(query, frame);
    let pieces = Pieces::Kept(Distribution { portions });
    let summary = Summary::of(pieces.measured(), &asked, largest);
    let areas =
        if summary.is_some() { pieces.measured().cumulative(largest, query.bins) } else { Vec::new() };

    let of_face = |(low, high): &(f64, f64)| {
        let all = length_out(frame, *low, *high);
        FaceDeviation { max: all, min: all, mean: all }
    };
    let mut faces: Vec<FaceDeviation> = ends.par_iter().map(of_face).collect();
    let farthest = &mut faces[distance.witness.from.face.index()].max;
    let lower = frame.length_in(distance.distance.lower());
    *farthest = length_out(frame, greater(lower, 0.0), largest);
    let (vertices, vertex_error) = vertices_of(from, frame, &ends);
    let statistics = summary.as_ref().map(|s| s.publish(&areas, &asked, query.threshold, largest, frame));
    let report = DirectedDeviation {
        direction,
        distance,
        statistics,
        signed: None,
        faces,
        vertices,
        vertex_error,
        sides: None,
        regions: Vec::new(),
        beyond_threshold: Vec::new(),
        floor: frame.length_out(floor),
        stop,
        work: DeviationWork { pieces: pieces.len(), ..DeviationWork::default() },
    };
    Outcome { report, pieces, summary, areas, largest }
}

/// One entry for all faces.
fn of_all(from: &TriMesh, frame: &Frame, largest: f64) -> Portion {
    let area = area::of_mesh(from, frame).enclosure();
    let entry = Entry::constant((area.lower(), area.upper()), (0.0, largest));
    let moments = Moments::of(std::iter::once(entry));
    Portion { entries: Entries::Full(vec![entry]), starts: vec![0, 1], moments }
}

/// For each vertex of a face the middle between the ends of one of its faces, and half of the widest.
fn vertices_of(from: &TriMesh, frame: &Frame, ends: &[(f64, f64)]) -> (Vec<f64>, f64) {
    let mut vertices = vec![f64::NAN; from.positions().len()];
    let mut error = 0.0;
    for (corners, (low, high)) in from.faces().iter().zip(ends) {
        error = greater(error, 0.5 * (high - low));
        for v in corners {
            vertices[*v as usize] = frame.length_out(0.5 * (low + high));
        }
    }
    // The middle and its distance from both ends are rounded.
    (vertices, frame.length_out(error) * MORE + f64::MIN_POSITIVE)
}
