//! A result whose faces do not intersect where those of the input do not.

use super::Work;
use crate::guard::{IntersectionCount, Intersections, Intersects};
use crate::marked::Marked;
use crate::remesh_options::RemeshError;
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::spatial::self_intersections;

/// Where faces of the result would intersect that of the input do not, it stays within the first of these shares of the least target
/// length, and of the distance asked for, with which they do not.
const NEAR: [f64; 3] = [0.05, 0.005, 0.0005];

/// It is remeshed again with nothing held within these distances of places where faces intersect, in target lengths.
const BESIDE: [f64; 2] = [1.0, 3.0];

/// Places that are taken note of at a time, at most.
const MOST_PLACES: usize = 256;

/// A mesh, with the number of pairs of its faces that intersect.
type Checked = (TriMesh, Option<IntersectionCount>);

impl Work<'_> {
    /// The mesh in its own place, with the number of pairs of faces that intersect. Where these are new, or more, and are to be refused, it
    /// is made again with less held, then near to the input, which leaves sheets apart from each other.
    pub(super) fn result(&mut self) -> Result<Checked, RemeshError> {
        let mut found = self.checked()?;
        if self.options.intersections.after(self.control.reason()) != Intersections::RefuseNew {
            return Ok(found?);
        }
        if self.options.within.is_none() && is_worse(&found) {
            found = self.apart(found)?;
        }
        let shortest =
            self.surface.length.iter().fold(f64::INFINITY, |least, &l| if l < least { l } else { least });
        let within = self.options.within.map_or(shortest, |d| self.frame.length_in(d));
        for share in NEAR {
            if found.is_ok() {
                break;
            }
            self.stay_within(share * if within < shortest { within } else { shortest }, None)?;
            found = self.checked()?;
        }
        Ok(found?)
    }

    /// Remeshes again with nothing held where faces intersect, and takes what has the fewest such pairs.
    fn apart(
        &mut self,
        first: Result<Checked, Intersects>,
    ) -> Result<Result<Checked, Intersects>, RemeshError> {
        let mut best: (Result<Checked, Intersects>, Marked) = (first, self.surface.clone());
        for beside in BESIDE {
            if !is_worse(&best.0) || self.control.is_stopped() {
                break;
            }
            let found = self_intersections(&self.surface.mesh.to_mesh()?, MOST_PLACES);
            self.avoided.places.extend(found.pairs.iter().map(|pair| DVec3::from_array(pair.place)));
            self.avoided.beside = beside;
            self.surface = self.copy.clone();
            self.iterate(self.options.iterations)?;
            best = self.better(best)?;
        }
        if is_worse(&best.0)
            && let Some(unimproved) = self.unimproved.take()
        {
            self.surface = unimproved;
            best = self.better(best)?;
        }
        self.surface = best.1;
        Ok(best.0)
    }

    /// The surface if it has fewer pairs of faces that intersect than another one, which otherwise stays.
    fn better(
        &self,
        best: (Result<Checked, Intersects>, Marked),
    ) -> Result<(Result<Checked, Intersects>, Marked), RemeshError> {
        let found = self.checked()?;
        Ok(if pairs(&found) < pairs(&best.0) { (found, self.surface.clone()) } else { best })
    }

    /// The surface as a mesh, unless its faces intersect and must not.
    fn checked(&self) -> Result<Result<Checked, Intersects>, RemeshError> {
        let mut result = self.surface.mesh.clone();
        self.places.bring_out(&mut result);
        let mesh = result.to_mesh()?;
        let guard = self.options.intersections.after(self.control.reason());
        Ok(guard.of(&mesh, self.input).map(|count| (mesh, count)))
    }
}

/// Whether more pairs of faces intersect than of the input.
fn is_worse(found: &Result<Checked, Intersects>) -> bool {
    match found {
        Ok((_, count)) => count.is_some_and(|count| count.is_more()),
        Err(_) => true,
    }
}

/// The number of pairs of faces that intersect.
fn pairs(found: &Result<Checked, Intersects>) -> usize {
    match found {
        Ok((_, count)) => count.map_or(0, |count| count.pairs),
        Err(error) => error.pairs,
    }
}
