//! What a mesh of a skeleton cannot do, with the cause.

use super::{Problem, ProblemKind, problems};
use crate::mesh::{Cause, Causes, cells_are, decisive_report};
use crate::{
    BeyondSample, FoldedNode, MeshError, MeshOptions, MeshReport, RoundCone, Skeleton, UnprovenCell,
};
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// Whether a skeleton can be meshed as asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Meshability {
    /// Whether it can: every cell proven valid, and the wall proven to be within the tolerated distance of the cones. `None` if it is not
    /// decided whether the wall is.
    pub meshable: Option<bool>,
    /// What cannot be done; empty unless `meshable` is `Some(false)`.
    pub problems: Vec<Problem>,
}

/// Finds out whether [`mesh_neuron`](crate::mesh_neuron) can mesh a skeleton with the same options, and where and why it cannot.
///
/// # Definition
/// A mesh is made whose nodes are only improved until they are valid and near the cones, and as well as they can be where it is not as asked.
/// A skeleton is meshable if there is a mesh whose cells are all proven valid and whose wall is proven to be within
/// [`MeshOptions::within`] of the cones. Otherwise there is a problem for each node whose cells stay folded, and one for each cause of
/// samples beyond the tolerance, at the worst of them: a branch that is too short and left out, one that turns too sharply, two that
/// overlap, a node, or none of these.
/// # Errors
/// [`MeshError`] for invalid options and limits.
/// # Cost
/// Less than that of the mesh, unless there is none.
pub fn meshability(skeleton: &Skeleton, options: &MeshOptions<'_>) -> Result<Meshability, MeshError> {
    let finding = Finding { skeleton, options };
    let refused = |problems| Meshability { meshable: Some(false), problems };
    match decisive_report(skeleton, &MeshOptions { measure: true, ..options.clone() }) {
        Ok(report) => Ok(finding.of_report(&report)),
        Err(MeshError::Nodes(nodes)) => Ok(refused(finding.of_nodes(&nodes))),
        Err(error @ MeshError::NoBranch) => {
            let first = skeleton.samples()[0];
            let place = (first.id, first.line);
            Ok(refused(vec![problem(ProblemKind::NoBranch, place, [0.0, 1.0], error.to_string())]))
        }
        Err(MeshError::ZeroRadius { .. }) => {
            let all = problems(skeleton).into_iter();
            Ok(refused(all.filter(|problem| problem.kind == ProblemKind::ZeroRadius).collect()))
        }
        Err(error) => Err(error),
    }
}

fn problem(kind: ProblemKind, (sample, line): (i64, usize), values: [f64; 2], message: String) -> Problem {
    let [value, limit] = values;
    Problem {
        kind,
        branch: None,
        sample,
        line,
        other_branch: None,
        other_sample: None,
        value,
        limit,
        message,
    }
}

/// What samples beyond the tolerance have in common.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    LeftOut([usize; 2]),
    Turn([usize; 2]),
    Overlap([usize; 2]),
    Node(usize),
    None,
}

struct Finding<'f> {
    skeleton: &'f Skeleton,
    options: &'f MeshOptions<'f>,
}

impl Finding<'_> {
    fn of_nodes(&self, nodes: &[FoldedNode]) -> Vec<Problem> {
        let causes = Causes::new(self.skeleton, self.options.parts);
        let samples = self.skeleton.samples();
        let of_node = |node: &FoldedNode| {
            let sample = samples.iter().position(|sample| sample.id == node.sample);
            let apart = match sample.and_then(|sample| causes.node_at(sample)) {
                Some(Cause::Node { angle: Some(angle), .. }) => {
                    format!("; its nearest branches are {angle:.0}° apart")
                }
                _ => String::new(),
            };
            let values = [node.quality, 0.0];
            problem(ProblemKind::Node, (node.sample, node.line), values, format!("{node}{apart}"))
        };
        nodes.iter().map(of_node).collect()
    }

    fn of_report(&self, report: &MeshReport) -> Meshability {
        let mut problems: Vec<Problem> =
            report.unproven.iter().take(1).map(|cell| of_cells(report, cell)).collect();
        let within = report.wall.as_ref().map_or(Some(true), crate::WallDistance::is_within);
        if let (Some(wall), Some(false)) = (&report.wall, within) {
            problems.extend(self.of_wall(&wall.beyond));
        }
        let meshable = if problems.is_empty() { within } else { Some(false) };
        Meshability { meshable, problems }
    }

    /// For each sample of the file, by its number, that of the skeleton which is meshed: itself, or the nearest one if it was moved.
    fn places(&self) -> BTreeMap<i64, usize> {
        let meshed = self.skeleton.samples();
        let Some(file) = self.options.reference else {
            return meshed.iter().enumerate().map(|(k, sample)| (sample.id, k)).collect();
        };
        let nearest = |p: DVec3| {
            let distance = |k: &usize| meshed[*k].position.distance_squared(p);
            (0..meshed.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
        };
        file.samples().iter().filter_map(|sample| Some((sample.id, nearest(sample.position)?))).collect()
    }

    /// One problem for each cause, at the sample that is farthest.
    fn of_wall(&self, beyond: &[BeyondSample]) -> Vec<Problem> {
        let places = self.places();
        let causes = Causes::new(self.skeleton, self.options.parts);
        let overlaps = Overlaps::new(self.skeleton);
        let mut groups: Vec<(Group, Option<Cause>, Vec<&BeyondSample>)> = Vec::new();
        for place in beyond {
            let sample = places.get(&place.sample).copied();
            let cause = sample.and_then(|sample| causes.at(sample));
            let group = match cause {
                Some(Cause::LeftOut { ends, .. }) => Group::LeftOut(ends),
                Some(Cause::Turn { ends, .. }) => Group::Turn(ends),
                _ => match (sample.and_then(|sample| overlaps.at(sample)), cause) {
                    (Some(pair), _) => Group::Overlap(pair),
                    (None, Some(Cause::Node { sample, .. })) => Group::Node(sample),
                    _ => Group::None,
                },
            };
            match groups.iter_mut().find(|(other, ..)| *other == group) {
                Some((.., places)) => places.push(place),
                None => groups.push((group, cause, vec![place])),
            }
        }
        groups.into_iter().map(|(group, cause, places)| self.of_group(group, cause, &places)).collect()
    }

    fn of_group(&self, group: Group, cause: Option<Cause>, places: &[&BeyondSample]) -> Problem {
        let worst = places[0];
        let id = |sample: usize| self.skeleton.samples()[sample].id;
        let (kind, why) = match (group, cause) {
            (Group::Overlap([a, b]), _) if a == b => {
                (ProblemKind::Overlap, format!("branch {a} runs into itself"))
            }
            (Group::Overlap([a, b]), _) => (ProblemKind::Overlap, format!("branches {a} and {b} overlap")),
            (_, Some(Cause::LeftOut { ends, length })) => {
                let [a, b] = ends.map(id);
                let why =
                    format!("the branch from sample {a} to {b}, {length:.4} long, ends too near to its node");
                (ProblemKind::TooShort, why)
            }
            (_, Some(Cause::Turn { ends, moved })) => {
                let [a, b] = ends.map(id);
                let why = format!(
                    "the branch from sample {a} to {b} turns too sharply, so that its axis is moved by up to {moved:.2} radii"
                );
                (ProblemKind::SharpTurn, why)
            }
            (_, Some(Cause::Node { sample, arms, angle })) => {
                let angle = angle.map_or(String::new(), |angle| format!(", the nearest {angle:.0}° apart"));
                let branches = if arms == 1 { "branch" } else { "branches" };
                let why = format!("the node at sample {} has {arms} {branches}{angle}", id(sample));
                (ProblemKind::Node, why)
            }
            (_, None) => (ProblemKind::Wall, "the tube is not followed".to_owned()),
        };
        let others = match places.len() - 1 {
            0 => String::new(),
            1 => ", and farther than tolerated at 1 more sample".to_owned(),
            n => format!(", and farther than tolerated at {n} more samples"),
        };
        let within = self.options.within;
        let message = format!(
            "{why}: the wall would be {:.4} µm, {:.3} radii off at sample {}{others}",
            worst.distance, worst.radii, worst.sample
        );
        let mut found = problem(kind, (worst.sample, worst.line), [worst.radii, within], message);
        if let Group::Overlap([a, b]) = group {
            (found.branch, found.other_branch) = (Some(a), Some(b));
        }
        found
    }
}

fn of_cells(report: &MeshReport, worst: &UnprovenCell) -> Problem {
    let place = (worst.sample.unwrap_or_default(), worst.line.unwrap_or_default());
    let folded = report.folded();
    let (count, what) =
        if folded > 0 { (folded, "folded") } else { (report.unproven.len(), "not proven valid") };
    let cells = cells_are(count);
    let message = format!("{cells} {what}, with a scaled Jacobian of {:.3}", worst.scaled_jacobian);
    problem(ProblemKind::Cells, place, [worst.scaled_jacobian, 0.0], message)
}

/// Branches that overlap, with the cones of each.
struct Overlaps<'o> {
    skeleton: &'o Skeleton,
    branches: Vec<Vec<usize>>,
    pairs: BTreeSet<[usize; 2]>,
}

impl<'o> Overlaps<'o> {
    fn new(skeleton: &'o Skeleton) -> Self {
        let pair = |problem: Problem| {
            matches!(problem.kind, ProblemKind::Overlap | ProblemKind::Inside)
                .then(|| Some([problem.branch?, problem.other_branch?]))
                .flatten()
        };
        let pairs = problems(skeleton).into_iter().filter_map(pair).collect();
        Self { skeleton, branches: skeleton.branches(), pairs }
    }

    /// The pair of branches of which one has the sample, whose ball overlaps the other.
    fn at(&self, sample: usize) -> Option<[usize; 2]> {
        let samples = self.skeleton.samples();
        let ball = |k: usize| (samples[k].position, samples[k].radius);
        let (centre, radius) = ball(sample);
        let touches = |branch: usize| {
            self.branches[branch].windows(2).any(|ends| {
                let [(a, ra), (b, rb)] = [ball(ends[0]), ball(ends[1])];
                RoundCone { ends: [a, b], radii: [ra, rb] }.distance(centre).0 < radius
            })
        };
        let on = |branch: usize| self.branches[branch].contains(&sample);
        let meets = |&&[a, b]: &&[usize; 2]| (on(a) && touches(b)) || (on(b) && touches(a));
        self.pairs.iter().find(meets).copied()
    }
}
