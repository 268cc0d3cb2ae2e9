//! Remeshing within a distance: what is held, and what is given up again.

use super::Work;
use crate::confined::Confined;
use crate::cover::Cover;
use crate::held::{Held, RISKY, keep_creases, mark_rough, spread};
use crate::isotropic::{LONGEST, finish, iterate};
use crate::marked::Marked;
use crate::near::far_places;
use crate::reference::{Reference, identity};
use crate::remesh_options::RemeshError;
use crate::sizing::Lengths;
use crate::splits::{Flips, split_longer_than};
use pompeiu_core::spatial::bvh::Bvh;

/// Times that edges are held at some places only.
const MOST_ROUNDS: usize = 2;

/// The input is covered in parts whose edges are no longer than this many target lengths.
const COVERED: f64 = 2.0;

/// Share of the input that may be too far from the result if only the edges there are to be held.
const MOST_FAR: f64 = 0.3;

/// Iterations while edges of the input are held.
const HELD: usize = 3;

/// Iterations of the operations that keep the distance, where that was in vain.
const CONFINED: usize = 2;

impl Work<'_> {
    /// Remeshes; where the surface is then farther from the input than a limit, the edges of the input stay, and are given up only by
    /// operations that each keep the limit.
    pub(super) fn come_within(&mut self, limit: f64) -> Result<(), RemeshError> {
        if self.is_rough {
            return self.stay_within(limit, None);
        }
        match self.iterate(self.options.iterations) {
            Ok(()) => {}
            Err(RemeshError::TooManyFacesWithin { .. }) => return self.stay_within(limit, None),
            Err(error) => return Err(error),
        }
        if self.control.is_stopped() {
            return Ok(());
        }
        let mut far = far_places(&self.copy, &self.reference, &self.surface, limit)?;
        if !far.contains(&true) {
            return Ok(());
        }
        spread(&self.copy.mesh, &mut far);
        mark_rough(&self.copy, RISKY * limit, &mut far);
        if far.iter().filter(|far| **far).count() as f64 > MOST_FAR * far.len() as f64 {
            return self.stay_within(limit, None);
        }
        keep_creases(&mut self.copy, &self.options.features, &far);
        self.stay_within(limit, Some(far))
    }

    /// Remeshes with the edges of the input held at some vertices, or at all, then changes what was held by operations that each keep
    /// the surface within a limit, as long as time allows.
    pub(super) fn stay_within(&mut self, limit: f64, marked: Option<Vec<bool>>) -> Result<(), RemeshError> {
        if marked.is_none()
            && let Some(first) = self.first.take()
        {
            self.copy = first;
        }
        let start = self.held_start(limit, marked)?;
        let mut whole = self.copy.clone();
        self.split(&mut whole, COVERED, limit)?;
        if self.control.is_stopped() {
            self.places.settle(&mut whole.mesh);
            self.surface = whole;
            return Ok(());
        }
        let tree = |whole: &Marked| Ok::<_, RemeshError>(Bvh::build(&whole.mesh.to_mesh()?, &identity()));
        let covered = match &start {
            Some((start, _)) => Cover::of(&start.mesh, &whole.mesh, &tree(&whole)?, limit)?,
            None => None,
        };
        let (start, open, cover) = if let (Some((start, open)), Some(cover)) = (start, covered) {
            (start, open, cover)
        } else {
            self.split(&mut whole, LONGEST, limit)?;
            let cover = Cover::new(&whole.mesh, &tree(&whole)?);
            self.places.settle(&mut whole.mesh);
            let all = vec![true; whole.hold.len()];
            (whole, all, cover)
        };
        let mut confined = Confined::new(start, open, cover, &self.reference, self.places, limit);
        let count = self.options.iterations.min(CONFINED);
        for i in 0..count {
            self.report("remeshing within the distance", i as f64 / count as f64);
            if self.control.is_stopped() {
                break;
            }
            self.iterations += 1;
            if !confined.iterate(&self.control)? {
                break;
            }
        }
        self.surface = confined.surface;
        Ok(())
    }

    /// Splits edges longer than this many target lengths, and leaves the surface where it is.
    fn split(&self, surface: &mut Marked, longest: f64, limit: f64) -> Result<(), RemeshError> {
        let most_faces = self.options.most_faces;
        split_longer_than(surface, longest, Flips::in_place(limit), most_faces, &self.control)
            .map_err(|_| self.too_many())
    }

    /// The input remeshed while edges stay at which it bends, with the vertices near these; none if it is not within the limit. The
    /// reference is then the input with its own curves.
    fn held_start(
        &mut self,
        limit: f64,
        mut marked: Option<Vec<bool>>,
    ) -> Result<Option<(Marked, Vec<bool>)>, RemeshError> {
        let lengths = Lengths::AtVertices(self.copy.length.clone());
        self.reference = Reference::new(&self.copy, self.frame, lengths)?;
        self.copy.near = self.reference.slots_at_vertices(self.copy.mesh.positions.len());
        for round in 1.. {
            let mut held = Held::new(&self.copy, limit, marked.as_deref());
            self.reference.keep(&held.surface);
            for _ in 0..self.options.iterations.min(HELD) {
                if self.control.is_stopped() {
                    return Ok(None);
                }
                iterate(&mut held.surface, Some(&self.reference), self.options.most_faces, &self.control)
                    .map_err(|_| self.too_many())?;
            }
            if marked.is_some() {
                finish(&mut held.surface, Some(&self.reference));
            }
            self.places.settle(&mut held.surface.mesh);
            self.reference.keep(&self.copy);
            let mut far = far_places(&self.copy, &self.reference, &held.surface, limit)?;
            if !far.contains(&true) {
                return Ok(Some(held.release()));
            }
            // At some places, at more, at all.
            marked = match marked {
                None => break,
                Some(_) if round == MOST_ROUNDS => None,
                Some(mut marked) => {
                    spread(&self.copy.mesh, &mut far);
                    spread(&self.copy.mesh, &mut far);
                    marked.iter_mut().zip(far).for_each(|(marked, far)| *marked |= far);
                    Some(marked)
                }
            };
        }
        Ok(None)
    }
}
