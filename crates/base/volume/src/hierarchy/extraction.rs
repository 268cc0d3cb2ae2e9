//! Bézier coefficients of truncated functions, element by element.

use super::HierarchicalSplines;
use super::level::Status;
use crate::bezier::along_lines;
use crate::{CellKind, CellSplines};
use rayon::prelude::*;

/// A 4 × 4 matrix for each axis: rows express four functions in four others.
type Shares = [[[f64; 4]; 4]; 3];

/// Applies the matrices along the three axes to the 64 coefficients of a function.
fn times(row: &[f64; 64], shares: &Shares) -> [f64; 64] {
    along_lines(row, |axis, line| {
        [0, 1, 2, 3].map(|k| (0..4).map(|from| line[from] * shares[axis][from][k]).sum())
    })
}

impl HierarchicalSplines {
    /// The functions that do not vanish in an element, with their Bézier coefficients there. Computed level by level: functions are
    /// expressed in those of the next level and truncated.
    ///
    /// # Panics
    /// If there is no such element.
    /// # Source
    /// `hennig_bezier_2016`.
    pub fn splines_of(&self, element: usize) -> CellSplines {
        let element = &self.elements[element];
        let last = usize::from(element.level);
        let mut rows: Vec<(u32, [f64; 64])> = Vec::new();
        let mut is_of_one_level = true;
        for (number, level) in self.levels[..=last].iter().enumerate() {
            let place = element.place.map(|i| usize::from(i) >> (last - number));
            let functions = level.on(element.patch, place);
            if let Some(coarser) = number.checked_sub(1) {
                let shares = place.map(|half| self.levels[coarser].knots.two_scale(half));
                for (_, row) in &mut rows {
                    *row = times(row, &shares);
                    for (share, function) in row.iter_mut().zip(functions) {
                        if level.status[function as usize] != Status::Outside {
                            *share = 0.0;
                        }
                    }
                }
                rows.retain(|(_, row)| row.iter().any(|share| *share != 0.0));
            }
            is_of_one_level = rows.is_empty();
            for (k, function) in functions.into_iter().enumerate() {
                if let Status::Active(function) = level.status[function as usize] {
                    let mut row = [0.0; 64];
                    row[k] = 1.0;
                    rows.push((function, row));
                }
            }
        }
        let (knots, place) = (self.levels[last].knots, element.place.map(usize::from));
        let bezier = place.map(|i| knots.bezier(i));
        let is_regular = is_of_one_level && place.iter().all(|&i| i >= 3 && i + 3 < knots.elements());
        CellSplines {
            kind: if is_regular { CellKind::Regular } else { CellKind::Irregular },
            functions: rows.iter().map(|(function, _)| *function).collect(),
            coefficients: rows.iter().map(|(_, row)| times(row, &bezier)).collect(),
        }
    }

    /// A bound on the deviation from one of the sum of all functions over all elements, from the Bézier coefficients of the sum.
    pub fn partition_of_unity_error(&self) -> f64 {
        let of = |element: usize| {
            let splines = self.splines_of(element);
            let off = |k: usize| (splines.coefficients.iter().map(|c| c[k]).sum::<f64>() - 1.0).abs();
            (0..64).map(off).fold(0.0, f64::max)
        };
        (0..self.elements.len()).into_par_iter().map(of).reduce(|| 0.0, f64::max)
    }
}
