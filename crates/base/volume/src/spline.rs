//! Cubic splines on the patches of a mesh: twice continuously differentiable within a patch, continuous across patches.

use crate::knots::{Line, OpenKnots};
use crate::{BezierMesh, CORNERS_OF_64, Refinement};
use glam::DVec3;

/// The spline functions of a mesh whose cells are patches, each cut into equal elements.
///
/// # Definition
/// Within a patch: tensor products of cubic B-splines over open knots with `elements` equal spans, twice continuously
/// differentiable. Across patches: functions whose coefficients lie on a common face, edge or corner are identified, so that the
/// space consists of all continuous functions that are such splines in each patch.
/// # Accuracy
/// Functions with four bounded derivatives in each patch are approximated to the fourth order in L² and the third in H¹, also at
/// extraordinary edges and corners: every patch keeps all functions of its boundary.
/// # Source
/// Open knots and identification of functions across patches: `cottrell_isogeometric_2009`.
#[derive(Clone, Debug)]
pub struct SplineSpace {
    knots: OpenKnots,
    functions: usize,
    patches: Vec<Vec<u32>>,
}

impl SplineSpace {
    /// The space with this many elements along each axis of each patch, at least one.
    pub fn new(mesh: &BezierMesh, elements: usize) -> Self {
        let knots = OpenKnots::new(elements);
        // The coefficients of a patch form a lattice with one step less than functions along each axis.
        let mut refinement = Refinement::new(knots.elements() + 2);
        let patches =
            mesh.cells().iter().map(|cell| refinement.lattice(CORNERS_OF_64.map(|k| cell[k]))).collect();
        Self { knots, functions: refinement.keys().len(), patches }
    }

    /// Number of functions.
    pub fn functions(&self) -> usize {
        self.functions
    }

    /// Elements along each axis of a patch.
    pub fn elements(&self) -> usize {
        self.knots.elements()
    }

    /// The functions of each patch, the first axis fastest, `elements` + 3 along each axis.
    pub fn patches(&self) -> &[Vec<u32>] {
        &self.patches
    }

    /// The functions along one axis at a parameter from 0 to 1 of the patch, in the given element; by the Cox–de Boor recursion.
    pub fn line(&self, element: usize, place: f64) -> Line {
        self.knots.line(element, place)
    }

    /// The coefficients of a tricubic in a patch: its blossoms at the knots. The spline is then the same tricubic.
    fn coefficients(&self, points: &[DVec3; 64]) -> Vec<DVec3> {
        let (m, whole) = (self.elements() + 3, [0.0, self.elements() as f64]);
        let rows: Vec<[f64; 4]> = (0..m).map(|function| self.knots.dual(function, whole)).collect();
        let mut result = Vec::with_capacity(m * m * m);
        for c in &rows {
            for b in &rows {
                for a in &rows {
                    let mut sum = DVec3::ZERO;
                    for (n, point) in points.iter().enumerate() {
                        sum += *point * (a[n % 4] * b[n / 4 % 4] * c[n / 16]);
                    }
                    result.push(sum);
                }
            }
        }
        result
    }

    /// The coefficients of the positions, or of another field with a coefficient for each control point: exact but for rounding.
    pub fn represent(&self, mesh: &BezierMesh, field: &[DVec3]) -> Vec<DVec3> {
        let mut result = vec![DVec3::ZERO; self.functions];
        for (patch, cell) in self.patches.iter().zip(mesh.cells()) {
            let values = self.coefficients(&cell.map(|k| field[k as usize]));
            for (&function, value) in patch.iter().zip(values) {
                result[function as usize] = value;
            }
        }
        result
    }

    /// For each element along an axis, the matrix that maps the coefficients of the four splines there to Bézier coefficients:
    /// entry `[k][r]` is the coefficient r of function k.
    pub fn extraction(&self) -> Vec<[[f64; 4]; 4]> {
        (0..self.elements()).map(|element| self.knots.bezier(element)).collect()
    }

    /// The greatest deviation from one of the sum of all functions, over a grid of points in each element. All patches have the
    /// same functions.
    pub fn partition_of_unity_error(&self) -> f64 {
        let mut worst = 0.0_f64;
        let places = [0.0, 0.173, 0.5, 0.827, 1.0];
        let lines: Vec<Line> = (0..self.elements())
            .flat_map(|e| places.map(|t| self.line(e, (e as f64 + t) / self.elements() as f64)))
            .collect();
        for c in &lines {
            for b in &lines {
                for a in &lines {
                    let mut sum = 0.0;
                    for n in 0..64 {
                        sum += a.values[n % 4] * b.values[n / 4 % 4] * c.values[n / 16];
                    }
                    worst = worst.max((sum - 1.0_f64).abs());
                }
            }
        }
        worst
    }
}
