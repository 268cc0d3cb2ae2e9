//! Viscous diffusion of velocities at midpoints of edges (Crouzeix and Raviart).

use crate::curvature::{CurvatureLimit, allowed_growth, bends, face_curvature};
use crate::space::Space;
use crate::viscosity::shortened;
use crate::{FluidError, ViscosityModel, Wall};
use pompeiu_core::mesh::FaceData;
use pompeiu_operators::FaceField;
use pompeiu_solve::{Cholesky, LinearSolver, SemidefiniteCholesky, SolveError, SparseMatrix};
use pompeiu_surface::plane::{Vec2, add, dot, inverse, norm, rotate, scale, sub};
use pompeiu_surface::{EdgeData, EdgeId, HalfedgeId, SurfaceMesh};

/// A velocity at the midpoint of each edge: its components along the first half-edge and to the left of it.
pub(crate) type EdgeField = EdgeData<Vec2>;

/// A backward Euler step for viscosity, factored for one product of viscosity and time, with the subsequent projection.
///
/// # Definition
/// A velocity is linear on each face and continuous at midpoints of edges, after unfolding. B is the matrix of `∫ |∇u|²` (the
/// Bochner connection Laplacian), K that of the Gaussian curvature on faces, M the areas of edges. One step solves `(M + νΔt (B +
/// (1 − χ) K)) u' = M u`, with χ = 0, 1, 2 for the Hodge, Bochner and physical viscosity. At a no-slip boundary `u'` is the
/// velocity of the wall. At a free-slip boundary the normal component is zero, and the geodesic curvature is subtracted from the
/// matrix for the tangential component. What would let velocities grow is limited, see [`CurvatureLimit`]. Then the gradient of a piecewise constant pressure is subtracted, so that inflow and
/// outflow balance in each face.
///
/// # Accuracy
/// Second order in the edge length, first order in the step.
#[derive(Debug)]
pub(crate) struct EdgeViscosity {
    product: f64,
    /// How often the step is taken that is factored.
    repeats: usize,
    factor: Cholesky,
    /// The unknown of each component at each edge; `None` if it is prescribed.
    unknown: Vec<[Option<usize>; 2]>,
    /// Contribution of the prescribed components to the right-hand side.
    drive: Vec<f64>,
    given: EdgeField,
    mass: EdgeData<f64>,
    pressure: SemidefiniteCholesky,
}

impl EdgeViscosity {
    pub(crate) fn new(
        space: &Space<'_>,
        terms: Terms,
        wall_velocity: Option<&EdgeData<f64>>,
        product: f64,
        pressure: Option<SemidefiniteCholesky>,
    ) -> Result<Self, FluidError> {
        let mesh = space.mesh();
        let given = EdgeField::from_fn(mesh.edges(), |edge| {
            if !mesh.is_boundary_edge(edge) {
                return [0.0; 2];
            }
            let through = space.inflow.as_ref().map_or(0.0, |inflow| inflow.through_edges()[edge]);
            // The surface lies to the left of its boundary.
            [wall_velocity.map_or(0.0, |velocity| velocity[edge]), through / space.surface.edge_length(edge)]
        });
        let (unknown, count) = unknowns(space, terms.wall);
        let mass = space.surface.edge_areas();
        let factored = |product: f64| {
            let mut entries = terms.entries(space, product);
            for (edge, &area) in mass.entries() {
                entries.extend((0..2).map(|i| (2 * edge.index() + i, 2 * edge.index() + i, area)));
            }
            let mut drive = vec![0.0; count];
            let mut kept = Vec::with_capacity(entries.len());
            for (row, column, value) in entries {
                let Some(i) = unknown[row / 2][row % 2] else { continue };
                match unknown[column / 2][column % 2] {
                    Some(j) => kept.push((i, j, value)),
                    None => drive[i] -= value * given.as_slice()[column / 2][column % 2],
                }
            }
            match Cholesky::new(&SparseMatrix::from_triplets(count, count, &kept)?) {
                Ok(factor) => Ok((factor, drive)),
                Err(SolveError::NotPositiveDefinite { .. }) => Err(FluidError::Viscous { product }),
                Err(other) => Err(other.into()),
            }
        };
        let ((factor, drive), repeats) = shortened(product, factored)?;
        let pressure = match pressure {
            Some(pressure) => pressure,
            None => pressure_system(space, &mass)?,
        };
        Ok(Self { product, repeats, factor, unknown, drive, given, mass, pressure })
    }

    /// The pressure system, which does not depend on the step.
    pub(crate) fn into_pressure(self) -> SemidefiniteCholesky {
        self.pressure
    }

    /// Viscosity times time.
    pub(crate) fn product(&self) -> f64 {
        self.product
    }

    /// The velocity after the step.
    pub(crate) fn step(&self, space: &Space<'_>, before: &EdgeField) -> Result<EdgeField, FluidError> {
        let mut after = self.once(space, before)?;
        for _ in 1..self.repeats {
            after = self.once(space, &after)?;
        }
        Ok(after)
    }

    fn once(&self, space: &Space<'_>, before: &EdgeField) -> Result<EdgeField, FluidError> {
        let mut values = self.drive.clone();
        for ((unknown, u), area) in self.unknown.iter().zip(before).zip(&self.mass) {
            for (i, u) in unknown.iter().zip(u).filter_map(|(i, u)| Some((i.as_ref()?, u))) {
                values[*i] += area * u;
            }
        }
        self.factor.solve_in_place(&mut values)?;
        let mut after = self.given.clone();
        for (u, unknown) in after.iter_mut().zip(&self.unknown) {
            for (u, i) in u.iter_mut().zip(unknown).filter_map(|(u, i)| Some((u, i.as_ref()?))) {
                *u = values[*i];
            }
        }
        self.project(space, &mut after)?;
        Ok(after)
    }

    /// Subtracts the gradient of a pressure, so that inflow and outflow balance in each face.
    ///
    /// The tangential component of that gradient at an edge is that of the lowest-order Raviart–Thomas fields on the adjacent
    /// faces.
    fn project(&self, space: &Space<'_>, field: &mut EdgeField) -> Result<(), FluidError> {
        let mesh = space.mesh();
        let mut pressure: Vec<f64> =
            mesh.face_ids().map(|face| outflows(space, face, field).iter().sum()).collect();
        self.pressure.solve_in_place(&mut pressure)?;
        let change = EdgeField::from_fn(mesh.edges(), |edge| {
            let h = mesh.edge_halfedge(edge);
            let across = mesh.twin(h).map_or(0.0, |twin| {
                let difference = pressure[h.face().index()] - pressure[twin.face().index()];
                space.surface.edge_length(edge) / self.mass[edge] * difference
            });
            [0.0, across]
        });
        for edge in mesh.edge_ids() {
            field[edge][1] += change[edge][1];
            if self.unknown[edge.index()][0].is_some() {
                field[edge][0] += along_edge(space, edge, &change);
            }
        }
        Ok(())
    }
}

/// What the viscous power of velocities at midpoints of edges consists of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Terms {
    model: ViscosityModel,
    wall: Wall,
    limit: CurvatureLimit,
}

impl Terms {
    /// Those with as much curvature as the surface allows.
    pub(crate) fn new(space: &Space<'_>, model: ViscosityModel, wall: Wall) -> Result<Self, FluidError> {
        let (mesh, mass) = (space.mesh(), space.surface.edge_areas());
        let (unknown, count) = unknowns(space, wall);
        let at: Vec<EdgeId> = mesh
            .edge_ids()
            .flat_map(|edge| unknown[edge.index()].iter().flatten().map(move |_| edge))
            .collect();
        let energy = SparseMatrix::diagonal(&at.iter().map(|&edge| mass[edge]).collect::<Vec<_>>())?;
        let component = |i: usize| mesh.component(mesh.ends(at[i])[0]);
        let allowed = allowed_growth(space, &energy, component)?;
        let is_semidefinite = |terms: &Self| {
            let kept = terms.entries(space, 1.0).into_iter().filter_map(|(row, column, value)| {
                Some((unknown[row / 2][row % 2]?, unknown[column / 2][column % 2]?, value))
            });
            let power = SparseMatrix::from_triplets(count, count, &kept.collect::<Vec<_>>())?;
            Ok(Cholesky::new(&allowed.combined(1.0, &power, 1.0)?).map(|_| ())?)
        };
        let (_, terms) = CurvatureLimit::find(|limit| Ok(Self { model, wall, limit }), is_semidefinite)?;
        Ok(terms)
    }

    /// The curvature that they contain.
    pub(crate) fn limit(self) -> CurvatureLimit {
        self.limit
    }

    /// The entries of their matrix times a factor, two rows for each edge.
    fn entries(self, space: &Space<'_>, factor: f64) -> Vec<(usize, usize, f64)> {
        let mut entries = energy(space, 1.0 - self.model.curvatures(), factor, self.limit);
        if self.wall == Wall::FreeSlip {
            let bend = slip(space);
            entries.extend(
                bend.entries()
                    .map(|(edge, k)| (2 * edge.index(), 2 * edge.index(), factor * self.limit.of_wall(-k))),
            );
        }
        entries
    }
}

/// The number of the unknown of each component at each edge, and how many there are.
fn unknowns(space: &Space<'_>, wall: Wall) -> (Vec<[Option<usize>; 2]>, usize) {
    let mesh = space.mesh();
    let mut count = 0;
    let mut number = |free: bool| {
        count += usize::from(free);
        free.then(|| count - 1)
    };
    let unknown = mesh
        .edge_ids()
        .map(|edge| {
            let inside = !mesh.is_boundary_edge(edge);
            [number(inside || wall == Wall::FreeSlip), number(inside)]
        })
        .collect();
    (unknown, count)
}

/// The tangential component at the midpoint of an edge of the Raviart–Thomas fields on the adjacent faces; their mean, weighted by
/// area.
fn along_edge(space: &Space<'_>, edge: EdgeId, field: &EdgeField) -> f64 {
    let (mesh, surface) = (space.mesh(), space.surface);
    let h = mesh.edge_halfedge(edge);
    let (mut sum, mut area) = (0.0, 0.0);
    for h in [Some(h), mesh.twin(h)].into_iter().flatten() {
        let corners = surface.corners(h.face());
        let middle = scale(0.5, add(corners[h.corner()], corners[(h.corner() + 1) % 3]));
        let flows = outflows(space, h.face(), field);
        // The basis field of a side is its flow times the vector from the opposite corner, over twice the area.
        let mut twice = [0.0; 2];
        for (i, flow) in flows.into_iter().enumerate() {
            twice = add(twice, scale(flow, sub(middle, corners[(i + 2) % 3])));
        }
        sum += 0.5 * dot(along(space, h), twice);
        area += surface.face_area(h.face());
    }
    sum / area
}

/// The outflow of a face through each of its sides.
fn outflows(space: &Space<'_>, face: pompeiu_core::FaceId, field: &EdgeField) -> [f64; 3] {
    let mesh = space.mesh();
    SurfaceMesh::face_halfedges(face).map(|h| {
        let edge = mesh.edge(h);
        // A face lies to the left of its half-edges.
        let left = space.surface.edge_length(edge) * field[edge][1];
        if mesh.is_along(h) { -left } else { left }
    })
}

/// The field, constant on faces, with the same flow across each edge.
pub(crate) fn on_faces(space: &Space<'_>, field: &EdgeField) -> FaceField {
    FaceField::from_fn(space.mesh().faces(), |face| {
        let [first, second, _] = outflows(space, face, field);
        // The flow across a side is the stream function at its start minus that at its end.
        space.rotated_gradient(face, [0.0, -first, -first - second])
    })
}

/// Means of a field over the faces adjacent to each edge, weighted by area.
pub(crate) fn at_edges(space: &Space<'_>, field: &FaceField) -> EdgeField {
    let mesh = space.mesh();
    EdgeField::from_fn(mesh.edges(), |edge| {
        let h = mesh.edge_halfedge(edge);
        let (mut sum, mut area) = ([0.0; 2], 0.0);
        for h in [Some(h), mesh.twin(h)].into_iter().flatten() {
            let weight = space.surface.face_area(h.face());
            sum = add(sum, scale(weight, rotate(inverse(along(space, h)), field[h.face()])));
            area += weight;
        }
        scale(1.0 / area, sum)
    })
}

/// The direction of the edge of a half-edge, in the frame of its face.
fn along(space: &Space<'_>, h: HalfedgeId) -> Vec2 {
    let side = space.surface.vector(h);
    let sign = if space.mesh().is_along(h) { 1.0 } else { -1.0 };
    scale(sign / norm(side), side)
}

/// Entries of `factor (B + curvatures K)`.
fn energy(
    space: &Space<'_>,
    curvatures: f64,
    factor: f64,
    limit: CurvatureLimit,
) -> Vec<(usize, usize, f64)> {
    let (mesh, surface) = (space.mesh(), space.surface);
    let curvature: FaceData<f64> = face_curvature(surface, &space.areas, limit);
    let mut entries = Vec::with_capacity(36 * mesh.faces());
    for face in mesh.face_ids() {
        let sides = SurfaceMesh::face_halfedges(face);
        let area = surface.face_area(face);
        let directions = sides.map(|h| along(space, h));
        for (i, h) in sides.into_iter().enumerate() {
            for (j, g) in sides.into_iter().enumerate() {
                // Gradients of the functions of two midpoints: J s / A each.
                let weight = factor * dot(surface.vector(h), surface.vector(g)) / area;
                let [cosine, sine] = rotate(inverse(directions[i]), directions[j]);
                let (row, column) = (2 * mesh.edge(h).index(), 2 * mesh.edge(g).index());
                entries.push((row, column, weight * cosine));
                entries.push((row, column + 1, -weight * sine));
                entries.push((row + 1, column, weight * sine));
                entries.push((row + 1, column + 1, weight * cosine));
            }
            let share = factor * curvatures * area * curvature[face] / 3.0;
            entries
                .extend((0..2).map(|k| (2 * mesh.edge(h).index() + k, 2 * mesh.edge(h).index() + k, share)));
        }
    }
    entries
}

/// Turning angle of the boundary at a vertex, in radians, above which it is a corner and not curvature.
const CORNER: f64 = 0.6;

/// The geodesic curvature of each boundary edge times its length; zero inside.
fn slip(space: &Space<'_>) -> EdgeData<f64> {
    let mesh = space.mesh();
    let (bend, lengths) = bends(space);
    EdgeData::from_fn(mesh.edges(), |edge| {
        if !mesh.is_boundary_edge(edge) {
            return 0.0;
        }
        let half = 0.5 * space.surface.edge_length(edge);
        let smooth = mesh.ends(edge).into_iter().filter(|&v| bend[v].abs() <= CORNER);
        smooth.map(|v| half * bend[v] / lengths[v]).sum()
    })
}

/// The matrix of pressures on faces, whose kernel consists of the constants on each component.
fn pressure_system(space: &Space<'_>, mass: &EdgeData<f64>) -> Result<SemidefiniteCholesky, FluidError> {
    let mesh = space.mesh();
    let links: Vec<(u32, u32, f64)> = mesh
        .edge_ids()
        .filter_map(|edge| {
            let h = mesh.edge_halfedge(edge);
            let weight = space.surface.edge_length(edge).powi(2) / mass[edge];
            Some((h.face().0, mesh.twin(h)?.face().0, weight))
        })
        .collect();
    let matrix = SparseMatrix::from_links(mesh.faces(), &links)?;
    let component = |face| Some(mesh.component(mesh.face(face)[0]) as u32);
    let group: Vec<Option<u32>> = mesh.face_ids().map(component).collect();
    Ok(SemidefiniteCholesky::new(matrix, &vec![false; mesh.faces()], &group)?)
}
