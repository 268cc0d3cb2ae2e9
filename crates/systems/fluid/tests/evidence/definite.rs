//! Viscosity on surfaces whose curvature the faces do not resolve: it can be solved at any length of a step, and adds no energy.

use crate::{surface, values};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{Diagonal, cube, grid, icosphere, torus};
use pompeiu_core::mesh::{Random, merge};
use pompeiu_fluid::{FluidOptions, Scheme, Simulation, ViscosityModel, Wall};
use pompeiu_operators::{FaceField, difference, field_norm, rotation_field};

/// A mesh with each vertex moved by a function.
fn moved(mesh: TriMesh, mut to: impl FnMut([f64; 3]) -> [f64; 3]) -> TriMesh {
    let (positions, faces) = mesh.into_parts();
    TriMesh::new(positions.into_iter().map(&mut to).collect(), faces).unwrap()
}

/// Closed and open surfaces with points, thin and obtuse faces.
fn unresolved() -> Vec<(&'static str, TriMesh)> {
    let ball = || icosphere(1.0, 2).unwrap();
    let mut random = Random::new(3);
    let spikes = moved(ball(), |p| p.map(|x| x * if random.below(8) == 0 { 3.0 } else { 1.0 }));
    let needle = moved(ball(), |[x, y, z]| [0.02 * x, 0.02 * y, 5.0 * z]);
    let coin = moved(ball(), |[x, y, z]| [x, y, 0.003 * z]);
    let noisy = moved(torus(1.0, 0.3, 24, 12).unwrap(), |p| p.map(|x| x + 0.06 * random.signed_unit()));
    let flat = grid([2.0, 2.0], [16, 16], Diagonal::Rising).unwrap();
    let tip = moved(flat, |[x, y, z]| [x, y, z + 4.0 * (-60.0 * (x * x + y * y)).exp()]);
    let both =
        merge(&[&icosphere(1.0, 2).unwrap(), &moved(needle.clone(), |[x, y, z]| [x + 3.0, y, z])]).unwrap();
    vec![
        ("spikes", spikes),
        ("needle", needle),
        ("coin", coin),
        ("noisy torus", noisy),
        ("tip", tip),
        ("cube", cube(1.0, 1).unwrap()),
        ("sphere and needle", both),
    ]
}

#[test]
fn viscosity_can_be_solved_on_any_surface_and_adds_no_energy() {
    let mut limited = 0;
    for (name, mesh) in unresolved() {
        let surface = surface(&mesh);
        let vorticity = values(&surface, |[x, y, z]| (3.0 * x + y).sin() + (2.0 * y - z).cos() * x);
        for scheme in [Scheme::Vorticity, Scheme::CrouzeixRaviart] {
            for model in ViscosityModel::ALL {
                for (viscosity, wall) in [
                    (1e-4, Wall::NoSlip),
                    (0.1, Wall::FreeSlip),
                    (100.0, Wall::NoSlip),
                    (1e8, Wall::FreeSlip),
                ] {
                    let options = FluidOptions {
                        scheme,
                        viscosity,
                        viscosity_model: model,
                        wall,
                        ..FluidOptions::new(0.01)
                    };
                    let case = format!("{name}: {options:?}");
                    let mut fluid =
                        Simulation::new(surface.surface(), options).unwrap_or_else(|e| panic!("{case}: {e}"));
                    let still = vec![0.0; fluid.harmonic_fields().len()];
                    fluid.set_vorticity(&vorticity, &still).unwrap();
                    let mut before = fluid.measure().unwrap().energy;
                    for _ in 0..3 {
                        let after = fluid.step().unwrap_or_else(|e| panic!("{case}: {e}")).energy;
                        assert!(after <= before * (1.0 + 1e-6), "{case}: {before} {after}");
                        before = after;
                    }
                    let report = fluid.scheme();
                    assert_eq!(report.curvature_limit.is_some(), report.limited_vertices > 0, "{case}");
                    limited += usize::from(report.curvature_limit.is_some());
                }
            }
        }
    }
    assert!(limited > 20, "{limited}");
}

#[test]
fn a_rotation_of_a_sphere_stays_however_long_the_step() {
    let sphere = surface(&icosphere(1.0, 3).unwrap());
    for viscosity in [1.0, 1e3, 1e9] {
        let options = FluidOptions { viscosity, ..FluidOptions::new(1.0) };
        let mut fluid = Simulation::new(sphere.surface(), options).unwrap();
        assert_eq!(fluid.scheme().curvature_limit, None);
        let rotation = rotation_field(&sphere, [0.0, 0.0, 1.0]);
        let disturbance = rotation_field(&sphere, [0.0, 0.0, 1.0]);
        let uneven = FaceField::from_fn(rotation.len(), |f| {
            let z = sphere.centroid(f)[2];
            disturbance[f].map(|u| u * (1.0 + z))
        });
        fluid.set_velocity(&uneven).unwrap();
        let whole = field_norm(sphere.surface(), &fluid.state().velocity);
        for _ in 0..20 {
            fluid.step().unwrap();
        }
        let velocity = &fluid.state().velocity;
        let norm = field_norm(sphere.surface(), velocity);
        let share = pompeiu_operators::field_inner_product(sphere.surface(), velocity, &rotation)
            / (norm * field_norm(sphere.surface(), &rotation));
        // The part of degree 2 is gone, the rotation is left.
        assert!(
            share > 1.0 - 1e-4 && norm < whole && norm > 0.8 * whole,
            "{viscosity}: {share} {norm} {whole}"
        );
        let away = difference(velocity, &rotation);
        assert!(field_norm(sphere.surface(), &away) < 0.2 * norm);
    }
}
