//! Linear problems with three unknowns, whose answers and eigenvalues are known.

use pompeiu_coupling::{Coupling, CouplingOptions, Function, Refusal, Scheme, Subproblem};

/// Eigenvalues −3, −0.5 and 0.2.
const MAP: [[f64; 3]; 3] = [[-3.0, 1.0, 2.0], [0.0, -0.5, 4.0], [0.0, 0.0, 0.2]];

/// `MAP y + c`, with c larger in each window.
struct Solid {
    window: f64,
}

impl Subproblem for Solid {
    fn inputs(&self) -> usize {
        3
    }

    fn outputs(&self) -> usize {
        3
    }

    fn solve(&mut self, input: &[f64], output: &mut [f64]) -> Result<(), Refusal> {
        for ((output, row), c) in output.iter_mut().zip(MAP).zip([1.0, -2.0, 0.5]) {
            *output = c * self.window * self.window + row.iter().zip(input).map(|(a, x)| a * x).sum::<f64>();
        }
        Ok(())
    }

    fn accept(&mut self) {
        self.window += 1.0;
    }
}

/// The answer of a window: `x = MAP x + c`, from the last row up.
fn exact(window: f64) -> [f64; 3] {
    let c = [1.0, -2.0, 0.5].map(|c| c * window * window);
    let z = c[2] / 0.8;
    let y = (c[1] + 4.0 * z) / 1.5;
    [(c[0] + y + 2.0 * z) / 4.0, y, z]
}

#[test]
fn what_is_learned_of_a_linear_problem_solves_it_and_columns_that_say_the_same_are_left_out() {
    for (scheme, columns, solves) in [(Scheme::IqnIls, 3, 6), (Scheme::TwoModels, 6, 5)] {
        let fluid = Function::new(3, 3, |x: &[f64], y: &mut [f64]| {
            y.copy_from_slice(x);
            Ok(())
        });
        let options = CouplingOptions { scheme, tolerance: 1e-10, ..CouplingOptions::default() };
        let mut coupling = Coupling::new(fluid, Solid { window: 1.0 }, &[0.0; 3], options).unwrap();
        for window in 1..6 {
            let report = coupling.advance().unwrap();
            // Three directions are all that there are; the solves of earlier windows say no more.
            let most = if window == 1 { solves } else { 3 };
            assert!(report.solves <= most && report.columns <= columns, "{scheme:?} {window}: {report:?}");
            if window == 1 {
                let added = report.added_mass.unwrap();
                assert!((added.number - 3.0).abs() < 1e-12, "{added:?}");
            }
            if window == 2 {
                assert_eq!((report.columns, report.dropped), (columns, 2), "{scheme:?}");
            }
            for (x, exact) in coupling.x().iter().zip(exact(f64::from(window))) {
                assert!((x - exact).abs() < 1e-9 * exact.abs(), "{x} {exact}");
            }
        }
    }
}
