//! Scenes that have a name.

use super::ContactRequestError;
use super::own::{MaterialTable, material_of};
use crate::bodies::HandleMotion;
use crate::shapes::{sheet, tetrahedral_box};
use crate::{Bodies, ContactError, ContactOptions, Handle, Material, Obstacle};
use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// A scene that has a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Example {
    /// A stiff box on an inclined plane, with friction.
    Incline,
    /// Boxes that fall on each other.
    Stack,
    /// Cloth that falls on a ball.
    Drape,
    /// Cloth whose ends are turned against each other.
    ClothTwist,
    /// A rod whose ends are turned against each other.
    RodTwist,
    /// Two soft cubes that collide, without gravity.
    Collision,
}

/// What a scene says of an example; each suits it where nothing is said.
#[derive(Clone, Copy)]
pub(super) struct Sizes {
    pub(super) material: MaterialTable,
    pub(super) cells: Option<usize>,
    pub(super) angle: Option<f64>,
    pub(super) turns: Option<f64>,
    pub(super) boxes: Option<usize>,
    pub(super) speed: Option<f64>,
}

const RUBBER: Material = Material { young: 1e5, poisson: 0.4, density: 1000.0 };
const CLOTH: Material = Material { young: 1e5, poisson: 0.3, density: 300.0 };
const CLOTH_THICKNESS: f64 = 1e-3;

/// Largest number of cells along a body.
const MOST_CELLS: usize = 500;

impl Example {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Incline, Self::Stack, Self::Drape, Self::ClothTwist, Self::RodTwist, Self::Collision];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Incline => "incline",
            Self::Stack => "stack",
            Self::Drape => "drape",
            Self::ClothTwist => "cloth-twist",
            Self::RodTwist => "rod-twist",
            Self::Collision => "collision",
        }
    }

    /// The example of a name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|example| example.name() == name)
    }

    /// All names, for sentences.
    pub(super) fn names() -> String {
        Self::ALL.map(Self::name).join(", ")
    }

    pub(super) fn build(self, sizes: Sizes) -> Result<Built, ContactRequestError> {
        let given = sizes.material;
        let cells = |default: usize| match sizes.cells.unwrap_or(default) {
            n @ 1..=MOST_CELLS => Ok(n),
            n => Err(ContactRequestError::Value { key: "cells", value: n as f64, expected: "1 to 500" }),
        };
        let material = |default| material_of(given, default);
        let mut making = Making { bodies: Bodies::new(), first_faces: Vec::new() };
        let (options, steps) = match self {
            Self::Incline => making.incline(material(Material { young: 1e8, ..RUBBER }), sizes.angle)?,
            Self::Stack => {
                let boxes = sizes.boxes.unwrap_or(3);
                if !(1..=100).contains(&boxes) {
                    let (value, expected) = (boxes as f64, "1 to 100");
                    return Err(ContactRequestError::Value { key: "boxes", value, expected });
                }
                making.stack(material(Material { young: 1e6, ..RUBBER }), boxes, cells(2)?)?
            }
            Self::Drape => {
                let thickness = given.thickness.unwrap_or(CLOTH_THICKNESS);
                making.drape(material(CLOTH), thickness, cells(16)?)?
            }
            Self::ClothTwist => {
                let thickness = given.thickness.unwrap_or(CLOTH_THICKNESS);
                making.cloth_twist(material(CLOTH), thickness, cells(16)?, sizes.turns.unwrap_or(2.5))?
            }
            Self::RodTwist => making.rod_twist(material(RUBBER), cells(28)?, sizes.turns.unwrap_or(4.0))?,
            Self::Collision => {
                let soft = material(Material { poisson: 0.3, ..RUBBER });
                making.collision(soft, cells(3)?, sizes.speed.unwrap_or(1.0))?
            }
        };
        let Making { bodies, first_faces } = making;
        Ok(Built { bodies, options, steps, first_faces, first_of_obstacles: Vec::new() })
    }
}

/// Bodies on their way.
struct Making {
    bodies: Bodies,
    first_faces: Vec<usize>,
}

/// How the ends of a body of length 1 are held that is twisted.
#[derive(Clone, Copy)]
struct Ends {
    /// The length that is held at each end.
    length: f64,
    /// How much nearer the ends come.
    nearer: f64,
    /// Stiffness of the handles. Where the torque is greater than their springs bear, the ends slip.
    stiffness: f64,
}

type Made = Result<(ContactOptions, usize), ContactError>;

impl Making {
    fn solid(
        &mut self,
        (positions, tetrahedra): &(Vec<DVec3>, Vec<[u32; 4]>),
        material: Material,
        place: impl Fn(DVec3) -> DVec3,
    ) -> Result<std::ops::Range<usize>, ContactError> {
        self.first_faces.push(self.bodies.faces().len());
        let placed: Vec<DVec3> = positions.iter().map(|p| place(*p)).collect();
        self.bodies.add_solid(&placed, tetrahedra, material)
    }

    fn cloth(
        &mut self,
        (positions, faces): &(Vec<DVec3>, Vec<[u32; 3]>),
        material: Material,
        thickness: f64,
    ) -> Result<(), ContactError> {
        self.first_faces.push(self.bodies.faces().len());
        self.bodies.add_shell(positions, faces, material, thickness)?;
        Ok(())
    }

    fn incline(&mut self, material: Material, angle: Option<f64>) -> Made {
        let angle = angle.unwrap_or(27.0).to_radians();
        let turn = DQuat::from_rotation_y(angle);
        let unit = tetrahedral_box(DVec3::new(0.0, 0.0, 0.005), DVec3::new(1.0, 1.0, 1.005), [1, 1, 1]);
        self.solid(&unit, material, |p| turn * p)?;
        self.bodies.add_obstacle(Obstacle::HalfSpace { normal: turn * DVec3::Z, offset: 0.0 })?;
        let options = ContactOptions {
            distance: 0.01,
            friction: 0.5,
            tolerance: 1e-5,
            ..ContactOptions::new(0.01, 1.0)
        };
        Ok((options, 100))
    }

    fn stack(&mut self, material: Material, boxes: usize, cells: usize) -> Made {
        let (side, gap) = (0.2, 0.01);
        let half = DVec3::new(0.5 * side, 0.5 * side, 0.0);
        let body = tetrahedral_box(-half, half + DVec3::Z * side, [cells; 3]);
        for i in 0..boxes {
            let turn = DQuat::from_rotation_z(0.3 * i as f64);
            let up = DVec3::Z * (gap + i as f64 * (side + gap));
            self.solid(&body, material, |p| turn * p + up)?;
        }
        self.bodies.add_obstacle(Obstacle::HalfSpace { normal: DVec3::Z, offset: 0.0 })?;
        let options = ContactOptions {
            distance: 0.002,
            friction: 0.3,
            tolerance: 1e-3,
            ..ContactOptions::new(0.01, side)
        };
        Ok((options, 80))
    }

    fn drape(&mut self, material: Material, thickness: f64, cells: usize) -> Made {
        let cloth = sheet(DVec3::new(-0.5, -0.5, 0.32), [DVec3::X, DVec3::Y], [cells; 2]);
        self.cloth(&cloth, material, thickness)?;
        self.bodies.add_obstacle(Obstacle::Ball { centre: DVec3::ZERO, radius: 0.3 })?;
        let options = ContactOptions {
            distance: 0.01,
            friction: 0.2,
            tolerance: 1e-2,
            ..ContactOptions::new(0.02, 1.0)
        };
        Ok((options, 40))
    }

    /// Handles of vertices at both ends along x, which turn against each other so often in so long.
    fn twist(&mut self, ends: Ends, turns: f64, time: f64) -> Result<(), ContactError> {
        let Ends { length, nearer, stiffness } = ends;
        let count = self.bodies.positions().len();
        for vertex in 0..count {
            let x = self.bodies.positions()[vertex].x;
            if x.abs() < 0.5 - length {
                continue;
            }
            let speed = x.signum() * -0.5 * turns * TAU / time;
            let velocity = DVec3::X * (x.signum() * -0.5 * nearer / time);
            let motion = HandleMotion::Rotate { through: DVec3::ZERO, about: DVec3::X, speed, velocity };
            self.bodies.add_handle(Handle { vertex: vertex as u32, motion, stiffness })?;
        }
        Ok(())
    }

    fn cloth_twist(&mut self, material: Material, thickness: f64, cells: usize, turns: f64) -> Made {
        let cloth = sheet(DVec3::new(-0.5, -0.25, 0.0), [DVec3::X, DVec3::Y * 0.5], [cells; 2]);
        self.cloth(&cloth, material, thickness)?;
        let (dt, steps) = (0.04, 45);
        let ends = Ends { length: 1e-3, nearer: 0.0, stiffness: Handle::STIFFNESS };
        self.twist(ends, turns, dt * steps as f64)?;
        let options = ContactOptions {
            gravity: DVec3::ZERO,
            distance: 0.005,
            tolerance: 1e-2,
            ..ContactOptions::new(dt, 1.0)
        };
        Ok((options, steps))
    }

    /// The ends come nearer while they turn, so that the rod leaves its axis and winds about itself.
    fn rod_twist(&mut self, material: Material, cells: usize, turns: f64) -> Made {
        let half = 0.02;
        let (low, high) = (DVec3::new(-0.5, -half, -half), DVec3::new(0.5, half, half));
        let across = cells.div_ceil(14);
        let rod = tetrahedral_box(low, high, [cells, across, across]);
        self.solid(&rod, material, |p| p)?;
        let (dt, steps) = (0.05, 60);
        let ends = Ends { length: 4.0 * half, nearer: 0.35, stiffness: 100.0 * Handle::STIFFNESS };
        self.twist(ends, turns, dt * steps as f64)?;
        let options = ContactOptions {
            gravity: DVec3::ZERO,
            distance: 0.25 * half,
            tolerance: 1e-2,
            ..ContactOptions::new(dt, 1.0)
        };
        Ok((options, steps))
    }

    fn collision(&mut self, material: Material, cells: usize, speed: f64) -> Made {
        let cube = tetrahedral_box(DVec3::ZERO, DVec3::ONE, [cells; 3]);
        let first = self.solid(&cube, material, |p| p)?;
        let second = self.solid(&cube, material, |p| p + DVec3::new(1.1, 0.3, 0.2))?;
        if !speed.is_finite() {
            return Err(ContactError::Parameter { what: "speed", value: speed, expected: "a number" });
        }
        self.bodies.set_velocity(first, DVec3::X * speed);
        self.bodies.set_velocity(second, DVec3::X * -speed);
        let options = ContactOptions {
            gravity: DVec3::ZERO,
            distance: 0.01,
            tolerance: 1e-4,
            ..ContactOptions::new(0.01, 1.0)
        };
        Ok((options, 60))
    }
}

/// Bodies that are put together, with the options that suit them.
pub(super) struct Built {
    pub(super) bodies: Bodies,
    pub(super) options: ContactOptions,
    pub(super) steps: usize,
    /// The first face of each body.
    pub(super) first_faces: Vec<usize>,
    /// The first face of each obstacle with a mesh; their faces are the last ones.
    pub(super) first_of_obstacles: Vec<usize>,
}
