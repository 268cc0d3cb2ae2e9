//! Infinitesimal joint motions of all pieces.

mod cone;
mod contacts;
mod exact;
mod least;
mod program;

use crate::Puzzle;
use cone::Cone;
use contacts::{rows, rows_of};
use pompeiu_core::run::Control;
use program::Verdict;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// How it was decided whether a puzzle is locked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Proof {
    /// Locked: clusters that cannot move relative to each other were merged until one was left, decided in integers.
    Merging,
    /// Free: one cluster can move while all others stay, decided in integers.
    OneMoves,
    /// Locked: multipliers show that no joint motion of several clusters is possible, checked in integers.
    Multipliers,
    /// Free: several clusters can move at once, in double precision.
    SeveralMove,
    /// Undecided: no cluster can move alone, and because of rounding it is not known whether several can move jointly; or a limit
    /// ended the test.
    Undecided,
}

/// An infinitesimal motion that takes a puzzle apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Escape {
    /// For each piece its velocity at the origin and its angular velocity, in units of the outline; all zero for stationary pieces.
    pub twists: Vec<[f64; 3]>,
}

/// Which pieces hold each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Lock {
    /// The cluster of each piece: no two pieces of a cluster can move relative to each other.
    pub clusters: Vec<usize>,
    /// The number of clusters.
    pub count: usize,
    /// How it was decided.
    pub proof: Proof,
    /// A motion, where there is one.
    pub escape: Option<Escape>,
    /// For each piece a motion of its cluster while all others stay, where there is one.
    pub alone: Vec<Option<[f64; 3]>>,
}

impl Lock {
    /// Whether no piece can move relative to another one.
    pub fn is_locked(&self) -> bool {
        matches!(self.proof, Proof::Merging | Proof::Multipliers)
    }
}

/// Decides which pieces can move, over all joint motions of the pieces.
///
/// # Definition
/// A motion gives each piece a velocity and an angular velocity in the plane. It is possible if on every border, to first order,
/// neither piece moves into the other. A puzzle is locked if the only possible motions move it as a whole.
///
/// # Accuracy
/// Pairs of clusters are tested in integers: pieces that cannot move relative to each other are merged into one cluster, whose
/// borders are combined, repeatedly. If one cluster is left, the puzzle is locked, exactly. If a cluster can move alone, it is
/// free, exactly. The remaining cases are decided by an optimisation in double precision: if its multipliers indicate a lock, that
/// is checked in integers; a motion that it finds is valid up to rounding.
///
/// # Limits
/// First-order tests see directions, not sizes: roughness of a border can also lock. See [`Puzzle::simplified`] for the depth to
/// which a lock holds. A kerf removes all contacts, so this test says nothing about loose pieces.
///
/// # Cost
/// For each pair of clusters, the square of the number of segments; for the optimisation some hundred sparse factorisations.
///
/// # Source
/// `wang_desia_2018` for rows and multipliers; merging is ours.
pub fn lock(puzzle: &Puzzle) -> Lock {
    lock_until(puzzle, &Control::default())
}

/// As [`lock`]. What is not decided when the control stops is reported as undecided; clusters and motions found by then are valid.
pub(crate) fn lock_until(puzzle: &Puzzle, control: &Control) -> Lock {
    verdict(puzzle, merged(puzzle, control), control)
}

/// Whether a puzzle is proven to be locked, as by [`lock`]; `false` where that needs multipliers that differ more than those of any known
/// proof, or once the control stops.
///
/// # Cost
/// Less than that of [`lock`] where a puzzle is free, because no motion is looked for.
pub(crate) fn is_locked_until(puzzle: &Puzzle, control: &Control) -> bool {
    let (clusters, count) = merged(puzzle, control);
    if count == 1 {
        return true;
    }
    let borders = borders_between(puzzle, &clusters, count);
    let moves = |borders: (usize, &Vec<usize>)| alone(puzzle, &clusters, borders, control).is_some();
    !borders.par_iter().enumerate().any(moves) && program::is_locked(puzzle, &clusters, count, control)
}

/// Merges clusters of which two hold each other until there are none; the cluster of each piece, and their number.
fn merged(puzzle: &Puzzle, control: &Control) -> (Vec<usize>, usize) {
    let mut clusters: Vec<usize> = (0..puzzle.pieces()).collect();
    let mut open: BTreeSet<[usize; 2]> = BTreeSet::new();
    loop {
        let shared = shared_borders(puzzle, &clusters);
        // Pairs with unchanged borders need no second test.
        let changed: Vec<(&[usize; 2], &Vec<usize>)> =
            shared.iter().filter(|(pair, _)| !open.contains(*pair)).collect();
        let is_locked: Vec<bool> = changed
            .par_iter()
            .map(|(pair, borders)| {
                !control.is_stopped() && pair_cone(puzzle, &clusters, **pair, borders).is_none()
            })
            .collect();
        let mut parent: Vec<usize> = (0..puzzle.pieces()).collect();
        let mut is_grown = vec![false; puzzle.pieces()];
        let mut has_merged = false;
        for ((pair, _), is_locked) in changed.iter().zip(is_locked) {
            if is_locked {
                let [a, b] = pair.map(|c| root(&mut parent, c));
                parent[a.max(b)] = a.min(b);
                is_grown[pair[0]] = true;
                is_grown[pair[1]] = true;
                has_merged = true;
            } else {
                open.insert(**pair);
            }
        }
        if !has_merged || control.is_stopped() {
            break;
        }
        open.retain(|pair| !pair.iter().any(|c| is_grown[*c]));
        for cluster in &mut clusters {
            *cluster = root(&mut parent, *cluster);
        }
    }
    numbered(&clusters)
}

/// Clusters numbered in the order of their names, and their number.
fn numbered(names: &[usize]) -> (Vec<usize>, usize) {
    let mut order: Vec<usize> = names.to_vec();
    order.sort_unstable();
    order.dedup();
    (names.iter().map(|name| order.partition_point(|other| other < name)).collect(), order.len())
}

/// The result once no two clusters hold each other pairwise.
fn verdict(puzzle: &Puzzle, (clusters, count): (Vec<usize>, usize), control: &Control) -> Lock {
    let none = vec![None; puzzle.pieces()];
    if count == 1 {
        return Lock { clusters, count, proof: Proof::Merging, escape: None, alone: none };
    }
    let borders = borders_between(puzzle, &clusters, count);
    let motions: Vec<Option<[f64; 3]>> =
        borders.par_iter().enumerate().map(|borders| alone(puzzle, &clusters, borders, control)).collect();
    let alone: Vec<Option<[f64; 3]>> = clusters.iter().map(|cluster| motions[*cluster]).collect();
    // The smallest cluster that can move is the clearest example.
    let mut sizes = vec![0_usize; count];
    for cluster in &clusters {
        sizes[*cluster] += 1;
    }
    if let Some(cluster) = (0..count).filter(|c| motions[*c].is_some()).min_by_key(|c| (sizes[*c], *c)) {
        let moves = |c: &usize| if *c == cluster { motions[cluster].unwrap_or_default() } else { [0.0; 3] };
        let escape = Some(Escape { twists: clusters.iter().map(moves).collect() });
        return Lock { clusters, count, proof: Proof::OneMoves, escape, alone };
    }
    let (proof, escape) = match program::solve(puzzle, &clusters, count, control) {
        Verdict::Locked => (Proof::Multipliers, None),
        Verdict::Moves(twists) => (Proof::SeveralMove, Some(twists)),
        Verdict::Unclear => (Proof::Undecided, None),
    };
    let escape = escape.map(|twists| Escape { twists: clusters.iter().map(|c| twists[*c]).collect() });
    let is_locked = proof == Proof::Multipliers;
    let (clusters, count) = if is_locked { (vec![0; clusters.len()], 1) } else { (clusters, count) };
    Lock { clusters, count, proof, escape, alone }
}

/// The borders between each two clusters.
fn shared_borders(puzzle: &Puzzle, clusters: &[usize]) -> BTreeMap<[usize; 2], Vec<usize>> {
    let mut shared: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
    for (i, border) in puzzle.borders.iter().enumerate() {
        let Some(right) = border.right else { continue };
        let [a, b] = [clusters[border.left], clusters[right]];
        if a != b {
            shared.entry([a.min(b), a.max(b)]).or_default().push(i);
        }
    }
    shared
}

/// For each cluster its borders with others, in order.
fn borders_between(puzzle: &Puzzle, clusters: &[usize], count: usize) -> Vec<Vec<usize>> {
    let mut found = vec![Vec::new(); count];
    for (i, border) in puzzle.borders.iter().enumerate() {
        let Some(right) = border.right else { continue };
        let [a, b] = [clusters[border.left], clusters[right]];
        if a != b {
            found[a].push(i);
            found[b].push(i);
        }
    }
    found
}

/// Whether a border alone holds the two adjacent pieces together, exactly.
pub(crate) fn holds(corners: &[[i64; 2]]) -> bool {
    let mut cone = Cone::default();
    cone.extend(rows_of(corners, corners[0]));
    cone.motion().is_none()
}

/// A motion of the first of two clusters relative to the second; `None` if they hold each other.
fn pair_cone(
    puzzle: &Puzzle,
    clusters: &[usize],
    [first, _]: [usize; 2],
    borders: &[usize],
) -> Option<[i128; 3]> {
    let origin = puzzle.borders[borders[0]].corners[0];
    let mut cone = Cone::default();
    for border in borders {
        let sign = if clusters[puzzle.borders[*border].left] == first { 1 } else { -1 };
        cone.extend(rows(puzzle, *border, origin).map(|row| row.map(|x| sign * x)));
    }
    cone.motion()
}

/// A motion of a cluster with some borders while all others stay: velocity at the origin and angular velocity. None once the control
/// stops.
fn alone(
    puzzle: &Puzzle,
    clusters: &[usize],
    (cluster, borders): (usize, &Vec<usize>),
    control: &Control,
) -> Option<[f64; 3]> {
    if control.is_stopped() {
        return None;
    }
    let origin = puzzle.borders[*borders.first()?].corners[0];
    let mut cone = Cone::default();
    for &border in borders {
        let sign = if clusters[puzzle.borders[border].left] == cluster { 1 } else { -1 };
        cone.extend(rows(puzzle, border, origin).map(|row| row.map(|x| sign * x)));
    }
    cone.motion().map(|motion| from_steps(motion.map(|x| x as f64), origin, puzzle.step))
}

/// Converts a twist about a lattice corner, in steps, to one about the origin in the unit of the outline, of length about 1.
fn from_steps([vx, vy, w]: [f64; 3], origin: [i64; 2], step: f64) -> [f64; 3] {
    // The velocity at p is v + w J p with J p = (−p_y, p_x).
    let [ox, oy] = origin.map(|x| x as f64 * step);
    let (vx, vy) = (vx * step, vy * step);
    let moved = [vx + w * oy, vy - w * ox, w];
    let scale = libm::hypot(vx, vy).max(w.abs() * step * crate::make::STEPS * 0.1);
    moved.map(|x| x / scale)
}

fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Border, Layout, PuzzleOptions, Tab, make};
    use pompeiu_core::mesh::edit::Random;

    /// Two adjacent pieces: piece 0 on the left of a border that goes up.
    fn two(middle: &[[i64; 2]]) -> Lock {
        let corners = [&[[500, 0]], middle, &[[500, 1000]]].concat();
        let border = Border { corners, left: 0, right: Some(1) };
        lock(&Puzzle {
            borders: vec![border],
            loops: vec![vec![]; 2],
            step: 1.0,
            size: [1000, 1000],
            doubled_outline: 2_000_000,
            whimsies: Vec::new(),
        })
    }

    #[test]
    fn many_clusters_at_once_are_decided_as_by_merging() {
        for (tab, pieces) in [(Tab::Knob, 150), (Tab::Dovetail, 90), (Tab::None, 40)] {
            let options =
                PuzzleOptions { layout: Layout::Voronoi, tab, pieces, seed: 6, ..PuzzleOptions::default() };
            let puzzle = make(&options).unwrap();
            let single: Vec<usize> = (0..pieces).collect();
            match program::solve(&puzzle, &single, pieces, &Control::default()) {
                Verdict::Locked => assert!(lock(&puzzle).is_locked(), "{tab:?}"),
                Verdict::Moves(twists) => {
                    assert!(!lock(&puzzle).is_locked() && enters_nothing(&puzzle, &twists), "{tab:?}");
                }
                Verdict::Unclear => panic!("{tab:?}: unclear"),
            }
        }
    }

    #[test]
    fn tabs_with_known_motions() {
        assert_eq!(two(&[]).proof, Proof::OneMoves);
        // Parallel sides: only straight out.
        let parallel = two(&[[500, 400], [700, 400], [700, 600], [500, 600]]);
        assert_eq!(parallel.proof, Proof::OneMoves);
        let ways: Vec<[f64; 3]> =
            parallel.alone.iter().flatten().map(|v| v.map(|x| x.signum() * x.abs().ceil())).collect();
        assert_eq!(ways, [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]]);
        // Wider at the head, on both sides or minimally on one.
        assert_eq!(two(&[[500, 400], [700, 350], [700, 650], [500, 600]]).proof, Proof::Merging);
        assert_eq!(two(&[[500, 400], [700, 400], [700, 601], [500, 600]]).proof, Proof::Merging);
        // A missing corner on one side: obliquely out.
        let broken = two(&[[500, 300], [700, 400], [700, 650], [500, 600]]);
        let [vx, vy, w] = broken.alone[0].unwrap();
        assert!(broken.proof == Proof::OneMoves && vx < 0.0);
        // The tab's corners leave the slot on its lower side, which rises by 1 in 2, and under the upper one, which rises by 1 in 4.
        for [x, y] in [[700.0, 650.0], [500.0, 600.0]] {
            let at = [vx - w * y, vy + w * x];
            assert!(at[1] <= 0.25 * at[0] + 1e-9, "{at:?}");
        }
    }

    #[test]
    fn the_program_of_all_pieces_agrees_with_merging() {
        let mut random = Random::new(17);
        let mut seen = BTreeMap::new();
        for seed in 0..150 {
            let tab = if seed % 2 == 0 { Tab::Knob } else { Tab::Dovetail };
            let layout = if seed % 3 == 0 { Layout::Grid } else { Layout::Voronoi };
            let options = PuzzleOptions {
                pieces: 4 + seed as usize % 6,
                tab,
                layout,
                seed,
                ..PuzzleOptions::default()
            };
            let mut puzzle = make(&options).unwrap();
            // Without most tabs, and with others that come out one way.
            for border in puzzle.borders.iter_mut().filter(|border| border.right.is_some()) {
                let n = border.corners.len();
                match random.below(3) {
                    0 => border.corners = vec![border.corners[0], border.corners[n - 1]],
                    1 if n > 5 => {
                        border.corners.remove(2);
                    }
                    _ => (),
                }
            }
            let found = lock(&puzzle);
            let single: Vec<usize> = (0..puzzle.pieces()).collect();
            let direct = match program::solve(&puzzle, &single, puzzle.pieces(), &Control::default()) {
                Verdict::Locked => true,
                Verdict::Moves(twists) => {
                    assert!(enters_nothing(&puzzle, &twists), "seed {seed}");
                    false
                }
                Verdict::Unclear => panic!("seed {seed}: unclear"),
            };
            assert_eq!(found.is_locked(), direct, "seed {seed}: {:?}", found.proof);
            if let Some(escape) = &found.escape {
                assert!(enters_nothing(&puzzle, &escape.twists), "seed {seed}");
            }
            *seen.entry(format!("{:?}", found.proof)).or_insert(0) += 1;
        }
        assert!(seen["Merging"] > 10 && seen["OneMoves"] > 10, "{seen:?}");
    }

    /// Checks a motion by the velocities at the corners of all borders.
    fn enters_nothing(puzzle: &Puzzle, twists: &[[f64; 3]]) -> bool {
        let at = |[vx, vy, w]: [f64; 3], [x, y]: [f64; 2]| [vx - w * y, vy + w * x];
        let largest = puzzle
            .borders
            .iter()
            .flat_map(|border| &border.corners)
            .flat_map(|c| twists.iter().flat_map(move |t| at(*t, puzzle.point(*c))));
        let largest = largest.fold(0.0, |most: f64, v| most.max(v.abs()));
        puzzle.borders.iter().all(|border| {
            let Some(right) = border.right else { return true };
            border.corners.windows(2).all(|pair| {
                let [p, q] = [puzzle.point(pair[0]), puzzle.point(pair[1])];
                let length = libm::hypot(q[0] - p[0], q[1] - p[1]);
                let normal = [(p[1] - q[1]) / length, (q[0] - p[0]) / length];
                [p, q].into_iter().all(|c| {
                    let (a, b) = (at(twists[border.left], c), at(twists[right], c));
                    normal[0] * (a[0] - b[0]) + normal[1] * (a[1] - b[1]) >= -1e-6 * largest
                })
            })
        })
    }
}
