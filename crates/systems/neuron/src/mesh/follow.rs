//! Drawing the wall of a node to the cones where it is too far from them.

use super::energy::Energy;
use super::node_mesh::{NodeMesh, PLACES, quality};
use super::shape::Shape;
use super::skin::Skin;
use super::wall::Wall;
use pompeiu_core::run::Control;

/// The mesh around a node with what is needed to move its vertices.
#[derive(Clone)]
pub(super) struct Draft {
    pub(super) node: NodeMesh,
    pub(super) cells: Vec<[u32; 8]>,
    /// The size of each cell.
    pub(super) sizes: Vec<f64>,
    /// The size of the node.
    pub(super) scale: f64,
    /// Vertices that may move.
    pub(super) free: Vec<u32>,
    /// Faces on the wall that have such a vertex.
    pub(super) faces: Vec<[u32; 4]>,
    /// The greatest distance of its wall from the cones, in radii.
    pub(super) off: f64,
}

/// Distance of the wall from the cones of the tubes beyond which it is drawn to them, in radii: half the default tolerance, because the axes of
/// tubes may be as far from the samples.
pub(super) const NEAR: f64 = 0.1;

/// Distance beyond which other complexes are tried, which takes many times as long: three quarters of the default tolerance.
const FAR: f64 = 0.15;

/// Scaled Jacobian from which on more of it does not make a draft fitter.
const FULL: f64 = 0.35;

/// Scaled Jacobian that no distance outweighs.
const LEAST: f64 = 0.1;

/// Scaled Jacobian below which a mesh is less fit by [`LOW`]: only a wall that is much nearer outweighs that.
const MODEST: f64 = 0.2;

/// See [`MODEST`].
const LOW: f64 = 0.15;

/// What makes a draft less fit than all with a larger scaled Jacobian.
const FOLDED: f64 = 1e3;

/// Scaled Jacobian that a radius of distance beyond [`NEAR`] outweighs.
const PER_RADIUS: f64 = 2.0;

/// Weights of the distance of the wall beside the energy of a cell.
pub(super) const WEIGHTS: [f64; 3] = [1.0, 10.0, 100.0];

/// Energies that are minimised one after another, with factors of these weights: they grow with the energies.
pub(super) fn shapes() -> [(Shape, f64); 3] {
    [
        (Shape::MeanRatio { epsilon: EPSILON }, 1.0),
        (Shape::Scaled { power: 2 }, 3.0),
        (Shape::Scaled { power: 4 }, 10.0),
    ]
}

/// Regularisation of the determinants of cells, none of which is folded.
const EPSILON: f64 = 1e-6;

/// Most steps of each minimisation.
const STEPS: usize = 60;

/// How good a mesh with this least scaled Jacobian is whose wall is so far from the cones. Nearly folded ones are less fit than all others.
pub(super) fn fitness(quality: f64, off: f64) -> f64 {
    let lost = match quality {
        _ if quality < LEAST => FOLDED,
        _ if quality < MODEST => LOW,
        _ => 0.0,
    };
    quality.min(FULL) - PER_RADIUS * (off - NEAR).max(0.0) - lost
}

impl Draft {
    /// How good it is: its least scaled Jacobian, less what its distance costs. Nearly folded ones are less fit than all others.
    pub(super) fn fitness(&self) -> f64 {
        fitness(self.node.quality, self.off)
    }

    pub(super) fn is_near(&self) -> bool {
        self.off <= NEAR
    }

    pub(super) fn is_far(&self) -> bool {
        self.off > FAR
    }

    /// Moves the vertices, those on the wall as well, with an increasing weight of the distance of faces from the cones, until the wall is near;
    /// keeps the fittest.
    ///
    /// Mean ratios keep edges from shrinking to nothing, which scaled Jacobians alone permit; then these are improved.
    pub(super) fn follow(&mut self, cones: &Wall, control: &Control) {
        let mut draft = self.clone();
        for weight in WEIGHTS {
            for (shape, factor) in shapes() {
                draft.relax(cones, shape, weight * factor, control);
            }
            if control.is_stopped() {
                return;
            }
            if draft.fitness() > self.fitness() {
                self.clone_from(&draft);
            }
            if draft.is_near() {
                return;
            }
        }
    }

    fn relax(&mut self, cones: &Wall, shape: Shape, weight: f64, control: &Control) {
        let skin = Skin::new(cones, &self.faces, &self.node.positions, weight);
        let energy = Energy {
            cells: &self.cells,
            free: &self.free,
            places: &PLACES,
            shape,
            wall: None,
            middles: (&[], 0.0),
            skin: Some(&skin),
            scale: self.scale,
            sizes: &self.sizes,
            control,
        };
        energy.minimise(&mut self.node.positions, STEPS);
        self.off = skin.off(&self.node.positions);
        self.node.quality = quality(&self.cells, &self.node.positions);
    }
}
