//! Open knot vectors with equal spans, and their cubic B-splines.

use crate::bernstein::blossoms;

/// Knots from 0 to the number of elements, the first and the last with multiplicity four: three more functions than elements along
/// an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct OpenKnots(usize);

/// Values and derivatives of the four B-splines that do not vanish in an element. The number of the first is that of the element.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// The element, which is the number of the first function.
    pub first: usize,
    /// Values.
    pub values: [f64; 4],
    /// Derivatives with respect to the parameter of the patch, from 0 to 1.
    pub slopes: [f64; 4],
}

impl OpenKnots {
    /// Knots of this many elements, at least one.
    pub(crate) fn new(elements: usize) -> Self {
        Self(elements.max(1))
    }

    pub(crate) fn elements(self) -> usize {
        self.0
    }

    /// Knot k of `elements` + 7, in units of elements.
    fn knot(self, k: usize) -> f64 {
        k.saturating_sub(3).min(self.0) as f64
    }

    /// The inner knots of a function, in units of elements: its coefficient in a spline is the spline's blossom at these knots.
    fn inner(self, function: usize) -> [f64; 3] {
        [1, 2, 3].map(|k| self.knot(function + k))
    }

    /// The blossoms of the four functions in an element, at arguments in units of elements, and those of its three quadratic
    /// functions; by the Cox–de Boor recursion.
    fn blossoms(self, element: usize, arguments: [f64; 3]) -> ([f64; 4], [f64; 4]) {
        let span = element + 3;
        let mut values = [1.0, 0.0, 0.0, 0.0];
        let mut lower = values;
        for (degree, t) in (1..4).zip(arguments) {
            lower = values;
            values = [0.0; 4];
            for k in 0..degree {
                // Function k of the lower degree begins at this knot.
                let (a, b) = (self.knot(span + 1 + k - degree), self.knot(span + 1 + k));
                let share = lower[k] / (b - a);
                values[k] += (b - t) * share;
                values[k + 1] += (t - a) * share;
            }
        }
        (values, lower)
    }

    /// The functions at a parameter from 0 to 1 in the given element.
    pub(crate) fn line(self, element: usize, place: f64) -> Line {
        let span = element + 3;
        let (values, lower) = self.blossoms(element, [place * self.0 as f64; 3]);
        let mut slopes = [0.0; 4];
        for k in 0..3 {
            let share = 3.0 * lower[k] / (self.knot(span + 1 + k) - self.knot(span + k - 2));
            slopes[k] -= share;
            slopes[k + 1] += share;
        }
        Line { first: element, values, slopes: slopes.map(|s| s * self.0 as f64) }
    }

    /// The weights of the Bézier coefficients over an interval, in units of elements, in the coefficient of a function.
    pub(crate) fn dual(self, function: usize, [a, b]: [f64; 2]) -> [f64; 4] {
        blossoms(self.inner(function).map(|knot| (knot - a) / (b - a)))
    }

    /// The extraction matrix of an element: each row holds the four Bézier coefficients of a function.
    pub(crate) fn bezier(self, element: usize) -> [[f64; 4]; 4] {
        let (a, b) = (element as f64, (element + 1) as f64);
        let columns =
            [[a, a, a], [a, a, b], [a, b, b], [b, b, b]].map(|arguments| self.blossoms(element, arguments).0);
        transposed(columns)
    }

    /// The two-scale matrix of an element of the knots with twice as many: each row holds the coefficients of a function of the
    /// enclosing element in the four functions of the smaller one.
    pub(crate) fn two_scale(self, half: usize) -> [[f64; 4]; 4] {
        let fine = Self(2 * self.0);
        let columns = [0, 1, 2, 3].map(|k| self.blossoms(half / 2, fine.inner(half + k).map(|x| x / 2.0)).0);
        transposed(columns)
    }
}

fn transposed(columns: [[f64; 4]; 4]) -> [[f64; 4]; 4] {
    std::array::from_fn(|row| std::array::from_fn(|column| columns[column][row]))
}
