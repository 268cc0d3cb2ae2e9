//! Geodesic distances by the heat method.

use crate::error::name_thin_faces;
use crate::gradient::{divergence, face_gradient};
use crate::laplacian::cotan_laplacian;
use crate::{FaceField, OperatorError};
use pompeiu_core::mesh::VertexData;
use pompeiu_core::{FaceId, VertexId};
use pompeiu_solve::{Cholesky, LinearSolver, SemidefiniteCholesky, SparseMatrix};
use pompeiu_surface::plane::{Vec2, norm};
use pompeiu_surface::{Surface, intrinsic_delaunay};
use std::borrow::Cow;

/// How distances are computed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HeatOptions {
    /// How long heat spreads, in squared length; by default the square of the mean length of edges.
    pub time: Option<f64>,
    /// Whether to compute on the intrinsic Delaunay triangulation of the same vertices, which gives better distances where faces
    /// are obtuse. Distances are still those of the surface.
    pub intrinsic_delaunay: bool,
}

/// A surface prepared for distances from any set of vertices: the heat method.
///
/// # Definition
/// Heat spreads from the sources for a short time t, `(M + t L) u = δ`; its gradient points along shortest paths, so the
/// distance is the function whose gradient is nearest to `−∇u / |∇u|`, zero on average at the sources. The boundary has
/// Neumann conditions. M is lumped, L the cotangent Laplacian; nothing is added to either.
///
/// Heat decays exponentially. Where it would underflow it is continued: the heat of all vertices reached so far becomes a boundary
/// condition, and the heat of the others is computed from it at a scale larger by a power of two, with one more solve with the same
/// factor.
///
/// First order in the edge length; in practice about one percent of the distance on evenly triangulated surfaces. Neither an upper
/// nor a lower bound. Where edges are not Delaunay the Laplacian has no maximum principle, and distances are less accurate;
/// [`HeatOptions::intrinsic_delaunay`] helps.
///
/// # Cost
/// Two sparse factorizations to prepare, two solves per query, and one more for every 670 edges or so of distance.
///
/// # Source
/// `crane_geodesics_2013`; the continuation of heat is ours.
///
/// # Example
/// ```
/// use pompeiu_core::VertexId;
/// use pompeiu_core::mesh::shapes::icosphere;
/// use pompeiu_operators::{HeatMethod, HeatOptions};
/// use pompeiu_surface::EmbeddedSurface;
///
/// let sphere = EmbeddedSurface::new(&icosphere(1.0, 4)?)?;
/// let heat = HeatMethod::new(sphere.surface(), &HeatOptions::default())?;
/// let distances = heat.distances(&[VertexId(0)])?;
/// let farthest = distances.iter().fold(0.0, |m: f64, &d| m.max(d));
/// assert!((farthest - std::f64::consts::PI).abs() < 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct HeatMethod<'s> {
    surface: Cow<'s, Surface>,
    time: f64,
    heat: Cholesky,
    poisson: SemidefiniteCholesky,
}

/// 2^-930: heat below this share of that at the sources is continued at a larger scale. The threshold is so small that few surfaces
/// need it, and so large that heat one edge farther is still a normal number.
const FAINT: f64 = f64::from_bits((1023 - 930) << 52);

impl<'s> HeatMethod<'s> {
    /// Prepares a surface.
    ///
    /// # Errors
    /// [`OperatorError::HeatTime`]; [`OperatorError::ThinFaces`] if a matrix cannot be factored because of thin faces;
    /// [`OperatorError::Geometry`] if a face of the intrinsic Delaunay triangulation is degenerate;
    /// [`OperatorError::Solve`].
    pub fn new(surface: &'s Surface, options: &HeatOptions) -> Result<Self, OperatorError> {
        let surface = if options.intrinsic_delaunay {
            Cow::Owned(intrinsic_delaunay(surface)?.surface)
        } else {
            Cow::Borrowed(surface)
        };
        let time = options.time.unwrap_or_else(|| {
            let lengths = surface.edge_lengths();
            let mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
            mean * mean
        });
        if !(time > 0.0 && time.is_finite()) {
            return Err(OperatorError::HeatTime { time });
        }
        let laplacian = cotan_laplacian(&surface)?;
        let mass = SparseMatrix::diagonal(&surface.vertex_areas())?;
        let named = |error| name_thin_faces(&surface, error);
        let heat = Cholesky::new(&mass.combined(1.0, &laplacian, time)?).map_err(named)?;
        let mesh = surface.mesh();
        let group: Vec<Option<u32>> = mesh.vertex_ids().map(|v| Some(mesh.component(v) as u32)).collect();
        let poisson =
            SemidefiniteCholesky::new(laplacian, &vec![false; mesh.vertices()], &group).map_err(named)?;
        Ok(Self { surface, time, heat, poisson })
    }

    /// The distance of every vertex from the nearest source; infinite on components without one.
    ///
    /// # Errors
    /// [`OperatorError::NoSuchVertex`]; [`OperatorError::HeatUnderflow`]; [`OperatorError::Solve`] when values leave the
    /// range of doubles.
    pub fn distances(&self, sources: &[VertexId]) -> Result<VertexData<f64>, OperatorError> {
        let mesh = self.surface.mesh();
        let vertices = mesh.vertices();
        if let Some(&vertex) = sources.iter().find(|v| v.index() >= vertices) {
            return Err(OperatorError::NoSuchVertex { vertex, vertices });
        }
        let field = self.descent(sources, FAINT)?;
        // G_vᵀ M u is minus the divergence.
        let mut distances = divergence(&self.surface, &field)?;
        for value in &mut distances {
            *value = -*value;
        }
        self.poisson.solve_in_place(&mut distances)?;
        let mut sums = vec![(0.0, 0.0); mesh.components()];
        for &source in sources {
            let (sum, count) = &mut sums[mesh.component(source)];
            *sum += distances[source];
            *count += 1.0;
        }
        for (v, distance) in mesh.vertex_ids().zip(&mut distances) {
            let (sum, count) = sums[mesh.component(v)];
            *distance = if count > 0.0 { *distance - sum / count } else { f64::INFINITY };
        }
        Ok(distances)
    }

    /// `−∇u / |∇u|` on each face, zero on components without sources; `faint` is a power of two.
    fn descent(&self, sources: &[VertexId], faint: f64) -> Result<FaceField, OperatorError> {
        let mesh = self.surface.mesh();
        let mut warm = vec![false; mesh.components()];
        let mut heat = VertexData::filled(mesh.vertices(), 0.0);
        for &source in sources {
            warm[mesh.component(source)] = true;
            // Entries of the matrix have the size of the time, so scaling by it makes the heat at the sources about one.
            heat[source] = f64::from_bits(self.time.to_bits() & EXPONENT);
        }
        let mut field = FaceField::filled(mesh.faces(), [0.0; 2]);
        let mut open: Vec<FaceId> =
            mesh.face_ids().filter(|&face| warm[mesh.component(mesh.face(face)[0])]).collect();
        let mut reached = VertexData::filled(mesh.vertices(), false);
        let mut inflow = VertexData::filled(mesh.vertices(), 0.0);
        while !open.is_empty() {
            self.heat.solve_in_place(&mut heat)?;
            let is_new = VertexData::from_fn(mesh.vertices(), |v| !reached[v] && heat[v].abs() >= faint);
            if !is_new.contains(&true) {
                let cold = |v: &VertexId| warm[mesh.component(*v)] && !reached[*v];
                let vertex = mesh.vertex_ids().find(cold).unwrap_or(VertexId(0));
                return Err(OperatorError::HeatUnderflow {
                    vertex,
                    count: mesh.vertex_ids().filter(cold).count(),
                });
            }
            // Faces with a vertex reached earlier have their direction already.
            open.retain(|&face| {
                let known = mesh.face(face).into_iter().any(|v| is_new[v]);
                if known {
                    field[face] = downhill(face_gradient(&self.surface, face, &heat));
                }
                !known
            });
            if !open.is_empty() {
                self.pass_on(&mut heat, &mut inflow, &mut reached, &is_new, 1.0 / faint);
            }
        }
        Ok(field)
    }

    /// Makes the heat of newly reached vertices a boundary condition, and replaces the right-hand side by their effect on the
    /// others.
    ///
    /// With A the matrix of the system, `A v = r`, and w the part of v at newly reached vertices, `v − w` solves `A (v − w) = r − A
    /// w`. This right-hand side is zero except at both ends of edges between reached vertices and others. Only the off-diagonal
    /// entries of A are needed; they are those of `t L`.
    fn pass_on(
        &self,
        heat: &mut VertexData<f64>,
        inflow: &mut VertexData<f64>,
        reached: &mut VertexData<bool>,
        is_new: &VertexData<bool>,
        larger: f64,
    ) {
        let mesh = self.surface.mesh();
        for v in mesh.vertex_ids() {
            reached[v] |= is_new[v];
        }
        let next = VertexData::from_fn(mesh.vertices(), |v: VertexId| {
            let others = self.poisson.matrix().column(v.index());
            let others =
                others.map(|(w, entry)| (VertexId(w as u32), self.time * entry)).filter(|other| other.0 != v);
            if reached[v] {
                others.filter(|&(w, _)| !reached[w]).map(|(w, entry)| entry * (larger * heat[w])).sum()
            } else {
                let given: f64 =
                    others.filter(|&(w, _)| is_new[w]).map(|(w, entry)| entry * (larger * heat[w])).sum();
                larger * inflow[v] - given
            }
        });
        inflow.copy_from_slice(&next);
        heat.copy_from_slice(&next);
    }
}

/// The exponent bits of a double.
const EXPONENT: u64 = 0x7ff << 52;

/// The unit vector opposite to a gradient; zero for zero.
fn downhill(gradient: Vec2) -> Vec2 {
    let largest = if gradient[0].abs() > gradient[1].abs() { gradient[0].abs() } else { gradient[1].abs() };
    if largest > 0.0 {
        // Scaled first: squares of faint heat would underflow.
        let scaled = gradient.map(|x| x / largest);
        let length = norm(scaled);
        scaled.map(|x| -x / length)
    } else {
        gradient
    }
}
