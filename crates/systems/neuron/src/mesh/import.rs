//! Imported hexahedral meshes.

use super::build::{Cap, NeuronMesh, mean};
use super::cubic::CubicMesh;
use super::options::{MeshError, MeshReport};
use super::proof::CellProof;
use glam::DVec3;
use pompeiu_core::run::{Control, Limits};
use pompeiu_volume::{BezierMesh, Faces, HexMesh};
use std::collections::VecDeque;

/// A side of the bounding box of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// 0, 1 and 2 for x, y and z.
    pub axis: usize,
    /// Whether it is the side of the greatest coordinate.
    pub is_upper: bool,
}

impl Side {
    /// `-x`, `+x`, `-y`, `+y`, `-z` or `+z`.
    pub fn from_name(name: &str) -> Option<Self> {
        let (is_upper, axis) = match name.as_bytes() {
            [b'-', axis] => (false, axis),
            [b'+', axis] => (true, axis),
            _ => return None,
        };
        let axis = b"xyz".iter().position(|name| name == axis)?;
        Some(Self { axis, is_upper })
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        ["-x", "+x", "-y", "+y", "-z", "+z"][2 * self.axis + usize::from(self.is_upper)]
    }

    /// The number of its cap if a mesh has no samples: 1 to 6, in the order of names.
    pub fn number(self) -> i64 {
        [1, 3, 5][self.axis] + i64::from(self.is_upper)
    }
}

/// The ends of an imported mesh, where material and fluid enter and leave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ends<'e> {
    /// Nowhere.
    None,
    /// The faces that lie flat on sides of the bounding box; the first side is the inlet.
    Sides(&'e [Side]),
    /// By labels of vertices, as in `NeuronTransportIGA`: at most 0 on the wall and inside, 1 at the inlet, 2 and more at other
    /// ends.
    Labels(&'e [f64]),
}

/// Largest distance of a face from a side of the bounding box, relative to its diagonal.
const FLATNESS: f64 = 1e-6;

/// Smallest cosine of the angle between the normal of an end and those of its faces at the rim.
const ALIGNED: f64 = 0.7;

/// The boundary faces of each end, and the caps.
fn ends(mesh: &HexMesh, faces: &Faces, ends: Ends<'_>) -> Result<(Vec<u32>, Vec<Cap>), MeshError> {
    let numbers: Vec<i64> = match ends {
        Ends::None => vec![0; faces.boundary().len()],
        Ends::Sides(sides) => at_sides(mesh, faces, sides)?,
        Ends::Labels(labels) => at_labels(mesh, faces, labels)?,
    };
    let mut order: Vec<i64> = match ends {
        Ends::Sides(sides) => sides.iter().map(|side| side.number()).collect(),
        _ => numbers.iter().copied().filter(|number| *number > 0).collect(),
    };
    if !matches!(ends, Ends::Sides(_)) {
        order.sort_unstable();
    }
    order.dedup();
    let labels: Vec<u32> = numbers
        .iter()
        .map(|number| order.iter().position(|other| other == number).map_or(0, |k| k as u32 + 1))
        .collect();
    let caps = order.iter().enumerate().map(|(k, &sample)| {
        let mut sums = (DVec3::ZERO, DVec3::ZERO, 0.0);
        for (face, _) in faces.boundary().iter().zip(&labels).filter(|(_, label)| **label == k as u32 + 1) {
            let (centre, area) = quad(mesh, face.vertices);
            let size = area.length();
            sums = (sums.0 + centre * size, sums.1 + area, sums.2 + size);
        }
        Cap {
            sample,
            is_root: k == 0,
            centre: sums.0 / sums.2,
            normal: sums.1.normalize_or_zero(),
            radius: (sums.2 / std::f64::consts::PI).sqrt(),
        }
    });
    let caps = caps.collect();
    Ok((labels, caps))
}

/// The centre and the outward area vector of a face.
fn quad(mesh: &HexMesh, vertices: [u32; 4]) -> (DVec3, DVec3) {
    let [a, b, c, d] = vertices.map(|v| mesh.positions()[v as usize]);
    ((a + b + c + d) / 4.0, 0.5 * (c - a).cross(d - b))
}

fn at_sides(mesh: &HexMesh, faces: &Faces, sides: &[Side]) -> Result<Vec<i64>, MeshError> {
    let corners = || faces.boundary().iter().flat_map(|face| face.vertices);
    let place = |v: u32| mesh.positions()[v as usize];
    let low = corners().fold(DVec3::INFINITY, |low, v| low.min(place(v)));
    let high = corners().fold(DVec3::NEG_INFINITY, |high, v| high.max(place(v)));
    let flat = FLATNESS * (high - low).length();
    let mut numbers = vec![0; faces.boundary().len()];
    for (k, side) in sides.iter().enumerate() {
        if sides[..k].contains(side) {
            return Err(MeshError::Side { side: side.name(), problem: "it is named twice" });
        }
        let end = if side.is_upper { high } else { low }[side.axis];
        let mut is_found = false;
        for (face, number) in faces.boundary().iter().zip(&mut numbers) {
            if face.vertices.iter().all(|&v| (place(v)[side.axis] - end).abs() <= flat) {
                (*number, is_found) = (side.number(), true);
            }
        }
        if !is_found {
            let problem = "no face of the mesh lies flat on it";
            return Err(MeshError::Side { side: side.name(), problem });
        }
    }
    Ok(numbers)
}

/// Vertices at the rim of an end may have its label or that of the wall; the normal decides for faces with both.
fn at_labels(mesh: &HexMesh, faces: &Faces, labels: &[f64]) -> Result<Vec<i64>, MeshError> {
    if labels.len() != mesh.positions().len() {
        let (found, vertices) = (labels.len(), mesh.positions().len());
        return Err(MeshError::Labels { found, vertices });
    }
    let of = |v: u32| labels[v as usize].round().max(0.0) as i64;
    let mut normals: std::collections::BTreeMap<i64, DVec3> = std::collections::BTreeMap::new();
    let counted: Vec<(i64, usize)> = faces
        .boundary()
        .iter()
        .map(|face| {
            let numbers = face.vertices.map(of);
            let number = numbers.into_iter().max().unwrap_or(0);
            (number, numbers.iter().filter(|n| **n == number).count())
        })
        .collect();
    for (face, &(number, count)) in faces.boundary().iter().zip(&counted) {
        if number > 0 && count >= 3 {
            *normals.entry(number).or_default() += quad(mesh, face.vertices).1;
        }
    }
    let decide = |(face, &(number, count)): (&pompeiu_volume::BoundaryFace, &(i64, usize))| {
        let normal = normals.get(&number).copied().unwrap_or_default().normalize_or_zero();
        let aligned = quad(mesh, face.vertices).1.normalize_or_zero().dot(normal) >= ALIGNED;
        if number > 0 && (count == 4 || aligned) { number } else { 0 }
    };
    Ok(faces.boundary().iter().zip(&counted).map(decide).collect())
}

fn report(mesh: &HexMesh, proof: &CellProof) -> Result<MeshReport, MeshError> {
    let (cell, quality) = proof.worst;
    if quality <= 0.0 {
        return Err(MeshError::Folded { cell, quality });
    }
    Ok(MeshReport {
        vertices: mesh.positions().len(),
        hexahedra: mesh.cells().len(),
        min_scaled_jacobian: proof.least,
        certified: proof.is_complete(),
        unproven: proof.places(None, |cell| mean(&mesh.corners(mesh.cells()[cell]))),
        linear: None,
        wall: None,
        left_out: Vec::new(),
        moved: Vec::new(),
    })
}

impl NeuronMesh {
    /// An imported hexahedral mesh with its ends. The sample of a labelled end is its label; that of a side is [`Side::number`].
    ///
    /// # Errors
    /// [`MeshError::Folded`] for the worst cell if it is folded or inverted, [`MeshError::Side`], [`MeshError::Labels`],
    /// [`MeshError::Volume`] if the mesh does not conform, [`MeshError::Stopped`].
    pub fn from_hexahedra(mesh: HexMesh, at: Ends<'_>, limits: &Limits) -> Result<Self, MeshError> {
        let control = Control::start(limits);
        let proof = CellProof::of_cells(&mesh, &control)?;
        let report = report(&mesh, &proof)?;
        let faces = Faces::new(&mesh)?;
        let (labels, caps) = ends(&mesh, &faces, at)?;
        let parts = vec![0; mesh.cells().len()];
        Ok(Self { mesh, faces, labels, caps, parts, report })
    }
}

impl CubicMesh {
    /// The same with each cell as a patch.
    ///
    /// # Errors
    /// Those of [`NeuronMesh::from_hexahedra`].
    pub fn from_hexahedra(mesh: &HexMesh, at: Ends<'_>, limits: &Limits) -> Result<Self, MeshError> {
        let (cubic, faces, report) = patches(mesh, limits)?;
        let (labels, caps) = ends(mesh, &Faces::new(mesh)?, at)?;
        let parts = levels(mesh.cells().len(), &faces, &labels);
        Ok(Self { mesh: cubic, faces, labels, caps, parts, report })
    }

    /// A trilinear mesh with each cell as a patch.
    ///
    /// # Errors
    /// [`MeshError::Folded`], [`MeshError::Stopped`].
    pub fn from_trilinear(mesh: &NeuronMesh, limits: &Limits) -> Result<Self, MeshError> {
        let (cubic, faces, report) = patches(&mesh.mesh, limits)?;
        let (labels, caps) = (mesh.labels.clone(), mesh.caps.clone());
        let parts = levels(mesh.mesh.cells().len(), &faces, &labels);
        Ok(Self { mesh: cubic, faces, labels, caps, parts, report })
    }
}

/// Cells as patches. Their faces have the order of those of the cells.
fn patches(mesh: &HexMesh, limits: &Limits) -> Result<(BezierMesh, Faces, MeshReport), MeshError> {
    let control = Control::start(limits);
    let cubic = BezierMesh::from_trilinear(mesh);
    let proof = CellProof::of_patches(&cubic, &control)?;
    let report = report(mesh, &proof)?;
    let faces = Faces::new(&cubic.corner_mesh()?)?;
    Ok((cubic, faces, report))
}

/// For each cell −1 − k, where k is its distance in faces from the first end: cells of one number lie between those of the two
/// adjacent numbers.
fn levels(cells: usize, faces: &Faces, labels: &[u32]) -> Vec<i32> {
    let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); cells];
    for face in faces.inner() {
        let [a, b] = face.cells;
        neighbours[a as usize].push(b);
        neighbours[b as usize].push(a);
    }
    let mut parts = vec![0; cells];
    let starts = faces.boundary().iter().zip(labels).filter(|(_, label)| **label == 1);
    let mut queue: VecDeque<u32> = starts.map(|(face, _)| face.cell).collect();
    for &cell in &queue {
        parts[cell as usize] = -1;
    }
    for start in 0..cells as u32 {
        if parts[start as usize] == 0 && queue.is_empty() {
            parts[start as usize] = -1;
            queue.push_back(start);
        }
        while let Some(cell) = queue.pop_front() {
            for &next in &neighbours[cell as usize] {
                if parts[next as usize] == 0 {
                    parts[next as usize] = parts[cell as usize] - 1;
                    queue.push_back(next);
                }
            }
        }
    }
    parts
}
