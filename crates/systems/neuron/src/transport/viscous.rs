//! Transport along a viscous flow, on subdivided cells.

use super::discretisation::{Discretisation, EndFace};
use super::error::TransportError;
use super::factor::{cholesky, go_on};
use super::flow::FlowField;
use super::parts::{by_parts, deal, labels_of_parts};
use crate::mesh::{Labelled, LinearShares, concentrations, cubic_vtu, linear_shares};
use crate::{Cap, Flow};
use glam::DVec3;
use pompeiu_core::mesh::UnionFind;
use pompeiu_core::run::{Control, Limits};
use pompeiu_solve::{LinearSolver, SparseMatrix};
use pompeiu_volume::bernstein::value;
use pompeiu_volume::{BezierMesh, FACE_AXES, Faces, InnerFace, bezier_volume, face_flux, face_points};

/// The cells of a flow, subdivided, with the fluxes through their faces.
#[derive(Clone, Debug)]
pub struct FlowCells {
    mesh: BezierMesh,
    faces: Faces,
    pub(super) volumes: Discretisation,
    pub(super) field: FlowField,
    pub(super) caps: Vec<Cap>,
    pub(super) inlet: u32,
    linear: LinearShares,
}

impl FlowCells {
    /// Subdivides each cell of the flow into `parts` along each edge, 1 to 8.
    ///
    /// # Accuracy
    /// Volumes, areas and fluxes are those of the tricubic cells, exact but for rounding. The flow conserves the volume of
    /// subdivided cells only up to what the pressure resolves; the least change of fluxes, weighted by conductances, corrects the
    /// rest.
    /// # Errors
    /// [`TransportError::Parameter`] for invalid `parts`, or if there is no flow through the inlet; [`TransportError::Solve`];
    /// [`TransportError::Stopped`] if a limit on time or cancellation ends it.
    pub fn new(flow: &Flow, parts: usize, limits: &Limits) -> Result<Self, TransportError> {
        let control = Control::start(limits);
        if !(1..=8).contains(&parts) {
            let value = parts as f64;
            return Err(TransportError::Parameter { what: "the number of parts", value, expected: "1 to 8" });
        }
        let (mesh, mut fields) = flow.mesh.subdivided(parts, &[&flow.velocity])?;
        let velocity = fields.pop().unwrap_or_default();
        go_on(&control)?;
        let faces = Faces::new(&mesh.corner_mesh()?)?;
        let labels = labels_of_parts(&flow.faces, &flow.labels, &faces, parts);
        // Subdivided cells stay in the part of their cell.
        let dealt = deal(flow.mesh.cells().len(), parts.pow(3), &flow.faces);
        let dealt: Vec<u32> =
            dealt.into_iter().flat_map(|part| std::iter::repeat_n(part, parts.pow(3))).collect();
        go_on(&control)?;
        let cells: Vec<(f64, DVec3)> = by_parts(dealt.iter().copied(), |cell| {
            let points = mesh.control(cell);
            (bezier_volume(&points), value(&points, [0.5; 3]))
        });
        go_on(&control)?;
        // The centre of a face, its area, and the outflow there.
        let face = |cell: u32, place: u8| {
            let points = mesh.control(cell as usize);
            let (axis, side, _) = FACE_AXES[place as usize];
            let middle = std::array::from_fn(|k| if k == axis { side as f64 } else { 0.5 });
            let area: DVec3 = face_points(&points, place.into()).iter().map(|(_, area)| *area).sum();
            let field = mesh.cells()[cell as usize].map(|v| velocity[v as usize]);
            (value(&points, middle), area, face_flux(&points, &field, place.into()))
        };
        let half = |cell: u32, centre: DVec3, area: DVec3| {
            let d = centre - cells[cell as usize].1;
            area.dot(d).abs().max(1e-3 * area.length() * d.length()) / d.length_squared()
        };
        let part_of = |inner: &InnerFace| dealt[inner.cells[0] as usize];
        let inner: Vec<(([u32; 2], f64), f64)> = by_parts(faces.inner().iter().map(part_of), |k| {
            let inner = &faces.inner()[k];
            let (centre, area, flux) = face(inner.cells[0], inner.places[0]);
            let [a, b] = inner.cells.map(|cell| half(cell, centre, area));
            ((inner.cells, a * b / (a + b)), flux)
        });
        go_on(&control)?;
        let ends: Vec<(EndFace, f64)> = faces
            .boundary()
            .iter()
            .zip(&labels)
            .filter(|(_, label)| **label > 0)
            .map(|(end, label)| {
                let (centre, area, flux) = face(end.cell, end.place);
                let conductance = half(end.cell, centre, area);
                (EndFace { cap: label - 1, cell: end.cell, area: area.length(), conductance }, flux)
            })
            .collect();
        let (links, through): (Vec<_>, Vec<f64>) = inner.into_iter().unzip();
        let (ends, out): (Vec<EndFace>, Vec<f64>) = ends.into_iter().unzip();
        let volumes =
            Discretisation { volumes: cells.iter().map(|c| c.0).collect(), links, ends, parts: dealt };
        let field = balanced(&volumes, through, out, flow.inlet, &control)?;
        let boundary = Labelled { faces: &faces, labels: &labels };
        let linear = linear_shares(&mesh, boundary, 1, Some((&velocity, flow.inlet + 1)));
        Ok(Self { mesh, faces, volumes, field, caps: flow.caps.clone(), inlet: flow.inlet, linear })
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.mesh.cells().len()
    }

    /// The flat ends.
    pub fn caps(&self) -> &[Cap] {
        &self.caps
    }

    /// The cells.
    pub fn mesh(&self) -> &BezierMesh {
        &self.mesh
    }

    /// Their faces.
    pub fn faces(&self) -> &Faces {
        &self.faces
    }

    /// What the trilinear cells of [`vtu`](Self::vtu) keep of the cells.
    pub fn linear(&self) -> LinearShares {
        self.linear
    }

    /// Concentrations of each cell as a VTK XML unstructured grid: `total`, `free`, `plus` and `minus`, as Bézier hexahedra or as
    /// trilinear cells.
    ///
    /// # Errors
    /// [`std::io::ErrorKind::InvalidInput`] unless there are concentrations for each cell.
    pub fn vtu(&self, values: &[[f64; 3]], linear: bool) -> std::io::Result<Vec<u8>> {
        let columns = concentrations(values);
        let cells = columns.each_ref().map(|(name, column)| (*name, column.as_slice()));
        cubic_vtu(&self.mesh, linear.then_some(1), &[], &cells)
    }
}

/// Fluxes that balance in every cell, with a mean speed of one at the inlet: fluxes at the ends are kept, and differences of a
/// potential are added between cells.
fn balanced(
    mesh: &Discretisation,
    mut through: Vec<f64>,
    mut out: Vec<f64>,
    inlet: u32,
    control: &Control,
) -> Result<FlowField, TransportError> {
    let at_inlet = mesh.ends.iter().zip(&out).filter(|(end, _)| end.cap == inlet);
    let (area, entering) = at_inlet.fold((0.0, 0.0), |(a, q), (end, out)| (a + end.area, q - out));
    if entering == 0.0 || !entering.is_finite() {
        return Err(TransportError::Parameter {
            what: "what flows in at the inlet",
            value: entering,
            expected: "not 0",
        });
    }
    let factor = area / entering;
    through.iter_mut().chain(&mut out).for_each(|q| *q *= factor);
    let n = mesh.volumes.len();
    let net = |through: &[f64]| {
        let mut net = vec![0.0; n];
        for (&([a, b], _), q) in mesh.links.iter().zip(through) {
            net[a as usize] += q;
            net[b as usize] -= q;
        }
        for (end, q) in mesh.ends.iter().zip(&out) {
            net[end.cell as usize] += q;
        }
        net
    };
    let mut entries = Vec::with_capacity(4 * mesh.links.len() + 1);
    for &([a, b], c) in &mesh.links {
        let (a, b) = (a as usize, b as usize);
        entries.extend([(a, a, c), (b, b, c), (a, b, -c), (b, a, -c)]);
    }
    // In each connected component, one cell fixes the potential.
    let mut joined = UnionFind::new(n);
    for &([a, b], _) in &mesh.links {
        joined.union(a as usize, b as usize);
    }
    entries.extend((0..n).filter(|&k| joined.find(k) == k).map(|k| (k, k, 1.0)));
    let (solver, _) = cholesky(SparseMatrix::from_triplets(n, n, &entries)?, control)?;
    // The second pass removes the rounding errors of the first.
    for _ in 0..2 {
        let mut potential: Vec<f64> = net(&through).iter().map(|x| -x).collect();
        solver.solve_in_place(&mut potential)?;
        for (&([a, b], c), q) in mesh.links.iter().zip(&mut through) {
            *q += c * (potential[a as usize] - potential[b as usize]);
        }
    }
    let imbalance = net(&through).iter().fold(0.0, |most: f64, x| most.max(x.abs())) / area;
    Ok(FlowField { through, out, imbalance })
}
