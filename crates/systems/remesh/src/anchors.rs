//! Vertices that are held where a surface on its way would lose parts of the input.
//!
//! Where the surface is narrower than edges are long, such as at the tip of a cone, edges around it are too short, and collapse. Each
//! time the surface ends at the next ring of vertices, and nothing leads it back: the nearest point of the input is on the side of the
//! cone, not at its tip.

use super::marked::{Hold, Marked};
use super::samples::{Sample, reached};
use super::triangle::keeps_normal;
use glam::DVec3;
use pompeiu_core::MeshError;

/// Distance from which a vertex is put where the surface does not reach, in target lengths.
const FAR: f64 = 0.25;

/// Least distance between such vertices, in target lengths.
const APART: f64 = 0.8;

/// Vertices that are held at points of the input.
pub(super) struct Anchors<'s> {
    samples: &'s [Sample],
    positions: Vec<DVec3>,
    /// The vertices, with what holds them otherwise.
    vertices: Vec<(u32, Hold)>,
}

impl<'s> Anchors<'s> {
    pub(super) fn new(samples: &'s [Sample]) -> Self {
        Self { samples, positions: Vec::new(), vertices: Vec::new() }
    }

    /// Moves vertices to samples that the surface does not reach, the farthest first, and holds them there.
    pub(super) fn hold_far(&mut self, surface: &mut Marked) -> Result<(), MeshError> {
        let found = reached(surface, self.samples)?;
        let mut far: Vec<(f64, usize)> = found
            .iter()
            .zip(self.samples)
            .map(|(found, sample)| found.distance / sample.length)
            .enumerate()
            .filter(|(_, share)| *share > FAR)
            .map(|(i, share)| (share, i))
            .collect();
        far.sort_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
        // Also those where no vertex could be moved keep others at a distance, until the next time.
        let mut tried = self.positions.clone();
        for (_, i) in far {
            let sample = &self.samples[i];
            let least = APART * sample.length;
            if tried.iter().all(|p| p.distance_squared(sample.position) >= least * least) {
                tried.push(sample.position);
                self.hold(surface, sample, found[i].face);
            }
        }
        Ok(())
    }

    /// Moves the nearest vertex of a face that can be moved.
    fn hold(&mut self, surface: &mut Marked, sample: &Sample, mut face: [u32; 3]) {
        let distance = |v: u32| surface.mesh.positions[v as usize].distance_squared(sample.position);
        face.sort_by(|v, w| distance(*v).total_cmp(&distance(*w)));
        let Some(v) = face.into_iter().find(|&v| may_move(surface, v, sample)) else { return };
        let i = v as usize;
        self.positions.push(sample.position);
        self.vertices.push((v, surface.hold[i]));
        surface.mesh.positions[i] = sample.position;
        surface.hold[i] = Hold::Corner;
        (surface.near[i], surface.length[i]) = (sample.near, sample.length);
    }

    /// Lets the vertices move again.
    pub(super) fn release(self, surface: &mut Marked) {
        for (v, hold) in self.vertices {
            surface.hold[v as usize] = hold;
        }
    }
}

/// Whether a vertex is held by what holds a sample, and no face turns over when it moves there.
fn may_move(surface: &Marked, v: u32, sample: &Sample) -> bool {
    surface.hold[v as usize] == sample.hold
        && surface.mesh.halfedges_from(v).all(|h| {
            let old = surface.triangle(h / 3);
            let mut new = old;
            new[(h % 3) as usize] = sample.position;
            keeps_normal(old, new)
        })
}
