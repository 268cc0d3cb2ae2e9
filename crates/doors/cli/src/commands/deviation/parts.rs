//! Which faces are measured, and what is left out.

use super::full::percentage;
use crate::interrupt;
use crate::lengths::{Length, length};
use crate::numbers::{grouped, share, tuple};
use anyhow::{Context, bail};
use clap::Args;
use pompeiu::core::run::Limits;
use pompeiu::core::{FaceId, TriMesh};
use pompeiu::hausdorff::deviation::{DeviationOptions, LeftOut, Part, component_shares, overlapping};
use pompeiu::hausdorff::{Observer, Progress};
use pompeiu::io::Group;
use std::ops::ControlFlow;

#[derive(Args)]
pub(crate) struct Parts {
    /// Leave out the faces of both that reach farther than this from the other mesh: what has no counterpart, such as a
    /// fixture, or what was not scanned. What is kept is proven to be within
    #[arg(long, value_parser = length, allow_negative_numbers = true, value_name = "LENGTH")]
    ignore_beyond: Option<Length>,
    /// Leave out the faces beside the other mesh: those whose nearest point lies on its boundary, as of the part of a model
    /// that a partial scan does not show
    #[arg(long)]
    only_overlap: bool,
    /// Measure only faces that lie in this box as a whole: its least and its greatest coordinates
    #[arg(long = "box", value_parser = tuple::<6>, allow_hyphen_values = true, value_name = "X,Y,Z,X,Y,Z")]
    within: Option<[f64; 6]>,
    /// Measure only faces of this group or object of OBJ, or node of glTF; of several with the option given again. A mesh that has no group
    /// of any of these names is measured whole
    #[arg(long, value_name = "NAME")]
    group: Vec<String>,
    /// Leave out connected parts with less than this share of the area of their mesh, such as 0.001 or 0.1%
    #[arg(long, value_parser = share, value_name = "SHARE")]
    ignore_components: Option<f64>,
}

/// The parts of both meshes that are measured.
pub(super) type Chosen = [Part; 2];

impl Parts {
    fn is_empty(&self) -> bool {
        self.ignore_beyond.is_none()
            && !self.only_overlap
            && self.within.is_none()
            && self.ignore_components.is_none()
            && self.group.is_empty()
    }

    /// The faces of both that are measured; none if that is all of them because nothing was asked.
    pub(super) fn choose(
        &self,
        [a, b]: [&TriMesh; 2],
        groups: [&[Group]; 2],
        unit: &str,
        limits: &Limits,
    ) -> anyhow::Result<Option<Chosen>> {
        if self.is_empty() {
            return Ok(None);
        }
        let beyond = self.ignore_beyond.as_ref().map(|length| length.in_unit(unit)).transpose()?;
        if !self.group.is_empty() && !groups.iter().any(|groups| self.names_any(groups)) {
            bail!("neither file has a group {}{}", quoted(&self.group), known(groups));
        }
        let choose = |name: &str, mesh: &TriMesh, groups: &[Group], other: &TriMesh| {
            self.part(mesh, groups, other, beyond, limits)?
                .with_context(|| format!("nothing of {name} is left to be measured"))
        };
        Ok(Some([choose("A", a, groups[0], b)?, choose("B", b, groups[1], a)?]))
    }

    fn names_any(&self, groups: &[Group]) -> bool {
        groups.iter().any(|group| self.group.contains(&group.name))
    }

    fn part(
        &self,
        mesh: &TriMesh,
        groups: &[Group],
        other: &TriMesh,
        beyond: Option<f64>,
        limits: &Limits,
    ) -> anyhow::Result<Option<Part>> {
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
        if let Some(ends) = self.within {
            let inside = |p: [f64; 3]| (0..3).all(|k| ends[k] <= p[k] && p[k] <= ends[k + 3]);
            keep(&|face| mesh.corners(face).into_iter().all(inside));
        }
        if self.only_overlap {
            let over = overlapping(mesh, other);
            keep(&|face| over[face.index()]);
        }
        let Some(part) = Part::of(mesh, |face| kept[face.index()]) else { return Ok(None) };
        let Some(beyond) = beyond else { return Ok(Some(part)) };
        let options =
            DeviationOptions { limits: limits.clone(), observer: Some(&Stop), ..DeviationOptions::default() };
        Ok(options.within(&part, mesh, other, beyond)?)
    }
}

fn quoted(names: &[String]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(" or ")
}

/// Most names of groups that an error lists.
const MOST_NAMES: usize = 20;

/// What groups there are.
fn known(groups: [&[Group]; 2]) -> String {
    let mut names: Vec<&str> = Vec::new();
    for group in groups.into_iter().flatten() {
        if names.len() < MOST_NAMES && !names.contains(&group.name.as_str()) {
            names.push(&group.name);
        }
    }
    if names.is_empty() { "; they have none".to_owned() } else { format!("; there are {}", names.join(", ")) }
}

/// Ends the work on Ctrl-C.
struct Stop;

impl Observer for Stop {
    fn progress(&self, _: &Progress) -> ControlFlow<()> {
        interrupt::flow()
    }
}

/// What is left out of a mesh, for people.
pub(super) fn described(name: &str, left_out: &LeftOut) -> String {
    if left_out.faces == 0 {
        return format!("nothing of {name}");
    }
    let parts = match left_out.components {
        1 => "1 connected part".to_owned(),
        n => format!("{} connected parts", grouped(n as u64)),
    };
    let faces = match left_out.faces {
        1 => "1 face".to_owned(),
        n => format!("{} faces", grouped(n as u64)),
    };
    format!("{} of {name}'s area, {faces} in {parts}", percentage(left_out.share))
}
