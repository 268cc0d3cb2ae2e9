//! Multifrontal elimination for dense elements in groups along a tree, where each group shares unknowns with few others.

use crate::solver::{LinearSolver, columns, finite};
use crate::{FIXED, SolveError};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::{lu_in_place, lu_in_place_scratch};
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::{solve_unit_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Accum, MatMut, MatRef, Par, Spec};
use rayon::prelude::*;

/// Assigns the unknowns of dense elements to groups that eliminate them.
///
/// A group eliminates every unknown that no later group has, from the sum of its elements and of the remainders of earlier groups.
/// Before that, each element eliminates the unknowns that no other element has. Independent groups are computed in parallel, with
/// the same bits at any number of threads.
///
/// # Shapes and units
/// Groups are numbered in the order in which they are eliminated. [`FIXED`] marks an absent unknown.
/// # Limits
/// Pivoting is limited to rows within one group or one element: a regular matrix with a singular block there cannot be factored.
/// List unknowns whose elimination must be delayed in `stay`.
/// # Cost
/// Each group costs the cube of its number of unknowns: linear in the length of a tree whose groups have bounded size.
/// # Source
/// `duff_multifrontal_1983`.
#[derive(Clone, Debug)]
pub struct FrontalPlan {
    unknowns: usize,
    elements: Vec<Element>,
    groups: Vec<Group>,
    /// Groups by height: those of one height depend on lower ones only.
    heights: Vec<Vec<u32>>,
}

#[derive(Clone, Debug)]
struct Element {
    /// Its unknowns in the given order.
    list: Vec<u32>,
    /// The unknowns that no other element has, and the others.
    own: Vec<u32>,
    shared: Vec<u32>,
}

#[derive(Clone, Debug, Default)]
struct Group {
    elements: Vec<u32>,
    children: Vec<u32>,
    /// Sorted.
    eliminated: Vec<u32>,
    kept: Vec<u32>,
}

impl FrontalPlan {
    /// The plan for elements with these unknowns, each in a group; `stay` lists unknowns with the first group that may eliminate
    /// them.
    ///
    /// # Errors
    /// [`SolveError::OutOfRange`] for an unknown or group that does not exist; [`SolveError::Length`] unless every element has a group;
    /// [`SolveError::Singular`] for an unknown that no element has.
    pub fn new(
        unknowns: usize,
        elements: &[Vec<u32>],
        group_of: &[u32],
        groups: usize,
        stay: &[(u32, u32)],
    ) -> Result<Self, SolveError> {
        if elements.len() != group_of.len() {
            let (found, expected) = (group_of.len(), elements.len());
            return Err(SolveError::Length { what: "groups of elements", found, expected });
        }
        let outside = |row: u32, group: u32| SolveError::OutOfRange {
            row: row as usize,
            column: group as usize,
            rows: unknowns,
            columns: groups,
        };
        // The last group that has the unknown, and the number of elements that have it.
        let mut last = vec![None::<u32>; unknowns];
        let mut count = vec![0_u32; unknowns];
        let pairs =
            elements.iter().zip(group_of).flat_map(|(list, &group)| list.iter().map(move |&u| (u, group)));
        for (unknown, group) in pairs.clone().filter(|(u, _)| *u != FIXED).chain(stay.iter().copied()) {
            let Some(last) = last.get_mut(unknown as usize).filter(|_| (group as usize) < groups) else {
                return Err(outside(unknown, group));
            };
            *last = Some(last.map_or(group, |last| last.max(group)));
        }
        pairs.filter(|(u, _)| *u != FIXED).for_each(|(u, _)| count[u as usize] += 1);
        for &(u, _) in stay {
            count[u as usize] += 2;
        }
        if let Some(index) = last.iter().position(Option::is_none) {
            return Err(SolveError::Singular { index });
        }
        let elements: Vec<Element> = elements
            .iter()
            .map(|list| {
                let mut present: Vec<u32> = list.iter().copied().filter(|&u| u != FIXED).collect();
                present.sort_unstable();
                present.dedup();
                let (own, shared) = present.into_iter().partition(|&u| count[u as usize] == 1);
                Element { list: list.clone(), own, shared }
            })
            .collect();
        let mut plan =
            Self { unknowns, elements, groups: vec![Group::default(); groups], heights: Vec::new() };
        plan.link(group_of, &last);
        Ok(plan)
    }

    fn link(&mut self, group_of: &[u32], last: &[Option<u32>]) {
        for (e, &group) in group_of.iter().enumerate() {
            self.groups[group as usize].elements.push(e as u32);
        }
        let mut height = vec![0_usize; self.groups.len()];
        for g in 0..self.groups.len() {
            let mut front: Vec<u32> = Vec::new();
            for &e in &self.groups[g].elements {
                front.extend_from_slice(&self.elements[e as usize].shared);
            }
            for &child in &self.groups[g].children {
                front.extend_from_slice(&self.groups[child as usize].kept);
            }
            front.sort_unstable();
            front.dedup();
            let (eliminated, kept): (Vec<u32>, Vec<u32>) =
                front.into_iter().partition(|&u| last[u as usize] == Some(g as u32));
            if let Some(parent) = kept.iter().filter_map(|&u| last[u as usize]).min() {
                self.groups[parent as usize].children.push(g as u32);
                height[parent as usize] = height[parent as usize].max(height[g] + 1);
            }
            (self.groups[g].eliminated, self.groups[g].kept) = (eliminated, kept);
            if self.heights.len() <= height[g] {
                self.heights.resize(height[g] + 1, Vec::new());
            }
            self.heights[height[g]].push(g as u32);
        }
    }

    /// Bytes that the factors take.
    pub fn bytes(&self) -> usize {
        let of = |own: usize, kept: usize| 8 * own.saturating_mul(own + 2 * kept);
        let elements: usize = self.elements.iter().map(|e| of(e.own.len(), e.shared.len())).sum();
        elements + self.groups.iter().map(|g| of(g.eliminated.len(), g.kept.len())).sum::<usize>()
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.unknowns
    }

    /// Factors the sum of the element matrices. The function writes the matrix of an element row by row, in the order of its
    /// unknowns, into an array of zeros. It is called once for each element, from several threads.
    ///
    /// # Errors
    /// [`SolveError::Singular`].
    pub fn factor(&self, matrix: impl Fn(usize, &mut [f64]) + Sync) -> Result<FrontalLu<'_>, SolveError> {
        let mut left: Vec<Option<Vec<f64>>> = vec![None; self.groups.len()];
        let mut fronts: Vec<Option<Factors>> = vec![None; self.groups.len()];
        let mut elements: Vec<Option<Factors>> = vec![None; self.elements.len()];
        for groups in &self.heights {
            let done: Result<Vec<_>, SolveError> =
                groups.par_iter().map(|&g| self.eliminate(g as usize, &left, &matrix)).collect();
            for (&g, (own, front, rest)) in groups.iter().zip(done?) {
                for (&e, factors) in self.groups[g as usize].elements.iter().zip(own) {
                    elements[e as usize] = Some(factors);
                }
                fronts[g as usize] = Some(front);
                left[g as usize] = Some(rest);
                for &child in &self.groups[g as usize].children {
                    left[child as usize] = None;
                }
            }
        }
        let all = |list: Vec<Option<Factors>>| list.into_iter().flatten().collect();
        Ok(FrontalLu { plan: self, elements: all(elements), fronts: all(fronts) })
    }

    fn eliminate(
        &self,
        g: usize,
        left: &[Option<Vec<f64>>],
        matrix: &(impl Fn(usize, &mut [f64]) + Sync),
    ) -> Result<(Vec<Factors>, Factors, Vec<f64>), SolveError> {
        let group = &self.groups[g];
        let own: Result<Vec<(Factors, Vec<f64>)>, SolveError> = group
            .elements
            .par_iter()
            .map(|&e| {
                let element = &self.elements[e as usize];
                let k = element.list.len();
                let mut values = vec![0.0; k * k];
                matrix(e as usize, &mut values);
                let mut front = Front::new(&element.own, &element.shared);
                // Row by row: the transpose of what columns expect.
                let places: Vec<usize> = element.list.iter().map(|&u| front.place(u)).collect();
                front.add(&places, |i, j| values[k * i + j]);
                front.factor()
            })
            .collect();
        let own = own?;
        let mut front = Front::new(&group.eliminated, &group.kept);
        let mut add = |unknowns: &[u32], values: &[f64]| {
            let k = unknowns.len();
            let places: Vec<usize> = unknowns.iter().map(|&u| front.place(u)).collect();
            front.add(&places, |i, j| values[i + k * j]);
        };
        for &child in &group.children {
            if let Some(values) = &left[child as usize] {
                add(&self.groups[child as usize].kept, values);
            }
        }
        for (&e, (_, rest)) in group.elements.iter().zip(&own) {
            add(&self.elements[e as usize].shared, rest);
        }
        let (factors, rest) = front.factor()?;
        Ok((own.into_iter().map(|(factors, _)| factors).collect(), factors, rest))
    }
}

/// A dense matrix of eliminated and kept unknowns, column by column, in four blocks.
struct Front<'f> {
    eliminated: &'f [u32],
    kept: &'f [u32],
    /// Columns of eliminated unknowns: rows of eliminated ones, then rows of kept ones.
    ee: Vec<f64>,
    ke: Vec<f64>,
    ek: Vec<f64>,
    kk: Vec<f64>,
}

impl<'f> Front<'f> {
    fn new(eliminated: &'f [u32], kept: &'f [u32]) -> Self {
        let (n, k) = (eliminated.len(), kept.len());
        Self {
            eliminated,
            kept,
            ee: vec![0.0; n * n],
            ke: vec![0.0; k * n],
            ek: vec![0.0; n * k],
            kk: vec![0.0; k * k],
        }
    }

    /// The index of an unknown: eliminated ones come first; fixed ones lie beyond all others.
    fn place(&self, unknown: u32) -> usize {
        let n = self.eliminated.len();
        let in_kept = || self.kept.binary_search(&unknown).map_or(usize::MAX, |at| n + at);
        self.eliminated.binary_search(&unknown).unwrap_or_else(|_| in_kept())
    }

    fn add(&mut self, places: &[usize], value: impl Fn(usize, usize) -> f64) {
        let (n, k) = (self.eliminated.len(), self.kept.len());
        for (j, &column) in places.iter().enumerate().filter(|(_, column)| **column != usize::MAX) {
            for (i, &row) in places.iter().enumerate().filter(|(_, row)| **row != usize::MAX) {
                let entry = match (row < n, column < n) {
                    (true, true) => &mut self.ee[row + n * column],
                    (false, true) => &mut self.ke[row - n + k * column],
                    (true, false) => &mut self.ek[row + n * (column - n)],
                    (false, false) => &mut self.kk[row - n + k * (column - n)],
                };
                *entry += value(i, j);
            }
        }
    }

    /// Eliminates; returns the factors and the Schur complement of the kept unknowns.
    fn factor(mut self) -> Result<(Factors, Vec<f64>), SolveError> {
        let (n, k) = (self.eliminated.len(), self.kept.len());
        let mut order = vec![0_usize; n];
        if n > 0 {
            let mut inverse = vec![0_usize; n];
            let request = lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, Spec::default());
            let mut memory = MemBuffer::try_new(request)
                .map_err(|_| SolveError::NoMemory { unknowns: n, nonzeros: n * n })?;
            lu_in_place(
                MatMut::from_column_major_slice_mut(&mut self.ee, n, n),
                &mut order,
                &mut inverse,
                Par::Seq,
                MemStack::new(&mut memory),
                Spec::default(),
            );
            let singular = (0..n).find(|&i| self.ee[i + n * i] == 0.0 || !self.ee[i + n * i].is_finite());
            if let Some(i) = singular {
                return Err(SolveError::Singular { index: self.eliminated[i] as usize });
            }
        }
        let mut factors = Factors { order, lu: self.ee, ke: self.ke, solved: Vec::new() };
        if n > 0 && k > 0 {
            factors.solve(&mut self.ek, k);
            matmul(
                MatMut::from_column_major_slice_mut(&mut self.kk, k, k),
                Accum::Add,
                MatRef::from_column_major_slice(&factors.ke, k, n),
                MatRef::from_column_major_slice(&self.ek, n, k),
                -1.0,
                Par::Seq,
            );
        }
        factors.solved = self.ek;
        Ok((factors, self.kk))
    }
}

/// The stored part of a front.
#[derive(Clone, Debug)]
struct Factors {
    /// The row permutation of the factors.
    order: Vec<usize>,
    lu: Vec<f64>,
    ke: Vec<f64>,
    /// The inverse of the eliminated block times its coupling with the kept unknowns.
    solved: Vec<f64>,
}

impl Factors {
    /// Replaces columns by the inverse of the eliminated block times them.
    fn solve(&self, values: &mut [f64], count: usize) {
        let n = self.order.len();
        let mut column = vec![0.0; n];
        for values in values.chunks_exact_mut(n) {
            column.copy_from_slice(values);
            for (value, &row) in values.iter_mut().zip(&self.order) {
                *value = column[row];
            }
        }
        let lu = MatRef::from_column_major_slice(&self.lu, n, n);
        let mut right = MatMut::from_column_major_slice_mut(values, n, count);
        solve_unit_lower_triangular_in_place(lu, right.as_mut(), Par::Seq);
        solve_upper_triangular_in_place(lu, right, Par::Seq);
    }

    /// Forward elimination of a right-hand side.
    fn forward(&self, eliminated: &[u32], kept: &[u32], x: &mut [f64]) {
        if eliminated.is_empty() {
            return;
        }
        let mut own: Vec<f64> = eliminated.iter().map(|&u| x[u as usize]).collect();
        self.solve(&mut own, 1);
        for (column, &value) in self.ke.chunks_exact(kept.len().max(1)).zip(&own) {
            for (&u, entry) in kept.iter().zip(column) {
                x[u as usize] -= entry * value;
            }
        }
        for (&u, value) in eliminated.iter().zip(own) {
            x[u as usize] = value;
        }
    }

    fn backward(&self, eliminated: &[u32], kept: &[u32], x: &mut [f64]) {
        for (column, &k) in self.solved.chunks_exact(eliminated.len().max(1)).zip(kept) {
            let value = x[k as usize];
            for (&u, entry) in eliminated.iter().zip(column) {
                x[u as usize] -= entry * value;
            }
        }
    }
}

/// The factors of a [`FrontalPlan`].
#[derive(Debug)]
pub struct FrontalLu<'p> {
    plan: &'p FrontalPlan,
    elements: Vec<Factors>,
    fronts: Vec<Factors>,
}

impl LinearSolver for FrontalLu<'_> {
    fn unknowns(&self) -> usize {
        self.plan.unknowns
    }

    fn solve_in_place(&self, values: &mut [f64]) -> Result<(), SolveError> {
        let n = self.plan.unknowns;
        columns(n, values)?;
        for x in values.chunks_exact_mut(n.max(1)) {
            for (element, factors) in self.plan.elements.iter().zip(&self.elements) {
                factors.forward(&element.own, &element.shared, x);
            }
            for (group, factors) in self.plan.groups.iter().zip(&self.fronts) {
                factors.forward(&group.eliminated, &group.kept, x);
            }
            for (group, factors) in self.plan.groups.iter().zip(&self.fronts).rev() {
                factors.backward(&group.eliminated, &group.kept, x);
            }
            for (element, factors) in self.plan.elements.iter().zip(&self.elements) {
                factors.backward(&element.own, &element.shared, x);
            }
        }
        finite(n, values)
    }
}
