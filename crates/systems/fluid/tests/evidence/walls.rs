//! Boundaries.

use crate::{surface, values};
use pompeiu_core::mesh::shapes::{Diagonal, disk, grid, revolved};
use pompeiu_core::mesh::without_unreferenced;
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_fluid::{Density, FluidError, FluidOptions, Integrator, Scheme, Simulation, Wall};
use pompeiu_operators::rotation_field;
use pompeiu_surface::{EdgeData, EmbeddedSurface};
use std::f64::consts::PI;

#[test]
fn without_viscosity_energy_and_enstrophy_are_kept_between_walls_and_around_holes() {
    let (positions, faces) = grid([1.0, 1.0], [12, 12], Diagonal::Alternating).unwrap().into_parts();
    // An off-centre hole: a harmonic field flows around it.
    let middle = |face: &[u32; 3]| {
        let centre = [0, 1].map(|i| face.iter().map(|&v| positions[v as usize][i] / 3.0).sum::<f64>());
        (centre[0] - 0.1).abs() < 0.13 && (centre[1] + 0.1).abs() < 0.13
    };
    let kept: Vec<[u32; 3]> = faces.into_iter().filter(|face| !middle(face)).collect();
    let mesh = TriMesh::new(positions, kept).unwrap();
    let square = surface(&without_unreferenced(&mesh));
    assert_eq!(square.mesh().boundary_loops().len(), 2);
    let options = FluidOptions { integrator: Integrator::ImplicitMidpoint, ..FluidOptions::new(0.05) };
    let mut fluid = Simulation::new(square.surface(), options).unwrap();
    let vorticity = values(&square, |[x, y, _]| (5.0 * x).sin() + 2.0 * y);
    fluid.set_vorticity(&vorticity, &[0.4]).unwrap();
    let first = fluid.measure().unwrap();
    let mut last = first.clone();
    for _ in 0..15 {
        last = fluid.step().unwrap();
    }
    for (a, b) in [
        (last.energy, first.energy),
        (last.enstrophy, first.enstrophy),
        (last.total_vorticity, first.total_vorticity),
    ] {
        assert!((a / b - 1.0).abs() < 1e-12, "{first:?} {last:?}");
    }
    assert!(last.divergence < 1e-12 && last.harmonic != first.harmonic);
}

/// The part of a sphere above a height.
fn cap(subdivisions: u32, height: f64) -> EmbeddedSurface {
    // Rings around the axis, evenly spaced, so that the boundary is a circle.
    let rings = 4 << subdivisions;
    let disk = disk(height.acos(), 6 * rings, rings).unwrap();
    let (positions, faces) = disk.into_parts();
    let lifted = positions.into_iter().map(|[x, y, _]| {
        let angle = x.hypot(y);
        let s = if angle > 0.0 { angle.sin() / angle } else { 1.0 };
        [s * x, s * y, angle.cos()]
    });
    surface(&TriMesh::new(lifted.collect(), faces).unwrap())
}

#[test]
fn a_rotation_slips_along_a_free_wall_and_stops_at_one_that_holds_it() {
    let schemes = [Scheme::Vorticity, Scheme::CrouzeixRaviart];
    for (height, scheme) in [0.5, -0.3].into_iter().flat_map(|height| schemes.map(|s| (height, s))) {
        let lost = {
            let cap = cap(1, height);
            let wall = Wall::FreeSlip;
            let options = FluidOptions { scheme, viscosity: 1.0, wall, ..FluidOptions::new(0.05) };
            let mut fluid = Simulation::new(cap.surface(), options).unwrap();
            fluid.set_velocity(&rotation_field(&cap, [0.0, 0.0, 0.1])).unwrap();
            let before = fluid.measure().unwrap().energy;
            for _ in 0..20 {
                fluid.step().unwrap();
            }
            1.0 - (fluid.measure().unwrap().energy / before).sqrt()
        };
        // Of order 2 in the width of the rings.
        let bound = if scheme == Scheme::Vorticity { 2e-3 } else { 6e-3 };
        assert!(lost.abs() < bound, "{scheme:?} {height}: {lost}");
        let cap = cap(0, height);
        let options = FluidOptions { scheme, viscosity: 1.0, ..FluidOptions::new(0.05) };
        let mut fluid = Simulation::new(cap.surface(), options).unwrap();
        fluid.set_velocity(&rotation_field(&cap, [0.0, 0.0, 0.1])).unwrap();
        let before = fluid.measure().unwrap().energy;
        for _ in 0..20 {
            fluid.step().unwrap();
        }
        assert!(fluid.measure().unwrap().energy < 0.1 * before);
    }
}

#[test]
fn couette_flow_between_walls_is_linear() {
    // An annulus whose inner wall turns: u = A (r − 1 / r) with u(1/2) = −1, so that A = 2/3 and ω = 4/3 everywhere.
    let (inner, rings) = (0.5, 12);
    let ring =
        revolved(48, rings, |k| [inner + (1.0 - inner) * f64::from(k) / f64::from(rings), 0.0]).unwrap();
    let ring = surface(&ring);
    let is_inner = |v: VertexId| ring.positions()[v][0].hypot(ring.positions()[v][1]) < inner + 1e-9;
    let wall = EdgeData::from_fn(ring.mesh().edges(), |edge| {
        f64::from(u8::from(ring.mesh().ends(edge).into_iter().all(is_inner)))
    });
    // The vorticity of velocities at midpoints of edges is of first order at the boundary.
    for (scheme, bound) in [(Scheme::Vorticity, 0.02), (Scheme::CrouzeixRaviart, 0.25)] {
        let wall_velocity = Some(wall.clone());
        let options = FluidOptions { scheme, viscosity: 1.0, wall_velocity, ..FluidOptions::new(0.5) };
        let mut fluid = Simulation::new(ring.surface(), options).unwrap();
        for _ in 0..20 {
            fluid.step().unwrap();
        }
        // π A² (r⁴ / 4 − r² + ln r) from 1/2 to 1.
        let energy = fluid.measure().unwrap().energy;
        let expected = PI * 4.0 / 9.0 * (-0.75 + 0.25 - 0.015_625 + 2.0_f64.ln());
        assert!((energy / expected - 1.0).abs() < 0.01, "{scheme:?}: {energy} {expected}");
        let error = |w: &f64| (w.abs() - 4.0 / 3.0).abs();
        let worst = fluid.state().vorticity.iter().map(error).fold(0.0, f64::max);
        assert!(worst < bound, "{scheme:?}: {worst}");
    }
}

#[test]
fn a_lid_drives_a_cavity() {
    // Re 100 on a coarse mesh: the least velocity on the vertical midline of Ghia, Ghia and Shin is −0.21090 at y = 0.4531.
    let n = 24;
    let square = surface(&grid([1.0, 1.0], [n, n], Diagonal::Alternating).unwrap());
    let lid = EdgeData::from_fn(square.mesh().edges(), |edge| {
        let on_lid = square.mesh().ends(edge).iter().all(|&v| square.positions()[v][1] > 0.5 - 1e-9);
        // Counter-clockwise along the top is to the left.
        if on_lid { -1.0 } else { 0.0 }
    });
    let options = FluidOptions { viscosity: 0.01, wall_velocity: Some(lid), ..FluidOptions::new(0.1) };
    let mut fluid = Simulation::new(square.surface(), options).unwrap();
    let mut energy = 0.0;
    for _ in 0..200 {
        energy = fluid.step().unwrap().energy;
    }
    assert!((fluid.step().unwrap().energy / energy - 1.0).abs() < 1e-5);
    // The stream function in the middle line: u = −dψ/dy there.
    let on_line = |y: u32| {
        let v = square
            .positions()
            .entries()
            .find(|(_, p)| p[0].abs() < 1e-9 && (p[1] + 0.5 - f64::from(y) / f64::from(n)).abs() < 1e-9);
        fluid.state().stream[v.unwrap().0]
    };
    let least =
        (1..n).map(|y| -(on_line(y + 1) - on_line(y - 1)) * f64::from(n) / 2.0).fold(f64::INFINITY, f64::min);
    assert!((least + 0.2109).abs() < 0.015, "{least}");
    let depth = fluid.state().stream.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    assert!((depth - 0.1034).abs() < 0.004, "{depth}");
}

/// A channel of length 3 and width 1, and the inflow speeds: positive on the left, negative on the right.
fn channel(cells: u32, speed: f64) -> (EmbeddedSurface, EdgeData<f64>) {
    let channel = surface(&grid([3.0, 1.0], [3 * cells, cells], Diagonal::Alternating).unwrap());
    let inflow = EdgeData::from_fn(channel.mesh().edges(), |edge| {
        let [a, b] = channel.mesh().ends(edge).map(|v| channel.positions()[v][0]);
        let at = |x: f64| (a - x).abs() < 1e-9 && (b - x).abs() < 1e-9;
        speed * (f64::from(u8::from(at(-1.5))) - f64::from(u8::from(at(1.5))))
    });
    (channel, inflow)
}

#[test]
fn what_flows_in_flows_out_and_takes_densities_along() {
    let (channel, inflow) = channel(8, 0.5);
    let blob = values(&channel, |[x, y, _]| (-8.0 * ((x + 0.7).powi(2) + y * y)).exp());
    for scheme in Scheme::ALL {
        let options = FluidOptions {
            scheme,
            wall: Wall::FreeSlip,
            viscosity: 0.01,
            inflow: Some(inflow.clone()),
            densities: vec![Density::new("dye", blob.clone())],
            ..FluidOptions::new(0.1)
        };
        let mut fluid = Simulation::new(channel.surface(), options).unwrap();
        let before = fluid.measure().unwrap();
        let mut half = 0.0;
        for step in 1..=70 {
            let measured = fluid.step().unwrap();
            assert!(measured.divergence < 1e-12, "{scheme:?}: {measured:?}");
            if step == 20 {
                half = measured.mass[0];
            }
        }
        // After 2 of time the blob has moved by 1 and is all there; after 7 it has left.
        let after = fluid.measure().unwrap();
        assert!((half / before.mass[0] - 1.0).abs() < 0.01, "{scheme:?}: {half}");
        assert!(after.mass[0] < 0.02 * before.mass[0], "{scheme:?}: {after:?}");
        // Uniform flow: half of 0.5² times the area of 3.
        assert!((after.energy - 0.375).abs() < 1e-9 && after.max_speed < 0.5 + 1e-9, "{scheme:?}: {after:?}");
    }
    let lost = EdgeData::from_fn(inflow.len(), |edge| if inflow[edge] > 0.0 { inflow[edge] } else { 0.0 });
    let options = FluidOptions { inflow: Some(lost), ..FluidOptions::new(0.1) };
    let error = Simulation::new(channel.surface(), options).unwrap_err();
    assert_eq!(error, FluidError::Imbalance { component: 0, into: 0.5, out: 0.0 });
}

#[test]
fn between_walls_that_hold_it_a_flow_becomes_a_parabola() {
    let (channel, inflow) = channel(16, 1.0);
    // A projection after viscosity has an error proportional to the step.
    for (scheme, bound) in [(Scheme::Vorticity, 0.05), (Scheme::CrouzeixRaviart, 0.16)] {
        let inflow = Some(inflow.clone());
        let options = FluidOptions { scheme, viscosity: 0.5, inflow, ..FluidOptions::new(0.02) };
        let mut fluid = Simulation::new(channel.surface(), options).unwrap();
        for _ in 0..60 {
            fluid.step().unwrap();
        }
        // In the middle of the channel: 6 y (1 − y), from below.
        let velocity = &fluid.state().velocity;
        let worst = velocity
            .entries()
            .filter(|(face, _)| channel.centroid(*face)[0].abs() < 0.1)
            .map(|(face, &u)| {
                let y = channel.centroid(face)[1] + 0.5;
                (channel.to_space(face, u)[0] - 6.0 * y * (1.0 - y)).abs()
            })
            .fold(0.0, f64::max);
        assert!(worst < bound, "{scheme:?}: {worst}");
    }
}
