//! The next input from the previous solves.

use crate::columns::{MOST_COLUMNS, Model, Pair, add_scaled, difference, dot, norm};
use crate::{CouplingOptions, Scheme};
use std::collections::VecDeque;

/// Differences of solves of this window and of earlier ones, for both solvers together (`whole`) or for each (`first`, `second`).
#[derive(Debug, Default)]
pub(crate) struct Pairs {
    /// From `x̃ − x` to `x̃`.
    pub(crate) whole: Vec<Pair>,
    /// From x to `F(x)`.
    pub(crate) first: Vec<Pair>,
    /// From y to `S(y)`.
    pub(crate) second: Vec<Pair>,
}

/// Data kept between windows.
#[derive(Debug, Default)]
pub(crate) struct Memory {
    /// The newest window first.
    windows: VecDeque<Pairs>,
    /// The last relaxation factor of Aitken's formula.
    relaxation: Option<f64>,
    /// The inverse Jacobian of the last window, row by row.
    jacobian: Option<Vec<f64>>,
}

impl Memory {
    /// Discards all solves.
    pub(crate) fn clear(&mut self) {
        *self = Self::default();
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.windows.iter().all(|pairs| pairs.whole.is_empty()) && self.jacobian.is_none()
    }
}

/// One solve: its inputs and outputs.
#[derive(Clone, Debug)]
struct Solve {
    x: Vec<f64>,
    y: Vec<f64>,
    /// Input of the second solver: y, or y as predicted by the models.
    given: Vec<f64>,
    out: Vec<f64>,
}

/// The solves of one attempt at a window.
#[derive(Debug)]
pub(crate) struct Iteration<'a> {
    options: &'a CouplingOptions,
    memory: &'a Memory,
    damping: f64,
    last: Option<Solve>,
    pub(crate) pairs: Pairs,
    relaxation: Option<f64>,
    pub(crate) columns: usize,
    pub(crate) dropped: usize,
}

impl<'a> Iteration<'a> {
    pub(crate) fn new(options: &'a CouplingOptions, memory: &'a Memory, damping: f64) -> Self {
        let pairs = Pairs::default();
        Self { options, memory, damping, last: None, pairs, relaxation: None, columns: 0, dropped: 0 }
    }

    /// Pairs of this window, the newest first, then those of earlier ones.
    fn all(&self, of: fn(&Pairs) -> &Vec<Pair>) -> impl Iterator<Item = &Pair> {
        let reuse = if self.options.scheme == Scheme::IqnImvj { 0 } else { self.options.reuse };
        let old = self.memory.windows.iter().take(reuse).flat_map(move |pairs| of(pairs).iter().rev());
        of(&self.pairs).iter().rev().chain(old)
    }

    fn model(&self, of: fn(&Pairs) -> &Vec<Pair>) -> Model<'_> {
        Model::new(self.all(of), self.options.filter)
    }

    /// Input of the second solver after the first one has returned y for x.
    pub(crate) fn between(&mut self, x: &[f64], y: &[f64]) -> Vec<f64> {
        let Some(last) = &self.last else { return y.to_vec() };
        if self.options.scheme != Scheme::TwoModels {
            return y.to_vec();
        }
        let pair = Pair { from: difference(x, &last.x), to: difference(y, &last.y) };
        push(&mut self.pairs.first, pair, x);
        let (first, second) = (self.model(|p| &p.first), self.model(|p| &p.second));
        // The first solver's answer moves with the input that the second one would then give.
        let mut wanted = difference(&last.out, x);
        let moved = second.weights(&difference(y, &last.given));
        add_scaled(&mut wanted, 1.0, &second.to(&moved, x.len()));
        match answer(&first, &second, &wanted) {
            Some(change) => y.iter().zip(change).map(|(y, change)| y + self.damping * change).collect(),
            None => y.to_vec(),
        }
    }

    /// Records a solve and returns the input of the next one.
    pub(crate) fn next(&mut self, x: &[f64], y: &[f64], given: &[f64], out: &[f64]) -> Vec<f64> {
        self.record(x, y, given, out);
        let rest = difference(out, x);
        let mut change = match self.options.scheme {
            Scheme::Fixed => rest,
            Scheme::Constant(part) => rest.iter().map(|r| part * r).collect(),
            Scheme::Aitken(_) => {
                let part = self.relaxation.unwrap_or(1.0);
                rest.iter().map(|r| part * r).collect()
            }
            Scheme::IqnIls => self.least_squares(&rest),
            Scheme::IqnImvj => self.multi_vector(&rest),
            Scheme::TwoModels => self.two_models(x, y, given, out),
        };
        add_scaled(&mut change, 1.0, x);
        change
    }

    /// Records a solve.
    pub(crate) fn record(&mut self, x: &[f64], y: &[f64], given: &[f64], out: &[f64]) {
        let solve = Solve { x: x.to_vec(), y: y.to_vec(), given: given.to_vec(), out: out.to_vec() };
        if let Some(last) = &self.last {
            let (now, before) = (difference(out, x), difference(&last.out, &last.x));
            let from = difference(&now, &before);
            if matches!(self.options.scheme, Scheme::Aitken(_)) && norm(&from) > ROUNDING * norm(out) {
                self.relaxation = Some(aitken(self.relaxation.unwrap_or(1.0), &before, &from));
            }
            let to = difference(out, &last.out);
            push(&mut self.pairs.whole, Pair { from, to: to.clone() }, out);
            push(&mut self.pairs.second, Pair { from: difference(given, &last.given), to }, given);
        } else if let Scheme::Aitken(first) = self.options.scheme {
            self.relaxation = Some(self.memory.relaxation.unwrap_or(first));
        }
        self.last = Some(solve);
    }

    /// The change without a model: relaxed, and damped after a failure.
    fn blind(&self, rest: &[f64]) -> Vec<f64> {
        rest.iter().map(|r| self.options.initial_relaxation * self.damping * r).collect()
    }

    fn least_squares(&mut self, rest: &[f64]) -> Vec<f64> {
        let model = self.model(|p| &p.whole);
        let (kept, dropped) = (model.len(), model.dropped);
        let change = if model.is_empty() {
            self.blind(rest)
        } else {
            let (explained, unexplained, out) = explain(&model, rest);
            // The input changes by the modelled change of the output minus that of the residual, plus the damped unexplained part.
            let mut change = difference(&out, &explained);
            add_scaled(&mut change, self.damping, &unexplained);
            change
        };
        (self.columns, self.dropped) = (kept, dropped);
        change
    }

    fn multi_vector(&mut self, rest: &[f64]) -> Vec<f64> {
        let model = self.model(|p| &p.whole);
        let (kept, dropped) = (model.len(), model.dropped);
        let change = if model.is_empty() && self.memory.jacobian.is_none() {
            self.blind(rest)
        } else {
            let (explained, mut unexplained, out) = explain(&model, rest);
            let mut change = difference(&out, &explained);
            if let Some(jacobian) = &self.memory.jacobian {
                let known = multiply(jacobian, &unexplained);
                add_scaled(&mut unexplained, -1.0, &known);
            }
            add_scaled(&mut change, self.damping, &unexplained);
            change
        };
        (self.columns, self.dropped) = (kept, dropped);
        change
    }

    fn two_models(&mut self, x: &[f64], y: &[f64], given: &[f64], out: &[f64]) -> Vec<f64> {
        let (first, second) = (self.model(|p| &p.first), self.model(|p| &p.second));
        let (kept, dropped) = (first.len() + second.len(), first.dropped + second.dropped);
        let rest = difference(out, x);
        let change = if second.is_empty() {
            self.blind(&rest)
        } else {
            let mut wanted = difference(y, given);
            let moved = first.weights(&rest);
            add_scaled(&mut wanted, 1.0, &first.to(&moved, y.len()));
            let mut change = answer(&second, &first, &wanted).unwrap_or_else(|| vec![0.0; x.len()]);
            add_scaled(&mut change, 1.0, &rest);
            if self.damping < 1.0 {
                // What neither model has seen is damped: the part of the change beyond the inputs of the first one.
                let seen = first.from(&first.weights(&change), x.len());
                let unseen = difference(&change, &seen);
                change = seen;
                add_scaled(&mut change, self.damping, &unseen);
            }
            change
        };
        (self.columns, self.dropped) = (kept, dropped);
        change
    }

    /// Changes of inputs in this window, and the changes of outputs of both solvers applied in sequence.
    pub(crate) fn composed(&self) -> Vec<Pair> {
        if self.options.scheme == Scheme::TwoModels {
            // The second solver did not get what the first one gave.
            let second = self.model(|p| &p.second);
            let through = |pair: &Pair| second.to(&second.weights(&pair.to), pair.from.len());
            let pairs = self.pairs.first.iter().rev();
            return pairs.map(|pair| Pair { from: pair.from.clone(), to: through(pair) }).collect();
        }
        let pairs = self.pairs.whole.iter().rev();
        pairs.map(|pair| Pair { from: difference(&pair.to, &pair.from), to: pair.to.clone() }).collect()
    }

    /// Data for the next window.
    pub(crate) fn into_memory(self) -> (Pairs, Option<f64>, Option<Vec<f64>>) {
        let jacobian = (self.options.scheme == Scheme::IqnImvj).then(|| self.new_jacobian());
        (self.pairs, self.relaxation, jacobian)
    }

    /// `J + (W − J V) V⁺`, with J that of the last window.
    fn new_jacobian(&self) -> Vec<f64> {
        let size = self.last.as_ref().map_or(0, |last| last.x.len());
        let mut jacobian = self.memory.jacobian.clone().unwrap_or_else(|| vec![0.0; size * size]);
        let model = self.model(|p| &p.whole);
        for column in 0..model.len() {
            let weights = model.weights(&model.orthonormal[column]);
            let mut image = model.to(&weights, size);
            if let Some(old) = &self.memory.jacobian {
                add_scaled(&mut image, -1.0, &multiply(old, &model.orthonormal[column]));
            }
            for (row, image) in jacobian.chunks_exact_mut(size).zip(&image) {
                add_scaled(row, *image, &model.orthonormal[column]);
            }
        }
        jacobian
    }
}

impl Memory {
    /// Keeps the data of an accepted window.
    pub(crate) fn keep(
        &mut self,
        (pairs, relaxation, jacobian): (Pairs, Option<f64>, Option<Vec<f64>>),
        reuse: usize,
    ) {
        self.windows.push_front(pairs);
        self.windows.truncate(reuse.min(MOST_COLUMNS));
        self.relaxation = relaxation.or(self.relaxation);
        self.jacobian = jacobian;
    }
}

/// For a residual `r`: its negated projection `−V c` onto the columns, the part orthogonal to them, and the combination of outputs with
/// the weights c that cancel it.
fn explain(model: &Model<'_>, rest: &[f64]) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let weights: Vec<f64> = model.weights(rest).into_iter().map(|w| -w).collect();
    let explained = model.from(&weights, rest.len());
    let mut unexplained = rest.to_vec();
    add_scaled(&mut unexplained, 1.0, &explained);
    (explained, unexplained, model.to(&weights, rest.len()))
}

/// The δ with `δ = A (wanted + B δ)` for two models A and B; none if there is no solution.
fn answer(a: &Model<'_>, b: &Model<'_>, wanted: &[f64]) -> Option<Vec<f64>> {
    let k = a.len();
    if k == 0 {
        return None;
    }
    let size = a.kept[0].to.len();
    // δ is a sum of the outputs of A with weights w: w = A⁺ (wanted + B (outputs w)).
    let mut matrix = vec![0.0; k * k];
    for column in 0..k {
        let through = b.to(&b.weights(&a.kept[column].to), wanted.len());
        for (row, weight) in a.weights(&through).into_iter().enumerate() {
            matrix[row * k + column] = f64::from(u8::from(row == column)) - weight;
        }
    }
    let weights = solve_dense(matrix, a.weights(wanted))?;
    Some(a.to(&weights, size))
}

/// Gaussian elimination with partial pivoting; the matrix is row-major.
fn solve_dense(mut a: Vec<f64>, mut b: Vec<f64>) -> Option<Vec<f64>> {
    let n = b.len();
    for k in 0..n {
        let largest = |&i: &usize, &j: &usize| a[i * n + k].abs().total_cmp(&a[j * n + k].abs());
        let pivot = (k..n).max_by(largest)?;
        if a[pivot * n + k] == 0.0 || !a[pivot * n + k].is_finite() {
            return None;
        }
        b.swap(k, pivot);
        for column in 0..n {
            a.swap(k * n + column, pivot * n + column);
        }
        for row in k + 1..n {
            let factor = a[row * n + k] / a[k * n + k];
            for column in k..n {
                a[row * n + column] -= factor * a[k * n + column];
            }
            b[row] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|column| a[k * n + column] * b[column]).sum();
        b[k] = (b[k] - known) / a[k * n + k];
    }
    Some(b)
}

fn multiply(matrix: &[f64], x: &[f64]) -> Vec<f64> {
    matrix.chunks_exact(x.len().max(1)).map(|row| dot(row, x)).collect()
}

/// Aitken's relaxation factor from the previous factor, the previous residual and its change; between −1 and 1.
fn aitken(last: f64, before: &[f64], change: &[f64]) -> f64 {
    let square = dot(change, change);
    let part = -last * dot(before, change) / square;
    if square > 0.0 && part.is_finite() && part != 0.0 { part.clamp(-1.0, 1.0) } else { last }
}

/// Changes below this share of the value are rounding errors, not derivatives.
const ROUNDING: f64 = 1e-10;

/// Keeps a pair unless it is a rounding error of data of this size.
fn push(pairs: &mut Vec<Pair>, pair: Pair, of: &[f64]) {
    if norm(&pair.from) > ROUNDING * norm(of) {
        pairs.push(pair);
    }
}

/// Whether a change is less than a share of a reference value.
pub(crate) fn relative(change: &[f64], of: &[f64]) -> f64 {
    let (change, of) = (norm(change), norm(of));
    if change == 0.0 { 0.0 } else { change / of }
}
