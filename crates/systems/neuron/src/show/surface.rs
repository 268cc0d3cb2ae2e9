//! The boundary of a mesh as triangles, with the values of its cells at vertices.

use crate::{FlowCells, NeuronMesh};
use pompeiu_volume::bernstein::value;
use pompeiu_volume::{FACE_AXES, Faces, Refinement};

/// The boundary of a mesh: triangles, and the cells around each vertex.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct NeuronSurface {
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// For each vertex the cells of the faces around it.
    cells: Vec<Vec<u32>>,
}

/// Largest number of faces at which those of tricubic cells are drawn as four each.
const FEW_FACES: usize = 20_000;

impl NeuronSurface {
    /// The boundary of trilinear cells.
    pub fn new(mesh: &NeuronMesh) -> Self {
        let mut surface = Self::default();
        let mut numbers = std::collections::HashMap::new();
        for face in mesh.faces.boundary() {
            let [a, b, c, d] = face.vertices.map(|v| {
                let place = mesh.mesh.positions()[v as usize];
                let number = *numbers.entry(v).or_insert_with(|| surface.add(place.to_array()));
                surface.join(number, face.cell);
                number
            });
            surface.triangles.extend([[a, b, c], [a, c, d]]);
        }
        surface
    }

    /// The boundary of tricubic cells, from points on it.
    pub fn of_flow(cells: &FlowCells) -> Self {
        let parts = if cells.faces().boundary().len() > FEW_FACES { 1 } else { 2 };
        let mut surface = Self::default();
        let mut refinement = Refinement::new(parts);
        let mut numbers: Vec<u32> = Vec::new();
        let boundary: &Faces = cells.faces();
        for face in boundary.boundary() {
            let control = cells.mesh().cells()[face.cell as usize];
            let lattice = refinement.lattice(pompeiu_volume::CORNERS_OF_64.map(|k| control[k]));
            numbers.resize(refinement.keys().len(), u32::MAX);
            let points = cells.mesh().control(face.cell as usize);
            let (_, side, along) = FACE_AXES[face.place as usize];
            let mut at = |i: usize, j: usize| {
                let mut place = [side * parts; 3];
                (place[along[0]], place[along[1]]) = (i, j);
                let key = lattice[place[0] + (parts + 1) * (place[1] + (parts + 1) * place[2])] as usize;
                if numbers[key] == u32::MAX {
                    numbers[key] =
                        surface.add(value(&points, place.map(|i| i as f64 / parts as f64)).to_array());
                }
                surface.join(numbers[key], face.cell);
                numbers[key]
            };
            let mut triangles = Vec::with_capacity(2 * parts * parts);
            for j in 0..parts {
                for i in 0..parts {
                    let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                    triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
            surface.triangles.extend(triangles);
        }
        surface
    }

    fn add(&mut self, position: [f64; 3]) -> u32 {
        self.positions.push(position);
        self.cells.push(Vec::new());
        (self.positions.len() - 1) as u32
    }

    fn join(&mut self, vertex: u32, cell: u32) {
        let cells = &mut self.cells[vertex as usize];
        if cells.last() != Some(&cell) {
            cells.push(cell);
        }
    }

    /// Number of vertices.
    pub fn vertices(&self) -> usize {
        self.positions.len()
    }

    /// The mean of a quantity over the cells at each vertex.
    pub(super) fn at_vertices(&self, of: impl Fn(usize) -> f64) -> Vec<f64> {
        let mean =
            |cells: &Vec<u32>| cells.iter().map(|&cell| of(cell as usize)).sum::<f64>() / cells.len() as f64;
        self.cells.iter().map(mean).collect()
    }
}
