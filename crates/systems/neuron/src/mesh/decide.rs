//! Deciding whether a skeleton can be meshed, with less work than its mesh takes.
//!
//! Nodes are sketched: improved only until their cells are valid and their walls near the cones. Where the whole mesh is not proven to be as asked,
//! the nodes there are meshed as well as they can be. So what is said about a skeleton that cannot be meshed is what its mesh says; and a mesh that is
//! not as asked takes the sketches there if they are.

use super::build::{Effort, NeuronMesh, Parts, assembled, linear_parts, unfolded_parts};
use super::distance::Wanted;
use super::node_mesh::NodeMesh;
use super::options::{MeshError, MeshOptions, MeshReport, WallDistance};
use crate::Skeleton;
use glam::DVec3;
use pompeiu_core::run::{Control, on_threads};
use std::collections::BTreeSet;

/// Meshes a neuron.
///
/// # Shapes and units
/// Lengths in micrometres. Sections are polygons with the area of the disc. The mesh ends with a flat cap at tips and at roots with
/// one neighbour; a soma, or the end of a branch that lost all others, is round.
/// # Accuracy
/// [`MeshReport::certified`] is proven, rounding included. Tubes of branches that are not adjacent are meshed separately even if
/// they overlap: see [`problems`](crate::problems).
/// # Errors
/// [`MeshError`]: a sample without a radius, nodes that cannot be meshed, memory, a limit on time.
/// # Cost
/// Linear in the length of the tree in radii; about 0.15 s per node, in parallel.
/// # Source
/// The untangling energy: `garanzha_foldover_2021`.
pub fn mesh_neuron(skeleton: &Skeleton, options: &MeshOptions<'_>) -> Result<NeuronMesh, MeshError> {
    options.check()?;
    on_threads(options.limits.threads, || mesh(skeleton, options))
}

fn mesh(skeleton: &Skeleton, options: &MeshOptions<'_>) -> Result<NeuronMesh, MeshError> {
    let control = Control::start(&options.limits);
    let parts = unfolded_parts(skeleton, options, &control)?;
    let mesh = assembled(skeleton, &parts, options.measure.then_some(Wanted::Enclosed), (options, &control))?;
    or_sketched(skeleton, parts, mesh, (options, &control))
}

/// The report of a mesh that is as asked if there is one, and otherwise that of [`mesh_neuron`].
pub(crate) fn decisive_report(
    skeleton: &Skeleton,
    options: &MeshOptions<'_>,
) -> Result<MeshReport, MeshError> {
    options.check()?;
    on_threads(options.limits.threads, || {
        let control = Control::start(&options.limits);
        let mut parts = linear_parts(skeleton, options, Effort::Enough, &control)?;
        let mut wanted = Wanted::Whether;
        loop {
            let mesh = assembled(skeleton, &parts, Some(wanted), (options, &control))?;
            let doubtful = doubtful(skeleton, &parts, &mesh, options, true);
            let is_done = wanted == Wanted::Where || is_as_asked(&mesh.report) == Some(true);
            if doubtful.is_empty() && is_done {
                return Ok(mesh.report);
            }
            parts.replace_nodes(skeleton, &doubtful, Effort::Best, (options, &control))?;
            wanted = Wanted::Where;
        }
    })
}

/// The mesh, or one with sketches of nodes where it is not as asked, if that one is.
fn or_sketched(
    skeleton: &Skeleton,
    mut parts: Parts,
    mesh: NeuronMesh,
    (options, control): (&MeshOptions<'_>, &Control),
) -> Result<NeuronMesh, MeshError> {
    let doubtful = doubtful(skeleton, &parts, &mesh, options, false);
    if !parts.replace_nodes(skeleton, &doubtful, Effort::Sketch, (options, control))? {
        return Ok(mesh);
    }
    let wanted = options.measure.then_some(Wanted::Enclosed);
    let other = assembled(skeleton, &parts, wanted, (options, control))?;
    Ok(if is_as_asked(&other.report) == Some(true) { other } else { mesh })
}

/// Whether all cells are valid and the wall is within the tolerated distance of the cones; `None` if the latter is not decided.
fn is_as_asked(report: &MeshReport) -> Option<bool> {
    if report.certified {
        report.wall.as_ref().map_or(Some(true), WallDistance::is_within)
    } else {
        Some(false)
    }
}

/// The nodes where a mesh is not as asked that are sketches, or that are not.
fn doubtful(
    skeleton: &Skeleton,
    parts: &Parts,
    mesh: &NeuronMesh,
    options: &MeshOptions<'_>,
    are_sketches: bool,
) -> Vec<usize> {
    let report = &mesh.report;
    let is_decided = match is_as_asked(report) {
        Some(true) => return Vec::new(),
        Some(false) => true,
        None => false,
    };
    let unproven: BTreeSet<i32> = report.unproven.iter().map(|cell| mesh.parts[cell.cell]).collect();
    let beyond: BTreeSet<i64> =
        report.wall.iter().flat_map(|wall| &wall.beyond).map(|beyond| beyond.sample).collect();
    let reference = options.reference.unwrap_or(skeleton);
    let places: Vec<(DVec3, f64)> = (0..reference.samples().len())
        .filter(|&k| beyond.contains(&reference.samples()[k].id))
        .map(|k| (reference.samples()[k].position, reach(reference, k)))
        .collect();
    let is_near = |node: &NodeMesh| {
        let first = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = node.positions.iter().fold(first, |(a, b), p| (a.min(*p), b.max(*p)));
        places.iter().any(|(p, reach)| p.distance(p.clamp(low, high)) <= *reach)
    };
    let is_doubtful = |(index, node): (usize, &Option<NodeMesh>)| {
        let node = node.as_ref().filter(|node| node.is_sketch == are_sketches)?;
        let is_unproven = unproven.iter().any(|part| part.unsigned_abs() as usize == index + 1 && *part < 0);
        // Nothing is proven, and nobody knows where.
        let is_anywhere = !is_decided && places.is_empty();
        (is_anywhere || is_unproven || is_near(node)).then_some(index)
    };
    parts.nodes.iter().enumerate().filter_map(is_doubtful).collect()
}

/// A length beyond which no point is next to a sample: to the ends of its cones, and their radii.
fn reach(skeleton: &Skeleton, sample: usize) -> f64 {
    let all = skeleton.samples();
    let neighbours = skeleton.children(sample).iter().copied().chain(skeleton.parent(sample));
    let length = |other: usize| all[other].position.distance(all[sample].position) + 2.0 * all[other].radius;
    neighbours.map(length).fold(2.0 * all[sample].radius, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read_swc;

    const FORK: &str = "1 2 0 0 0 1 -1\n2 2 6 0 0 1 1\n3 2 12 0 0 1 2\n4 2 18 5 0 0.8 3\n5 2 18 -5 2 0.7 3\n";

    fn fork() -> Skeleton {
        Skeleton::new(&read_swc(FORK.as_bytes()).unwrap()).unwrap()
    }

    #[test]
    fn nodes_are_sketched_where_that_decides() {
        let options = MeshOptions::default();
        let parts = linear_parts(&fork(), &options, Effort::Enough, &Control::default()).unwrap();
        assert!(parts.nodes.iter().flatten().all(|node| node.is_sketch));
        assert!(parts.nodes.iter().flatten().count() == 1);
        assert_eq!(is_as_asked(&decisive_report(&fork(), &options).unwrap()), Some(true));
    }

    #[test]
    fn what_is_beyond_is_that_of_the_mesh() {
        for within in [0.02, 0.05, 0.07] {
            let options = MeshOptions { within, ..MeshOptions::default() };
            let [decided, meshed] =
                [decisive_report(&fork(), &options).unwrap(), mesh_neuron(&fork(), &options).unwrap().report];
            assert_eq!(is_as_asked(&decided), is_as_asked(&meshed), "{within}");
            let beyond = |report: MeshReport| report.wall.map(|wall| wall.beyond);
            assert_eq!(beyond(decided), beyond(meshed), "{within}");
        }
    }
}
