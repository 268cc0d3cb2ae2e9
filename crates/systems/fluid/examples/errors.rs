//! Errors of each scheme against exact solutions on the unit sphere, as comma-separated values.
//!
//! A Rossby–Haurwitz wave of degree 3 and order 2 on a rotation drifts around the axis by a known angle. The table lists, after one
//! turn, the error of that angle in per cent of a turn and the change of the kinetic energy in per cent. Meshes: an icosphere of
//! 20,480 faces, and the same with vertices displaced by up to a quarter of the edge length.

#![allow(clippy::print_stdout, reason = "it prints a table")]

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::mesh::{Random, VertexData};
use pompeiu_fluid::{Correction, FluidOptions, Scheme, Simulation};
use pompeiu_surface::EmbeddedSurface;
use std::f64::consts::{PI, TAU};

/// Edges are about 0.036 long, and the greatest speed is 1.2.
const STEPS_AT_COURANT_ONE: usize = 480;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let sphere = icosphere(1.0, 5)?;
    println!("mesh,scheme,correction,steps,phase_percent,energy_percent");
    for (name, mesh) in [("icosphere", sphere.clone()), ("jittered", jittered(&sphere)?)] {
        let surface = EmbeddedSurface::new(&mesh)?;
        for (scheme, correction) in [
            (Scheme::Vorticity, Correction::MacCormack),
            (Scheme::AnyStep, Correction::MacCormack),
            (Scheme::AnyStep, Correction::Bfecc),
            (Scheme::Faces, Correction::Linear),
            (Scheme::Faces, Correction::MacCormack),
            (Scheme::Faces, Correction::Bfecc),
        ] {
            for steps in [STEPS_AT_COURANT_ONE, STEPS_AT_COURANT_ONE / 4] {
                let [phase, energy] = wave(&surface, scheme, correction, steps)?;
                let (scheme, correction) = (scheme.name(), correction.name());
                println!("{name},{scheme},{correction},{steps},{:.4},{:.3e}", 100.0 * phase, 100.0 * energy);
            }
        }
    }
    Ok(())
}

/// The errors of phase and energy after one turn of the wave.
fn wave(
    surface: &EmbeddedSurface,
    scheme: Scheme,
    correction: Correction,
    steps: usize,
) -> Result<[f64; 2], Box<dyn std::error::Error>> {
    let of = |f: &dyn Fn([f64; 3]) -> f64| surface.positions().map(|&p| f(p));
    let (cosine, sine) = (of(&|[x, y, z]| (x * x - y * y) * z), of(&|[x, y, z]| 2.0 * x * y * z));
    // Degree l drifts at 1 − 2 / (l (l + 1)) of the speed of the rotation.
    let time_step = TAU / (1.0 - 2.0 / 12.0) / steps as f64;
    let options = FluidOptions { scheme, correction, ..FluidOptions::new(time_step) };
    let mut fluid = Simulation::new(surface.surface(), options)?;
    let start = VertexData::from_fn(cosine.len(), |v| 2.0 * surface.positions()[v][2] + 0.5 * cosine[v]);
    fluid.set_vorticity(&start, &[])?;
    let before = fluid.measure()?.energy;
    for _ in 0..steps {
        fluid.step()?;
    }
    let areas = surface.surface().vertex_areas();
    let along = |wave: &VertexData<f64>| -> f64 {
        wave.iter().zip(&fluid.state().vorticity).zip(&areas).map(|((y, w), a)| a * y * w).sum()
    };
    // Order 2: half of the phase angle, which is zero after one turn up to multiples of half a turn.
    let phase = 0.5 * along(&sine).atan2(along(&cosine));
    let phase = (phase + 0.5 * PI).rem_euclid(PI) - 0.5 * PI;
    Ok([phase / TAU, fluid.measure()?.energy / before - 1.0])
}

/// A sphere whose vertices are displaced along it.
fn jittered(sphere: &TriMesh) -> Result<TriMesh, Box<dyn std::error::Error>> {
    let mut random = Random::new(7);
    let (positions, faces) = sphere.clone().into_parts();
    let moved = positions.into_iter().map(|p| {
        let q = p.map(|x| x + 0.25 * 0.036 * random.signed_unit());
        let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        q.map(|x| x / length)
    });
    Ok(TriMesh::new(moved.collect(), faces)?)
}
