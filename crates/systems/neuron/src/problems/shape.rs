//! Defects of single samples and branches.

use super::{MOST_TURN, Problem, ProblemKind};
use crate::Skeleton;
use glam::DVec3;

pub(super) fn problems(skeleton: &Skeleton, branches: &[Vec<usize>]) -> Vec<Problem> {
    let samples = skeleton.samples();
    let at = |kind, branch, sample: usize, value, limit, message| Problem {
        kind,
        branch,
        sample: samples[sample].id,
        line: samples[sample].line,
        other_branch: None,
        other_sample: None,
        value,
        limit,
        message,
    };
    let mut found = Vec::new();
    let roots: Vec<usize> = skeleton.roots().collect();
    if let Some(&second) = roots.get(1) {
        let message =
            format!("there are {} trees; the second begins at sample {}", roots.len(), samples[second].id);
        found.push(at(ProblemKind::SeveralRoots, None, second, roots.len() as f64, 1.0, message));
    }
    for (i, sample) in samples.iter().enumerate() {
        if sample.radius == 0.0 {
            let message = format!("sample {} has the radius 0", sample.id);
            found.push(at(ProblemKind::ZeroRadius, None, i, 0.0, 0.0, message));
        }
        if let Some(parent) = skeleton.parent(i)
            && samples[parent].position == sample.position
        {
            let message = format!("sample {} lies where its parent {} lies", sample.id, samples[parent].id);
            found.push(at(ProblemKind::Coincident, None, i, 0.0, 0.0, message));
        }
    }
    for (index, branch) in branches.iter().enumerate() {
        let (a, b) = (branch[0], branch[branch.len() - 1]);
        let distance = samples[a].position.distance(samples[b].position);
        let needed = match (skeleton.degree(a) > 1, skeleton.degree(b) > 1) {
            (true, true) => samples[a].radius + samples[b].radius,
            (true, false) => samples[a].radius,
            (false, true) => samples[b].radius,
            (false, false) => 0.0,
        };
        let length = skeleton.length(branch);
        if length <= needed && distance <= needed {
            let message = format!(
                "branch {index} from sample {} to {} is {length:.4} long, within the balls of its nodes, which reach {needed:.4}",
                samples[a].id, samples[b].id
            );
            found.push(at(ProblemKind::TooShort, Some(index), b, length, needed, message));
        }
        found.extend(turns(skeleton, branch).into_iter().map(|(sample, turn)| {
            let message = format!(
                "branch {index} turns by {turn:.1}° within one radius at sample {}, more than {MOST_TURN}°",
                samples[sample].id
            );
            at(ProblemKind::SharpTurn, Some(index), sample, turn, MOST_TURN, message)
        }));
    }
    found
}

/// The samples where a branch turns too much, the worst of each run, with the angle in degrees.
fn turns(skeleton: &Skeleton, branch: &[usize]) -> Vec<(usize, f64)> {
    let samples = skeleton.samples();
    let mut found = Vec::new();
    let mut worst: Option<(usize, f64)> = None;
    for k in 1..branch.len() - 1 {
        let radius = samples[branch[k]].radius;
        let (before, behind) =
            (walk(skeleton, branch, k, radius, false), walk(skeleton, branch, k, radius, true));
        let here = samples[branch[k]].position;
        let turn = angle(here - before, behind - here);
        if turn > MOST_TURN {
            if worst.is_none_or(|(_, most)| turn > most) {
                worst = Some((branch[k], turn));
            }
        } else if let Some(found_here) = worst.take() {
            found.push(found_here);
        }
    }
    found.extend(worst);
    found
}

/// The point at a distance along a branch from one of its samples, or its end.
fn walk(skeleton: &Skeleton, branch: &[usize], from: usize, distance: f64, forward: bool) -> DVec3 {
    let position = |k: usize| skeleton.samples()[branch[k]].position;
    let (mut k, mut left) = (from, distance);
    loop {
        let next = if forward { k + 1 } else { k.wrapping_sub(1) };
        if next >= branch.len() {
            return position(k);
        }
        let step = position(k).distance(position(next));
        if step >= left && step > 0.0 {
            return position(k).lerp(position(next), left / step);
        }
        left -= step;
        k = next;
    }
}

/// The angle between two vectors in degrees, 0 where one of them vanishes.
fn angle(a: DVec3, b: DVec3) -> f64 {
    libm::atan2(a.cross(b).length(), a.dot(b)).to_degrees()
}
