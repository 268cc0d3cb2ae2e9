//! The scene: which bodies there are, and the options that suit them, in TOML.

use super::examples::{Built, Sizes};
use super::own::{self, BodyTable, HandleTable, MaterialTable, ObstacleTable, Tables};
use super::{BodyMesh, ContactRequest, ContactRequestError, Example};
use crate::{Check, ContactOptions, Integrator, PairSet, Projection};
use glam::DVec3;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// A scene: the keys of its file. Lengths, times and masses are in any units that go together.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct Scene {
    kind: Option<Example>,
    /// Cells along the bodies of an example.
    cells: Option<usize>,
    /// Degrees of the incline.
    angle: Option<f64>,
    /// Turns of a twist.
    turns: Option<f64>,
    /// Boxes of the stack.
    boxes: Option<usize>,
    /// Speed of each body of the collision.
    speed: Option<f64>,
    steps: Option<usize>,
    dt: Option<f64>,
    distance: Option<f64>,
    friction: Option<f64>,
    gravity: Option<[f64; 3]>,
    pairs: Option<PairSet>,
    projection: Option<Projection>,
    integrator: Option<Integrator>,
    check: Option<Check>,
    tolerance: Option<f64>,
    stiffness: Option<f64>,
    sticking_speed: Option<f64>,
    most_iterations: Option<usize>,
    material: Option<MaterialTable>,
    body: Vec<BodyTable>,
    obstacle: Vec<ObstacleTable>,
    handle: Vec<HandleTable>,
}

/// Largest size of a scene, in bytes.
const MOST_BYTES: u64 = 1 << 20;

/// Steps where nothing says how many.
const STEPS: usize = 100;

/// Length of a step where nothing says it.
const TIME_STEP: f64 = 0.01;

impl Scene {
    /// Reads the file of a scene; where there is none, the example of that name.
    ///
    /// # Errors
    /// [`ContactRequestError`].
    pub fn named(name: &Path) -> Result<Self, ContactRequestError> {
        let example = name.to_str().and_then(Example::of_name).filter(|_| !name.exists());
        match example {
            Some(example) => Ok(Self { kind: Some(example), ..Self::default() }),
            None if !name.exists() => Err(ContactRequestError::NoScene { name: name.display().to_string() }),
            None => Self::read(name),
        }
    }

    /// Reads the file of a scene. Meshes that it names are beside it.
    ///
    /// # Errors
    /// [`ContactRequestError`].
    pub fn read(path: &Path) -> Result<Self, ContactRequestError> {
        let unusable = |error| ContactRequestError::File { path: path.to_owned(), error };
        let found = std::fs::metadata(path).map_err(unusable)?.len();
        if found > MOST_BYTES {
            return Err(ContactRequestError::Large { path: path.to_owned(), found, most: MOST_BYTES });
        }
        let text = std::fs::read_to_string(path).map_err(unusable)?;
        let mut scene: Self = toml::from_str(&text).map_err(|error| {
            let message = error.to_string().trim_end().to_owned() + &hint(error.message());
            ContactRequestError::Syntax { place: path.display().to_string(), message }
        })?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let of_obstacles = scene.obstacle.iter_mut().filter_map(|obstacle| obstacle.mesh.as_mut());
        for mesh in scene.body.iter_mut().filter_map(|body| body.mesh.as_mut()).chain(of_obstacles) {
            *mesh = folder.join(&mesh);
        }
        scene.check()?;
        Ok(scene)
    }

    /// A scene from JSON with the same keys.
    ///
    /// # Errors
    /// [`ContactRequestError`].
    pub fn from_json(text: &str) -> Result<Self, ContactRequestError> {
        let scene: Self = serde_json::from_str(text).map_err(|error| {
            let message = error.to_string();
            ContactRequestError::Syntax {
                place: "the scene".to_owned(),
                message: message.clone() + &hint(&message),
            }
        })?;
        scene.check()?;
        Ok(scene)
    }

    /// What it is called: the example, or the bodies of a file.
    pub fn name(&self) -> &'static str {
        self.kind.map_or("bodies", Example::name)
    }

    /// The files of meshes that its bodies name; none for bodies that take a mesh that is given.
    pub fn meshes(&self) -> Vec<Option<PathBuf>> {
        self.body.iter().map(|body| body.mesh.clone()).collect()
    }

    /// The meshes of obstacles, then those of all bodies: those that they name, which `read` reads, and those that are given, in order.
    ///
    /// # Errors
    /// [`ContactRequestError::NoMesh`], or what `read` says.
    pub fn with_meshes<E: From<ContactRequestError>>(
        &self,
        given: Vec<BodyMesh>,
        mut read: impl FnMut(&Path) -> Result<BodyMesh, E>,
    ) -> Result<Vec<BodyMesh>, E> {
        let mut given = given.into_iter();
        let of_obstacles = self.obstacle.iter().filter_map(|obstacle| obstacle.mesh.as_deref());
        let mut meshes = of_obstacles.map(&mut read).collect::<Result<Vec<_>, E>>()?;
        for (body, mesh) in self.meshes().into_iter().enumerate() {
            meshes.push(match mesh {
                Some(path) => read(&path)?,
                None => given.next().ok_or(ContactRequestError::NoMesh { body: body + 1 })?,
            });
        }
        meshes.extend(given);
        Ok(meshes)
    }

    fn check(&self) -> Result<(), ContactRequestError> {
        let key = |key| Err(ContactRequestError::Key { key, scene: format!("a scene of {}", self.name()) });
        for (name, is_given, examples) in [
            ("cells", self.cells.is_some(), &Example::ALL[1..]),
            ("angle", self.angle.is_some(), &[Example::Incline][..]),
            ("turns", self.turns.is_some(), &[Example::ClothTwist, Example::RodTwist]),
            ("boxes", self.boxes.is_some(), &[Example::Stack]),
            ("speed", self.speed.is_some(), &[Example::Collision]),
        ] {
            if is_given && !self.kind.is_some_and(|kind| examples.contains(&kind)) {
                return key(name);
            }
        }
        if self.kind.is_some() {
            for (name, is_given) in [
                ("body", !self.body.is_empty()),
                ("obstacle", !self.obstacle.is_empty()),
                ("handle", !self.handle.is_empty()),
            ] {
                if is_given {
                    return key(name);
                }
            }
        }
        Ok(())
    }

    /// The bodies and the options, with what the request replaces.
    pub(super) fn build(
        &self,
        meshes: &[BodyMesh],
        request: &ContactRequest,
    ) -> Result<Built, ContactRequestError> {
        let mut built = match self.kind {
            Some(kind) if !meshes.is_empty() => {
                return Err(ContactRequestError::TakesNoMesh { scene: kind.name() });
            }
            Some(kind) => kind.build(self.sizes())?,
            None => {
                let (bodies, [first_faces, first_of_obstacles]) = own::build(&self.tables(), meshes)?;
                let options = ContactOptions::new(TIME_STEP, extent(bodies.positions()));
                Built { bodies, options, steps: STEPS, first_faces, first_of_obstacles }
            }
        };
        self.replace(&mut built.options);
        replace(request, &mut built.options);
        built.steps = request.steps.or(self.steps).unwrap_or(built.steps);
        Ok(built)
    }

    fn sizes(&self) -> Sizes {
        Sizes {
            material: self.material.unwrap_or_default(),
            cells: self.cells,
            angle: self.angle,
            turns: self.turns,
            boxes: self.boxes,
            speed: self.speed,
        }
    }

    fn tables(&self) -> Tables<'_> {
        let material = self.material.unwrap_or_default();
        Tables { material, body: &self.body, obstacle: &self.obstacle, handle: &self.handle }
    }

    fn replace(&self, options: &mut ContactOptions) {
        let as_request = ContactRequest {
            steps: None,
            dt: self.dt,
            distance: self.distance,
            friction: self.friction,
            gravity: self.gravity,
            pairs: self.pairs,
            projection: self.projection,
            integrator: self.integrator,
            check: self.check,
            tolerance: self.tolerance,
            stiffness: self.stiffness,
        };
        replace(&as_request, options);
        options.sticking_speed = self.sticking_speed.unwrap_or(options.sticking_speed);
        options.most_iterations = self.most_iterations.unwrap_or(options.most_iterations);
    }
}

fn replace(request: &ContactRequest, options: &mut ContactOptions) {
    options.time_step = request.dt.unwrap_or(options.time_step);
    options.distance = request.distance.unwrap_or(options.distance);
    options.friction = request.friction.unwrap_or(options.friction);
    options.gravity = request.gravity.map_or(options.gravity, DVec3::from_array);
    options.pairs = request.pairs.unwrap_or(options.pairs);
    options.projection = request.projection.unwrap_or(options.projection);
    options.integrator = request.integrator.unwrap_or(options.integrator);
    options.check = request.check.unwrap_or(options.check);
    options.tolerance = request.tolerance.unwrap_or(options.tolerance);
    options.stiffness = request.stiffness.or(options.stiffness);
}

/// The greatest extent along an axis; 1 where there is none.
pub(super) fn extent(positions: &[DVec3]) -> f64 {
    let low = positions.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = positions.iter().copied().reduce(DVec3::max).unwrap_or_default();
    let extent = (high - low).max_element();
    if extent > 0.0 && extent.is_finite() { extent } else { 1.0 }
}

/// The known key that is most like an unknown one.
fn hint(message: &str) -> String {
    let names: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match names[..] {
        [unknown, ref known @ ..] if message.starts_with("unknown ") => {
            let likeness = |name: &&&str| strsim::normalized_damerau_levenshtein(unknown, name);
            let nearest = known.iter().max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
            nearest.map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
        }
        _ => String::new(),
    }
}
