//! Joint motions of several clusters by optimisation; its multipliers are checked in integers.

use super::contacts::{Contact, add, contacts, opening, side, square};
use super::exact::proves;
use super::least;
use crate::Puzzle;
use pompeiu_core::run::Control;
use pompeiu_solve::{Analysis, Cholesky, LinearSolver, Ordering, SparseMatrix};

/// The result of the optimisation.
pub(super) enum Verdict {
    /// Positive multipliers with a vanishing combination of all rows, and rows of full rank: no motion. Proven.
    Locked,
    /// A twist for each cluster, about the origin, in units of the outline.
    Moves(Vec<[f64; 3]>),
    /// Undecided because of rounding.
    Unclear,
}

/// Largest number of Newton steps.
const STEPS: usize = 150;

/// Largest change of an exponent in a step: the sum of exponentials then decreases.
const REACH: f64 = 0.7;

/// The combination of rows counts as 0 up to this share of the sum of multipliers.
const SETTLED: f64 = 1e-13;

/// Steps between two checks for convergence to a motion.
const LOOK: usize = 15;

/// Contacts count as closed if they open by less than these shares of the largest opening.
const CLOSED: [f64; 4] = [0.03, 0.003, 3e-4, 3e-5];

/// Largest number of clusters for the least-squares method, which is tried if this one finds no motion.
const FEW: usize = 60;

/// Largest closing of a contact relative to the largest opening, due to rounding of the projection.
const ZERO: f64 = 1e-9;

/// Largest difference of exponents, the logarithm of the ratio of multipliers, with which a proof of a lock is still expected. Those of known
/// proofs differ by less than half of it.
const EXPECTED: f64 = 30.0;

/// Regularisation of the diagonal, relative to it.
const SHIFT: f64 = 1e-13;

/// Minimises F(x) = Σ exp(−a·x) over the twists x of all clusters but the first, a the unit rows of all contacts.
///
/// By Stiemke's lemma either some λ > 0 has Σ λ a = 0, or some x has a·x ≥ 0 for all rows and a·x > 0 for one. In the first case,
/// if the rows span the space, F has a minimum, where λ = exp(−a·x); `exact.rs` checks in integers that these multipliers prove the
/// lock. In the second case x grows without bound along a motion; a projection onto the contacts that stay closed removes its
/// rounding errors.
///
/// Once the control stops, the verdict is unclear.
pub(super) fn solve(puzzle: &Puzzle, clusters: &[usize], count: usize, control: &Control) -> Verdict {
    match by_exponentials(puzzle, clusters, count, f64::INFINITY, control) {
        Verdict::Unclear if count <= FEW && !control.is_stopped() => {
            least::motion(puzzle, clusters, count).map_or(Verdict::Unclear, Verdict::Moves)
        }
        found => found,
    }
}

/// Whether positive multipliers prove that no motion is possible, with exponents that do not differ more than is [`EXPECTED`].
pub(super) fn is_locked(puzzle: &Puzzle, clusters: &[usize], count: usize, control: &Control) -> bool {
    matches!(by_exponentials(puzzle, clusters, count, EXPECTED, control), Verdict::Locked)
}

/// Gives up where exponents differ by more than `most`.
fn by_exponentials(
    puzzle: &Puzzle,
    clusters: &[usize],
    count: usize,
    most: f64,
    control: &Control,
) -> Verdict {
    let contacts = contacts(puzzle, clusters);
    let columns = 3 * (count - 1);
    let mut analysis = None;
    let mut x = vec![0.0; columns];
    let mut before = x.clone();
    for round in 0..STEPS {
        if control.is_stopped() {
            return Verdict::Unclear;
        }
        let exponents: Vec<f64> = contacts.iter().map(|c| opening(c, &x)).collect();
        let ends = exponents
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(*z), high.max(*z)]);
        if ends[1] - ends[0] > most {
            return Verdict::Unclear;
        }
        if round > 0 && round % LOOK == 0 {
            // If nothing moves, the twists converge; otherwise their change tends to a motion.
            let change: Vec<f64> = x.iter().zip(&before).map(|(now, then)| now - then).collect();
            if let Some(motion) =
                CLOSED.iter().find_map(|closed| motion(&mut analysis, &contacts, *closed, &change))
            {
                return Verdict::Moves(twists(puzzle, count, &motion));
            }
            before.clone_from(&x);
        }
        let weights: Vec<f64> = exponents.iter().map(|z| libm::exp(-z)).collect();
        let mut gradient = vec![0.0; columns];
        for (contact, weight) in contacts.iter().zip(&weights) {
            add(contact, *weight, &mut gradient);
        }
        let Some(mut step) = solved(&mut analysis, &contacts, &weights, columns, SHIFT, &gradient) else {
            return Verdict::Unclear;
        };
        let total: f64 = weights.iter().sum();
        let reach = contacts.iter().map(|c| opening(c, &step).abs()).fold(0.0, f64::max);
        if norm(&gradient) <= SETTLED * total || reach < 1e-11 {
            if proves(&contacts, &weights, columns) {
                return Verdict::Locked;
            }
            return slide(&mut analysis, puzzle, &contacts, columns, count).unwrap_or(Verdict::Unclear);
        }
        let factor = (REACH / reach).min(1.0);
        step.iter_mut().zip(&mut x).for_each(|(s, x)| *x += factor * *s);
    }
    Verdict::Unclear
}

/// Solves with the weighted sum of outer products, see [`factor`].
fn solved(
    analysis: &mut Option<Analysis>,
    contacts: &[Contact],
    weights: &[f64],
    columns: usize,
    shift: f64,
    right: &[f64],
) -> Option<Vec<f64>> {
    factor(analysis, contacts, weights, columns, shift)?.solve(right).ok()
}

/// The factor of the weighted sum of outer products, regularised by a share of the largest weight on the diagonal. Its pattern is
/// analysed once.
fn factor(
    analysis: &mut Option<Analysis>,
    contacts: &[Contact],
    weights: &[f64],
    columns: usize,
    shift: f64,
) -> Option<Cholesky> {
    let mut entries = square(contacts, weights);
    let largest = weights.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    entries.extend((0..columns).map(|k| (k, k, shift * largest)));
    let matrix = SparseMatrix::from_triplets(columns, columns, &entries).ok()?;
    let analysis = match analysis {
        Some(known) => known,
        none => none.insert(Analysis::new(&matrix, &Ordering::MinimumDegree).ok()?),
    };
    Cholesky::with(analysis, &matrix).ok()
}

/// The motion nearest to x that keeps contacts closed if they open by less than a share of the maximum; `None` if it closes others.
fn motion(analysis: &mut Option<Analysis>, contacts: &[Contact], closed: f64, x: &[f64]) -> Option<Vec<f64>> {
    let openings: Vec<f64> = contacts.iter().map(|c| opening(c, x)).collect();
    let most = openings.iter().copied().fold(0.0, f64::max);
    let weights: Vec<f64> = openings.iter().map(|z| if *z <= closed * most { 1.0 } else { 0.0 }).collect();
    let size = norm(x);
    let mut found: Vec<f64> = x.iter().map(|v| v / size).collect();
    // Each round reduces the opening of closed contacts by the regularisation factor.
    let shift = 1e-9;
    let factor = factor(analysis, contacts, &weights, x.len(), shift)?;
    for _ in 0..3 {
        let right: Vec<f64> = found.iter().map(|v| shift * v).collect();
        found = factor.solve(&right).ok()?;
    }
    let openings = || contacts.iter().map(|c| opening(c, &found));
    let (least, most) =
        openings().fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), z| (low.min(z), high.max(z)));
    (most > 1e-6 * norm(&found) && least >= -ZERO * most).then_some(found)
}

/// A motion that keeps all contacts closed, if there is one.
fn slide(
    analysis: &mut Option<Analysis>,
    puzzle: &Puzzle,
    contacts: &[Contact],
    columns: usize,
    count: usize,
) -> Option<Verdict> {
    let weights = vec![1.0; contacts.len()];
    let mut x: Vec<f64> = (0..columns).map(|k| libm::sin(1.0 + k as f64)).collect();
    let factor = factor(analysis, contacts, &weights, columns, 1e-11)?;
    for _ in 0..4 {
        x = factor.solve(&x).ok()?;
        let size = norm(&x);
        for v in &mut x {
            *v /= size;
        }
    }
    let most = contacts.iter().map(|c| opening(c, &x).abs()).fold(0.0, f64::max);
    (most <= ZERO).then(|| Verdict::Moves(twists(puzzle, count, &x)))
}

/// Converts twists about the centre, in units of the mean side, to twists about the origin in the unit of the outline.
fn twists(puzzle: &Puzzle, count: usize, x: &[f64]) -> Vec<[f64; 3]> {
    let largest = x.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    let middle = puzzle.size.map(|s| (s / 2) as f64 * puzzle.step);
    let unit = side(puzzle) as f64 * puzzle.step;
    let twist = |cluster: usize| {
        let at = 3 * (cluster - 1);
        let (vx, vy, w) = (x[at] / largest, x[at + 1] / largest, x[at + 2] / largest / unit);
        [vx + w * middle[1], vy - w * middle[0], w]
    };
    (0..count).map(|cluster| if cluster == 0 { [0.0; 3] } else { twist(cluster) }).collect()
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}
