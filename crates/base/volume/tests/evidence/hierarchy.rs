//! Truncated hierarchical splines: sums, positions, independence, nested spaces, a count by definition, and errors that fall where
//! elements are refined.

use crate::splines::{bent, star};
use glam::DVec3;
use pompeiu_solve::{Cholesky, LinearSolver, SparseMatrix};
use pompeiu_volume::bernstein::{GAUSS_4, derivatives, value};
use pompeiu_volume::{BezierMesh, HexMesh, HierarchicalSplines, SplineSpace};
use std::collections::HashMap;

/// A bent star, each cell divided into 27 patches.
fn patches(valence: u32, height: f64) -> BezierMesh {
    bent(&star(valence, height)).subdivided(3, &[]).unwrap().0
}

/// Refines repeatedly the elements near a point of the extraordinary edge in the middle of a star.
fn refined(mesh: &BezierMesh, times: usize) -> HierarchicalSplines {
    let mut splines = HierarchicalSplines::new(mesh, 1);
    for level in 0..times {
        let near = |k: &usize| {
            let points = splines.control(mesh, *k);
            let is_near = points.iter().any(|p| p.length() < 0.2);
            usize::from(splines.elements()[*k].level) == level && is_near
        };
        let marked: Vec<usize> = (0..splines.elements().len()).filter(near).collect();
        assert!(!marked.is_empty());
        splines = splines.refined(mesh, &marked);
    }
    splines
}

/// The greatest difference of the control points of two lists of cells.
fn difference(a: &[[DVec3; 64]], b: &[[DVec3; 64]]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().flatten().zip(b.iter().flatten()).map(|(p, q)| (*p - *q).abs().max_element()).fold(0.0, f64::max)
}

#[test]
fn truncated_functions_add_up_to_one_and_reproduce_positions() {
    for (mesh, times) in [(patches(3, 1.0), 2), (patches(5, 0.7), 1)] {
        let splines = refined(&mesh, times);
        assert_eq!(splines.functions_of_levels().len(), times + 1);
        assert!(
            splines.functions_of_levels().iter().all(|count| *count > 0),
            "{:?}",
            splines.functions_of_levels()
        );
        assert!(splines.partition_of_unity_error() <= 1e-14, "{:e}", splines.partition_of_unity_error());
        let least = splines
            .extraction()
            .cells()
            .iter()
            .flat_map(|cell| cell.coefficients.iter().flatten().copied().collect::<Vec<_>>())
            .fold(f64::INFINITY, f64::min);
        assert!(least >= 0.0, "{least:e}");
        // Cubic maps of patches, among them the linear ones.
        let places = splines.bezier_field(&splines.represent(&mesh, mesh.points()));
        let cells: Vec<[DVec3; 64]> =
            (0..splines.elements().len()).map(|element| splines.control(&mesh, element)).collect();
        assert!(difference(&places, &cells) < 1e-13, "{:e}", difference(&places, &cells));
        let volume = splines.cells(&mesh).unwrap().volume();
        assert!((volume / mesh.volume() - 1.0).abs() < 1e-13, "{volume} {}", mesh.volume());
    }
}

#[test]
fn spaces_contain_those_that_they_were_refined_from() {
    let mesh = patches(3, 1.0);
    let [coarse, middle, fine] = [0, 1, 2].map(|times| refined(&mesh, times));
    for (coarse, fine) in [(&coarse, &middle), (&middle, &fine), (&coarse, &fine)] {
        // Coefficients without any order.
        let of = |k: usize| DVec3::new((1.7 * k as f64).sin(), (2.9 * k as f64).cos(), (k % 7) as f64 - 3.0);
        let coefficients: Vec<DVec3> = (0..coarse.functions()).map(of).collect();
        let same = coarse.prolonged(fine, &coefficients);
        let pieces = coarse.bezier_field(&coefficients);
        let fields = fine.bezier_field(&same);
        let around: HashMap<_, _> = coarse
            .elements()
            .iter()
            .zip(&pieces)
            .map(|(e, piece)| ((e.level, e.patch, e.place), piece))
            .collect();
        for (element, field) in fine.elements().iter().zip(&fields) {
            let (up, piece) = (0..=element.level)
                .find_map(|up| {
                    let key = (element.level - up, element.patch, element.place.map(|i| i >> up));
                    Some((up, *around.get(&key)?))
                })
                .unwrap();
            for place in [[0.0, 0.3, 1.0], [0.5, 0.9, 0.1]] {
                let at = [0, 1, 2].map(|axis| {
                    let within = element.place[axis] % (1 << up);
                    (f64::from(within) + place[axis]) / f64::from(1_u16 << up)
                });
                let off = (value(field, place) - value(piece, at)).length();
                assert!(off < 1e-12, "{element:?} {off:e}");
            }
        }
    }
}

/// The ratio of the greatest to the least eigenvalue of the mass matrix scaled to a unit diagonal, with elements taken as cubes.
fn condition(splines: &HierarchicalSplines) -> f64 {
    // Integrals of products of cubic Bernstein polynomials.
    const MASS: [[f64; 4]; 4] =
        [[20.0, 10.0, 4.0, 1.0], [10.0, 12.0, 9.0, 4.0], [4.0, 9.0, 12.0, 10.0], [1.0, 4.0, 10.0, 20.0]];
    let n = splines.functions();
    let mut entries = vec![0.0; n * n];
    for (element, cell) in splines.elements().iter().zip(splines.extraction().cells()) {
        let weight = 0.125_f64.powi(element.level.into());
        for (a, &i) in cell.functions.iter().enumerate() {
            let mut row = cell.coefficients[a];
            for [stride, p, q] in [[1, 4, 16], [4, 1, 16], [16, 1, 4]] {
                for start in (0..16).map(|n| n % 4 * p + n / 4 * q) {
                    let line = [0, 1, 2, 3].map(|k| row[start + k * stride]);
                    for (k, mass) in MASS.iter().enumerate() {
                        row[start + k * stride] = (0..4).map(|l| line[l] * mass[l]).sum();
                    }
                }
            }
            for (b, &j) in cell.functions.iter().enumerate() {
                let sum: f64 = row.iter().zip(&cell.coefficients[b]).map(|(x, y)| x * y).sum();
                entries[n * i as usize + j as usize] += weight * sum;
            }
        }
    }
    let diagonal: Vec<f64> = (0..n).map(|k| entries[n * k + k].sqrt()).collect();
    let present = entries.into_iter().enumerate().filter(|(_, x)| *x != 0.0);
    let triplets: Vec<_> =
        present.map(|(at, x)| (at / n, at % n, x / (diagonal[at / n] * diagonal[at % n]))).collect();
    let matrix = SparseMatrix::from_triplets(n, n, &triplets).unwrap();
    let solver = Cholesky::new(&matrix).unwrap();
    let power = |step: &dyn Fn(&[f64]) -> Vec<f64>| {
        let (mut x, mut norm): (Vec<f64>, f64) = ((0..n).map(|k| (k as f64).sin()).collect(), 0.0);
        for _ in 0..60 {
            let y = step(&x);
            norm = y.iter().map(|v| v * v).sum::<f64>().sqrt();
            x = y.iter().map(|v| v / norm).collect();
        }
        norm
    };
    power(&|x| matrix.multiply(x)) * power(&|x| solver.solve(x).unwrap())
}

#[test]
fn truncated_functions_are_linearly_independent() {
    let mesh = patches(3, 1.0);
    let [plain, found] = [0, 2].map(|times| condition(&refined(&mesh, times)));
    println!("condition {found:.0}, {plain:.0} without refinement");
    assert!(found < 20.0 * plain, "{found} {plain}");
}

#[test]
fn active_functions_are_those_of_the_definition() {
    let mesh = patches(5, 0.7);
    let splines = refined(&mesh, 2);
    // The level of the element that contains each smallest element.
    let mut level_at: HashMap<(u32, [usize; 3]), u8> = HashMap::new();
    for element in splines.elements() {
        let size = 1 << (2 - element.level);
        for n in 0..size * size * size {
            let within = [n % size, n / size % size, n / size / size];
            let place = [0, 1, 2].map(|axis| usize::from(element.place[axis]) * size + within[axis]);
            assert!(level_at.insert((element.patch, place), element.level).is_none());
        }
    }
    assert_eq!(level_at.len(), 5 * 27 * 4_usize.pow(3), "elements cover every patch once");
    for level in 0..3_u8 {
        let along = 1 << level;
        let space = SplineSpace::new(&mesh, along);
        let mut least = vec![u8::MAX; space.functions()];
        for (patch, functions) in space.patches().iter().enumerate() {
            for (at, &function) in functions.iter().enumerate() {
                let m = along + 3;
                let axes = [at % m, at / m % m, at / m / m].map(|i| {
                    let size = 1 << (2 - level);
                    i.saturating_sub(3) * size..(i.min(along - 1) + 1) * size
                });
                for k in axes[2].clone() {
                    for j in axes[1].clone() {
                        for i in axes[0].clone() {
                            let there = level_at[&(patch as u32, [i, j, k])];
                            least[function as usize] = least[function as usize].min(there);
                        }
                    }
                }
            }
        }
        // In elements of its level or finer ones, but not in finer ones only.
        let count = least.iter().map(|least| usize::from(*least == level)).sum::<usize>();
        assert_eq!(splines.functions_of_levels()[usize::from(level)], count, "level {level}");
        assert!(count > 0);
    }
    // All elements of all patches: the next uniform space.
    let all: Vec<usize> = (0..5 * 27).collect();
    let uniform = HierarchicalSplines::new(&mesh, 1).refined(&mesh, &all);
    assert_eq!(uniform.functions(), SplineSpace::new(&mesh, 2).functions());
    assert_eq!(uniform.functions_of_levels()[0], 0);
    // Elements that do not exist, and those of the last level, change nothing.
    let none = splines.refined(&mesh, &[usize::MAX]);
    assert_eq!((none.functions(), none.elements()), (splines.functions(), splines.elements()));
}

/// The error in L² of a quasi-interpolant of a ridge across a bent rod, and the share of each element in its square.
fn error(mesh: &BezierMesh, splines: &HierarchicalSplines) -> (f64, Vec<f64>) {
    let exact = |p: DVec3| DVec3::X * (-(p.x - 3.1).powi(2) / 0.09).exp();
    let field = splines.bezier_field(&splines.approximate(mesh, &exact));
    let share = |(element, field): (usize, &[DVec3; 64])| {
        let points = splines.control(mesh, element);
        let of = |n: usize| {
            let rule = [GAUSS_4[n % 4], GAUSS_4[n / 4 % 4], GAUSS_4[n / 16]];
            let place = rule.map(|r| r.0);
            let [du, dv, dw] = derivatives(&points, place);
            let weight: f64 = rule.iter().map(|r| r.1).product();
            let off = value(field, place).x - exact(value(&points, place)).x;
            weight * du.dot(dv.cross(dw)) * off * off
        };
        (0..64).map(of).sum()
    };
    let shares: Vec<f64> = field.iter().enumerate().map(share).collect();
    (shares.iter().sum::<f64>().sqrt(), shares)
}

#[test]
fn errors_of_a_local_feature_fall_as_those_of_uniform_elements_do_with_fewer_functions() {
    let rod = BezierMesh::from_trilinear(&HexMesh::grid([6, 1, 1], [6.0, 1.0, 1.0]));
    let bend = |p: &DVec3| *p + DVec3::new(0.0, 0.1 * (0.8 * p.x).sin(), 0.02 * p.x * p.x);
    let mesh = BezierMesh::new(rod.points().iter().map(bend).collect(), rod.cells().to_vec()).unwrap();
    let uniform = [2, 4, 8].map(|elements| {
        let splines = HierarchicalSplines::new(&mesh, elements);
        (splines.functions(), error(&mesh, &splines).0)
    });
    let mut splines = HierarchicalSplines::new(&mesh, 2);
    let refined = [0, 1, 2].map(|_| {
        let (sum, shares) = error(&mesh, &splines);
        let functions = splines.functions();
        let most = shares.iter().fold(0.0, |most: f64, x| most.max(*x));
        let marked: Vec<usize> = (0..shares.len()).filter(|&k| shares[k] > 0.002 * most).collect();
        splines = splines.refined(&mesh, &marked);
        (functions, sum)
    });
    println!("uniform {uniform:?}, refined {refined:?}");
    let rate = (refined[1].1 / refined[2].1).log2();
    assert!(rate > 3.7, "{rate}");
    for ((functions, error), (of_uniform, least)) in refined.into_iter().zip(uniform).skip(1) {
        assert!(
            error < 1.1 * least && 3 * functions < 2 * of_uniform,
            "{functions} {error} {of_uniform} {least}"
        );
    }
}
