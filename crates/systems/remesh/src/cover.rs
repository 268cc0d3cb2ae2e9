//! Which faces of the result lie near which faces of the input.

use super::candidates::Candidates;
use super::connectivity::{DynamicMesh, NONE};
use super::reference::identity;
use super::triangle::Triangle;
use super::within::{Input, is_covered};
use glam::DVec3;
use pompeiu_core::MeshError;
use pompeiu_core::spatial::bvh::{Bvh, Workspace};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Stands for more than one face.
const SEVERAL: u32 = NONE;

/// A collapse leaves something uncovered: the least squared distance at which it would not, as far as is known; 0 where nothing is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Uncovered(pub(crate) f64);

/// Pieces of a face of the input that are looked at until it counts as not covered, and faces of a task.
const MOST_COVERING_PIECES: usize = 4096;
const COVERING_TASK: usize = 1024;

/// Faces of the input that are tried first, for each face that goes.
const TRIED_FIRST: usize = 3;

/// For each face of the input, faces of the result that together come within the distance of all of its points.
///
/// Faces of the input are those of a tree in its order, and vertices in the order in which these name them: what is near in space is near
/// in memory.
pub(crate) struct Cover {
    positions: Vec<[f64; 3]>,
    faces: Vec<[u32; 3]>,
    /// The face of the result that covers each face of the input, or [`SEVERAL`].
    witness: Vec<u32>,
    /// The faces of the result that together cover a face of the input, where these are several.
    several: BTreeMap<u32, Vec<u32>>,
    /// The faces of the input that each face of the result covers, alone or with others.
    covers: Vec<Vec<u32>>,
}

/// The faces of the input that a collapse affects, with the vertices of those, and memory to find them.
#[derive(Default)]
pub(crate) struct Affected {
    faces: Vec<u32>,
    /// Corners of each, as places in `points`.
    corners: Vec<[u32; 3]>,
    /// Whether each is also covered by faces beyond the collapse.
    shared: Vec<bool>,
    points: Vec<[f64; 3]>,
    /// Whether a point belongs to a face that only new faces can cover.
    must: Vec<bool>,
    masks: Vec<u64>,
    /// The point at which the last position failed: it is likely to fail at the next, too.
    last_failed: usize,
    /// Points that are tried first.
    first: Vec<[f64; 3]>,
    candidates: Candidates,
    beyond: Candidates,
    /// By face and by vertex of the input: when it was last found, and at which place.
    found_faces: Vec<u32>,
    found_vertices: Vec<(u32, u32)>,
    search: u32,
}

/// The faces of the input that a collapse affects, each with the faces that would cover it.
#[derive(Debug, Default)]
pub(crate) struct Covering {
    faces: Vec<u32>,
    /// Where the witnesses of each face end in `witnesses`.
    ends: Vec<u32>,
    witnesses: Vec<u32>,
}

impl Covering {
    fn each(&self) -> impl Iterator<Item = (u32, &[u32])> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        let ranges = starts.zip(&self.ends).map(|(from, to)| &self.witnesses[from as usize..*to as usize]);
        self.faces.iter().copied().zip(ranges)
    }

    /// The faces of the result on which it relies.
    pub(crate) fn relies_on(&self) -> &[u32] {
        &self.witnesses
    }
}

/// Faces of the input, each with the faces of the result that cover it.
pub(crate) struct WitnessLists {
    pub(crate) faces: Vec<u32>,
    pub(crate) witnesses: Vec<Vec<u32>>,
}

impl WitnessLists {
    pub(crate) fn each(&self) -> impl Iterator<Item = (u32, &[u32])> {
        self.faces.iter().copied().zip(self.witnesses.iter().map(Vec::as_slice))
    }
}

impl Cover {
    /// Each face covers itself.
    pub(crate) fn new(mesh: &DynamicMesh, bvh: &Bvh) -> Self {
        let mut number = vec![NONE; mesh.positions.len()];
        let mut cover = Self {
            positions: Vec::new(),
            faces: Vec::new(),
            witness: Vec::new(),
            several: BTreeMap::new(),
            covers: vec![Vec::new(); mesh.face_count()],
        };
        for (i, slot) in bvh.slots().enumerate() {
            let face = bvh.face(slot);
            cover.faces.push(mesh.corners(face.0).map(|v| {
                let known = &mut number[v as usize];
                if *known == NONE {
                    *known = cover.positions.len() as u32;
                    cover.positions.push(mesh.positions[v as usize].to_array());
                }
                *known
            }));
            cover.witness.push(face.0);
            cover.covers[face.index()].push(i as u32);
        }
        cover
    }

    /// A surface that is no longer the input covers it within a limit: for each face of the input some of its faces are looked for. None
    /// if one is not covered, as far as is found.
    pub(crate) fn of(
        mesh: &DynamicMesh,
        input: &DynamicMesh,
        bvh: &Bvh,
        limit: f64,
    ) -> Result<Option<Self>, MeshError> {
        let mut cover = Self::new(input, bvh);
        cover.covers = vec![Vec::new(); mesh.origin.len() / 3];
        let faces: Vec<u32> = (0..cover.faces.len() as u32).collect();
        let found = cover.found_on(mesh, &faces, limit * limit)?;
        for (f, by) in (0..).zip(found) {
            if by.is_empty() {
                return Ok(None);
            }
            cover.cover_by(f, by);
        }
        Ok(Some(cover))
    }

    /// Faces of a surface that together cover each of some faces of the input, as far as they are found; none where they are not.
    pub(crate) fn found_on(
        &self,
        mesh: &DynamicMesh,
        faces: &[u32],
        limit_sq: f64,
    ) -> Result<Vec<Vec<u32>>, MeshError> {
        let alive: Vec<u32> = (0..mesh.origin.len() as u32 / 3).filter(|&f| mesh.exists(3 * f)).collect();
        let now = Bvh::build(&mesh.to_mesh()?, &identity());
        let near = Input { bvh: &now, limit_sq };
        let of_task = |faces: &[u32]| -> Vec<Vec<u32>> {
            let (mut workspace, mut start) = (Workspace::default(), now.any_slot());
            let witnesses = |&f: &u32| {
                let mut used = Vec::new();
                let triangle = self.triangle(f);
                if !near.is_covered(triangle, MOST_COVERING_PIECES, &mut start, &mut workspace, &mut used) {
                    return Vec::new();
                }
                used.sort_unstable();
                used.dedup();
                used.iter().map(|slot| alive[now.face(*slot).index()]).collect()
            };
            faces.iter().map(witnesses).collect()
        };
        Ok(faces.par_chunks(COVERING_TASK).flat_map_iter(of_task).collect())
    }

    /// The corners of a face of the input.
    pub(crate) fn triangle(&self, f: u32) -> Triangle {
        self.faces[f as usize].map(|v| DVec3::from_array(self.positions[v as usize]))
    }

    /// The faces of the input that some faces of the result cover, alone or with others.
    pub(crate) fn affected_by(&self, faces: &[u32]) -> Vec<u32> {
        let mut affected: Vec<u32> = faces.iter().flat_map(|&f| &self.covers[f as usize]).copied().collect();
        affected.sort_unstable();
        affected.dedup();
        affected
    }

    /// Covers faces of the input by others than before.
    pub(crate) fn take_over(&mut self, found: WitnessLists) {
        let mut is_new = vec![false; self.faces.len()];
        found.faces.iter().for_each(|&f| is_new[f as usize] = true);
        let mut old: Vec<u32> = found.faces.iter().flat_map(|&f| self.witnesses(f)).copied().collect();
        old.sort_unstable();
        old.dedup();
        for g in old {
            self.covers[g as usize].retain(|&f| !is_new[f as usize]);
        }
        for (f, by) in found.faces.into_iter().zip(found.witnesses) {
            self.several.remove(&f);
            self.cover_by(f, by);
        }
    }

    /// Notes the faces that cover a face of the input.
    fn cover_by(&mut self, f: u32, by: Vec<u32>) {
        for &g in &by {
            self.covers[g as usize].push(f);
        }
        self.witness[f as usize] = if let [one] = by[..] { one } else { SEVERAL };
        if by.len() > 1 {
            self.several.insert(f, by);
        }
    }

    /// The faces of the result that cover a face of the input.
    pub(crate) fn witnesses(&self, f: u32) -> &[u32] {
        match self.witness[f as usize] {
            SEVERAL => self.several.get(&f).map_or(&[], Vec::as_slice),
            _ => &self.witness[f as usize..=f as usize],
        }
    }

    /// How many faces of the input a face of the result covers, alone or with others.
    pub(crate) fn covered_by(&self, face: u32) -> usize {
        self.covers[face as usize].len()
    }

    /// Looks whether the new faces come near some points of what the faces `gone` cover alone: most positions that leave something uncovered are
    /// found out here.
    pub(crate) fn may_cover(
        &self,
        affected: &mut Affected,
        gone: &[u32],
        new: &[Triangle],
        limit_sq: f64,
    ) -> Result<(), Uncovered> {
        affected.candidates.set(new.iter().copied());
        affected.first.clear();
        for &g in gone {
            let covered = &self.covers[g as usize];
            for &f in covered.iter().step_by(covered.len() / TRIED_FIRST + 1) {
                if gone.contains(&self.witness[f as usize]) {
                    affected.first.push(self.positions[self.faces[f as usize][0] as usize]);
                }
            }
        }
        let Affected { first, masks, candidates, .. } = affected;
        masks.resize(first.len().max(masks.len()), 0);
        let all = vec![true; first.len()];
        candidates.near(first, &all, limit_sq, masks).map_err(|i| Uncovered(candidates.distance_sq(first[i])))
    }

    /// Finds what the faces `gone` cover.
    pub(crate) fn find_affected(&self, gone: &[u32], affected: &mut Affected) {
        let Affected { faces, corners, shared, points, must, masks, .. } = affected;
        faces.clear();
        corners.clear();
        shared.clear();
        points.clear();
        must.clear();
        affected.found_faces.resize(self.faces.len(), 0);
        affected.found_vertices.resize(self.positions.len(), (0, 0));
        affected.last_failed = 0;
        affected.search += 1;
        let search = affected.search;
        for &f in gone.iter().flat_map(|&g| &self.covers[g as usize]) {
            if std::mem::replace(&mut affected.found_faces[f as usize], search) == search {
                continue;
            }
            let beyond = self.witnesses(f).iter().any(|g| !gone.contains(g));
            let places = self.faces[f as usize].map(|v| {
                let known = &mut affected.found_vertices[v as usize];
                if known.0 != search {
                    *known = (search, points.len() as u32);
                    points.push(self.positions[v as usize]);
                    must.push(false);
                }
                must[known.1 as usize] |= !beyond;
                known.1
            });
            faces.push(f);
            corners.push(places);
            shared.push(beyond);
        }
        masks.clear();
        masks.resize(points.len(), 0);
    }

    /// Covers anew what [`Cover::find_affected`] found: by the faces `kept`, which would become `new`, and by others as they are.
    pub(crate) fn cover_anew(
        &self,
        mesh: &DynamicMesh,
        affected: &mut Affected,
        gone: &[u32],
        kept: &[u32],
        new: &[Triangle],
        limit_sq: f64,
    ) -> Result<Covering, Uncovered> {
        affected.candidates.set(new.iter().copied());
        affected.find_near(limit_sq)?;
        let mut covering = Covering::default();
        for (i, &f) in affected.faces.iter().enumerate() {
            let corners = affected.corners[i].map(|place| place as usize);
            let near = corners.iter().fold(u64::MAX, |mask, &place| mask & affected.masks[place]);
            if near != 0 {
                covering.witnesses.push(kept[near.trailing_zeros() as usize]);
            } else {
                let triangle = corners.map(|place| DVec3::from_array(affected.points[place]));
                let others = self.witnesses(f).iter().copied().filter(|g| !gone.contains(g));
                let names: Vec<u32> = others.chain(kept.iter().copied()).collect();
                let by = if affected.shared[i] {
                    let beyond = names[..names.len() - kept.len()].iter();
                    let now = beyond.map(|&g| mesh.corners(g).map(|v| mesh.positions[v as usize]));
                    affected.beyond.set(now.chain(new.iter().copied()));
                    &affected.beyond
                } else {
                    &affected.candidates
                };
                let mut used = 0;
                if !is_covered(&triangle, by, limit_sq, &mut used) {
                    // A position beside this one may fail here, too.
                    affected.last_failed = corners[0];
                    return Err(Uncovered(0.0));
                }
                covering.witnesses.extend(bits(used).map(|bit| names[bit]));
            }
            covering.faces.push(f);
            covering.ends.push(covering.witnesses.len() as u32);
        }
        Ok(covering)
    }

    /// Takes over what [`Cover::cover_anew`] found.
    pub(crate) fn replace(&mut self, gone: &[u32], covering: &Covering) {
        for &f in gone {
            self.covers[f as usize].clear();
        }
        for (f, by) in covering.each() {
            let before = self.witness[f as usize];
            let several = if before == SEVERAL { self.several.remove(&f) } else { None };
            let before = several.as_deref().unwrap_or(std::slice::from_ref(&before));
            for &old in before {
                if !gone.contains(&old) && !by.contains(&old) {
                    self.covers[old as usize].retain(|g| *g != f);
                }
            }
            for &new in by {
                if gone.contains(&new) || !before.contains(&new) {
                    self.covers[new as usize].push(f);
                }
            }
            self.witness[f as usize] = if let [one] = *by { one } else { SEVERAL };
            if by.len() > 1 {
                self.several.insert(f, by.to_vec());
            }
        }
    }
}

impl Affected {
    /// Finds which candidates each point is near, unless one is near none of those that may cover it.
    fn find_near(&mut self, limit_sq: f64) -> Result<(), Uncovered> {
        let last = self.last_failed;
        if let (Some(p), Some(must)) = (self.points.get(last), self.must.get(last)) {
            let near = self.candidates.near(&[*p], &[*must], limit_sq, &mut [0]);
            near.map_err(|_| Uncovered(self.candidates.distance_sq(*p)))?;
        }
        match self.candidates.near(&self.points, &self.must, limit_sq, &mut self.masks) {
            Ok(()) => Ok(()),
            Err(failed) => {
                self.last_failed = failed;
                Err(Uncovered(self.candidates.distance_sq(self.points[failed])))
            }
        }
    }
}

/// The places of the bits that are set.
fn bits(mut mask: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = (mask != 0).then(|| mask.trailing_zeros() as usize)?;
        mask &= mask - 1;
        Some(bit)
    })
}
