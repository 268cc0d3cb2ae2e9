//! The tree of samples.

use crate::{SwcError, SwcRow};
use glam::DVec3;
use std::collections::HashMap;
use std::fmt;

/// A ball of the skeleton. Two neighbours span a round cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Its number in the file.
    pub id: i64,
    /// Its line in the file, from 1; 0 for a generated sample.
    pub line: usize,
    /// The structure, as in [`SwcRow::kind`].
    pub kind: i64,
    /// Centre in micrometres.
    pub position: DVec3,
    /// Radius in micrometres, at least 0.
    pub radius: f64,
}

/// Largest number of samples: an index fits into four bytes, and arrays derived from samples have room.
const MOST_SAMPLES: usize = 100_000_000;

/// The structure that is the soma.
pub const SOMA: i64 = 1;

/// A repair of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Repair {
    /// The sample.
    pub id: i64,
    /// Its line, from 1.
    pub line: usize,
    /// The action.
    pub action: RepairAction,
}

/// The kinds of repairs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RepairAction {
    /// Made a root, because its parent does not exist.
    Uprooted {
        /// The parent that is missing.
        parent: i64,
    },
    /// Made a root, because it was its own ancestor.
    CycleOpened,
    /// Given a radius.
    Radius {
        /// The old radius.
        from: f64,
        /// The new radius.
        to: f64,
    },
    /// Removed, because it lies at the position of its parent.
    Merged {
        /// The parent.
        into: i64,
    },
    /// Removed with its branch, which ends inside the ball of its node.
    ShortBranch {
        /// Length of the branch.
        length: f64,
    },
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { id, line, action } = self;
        write!(f, "sample {id} (line {line}) ")?;
        match action {
            RepairAction::Uprooted { parent } => {
                write!(f, "became a root: its parent {parent} does not exist")
            }
            RepairAction::CycleOpened => write!(f, "became a root: it continued itself"),
            RepairAction::Radius { from, to } => write!(f, "has the radius {to:.6} instead of {from}"),
            RepairAction::Merged { into } => write!(f, "was left out: it lies where its parent {into} lies"),
            RepairAction::ShortBranch { length } => write!(
                f,
                "was left out with its branch of length {length:.6}, which ends inside the ball of its node"
            ),
        }
    }
}

/// A forest of samples: every parent comes before its children, roots in the order of the file.
///
/// # Shapes and units
/// Lengths are in micrometres. Indices count samples in this order.
#[derive(Clone, Debug, PartialEq)]
pub struct Skeleton {
    samples: Vec<Sample>,
    parents: Vec<Option<usize>>,
    children: Vec<Vec<usize>>,
    soma: Soma,
}

/// How the file represents the soma.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Soma {
    /// Not at all.
    None,
    /// As one sample: a ball.
    Point,
    /// As three samples, the second and third next to the first, as NeuroMorpho.Org represents a ball. These two are removed here.
    ThreePoints,
    /// As a chain or tree of samples, which form tubes like any others.
    Cylinders,
}

impl Skeleton {
    /// The tree described by rows.
    ///
    /// # Errors
    /// [`SwcError`]: two samples with one number, a parent that does not exist, a cycle, a negative radius.
    pub fn new(rows: &[SwcRow]) -> Result<Self, SwcError> {
        Ok(Self::build(rows, false)?.0)
    }

    /// The tree described by rows, repaired: samples without an existing parent and one of each cycle become roots; samples without
    /// a radius get one from their nearest neighbours along the tree; samples at the position of their parent are removed, and so
    /// are branches that end inside the ball of their node.
    ///
    /// # Errors
    /// [`SwcError::Duplicate`], which cannot be repaired.
    pub fn repaired(rows: &[SwcRow]) -> Result<(Self, Vec<Repair>), SwcError> {
        let (mut skeleton, mut repairs) = Self::build(rows, true)?;
        skeleton.merge_coincident(&mut repairs);
        skeleton.fill_radii(&mut repairs);
        skeleton.drop_short_tips(&mut repairs);
        Ok((skeleton, repairs))
    }

    fn build(rows: &[SwcRow], repair: bool) -> Result<(Self, Vec<Repair>), SwcError> {
        if rows.len() > MOST_SAMPLES {
            return Err(SwcError::TooMany(rows.len()));
        }
        if rows.is_empty() {
            return Err(SwcError::Empty);
        }
        let mut repairs = Vec::new();
        let mut index = HashMap::with_capacity(rows.len());
        for (i, row) in rows.iter().enumerate() {
            if let Some(first) = index.insert(row.id, i) {
                return Err(SwcError::Duplicate { line: row.line, id: row.id, first: rows[first].line });
            }
            if row.radius < 0.0 && !repair {
                let SwcRow { line, id, radius, .. } = *row;
                return Err(SwcError::NegativeRadius { line, id, radius });
            }
        }
        let mut parents = Vec::with_capacity(rows.len());
        for row in rows {
            let parent = row.parent.map(|parent| index.get(&parent).copied().ok_or(parent));
            parents.push(match parent {
                None => None,
                Some(Ok(parent)) => Some(parent),
                Some(Err(parent)) => {
                    let (line, id) = (row.line, row.id);
                    if !repair {
                        return Err(SwcError::MissingParent { line, id, parent });
                    }
                    repairs.push(Repair { id, line, action: RepairAction::Uprooted { parent } });
                    None
                }
            });
        }
        open_cycles(rows, &mut parents, repair, &mut repairs)?;
        let (drop, soma) = soma_of(rows, &parents);
        let samples: Vec<Sample> = rows
            .iter()
            .map(|row| Sample {
                id: row.id,
                line: row.line,
                kind: row.kind,
                position: row.position.into(),
                radius: row.radius,
            })
            .collect();
        let mut skeleton = Self::ordered(&samples, &parents, soma);
        let places: HashMap<i64, usize> =
            skeleton.samples.iter().enumerate().map(|(i, s)| (s.id, i)).collect();
        let dropped: Vec<usize> = drop.iter().map(|&i| places[&rows[i].id]).collect();
        if !dropped.is_empty() {
            skeleton.remove(&dropped);
        }
        Ok((skeleton, repairs))
    }

    /// Sorts parents before children, depth first, children in the given order.
    fn ordered(samples: &[Sample], parents: &[Option<usize>], soma: Soma) -> Self {
        let mut children = vec![Vec::new(); samples.len()];
        let mut stack = Vec::new();
        for (i, parent) in parents.iter().enumerate() {
            match parent {
                Some(parent) => children[*parent].push(i),
                None => stack.push(i),
            }
        }
        stack.reverse();
        let mut place = vec![0; samples.len()];
        let mut order = Vec::with_capacity(samples.len());
        while let Some(i) = stack.pop() {
            place[i] = order.len();
            order.push(i);
            stack.extend(children[i].iter().rev());
        }
        Self {
            samples: order.iter().map(|&i| samples[i]).collect(),
            parents: order.iter().map(|&i| parents[i].map(|p| place[p])).collect(),
            children: order.iter().map(|&i| children[i].iter().map(|&c| place[c]).collect()).collect(),
            soma,
        }
    }

    /// Removes samples; their children are attached to their parents.
    fn remove(&mut self, dropped: &[usize]) {
        let mut gone = vec![false; self.samples.len()];
        for &i in dropped {
            gone[i] = true;
        }
        // The nearest ancestor that stays; parents come first.
        let mut stays: Vec<Option<usize>> = vec![None; self.samples.len()];
        let mut place = vec![0; self.samples.len()];
        let (mut samples, mut parents) = (Vec::new(), Vec::new());
        for i in 0..self.samples.len() {
            let above = self.parents[i].and_then(|p| if gone[p] { stays[p] } else { Some(p) });
            if gone[i] {
                stays[i] = above;
            } else {
                place[i] = samples.len();
                samples.push(self.samples[i]);
                parents.push(above.map(|p| place[p]));
            }
        }
        *self = Self::ordered(&samples, &parents, self.soma);
    }

    fn merge_coincident(&mut self, repairs: &mut Vec<Repair>) {
        let mut dropped = Vec::new();
        for (i, sample) in self.samples.iter().enumerate() {
            if let Some(parent) = self.parents[i]
                && self.samples[parent].position == sample.position
            {
                let action = RepairAction::Merged { into: self.samples[parent].id };
                repairs.push(Repair { id: sample.id, line: sample.line, action });
                dropped.push(i);
            }
        }
        self.remove(&dropped);
    }

    /// Sets the radius of each sample without one to the mean of those of the nearest ancestor and the nearest descendant with a
    /// radius, weighted by distance along the tree.
    fn fill_radii(&mut self, repairs: &mut Vec<Repair>) {
        let n = self.samples.len();
        let length = |s: &Self, i: usize, p: usize| s.samples[i].position.distance(s.samples[p].position);
        let known = |s: &Self, i: usize| (s.samples[i].radius > 0.0).then_some((0.0, s.samples[i].radius));
        let mut above: Vec<Option<(f64, f64)>> = vec![None; n];
        for i in 0..n {
            above[i] = known(self, i).or_else(|| {
                let parent = self.parents[i]?;
                above[parent].map(|(d, r)| (d + length(self, i, parent), r))
            });
        }
        let mut below: Vec<Option<(f64, f64)>> = (0..n).map(|i| known(self, i)).collect();
        for i in (0..n).rev() {
            if let (Some((d, r)), Some(parent)) = (below[i], self.parents[i]) {
                let found = (d + length(self, i, parent), r);
                if below[parent].is_none_or(|(best, _)| found.0 < best) {
                    below[parent] = Some(found);
                }
            }
        }
        for i in 0..n {
            let sample = &mut self.samples[i];
            if sample.radius > 0.0 {
                continue;
            }
            let to = match (above[i], below[i]) {
                (Some((da, ra)), Some((db, rb))) if da + db > 0.0 => (ra * db + rb * da) / (da + db),
                (Some((_, r)), _) | (None, Some((_, r))) => r,
                (None, None) => continue,
            };
            let action = RepairAction::Radius { from: sample.radius, to };
            repairs.push(Repair { id: sample.id, line: sample.line, action });
            sample.radius = to;
        }
    }

    /// Repeatedly removes tip branches that end inside the ball of their node.
    fn drop_short_tips(&mut self, repairs: &mut Vec<Repair>) {
        loop {
            let found = self.branches().iter().find_map(|branch| {
                let (node, tip) = (branch[0], branch[branch.len() - 1]);
                let (a, b) = (&self.samples[node], &self.samples[tip]);
                let short = self.children[tip].is_empty()
                    && self.degree(node) > 2
                    && a.position.distance(b.position) <= a.radius;
                short.then(|| (branch[1..].to_vec(), b.id, b.line, self.length(branch)))
            });
            let Some((samples, id, line, length)) = found else { return };
            repairs.push(Repair { id, line, action: RepairAction::ShortBranch { length } });
            self.remove(&samples);
        }
    }

    /// The samples.
    pub fn samples(&self) -> &[Sample] {
        &self.samples
    }

    /// The parent of a sample.
    ///
    /// # Panics
    /// If there is no such sample.
    pub fn parent(&self, sample: usize) -> Option<usize> {
        self.parents[sample]
    }

    /// The children of a sample.
    ///
    /// # Panics
    /// If there is no such sample.
    pub fn children(&self, sample: usize) -> &[usize] {
        &self.children[sample]
    }

    /// Number of neighbours of a sample.
    ///
    /// # Panics
    /// If there is no such sample.
    pub fn degree(&self, sample: usize) -> usize {
        self.children[sample].len() + usize::from(self.parents[sample].is_some())
    }

    /// How the file represents the soma.
    pub const fn soma(&self) -> Soma {
        self.soma
    }

    /// The samples without a parent.
    pub fn roots(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.samples.len()).filter(|&i| self.parents[i].is_none())
    }

    /// The samples without children.
    pub fn tips(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.samples.len()).filter(|&i| self.children[i].is_empty())
    }

    /// The branches: paths from a root or a furcation to the next furcation or tip, both ends included, ordered by their second
    /// samples.
    pub fn branches(&self) -> Vec<Vec<usize>> {
        let starts = |i: usize| {
            self.parents[i].is_none_or(|p| self.parents[p].is_none() || self.children[p].len() != 1)
        };
        let mut branches = Vec::new();
        for i in (0..self.samples.len()).filter(|&i| starts(i)) {
            let Some(node) = self.parents[i] else { continue };
            let mut branch = vec![node, i];
            let mut at = i;
            while let [next] = self.children[at][..] {
                branch.push(next);
                at = next;
            }
            branches.push(branch);
        }
        branches
    }

    /// Length of a path of samples.
    ///
    /// # Panics
    /// If there is no such sample.
    pub fn length(&self, path: &[usize]) -> f64 {
        path.windows(2).map(|w| self.samples[w[0]].position.distance(self.samples[w[1]].position)).sum()
    }

    /// The tree as rows, numbered from 1 in its order.
    pub fn rows(&self) -> Vec<SwcRow> {
        let row = |(i, sample): (usize, &Sample)| SwcRow {
            line: i + 1,
            id: i.cast_signed() as i64 + 1,
            kind: sample.kind,
            position: sample.position.into(),
            radius: sample.radius,
            parent: self.parents[i].map(|p| p.cast_signed() as i64 + 1),
        };
        self.samples.iter().enumerate().map(row).collect()
    }

    /// The same tree with new samples on its branches: for each branch its positions and radii, including the ends, which must be
    /// those of the nodes.
    pub(crate) fn with_branches(&self, branches: &[NewBranch]) -> Self {
        let mut keep: HashMap<usize, usize> = HashMap::new();
        let (mut samples, mut parents) = (Vec::new(), Vec::new());
        let mut next_id = self.samples.iter().map(|s| s.id).max().unwrap_or(0);
        for root in self.roots() {
            keep.insert(root, samples.len());
            samples.push(self.samples[root]);
            parents.push(None);
        }
        for (path, points) in branches {
            let (Some(&first), Some(&last)) = (path.first(), path.last()) else { continue };
            let mut above = keep[&first];
            for (k, &(position, radius)) in points.iter().enumerate().skip(1) {
                let end = k + 1 == points.len();
                // Inner samples copy their other properties from the end of the branch.
                let like = self.samples[last];
                next_id += i64::from(!end);
                let (id, line) = if end { (like.id, like.line) } else { (next_id, 0) };
                if end {
                    keep.insert(last, samples.len());
                }
                parents.push(Some(above));
                above = samples.len();
                samples.push(Sample { id, line, kind: like.kind, position, radius });
            }
        }
        Self::ordered(&samples, &parents, self.soma)
    }
}

/// The samples of a branch, and its new positions and radii.
pub(crate) type NewBranch = (Vec<usize>, Vec<(DVec3, f64)>);

/// Finds cycles; makes one sample of each a root, or fails.
fn open_cycles(
    rows: &[SwcRow],
    parents: &mut [Option<usize>],
    repair: bool,
    repairs: &mut Vec<Repair>,
) -> Result<(), SwcError> {
    // 0: not visited; otherwise the traversal that visited it.
    let mut seen = vec![0_usize; rows.len()];
    for start in 0..rows.len() {
        let mut at = start;
        while seen[at] == 0 {
            seen[at] = start + 1;
            let Some(next) = parents[at] else { break };
            if seen[next] == start + 1 {
                let (line, id) = (rows[next].line, rows[next].id);
                if !repair {
                    let length = cycle_length(parents, next);
                    return Err(SwcError::Cycle { line, id, length });
                }
                repairs.push(Repair { id, line, action: RepairAction::CycleOpened });
                parents[next] = None;
                break;
            }
            at = next;
        }
    }
    Ok(())
}

fn cycle_length(parents: &[Option<usize>], start: usize) -> usize {
    let mut length = 1;
    let mut at = parents[start];
    while let Some(next) = at.filter(|&next| next != start) {
        length += 1;
        at = parents[next];
    }
    length
}

/// Tolerance for recognising a three-point soma, relative and in micrometres: files hold two or three decimals.
const DECIMALS: f64 = 0.02;

/// The representation of the soma, and the rows to remove for it.
fn soma_of(rows: &[SwcRow], parents: &[Option<usize>]) -> (Vec<usize>, Soma) {
    let of_soma: Vec<usize> = (0..rows.len()).filter(|&i| rows[i].kind == SOMA).collect();
    match of_soma[..] {
        [] => (Vec::new(), Soma::None),
        [_] => (Vec::new(), Soma::Point),
        [a, b, c] => {
            let root = [a, b, c].into_iter().find(|&i| parents[i].is_none());
            let beside = |root: usize, i: usize| {
                let distance = DVec3::from(rows[i].position).distance(rows[root].position.into());
                let radius = rows[root].radius;
                parents[i] == Some(root) && (distance - radius).abs() <= DECIMALS * radius + DECIMALS
            };
            match root {
                Some(root) if of_soma.iter().all(|&i| i == root || beside(root, i)) => {
                    (of_soma.into_iter().filter(|&i| i != root).collect(), Soma::ThreePoints)
                }
                _ => (Vec::new(), Soma::Cylinders),
            }
        }
        _ => (Vec::new(), Soma::Cylinders),
    }
}
