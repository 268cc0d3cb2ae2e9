//! Volumes, areas and conductances of cells and faces.

use super::parts::{by_parts, deal};
use glam::DVec3;
use pompeiu_volume::{Faces, HexMesh, volume};

/// A finite-volume discretisation of a mesh.
#[derive(Clone, Debug)]
pub struct Discretisation {
    /// The volume of each cell.
    pub volumes: Vec<f64>,
    /// For each inner face its two cells, and the flux from the first to the second for a unit difference of potential and unit
    /// conductivity.
    pub links: Vec<([u32; 2], f64)>,
    /// For each face on a flat end: the cap, the cell, the area, and the conductance from the cell's centre to the face.
    pub ends: Vec<EndFace>,
    /// The part of each cell, for parallel work. No result depends on it.
    pub parts: Vec<u32>,
}

/// A face on a flat end.
#[derive(Clone, Copy, Debug)]
pub struct EndFace {
    /// The cap, from 0.
    pub cap: u32,
    /// The cell.
    pub cell: u32,
    /// Its area.
    pub area: f64,
    /// Conductance from the cell's centre to the face.
    pub conductance: f64,
}

impl Discretisation {
    /// Two-point fluxes: half conductances `A·d / |d|²` from the centre of a cell to that of a face, in series.
    ///
    /// # Limits
    /// Exact for fluxes along lines orthogonal to faces, as in a straight tube. Where faces are oblique, around nodes, the error is
    /// some percent whatever the cell size; the scheme is conservative and monotone in any case.
    pub fn new(mesh: &HexMesh, faces: &Faces, labels: &[u32]) -> Self {
        Self::dealt(mesh, faces, labels, deal(mesh.cells().len(), 1, faces))
    }

    /// The same, with given parts.
    pub(super) fn dealt(mesh: &HexMesh, faces: &Faces, labels: &[u32], parts: Vec<u32>) -> Self {
        let cells = mesh.cells();
        let measured = by_parts(parts.iter().copied(), |c| {
            let corners = mesh.corners(cells[c]);
            (corners.iter().sum::<DVec3>() / 8.0, volume(&corners))
        });
        let (centres, volumes): (Vec<DVec3>, Vec<f64>) = measured.into_iter().unzip();
        let quad = |vertices: [u32; 4]| {
            let [a, b, c, d] = vertices.map(|v| mesh.positions()[v as usize]);
            ((a + b + c + d) / 4.0, 0.5 * (c - a).cross(d - b))
        };
        let half = |cell: u32, centre: DVec3, area: DVec3| {
            let d = centre - centres[cell as usize];
            // Conductances are nonnegative even if faces are oblique.
            let along = area.dot(d).abs().max(1e-3 * area.length() * d.length());
            along / d.length_squared()
        };
        let links = by_parts(faces.inner().iter().map(|face| parts[face.cells[0] as usize]), |k| {
            let face = &faces.inner()[k];
            let (centre, area) = quad(face.vertices);
            let [a, b] = face.cells.map(|cell| half(cell, centre, area));
            (face.cells, a * b / (a + b))
        });
        let ends = faces
            .boundary()
            .iter()
            .zip(labels)
            .filter(|(_, label)| **label > 0)
            .map(|(face, label)| {
                let (centre, area) = quad(face.vertices);
                EndFace {
                    cap: label - 1,
                    cell: face.cell,
                    area: area.length(),
                    conductance: half(face.cell, centre, area),
                }
            })
            .collect();
        Self { volumes, links, ends, parts }
    }
}
