//! Splines over a tricubic mesh with local refinement.

use crate::mesh::{LINEAR_PARTS, cubic_vtu, go_on};
use crate::{CubicMesh, MeshError, Skeleton};
use glam::DVec3;
use pompeiu_core::run::{Control, Limits, Progress, ProgressObserver, StopReason};
use pompeiu_volume::{BYTES_PER_FUNCTION, FACE_AXES, HierarchicalElement, HierarchicalSplines, MOST_LEVELS};
use std::collections::HashMap;
use std::ops::ControlFlow;

/// A place where splines are refined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RefineAt {
    /// In the patches of nodes.
    Nodes,
    /// Next to flat ends.
    Ends,
    /// Next to the wall.
    Wall,
    /// In the patches of a branch.
    Branch(u32),
    /// In elements within this distance of a point, in micrometres.
    Ball {
        /// The place.
        centre: DVec3,
        /// The distance.
        radius: f64,
    },
}

impl RefineAt {
    /// The place with a name: `nodes`, `ends`, `wall`, `branch=3`, `sample=57`, which is the ball of that sample, or
    /// `ball=x,y,z,r`.
    ///
    /// # Errors
    /// [`MeshError::Place`] for another name, and for nodes and samples of an imported mesh, which has no skeleton.
    pub fn from_name(name: &str, skeleton: Option<&Skeleton>) -> Result<Self, MeshError> {
        let wrong = |problem| MeshError::Place { place: name.to_owned(), problem };
        let unknown = || {
            wrong("is no place to refine; expected nodes, ends, wall, branch=N, sample=ID or ball=X,Y,Z,R")
        };
        let skeleton = || skeleton.ok_or_else(|| wrong("is a place in skeletons; this mesh has none"));
        match name.split_once('=') {
            None if name == "nodes" => skeleton().map(|_| Self::Nodes),
            None if name == "ends" => Ok(Self::Ends),
            None if name == "wall" => Ok(Self::Wall),
            Some(("branch", number)) => {
                skeleton()?;
                number.parse().map(Self::Branch).map_err(|_| unknown())
            }
            Some(("sample", id)) => {
                let id: i64 = id.parse().map_err(|_| unknown())?;
                let sample = skeleton()?.samples().iter().find(|sample| sample.id == id);
                let sample = sample.ok_or_else(|| wrong("is not there: no sample has this number"))?;
                Ok(Self::Ball { centre: sample.position, radius: sample.radius })
            }
            Some(("ball", numbers)) => {
                let numbers: Result<Vec<f64>, _> = numbers.split(',').map(|x| x.trim().parse()).collect();
                match numbers.as_deref() {
                    Ok(&[x, y, z, radius]) => Ok(Self::Ball { centre: DVec3::new(x, y, z), radius }),
                    _ => Err(unknown()),
                }
            }
            _ => Err(unknown()),
        }
    }

    /// Its name.
    fn name(&self) -> String {
        match self {
            Self::Nodes => "nodes".to_owned(),
            Self::Ends => "ends".to_owned(),
            Self::Wall => "wall".to_owned(),
            Self::Branch(branch) => format!("branch={branch}"),
            Self::Ball { centre, radius } => format!("ball={},{},{},{radius}", centre.x, centre.y, centre.z),
        }
    }
}

/// Options of refinement.
#[derive(Clone)]
pub struct RefineOptions<'o> {
    /// Unrefined elements along each edge of each patch, 1 to 4.
    pub elements: usize,
    /// The places; elements in any of them are refined.
    pub at: &'o [RefineAt],
    /// How often elements are halved there, 0 to 5.
    pub times: usize,
    /// Limits on time and memory.
    pub limits: Limits,
    /// Receives the number of completed levels.
    pub progress: Option<&'o dyn ProgressObserver>,
}

/// Largest memory if no limit is given, in bytes.
const MOST_BYTES: usize = 8 << 30;

/// Splines over the patches of a mesh with local refinement: truncated hierarchical splines, whose space contains the unrefined
/// one. In the requested elements, all functions of their level exist.
///
/// # Shapes and units
/// Lengths in micrometres.
/// # Errors
/// [`MeshError::Option`] for numbers out of range; [`MeshError::Place`] if a place contains no element; [`MeshError::Memory`],
/// [`MeshError::Stopped`].
/// # Cost
/// See [`HierarchicalSplines`].
/// # Source
/// `giannelli_thbsplines_2012`.
pub fn refined_splines(
    mesh: &CubicMesh,
    options: &RefineOptions<'_>,
) -> Result<HierarchicalSplines, MeshError> {
    let wrong = |what, value, expected| Err(MeshError::Option { what, value, expected });
    if !(1..=4).contains(&options.elements) {
        return wrong("number of elements of a patch", options.elements as f64, "1 to 4");
    }
    if options.times >= MOST_LEVELS {
        return wrong("number of levels of refinement", options.times as f64, "0 to 5");
    }
    for at in options.at {
        if let RefineAt::Ball { centre, radius } = at
            && !(centre.is_finite() && radius.is_finite() && *radius >= 0.0)
        {
            return wrong("radius around a place", *radius, "at least 0, and finite as the place is");
        }
    }
    let control = Control::start(&options.limits);
    let places = Places::new(mesh);
    let mut splines = HierarchicalSplines::new(&mesh.mesh, options.elements);
    let all = splines.elements().len();
    if let Some(at) = options.at.iter().find(|at| !(0..all).any(|k| places.has(at, &splines, k))) {
        return Err(MeshError::Place {
            place: at.name(),
            problem: "is not there: no element is in this place",
        });
    }
    for level in 0..options.times {
        let marked: Vec<usize> = (0..splines.elements().len())
            .filter(|&k| usize::from(splines.elements()[k].level) == level)
            .filter(|&k| options.at.iter().any(|at| places.has(at, &splines, k)))
            .collect();
        check_memory(&splines, mesh, &marked, &options.limits)?;
        let share = Some((level + 1) as f64 / options.times as f64);
        let progress = Progress { doing: "refining splines", share };
        if options.progress.is_some_and(|observer| observer.progress(&progress) == ControlFlow::Break(())) {
            control.stop(StopReason::Cancelled);
        }
        go_on(&control)?;
        splines = splines.refined(&mesh.mesh, &marked);
    }
    Ok(splines)
}

fn check_memory(
    splines: &HierarchicalSplines,
    mesh: &CubicMesh,
    marked: &[usize],
    limits: &Limits,
) -> Result<(), MeshError> {
    let functions = splines.functions_to_number(&mesh.mesh, marked);
    let (needed, limit) = (functions.saturating_mul(BYTES_PER_FUNCTION), limits.memory.unwrap_or(MOST_BYTES));
    if needed > limit {
        let (cells, needed) = (splines.elements().len() + 7 * marked.len(), needed.div_ceil(1 << 20));
        return Err(MeshError::Memory { cells, needed, limit: limit >> 20 });
    }
    Ok(())
}

/// The positions of patches.
struct Places<'m> {
    mesh: &'m CubicMesh,
    /// Whether each boundary face of a patch is on the wall.
    is_wall: HashMap<(u32, u8), bool>,
}

impl<'m> Places<'m> {
    fn new(mesh: &'m CubicMesh) -> Self {
        let faces = mesh.faces.boundary().iter().zip(&mesh.labels);
        Self { mesh, is_wall: faces.map(|(face, label)| ((face.cell, face.place), *label == 0)).collect() }
    }

    /// Whether an element is in a place.
    fn has(&self, at: &RefineAt, splines: &HierarchicalSplines, number: usize) -> bool {
        let element = &splines.elements()[number];
        let part = self.mesh.parts[element.patch as usize];
        match *at {
            RefineAt::Nodes => part < 0,
            RefineAt::Branch(branch) => i64::from(part) == i64::from(branch),
            RefineAt::Ends => self.touches(splines, element, false),
            RefineAt::Wall => self.touches(splines, element, true),
            RefineAt::Ball { centre, radius } => {
                let points = splines.control(&self.mesh.mesh, number);
                let low = points.iter().fold(DVec3::INFINITY, |low, p| low.min(*p));
                let high = points.iter().fold(DVec3::NEG_INFINITY, |high, p| high.max(*p));
                centre.distance(centre.clamp(low, high)) <= radius
            }
        }
    }

    /// Whether an element has a face on the wall, or on a flat end.
    fn touches(&self, splines: &HierarchicalSplines, element: &HierarchicalElement, wall: bool) -> bool {
        let intervals = splines.intervals(element);
        (0..6_u8).zip(FACE_AXES).any(|(face, (axis, side, _))| {
            let [start, end] = intervals[axis];
            let is_there = if side == 0 { start == 0.0 } else { end == 1.0 };
            is_there && self.is_wall.get(&(element.patch, face)) == Some(&wall)
        })
    }
}

/// The elements of refined splines as a VTK XML unstructured grid, as Bézier hexahedra or as trilinear cells, with the branch and
/// the level of each as cell data.
///
/// # Errors
/// Only allocation errors.
pub fn refined_vtu(
    mesh: &CubicMesh,
    splines: &HierarchicalSplines,
    linear: bool,
) -> std::io::Result<Vec<u8>> {
    let wrong = |error| std::io::Error::new(std::io::ErrorKind::InvalidInput, error);
    let cells = splines.cells(&mesh.mesh).map_err(wrong)?;
    let of = |value: fn(&HierarchicalElement, &CubicMesh) -> f64| -> Vec<f64> {
        splines.elements().iter().map(|element| value(element, mesh)).collect()
    };
    let branches = of(|element, mesh| f64::from(mesh.parts[element.patch as usize]));
    let levels = of(|element, _| f64::from(element.level));
    cubic_vtu(&cells, linear.then_some(LINEAR_PARTS), &[], &[("branch", &branches), ("level", &levels)])
}
