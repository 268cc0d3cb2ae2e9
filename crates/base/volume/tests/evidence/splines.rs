//! Tricubic cells and splines: certificates against dense samples, closed forms, convergence rates, VTK's order of points.

use glam::DVec3;
use pompeiu_solve::{Cholesky, LinearSolver, SparseMatrix};
use pompeiu_volume::bernstein::{GAUSS_4, bernstein, derivatives, interpolate_lattice, value};
use pompeiu_volume::{
    BezierMesh, Faces, HexMesh, Jacobian, SplineSpace, bezier_volume, certify_bezier, face_flux, place_of_64,
    scaled_jacobian_bezier, slopes_at, write_bezier_vtu,
};

/// Rhombic patches around an axis, one layer high.
pub(crate) fn star(valence: u32, height: f64) -> HexMesh {
    let ring = |k: u32, radius: f64, z: f64| {
        let angle = std::f64::consts::PI * f64::from(k) / f64::from(valence);
        DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
    };
    let mut positions = Vec::new();
    for z in [0.0, height] {
        positions.push(DVec3::new(0.0, 0.0, z));
        positions.extend((0..2 * valence).map(|k| ring(k, 1.0, z)));
    }
    let up = 1 + 2 * valence;
    let cells = (0..valence)
        .map(|k| {
            let quad = [0, 1 + 2 * k, 2 + 2 * k, 1 + (2 * k + 2) % (2 * valence)];
            [quad[0], quad[1], quad[2], quad[3], up, up + quad[1], up + quad[2], up + quad[3]]
        })
        .collect();
    HexMesh::new(positions, cells).unwrap()
}

/// The mesh with smoothly displaced control points.
pub(crate) fn bent(mesh: &HexMesh) -> BezierMesh {
    let straight = BezierMesh::from_trilinear(mesh);
    let bend = |p: DVec3| {
        p + DVec3::new(0.08 * (1.5 * p.y).sin(), 0.1 * p.x * p.z, 0.1 * (p.x * 1.2).cos() + 0.05 * p.y * p.y)
    };
    let mut points = straight.points().to_vec();
    for cell in straight.cells() {
        let lattice = std::array::from_fn(|k| bend(value(&straight_cell(&straight, cell), thirds(k))));
        for (&k, point) in cell.iter().zip(interpolate_lattice(&lattice)) {
            points[k as usize] = point;
        }
    }
    BezierMesh::new(points, straight.cells().to_vec()).unwrap()
}

fn straight_cell(mesh: &BezierMesh, cell: &[u32; 64]) -> [DVec3; 64] {
    cell.map(|k| mesh.points()[k as usize])
}

fn thirds(k: usize) -> [f64; 3] {
    place_of_64(k).map(|i| i as f64 / 3.0)
}

struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[test]
fn certificates_of_tricubic_cells_agree_with_dense_samples() {
    let mut random = Random(11);
    let (mut positive, mut folded, mut undecided) = (0, 0, 0);
    for trial in 0..400 {
        let size = 0.02 + 0.4 * f64::from(trial % 10) / 10.0;
        let points: [DVec3; 64] = std::array::from_fn(|k| {
            let [x, y, z] = thirds(k);
            let mut shift = || size * (random.next() - 0.5);
            DVec3::new(x + shift(), y + shift(), z + shift())
        });
        let mut least = f64::INFINITY;
        for n in 0..9_usize.pow(3) {
            let [du, dv, dw] = derivatives(&points, [n % 9, n / 9 % 9, n / 81].map(|i| i as f64 / 8.0));
            least = least.min(du.dot(dv.cross(dw)));
        }
        match certify_bezier(&points) {
            Jacobian::Positive => {
                positive += 1;
                assert!(least > 0.0, "{least}");
            }
            Jacobian::Folded => folded += 1,
            Jacobian::Undecided => {
                undecided += 1;
                assert!(least.abs() < 0.05, "{least}");
            }
        }
        assert!(certify_bezier(&points) == Jacobian::Positive || least < 0.1, "{least}");
        let (slopes, table) =
            (slopes_at(&points, &[(bernstein(0.3), [0.0; 4])]), scaled_jacobian_bezier(&points));
        assert!(slopes.len() == 1 && (least > 0.0 || table < 0.2));
    }
    assert!(positive > 50 && folded > 30 && undecided < 40, "{positive} {folded} {undecided}");
}

#[test]
fn cells_that_fold_inside_only_are_not_positive() {
    // The middle of a cube is pulled through one side; all corners keep their angles.
    let points: [DVec3; 64] = std::array::from_fn(|k| {
        let [x, y, z] = thirds(k);
        let inside = place_of_64(k).iter().all(|i| *i == 1 || *i == 2);
        DVec3::new(if inside { x + 2.0 } else { x }, y, z)
    });
    assert_eq!(certify_bezier(&points), Jacobian::Folded);
}

#[test]
fn parts_of_cells_are_the_same_map_and_keep_volume_and_flux() {
    let mesh = bent(&star(3, 1.0));
    let field: Vec<DVec3> = mesh.points().iter().map(|p| DVec3::new(p.y, p.z * p.x, p.x + 0.3)).collect();
    let (fine, fields) = mesh.subdivided(3, &[&field]).unwrap();
    assert_eq!((fine.cells().len(), fields.len()), (81, 1));
    assert!((fine.volume() / mesh.volume() - 1.0).abs() < 1e-14);
    // Part (1, 0, 2) of the second cell.
    let part = fine.control(27 + 1 + 9 * 2);
    let whole = mesh.control(1);
    for place in [[0.2, 0.7, 0.4], [1.0, 0.0, 0.3]] {
        let at = [(1.0 + place[0]) / 3.0, place[1] / 3.0, (2.0 + place[2]) / 3.0];
        assert!((value(&part, place) - value(&whole, at)).length() < 1e-14);
    }
    // The flux out of all cells is the flux through the boundary, summed by parts or by whole cells.
    let total = |mesh: &BezierMesh, field: &[DVec3]| -> (f64, f64) {
        let control = |c: usize| (mesh.control(c), mesh.cells()[c].map(|k| field[k as usize]));
        let flux = |cell: usize, face: usize| {
            let (points, field) = control(cell);
            face_flux(&points, &field, face)
        };
        let faces = Faces::new(&mesh.corner_mesh().unwrap()).unwrap();
        let all = (0..mesh.cells().len()).map(|c| (0..6).map(|f| flux(c, f)).sum::<f64>()).sum();
        (all, faces.boundary().iter().map(|face| flux(face.cell as usize, face.place.into())).sum())
    };
    let (coarse, fine) = (total(&mesh, &field), total(&fine, &fields[0]));
    for x in [coarse.1, fine.0, fine.1] {
        assert!((x - coarse.0).abs() < 1e-13, "{coarse:?} {fine:?}");
    }
    let box_volume =
        bezier_volume(&BezierMesh::from_trilinear(&HexMesh::grid([1, 1, 1], [2.0, 3.0, 0.5])).control(0));
    assert!((box_volume - 3.0).abs() < 1e-14);
}

#[test]
fn splines_add_up_to_one_and_reproduce_positions() {
    for (mesh, valence) in [(bent(&star(3, 1.0)), 3), (bent(&star(5, 0.7)), 5)] {
        for elements in [1, 2, 5] {
            let space = SplineSpace::new(&mesh, elements);
            assert!(space.partition_of_unity_error() <= 1e-14);
            let m = elements + 3;
            assert_eq!(space.functions(), m * (valence * (m - 1) * (m - 1) + valence * (m - 1) + 1));
            let coefficients = space.represent(&mesh, mesh.points());
            for (patch, cell) in space.patches().iter().zip(0..) {
                let points = mesh.control(cell);
                for place in [[0.0, 0.33, 1.0], [0.71, 0.52, 0.05], [0.999, 0.4, 0.6]] {
                    let lines =
                        place.map(|t| space.line(((t * elements as f64) as usize).min(elements - 1), t));
                    let mut sum = DVec3::ZERO;
                    for n in 0..64 {
                        let at = [n % 4, n / 4 % 4, n / 16];
                        let [i, j, k] = [0, 1, 2].map(|axis| lines[axis].first + at[axis]);
                        let weight: f64 = (0..3).map(|axis| lines[axis].values[at[axis]]).product();
                        sum += coefficients[patch[i + m * (j + m * k)] as usize] * weight;
                    }
                    assert!((sum - value(&points, place)).length() < 1e-13);
                }
            }
        }
    }
}

#[test]
fn splines_have_two_continuous_derivatives_and_their_extraction_is_exact() {
    let mesh = BezierMesh::from_trilinear(&HexMesh::grid([1, 1, 1], [1.0; 3]));
    let space = SplineSpace::new(&mesh, 3);
    let extraction = space.extraction();
    for (element, matrix) in extraction.iter().enumerate() {
        for t in [0.0, 0.4, 1.0] {
            let place = (element as f64 + t) / 3.0;
            let line = space.line(element, place);
            let weights = bernstein(t);
            for k in 0..4 {
                let expected: f64 = (0..4).map(|r| weights[r] * matrix[k][r]).sum();
                assert!((line.values[k] - expected).abs() < 1e-14);
            }
            assert!(line.slopes.iter().sum::<f64>().abs() < 1e-13);
        }
    }
    // Values, slopes and second differences on either side of an inner knot.
    for knot in [1, 2] {
        let place = knot as f64 / 3.0;
        let h = 1e-5;
        for function in 0..6_usize {
            let of = |element: usize, place: f64| {
                let line = space.line(element, place);
                let k = function.wrapping_sub(line.first);
                if k < 4 { [line.values[k], line.slopes[k]] } else { [0.0; 2] }
            };
            let (left, right) = (of(knot - 1, place), of(knot, place));
            assert!((left[0] - right[0]).abs() < 1e-14 && (left[1] - right[1]).abs() < 1e-12);
            let second = [left[1] - of(knot - 1, place - h)[1], of(knot, place + h)[1] - right[1]];
            assert!((second[0] - second[1]).abs() / h < 0.1, "{second:?}");
        }
    }
}

/// Called at a point with functions, values, gradients, weight and position.
type Act<'a> = dyn FnMut(&[u32; 64], &[f64; 64], &[DVec3; 64], f64, DVec3) + 'a;

/// The errors in L² and in the first derivatives of the Ritz projection for −Δ + 1, including natural boundary terms.
fn ritz(mesh: &BezierMesh, elements: usize) -> [f64; 2] {
    let exact = |p: DVec3| (1.3 * p.x + 0.4).sin() * (1.1 * p.y - 0.2).cos() * (0.7 * p.z).exp();
    let slope = |p: DVec3| {
        let (x, y, z) = (1.3 * p.x + 0.4, 1.1 * p.y - 0.2, (0.7 * p.z).exp());
        DVec3::new(1.3 * x.cos() * y.cos(), -1.1 * x.sin() * y.sin(), 0.7 * x.sin() * y.cos()) * z
    };
    let space = SplineSpace::new(mesh, elements);
    let m = elements + 3;
    // All points of all elements: functions there, their gradients, the weight, the position.
    let each = |act: &mut Act<'_>| {
        for (patch, cell) in space.patches().iter().zip(0..) {
            let points = mesh.control(cell);
            for n in 0..elements.pow(3) {
                let element = [n % elements, n / elements % elements, n / elements / elements];
                let functions: [u32; 64] = std::array::from_fn(|l| {
                    let at = [l % 4, l / 4 % 4, l / 16];
                    let [i, j, k] = [0, 1, 2].map(|axis| element[axis] + at[axis]);
                    patch[i + m * (j + m * k)]
                });
                for q in 0..64 {
                    let rule = [GAUSS_4[q % 4], GAUSS_4[q / 4 % 4], GAUSS_4[q / 16]];
                    let place = [0, 1, 2].map(|a| (element[a] as f64 + rule[a].0) / elements as f64);
                    let lines = [0, 1, 2].map(|a| space.line(element[a], place[a]));
                    let [du, dv, dw] = derivatives(&points, place);
                    let det = du.dot(dv.cross(dw));
                    let dual = [dv.cross(dw) / det, dw.cross(du) / det, du.cross(dv) / det];
                    let mut values = [0.0; 64];
                    let mut gradients = [DVec3::ZERO; 64];
                    for l in 0..64 {
                        let at = [l % 4, l / 4 % 4, l / 16];
                        let [a, b, c] = [0, 1, 2].map(|x| lines[x].values[at[x]]);
                        let [sa, sb, sc] = [0, 1, 2].map(|x| lines[x].slopes[at[x]]);
                        values[l] = a * b * c;
                        gradients[l] =
                            dual[0] * (sa * b * c) + dual[1] * (a * sb * c) + dual[2] * (a * b * sc);
                    }
                    let weight = det * rule.iter().map(|r| r.1).product::<f64>() / (elements as f64).powi(3);
                    act(&functions, &values, &gradients, weight, value(&points, place));
                }
            }
        }
    };
    let n = space.functions();
    let mut entries: std::collections::BTreeMap<(usize, usize), f64> = std::collections::BTreeMap::new();
    let mut right = vec![0.0; n];
    let mut local = vec![0.0; 64 * 64];
    let mut count = 0;
    each(&mut |functions, values, gradients, weight, p| {
        let (u, du) = (exact(p), slope(p));
        for i in 0..64 {
            right[functions[i] as usize] += weight * (values[i] * u + gradients[i].dot(du));
            for j in 0..=i {
                local[64 * i + j] += weight * (values[i] * values[j] + gradients[i].dot(gradients[j]));
            }
        }
        count += 1;
        if count % 64 == 0 {
            for i in 0..64 {
                for j in 0..64 {
                    *entries.entry((functions[i] as usize, functions[j] as usize)).or_default() +=
                        local[64 * i.max(j) + i.min(j)];
                }
            }
            local.fill(0.0);
        }
    });
    let triplets: Vec<_> = entries.into_iter().map(|((i, j), v)| (i, j, v)).collect();
    let matrix = SparseMatrix::from_triplets(n, n, &triplets).unwrap();
    let solution = Cholesky::new(&matrix).unwrap().solve(&right).unwrap();
    let mut errors = [0.0; 2];
    each(&mut |functions, values, gradients, weight, p| {
        let (mut u, mut du) = (-exact(p), -slope(p));
        for i in 0..64 {
            u += solution[functions[i] as usize] * values[i];
            du += gradients[i] * solution[functions[i] as usize];
        }
        errors[0] += weight * u * u;
        errors[1] += weight * du.length_squared();
    });
    errors.map(f64::sqrt)
}

#[test]
fn errors_fall_with_the_fourth_and_third_power_at_extraordinary_edges_too() {
    let cube = BezierMesh::from_trilinear(&HexMesh::grid([1, 1, 1], [1.5, 1.0, 1.0]));
    for (name, mesh, parts) in [
        ("cube", cube, [3, 6]),
        ("valence 3", bent(&star(3, 0.6)), [3, 6]),
        ("valence 5", bent(&star(5, 0.6)), [3, 5]),
    ] {
        let [coarse, fine] = parts.map(|elements| ritz(&mesh, elements));
        let ratio = (parts[1] as f64 / parts[0] as f64).ln();
        let [values, slopes] = [0, 1].map(|k| (coarse[k] / fine[k]).ln() / ratio);
        println!("{name}: rates {values:.2} and {slopes:.2}, errors {fine:?}");
        assert!(values >= 3.8 && slopes >= 2.8, "{name}: {values} {slopes}");
    }
}

#[test]
fn files_of_bezier_cells_begin_with_the_corners_in_their_order() {
    let mesh = BezierMesh::from_trilinear(&HexMesh::grid([1, 1, 1], [1.0; 3]));
    let mut bytes = Vec::new();
    write_bezier_vtu(&mut bytes, &mesh, &[], &[]).unwrap();
    let text = String::from_utf8_lossy(&bytes);
    assert!(text.contains("version=\"2.2\"") && text.contains("NumberOfPoints=\"64\""));
    let marker = b"<AppendedData encoding=\"raw\">\n_";
    let start = bytes.windows(marker.len()).position(|w| w == marker).unwrap() + marker.len();
    let number = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap()) as usize;
    let connectivity = start + 8 + 64 * 24 + 8;
    let order: Vec<usize> = (0..64).map(|k| number(connectivity + 8 * k)).collect();
    let place = |k: usize| mesh.points()[order[k]] * 3.0;
    // Points as documented by VTK: corner 6, then edges, faces and the inside by axis.
    for (k, expected) in [
        (6, [3, 3, 3]),
        (8, [1, 0, 0]),
        (10, [3, 1, 0]),
        (13, [2, 3, 0]),
        (24, [0, 0, 1]),
        (28, [3, 3, 1]),
        (30, [0, 3, 1]),
        (32, [0, 1, 1]),
        (63, [2, 2, 2]),
    ] {
        assert!((place(k) - DVec3::from(expected.map(f64::from))).length() < 1e-14, "{k}: {}", place(k));
    }
    let mut sorted = order;
    sorted.sort_unstable();
    assert_eq!(sorted, (0..64).collect::<Vec<_>>());
}
