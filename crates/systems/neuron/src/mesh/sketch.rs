//! The mesh around a node, improved only until it decides whether the node can be meshed.

use super::energy::Energy;
use super::node::{Kind, MIDDLES, Sketch, middles};
use super::node_mesh::{NodeMesh, quality};
use super::shape::Shape;
use super::skin::Skin;
use super::wall::Wall;
use pompeiu_core::run::Control;

/// Least scaled Jacobian of cells that are far enough from being folded.
const VALID: f64 = 0.1;

/// Share of the tolerated distance of the wall that points on it may be from the cones, because there are others between them.
const SHARE: f64 = 0.8;

/// Steps of each round, and the weight of vertices off the wall. Before each round and after the last one, the mesh is looked at.
const ROUNDS: [(usize, f64); 4] = [(25, 30.0), (15, 300.0), (10, 3000.0), (20, 30_000.0)];

/// Parameters along each axis of a cell at which its shape is measured.
const CORNERS: [f64; 2] = [0.0, 1.0];

impl Sketch {
    /// The mesh as soon as its cells are valid and its wall is within a distance of the cones, if there are any; `None` if it does not come to that.
    pub(super) fn enough(
        mut self,
        wall: &Wall,
        (cones, within): (Option<&Wall>, f64),
        control: &Control,
    ) -> Option<NodeMesh> {
        let of = |wanted: &dyn Fn(Kind) -> bool| -> Vec<u32> {
            (0..self.kinds.len() as u32).filter(|&v| wanted(self.kinds[v as usize])).collect()
        };
        let free = of(&|kind| kind != Kind::Fixed);
        let on_wall = of(&|kind| kind == Kind::Wall);
        let faces = self.free_faces();
        let mut rounds = ROUNDS.into_iter();
        loop {
            let before = self.positions.clone();
            for &v in &on_wall {
                self.positions[v as usize] = wall.project(self.positions[v as usize]);
            }
            let quality = quality(&self.cells, &self.positions);
            let off = |cones: &Wall| Skin::new(cones, &faces, &self.positions, 0.0).off(&self.positions);
            if quality >= VALID && cones.is_none_or(|cones| off(cones) <= SHARE * within) {
                return Some(self.into_node(quality, true));
            }
            let (steps, weight) = rounds.next().filter(|_| !control.is_stopped())?;
            if quality < VALID && rounds.len() + 1 < ROUNDS.len() {
                // Where the projection folds cells, they are improved off the wall first.
                self.positions = before;
            }
            let found = middles(wall, &self.outer, &self.kinds, &self.positions);
            let mut energy = Energy {
                cells: &self.cells,
                free: &free,
                places: &CORNERS,
                shape: Shape::MeanRatio { epsilon: 0.1 },
                wall: Some((wall, &on_wall, weight)),
                middles: (&found, MIDDLES),
                skin: None,
                scale: self.scale,
                sizes: &self.sizes,
                control,
            };
            energy.shape = Shape::untangling(energy.least_determinant(&self.positions));
            energy.minimise(&mut self.positions, steps);
        }
    }
}
