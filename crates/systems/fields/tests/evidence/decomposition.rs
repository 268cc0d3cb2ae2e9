//! Known parts are recovered; parts are orthogonal and add up.

use crate::common::{Field, Random, cases, shared_cases, surface};
use crate::compare::{distance, norm, sum};
use pompeiu_core::FaceId;
use pompeiu_core::mesh::shapes;
use pompeiu_fields::{Decomposition, DecompositionOptions, HodgeSolver};
use pompeiu_operators::{Boundary, OperatorError, Splitting, crouzeix_raviart_gradient, gradient, rotated};
use pompeiu_surface::{EmbeddedSurface, Surface, flat_torus};

fn solver(surface: &Surface, splitting: Splitting, boundary: Boundary) -> HodgeSolver<'_> {
    HodgeSolver::new(surface, &DecompositionOptions { splitting, boundary }).unwrap()
}

const KINDS: [(Splitting, Boundary); 4] = [
    (Splitting::Primal, Boundary::Tangential),
    (Splitting::Primal, Boundary::Normal),
    (Splitting::Dual, Boundary::Tangential),
    (Splitting::Dual, Boundary::Normal),
];

/// A gradient, a rotated gradient and a harmonic field of a splitting, each of norm one.
fn planted(solver: &HodgeSolver, random: &mut Random) -> [Field; 3] {
    let surface = solver.surface();
    let mesh = surface.mesh();
    let mut a = random.values(mesh.vertices());
    let mut b = random.values(mesh.edges());
    // In the dual splitting the vertex potential belongs to the rotated part.
    let vertices_fixed = (solver.boundary() == Boundary::Normal) == (solver.splitting() == Splitting::Primal);
    if vertices_fixed {
        mesh.vertex_ids().filter(|&v| mesh.is_boundary_vertex(v)).for_each(|v| a[v] = 0.0);
    } else {
        mesh.edge_ids().filter(|&e| mesh.is_boundary_edge(e)).for_each(|e| b[e] = 0.0);
    }
    let (ga, gb) = (gradient(surface, &a).unwrap(), crouzeix_raviart_gradient(surface, &b).unwrap());
    let [g, r] = match solver.splitting() {
        Splitting::Primal => [ga, rotated(&gb)],
        Splitting::Dual => [gb, rotated(&ga)],
    };
    let coefficients = random.values::<FaceId>(solver.basis().dimension());
    let h = solver.basis().combination(mesh.faces(), &coefficients);
    [g, r, h].map(|field| {
        let size = norm(surface, &field);
        field.map(|u| u.map(|x| if size > 0.0 { x / size } else { 0.0 }))
    })
}

fn assert_parts(surface: &Surface, parts: &Decomposition, expected: &[Field; 3], name: &str) {
    for (found, expected) in [&parts.gradient, &parts.rotated, &parts.harmonic].into_iter().zip(expected) {
        let error = distance(surface, found, expected);
        assert!(error <= 1e-10, "{name}: {error:e}");
        // The bound holds, up to the rounding of the planted field itself.
        assert!(error <= parts.quality.part_error * parts.quality.norms.field + 1e-13, "{name}: {error:e}");
    }
}

#[test]
fn planted_parts_come_back() {
    for case in cases().into_iter().chain(shared_cases()) {
        for (splitting, boundary) in KINDS {
            let solver = solver(&case.surface, splitting, boundary);
            let name = format!("{}, {splitting:?}, {boundary:?}", case.name);
            let expected = planted(&solver, &mut Random(3));
            let field = sum(&[&expected[0], &expected[1], &expected[2]]);
            let parts = solver.decompose(&field).unwrap();
            assert_parts(&case.surface, &parts, &expected, &name);
        }
    }
}

#[test]
fn parts_are_orthogonal_and_add_up() {
    for case in cases().into_iter().chain(shared_cases()) {
        for (splitting, boundary) in KINDS {
            let solver = solver(&case.surface, splitting, boundary);
            let name = format!("{}, {splitting:?}, {boundary:?}", case.name);
            let field = Random(17).field(&case.surface);
            let parts = solver.decompose(&field).unwrap();
            let quality = parts.quality;
            let added = sum(&[&parts.gradient, &parts.rotated, &parts.harmonic]);
            let rest = distance(&case.surface, &added, &field) / norm(&case.surface, &field);
            assert!(rest <= 1e-12 && (rest - quality.residual).abs() <= 1e-15, "{name}: {rest:e}");
            let products = quality.inner_products;
            for product in [products.gradient_rotated, products.gradient_harmonic, products.rotated_harmonic]
            {
                assert!(product.abs() <= 1e-12, "{name}: {products:?}");
            }
            let norms = quality.norms;
            let squares = norms.gradient.powi(2) + norms.rotated.powi(2) + norms.harmonic.powi(2);
            assert!((squares / norms.field.powi(2) - 1.0).abs() <= 1e-12, "{name}: {norms:?}");
            assert!(quality.part_error <= 1e-12, "{name}: {}", quality.part_error);
            // The parts agree with their potentials.
            let turned: Field =
                rotated(&crouzeix_raviart_gradient(&case.surface, &parts.edge_potential).unwrap());
            let straight = gradient(&case.surface, &parts.vertex_potential).unwrap();
            let (of_vertices, of_edges) = match splitting {
                Splitting::Primal => (parts.gradient.clone(), parts.rotated.clone()),
                // J applied to both sides.
                Splitting::Dual => (rotated(&parts.rotated).map(|u| u.map(|x| -x)), rotated(&parts.gradient)),
            };
            let scale = norm(&case.surface, &field);
            assert!(distance(&case.surface, &straight, &of_vertices) <= 1e-11 * scale, "{name}");
            assert!(distance(&case.surface, &turned, &of_edges) <= 1e-11 * scale, "{name}");
        }
    }
}

#[test]
fn constants_are_harmonic_on_the_flat_torus() {
    let torus = flat_torus([3.0, 2.0], [12, 9]).unwrap();
    // Frames of odd faces are turned by half.
    let constant = |u: [f64; 2]| -> Field {
        Field::from_fn(torus.mesh().faces(), |f| if f.0 % 2 == 0 { u } else { u.map(|x| -x) })
    };
    for (splitting, boundary) in KINDS {
        let solver = solver(&torus, splitting, boundary);
        assert_eq!(solver.basis().dimension(), 2);
        for u in [[1.0, 0.0], [0.0, 1.0], [-0.3, 2.0]] {
            let field = constant(u);
            let parts = solver.decompose(&field).unwrap();
            let size = norm(&torus, &field);
            assert!(distance(&torus, &parts.harmonic, &field) <= 1e-12 * size);
            assert!(norm(&torus, &parts.gradient) <= 1e-12 * size);
            assert!(norm(&torus, &parts.rotated) <= 1e-12 * size);
        }
    }
}

#[test]
fn angle_fields_of_the_torus_become_harmonic() {
    // On the smooth torus ∇θ and J∇θ are harmonic, with θ the angle about the axis.
    let errors: Vec<f64> = [12_u32, 24, 48]
        .into_iter()
        .map(|n| {
            let torus = EmbeddedSurface::new(&shapes::torus(2.0, 0.7, 2 * n, n).unwrap()).unwrap();
            let mesh = shapes::torus(2.0, 0.7, 2 * n, n).unwrap();
            let surface = torus.surface();
            let solver = solver(surface, Splitting::Primal, Boundary::Tangential);
            let field = Field::from_fn(mesh.faces().len(), |face| {
                let corners = mesh.corners(face);
                let [x, y] = [0, 1].map(|i| corners.iter().map(|p| p[i]).sum::<f64>() / 3.0);
                let square = x * x + y * y;
                torus.to_tangent(face, [-y / square, x / square, 0.0])
            });
            let both = [field.clone(), rotated(&field)];
            let share = both.map(|u| {
                let parts = solver.decompose(&u).unwrap();
                distance(surface, &parts.harmonic, &u) / norm(surface, &u)
            });
            share[0] + share[1]
        })
        .collect();
    assert!(errors[0] > 1.8 * errors[1] && errors[1] > 1.8 * errors[2] && errors[2] < 0.1, "{errors:?}");
}

#[test]
fn size_and_place_do_not_matter() {
    let mesh = shapes::torus(2.0, 0.7, 12, 9).unwrap();
    let split = |scale: f64| {
        let positions = mesh.positions().iter().map(|p| p.map(|x| x * scale)).collect();
        let mesh = pompeiu_core::TriMesh::new(positions, mesh.faces().to_vec()).unwrap();
        let surface = surface(&mesh);
        let solver = solver(&surface, Splitting::Primal, Boundary::Tangential);
        solver.decompose(&Random(2).field(&surface)).unwrap().harmonic
    };
    let (one, small, large) = (split(1.0), split(2.0_f64.powi(-30)), split(2.0_f64.powi(40)));
    assert_eq!(one, small, "a power of two changes no bit");
    assert_eq!(one, large);
}

#[test]
fn fields_of_any_size_are_split_alike() {
    let surface = surface(&shapes::torus(2.0, 0.7, 12, 9).unwrap());
    let field = Random(8).field(&surface);
    let times = |u: &Field, scale: f64| u.map(|u| u.map(|x| x * scale));
    for splitting in [Splitting::Primal, Splitting::Dual] {
        let solver = solver(&surface, splitting, Boundary::Tangential);
        let one = solver.decompose(&field).unwrap();
        for exponent in [-1000, -512, -300, 300, 512, 1000] {
            let scale = 2.0_f64.powi(exponent);
            let other = solver.decompose(&times(&field, scale)).unwrap();
            assert_eq!(other.gradient, times(&one.gradient, scale), "2^{exponent}");
            assert_eq!(other.harmonic, times(&one.harmonic, scale), "2^{exponent}");
            assert_eq!(other.vertex_potential, one.vertex_potential.map(|x| x * scale), "2^{exponent}");
            assert_eq!(other.quality.norms.rotated, one.quality.norms.rotated * scale, "2^{exponent}");
            assert_eq!(other.quality.residual, one.quality.residual, "2^{exponent}");
            assert_eq!(other.quality.inner_products, one.quality.inner_products, "2^{exponent}");
            // The bound includes what numbers near the least double lose.
            let (error, expected) = (other.quality.part_error, one.quality.part_error);
            assert!(error >= expected && error <= 1.0001 * expected && expected > 0.0, "2^{exponent}");
        }
        // Below the range of normal doubles components are rounded, and the bound says so.
        let tiny = solver.decompose(&times(&field, 2.0_f64.powi(-1060))).unwrap();
        let rest = sum(&[&tiny.gradient, &tiny.rotated, &tiny.harmonic]);
        let error = distance(&surface, &rest, &times(&field, 2.0_f64.powi(-1060)));
        assert!(tiny.quality.part_error > 1e-6, "{:e}", tiny.quality.part_error);
        assert!(error <= 3.0 * tiny.quality.part_error * tiny.quality.norms.field, "{error:e}");
        let least = solver.decompose(&times(&field, 2.0_f64.powi(-1072))).unwrap();
        assert!(least.quality.norms.field > 0.0 && least.quality.part_error <= 1.0, "{:?}", least.quality);
        let error = solver.decompose(&times(&field, f64::MAX)).unwrap_err();
        assert!(matches!(error, OperatorError::FieldTooLarge { .. }), "{error}");
    }
}

#[test]
fn the_same_bits_at_any_number_of_threads() {
    let surface = surface(&shapes::torus(2.0, 0.7, 24, 16).unwrap());
    let split = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let solver = solver(&surface, Splitting::Primal, Boundary::Tangential);
            let fields: Vec<Field> = (0..5).map(|seed| Random(seed).field(&surface)).collect();
            solver.decompose_many(&fields).unwrap()
        })
    };
    let one = split(1);
    assert_eq!(one, split(2));
    assert_eq!(one, split(8));
}

#[test]
fn unusable_fields_are_named() {
    let surface = surface(&shapes::icosphere(1.0, 1).unwrap());
    let solver = solver(&surface, Splitting::Primal, Boundary::Tangential);
    let error = solver.decompose(&Field::filled(79, [0.0; 2])).unwrap_err();
    assert_eq!(error.to_string(), "the field has 79 vectors, expected 80, one for each face");
    let mut field = Field::filled(80, [1.0, 0.0]);
    field[FaceId(41)][1] = f64::NAN;
    assert!(
        matches!(solver.decompose(&field), Err(OperatorError::NonFiniteField { face, .. }) if face.0 == 41)
    );
    let zero = solver.decompose(&Field::filled(80, [0.0; 2])).unwrap();
    assert_eq!((zero.quality.residual, zero.quality.part_error), (0.0, 0.0));
}
