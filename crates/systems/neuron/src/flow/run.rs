//! Flow through a neuron.

use super::element::{Cell, PRESSURES, Tables};
use super::error::FlowError;
use super::problem::{Drive, FlowOptions, FlowParameters};
use super::system::FlowSystem;
use crate::mesh::{LINEAR_PARTS, Labelled, LinearShares, cubic_vtu, linear_shares};
use crate::transport::labels_of_parts;
use crate::{Cap, CubicMesh};
use glam::DVec3;
use pompeiu_core::run::{Control, Progress, StopReason, on_threads};
use pompeiu_volume::bernstein::{interpolate_lattice, value};
use pompeiu_volume::{BezierMesh, FACE_AXES, Faces, face_flux, face_points, place_of_64};
use std::collections::VecDeque;
use std::ops::ControlFlow;

/// The velocity and pressure in a neuron.
#[derive(Clone, Debug)]
pub struct Flow {
    /// The cells: patches, subdivided into elements.
    pub mesh: BezierMesh,
    /// The faces of the cells.
    pub faces: Faces,
    /// For each boundary face 0 if it lies on the wall, and 1 + k if it lies on cap k.
    pub labels: Vec<u32>,
    /// The branch of each cell.
    pub parts: Vec<i32>,
    /// The flat ends of tubes.
    pub caps: Vec<Cap>,
    /// The cap that is the inlet.
    pub inlet: u32,
    /// The velocity at control points in µm/s: its Bézier coefficients.
    pub velocity: Vec<DVec3>,
    /// The outflow and the mean pressure at each flat end.
    pub ends: Vec<FlowEnd>,
    /// The report.
    pub report: FlowReport,
    /// The pressure at the centre of each cell, in Pa.
    pressure: Vec<f64>,
}

/// The flow at a flat end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowEnd {
    /// The number of its sample.
    pub sample: i64,
    /// Outflow in µm³/s.
    pub flux: f64,
    /// The mean pressure in Pa.
    pub pressure: f64,
}

/// The report of a flow.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FlowReport {
    /// Reynolds number at the inlet: mean speed times diameter over kinematic viscosity.
    pub reynolds: f64,
    /// The norm of the residual before each Newton step and after the last, relative to the first.
    pub newton: Vec<f64>,
    /// Net outflow through all flat ends, relative to the inlet.
    pub imbalance: f64,
    /// Absolute flux through the wall, relative to the inlet.
    pub wall_leak: f64,
    /// The greatest difference between the flux through a section and the outflow of the ends behind it, relative to the inlet.
    pub section_flux_drift: f64,
    /// Mean pressure at the inlet minus the mean over all other ends, in Pa.
    pub pressure_drop: f64,
    /// What the trilinear cells keep that stand for tricubic ones in files, three along each edge of an element.
    pub linear: LinearShares,
}

/// Largest memory for factors if no limit is given, in bytes.
const MOST_BYTES: usize = 10 << 30;

/// Computes the flow through a neuron: steady, incompressible, viscous, at rest at the wall.
///
/// # Shapes and units
/// µm, seconds, Pa.
/// # Definition
/// The Navier–Stokes equations with velocity or pressure given at the inlet, and pressures at all other flat ends. There, viscosity
/// times the normal derivative of the velocity balances the difference between the inner and the given pressure.
/// # Accuracy
/// Where the mesh is smooth, the velocity is of fourth order in L² and the pressure of third order in the cell size. Inflow and
/// outflow of each cell balance to the accuracy of the linear solves.
/// # Errors
/// [`FlowError`].
/// # Cost
/// One factorisation along the tree per Newton step: linear in its length.
/// # Source
/// Discontinuous pressures, polynomial in space coordinates: `arnold_approximation_2002`. Pressures at ends:
/// `heywood_artificial_1996`.
pub fn neuron_flow(
    mesh: &CubicMesh,
    parameters: &FlowParameters,
    options: &FlowOptions<'_>,
) -> Result<Flow, FlowError> {
    parameters.check()?;
    if !(1..=4).contains(&options.elements) {
        let value = options.elements as f64;
        return Err(FlowError::Parameter { what: "the number of elements", value, expected: "1 to 4" });
    }
    on_threads(options.limits.threads, || solve(mesh, parameters, options))
}

fn cap_of(caps: &[Cap], sample: i64) -> Result<u32, FlowError> {
    Cap::at(caps, sample).map_err(|ends| FlowError::NotAnEnd { sample, ends })
}

fn solve(
    mesh: &CubicMesh,
    parameters: &FlowParameters,
    options: &FlowOptions<'_>,
) -> Result<Flow, FlowError> {
    let control = Control::start(&options.limits);
    let inlet = match parameters.inlet {
        None => Cap::of_root(&mesh.caps).ok_or(FlowError::NoInlet)?,
        Some(sample) => cap_of(&mesh.caps, sample)?,
    };
    let mut outside = vec![0.0; mesh.caps.len()];
    for &(sample, pressure) in &parameters.pressures {
        outside[cap_of(&mesh.caps, sample)? as usize] = pressure / parameters.viscosity;
    }
    let n = options.elements;
    let (cells, _) = mesh.mesh.subdivided(n, &[])?;
    let faces = Faces::new(&cells.corner_mesh()?)?;
    let labels = labels_of_parts(&mesh.faces, &mesh.labels, &faces, n);
    let parts: Vec<i32> = mesh.parts.iter().flat_map(|&part| std::iter::repeat_n(part, n.pow(3))).collect();
    let tree = Tree::new(mesh, &faces, &labels, inlet, n);
    let mut given: Vec<Option<DVec3>> = vec![None; cells.points().len()];
    let mut tractions = Vec::new();
    let mut has_outlet = vec![false; tree.components];
    for (face, &label) in faces.boundary().iter().zip(&labels).filter(|(_, label)| **label > 0) {
        match parameters.drive {
            Drive::Speed(_) if label - 1 == inlet => continue,
            Drive::Pressure(pressure) if label - 1 == inlet => {
                tractions.push((face.cell, face.place, pressure / parameters.viscosity));
            }
            _ => tractions.push((face.cell, face.place, outside[label as usize - 1])),
        }
        has_outlet[tree.component[tree.group[face.cell as usize] as usize]] = true;
    }
    if !has_outlet.iter().all(|has| *has) {
        return Err(FlowError::NoOutlet);
    }
    if let Drive::Speed(speed) = parameters.drive {
        profile(&cells, &faces, &labels, mesh.caps[inlet as usize], inlet, speed, &mut given);
    }
    // The wall comes last, because the rim of the inlet is at rest.
    for (face, _) in faces.boundary().iter().zip(&labels).filter(|(_, label)| **label == 0) {
        on_face(&cells, face.cell, face.place, |v, _| given[v as usize] = Some(DVec3::ZERO));
    }
    let (groups, parents) = tree.elimination();
    let system = FlowSystem {
        mesh: &cells,
        given,
        tractions,
        force: None,
        inverse_viscosity: 1.0 / parameters.kinematic_viscosity(),
        groups,
        parents,
        pinned: None,
    };
    let mut step = |done: usize| {
        let share = Some(1.0 - 1.0 / (done + 1) as f64);
        let told = options
            .progress
            .map(|observer| observer.progress(&Progress { doing: "solving for the flow", share }));
        if told == Some(ControlFlow::Break(())) {
            control.stop(StopReason::Cancelled);
        }
    };
    let found = system.solve(options.limits.memory.unwrap_or(MOST_BYTES), &control, &mut step)?;
    let scaled: Vec<[f64; PRESSURES]> =
        found.pressure.iter().map(|p| p.map(|x| x * parameters.viscosity)).collect();
    let boundary = Labelled { faces: &faces, labels: &labels };
    let linear = linear_shares(&cells, boundary, LINEAR_PARTS, Some((&found.velocity, inlet + 1)));
    let mut flow = Flow {
        faces,
        labels,
        parts,
        caps: mesh.caps.clone(),
        inlet,
        velocity: found.velocity,
        ends: Vec::new(),
        report: FlowReport {
            reynolds: 0.0,
            newton: found.newton,
            imbalance: 0.0,
            wall_leak: 0.0,
            section_flux_drift: 0.0,
            pressure_drop: 0.0,
            linear,
        },
        pressure: Vec::new(),
        mesh: cells,
    };
    flow.measure(&tree, &scaled, parameters);
    Ok(flow)
}

/// The control points on a face of a cell, with their indices among the 64.
fn on_face(mesh: &BezierMesh, cell: u32, face: u8, mut act: impl FnMut(u32, usize)) {
    let (axis, side, _) = FACE_AXES[face as usize];
    for (k, &v) in mesh.cells()[cell as usize].iter().enumerate() {
        if place_of_64(k)[axis] == 3 * side {
            act(v, k);
        }
    }
}

/// The velocity at the inlet: normal to it, with the profile of a long tube and the given mean speed.
fn profile(
    mesh: &BezierMesh,
    faces: &Faces,
    labels: &[u32],
    cap: Cap,
    inlet: u32,
    speed: f64,
    given: &mut [Option<DVec3>],
) {
    let at_inlet: Vec<_> =
        faces.boundary().iter().zip(labels).filter(|(_, l)| **l == inlet + 1).map(|(face, _)| face).collect();
    let wall: Vec<_> =
        faces.boundary().iter().zip(labels).filter(|(_, l)| **l == 0).map(|(face, _)| face).collect();
    let mut is_wall = vec![false; given.len()];
    for face in wall {
        on_face(mesh, face.cell, face.place, |v, _| is_wall[v as usize] = true);
    }
    let mut radius_sq = 0.0_f64;
    for face in &at_inlet {
        on_face(mesh, face.cell, face.place, |v, k| {
            if pompeiu_volume::CORNERS_OF_64.contains(&k) {
                radius_sq = radius_sq.max(mesh.points()[v as usize].distance_squared(cap.centre));
            }
        });
    }
    let (mut area, mut flux) = (0.0, 0.0);
    for face in &at_inlet {
        let points = mesh.control(face.cell as usize);
        let values = std::array::from_fn(|k| {
            let p = value(&points, place_of_64(k).map(|i| i as f64 / 3.0));
            -cap.normal * (1.0 - p.distance_squared(cap.centre) / radius_sq)
        });
        let coefficients = interpolate_lattice(&values);
        on_face(mesh, face.cell, face.place, |v, k| {
            given[v as usize] = Some(if is_wall[v as usize] { DVec3::ZERO } else { coefficients[k] });
        });
        area += face_points(&points, face.place.into()).iter().map(|(_, a)| a.dot(cap.normal)).sum::<f64>();
    }
    for face in &at_inlet {
        let points = mesh.control(face.cell as usize);
        let field = mesh.cells()[face.cell as usize].map(|v| given[v as usize].unwrap_or_default());
        flux -= face_flux(&points, &field, face.place.into());
    }
    let factor = if flux > 0.0 { speed * area / flux } else { 0.0 };
    for velocity in given.iter_mut().flatten() {
        *velocity *= factor;
    }
}

/// Groups of cells (sections of tubes and whole nodes) as a tree rooted in the inlet.
struct Tree {
    /// The group of each cell.
    group: Vec<u32>,
    /// Groups in order from the inlet: each after its parent.
    order: Vec<u32>,
    parent: Vec<Option<u32>>,
    component: Vec<usize>,
    components: usize,
}

impl Tree {
    fn new(mesh: &CubicMesh, faces: &Faces, labels: &[u32], inlet: u32, n: usize) -> Self {
        // Five patches of a tube are a layer, which has one group for each element along it.
        let mut number = std::collections::HashMap::new();
        let mut in_tube: std::collections::HashMap<i32, usize> = std::collections::HashMap::new();
        let mut group = Vec::with_capacity(mesh.parts.len() * n.pow(3));
        for &part in &mesh.parts {
            let nth = in_tube.entry(part).or_default();
            let layer = if part < 0 { 0 } else { *nth / 5 };
            *nth += 1;
            for c in 0..n.pow(3) {
                let key = (part, if part < 0 { 0 } else { layer * n + c / (n * n) });
                let next = number.len() as u32;
                group.push(*number.entry(key).or_insert(next));
            }
        }
        let count = number.len();
        let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); count];
        for face in faces.inner() {
            let [a, b] = face.cells.map(|cell| group[cell as usize]);
            if a != b {
                neighbours[a as usize].push(b);
                neighbours[b as usize].push(a);
            }
        }
        let root = faces
            .boundary()
            .iter()
            .zip(labels)
            .find(|(_, label)| **label == inlet + 1)
            .map_or(0, |(face, _)| group[face.cell as usize]);
        let (mut order, mut parent) = (Vec::with_capacity(count), vec![None; count]);
        let (mut component, mut components) = (vec![usize::MAX; count], 0);
        for start in std::iter::once(root).chain(0..count as u32) {
            if component[start as usize] != usize::MAX {
                continue;
            }
            let mut queue = VecDeque::from([start]);
            component[start as usize] = components;
            while let Some(g) = queue.pop_front() {
                order.push(g);
                for &next in &neighbours[g as usize] {
                    if component[next as usize] == usize::MAX {
                        component[next as usize] = components;
                        parent[next as usize] = Some(g);
                        queue.push_back(next);
                    }
                }
            }
            components += 1;
        }
        Self { group, order, parent, component, components }
    }

    /// The group of each cell in elimination order, from the tips to the inlet, and the parents of groups.
    fn elimination(&self) -> (Vec<u32>, Vec<Option<u32>>) {
        let count = self.order.len();
        let mut rank = vec![0; count];
        for (k, &g) in self.order.iter().enumerate() {
            rank[g as usize] = (count - 1 - k) as u32;
        }
        let groups = self.group.iter().map(|&g| rank[g as usize]).collect();
        let mut parents = vec![None; count];
        for (g, parent) in self.parent.iter().enumerate() {
            parents[rank[g] as usize] = parent.map(|p| rank[p as usize]);
        }
        (groups, parents)
    }
}

impl Flow {
    /// The flux out of a cell through a face.
    pub fn flux(&self, cell: u32, face: u8) -> f64 {
        let field = self.mesh.cells()[cell as usize].map(|v| self.velocity[v as usize]);
        face_flux(&self.mesh.control(cell as usize), &field, face.into())
    }

    fn measure(&mut self, tree: &Tree, pressures: &[[f64; PRESSURES]], parameters: &FlowParameters) {
        let tables = Tables::new();
        let count = self.caps.len();
        let (mut flux, mut sums, mut wall) = (vec![0.0; count], vec![[0.0; 2]; count], 0.0);
        // The outflow of each group through its own ends.
        let mut leaves = vec![0.0; tree.order.len()];
        for (face, &label) in self.faces.boundary().iter().zip(&self.labels) {
            let out = self.flux(face.cell, face.place);
            if label == 0 {
                wall += out.abs();
                continue;
            }
            let cap = label as usize - 1;
            flux[cap] += out;
            leaves[tree.group[face.cell as usize] as usize] += out;
            let cell = Cell::new(&tables, &self.mesh.control(face.cell as usize));
            let [p, area] = cell.face_pressure(face.place.into(), &pressures[face.cell as usize]);
            (sums[cap][0], sums[cap][1]) = (sums[cap][0] + p, sums[cap][1] + area);
        }
        let inlet = self.inlet as usize;
        let entering = flux[inlet].abs().max(f64::MIN_POSITIVE);
        // The flux from each group to its parent, face by face, and the outflow at the ends of its subtree.
        let mut given = vec![0.0; tree.order.len()];
        for face in self.faces.inner() {
            let [a, b] = face.cells.map(|cell| tree.group[cell as usize]);
            let out = self.flux(face.cells[0], face.places[0]);
            if tree.parent[a as usize] == Some(b) {
                given[a as usize] += out;
            } else if tree.parent[b as usize] == Some(a) {
                given[b as usize] -= out;
            }
        }
        let mut drift = 0.0_f64;
        for &g in tree.order.iter().rev() {
            if let Some(parent) = tree.parent[g as usize] {
                drift = drift.max((given[g as usize] + leaves[g as usize]).abs());
                leaves[parent as usize] += leaves[g as usize];
            }
        }
        let mean = |[p, area]: [f64; 2]| p / area.max(f64::MIN_POSITIVE);
        let others = sums.iter().enumerate().filter(|(cap, _)| *cap != inlet);
        let rest = others.fold([0.0; 2], |[p, a], (_, [q, b])| [p + q, a + b]);
        let speed = entering / sums[inlet][1].max(f64::MIN_POSITIVE);
        self.report.reynolds = speed * 2.0 * self.caps[inlet].radius / parameters.kinematic_viscosity();
        self.report.imbalance = flux.iter().sum::<f64>().abs() / entering;
        self.report.wall_leak = wall / entering;
        self.report.section_flux_drift = drift / entering;
        self.report.pressure_drop = mean(sums[inlet]) - mean(rest);
        self.ends = (0..count)
            .map(|k| FlowEnd { sample: self.caps[k].sample, flux: flux[k], pressure: mean(sums[k]) })
            .collect();
        self.pressure = pressures
            .iter()
            .enumerate()
            .map(|(c, p)| Cell::new(&tables, &self.mesh.control(c)).pressure_at([0.5; 3], p))
            .collect();
    }

    /// The velocity as a VTK XML unstructured grid, exactly as Bézier hexahedra or at the corners of trilinear cells, with the
    /// pressure at the centre of each cell and its branch as cell data.
    ///
    /// # Errors
    /// Only allocation errors.
    pub fn vtu(&self, linear: bool) -> std::io::Result<Vec<u8>> {
        let branches: Vec<f64> = self.parts.iter().map(|&part| f64::from(part)).collect();
        let cells = [("pressure", self.pressure.as_slice()), ("branch", &branches)];
        cubic_vtu(&self.mesh, linear.then_some(LINEAR_PARTS), &[("velocity", &self.velocity, 3)], &cells)
    }

    /// The pressure at the centre of each cell, in Pa.
    pub fn pressure(&self) -> &[f64] {
        &self.pressure
    }
}
