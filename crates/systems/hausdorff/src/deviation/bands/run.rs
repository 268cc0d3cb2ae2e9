//! The classes of all faces of both surfaces.

use super::super::area;
use super::super::boundary::Boundary;
use super::super::connected::Entering;
use super::super::inside::Scratch;
use super::super::linear::{greater, lesser};
use super::super::report::{Deviation, DirectedDeviation};
use super::super::statistics::share_of;
use super::super::task::Faces;
use super::cut::Cutting;
use super::share::{Reach, Sign, Tally};
use super::side::SideOf;
use super::{BandReport, Bands, DirectedBands, Extreme};
use crate::deviation::frame_of;
use crate::engine::bytes_to_start;
use crate::observer::{Observer, Progress};
use crate::prepared::PreparedPair;
use crate::report::{Direction, Enclosure, StopReason};
use glam::DVec3;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::mesh::first_at_position;
use pompeiu_core::run::Instant;
use pompeiu_core::run::{Control, Limits, on_threads};
use pompeiu_core::spatial::morton_order;
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::Mutex;

/// Faces of a task, and tasks between two looks at the limits.
const TASK: usize = 16;
const TASKS_PER_ROUND: usize = 64;
/// At most this part of a face is allowed to stay in doubt.
const MOST_DOUBT: f64 = 0.5;
/// Part of the doubt that is asked for that cutting aims at.
const SPARE: f64 = 0.5;
/// Distances up to so many units of rounding may be zero.
const TOUCHING: f64 = 8.0;

impl Deviation {
    /// How much of both surfaces lies in which tolerance band, on which side. `a` and `b` must be the meshes that were measured.
    ///
    /// Shares are narrowed to `accuracy`, absolutely. Time and threads of the limits are kept; shares hold, wider, when they end the
    /// work, or when the observer does.
    ///
    /// # Accuracy
    /// All points of all faces count, and rounding is accounted for. Faces that lie in one class as a whole are not cut. A part that
    /// does not meet the other surface lies on one side of it if that is closed; beside an open one the change of the winding number over
    /// the part is bounded. Where the side is not known for certain, both are reckoned with.
    pub fn bands(
        &self,
        a: &TriMesh,
        b: &TriMesh,
        bands: &Bands,
        accuracy: f64,
        limits: &Limits,
        observer: Option<&dyn Observer>,
    ) -> BandReport {
        self.bands_of(&PreparedPair::for_one_question(a, b), bands, accuracy, limits, observer)
    }

    /// The same of the prepared pair that was measured
    /// ([`DeviationOptions::symmetric_of`](crate::DeviationOptions::symmetric_of)), whose trees are used again.
    pub fn bands_of(
        &self,
        pair: &PreparedPair<'_>,
        bands: &Bands,
        accuracy: f64,
        limits: &Limits,
        observer: Option<&dyn Observer>,
    ) -> BandReport {
        on_threads(limits.threads, || {
            let now = Instant::now();
            let until = |part: u32| limits.time.and_then(|time| now.checked_add(time / part));
            let observer = observer.unwrap_or(&());
            let question = |part| Question { bands, accuracy, limits, deadline: until(part), observer };
            BandReport {
                edges: bands.edges().to_vec(),
                a_to_b: question(2).ask(&self.a_to_b, pair),
                b_to_a: question(1).ask(&self.b_to_a, pair),
            }
        })
    }
}

struct Question<'q> {
    bands: &'q Bands,
    accuracy: f64,
    limits: &'q Limits,
    deadline: Option<Instant>,
    observer: &'q dyn Observer,
}

impl Question<'_> {
    fn ask(&self, found: &DirectedDeviation, pair: &PreparedPair<'_>) -> DirectedBands {
        let (mesh, other) = (pair.measured(found.direction), pair.other(found.direction));
        let (frame, _, rounding) = frame_of(mesh, other);
        let control = Control::start(self.limits).until(self.deadline);
        control.check_memory(bytes_to_start(mesh, other));
        let Some(target) = pair.target_unless_stopped(found.direction, frame, &control) else {
            return self.unknown(found, other, &control);
        };
        let order = morton_order(mesh, &Aabb::of_faces(mesh));
        let Some(vertices) = pair.vertices(found.direction, &order, &target, &control) else {
            return self.unknown(found, other, &control);
        };
        let neighbours = target.neighbours_in(other);
        let other = target.surface(other);
        let largest = frame.length_in(found.distance.distance.upper()).next_up();
        let faces = Faces {
            mesh,
            frame: &frame,
            vertices: &vertices,
            bvh: target.bvh(),
            neighbours: Some(neighbours),
            rounding,
            control: &control,
            largest,
            scale: largest,
            packed: false,
            signs: None,
            idle: Mutex::default(),
        };
        let edges = self.bands.edges().iter().map(|edge| frame.length_in(*edge)).collect();
        let bands = Bands { edges };
        let sides = SideOf::new(other, (target.bvh(), &frame), rounding, &control);
        let mut cutting = Cutting {
            faces: &faces,
            sides: &sides,
            bands: &bands,
            inside_is_positive: found.direction == Direction::AToB,
            touching: TOUCHING * rounding.bound(0),
            allowed: MOST_DOUBT,
            floor: frame.length_in(found.floor),
        };
        let reaches: Vec<Reach> = found.faces.iter().map(|face| reach(&frame, face.min, face.max)).collect();
        let signs = Self::signs(&cutting, &reaches);

        // Whole faces first; the others are cut, neighbours together.
        let mut sum = Tally::new(&bands);
        let mut to_cut = Vec::new();
        let mut area_to_cut = 0.0;
        let mut total = 0.0;
        for &face in &order {
            let (reach, sign) = (&reaches[face as usize], signs[face as usize]);
            let area = area::of_face(mesh, &frame, face);
            total += area.1;
            if let Some(class) = reach.class(sign, &bands) {
                sum.reach(reach, sign);
                sum.whole(class, area);
            } else {
                to_cut.push(face);
                area_to_cut += area.1;
            }
        }
        if area_to_cut > 0.0 {
            cutting.allowed = lesser(SPARE * self.accuracy * total / area_to_cut, MOST_DOUBT);
        }
        self.cut_all(&cutting, found, &to_cut, (&reaches, &signs), &mut sum);
        self.publish(&sum, &frame, sides.is_closed(), control.reason())
    }

    /// What is said where limits leave no room to look at faces: no deviation is greater than the largest distance.
    fn unknown(&self, found: &DirectedDeviation, other: &TriMesh, control: &Control) -> DirectedBands {
        let largest = found.distance.distance.upper();
        let anywhere = Extreme { lower: -largest, upper: largest };
        let classes = self.bands.edges().len() + 1;
        DirectedBands {
            lowest: anywhere,
            highest: anywhere,
            shares: found.statistics.as_ref().map(|_| vec![share_of((0.0, 1.0)); classes]),
            closed: Boundary::new(other, &frame_of(other, other).0).is_empty(),
            stop: control.reason().unwrap_or(StopReason::Time),
        }
    }

    /// The signs of faces as a whole, where classes depend on them.
    fn signs(cutting: &Cutting<'_>, reaches: &[Reach]) -> Vec<Sign> {
        let mesh = cutting.faces.mesh;
        let is_wanted = |face: usize| {
            reaches[face].least.0 > cutting.touching
                && reaches[face].class(Sign::Unknown, cutting.bands).is_none()
        };
        let inside = |face: usize, scratch: &mut Scratch| {
            let corners = mesh.corners(FaceId(face as u32)).map(|p| cutting.faces.frame.map(p));
            let centre = [0, 1, 2].map(|k| (corners[0][k] + corners[1][k] + corners[2][k]) * (1.0 / 3.0));
            let away = |p: &[f64; 3]| DVec3::from_array(*p).distance(DVec3::from_array(centre));
            let radius = corners.iter().map(away).fold(cutting.touching, greater);
            let near = cutting.faces.vertices.near[mesh.faces()[face][0] as usize];
            cutting.sign_of(cutting.sides.side(centre, radius, near, scratch).known())
        };
        let count = reaches.len();
        if !cutting.sides.is_closed() {
            return (0..count)
                .into_par_iter()
                .map_init(Scratch::default, |scratch, face| {
                    if is_wanted(face) { inside(face, scratch) } else { Sign::Unknown }
                })
                .collect();
        }
        // Faces that touch each other and not the other surface lie on one side of it.
        let place = first_at_position(mesh.positions());
        let mut entering = Entering::new(mesh, &place);
        let clear = |face: &u32| reaches[*face as usize].least.0 > cutting.touching;
        for face in (0..count as u32).filter(clear) {
            entering.enter(face, face);
        }
        let mut known = vec![None; count];
        let mut scratch = Scratch::default();
        (0..count)
            .map(|face| {
                if !is_wanted(face) {
                    return Sign::Unknown;
                }
                let first = entering.first(face as u32) as usize;
                *known[first].get_or_insert_with(|| inside(first, &mut scratch))
            })
            .collect()
    }

    fn cut_all(
        &self,
        cutting: &Cutting<'_>,
        found: &DirectedDeviation,
        to_cut: &[u32],
        (reaches, signs): (&[Reach], &[Sign]),
        sum: &mut Tally,
    ) {
        let control = cutting.faces.control;
        let mut left = to_cut.len();
        for round in to_cut.chunks(TASK * TASKS_PER_ROUND) {
            let of_task = |task: &[u32]| {
                let faces = cutting.faces;
                let (mut cutter, entries) = faces.idle_cutter();
                let mut sum = Tally::new(cutting.bands);
                for &face in task {
                    let (reach, sign) = (&reaches[face as usize], signs[face as usize]);
                    if control.is_stopped() {
                        sum.reach(reach, sign);
                        let area = area::of_face(faces.mesh, faces.frame, face);
                        sum.anywhere(reach.range(sign), cutting.bands, area);
                    } else {
                        sum.add(&cutting.face(&mut cutter, face, reach, sign));
                    }
                }
                faces.leave(cutter, entries);
                sum
            };
            let made: Vec<Tally> = round.par_chunks(TASK).with_max_len(1).map(of_task).collect();
            for of_task in &made {
                sum.add(of_task);
            }
            left -= round.len();
            let ends = [found.distance.distance.lower(), found.distance.distance.upper()];
            let examined = (to_cut.len() - left) as u64;
            let progress = Progress::new(found.direction, ends, examined, left as u64);
            if self.observer.progress(&progress) == ControlFlow::Break(()) {
                control.stop(StopReason::Cancelled);
            }
        }
    }

    fn publish(&self, sum: &Tally, frame: &Frame, closed: bool, reason: Option<StopReason>) -> DirectedBands {
        let area = sum.area.enclosure();
        let share = |class: &super::super::entry::Sum| {
            let part = class.enclosure();
            if part.upper() == 0.0 {
                return share_of((0.0, 0.0));
            }
            let share = part.divide_by_positive(area);
            share_of((lesser(share.lower(), 1.0), share.upper()))
        };
        let shares = (area.lower() > 0.0).then(|| sum.classes.iter().map(share).collect::<Vec<_>>());
        let is_narrow = |share: &Enclosure| share.upper() - share.lower() <= self.accuracy;
        let stop = match reason {
            Some(reason) => reason,
            None if shares.iter().flatten().all(is_narrow) => StopReason::Tolerance,
            None => StopReason::Stalled,
        };
        let extreme = |(low, high): (f64, f64)| {
            let [lower, upper] = [low, high].map(|x| frame.length_out(x));
            Extreme { lower, upper }
        };
        DirectedBands { lowest: extreme(sum.lowest), highest: extreme(sum.highest), shares, closed, stop }
    }
}

fn reach(frame: &Frame, min: Enclosure, max: Enclosure) -> Reach {
    let ends =
        |enclosure: Enclosure| (frame.length_in(enclosure.lower()), frame.length_in(enclosure.upper()));
    let (least, greatest) = (ends(min), ends(max));
    Reach { least: (lesser(least.0, greatest.1), lesser(least.1, greatest.1)), greatest, unsigned: 0.0 }
}
