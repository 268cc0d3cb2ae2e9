//! Fields in truncated hierarchical splines: representation, prolongation and quasi-interpolation.

use super::{HierarchicalElement, HierarchicalSplines};
use crate::bernstein::{interpolate_lattice, part, value};
use crate::bezier::cut;
use crate::{BezierMesh, VolumeError};
use glam::DVec3;
use rayon::prelude::*;

impl HierarchicalSplines {
    /// The coefficients of the positions, or of another field with a coefficient for each control point: exact but for rounding.
    ///
    /// # Source
    /// The coefficient of a truncated function is that of the function before it was truncated: `giannelli_strongly_2014`.
    pub fn represent(&self, mesh: &BezierMesh, field: &[DVec3]) -> Vec<DVec3> {
        let of = |&(element, at): &(u32, u8)| {
            let element = &self.elements[element as usize];
            let cell = mesh.cells()[element.patch as usize].map(|k| field[k as usize]);
            let whole = [0.0, self.along(element.level.into()) as f64];
            self.coefficient(element, at, &cell, [whole; 3])
        };
        self.homes.par_iter().map(of).collect()
    }

    /// Prolongation to a refinement of this space: the coefficients there of the same field, exact but for rounding. Zero where the
    /// other space is no refinement of this one.
    ///
    /// # Panics
    /// Unless there is a coefficient for each function.
    pub fn prolonged(&self, fine: &Self, coefficients: &[DVec3]) -> Vec<DVec3> {
        let pieces = self.bezier_field(coefficients);
        let of = |&(element, at): &(u32, u8)| {
            let element = &fine.elements[element as usize];
            let level = usize::from(element.level);
            // The active element here that contains it, with its interval in units of elements of the finer level.
            let around = (0..=level.min(self.levels.len() - 1)).rev().find_map(|number| {
                let place = element.place.map(|i| usize::from(i) >> (level - number));
                Some((number, place, self.levels[number].element(element.patch, place)?))
            });
            let Some((number, place, piece)) = around else { return DVec3::ZERO };
            let intervals = place.map(|i| [i, i + 1].map(|end| (end << (level - number)) as f64));
            fine.coefficient(element, at, &pieces[piece as usize], intervals)
        };
        fine.homes.par_iter().map(of).collect()
    }

    /// The coefficients of a quasi-interpolant of a field: each from the tricubic that interpolates the field at 64 points of one
    /// element.
    ///
    /// # Accuracy
    /// Reproduces tricubics in each patch, and has the approximation order of the space.
    /// # Source
    /// `speleers_effortless_2016`.
    pub fn approximate(&self, mesh: &BezierMesh, field: &(dyn Fn(DVec3) -> DVec3 + Sync)) -> Vec<DVec3> {
        let of = |&(number, at): &(u32, u8)| {
            let element = &self.elements[number as usize];
            let points = self.control(mesh, number as usize);
            let values =
                std::array::from_fn(|k| field(value(&points, crate::place_of_64(k).map(|i| i as f64 / 3.0))));
            let cell = interpolate_lattice(&values);
            let intervals = element.place.map(|i| [f64::from(i), f64::from(i) + 1.0]);
            self.coefficient(element, at, &cell, intervals)
        };
        self.homes.par_iter().map(of).collect()
    }

    /// The coefficient of one of the 64 functions of an element's level, in a spline that equals the tricubic with these Bézier
    /// coefficients over intervals in units of elements.
    fn coefficient(
        &self,
        element: &HierarchicalElement,
        at: u8,
        piece: &[DVec3; 64],
        intervals: [[f64; 2]; 3],
    ) -> DVec3 {
        let knots = self.levels[usize::from(element.level)].knots;
        let at = crate::place_of_64(at.into());
        let [a, b, c] =
            [0, 1, 2].map(|axis| knots.dual(usize::from(element.place[axis]) + at[axis], intervals[axis]));
        piece.iter().enumerate().map(|(n, p)| *p * (a[n % 4] * b[n / 4 % 4] * c[n / 16])).sum()
    }

    /// The Bézier coefficients of a field in each element.
    ///
    /// # Panics
    /// Unless there is a coefficient for each function.
    pub fn bezier_field(&self, coefficients: &[DVec3]) -> Vec<[DVec3; 64]> {
        let of = |element: usize| {
            let splines = self.splines_of(element);
            let mut points = [DVec3::ZERO; 64];
            for (&function, shares) in splines.functions.iter().zip(&splines.coefficients) {
                for (point, share) in points.iter_mut().zip(shares) {
                    *point += coefficients[function as usize] * *share;
                }
            }
            points
        };
        (0..self.elements.len()).into_par_iter().map(of).collect()
    }

    /// The control points of an element: a part of its patch.
    ///
    /// # Panics
    /// If there is no such element.
    pub fn control(&self, mesh: &BezierMesh, element: usize) -> [DVec3; 64] {
        let element = &self.elements[element];
        let parts = self.intervals(element).map(|[a, b]| part(a, b));
        cut(&mesh.control(element.patch as usize), parts.each_ref())
    }

    /// The elements as cells, each with its own control points: they do not conform where their levels differ.
    ///
    /// # Errors
    /// Those of [`BezierMesh::new`].
    pub fn cells(&self, mesh: &BezierMesh) -> Result<BezierMesh, VolumeError> {
        let points: Vec<[DVec3; 64]> =
            (0..self.elements.len()).into_par_iter().map(|element| self.control(mesh, element)).collect();
        let cells = (0..points.len()).map(|k| std::array::from_fn(|i| (64 * k + i) as u32)).collect();
        BezierMesh::new(points.into_iter().flatten().collect(), cells)
    }
}
