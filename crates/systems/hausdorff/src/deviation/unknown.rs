//! What is said where limits leave no room to look at faces: no distance exceeds the largest.

use super::area;
use super::distribution::Distribution;
use super::entry::{Entry, Moments, Sum};
use super::linear::greater;
use super::options::DeviationOptions;
use super::outcome::Outcome;
use super::packed::Entries;
use super::pieces::Pieces;
use super::portion::Portion;
use super::report::{DeviationWork, DirectedDeviation, FaceDeviation, unreferenced};
use super::statistics::{StatisticsQuery, Summary, length_out};
use crate::report::{DirectedReport, Direction, StopReason};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;

/// The outcome of a direction of which the largest distance is enclosed and nothing else known.
pub(super) fn unknown(
    query: &DeviationOptions<'_>,
    from: &TriMesh,
    frame: &Frame,
    direction: Direction,
    floor: f64,
    distance: DirectedReport,
    stop: StopReason,
) -> Outcome {
    let largest = frame.length_in(distance.distance.upper()).next_up();
    let mut area = Sum::default();
    for face in 0..from.faces().len() as u32 {
        let (low, high) = area::of_face(from, frame, face);
        area.add(low, high);
    }
    let area = area.enclosure();
    let entry = Entry::unknown((area.lower(), area.upper()), largest);
    let moments = Moments::of(std::iter::once(entry));
    let portion = Portion { entries: Entries::Full(vec![entry]), starts: vec![0, 1], moments };
    let asked = StatisticsQuery::of(query, frame);
    let pieces = Pieces::Kept(Distribution { portions: vec![portion] });
    let summary = Summary::of(pieces.measured(), &asked, largest);
    let areas =
        if summary.is_some() { pieces.measured().cumulative(largest, query.bins) } else { Vec::new() };

    let all = length_out(frame, 0.0, largest);
    let mut faces = vec![FaceDeviation { max: all, min: all, mean: all }; from.faces().len()];
    let farthest = &mut faces[distance.witness.from.face.index()].max;
    let lower = frame.length_in(distance.distance.lower());
    *farthest = length_out(frame, greater(lower, 0.0), largest);
    // Each within half of the largest distance of that half.
    let half = 0.5 * all.upper();
    let mut vertices = vec![half; from.positions().len()];
    for vertex in unreferenced(from) {
        vertices[vertex] = f64::NAN;
    }
    let statistics = summary.as_ref().map(|s| s.publish(&areas, &asked, query.threshold, largest, frame));
    let report = DirectedDeviation {
        direction,
        distance,
        statistics,
        signed: None,
        faces,
        vertices,
        vertex_error: half.next_up(),
        sides: None,
        regions: Vec::new(),
        beyond_threshold: Vec::new(),
        floor: frame.length_out(floor),
        stop,
        work: DeviationWork { pieces: 1, ..DeviationWork::default() },
    };
    Outcome { report, pieces, summary, areas, largest }
}
