//! Bodies of meshes that are given.

use super::ContactRequestError;
use crate::bodies::{HandleMotion, outer_faces};
use crate::{Bodies, ContactError, Handle, Material, Obstacle};
use glam::DVec3;
use pompeiu_core::TriMesh;
use serde::Deserialize;
use std::f64::consts::TAU;
use std::ops::Range;
use std::path::PathBuf;

/// The mesh of a body.
#[derive(Clone, Debug)]
pub enum BodyMesh {
    /// A surface, for shells and what stays where it is.
    Surface(TriMesh),
    /// Tetrahedra, for solids.
    Tetrahedra {
        /// Places of vertices.
        positions: Vec<[f64; 3]>,
        /// Four vertices each, in any order.
        cells: Vec<[u32; 4]>,
    },
}

/// What a body is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BodyKind {
    /// Elastic tetrahedra.
    Solid,
    /// Cloth or a shell.
    Shell,
    /// A surface that stays where it is.
    Fixed,
}

/// A material; what is not given is a default.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct MaterialTable {
    pub(super) young: Option<f64>,
    pub(super) poisson: Option<f64>,
    pub(super) density: Option<f64>,
    pub(super) thickness: Option<f64>,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct BodyTable {
    pub(super) mesh: Option<PathBuf>,
    kind: Option<BodyKind>,
    material: Option<MaterialTable>,
    scale: Option<f64>,
    r#move: Option<[f64; 3]>,
    velocity: Option<[f64; 3]>,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct ObstacleTable {
    normal: Option<[f64; 3]>,
    through: Option<[f64; 3]>,
    centre: Option<[f64; 3]>,
    radius: Option<f64>,
    pub(super) mesh: Option<PathBuf>,
    scale: Option<f64>,
    r#move: Option<[f64; 3]>,
    velocity: Option<[f64; 3]>,
    about: Option<[f64; 3]>,
    turns: Option<f64>,
}

#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct HandleTable {
    /// Number of the body, from 1.
    body: Option<usize>,
    /// The least and the greatest corner of a box whose vertices are held.
    low: Option<[f64; 3]>,
    high: Option<[f64; 3]>,
    velocity: Option<[f64; 3]>,
    about: Option<[f64; 3]>,
    through: Option<[f64; 3]>,
    /// Turns in a unit of time.
    turns: Option<f64>,
    /// Stiffness of springs for a unit of mass.
    stiffness: Option<f64>,
}

/// A material with what is given in place of a default.
pub(super) fn material_of(given: MaterialTable, default: Material) -> Material {
    Material {
        young: given.young.unwrap_or(default.young),
        poisson: given.poisson.unwrap_or(default.poisson),
        density: given.density.unwrap_or(default.density),
    }
}

/// Rubber, where nothing is said of a solid.
const SOLID: Material = Material { young: 1e6, poisson: 0.4, density: 1000.0 };

/// Cloth, where nothing is said of a shell.
const SHELL: Material = Material { young: 1e5, poisson: 0.3, density: 300.0 };

/// The thickness of a shell in parts of its extent.
const THICKNESS: f64 = 1e-3;

/// The tables of a scene of own meshes.
pub(super) struct Tables<'a> {
    pub(super) material: MaterialTable,
    pub(super) body: &'a [BodyTable],
    pub(super) obstacle: &'a [ObstacleTable],
    pub(super) handle: &'a [HandleTable],
}

/// The bodies of a scene, and the first face of each, and of each obstacle with a mesh. The meshes of obstacles are the first ones.
pub(super) fn build(
    tables: &Tables,
    meshes: &[BodyMesh],
) -> Result<(Bodies, [Vec<usize>; 2]), ContactRequestError> {
    let of_obstacles = tables.obstacle.iter().filter(|table| table.mesh.is_some()).count();
    let (obstacles, meshes) = meshes.split_at_checked(of_obstacles).unwrap_or((&[], &[]));
    if meshes.is_empty() {
        return Err(ContactRequestError::NoBodies);
    }
    let mut bodies = Bodies::new();
    let (mut ranges, mut first_faces) = (Vec::new(), Vec::new());
    let default = BodyTable::default();
    for (i, mesh) in meshes.iter().enumerate() {
        first_faces.push(bodies.faces().len());
        let table = tables.body.get(i).unwrap_or(&default);
        let given = merged(table.material.unwrap_or_default(), tables.material);
        ranges.push(add(&mut bodies, mesh, table, given, i + 1)?);
    }
    let (mut of_meshes, mut first_of_obstacles) = (obstacles.iter(), Vec::new());
    for (i, table) in tables.obstacle.iter().enumerate() {
        let in_obstacle = |error| ContactRequestError::InObstacle { obstacle: i + 1, error };
        match table.mesh.as_ref().and_then(|_| of_meshes.next()) {
            Some(mesh) => {
                first_of_obstacles.push(bodies.faces().len());
                add_surface(&mut bodies, mesh, table, i + 1)?;
            }
            None => bodies.add_obstacle(table.obstacle(i + 1)?).map_err(in_obstacle)?,
        }
    }
    for (i, table) in tables.handle.iter().enumerate() {
        hold(&mut bodies, table, &ranges, i + 1)?;
    }
    Ok((bodies, [first_faces, first_of_obstacles]))
}

/// Adds an obstacle with a mesh: a surface, or that of tetrahedra.
fn add_surface(
    bodies: &mut Bodies,
    mesh: &BodyMesh,
    table: &ObstacleTable,
    obstacle: usize,
) -> Result<(), ContactRequestError> {
    if table.normal.is_some() || table.centre.is_some() || table.radius.is_some() {
        return Err(ContactRequestError::Obstacle { obstacle });
    }
    let place = placement(table.scale, table.r#move)?;
    let motion = motion_of(table.velocity, table.about, table.through, table.turns)?;
    let (positions, faces): (_, Vec<[u32; 3]>) = match mesh {
        BodyMesh::Surface(mesh) => (place(mesh.positions()), mesh.faces().to_vec()),
        BodyMesh::Tetrahedra { positions, cells } => {
            let positions = place(positions);
            let faces = outer_faces(&oriented(&positions, cells)).collect();
            (positions, faces)
        }
    };
    let added = match motion {
        None => bodies.add_fixed(&positions, &faces),
        Some(motion) => bodies.add_moving(&positions, &faces, motion),
    };
    added.map(|_| ()).map_err(|error| ContactRequestError::InObstacle { obstacle, error })
}

/// What scales and then moves positions.
fn placement(
    scale: Option<f64>,
    shift: Option<[f64; 3]>,
) -> Result<impl Fn(&[[f64; 3]]) -> Vec<DVec3>, ContactRequestError> {
    let scale = scale.unwrap_or(1.0);
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(ContactRequestError::Value { key: "scale", value: scale, expected: "above 0" });
    }
    let shift = DVec3::from_array(shift.unwrap_or_default());
    Ok(move |positions: &[[f64; 3]]| {
        positions.iter().map(|p| DVec3::from_array(*p) * scale + shift).collect()
    })
}

/// A motion from the keys of a handle or of an obstacle; none where there is no key.
fn motion_of(
    velocity: Option<[f64; 3]>,
    about: Option<[f64; 3]>,
    through: Option<[f64; 3]>,
    turns: Option<f64>,
) -> Result<Option<HandleMotion>, ContactRequestError> {
    let vector = |key, given: Option<[f64; 3]>| {
        let vector = DVec3::from_array(given.unwrap_or_default());
        let (value, expected) = (vector.length(), "three numbers");
        if vector.is_finite() { Ok(vector) } else { Err(ContactRequestError::Value { key, value, expected }) }
    };
    let (moves, through_point) = (vector("velocity", velocity)?, vector("through", through)?);
    let Some(about) = about else {
        for (key, is_given) in [("through", through.is_some()), ("turns", turns.is_some())] {
            if is_given {
                return Err(ContactRequestError::Key {
                    key,
                    scene: "a motion that is not `about` an axis".to_owned(),
                });
            }
        }
        return Ok(velocity.map(|_| HandleMotion::Translate(moves)));
    };
    let axis = vector("about", Some(about))?;
    if axis == DVec3::ZERO {
        let expected = "the direction of an axis, not zero";
        return Err(ContactRequestError::Value { key: "about", value: 0.0, expected });
    }
    let turns = turns.unwrap_or(1.0);
    if !turns.is_finite() {
        return Err(ContactRequestError::Value { key: "turns", value: turns, expected: "a number" });
    }
    Ok(Some(HandleMotion::Rotate {
        through: through_point,
        about: axis,
        speed: turns * TAU,
        velocity: moves,
    }))
}

fn merged(first: MaterialTable, second: MaterialTable) -> MaterialTable {
    MaterialTable {
        young: first.young.or(second.young),
        poisson: first.poisson.or(second.poisson),
        density: first.density.or(second.density),
        thickness: first.thickness.or(second.thickness),
    }
}

/// Adds a body; its number counts from 1.
fn add(
    bodies: &mut Bodies,
    mesh: &BodyMesh,
    table: &BodyTable,
    given: MaterialTable,
    body: usize,
) -> Result<Range<usize>, ContactRequestError> {
    let placed = placement(table.scale, table.r#move)?;
    if table.kind == Some(BodyKind::Fixed) && table.velocity.is_some() {
        let scene =
            "a fixed body, which stays; a surface with a velocity is an [[obstacle]] with a mesh".to_owned();
        return Err(ContactRequestError::Key { key: "velocity", scene });
    }
    let in_body = |error| ContactRequestError::Body { body, error };
    let range = match (mesh, table.kind) {
        (BodyMesh::Surface(_), Some(BodyKind::Solid)) => {
            return Err(ContactRequestError::NotFilled { body });
        }
        (BodyMesh::Tetrahedra { .. }, Some(BodyKind::Shell)) => {
            return Err(ContactRequestError::NotThin { body });
        }
        (BodyMesh::Surface(mesh), Some(BodyKind::Fixed)) => {
            bodies.add_fixed(&placed(mesh.positions()), mesh.faces())
        }
        (BodyMesh::Surface(mesh), _) => {
            let positions = placed(mesh.positions());
            let thickness = given.thickness.unwrap_or(THICKNESS * super::scene::extent(&positions));
            bodies.add_shell(&positions, mesh.faces(), material_of(given, SHELL), thickness)
        }
        (BodyMesh::Tetrahedra { positions, cells }, kind) => {
            let positions = placed(positions);
            let cells = oriented(&positions, cells);
            let found = bodies.add_solid(&positions, &cells, material_of(given, SOLID));
            if let (Ok(range), Some(BodyKind::Fixed)) = (&found, kind) {
                bodies.fix(range.clone());
            }
            found
        }
    };
    let range = range.map_err(in_body)?;
    if let Some(velocity) = table.velocity {
        let velocity = DVec3::from_array(velocity);
        if !velocity.is_finite() {
            let (value, expected) = (velocity.length(), "three numbers");
            return Err(ContactRequestError::Value { key: "velocity", value, expected });
        }
        bodies.set_velocity(range.clone(), velocity);
    }
    Ok(range)
}

/// Tetrahedra of positive volume; indices are checked later.
fn oriented(positions: &[DVec3], cells: &[[u32; 4]]) -> Vec<[u32; 4]> {
    let turned = |cell: &[u32; 4]| {
        let mut cell = *cell;
        if let [Some(a), Some(b), Some(c), Some(d)] = cell.map(|v| positions.get(v as usize))
            && (*b - *a).cross(*c - *a).dot(*d - *a) < 0.0
        {
            cell.swap(2, 3);
        }
        cell
    };
    cells.iter().map(turned).collect()
}

impl ObstacleTable {
    fn obstacle(&self, obstacle: usize) -> Result<Obstacle, ContactRequestError> {
        let moves = self.velocity.is_some() || self.about.is_some() || self.turns.is_some();
        let is_placed = self.scale.is_some() || self.r#move.is_some();
        match (self.normal, self.centre, self.radius) {
            _ if moves || is_placed => Err(ContactRequestError::Obstacle { obstacle }),
            (Some(normal), None, None) => {
                let normal = DVec3::from_array(normal).normalize_or_zero();
                let through = DVec3::from_array(self.through.unwrap_or_default());
                Ok(Obstacle::HalfSpace { normal, offset: normal.dot(through) })
            }
            (None, Some(centre), Some(radius)) if self.through.is_none() => {
                Ok(Obstacle::Ball { centre: DVec3::from_array(centre), radius })
            }
            _ => Err(ContactRequestError::Obstacle { obstacle }),
        }
    }
}

/// Adds a handle for each vertex of a body in a box.
fn hold(
    bodies: &mut Bodies,
    table: &HandleTable,
    ranges: &[Range<usize>],
    handle: usize,
) -> Result<(), ContactRequestError> {
    let body = table.body.unwrap_or(1);
    let range = body.checked_sub(1).and_then(|i| ranges.get(i)).cloned();
    let count = ranges.len();
    let range = range.ok_or(ContactRequestError::HandleOf { handle, body, count })?;
    let low = table.low.map_or(DVec3::NEG_INFINITY, DVec3::from_array);
    let high = table.high.map_or(DVec3::INFINITY, DVec3::from_array);
    let motion = motion_of(table.velocity, table.about, table.through, table.turns)?;
    let motion = motion.unwrap_or(HandleMotion::Translate(DVec3::ZERO));
    let is_inside = |p: &DVec3| p.cmpge(low).all() && p.cmple(high).all();
    let held: Vec<usize> = range.filter(|v| is_inside(&bodies.positions()[*v])).collect();
    if held.is_empty() {
        return Err(ContactRequestError::NothingHeld { handle, body });
    }
    let stiffness = table.stiffness.unwrap_or(Handle::STIFFNESS);
    for vertex in held {
        let added = bodies.add_handle(Handle { vertex: vertex as u32, motion, stiffness });
        added.map_err(|error: ContactError| ContactRequestError::Body { body, error })?;
    }
    Ok(())
}
