//! What is simulated: elastic solids, cloth and shells, obstacles, handles.

use crate::ContactError;
use crate::elastic::{Hinge, Membrane};
use crate::tetrahedron::Tetrahedron;
use glam::{DMat2, DMat3, DVec2, DVec3};
use std::collections::BTreeMap;
use std::ops::Range;

/// An elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Young's modulus.
    pub young: f64,
    /// Poisson's ratio, between −1 and 0.5.
    pub poisson: f64,
    /// Mass by volume.
    pub density: f64,
}

impl Material {
    fn check(&self) -> Result<(), ContactError> {
        for (what, value) in [("modulus of Young", self.young), ("density", self.density)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(ContactError::Parameter { what, value, expected: "above 0" });
            }
        }
        if !(self.poisson > -1.0 && self.poisson < 0.5) {
            let (what, expected) = ("ratio of Poisson", "above -1 and below 0.5");
            return Err(ContactError::Parameter { what, value: self.poisson, expected });
        }
        Ok(())
    }
}

/// A motion that is given, from where a vertex starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HandleMotion {
    /// With a velocity; zero holds it.
    Translate(DVec3),
    /// About an axis through a point, at an angular speed, while the axis moves with a velocity.
    Rotate {
        /// A point of the axis at the start.
        through: DVec3,
        /// The direction of the axis.
        about: DVec3,
        /// Radians per time.
        speed: f64,
        /// The velocity of the axis.
        velocity: DVec3,
    },
}

impl HandleMotion {
    pub(crate) fn at(&self, start: DVec3, time: f64) -> DVec3 {
        match *self {
            Self::Translate(velocity) => start + velocity * time,
            Self::Rotate { through, about, speed, velocity } => {
                let (axis, angle) = (about.normalize_or_zero(), speed * time);
                let (sine, cosine) = (libm::sin(angle), libm::cos(angle));
                let arm = start - through;
                let turned = arm * cosine + axis.cross(arm) * sine + axis * (axis.dot(arm) * (1.0 - cosine));
                through + velocity * time + turned
            }
        }
    }
}

/// A vertex that is pulled along by a spring, which yields to greater forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// The vertex.
    pub vertex: u32,
    /// Where it is pulled.
    pub motion: HandleMotion,
    /// Stiffness of the spring for a unit of mass of the vertex.
    pub stiffness: f64,
}

impl Handle {
    /// Stiffness of springs for a unit of mass, where nothing says it.
    pub const STIFFNESS: f64 = 1e4;

    /// A vertex with a spring of [`Handle::STIFFNESS`].
    pub const fn new(vertex: u32, motion: HandleMotion) -> Self {
        Self { vertex, motion, stiffness: Self::STIFFNESS }
    }
}

/// An obstacle with a formula instead of faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Obstacle {
    /// What lies below a plane: `normal · x < offset`.
    HalfSpace {
        /// The unit normal, out of the obstacle.
        normal: DVec3,
        /// The offset along it.
        offset: f64,
    },
    /// A ball.
    Ball {
        /// Its centre.
        centre: DVec3,
        /// Its radius.
        radius: f64,
    },
}

impl Obstacle {
    /// The distance of a point, negative inside, and the direction in which it grows.
    pub(crate) fn distance(&self, x: DVec3) -> (f64, DVec3) {
        match *self {
            Self::HalfSpace { normal, offset } => (normal.dot(x) - offset, normal),
            Self::Ball { centre, radius } => {
                let arm = x - centre;
                let length = arm.length();
                (length - radius, if length > 0.0 { arm / length } else { DVec3::Z })
            }
        }
    }
}

/// Bodies and obstacles, put together one after the other.
#[derive(Clone, Debug, Default)]
pub struct Bodies {
    pub(crate) positions: Vec<DVec3>,
    pub(crate) velocities: Vec<DVec3>,
    pub(crate) mass: Vec<f64>,
    pub(crate) is_fixed: Vec<bool>,
    pub(crate) faces: Vec<[u32; 3]>,
    pub(crate) tetrahedra: Vec<Tetrahedron>,
    pub(crate) membranes: Vec<Membrane>,
    pub(crate) hinges: Vec<Hinge>,
    pub(crate) handles: Vec<Handle>,
    pub(crate) obstacles: Vec<Obstacle>,
    /// Vertices of obstacles that move.
    pub(crate) driven: Vec<(u32, HandleMotion)>,
}

impl Bodies {
    /// Nothing.
    pub fn new() -> Self {
        Self::default()
    }

    /// The positions of all vertices.
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The faces of all surfaces.
    pub fn faces(&self) -> &[[u32; 3]] {
        &self.faces
    }

    fn push(&mut self, positions: &[DVec3], is_fixed: bool) -> Result<Range<usize>, ContactError> {
        let start = self.positions.len();
        if let Some(index) = positions.iter().position(|p| !p.is_finite()) {
            return Err(ContactError::NonFinite { index });
        }
        self.positions.extend_from_slice(positions);
        let end = self.positions.len();
        self.velocities.resize(end, DVec3::ZERO);
        self.mass.resize(end, 0.0);
        self.is_fixed.resize(end, is_fixed);
        Ok(start..end)
    }

    /// Adds an elastic solid (neo-Hookean) at rest; its surface is what only one tetrahedron has.
    ///
    /// # Errors
    /// [`ContactError`] for vertices that do not exist, and tetrahedra without volume or turned inside out.
    pub fn add_solid(
        &mut self,
        positions: &[DVec3],
        tetrahedra: &[[u32; 4]],
        material: Material,
    ) -> Result<Range<usize>, ContactError> {
        material.check()?;
        check_indices("tetrahedron", tetrahedra, positions.len())?;
        let mut elements = Vec::with_capacity(tetrahedra.len());
        for (index, t) in tetrahedra.iter().enumerate() {
            let x = t.map(|v| positions[v as usize]);
            let shape = DMat3::from_cols(x[1] - x[0], x[2] - x[0], x[3] - x[0]);
            let volume = shape.determinant() / 6.0;
            if volume <= 0.0 || !volume.is_finite() {
                let (what, measure) = ("tetrahedron", "volume");
                return Err(ContactError::Degenerate { what, index, measure, value: volume });
            }
            elements.push((*t, shape.inverse(), volume));
        }
        let range = self.push(positions, false)?;
        let base = range.start as u32;
        let lame = (
            0.5 * material.young / (1.0 + material.poisson),
            material.young * material.poisson / ((1.0 + material.poisson) * (1.0 - 2.0 * material.poisson)),
        );
        for (t, inverse, volume) in elements {
            let vertices = t.map(|v| v + base);
            for v in vertices {
                self.mass[v as usize] += 0.25 * material.density * volume;
            }
            self.tetrahedra.push(Tetrahedron { vertices, inverse, volume, lame });
        }
        self.faces.extend(outer_faces(tetrahedra).map(|face| face.map(|v| v + base)));
        Ok(range)
    }

    /// Adds cloth or a shell: membranes after Saint-Venant and Kirchhoff that resist bending at edges, from the shape at rest that is
    /// given.
    ///
    /// # Errors
    /// [`ContactError`] for vertices that do not exist, and faces without area.
    pub fn add_shell(
        &mut self,
        positions: &[DVec3],
        faces: &[[u32; 3]],
        material: Material,
        thickness: f64,
    ) -> Result<Range<usize>, ContactError> {
        material.check()?;
        if !(thickness > 0.0 && thickness.is_finite()) {
            let (what, expected) = ("thickness", "above 0");
            return Err(ContactError::Parameter { what, value: thickness, expected });
        }
        check_indices("face", faces, positions.len())?;
        let mut elements = Vec::with_capacity(faces.len());
        for (index, f) in faces.iter().enumerate() {
            let [a, b, c] = f.map(|v| positions[v as usize]);
            let (u, v) = (b - a, c - a);
            let area = 0.5 * u.cross(v).length();
            if area <= 0.0 || !area.is_finite() {
                return Err(ContactError::Degenerate { what: "face", index, measure: "area", value: area });
            }
            let x = u.normalize();
            let along = u.cross(v).normalize().cross(x);
            let shape = DMat2::from_cols(DVec2::new(u.length(), 0.0), DVec2::new(v.dot(x), v.dot(along)));
            elements.push((*f, shape.inverse(), area));
        }
        let range = self.push(positions, false)?;
        let base = range.start as u32;
        let Material { young, poisson, density } = material;
        // Plane stress.
        let lame = (
            0.5 * young / (1.0 + poisson) * thickness,
            young * poisson / (1.0 - poisson * poisson) * thickness,
        );
        let mut opposite: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
        for (f, inverse, area) in elements {
            let vertices = f.map(|v| v + base);
            for k in 0..3 {
                self.mass[vertices[k] as usize] += density * thickness * area / 3.0;
                let (i, j) = (vertices[k], vertices[(k + 1) % 3]);
                opposite.entry([i.min(j), i.max(j)]).or_default().push(vertices[(k + 2) % 3]);
            }
            self.membranes.push(Membrane { vertices, inverse, area, lame });
            self.faces.push(vertices);
        }
        let bending = young * thickness.powi(3) / (12.0 * (1.0 - poisson * poisson));
        for ([i, j], others) in opposite {
            if let [k, l] = others[..] {
                self.hinges.push(Hinge::new([i, j, k, l], &self.positions, bending));
            }
        }
        Ok(range)
    }

    /// Adds a surface that stays where it is.
    ///
    /// # Errors
    /// [`ContactError`] for vertices that do not exist.
    pub fn add_fixed(
        &mut self,
        positions: &[DVec3],
        faces: &[[u32; 3]],
    ) -> Result<Range<usize>, ContactError> {
        check_indices("face", faces, positions.len())?;
        let range = self.push(positions, true)?;
        let base = range.start as u32;
        self.faces.extend(faces.iter().map(|face| face.map(|v| v + base)));
        Ok(range)
    }

    /// Adds a surface that moves as it is told, whatever it pushes.
    ///
    /// # Errors
    /// [`ContactError`] for vertices that do not exist, and motions that are not finite.
    pub fn add_moving(
        &mut self,
        positions: &[DVec3],
        faces: &[[u32; 3]],
        motion: HandleMotion,
    ) -> Result<Range<usize>, ContactError> {
        if !motion.at(DVec3::ZERO, 1.0).is_finite() {
            let (what, expected) = ("motion of an obstacle", "numbers");
            return Err(ContactError::Parameter { what, value: f64::NAN, expected });
        }
        let range = self.add_fixed(positions, faces)?;
        self.driven.extend(range.clone().map(|v| (v as u32, motion)));
        Ok(range)
    }

    /// Adds an obstacle with a formula.
    ///
    /// # Errors
    /// [`ContactError::Parameter`] for a normal that is not a unit vector, or a radius that is not positive.
    pub fn add_obstacle(&mut self, obstacle: Obstacle) -> Result<(), ContactError> {
        let (what, value, ok, expected) = match obstacle {
            Obstacle::HalfSpace { normal, offset } => {
                let length = normal.length();
                let ok = (length - 1.0).abs() < 1e-9 && offset.is_finite();
                ("length of the normal of an obstacle", length, ok, "1")
            }
            Obstacle::Ball { centre, radius } => {
                let ok = radius > 0.0 && radius.is_finite() && centre.is_finite();
                ("radius of an obstacle", radius, ok, "above 0")
            }
        };
        if !ok {
            return Err(ContactError::Parameter { what, value, expected });
        }
        self.obstacles.push(obstacle);
        Ok(())
    }

    /// Adds a handle.
    ///
    /// # Errors
    /// [`ContactError::NoVertex`], [`ContactError::Parameter`] for a stiffness that is not positive.
    pub fn add_handle(&mut self, handle: Handle) -> Result<(), ContactError> {
        let (vertex, count) = (handle.vertex as usize, self.positions.len());
        if vertex >= count {
            return Err(ContactError::NoVertex { what: "handle", index: self.handles.len(), vertex, count });
        }
        if !(handle.stiffness > 0.0 && handle.stiffness.is_finite()) {
            let (what, value, expected) = ("stiffness of a handle", handle.stiffness, "above 0");
            return Err(ContactError::Parameter { what, value, expected });
        }
        self.handles.push(handle);
        Ok(())
    }

    /// Keeps vertices where they are.
    ///
    /// # Panics
    /// If there are no such vertices.
    pub fn fix(&mut self, range: Range<usize>) {
        self.is_fixed[range].fill(true);
    }

    /// Gives vertices a velocity.
    ///
    /// # Panics
    /// If there are no such vertices.
    pub fn set_velocity(&mut self, range: Range<usize>, velocity: DVec3) {
        self.velocities[range].fill(velocity);
    }
}

/// The faces that only one of positively oriented tetrahedra has, oriented outwards.
pub(crate) fn outer_faces(tetrahedra: &[[u32; 4]]) -> impl Iterator<Item = [u32; 3]> {
    let mut faces: BTreeMap<[u32; 3], ([u32; 3], usize)> = BTreeMap::new();
    for t in tetrahedra {
        for face in [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]] {
            let face = face.map(|k: usize| t[k]);
            let mut key = face;
            key.sort_unstable();
            faces.entry(key).or_insert((face, 0)).1 += 1;
        }
    }
    faces.into_values().filter(|(_, count)| *count == 1).map(|(face, _)| face)
}

fn check_indices<const N: usize>(
    what: &'static str,
    elements: &[[u32; N]],
    count: usize,
) -> Result<(), ContactError> {
    for (index, element) in elements.iter().enumerate() {
        if let Some(&vertex) = element.iter().find(|&&v| v as usize >= count) {
            return Err(ContactError::NoVertex { what, index, vertex: vertex as usize, count });
        }
    }
    Ok(())
}
