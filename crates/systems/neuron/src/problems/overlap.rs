//! Tubes that intersect where they should not.

use super::{Problem, ProblemKind};
use crate::{RoundCone, Sample, Skeleton};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// A cone of a branch.
struct Link {
    branch: usize,
    /// Its index in the branch, from the parent's end.
    place: usize,
    /// Length along the branch to its first end, and its own length.
    before: f64,
    length: f64,
    cone: RoundCone,
}

/// The deepest overlap of two branches: depth, and the link of each.
struct Deepest {
    depth: f64,
    links: [usize; 2],
}

pub(super) fn problems(skeleton: &Skeleton, branches: &[Vec<usize>]) -> Vec<Problem> {
    let links = links(skeleton, branches);
    let mut found = inside(skeleton, branches);
    let covered: Vec<[usize; 2]> = found
        .iter()
        .filter_map(|problem| Some([problem.branch?, problem.other_branch?]))
        .flat_map(|[a, b]| [[a, b], [b, a]])
        .collect();
    for ([a, b], deepest) in pairs(&clusters(skeleton, branches), branches, &links) {
        if covered.contains(&[a, b]) {
            continue;
        }
        let [first, second] = deepest.links.map(|link| branches[links[link].branch][links[link].place + 1]);
        let samples = skeleton.samples();
        let depth = deepest.depth;
        let message = if a == b {
            format!(
                "branch {a} runs into itself at samples {} and {}, {depth:.4} deep",
                samples[first].id, samples[second].id
            )
        } else {
            format!(
                "branches {a} and {b} overlap at samples {} and {}, {depth:.4} deep",
                samples[first].id, samples[second].id
            )
        };
        let other = (b, Some(samples[second].id));
        found.push(of_pair(ProblemKind::Overlap, (a, &samples[first]), other, [depth, 0.0], message));
    }
    found
}

/// A defect of two branches: its sample on each, the measured value and its limit.
fn of_pair(
    kind: ProblemKind,
    (branch, sample): (usize, &Sample),
    (other_branch, other_sample): (usize, Option<i64>),
    [value, limit]: [f64; 2],
    message: String,
) -> Problem {
    let (branch, other_branch) = (Some(branch), Some(other_branch));
    let (sample, line) = (sample.id, sample.line);
    Problem { kind, branch, sample, line, other_branch, other_sample, value, limit, message }
}

fn links(skeleton: &Skeleton, branches: &[Vec<usize>]) -> Vec<Link> {
    let samples = skeleton.samples();
    let mut links = Vec::new();
    for (branch, path) in branches.iter().enumerate() {
        let mut before = 0.0;
        for (place, ends) in path.windows(2).enumerate() {
            let [a, b] = [samples[ends[0]], samples[ends[1]]];
            let length = a.position.distance(b.position);
            let cone = RoundCone { ends: [a.position, b.position], radii: [a.radius, b.radius] };
            links.push(Link { branch, place, before, length, cone });
            before += length;
        }
    }
    links
}

/// The nodes at both ends of each branch; nodes with overlapping balls are identified.
fn clusters(skeleton: &Skeleton, branches: &[Vec<usize>]) -> Vec<[usize; 2]> {
    let samples = skeleton.samples();
    let mut leader: Vec<usize> = (0..samples.len()).collect();
    // Parents come first, so the representative of the first end is final.
    for branch in branches {
        let (a, b) = (branch[0], branch[branch.len() - 1]);
        if samples[a].position.distance(samples[b].position) <= samples[a].radius + samples[b].radius {
            leader[b] = leader[a];
        }
    }
    branches.iter().map(|branch| [leader[branch[0]], leader[branch[branch.len() - 1]]]).collect()
}

/// The pairs of branches that overlap where they should not, by a sweep along x.
fn pairs(nodes: &[[usize; 2]], branches: &[Vec<usize>], links: &[Link]) -> BTreeMap<[usize; 2], Deepest> {
    let boxes: Vec<_> = links.iter().map(|link| link.cone.bounds()).collect();
    let mut order: Vec<usize> = (0..links.len()).collect();
    order.sort_by(|&i, &j| boxes[i][0].x.total_cmp(&boxes[j][0].x).then(i.cmp(&j)));
    // Pairs of overlapping links, by branches; those of adjacent branches are judged together.
    let mut touching: BTreeMap<[usize; 2], Vec<([usize; 2], f64)>> = BTreeMap::new();
    for (k, &i) in order.iter().enumerate() {
        for &j in &order[k + 1..] {
            if boxes[j][0].x > boxes[i][1].x {
                break;
            }
            let apart =
                |axis: usize| boxes[i][0][axis] > boxes[j][1][axis] || boxes[j][0][axis] > boxes[i][1][axis];
            if apart(1) || apart(2) {
                continue;
            }
            let (i, j) = if (links[i].branch, links[i].place) < (links[j].branch, links[j].place) {
                (i, j)
            } else {
                (j, i)
            };
            let (gap, s, t) = links[i].cone.gap(&links[j].cone);
            if links[i].branch == links[j].branch && !is_far(&links[i], &links[j], [s, t]) {
                continue;
            }
            if gap < 0.0 {
                touching.entry([links[i].branch, links[j].branch]).or_default().push(([i, j], -gap));
            }
        }
    }
    let mut result = BTreeMap::new();
    for (pair, overlaps) in touching {
        let apart = |[i, j]: [usize; 2]| match common_node(nodes, pair) {
            None => true,
            Some(starts) => has_parted(branches, links, &overlaps, pair, starts, [i, j]),
        };
        let deepest = overlaps.iter().filter(|(which, _)| pair[0] == pair[1] || apart(*which)).fold(
            None,
            |best: Option<Deepest>, &(links, depth)| match best {
                Some(best) if best.depth >= depth => Some(best),
                _ => Some(Deepest { depth, links }),
            },
        );
        if let Some(deepest) = deepest {
            result.insert(pair, deepest);
        }
    }
    result
}

/// Whether two places of one branch are so far apart along it that a turn between them would leave them side by side.
fn is_far(a: &Link, b: &Link, places: [f64; 2]) -> bool {
    let [(s, p), (t, q)] = [(a, places[0]), (b, places[1])].map(|(link, place)| {
        let [r0, r1] = link.cone.radii;
        (link.before + place * link.length, r0 + (r1 - r0) * place)
    });
    (s - t).abs() > PI * (p + q)
}

/// The common node of two branches, as whether it is the first end of each.
fn common_node(nodes: &[[usize; 2]], [a, b]: [usize; 2]) -> Option<[bool; 2]> {
    let ends = |branch: usize| [(nodes[branch][0], true), (nodes[branch][1], false)];
    ends(a).into_iter().find_map(|(node, first)| {
        ends(b).into_iter().find(|(other, _)| *other == node).map(|(_, second)| [first, second])
    })
}

/// Whether one of two adjacent branches has separated from the other between their node and this pair of links.
fn has_parted(
    branches: &[Vec<usize>],
    links: &[Link],
    overlaps: &[([usize; 2], f64)],
    pair: [usize; 2],
    starts: [bool; 2],
    which: [usize; 2],
) -> bool {
    [0, 1].into_iter().any(|side| {
        let place = links[which[side]].place;
        let last = branches[pair[side]].len() - 2;
        let mut between: Box<dyn Iterator<Item = usize>> =
            if starts[side] { Box::new(0..place) } else { Box::new(place + 1..=last) };
        between.any(|free| !overlaps.iter().any(|(both, _)| links[both[side]].place == free))
    })
}

/// Tip branches whose samples beyond the node all lie inside one adjacent branch, although the tip lies outside the ball of the
/// node.
fn inside(skeleton: &Skeleton, branches: &[Vec<usize>]) -> Vec<Problem> {
    let samples = skeleton.samples();
    let mut at_node: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (index, branch) in branches.iter().enumerate() {
        at_node.entry(branch[0]).or_default().push(index);
        at_node.entry(branch[branch.len() - 1]).or_default().push(index);
    }
    let mut found = Vec::new();
    for (index, branch) in branches.iter().enumerate() {
        let (node, tip) = (branch[0], branch[branch.len() - 1]);
        if !skeleton.children(tip).is_empty()
            || samples[tip].position.distance(samples[node].position) <= samples[node].radius
        {
            continue;
        }
        for &other in &at_node[&node] {
            let within = |&sample: &usize| {
                let p = samples[sample].position;
                branches[other].windows(2).any(|ends| {
                    let [a, b] = [samples[ends[0]], samples[ends[1]]];
                    let cone = RoundCone { ends: [a.position, b.position], radii: [a.radius, b.radius] };
                    cone.distance(p).0 < 0.0
                })
            };
            // Of two branches that contain each other, the later is reported.
            let other_is_inside_too = other > index && {
                let tip_of_other = branches[other][branches[other].len() - 1];
                skeleton.children(tip_of_other).is_empty()
                    && samples[tip_of_other].position.distance(samples[tip].position) <= samples[tip].radius
            };
            if other == index || other_is_inside_too || !branch[1..].iter().all(within) {
                continue;
            }
            let depth = samples[tip].position.distance(samples[node].position);
            let message = format!(
                "branch {index} from sample {} to {} runs inside branch {other}",
                samples[node].id, samples[tip].id
            );
            let values = [depth, samples[node].radius];
            found.push(of_pair(ProblemKind::Inside, (index, &samples[tip]), (other, None), values, message));
            break;
        }
    }
    found
}
