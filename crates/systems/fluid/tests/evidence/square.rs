//! The square: a plain port of Stam's code, exact rates, divergence, masses, published values.

use pompeiu_fluid::square::{Edges, Square, SquareDensity, SquareOptions, SquareScheme, SquareState};
use pompeiu_fluid::{FluidError, Wall};
use std::f64::consts::TAU;

/// Stam's program for games as it was published, in doubles: plain loops over arrays with a ring around.
struct Published {
    n: usize,
    u: Vec<f64>,
    v: Vec<f64>,
    density: Vec<f64>,
}

impl Published {
    fn ix(&self, i: usize, j: usize) -> usize {
        i + (self.n + 2) * j
    }

    fn set_bnd(&self, b: u8, x: &mut [f64]) {
        let n = self.n;
        for i in 1..=n {
            x[self.ix(0, i)] = if b == 1 { -x[self.ix(1, i)] } else { x[self.ix(1, i)] };
            x[self.ix(n + 1, i)] = if b == 1 { -x[self.ix(n, i)] } else { x[self.ix(n, i)] };
            x[self.ix(i, 0)] = if b == 2 { -x[self.ix(i, 1)] } else { x[self.ix(i, 1)] };
            x[self.ix(i, n + 1)] = if b == 2 { -x[self.ix(i, n)] } else { x[self.ix(i, n)] };
        }
        x[self.ix(0, 0)] = 0.5 * (x[self.ix(1, 0)] + x[self.ix(0, 1)]);
        x[self.ix(0, n + 1)] = 0.5 * (x[self.ix(1, n + 1)] + x[self.ix(0, n)]);
        x[self.ix(n + 1, 0)] = 0.5 * (x[self.ix(n, 0)] + x[self.ix(n + 1, 1)]);
        x[self.ix(n + 1, n + 1)] = 0.5 * (x[self.ix(n, n + 1)] + x[self.ix(n + 1, n)]);
    }

    fn lin_solve(&self, b: u8, x: &mut [f64], x0: &[f64], a: f64, c: f64) {
        for _ in 0..20 {
            for j in 1..=self.n {
                for i in 1..=self.n {
                    let sum = x[self.ix(i - 1, j)]
                        + x[self.ix(i + 1, j)]
                        + x[self.ix(i, j - 1)]
                        + x[self.ix(i, j + 1)];
                    x[self.ix(i, j)] = (x0[self.ix(i, j)] + a * sum) / c;
                }
            }
            self.set_bnd(b, x);
        }
    }

    fn diffuse(&self, b: u8, x: &mut [f64], x0: &[f64], rate: f64, dt: f64) {
        let a = rate * dt * (self.n * self.n) as f64;
        self.lin_solve(b, x, x0, a, 1.0 + 4.0 * a);
    }

    fn advect(&self, b: u8, d: &mut [f64], d0: &[f64], u: &[f64], v: &[f64], dt: f64) {
        let n = self.n;
        let dt0 = dt * n as f64;
        for j in 1..=n {
            for i in 1..=n {
                let mut x = i as f64 - dt0 * u[self.ix(i, j)];
                let mut y = j as f64 - dt0 * v[self.ix(i, j)];
                if x < 0.5 {
                    x = 0.5;
                }
                if x > n as f64 + 0.5 {
                    x = n as f64 + 0.5;
                }
                if y < 0.5 {
                    y = 0.5;
                }
                if y > n as f64 + 0.5 {
                    y = n as f64 + 0.5;
                }
                let (i0, j0) = (x as usize, y as usize);
                let (s1, t1) = (x - i0 as f64, y - j0 as f64);
                let (s0, t0) = (1.0 - s1, 1.0 - t1);
                d[self.ix(i, j)] = s0 * (t0 * d0[self.ix(i0, j0)] + t1 * d0[self.ix(i0, j0 + 1)])
                    + s1 * (t0 * d0[self.ix(i0 + 1, j0)] + t1 * d0[self.ix(i0 + 1, j0 + 1)]);
            }
        }
        self.set_bnd(b, d);
    }

    fn project(&self, u: &mut [f64], v: &mut [f64]) {
        let n = self.n;
        let h = 1.0 / n as f64;
        let (mut p, mut div) = (vec![0.0; u.len()], vec![0.0; u.len()]);
        for j in 1..=n {
            for i in 1..=n {
                div[self.ix(i, j)] = -0.5
                    * h
                    * (u[self.ix(i + 1, j)] - u[self.ix(i - 1, j)] + v[self.ix(i, j + 1)]
                        - v[self.ix(i, j - 1)]);
            }
        }
        self.set_bnd(0, &mut div);
        self.lin_solve(0, &mut p, &div, 1.0, 4.0);
        for j in 1..=n {
            for i in 1..=n {
                u[self.ix(i, j)] -= 0.5 * (p[self.ix(i + 1, j)] - p[self.ix(i - 1, j)]) / h;
                v[self.ix(i, j)] -= 0.5 * (p[self.ix(i, j + 1)] - p[self.ix(i, j - 1)]) / h;
            }
        }
        self.set_bnd(1, u);
        self.set_bnd(2, v);
    }

    fn step(&mut self, [fu, fv, source]: [&[f64]; 3], [visc, diff]: [f64; 2], dt: f64) {
        let add = |x: &[f64], s: &[f64]| x.iter().zip(s).map(|(x, s)| x + dt * s).collect::<Vec<f64>>();
        // As in the published program, the source buffers are the initial guess of diffusion.
        let (u0, v0) = (add(&self.u, fu), add(&self.v, fv));
        let (mut u, mut v) = (fu.to_vec(), fv.to_vec());
        self.diffuse(1, &mut u, &u0, visc, dt);
        self.diffuse(2, &mut v, &v0, visc, dt);
        self.project(&mut u, &mut v);
        let (u0, v0) = (u.clone(), v.clone());
        self.advect(1, &mut u, &u0, &u0, &v0, dt);
        self.advect(2, &mut v, &v0, &u0, &v0, dt);
        self.project(&mut u, &mut v);
        let d0 = add(&self.density, source);
        let mut d = source.to_vec();
        self.diffuse(0, &mut d, &d0, diff, dt);
        let mut carried = d.clone();
        self.advect(0, &mut carried, &d, &u, &v, dt);
        (self.u, self.v, self.density) = (u, v, carried);
    }
}

#[test]
fn stams_grid_has_the_bits_of_the_published_program() {
    let n = 12;
    let ring = (n + 2) * (n + 2);
    let cell = |i: usize, j: usize| j * n + i;
    let mut force = vec![[0.0; 2]; n * n];
    force[cell(3, 4)] = [5.0, -2.0];
    force[cell(9, 8)] = [-3.0, 4.0];
    let mut source = vec![0.0; n * n];
    source[cell(5, 5)] = 40.0;
    let framed = |value: &dyn Fn(usize) -> f64| {
        let mut values = vec![0.0; ring];
        for index in 0..n * n {
            values[(index % n + 1) + (n + 2) * (index / n + 1)] = value(index);
        }
        values
    };
    let mut published = Published { n, u: vec![0.0; ring], v: vec![0.0; ring], density: vec![0.0; ring] };
    let (fu, fv, s) = (framed(&|c| force[c][0]), framed(&|c| force[c][1]), framed(&|c| source[c]));
    let density = SquareDensity {
        name: "dye".into(),
        initial: vec![0.0; n * n],
        diffusivity: 1e-3,
        weight: 0.0,
        source: Some(source),
    };
    let options = SquareOptions {
        scheme: SquareScheme::Stam { sweeps: Some(20) },
        viscosity: 2e-3,
        force: Some(force),
        densities: vec![density],
        ..SquareOptions::new(n, 0.1)
    };
    let mut square = Square::new(options.clone()).unwrap();
    for _ in 0..5 {
        square.step().unwrap();
        published.step([&fu, &fv, &s], [2e-3, 1e-3], 0.1);
    }
    for (index, velocity) in square.velocity().into_iter().enumerate() {
        let at = (index % n + 1) + (n + 2) * (index / n + 1);
        assert_eq!(velocity, [published.u[at], published.v[at]], "cell {index}");
        assert_eq!(square.densities()[0][index], published.density[at], "cell {index}");
    }
    // The direct solution is the limit of many sweeps.
    let with = |sweeps| {
        let scheme = SquareScheme::Stam { sweeps };
        let mut square = Square::new(SquareOptions { scheme, ..options.clone() }).unwrap();
        (0..3).for_each(|_| drop(square.step().unwrap()));
        square.velocity()
    };
    for (a, b) in with(Some(4000)).into_iter().zip(with(None)) {
        assert!((a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-9, "{a:?} {b:?}");
    }
}

#[test]
fn a_taylor_green_vortex_decays_at_the_discrete_rate() {
    let n = 24;
    for (scheme, bound) in [(SquareScheme::Mac, 1e-6), (SquareScheme::Stam { sweeps: None }, 1e-6)] {
        // So slow that advection is negligible.
        let options =
            SquareOptions { scheme, edges: Edges::Periodic, viscosity: 0.02, ..SquareOptions::new(n, 0.05) };
        let mut square = Square::new(options).unwrap();
        let h = 1.0 / n as f64;
        let field: Vec<[f64; 2]> = (0..n * n)
            .map(|cell| {
                let (x, y) = (((cell % n) as f64 + 0.5) * h, ((cell / n) as f64 + 0.5) * h);
                [1e-9 * (TAU * x).sin() * (TAU * y).cos(), -1e-9 * (TAU * x).cos() * (TAU * y).sin()]
            })
            .collect();
        square.set_velocity(&field).unwrap();
        let before = square.measure().unwrap();
        let after = square.step().unwrap();
        let eigenvalue = 2.0 * (2.0 - 2.0 * (TAU * h).cos()) / (h * h);
        let expected = 1.0 / (1.0 + 0.02 * 0.05 * eigenvalue);
        let found = (after.energy / before.energy).sqrt();
        assert!((found / expected - 1.0).abs() < bound, "{scheme:?}: {found} {expected}");
    }
}

#[test]
fn nothing_flows_out_of_any_cell_and_mass_is_kept() {
    let n = 20;
    let disc: Vec<bool> = (0..n * n)
        .map(|cell| {
            let (x, y) = ((cell % n) as f64 + 0.5 - 6.0, (cell / n) as f64 + 0.5 - 10.0);
            x.hypot(y) < 3.0
        })
        .collect();
    let dye: Vec<f64> =
        (0..n * n).map(|cell| f64::from(u8::from(cell % n > 10 && cell / n < 9 && !disc[cell]))).collect();
    for edges in [Edges::Walls, Edges::Periodic, Edges::Channel { speed: 1.0 }] {
        let density = SquareDensity {
            name: "dye".into(),
            initial: dye.clone(),
            diffusivity: 1e-3,
            weight: 1.0,
            source: None,
        };
        let options = SquareOptions {
            edges,
            viscosity: 1e-3,
            gravity: [0.0, -2.0],
            solid: Some(disc.clone()),
            densities: vec![density],
            ..SquareOptions::new(n, 0.04)
        };
        let mut square = Square::new(options).unwrap();
        let before = square.measure().unwrap();
        let mut moved = 0.0;
        for _ in 0..25 {
            let step = square.step().unwrap();
            assert!(step.divergence < 1e-12, "{edges:?}: {step:?}");
            assert!(step.range[0][0] > -1e-14 && step.range[0][1] < 1.0 + 1e-14, "{edges:?}: {step:?}");
            if matches!(edges, Edges::Channel { .. }) {
                assert!(step.mass[0] <= before.mass[0] * (1.0 + 1e-14));
            } else {
                assert!((step.mass[0] / before.mass[0] - 1.0).abs() < 1e-13, "{edges:?}");
            }
            moved = step.max_speed;
        }
        assert!(moved > 0.1, "{edges:?}");
        // Nothing gets into the obstacle.
        let inside = square.densities()[0].iter().zip(&disc).filter(|(_, solid)| **solid);
        assert!(inside.map(|(x, _)| x.abs()).fold(0.0, f64::max) == 0.0, "{edges:?}");
    }
}

#[test]
fn a_lid_drives_a_cavity() {
    // Ghia, Ghia and Shin at Re 100: u on the vertical midline is least at y = 0.4531, −0.21090.
    let n = 32;
    let options = SquareOptions { viscosity: 0.01, lid: 1.0, ..SquareOptions::new(n, 0.05) };
    let mut square = Square::new(options).unwrap();
    for _ in 0..300 {
        square.step().unwrap();
    }
    let u = |j: usize| square.velocity_at([0.5, (j as f64 + 0.5) / n as f64])[0];
    let least = (0..n).map(u).fold(f64::INFINITY, f64::min);
    assert!((least + 0.2109).abs() < 0.02, "{least}");
}

#[test]
fn walls_hold_or_let_slip() {
    let energy = |wall: Wall| {
        let mut square =
            Square::new(SquareOptions { viscosity: 0.05, wall, ..SquareOptions::new(16, 0.05) }).unwrap();
        let vortex: Vec<[f64; 2]> = (0..256)
            .map(|cell| {
                let (x, y) = (f64::from(cell % 16) / 16.0 - 0.47, f64::from(cell / 16) / 16.0 - 0.47);
                [-0.01 * y, 0.01 * x]
            })
            .collect();
        square.set_velocity(&vortex).unwrap();
        (0..10).for_each(|_| drop(square.step().unwrap()));
        square.measure().unwrap().energy
    };
    assert!(energy(Wall::NoSlip) < 0.9 * energy(Wall::FreeSlip));
}

#[test]
fn what_makes_no_sense_is_refused() {
    let new = |options: SquareOptions| Square::new(options).map(|_| ()).unwrap_err();
    let plain = || SquareOptions::new(8, 0.1);
    assert!(matches!(new(SquareOptions::new(1, 0.1)), FluidError::Cells { found: 1, .. }));
    assert!(matches!(new(SquareOptions::new(1 << 40, 0.1)), FluidError::Cells { .. }));
    assert!(matches!(new(SquareOptions::new(8, 0.0)), FluidError::Parameter { what: "time step", .. }));
    let stam = SquareScheme::Stam { sweeps: None };
    let edges = Edges::Channel { speed: 1.0 };
    assert_eq!(new(SquareOptions { scheme: stam, edges, ..plain() }), FluidError::StamHasNone);
    let force = Some(vec![[f64::NAN, 0.0]; 64]);
    assert!(matches!(new(SquareOptions { force, ..plain() }), FluidError::NonFinite { .. }));
    let solid = Some(vec![true; 3]);
    assert!(matches!(new(SquareOptions { solid, ..plain() }), FluidError::Length { found: 3, .. }));
    let mut square = Square::new(plain()).unwrap();
    assert!(square.set_velocity(&[[0.0; 2]; 5]).is_err());
    // All cells are obstacles: nothing moves, nothing fails.
    let solid = Some(vec![true; 64]);
    let mut still = Square::new(SquareOptions { solid, viscosity: 1.0, ..plain() }).unwrap();
    assert_eq!(still.step().unwrap().energy, 0.0);
}

#[test]
fn a_state_of_the_square_goes_on_bit_for_bit_and_forces_add_up() {
    for scheme in [SquareScheme::Mac, SquareScheme::Stam { sweeps: Some(5) }] {
        let force = vec![[0.5, -0.25]; 64];
        let half = vec![[0.25, -0.125]; 64];
        let options = |force: &[[f64; 2]]| SquareOptions {
            scheme,
            viscosity: 0.01,
            edges: Edges::Periodic,
            force: Some(force.to_vec()),
            ..SquareOptions::new(8, 0.1)
        };
        let mut whole = Square::new(options(&force)).unwrap();
        whole.step().unwrap();
        let state = whole.state();
        whole.step().unwrap();
        let mut parts = Square::new(options(&half)).unwrap();
        parts.set_state(&state).unwrap();
        parts.step_with(Some(&half)).unwrap();
        assert_eq!(parts.state(), whole.state(), "{scheme:?}");
        assert!(parts.step_with(Some(&half[1..])).is_err());
        let wrong = SquareState { velocity: [vec![f64::NAN; 1], Vec::new()], ..state };
        assert!(parts.set_state(&wrong).is_err());
    }
}

#[test]
fn grids_and_edges_are_told_apart() {
    assert_eq!("mac".parse(), Ok(SquareScheme::Mac));
    assert_eq!("stam:20".parse(), Ok(SquareScheme::Stam { sweeps: Some(20) }));
    assert_eq!("periodic".parse(), Ok(Edges::Periodic));
    assert_eq!("channel:1.5".parse(), Ok(Edges::Channel { speed: 1.5 }));
    for text in ["mac", "stam", "stam:20"] {
        assert_eq!(text.parse::<SquareScheme>().map(|one| one.to_string()).as_deref(), Ok(text));
    }
    for text in ["walls", "periodic", "channel:1.5"] {
        assert_eq!(text.parse::<Edges>().map(|one| one.to_string()).as_deref(), Ok(text));
    }
    for wrong in ["", "stam:0", "stam:x", "mac:3"] {
        assert!(wrong.parse::<SquareScheme>().is_err(), "{wrong}");
    }
    assert!("channel".parse::<Edges>().is_err() && "channel:x".parse::<Edges>().is_err());
}
