//! Certificates: what is written is accepted, what is false is not, and each cell that is accepted is near its face in exact arithmetic.

use crate::touching::{Triangle, on_lattice, soup, touching, triangles};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::shapes::{Diagonal, Ends, cylinder, grid, icosphere, schwarz_lantern, torus};
use pompeiu_core::run::Limits;
use pompeiu_hausdorff::certificate::{
    Certificate, CertificateError, CertificateOptions, Goal, write_certificate, write_packed,
};
use pompeiu_hausdorff::{HausdorffOptions, Method, Tolerance, directed_hausdorff, symmetric_hausdorff};
use pompeiu_testkit::certificate::is_true;
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::strategies::{pair, scaled};
use pompeiu_verify::{MAGIC, Rejected, Soup, Verified, verify};
use proptest::prelude::*;

/// Cells of a pair of some faces: of 46,000 random pairs of these kinds the worst took 41.
const MOST_CELLS: u64 = 200;

type Written = Result<(Certificate, Vec<u8>), CertificateError>;

fn write(a: &TriMesh, b: &TriMesh, goals: [Option<Goal>; 2]) -> Written {
    let mut bytes = Vec::new();
    let made = write_certificate(a, b, goals, &CertificateOptions::default(), &mut bytes)?;
    Ok((made, bytes))
}

fn check(a: &TriMesh, b: &TriMesh, bytes: &[u8], threads: usize) -> Result<Verified, Rejected> {
    let [a, b] = [a, b].map(|mesh| Soup::new(mesh.positions(), mesh.faces()).unwrap());
    verify(&a, &b, bytes, threads)
}

/// Both ends of a report, the upper one raised by what commands raise it by unless told otherwise.
fn both(a: &TriMesh, b: &TriMesh) -> [Option<Goal>; 2] {
    let diagonal = Aabb::of_faces(a).union(Aabb::of_faces(b)).diagonal();
    Goal::of_both(&symmetric_hausdorff(a, b), Goal::SLACK * diagonal)
}

fn meshes() -> (TriMesh, TriMesh) {
    (torus(1.0, 0.3, 60, 40).unwrap(), torus(1.01, 0.31, 37, 23).unwrap())
}

#[test]
fn what_is_written_is_accepted_at_the_ends_of_the_report() {
    let (a, b) = meshes();
    let report = symmetric_hausdorff(&a, &b);
    let (made, bytes) = write(&a, &b, Goal::of_both(&report, 0.0)).unwrap();
    let verified = check(&a, &b, &bytes, 1).unwrap();
    assert_eq!(made.bytes, bytes.len() as u64);
    for (claim, (certified, direction)) in
        verified.claims.iter().zip([(made.a_to_b, &report.a_to_b), (made.b_to_a, &report.b_to_a)])
    {
        let (claim, certified) = (claim.unwrap(), certified.unwrap());
        assert_eq!(
            (claim.lower, claim.upper, claim.cells),
            (certified.lower, certified.upper, certified.cells)
        );
        assert_eq!(claim.upper, direction.distance.upper());
        let lost = direction.distance.lower() - claim.lower;
        assert!((0.0..1e-14).contains(&lost), "{lost:e}");
    }
}

#[test]
fn a_certificate_is_read_packed_and_unpacked() {
    let (a, b) = (icosphere(1.0, 0).unwrap(), torus(0.8, 0.5, 7, 5).unwrap());
    let (_, plain) = write(&a, &b, both(&a, &b)).unwrap();
    let mut packed = Vec::new();
    let options = CertificateOptions::default();
    let made = write_packed(&mut packed, |into| write_certificate(&a, &b, both(&a, &b), &options, into));
    assert_eq!(made.unwrap().bytes, packed.len() as u64);
    assert!(packed.len() < plain.len() && !packed.starts_with(MAGIC));
    assert_eq!(check(&a, &b, &packed, 2).unwrap(), check(&a, &b, &plain, 2).unwrap());
    assert!(exact_verdict(&a, &b, &packed).is_none_or(|code| code == 0));
    for damaged in [&packed[..packed.len() / 2], &packed[..30], &packed[..2]] {
        assert!(check(&a, &b, damaged, 2).unwrap_err().is_unreadable());
    }
}

/// Polygons with corners on the line of their longest side were halved for ever.
#[test]
fn a_lantern_beside_a_cylinder_is_certified() {
    let (a, b) =
        (schwarz_lantern(1.0, 2.0, 48, 192).unwrap(), cylinder(1.0, 2.0, 256, 8, Ends::Open).unwrap());
    let [goal, _] = both(&a, &b);
    let (made, bytes) = write(&a, &b, [goal, None]).unwrap();
    check(&a, &b, &bytes, 2).unwrap();
    let cells = made.a_to_b.unwrap().cells;
    assert!(cells < 20 * a.faces().len() as u64, "{cells}");
}

#[test]
fn the_bytes_and_the_verdict_are_those_of_any_number_of_threads() {
    let (a, b) = (icosphere(1.0, 5).unwrap(), torus(0.8, 0.5, 150, 90).unwrap());
    let goals = both(&a, &b);
    let at = |threads| {
        let limits = Limits { threads: Limits::threads(threads).ok(), ..Limits::default() };
        let mut bytes = Vec::new();
        write_certificate(&a, &b, goals, &CertificateOptions { limits }, &mut bytes).unwrap();
        bytes
    };
    let bytes = at(1);
    assert!(at(2) == bytes && at(8) == bytes);
    let mut damaged = bytes.clone();
    for part in 1..5 {
        damaged[bytes.len() * part / 5] ^= 0x10;
    }
    let errors = [1, 2, 8].map(|threads| check(&a, &b, &damaged, threads).unwrap_err().to_string());
    assert!(errors.iter().all(|error| *error == errors[0]), "{errors:?}");
    assert_eq!(check(&a, &b, &bytes, 8).unwrap(), check(&a, &b, &bytes, 1).unwrap());
}

#[test]
fn answers_of_every_method_and_within_limits_are_certified() {
    let (a, b) = meshes();
    let soon = Limits { time: Some(std::time::Duration::ZERO), ..Limits::default() };
    let small = Limits { memory: Some(1), ..Limits::default() };
    for options in [
        HausdorffOptions {
            method: Method::Classic,
            tolerance: Tolerance::Absolute(0.01),
            ..Default::default()
        },
        HausdorffOptions { limits: soon, ..Default::default() },
        HausdorffOptions { limits: small, ..Default::default() },
        HausdorffOptions { threshold: Some(0.001), ..Default::default() },
        HausdorffOptions { threshold: Some(1.0), ..Default::default() },
    ] {
        let report = options.symmetric(&a, &b).unwrap();
        let (_, bytes) = write(&a, &b, Goal::of_both(&report, 0.0)).unwrap();
        check(&a, &b, &bytes, 2).unwrap();
    }
    let (made, bytes) = write(&a, &b, [None, Some(Goal::within(0.5))]).unwrap();
    let claims = check(&a, &b, &bytes, 2).unwrap().claims;
    assert!(made.a_to_b.is_none() && claims[0].is_none());
    assert_eq!(claims[1].map(|claim| (claim.lower, claim.upper)), Some((0.0, 0.5)));
}

#[test]
fn less_than_the_distance_is_refused_by_the_writer() {
    let (a, b) = meshes();
    let h = directed_hausdorff(&a, &b).distance;
    for below in [1e-13, 1e-9, 1e-3, 0.5, 1.0] {
        let upper = h.lower() * (1.0 - below);
        let refused = write(&a, &b, [Some(Goal::within(upper)), None]);
        assert!(matches!(refused, Err(CertificateError::Far { .. })), "{below:e}: {refused:?}");
    }
}

#[test]
fn other_meshes_and_other_claims_are_rejected() {
    let (a, b) = meshes();
    let (_, bytes) = write(&a, &b, both(&a, &b)).unwrap();
    assert!(matches!(check(&b, &a, &bytes, 1), Err(Rejected::Hash(0))));
    let moved = icosphere(1.0, 3).unwrap();
    assert!(matches!(check(&a, &moved, &bytes, 1), Err(Rejected::Hash(1))));
    let with = |at: usize, change: &dyn Fn(f64) -> f64| {
        let mut forged = bytes.clone();
        let number = f64::from_le_bytes(forged[at..at + 8].try_into().unwrap());
        forged[at..at + 8].copy_from_slice(&change(number).to_le_bytes());
        check(&a, &b, &forged, 2)
    };
    let (lower, upper) = (73, 81);
    assert!(matches!(with(lower, &|x| x * 1.000_001), Err(Rejected::Witness(..))));
    assert!(matches!(with(upper, &|x| x * 0.999), Err(Rejected::Cell { .. })));
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        assert!(matches!(with(lower, &|_| bad), Err(Rejected::Claim(..))));
        assert!(matches!(with(upper, &|_| bad), Err(Rejected::Claim(..))));
    }
    assert!(with(lower, &|_| 0.0).is_ok() && with(upper, &|x| 2.0 * x).is_ok(), "weaker claims hold");
}

#[test]
fn every_shortened_certificate_is_unreadable() {
    let (a, b) = (icosphere(1.0, 1).unwrap(), torus(0.8, 0.5, 12, 9).unwrap());
    let (_, bytes) = write(&a, &b, both(&a, &b)).unwrap();
    for length in 0..bytes.len() {
        assert!(check(&a, &b, &bytes[..length], 1).unwrap_err().is_unreadable(), "{length}");
    }
    assert!(check(&a, &b, &[&bytes[..], &[0]].concat(), 1).unwrap_err().is_unreadable());
}

/// The second verifier, in Python with exact fractions; none where there is no Python.
fn exact_verdict(a: &TriMesh, b: &TriMesh, bytes: &[u8]) -> Option<i32> {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    for (name, mesh) in [("a.obj", a), ("b.obj", b)] {
        pompeiu_io::write(path(name), mesh).unwrap();
    }
    std::fs::write(path("certificate"), bytes).unwrap();
    let program = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../examples/verify/verify.py");
    let mut command = std::process::Command::new("python3");
    let arguments = ["certificate", "a.obj", "b.obj"].map(path);
    command.arg(program).args(arguments).output().ok().and_then(|output| output.status.code())
}

#[test]
fn both_verifiers_agree_on_what_is_written_and_on_what_is_damaged() {
    let turned = |mesh: &TriMesh| {
        let turn = |[x, y, z]: [f64; 3]| [0.8 * x - 0.6 * y, 0.6 * x + 0.8 * y, z];
        TriMesh::new(mesh.positions().iter().map(|p| turn(*p)).collect(), mesh.faces().to_vec()).unwrap()
    };
    let square = |n| grid([1.0; 2], [n; 2], Diagonal::Rising).unwrap();
    let pairs = [
        (icosphere(1.0, 0).unwrap(), torus(0.8, 0.5, 7, 5).unwrap()),
        (square(3), turned(&square(2))),
        (square(2), square(3)),
    ];
    for (a, b) in pairs {
        let (_, bytes) = write(&a, &b, both(&a, &b)).unwrap();
        let Some(code) = exact_verdict(&a, &b, &bytes) else {
            println!("skipped: there is no python3");
            return;
        };
        assert_eq!((code, check(&a, &b, &bytes, 1).is_ok()), (0, true));
        for step in 0..6 {
            let mut damaged = bytes.clone();
            damaged[(step * 7919 + 73) % bytes.len()] ^= 1 << (step % 8);
            let code = exact_verdict(&a, &b, &damaged).unwrap();
            match check(&a, &b, &damaged, 1) {
                Ok(_) => assert_eq!(code, 0, "what arithmetic with bounds accepts is true"),
                Err(error) if error.is_unreadable() => assert_eq!(code, 2, "{error}"),
                // Bounds may reject what is true by less than rounding.
                Err(_) => assert!(code < 2),
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(24)))]

    #[test]
    fn less_than_the_distance_is_never_accepted((a, b) in pair(), digits in 1..16_i32) {
        let h = directed_hausdorff(&a, &b).distance;
        let goal = Goal::within(h.lower() * (1.0 - 10_f64.powi(-digits)));
        let diagonal = Aabb::of_faces(&a).union(Aabb::of_faces(&b)).diagonal();
        if h.lower() * 10_f64.powi(-digits) > 1e-15 * diagonal {
            prop_assert!(write(&a, &b, [Some(goal), None]).is_err());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(300)))]

    #[test]
    fn random_pairs_are_certified_and_every_cell_is_near_in_exact_arithmetic((a, b) in pair()) {
        let written = write(&a, &b, both(&a, &b));
        prop_assert!(written.is_ok(), "{written:?}");
        let (_, bytes) = written.unwrap();
        check(&a, &b, &bytes, 1).unwrap();
        prop_assert!(is_true(&a, &b, &bytes));
    }

    #[test]
    fn any_scale_is_certified((a, b) in pair(), exponent in -980..980_i32) {
        if let Some((a, b)) = scaled(&a, exponent).zip(scaled(&b, exponent)) {
            let report = symmetric_hausdorff(&a, &b);
            let slack = Goal::SLACK * Aabb::of_faces(&a).union(Aabb::of_faces(&b)).diagonal();
            let (_, bytes) = write(&a, &b, Goal::of_both(&report, slack)).unwrap();
            check(&a, &b, &bytes, 1).unwrap();
        }
    }

    #[test]
    fn what_is_accepted_after_damage_is_true((a, b) in pair(), at in 73..10_000_usize, bit in 0..8_u32, times in 1..4_usize) {
        let (_, mut bytes) = write(&a, &b, both(&a, &b)).unwrap();
        for i in 0..times {
            let length = bytes.len() - 73;
            bytes[73 + (at * (2 * i + 1)) % length] ^= 1 << bit;
        }
        if check(&a, &b, &bytes, 1).is_ok() {
            prop_assert!(is_true(&a, &b, &bytes));
        }
    }
}

/// The certificate of a pair is written at the ends of the report, holds, and takes few cells.
fn takes_few_cells(a: &[Triangle], b: &[Triangle]) {
    let (a, b) = (soup(a), soup(b));
    let (made, bytes) = write(&a, &b, both(&a, &b)).unwrap();
    let cells = [made.a_to_b, made.b_to_a].into_iter().flatten().map(|one| one.cells).sum::<u64>();
    assert!(cells <= MOST_CELLS, "{cells}");
    check(&a, &b, &bytes, 1).unwrap();
}

/// A face of A that is a segment lies where two faces of B tie: no part of it has more area than another.
#[test]
fn a_segment_among_coplanar_faces_takes_few_cells() {
    takes_few_cells(
        &[
            [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 2.0, 0.0]],
            [[0.0, -2.0, 0.0], [-2.0, 2.0, 0.0], [0.0, -2.0, 0.0]],
        ],
        &[
            [[-1.0, 2.0, 0.0], [-2.0, -1.0, 0.0], [0.0, -1.0, 0.0]],
            [[0.0, 2.0, 0.0], [-2.0, 0.0, 0.0], [-2.0, 2.0, 0.0]],
            [[0.0, -2.0, 0.0], [0.0, 0.0, 0.0], [2.0, 2.0, 0.0]],
        ],
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(200)))]

    #[test]
    fn lattice_pairs_take_few_cells(a in triangles(on_lattice(), 3), b in triangles(on_lattice(), 4)) {
        takes_few_cells(&a, &b);
    }

    #[test]
    fn coplanar_lattice_pairs_take_few_cells(a in triangles(on_lattice(), 3), b in triangles(on_lattice(), 4)) {
        let flat = |all: Vec<Triangle>| all.into_iter().map(|t| t.map(|[x, y, _]| [x, y, 0.0])).collect::<Vec<_>>();
        takes_few_cells(&flat(a), &flat(b));
    }

    #[test]
    fn touching_pairs_take_few_cells((a, b) in touching()) {
        takes_few_cells(&a, &b);
    }
}

/// Whose corners lie on a line, but for rounding, the third between the others: what was taken from its middle left it as long as it was,
/// for ever.
#[test]
fn a_face_that_is_a_segment_is_certified() {
    let a = TriMesh::new(
        vec![
            [0.806_479_442_045_588_2, -0.75, 0.75],
            [-0.883_222_275_445_964_5, -0.5, -0.25],
            [0.079_645_300_469_408_76, -0.642_461_176_127_701_3, 0.319_844_704_510_804_8],
        ],
        vec![[0, 1, 2]],
    )
    .unwrap();
    let b = TriMesh::new(
        vec![
            [0.0, 0.0, 0.0],
            [0.25, -0.939_197_564_741_373_4, 0.987_273_445_982_911_6],
            [0.0, 0.394_064_929_198_328_6, 0.0],
            [0.0, 0.0, -0.422_997_711_275_265_25],
            [1.0, -0.75, 0.379_166_842_815_830_1],
            [-1.0, -0.5, -0.392_293_411_582_333_7],
            [0.0, 0.0, -0.450_372_907_029_659_54],
            [0.0, 0.608_089_001_673_305_5, 0.0],
            [-1.0, 0.0, 0.696_234_378_122_277_2],
            [0.0, -0.832_177_143_285_627_3, 0.0],
        ],
        vec![[0, 0, 1], [2, 3, 4], [5, 6, 7], [8, 0, 9]],
    )
    .unwrap();
    write(&a, &b, both(&a, &b)).unwrap();
}
