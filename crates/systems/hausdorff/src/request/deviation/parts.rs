//! Which faces are measured, and what is left out.

use super::DeviationRequestError;
use crate::deviation::{DeviationOptions, Part, component_shares};
use crate::{Direction, Observer, PreparedPair};
use pompeiu_core::geom::Aabb;
use pompeiu_core::request::Length;
use pompeiu_core::run::{Control, Limits, on_threads};
use pompeiu_core::{FaceId, TriMesh};
use std::ops::Range;

#[cfg(feature = "clap")]
use pompeiu_core::request::values::{share, tuple};

/// Consecutive faces that have a name in the file of a mesh. Names may repeat, and faces may have several.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedFaces {
    /// The name.
    pub name: String,
    /// The faces.
    pub faces: Range<usize>,
}

/// Which faces are measured, to the other mesh as a whole.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MeasuredParts {
    /// Leave out what of both is farther than this from the other mesh: what has no counterpart, such as a fixture, or what was not scanned;
    /// faces that reach farther are cut, and what is kept is proven to be within.
    #[cfg_attr(feature = "clap", arg(long, allow_negative_numbers = true, value_name = "LENGTH"))]
    pub ignore_beyond: Option<Length>,
    /// Leave out what of both lies beside the other mesh, as of the part of a model that a partial scan does not show: the points from
    /// which its boundary is no more than a quarter farther away than its surface; faces that reach beside are cut.
    #[cfg_attr(feature = "clap", arg(long))]
    pub only_overlap: bool,
    /// Measure only what lies in this box, given by its least and its greatest coordinates; faces that reach out of it are cut.
    #[cfg_attr(
        feature = "clap",
        arg(id = "box", long = "box", value_parser = tuple::<6>, allow_hyphen_values = true, value_name = "X,Y,Z,X,Y,Z")
    )]
    #[cfg_attr(feature = "serde", serde(rename = "box"))]
    pub bounds: Option<[f64; 6]>,
    /// Measure only faces of this group or object of OBJ, or node of glTF; of several with the option given again; a mesh that has no group of
    /// any of these names is measured whole.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME"))]
    pub group: Vec<String>,
    /// Leave out connected parts with less than this share of the area of their mesh, such as 0.001.
    #[cfg_attr(feature = "clap", arg(long, value_parser = share, value_name = "SHARE"))]
    pub ignore_components: Option<f64>,
}

/// Most names of groups that an error lists.
const MOST_NAMES: usize = 20;

impl MeasuredParts {
    /// Whether everything is measured.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Whether the options make sense.
    pub(super) fn check(&self, unit: &str) -> Result<(), DeviationRequestError> {
        self.ignore_beyond.as_ref().map(|length| length.of(unit, 1.0)).transpose()?;
        match self.ignore_components {
            Some(share) if !(share > 0.0 && share <= 1.0) => Err(DeviationRequestError::Component(share)),
            _ => Ok(()),
        }
    }

    /// The faces of both that are measured; none if that is all of them because nothing was asked.
    pub(super) fn choose(
        &self,
        pair: &PreparedPair<'_>,
        groups: [&[NamedFaces]; 2],
        unit: &str,
        limits: &Limits,
        observer: &dyn Observer,
    ) -> Result<Option<[Part; 2]>, DeviationRequestError> {
        if self.is_empty() {
            return Ok(None);
        }
        if !self.group.is_empty() && !groups.iter().any(|groups| self.names_any(groups)) {
            return Err(self.unknown_group(groups));
        }
        let diagonal = Aabb::of_faces(pair.a()).union(Aabb::of_faces(pair.b())).diagonal();
        let beyond = self.ignore_beyond.as_ref().map(|length| length.of(unit, diagonal)).transpose()?;
        let options = DeviationOptions {
            limits: limits.clone(),
            observer: Some(observer),
            ..DeviationOptions::default()
        };
        let choose = |name, direction, mesh: &TriMesh, groups: &[NamedFaces]| {
            let part = self.kept(mesh, groups);
            let part = part.and_then(|part| match self.bounds {
                Some(bounds) => part.in_box(mesh, bounds),
                None => Some(part),
            });
            let part = part.and_then(|part| {
                if !self.only_overlap {
                    return Some(part);
                }
                let control = Control::start(limits);
                on_threads(limits.threads, || part.over_until(pair, direction, &control))
            });
            let part = match (part, beyond) {
                (Some(part), Some(length)) => options.within(&part, pair, direction, length)?,
                (part, _) => part,
            };
            part.ok_or(DeviationRequestError::NothingLeft(name))
        };
        let a = choose("A", Direction::AToB, pair.a(), groups[0])?;
        let b = choose("B", Direction::BToA, pair.b(), groups[1])?;
        Ok(Some([a, b]))
    }

    fn names_any(&self, groups: &[NamedFaces]) -> bool {
        groups.iter().any(|group| self.group.contains(&group.name))
    }

    fn unknown_group(&self, groups: [&[NamedFaces]; 2]) -> DeviationRequestError {
        let mut known: Vec<String> = Vec::new();
        for group in groups.into_iter().flatten() {
            if known.len() < MOST_NAMES && !known.contains(&group.name) {
                known.push(group.name.clone());
            }
        }
        DeviationRequestError::Group { names: self.group.clone(), known }
    }

    /// The faces of which something is kept, wherever they lie.
    fn kept(&self, mesh: &TriMesh, groups: &[NamedFaces]) -> Option<Part> {
        let mut kept = vec![true; mesh.faces().len()];
        let mut keep = |wanted: &dyn Fn(FaceId) -> bool| {
            for (face, kept) in mesh.face_ids().zip(&mut kept) {
                *kept &= wanted(face);
            }
        };
        if self.names_any(groups) {
            let mut named = vec![false; mesh.faces().len()];
            for group in groups.iter().filter(|group| self.group.contains(&group.name)) {
                named[group.faces.clone()].fill(true);
            }
            keep(&|face| named[face.index()]);
        }
        if let Some(least) = self.ignore_components {
            let shares = component_shares(mesh);
            keep(&|face| shares[face.index()] >= least);
        }
        Part::of(mesh, |face| kept[face.index()])
    }
}
