//! The pieces near a place.

use super::body::Pose;
use pompeiu_planar::Point;

/// Pieces in cells of a grid, by their middles.
pub(super) struct Near {
    side: f64,
    size: [usize; 2],
    cells: Vec<Vec<u32>>,
}

/// Most cells.
const MOST: f64 = 1e6;

impl Near {
    /// A grid in which all pieces that may be within a distance are in cells that touch.
    pub(super) fn new(size: [f64; 2], within: f64) -> Self {
        let side = within.max((size[0] * size[1] / MOST).sqrt());
        let size = size.map(|length| (length / side).ceil().clamp(1.0, MOST) as usize);
        Self { side, size, cells: vec![Vec::new(); size[0] * size[1]] }
    }

    fn cell(&self, at: Point) -> [usize; 2] {
        [0, 1].map(|k| ((at[k] / self.side).max(0.0) as usize).min(self.size[k] - 1))
    }

    /// Sorts all pieces into cells.
    pub(super) fn fill(&mut self, poses: &[Pose]) {
        for cell in &mut self.cells {
            cell.clear();
        }
        for (piece, pose) in poses.iter().enumerate() {
            let [x, y] = self.cell(pose.at);
            self.cells[y * self.size[0] + x].push(piece as u32);
        }
    }

    /// Moves a piece.
    pub(super) fn shift(&mut self, piece: usize, from: Point, to: Point) {
        let [x, y] = self.cell(from);
        self.cells[y * self.size[0] + x].retain(|other| *other as usize != piece);
        let [x, y] = self.cell(to);
        self.cells[y * self.size[0] + x].push(piece as u32);
    }

    /// All pieces in the cells around a place.
    #[inline]
    pub(super) fn each(&self, at: Point, mut visit: impl FnMut(usize)) {
        let [x, y] = self.cell(at);
        for j in y.saturating_sub(1)..(y + 2).min(self.size[1]) {
            for i in x.saturating_sub(1)..(x + 2).min(self.size[0]) {
                for piece in &self.cells[j * self.size[0] + i] {
                    visit(*piece as usize);
                }
            }
        }
    }
}
