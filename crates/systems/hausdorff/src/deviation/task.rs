//! Some faces of A, cut one after the other, and what their pieces say.

use super::area;
use super::bounds::FaceBounds;
use super::corners::Start;
use super::criterion::Criterion;
use super::distribution::add_part_up_to;
use super::entry::{Entry, Moments, Sum};
use super::face::Cutter;
use super::grid::SharedGrids;
use super::measure::VertexDistances;
use super::packed::Entries;
use super::polygon::Piece;
use super::portion::Portion;
use super::signed::{Recorded, SignedFace, Signs};
use crate::rounding::Rounding;
use pompeiu_core::geom::Frame;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Neighbours, Slot};
use pompeiu_core::{FaceId, TriMesh};
use std::ops::Range;
use std::sync::Mutex;

/// Faces of A, and B.
pub(super) struct Faces<'f> {
    pub(super) mesh: &'f TriMesh,
    pub(super) frame: &'f Frame,
    pub(super) vertices: &'f VertexDistances,
    pub(super) bvh: &'f Bvh,
    pub(super) neighbours: Option<&'f Neighbours>,
    pub(super) rounding: Rounding,
    pub(super) control: &'f Control,
    /// No distance is greater.
    pub(super) largest: f64,
    /// About how far most of the surface is away.
    pub(super) scale: f64,
    /// Whether entries that are kept are packed.
    pub(super) packed: bool,
    /// What tells inside from outside, if that is wanted.
    pub(super) signs: Option<&'f Signs<'f>>,
    /// Cutters that no task uses, with what they remember of B, and memory for entries.
    pub(super) idle: Mutex<Vec<(Cutter<'f>, Entries)>>,
}

impl<'f> Faces<'f> {
    /// Cuts faces into cells first, or looks closely at all of them.
    pub(super) fn cutter(&self, cells: bool) -> Cutter<'f> {
        let neighbours = self.neighbours.filter(|_| cells);
        Cutter::new(self.bvh, neighbours, self.rounding, self.control, self.largest, self.scale)
    }

    pub(super) fn start(&self, face: u32) -> (Start, (f64, f64)) {
        let corners = self.mesh.corners(FaceId(face)).map(|p| self.frame.map(p));
        let area = area::of_face(self.mesh, self.frame, face);
        let vertices = self.mesh.faces()[face as usize].map(|v| v as usize);
        let start = Start {
            corners,
            area: 0.5 * (area.0 + area.1),
            distances: vertices.map(|v| self.vertices.distances[v]),
            near: vertices.map(|v| self.vertices.near[v]),
        };
        (start, area)
    }

    /// Cuts the wanted ones of some faces; of the others, and of those that come out no narrower, what was before stays.
    pub(super) fn cut_task(
        &self,
        faces: &[u32],
        criterion: &Criterion,
        most: usize,
        wanted: impl Fn(usize) -> bool,
        before: Option<(&Portion, &[FaceBounds])>,
    ) -> Made {
        let (mut cutter, mut entries) = self.idle_cutter();
        let (looks, distances) = (cutter.looks, cutter.distances());
        let mut starts = vec![0];
        let mut moments = Moments::default();
        let mut bounds = Vec::with_capacity(faces.len());
        let mut recorded = Recorded::default();
        for (i, &face) in faces.iter().enumerate() {
            let start = entries.len();
            let known = before.map(|(portion, bounds)| (portion, portion.places(i), bounds[face as usize]));
            let mut keep = known.clone();
            let mut sums = Moments::default();
            let mut of_face = FaceBounds::unknown([0.0; 3], Slot::default(), self.largest);
            if known.is_none() || wanted(i) {
                let from = self.cut_face(&mut cutter, face, criterion, most, |entry| {
                    recorded.push(sums.include(&entry));
                    entries.push(&entry);
                });
                let signed = self.signed(&cutter, face, &from, &sums, &mut recorded);
                of_face = FaceBounds { signed, ..self.bounds(&cutter, &sums, &from) };
                // What limits have cut short may be wider than what was known.
                let is_narrower = |(portion, places, _): &(&Portion, Range<usize>, FaceBounds)| {
                    let excess = |entries: &Entries, places| criterion.excess(entries.range(places));
                    excess(&portion.entries, places.clone()) < excess(&entries, start..entries.len())
                };
                keep = known.filter(is_narrower);
            }
            if let Some((portion, places, known)) = keep {
                entries.truncate(start);
                sums = Moments::of(portion.entries.range(places.clone()));
                entries.extend_from(&portion.entries, places);
                bounds.push(known);
            } else {
                bounds.push(of_face);
            }
            moments = moments.plus(sums);
            starts.push(entries.len() as u32);
        }
        let portion = Portion { entries: entries.clone(), starts, moments };
        let (looks, distances) = (cutter.looks - looks, cutter.distances() - distances);
        self.leave(cutter, entries);
        Made { portion, bounds, looks, distances }
    }

    /// Cuts faces, and hands all of their entries at once to what sums them up; the area up to a level is summed up by itself.
    pub(super) fn sum_task(
        &self,
        faces: &[u32],
        criterion: &Criterion,
        most: usize,
        grids: &SharedGrids,
        level: Option<f64>,
    ) -> Summed {
        let (mut cutter, unused) = self.idle_cutter();
        let (looks, distances) = (cutter.looks, cutter.distances());
        let mut entries = Vec::new();
        let mut moments = Moments::default();
        let mut up_to = Sum::default();
        let mut bounds = Vec::with_capacity(faces.len());
        let mut recorded = Recorded::default();
        for &face in faces {
            let mut sums = Moments::default();
            let start = self.cut_face(&mut cutter, face, criterion, most, |entry| {
                recorded.push(sums.include(&entry));
                if let Some(level) = level {
                    add_part_up_to(&mut up_to, &entry, level);
                }
                entries.push(entry);
            });
            let signed = self.signed(&cutter, face, &start, &sums, &mut recorded);
            bounds.push(FaceBounds { signed, ..self.bounds(&cutter, &sums, &start) });
            moments = moments.plus(sums);
        }
        grids.add(&entries);
        let (looks, distances) = (cutter.looks - looks, cutter.distances() - distances);
        self.leave(cutter, unused);
        Summed { moments, up_to, entries: entries.len(), bounds, looks, distances }
    }

    fn cut_face(
        &self,
        cutter: &mut Cutter<'_>,
        face: u32,
        criterion: &Criterion,
        most: usize,
        mut take: impl FnMut(Entry),
    ) -> Start {
        let (from, area) = self.start(face);
        cutter.cut(&from, criterion, most);
        for Piece { polygon, .. } in &cutter.pieces {
            for triangle in polygon.outline.fan() {
                take(Entry::new(polygon, triangle, area));
            }
        }
        from
    }

    /// What is known of the face that was cut last, by its pieces and its corners.
    fn bounds(&self, cutter: &Cutter<'_>, sums: &Moments, start: &Start) -> FaceBounds {
        let mut bounds = FaceBounds::new(cutter, sums, self.largest);
        for i in 0..3 {
            let lower = start.distances[i] - self.rounding.bound(0);
            bounds.max.know_point(lower, start.corners[i], start.near[i]);
        }
        bounds
    }

    /// Signed distances of the face that was cut last, of whose entries integrals are recorded.
    fn signed(
        &self,
        cutter: &Cutter<'_>,
        face: u32,
        start: &Start,
        sums: &Moments,
        recorded: &mut Recorded,
    ) -> Option<SignedFace> {
        let corners = self.mesh.faces()[face as usize];
        let signed = self.signs.map(|signs| signs.of_face(cutter, corners, start, sums, recorded));
        recorded.clear();
        signed
    }

    /// A cutter that no task uses.
    pub(super) fn idle_cutter(&self) -> (Cutter<'f>, Entries) {
        let idle = self.idle.lock().map_or(None, |mut idle| idle.pop());
        let (mut cutter, entries) = idle.unwrap_or_else(|| (self.cutter(true), Entries::new(self.packed)));
        cutter.begin_task();
        (cutter, entries)
    }

    pub(super) fn leave(&self, cutter: Cutter<'f>, mut entries: Entries) {
        entries.truncate(0);
        if let Ok(mut idle) = self.idle.lock() {
            idle.push((cutter, entries));
        }
    }
}

/// What was summed up of the pieces of some faces.
pub(super) struct Summed {
    pub(super) moments: Moments,
    /// The area up to the level that was asked for.
    pub(super) up_to: Sum,
    pub(super) entries: usize,
    pub(super) bounds: Vec<FaceBounds>,
    pub(super) looks: u64,
    pub(super) distances: u64,
}

/// Pieces of some faces.
pub(super) struct Made {
    pub(super) portion: Portion,
    pub(super) bounds: Vec<FaceBounds>,
    pub(super) looks: u64,
    pub(super) distances: u64,
}
