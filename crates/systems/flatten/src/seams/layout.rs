//! A surface that is divided into charts by seams, and changes of its seams.

use super::potential::{Curvature, Potential};
use pompeiu_core::mesh::VertexData;
use pompeiu_core::{FaceId, VertexId};
use pompeiu_solve::SolveError;
use pompeiu_surface::{EdgeData, EdgeId, Surface, SurfaceMesh};

/// A chart: its faces and its potential.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    pub(super) faces: Vec<FaceId>,
    pub(super) potential: Potential,
}

/// A set of seams, and the disks between them.
pub(super) struct Layout<'s> {
    pub(super) surface: &'s Surface,
    pub(super) lengths: EdgeData<f64>,
    curvature: Curvature<'s>,
    pub(super) seams: EdgeData<bool>,
    /// Number of seam edges at each vertex.
    pub(super) degrees: VertexData<u32>,
    /// The chart of each face.
    pub(super) chart_of: Vec<u32>,
    /// Charts by their numbers, which are not used again: two charts with one number are the same.
    charts: Vec<Option<Patch>>,
}

/// Charts that replace others.
struct Replacement {
    replaced: Vec<u32>,
    patches: Vec<Patch>,
    excess: f64,
}

/// A change of seams, and what it would lead to.
pub(super) struct Trial {
    changed: Vec<EdgeId>,
    replaced: Vec<u32>,
    patches: Vec<Patch>,
    /// What is added to the excess.
    pub(super) excess: f64,
    /// What is added to the length of the seams.
    pub(super) length: f64,
}

impl Trial {
    /// Whether there are more charts than before.
    pub(super) fn divides(&self) -> bool {
        self.patches.len() > self.replaced.len()
    }
}

/// What a change replaced.
pub(super) struct Before {
    changed: Vec<EdgeId>,
    replaced: Vec<(u32, Patch)>,
    charts: usize,
}

impl<'s> Layout<'s> {
    pub(super) fn new(surface: &'s Surface, seams: EdgeData<bool>) -> Result<Self, SolveError> {
        let mesh = surface.mesh();
        let mut degrees = VertexData::filled(mesh.vertices(), 0);
        for edge in mesh.edge_ids().filter(|&edge| seams[edge]) {
            for v in mesh.ends(edge) {
                degrees[v] += 1;
            }
        }
        let mut layout = Self {
            surface,
            lengths: surface.edge_lengths(),
            curvature: Curvature::new(surface),
            seams,
            degrees,
            chart_of: vec![u32::MAX; mesh.faces()],
            charts: Vec::new(),
        };
        for faces in layout.connected(&mesh.face_ids().collect::<Vec<_>>()) {
            let patch = layout.patch(faces)?;
            layout.add(patch);
        }
        Ok(layout)
    }

    pub(super) fn mesh(&self) -> &'s SurfaceMesh {
        self.surface.mesh()
    }

    /// The numbers of the charts.
    pub(super) fn charts(&self) -> Vec<u32> {
        (0..self.charts.len() as u32).filter(|&i| self.charts[i as usize].is_some()).collect()
    }

    pub(super) fn chart(&self, number: u32) -> Option<&Patch> {
        self.charts.get(number as usize).and_then(Option::as_ref)
    }

    /// The excess of all charts.
    pub(super) fn excess(&self) -> f64 {
        self.charts.iter().flatten().map(|patch| patch.potential.excess).sum()
    }

    /// Whether a vertex lies on an outline.
    pub(super) fn is_fixed(&self, v: VertexId) -> bool {
        self.degrees[v] > 0 || self.mesh().is_boundary_vertex(v)
    }

    /// Whether an edge lies on an outline.
    pub(super) fn is_side(&self, edge: EdgeId) -> bool {
        self.seams[edge] || self.mesh().is_boundary_edge(edge)
    }

    /// What the seams would be with some edges the other way round: those of `opened` are seams then, those of `closed` are not. None if
    /// a chart would not be a disk.
    pub(super) fn trial(
        &mut self,
        opened: &[EdgeId],
        closed: &[EdgeId],
    ) -> Result<Option<Trial>, SolveError> {
        let mut changed: Vec<EdgeId> = Vec::new();
        let mut length = 0.0;
        for (edges, is_seam) in [(closed, false), (opened, true)] {
            for &edge in edges {
                if self.seams[edge] != is_seam {
                    changed.push(edge);
                    self.flip(edge);
                    length += if is_seam { self.lengths[edge] } else { -self.lengths[edge] };
                }
            }
        }
        // An edge that was closed and opened again is as it was.
        let found = self.patches(&changed);
        for &edge in changed.iter().rev() {
            self.flip(edge);
        }
        Ok(found?.map(|Replacement { replaced, patches, excess }| Trial {
            changed,
            replaced,
            patches,
            excess,
            length,
        }))
    }

    /// The charts beside some edges that were changed, those that replace them, and what they add to the excess.
    fn patches(&self, changed: &[EdgeId]) -> Result<Option<Replacement>, SolveError> {
        let mesh = self.mesh();
        let mut replaced: Vec<u32> = Vec::new();
        for &edge in changed {
            let h = mesh.edge_halfedge(edge);
            replaced.push(self.chart_of[h.face().index()]);
            replaced.extend(mesh.twin(h).map(|t| self.chart_of[t.face().index()]));
        }
        replaced.sort_unstable();
        replaced.dedup();
        let of = |number: &u32| self.chart(*number).map_or(&[][..], |patch| &patch.faces[..]);
        let faces: Vec<FaceId> = replaced.iter().flat_map(of).copied().collect();
        let parts = self.connected(&faces);
        if !parts.iter().all(|part| self.is_disk(part)) {
            return Ok(None);
        }
        let patches: Vec<Patch> = parts.into_iter().map(|part| self.patch(part)).collect::<Result<_, _>>()?;
        let excess = |patch: &Patch| patch.potential.excess;
        let before: f64 = replaced.iter().filter_map(|&number| self.chart(number)).map(excess).sum();
        let added = patches.iter().map(excess).sum::<f64>() - before;
        Ok(Some(Replacement { replaced, patches, excess: added }))
    }

    /// Changes the seams; the result is for [`Self::restore`].
    pub(super) fn accept(&mut self, trial: Trial) -> Before {
        for &edge in &trial.changed {
            self.flip(edge);
        }
        let charts = self.charts.len();
        let replaced = trial.replaced.into_iter().filter_map(|n| Some((n, self.charts[n as usize].take()?)));
        let before = Before { changed: trial.changed, replaced: replaced.collect(), charts };
        for patch in trial.patches {
            self.add(patch);
        }
        before
    }

    /// Takes the last change back.
    pub(super) fn restore(&mut self, before: Before) {
        for &edge in before.changed.iter().rev() {
            self.flip(edge);
        }
        self.charts.truncate(before.charts);
        for (number, patch) in before.replaced {
            for face in &patch.faces {
                self.chart_of[face.index()] = number;
            }
            self.charts[number as usize] = Some(patch);
        }
    }

    fn flip(&mut self, edge: EdgeId) {
        let is_seam = !self.seams[edge];
        self.seams[edge] = is_seam;
        for v in self.mesh().ends(edge) {
            self.degrees[v] = if is_seam { self.degrees[v] + 1 } else { self.degrees[v] - 1 };
        }
    }

    fn add(&mut self, patch: Patch) {
        for face in &patch.faces {
            self.chart_of[face.index()] = self.charts.len() as u32;
        }
        self.charts.push(Some(patch));
    }

    fn patch(&self, faces: Vec<FaceId>) -> Result<Patch, SolveError> {
        let potential = self.curvature.potential(&faces, |v| self.is_fixed(v))?;
        Ok(Patch { faces, potential })
    }

    /// The parts of a set of whole charts that no seam divides, each in the order of its faces.
    fn connected(&self, faces: &[FaceId]) -> Vec<Vec<FaceId>> {
        let mesh = self.mesh();
        let mut seen = vec![false; mesh.faces()];
        let mut parts = Vec::new();
        for &first in faces {
            if std::mem::replace(&mut seen[first.index()], true) {
                continue;
            }
            let mut part = vec![first];
            let mut at = 0;
            while let Some(&face) = part.get(at) {
                at += 1;
                for h in SurfaceMesh::face_halfedges(face) {
                    if let Some(t) = mesh.twin(h).filter(|_| !self.seams[mesh.edge(h)])
                        && !std::mem::replace(&mut seen[t.face().index()], true)
                    {
                        part.push(t.face());
                    }
                }
            }
            part.sort_unstable();
            parts.push(part);
        }
        parts
    }

    /// Whether the faces between seams form a disk: connected as they are, by their Euler characteristic.
    fn is_disk(&self, faces: &[FaceId]) -> bool {
        let mesh = self.mesh();
        let sides = faces.iter().flat_map(|&face| SurfaceMesh::face_halfedges(face));
        let sides = sides.filter(|&h| self.is_side(mesh.edge(h))).count();
        let mut inner: Vec<VertexId> =
            faces.iter().flat_map(|&face| mesh.face(face)).filter(|&v| !self.is_fixed(v)).collect();
        inner.sort_unstable();
        inner.dedup();
        // As many vertices as sides lie on the outline, and three times the faces is twice the edges less the sides.
        2 * inner.len() + sides == faces.len() + 2
    }
}

#[cfg(test)]
mod tests {
    use super::super::routes::routes;
    use super::*;
    use pompeiu_core::mesh::shapes::torus;
    use pompeiu_surface::EmbeddedSurface;

    /// What is known of charts after changes is what is found anew, and what is taken back is as it was.
    #[test]
    fn changes_add_up() {
        let torus = EmbeddedSurface::new(&torus(2.0, 0.7, 24, 16).unwrap()).unwrap();
        let surface = torus.surface();
        let cut = crate::choose_cut(&torus, &crate::CutOptions::default()).unwrap();
        let mut layout = Layout::new(surface, cut.clone()).unwrap();
        let again = |layout: &Layout<'_>| {
            let anew = Layout::new(surface, layout.seams.clone()).unwrap();
            assert_eq!(anew.charts().len(), layout.charts().len());
            assert_eq!(anew.degrees, layout.degrees);
            assert!((anew.excess() / layout.excess() - 1.0).abs() < 1e-12);
        };
        let first = layout.excess();
        let mut divided = 0;
        for _ in 0..6 {
            let charts = layout.charts();
            for route in routes(&layout, charts[0]) {
                let before = layout.excess();
                let Some(trial) = layout.trial(&route, &[]).unwrap() else { continue };
                let (excess, of_faces) = (trial.excess, layout.chart_of.clone());
                let undo = layout.accept(trial);
                assert!((layout.excess() - before - excess).abs() < 1e-12 * first);
                again(&layout);
                layout.restore(undo);
                assert_eq!(layout.chart_of, of_faces);
                again(&layout);
            }
            let route = routes(&layout, charts[0]).swap_remove(0);
            if let Some(trial) = layout.trial(&route, &[]).unwrap() {
                divided += usize::from(trial.divides());
                layout.accept(trial);
            }
        }
        assert!(divided > 0 && layout.excess() < 0.5 * first);
        // Without its first cut it is no disk.
        let cut: Vec<EdgeId> = cut.entries().filter(|(_, is_cut)| **is_cut).map(|(edge, _)| edge).collect();
        let mut whole = Layout::new(surface, layout.seams.clone()).unwrap();
        let others: Vec<EdgeId> = layout.seams.entries().filter(|(_, s)| **s).map(|(edge, _)| edge).collect();
        assert!(whole.trial(&[], &others).unwrap().is_none() && cut.len() < others.len());
    }
}
