//! Splines with one function per vertex, their files, and partitions: closed forms, convergence rates, results of other programs.

use crate::Random;
use flate2::read::GzDecoder;
use glam::DVec3;
use pompeiu_solve::{Cholesky, LinearSolver, SparseMatrix};
use pompeiu_volume::bernstein::{GAUSS_4, bernstein, derivatives, value};
use pompeiu_volume::{
    CellKind, ExtractionFiles, Faces, HexMesh, UnstructuredSplines, bezier_volume, controlmesh, epart,
    iga_units, partition, partition_quality, read_bzmeshinfo, read_bzpt,
};
use std::io::Read;
use std::path::PathBuf;

fn splines(mesh: &HexMesh) -> UnstructuredSplines {
    UnstructuredSplines::new(mesh, &Faces::new(mesh).unwrap())
}

#[test]
fn cells_of_a_grid_have_the_uniform_cubic_b_splines() {
    let mesh = HexMesh::grid([5, 5, 5], [5.0; 3]);
    let found = splines(&mesh);
    assert!(found.partition_of_unity_error() < 1e-15);
    let middle = &found.cells()[2 + 5 * (2 + 5 * 2)];
    assert_eq!((middle.kind, middle.functions.len()), (CellKind::Regular, 64));
    let number = |kind| found.cells().iter().filter(|cell| cell.kind == kind).count();
    assert_eq!((number(CellKind::Boundary), number(CellKind::Regular)), (98, 27));
    // The rows of the extraction of uniform cubic B-splines, for the four knots around the cell along each axis.
    let row = |offset: i64| match offset {
        -1 => [1.0 / 6.0, 0.0, 0.0, 0.0],
        0 => [4.0 / 6.0, 4.0 / 6.0, 2.0 / 6.0, 1.0 / 6.0],
        1 => [1.0 / 6.0, 2.0 / 6.0, 4.0 / 6.0, 4.0 / 6.0],
        _ => [0.0, 0.0, 0.0, 1.0 / 6.0],
    };
    for (&v, list) in middle.functions.iter().zip(&middle.coefficients) {
        let p = mesh.positions()[v as usize];
        let [a, b, c] = [p.x, p.y, p.z].map(|x| row(x.round() as i64 - 2));
        for (k, x) in list.iter().enumerate() {
            assert!((x - a[k % 4] * b[k / 4 % 4] * c[k / 16]).abs() < 1e-15, "{v} {k}");
        }
    }
    // Positions inside are kept; boundary edges are rounded off at their ends.
    let points = found.bezier_points(mesh.positions());
    assert!(
        (value(&points[2 + 5 * (2 + 5 * 2)], [0.3, 0.6, 0.9]) - DVec3::new(2.3, 2.6, 2.9)).length() < 1e-14
    );
    let bezier = found.bezier_mesh(&mesh).unwrap();
    assert!(bezier.volume() < 125.0 && bezier.volume() > 120.0, "{}", bezier.volume());
}

#[test]
fn files_are_read_back_and_damage_is_located() {
    let mesh = HexMesh::grid([3, 2, 1], [3.0, 2.0, 1.0]);
    let found = splines(&mesh);
    let text = found.cmat();
    let back = UnstructuredSplines::from_cmat(&text).unwrap();
    assert_eq!(found.difference(&back), Some(0.0));
    let info = read_bzmeshinfo(&found.bzmeshinfo()).unwrap();
    assert!(info.iter().zip(found.cells()).all(|(a, b)| *a == b.functions));
    let points = read_bzpt(&found.bzpt(mesh.positions())).unwrap();
    assert_eq!(points, found.bezier_points(mesh.positions()));
    let wrong = |text: &str| UnstructuredSplines::from_cmat(text).unwrap_err().to_string();
    assert_eq!(wrong(""), "line 1: found \"\", expected the number of cells");
    assert_eq!(wrong("1000000000000\n0 8 5"), "line 2: found \"0 8 5\", expected a type of 0, 1 or 2");
    assert_eq!(wrong("1\n1 8 1"), "line 2: found \"1 8 1\", expected cell 0");
    assert_eq!(wrong("1\n0 8 1\n1 2"), "line 3: found \"1 2\", expected 8 functions");
    assert_eq!(wrong("1\n0 1 1\n7\n0.5 x"), "line 4: found \"0.5 x\", expected 64 coefficients");
    let cut = &text[..text.len() / 2];
    assert!(UnstructuredSplines::from_cmat(cut).is_err() && read_bzpt("63\n").is_err());
    assert_eq!(
        read_bzmeshinfo("1\n0 1\n").unwrap_err().to_string(),
        "line 2: found \"0 1\", expected numbers from 1"
    );
    assert!(UnstructuredSplines::from_cmat(&(text + "7\n")).is_err());
}

#[test]
fn files_written_cell_by_cell_are_those_of_all_cells() {
    // More cells than are written at a time, and numbers with many digits.
    let mesh = HexMesh::grid([7, 6, 5], [3.0, 2.0, 1.0]);
    let faces = Faces::new(&mesh).unwrap();
    let found = splines(&mesh);
    let places = iga_units(mesh.positions());
    let mut files = ExtractionFiles { bzmeshinfo: Vec::new(), bzpt: Vec::new(), cmat: Vec::new() };
    files.write_unstructured(&mesh, &faces, &places).unwrap();
    let texts = [files.bzmeshinfo, files.bzpt, files.cmat].map(|text| String::from_utf8(text).unwrap());
    assert_eq!(texts, [found.bzmeshinfo(), found.bzpt(&places), found.cmat()]);
    let points = read_bzpt(&texts[1]).unwrap();
    assert_eq!(points, found.bezier_points(&places));
}

/// Called with the cell, the values of its functions, the weight and the position of each quadrature point.
type Act<'a> = &'a mut dyn FnMut(usize, &[f64], f64, DVec3);

/// The relative error of the L² projection of a function.
fn projection_error(n: u32) -> f64 {
    let mesh = HexMesh::grid([n, n, n], [1.0; 3]);
    let found = splines(&mesh);
    let points = found.bezier_points(mesh.positions());
    let exact = |p: DVec3| (p.x + 0.5 * p.y).exp() + p.z * p.z;
    let count = mesh.positions().len();
    let (mut entries, mut right) = (Vec::new(), vec![0.0; count]);
    let each = |act: Act<'_>| {
        for (c, cell) in found.cells().iter().enumerate() {
            for q in 0..64 {
                let rule = [GAUSS_4[q % 4], GAUSS_4[q / 4 % 4], GAUSS_4[q / 16]];
                let [a, b, d] = rule.map(|r| bernstein(r.0));
                let shapes: [f64; 64] = std::array::from_fn(|k| a[k % 4] * b[k / 4 % 4] * d[k / 16]);
                let values: Vec<f64> = cell
                    .coefficients
                    .iter()
                    .map(|list| list.iter().zip(&shapes).map(|(x, s)| x * s).sum())
                    .collect();
                let [du, dv, dw] = derivatives(&points[c], rule.map(|r| r.0));
                let weight = du.dot(dv.cross(dw)) * rule.iter().map(|r| r.1).product::<f64>();
                act(c, &values, weight, value(&points[c], rule.map(|r| r.0)));
            }
        }
    };
    let mut blocks: Vec<Vec<f64>> =
        found.cells().iter().map(|c| vec![0.0; c.functions.len().pow(2)]).collect();
    each(&mut |c, values, weight, p| {
        let functions = &found.cells()[c].functions;
        let block = &mut blocks[c];
        for (i, a) in values.iter().enumerate() {
            right[functions[i] as usize] += weight * a * exact(p);
            let row = &mut block[i * values.len()..(i + 1) * values.len()];
            for (entry, b) in row.iter_mut().zip(values) {
                *entry += weight * a * b;
            }
        }
    });
    for (cell, block) in found.cells().iter().zip(blocks) {
        let m = cell.functions.len();
        for (k, x) in block.into_iter().enumerate() {
            entries.push((cell.functions[k / m] as usize, cell.functions[k % m] as usize, x));
        }
    }
    let solver = Cholesky::new(&SparseMatrix::from_triplets(count, count, &entries).unwrap()).unwrap();
    let solution = solver.solve(&right).unwrap();
    let (mut error, mut norm) = (0.0, 0.0);
    each(&mut |c, values, weight, p| {
        let found: f64 =
            found.cells()[c].functions.iter().zip(values).map(|(&f, v)| solution[f as usize] * v).sum();
        error += weight * (found - exact(p)).powi(2);
        norm += weight * exact(p).powi(2);
    });
    (error / norm).sqrt()
}

#[test]
fn the_rule_at_the_boundary_costs_the_order_of_cubics() {
    let (coarse, fine) = (projection_error(4), projection_error(8));
    let rate = (coarse / fine).log2();
    println!("rate {rate:.2}, errors {coarse:.2e} {fine:.2e}");
    assert!((2.2..3.2).contains(&rate), "{rate}");
}

fn shipped(name: &str) -> Option<PathBuf> {
    pompeiu_testkit::data::file(&format!("neurons/bifurcation/{name}"))
}

fn text(name: &str) -> Option<String> {
    let mut text = String::new();
    GzDecoder::new(std::fs::File::open(shipped(name)?).unwrap()).read_to_string(&mut text).unwrap();
    Some(text)
}

#[test]
fn the_extraction_and_the_partition_are_those_that_others_ship() {
    let Some(path) = shipped("controlmesh.vtk.gz") else { return };
    let read = pompeiu_io::read_hexahedra(&path).unwrap();
    let labels: Vec<i64> = read.labels.unwrap().iter().map(|x| *x as i64).collect();
    let positions: Vec<DVec3> = read.positions.iter().copied().map(DVec3::from).collect();
    let mesh = HexMesh::new(positions.clone(), read.cells).unwrap();
    let faces = Faces::new(&mesh).unwrap();
    let found = UnstructuredSplines::new(&mesh, &faces);
    let number = |kind| found.cells().iter().filter(|cell| cell.kind == kind).count();
    let kinds = [CellKind::Regular, CellKind::Boundary, CellKind::Irregular].map(number);
    assert_eq!(kinds, [8632, 3260, 888]);
    assert!(found.partition_of_unity_error() < 1e-14);
    // The volume of its own files, whose points have six digits.
    let volume: f64 = found.bezier_points(&iga_units(&positions)).iter().map(bezier_volume).sum();
    assert!((volume - 0.034_916_61).abs() < 2e-7, "{volume}");
    if let Some(info) = text("bzmeshinfo.txt.gz") {
        assert!(info == found.bzmeshinfo(), "the functions of some cell differ");
    }
    // Written as it was read, but for the number of digits.
    let file = controlmesh(&mesh, &labels);
    let folder = std::env::temp_dir().join(format!("pompeiu-controlmesh-{}.vtk", std::process::id()));
    std::fs::write(&folder, file).unwrap();
    let back = pompeiu_io::read_hexahedra(&folder).unwrap();
    std::fs::remove_file(&folder).unwrap();
    assert_eq!(back.positions.len(), positions.len());
    assert!(back.labels.unwrap().iter().zip(&labels).all(|(a, b)| *a as i64 == *b));
    if let Some(theirs) = text("bzmeshinfo.txt.epart.28.gz") {
        let theirs: Vec<u32> = theirs.lines().map(|line| line.parse().unwrap()).collect();
        let ours = partition(mesh.cells().len(), &faces, 28);
        let (a, b) = (partition_quality(&faces, &ours), partition_quality(&faces, &theirs));
        println!("ours {a:?}, METIS {b:?}");
        assert!(a.imbalance < 1.03 && (a.cut as f64) <= 1.05 * b.cut as f64, "{a:?} {b:?}");
    }
}

#[test]
fn partitions_are_balanced_small_and_repeatable() {
    let mesh = HexMesh::grid([40, 4, 4], [40.0, 4.0, 4.0]);
    let faces = Faces::new(&mesh).unwrap();
    for parts in [1, 2, 3, 5, 8] {
        let of = partition(640, &faces, parts);
        let quality = partition_quality(&faces, &of);
        // Slices across the long axis.
        assert_eq!(of.iter().max().map(|m| *m as usize + 1), Some(parts));
        assert!(quality.imbalance <= 1.06 && quality.cut <= 22 * (parts - 1), "{parts} {quality:?}");
        assert_eq!(of, partition(640, &faces, parts));
    }
    // Cells in any order, disconnected, and more parts than cells.
    let mut random = Random(3);
    let mut cells = mesh.cells().to_vec();
    cells.sort_by_cached_key(|_| (random.next() * 1e9) as u64);
    let kept: Vec<[u32; 8]> = cells.into_iter().take(300).collect();
    let ragged = HexMesh::new(mesh.positions().to_vec(), kept).unwrap();
    let faces = Faces::new(&ragged).unwrap();
    let of = partition(300, &faces, 7);
    assert!(partition_quality(&faces, &of).imbalance < 1.1);
    assert_eq!(partition(3, &Faces::new(&HexMesh::grid([3, 1, 1], [3.0, 1.0, 1.0])).unwrap(), 9).len(), 3);
    assert_eq!(epart(&[0, 2, 1]), "0\n2\n1\n");
}
