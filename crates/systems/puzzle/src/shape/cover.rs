//! The part of an outline that copies of a shape leave uncovered.

use super::descend::{descend, hinge};
use super::map::Map;
use super::pose::{Pose, Turned};
use pompeiu_planar::{Outline, Point, SideTree};
use rayon::prelude::*;

/// Sample points of an outline, in blocks of nearby points.
pub(super) struct Samples {
    blocks: Vec<Block>,
    count: usize,
}

struct Block {
    centre: Point,
    radius: f64,
    points: Vec<Point>,
}

/// Derivatives with respect to position and angle of some copies.
type Slopes = Vec<(usize, [f64; 3])>;

/// The side of a block, relative to that of a piece.
const BLOCK: f64 = 0.25;

/// The inverses of the golden ratio and of the plastic number: the fractional parts of their multiples are evenly distributed.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
const PLASTIC: f64 = 0.754_877_666_246_692_8;

/// Blocks of a task.
const TASK: usize = 64;

/// Lipschitz constant of the interpolated distances of a map.
const LIPSCHITZ: f64 = 1.1;

impl Samples {
    /// Points inside an outline on a square lattice, with `per_unit` points per unit of length.
    pub(super) fn new(outline: &Outline, per_unit: f64) -> Self {
        let [low, high] = outline.bounds();
        let sides = SideTree::new(outline);
        let per_block = (per_unit * BLOCK).round().max(1.0) as usize;
        let blocks = [0, 1].map(|k| ((high[k] - low[k]) / BLOCK).ceil().max(1.0) as usize);
        // In the middle of the bounding box.
        let start = [0, 1].map(|k| 0.5 * (low[k] + high[k] - blocks[k] as f64 * BLOCK));
        let blocks: Vec<Block> = (0..blocks[0] * blocks[1])
            .into_par_iter()
            .map(|i| {
                let corner =
                    [start[0] + (i % blocks[0]) as f64 * BLOCK, start[1] + (i / blocks[0]) as f64 * BLOCK];
                // A rank-1 lattice, shifted differently in each block, so that no straight border lies along its rows.
                let n = (per_block * per_block) as f64;
                let part = |j: usize, k: usize| {
                    let own = if k == 0 { j as f64 / n } else { j as f64 * GOLDEN };
                    let moved = own + i as f64 * [PLASTIC, PLASTIC * PLASTIC][k];
                    moved - moved.floor()
                };
                let points = (0..per_block * per_block)
                    .map(|j| [corner[0] + BLOCK * part(j, 0), corner[1] + BLOCK * part(j, 1)])
                    .filter(|p| sides.contains(*p));
                Block {
                    centre: corner.map(|x| x + 0.5 * BLOCK),
                    radius: BLOCK * std::f64::consts::FRAC_1_SQRT_2,
                    points: points.collect(),
                }
            })
            .collect();
        let blocks: Vec<Block> = blocks.into_iter().filter(|block| !block.points.is_empty()).collect();
        let count = blocks.iter().map(|block| block.points.len()).sum();
        Self { blocks, count }
    }

    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Calls a function for each point with the copy of least value there and that value.
    pub(super) fn each(&self, map: &Map, poses: &[Pose], mut found: impl FnMut(Point, usize, f64)) {
        let turned: Vec<Turned> = poses.iter().map(Pose::turn).collect();
        let mut near = Vec::new();
        for block in &self.blocks {
            candidates(map, &turned, block.centre, block.radius, &mut near);
            for p in &block.points {
                let (value, j) = least(map, &turned, &near, *p);
                found(*p, j, value);
            }
        }
    }

    /// The mean hinge of the least values, and its gradient with respect to position and angle of each copy.
    fn energy(&self, map: &Map, poses: &[Pose], width: f64, gradient: &mut [f64]) -> f64 {
        let turned: Vec<Turned> = poses.iter().map(Pose::turn).collect();
        let tasks: Vec<(f64, Slopes)> = self
            .blocks
            .par_chunks(TASK)
            .map(|blocks| {
                let (mut total, mut slopes) = (0.0, Slopes::new());
                let mut near = Vec::new();
                for block in blocks {
                    candidates(map, &turned, block.centre, block.radius, &mut near);
                    for p in &block.points {
                        let (value, j) = least(map, &turned, &near, *p);
                        let (rise, slope) = hinge(value, width);
                        total += rise;
                        if slope > 0.0 {
                            let (_, by) = turned[j].with_gradient(map, *p);
                            let by = [slope * by[0], slope * by[1], slope * by[2]];
                            match slopes.iter_mut().rev().find(|(of, _): &&mut (usize, _)| *of == j) {
                                Some((_, sum)) => *sum = [sum[0] + by[0], sum[1] + by[1], sum[2] + by[2]],
                                None => slopes.push((j, by)),
                            }
                        }
                    }
                }
                (total, slopes)
            })
            .collect();
        gradient.fill(0.0);
        let norm = 1.0 / self.count as f64;
        let mut total = 0.0;
        for (part, slopes) in tasks {
            total += part;
            for (j, by) in slopes {
                (0..3).for_each(|k| gradient[3 * j + k] += norm * by[k]);
            }
        }
        total * norm
    }

    /// Moves copies by descent; each step lowers the energy. Returns the final energy.
    pub(super) fn settle(
        &self,
        map: &Map,
        poses: &mut [Pose],
        width: f64,
        steps: usize,
        taken: impl FnMut(f64) -> bool,
    ) -> f64 {
        let n = poses.len();
        let mut x: Vec<f64> = poses.iter().flat_map(|p| [p.place[0], p.place[1], p.angle]).collect();
        let mut current = poses.to_vec();
        let energy = |x: &[f64], gradient: &mut [f64]| {
            write(&mut current, x);
            self.energy(map, &current, width, gradient)
        };
        // Each copy contributes its share of the mean.
        let value = descend(&mut x, 0.3 * n as f64, steps, energy, taken);
        write(poses, &x);
        value
    }
}

fn write(poses: &mut [Pose], x: &[f64]) {
    for (pose, x) in poses.iter_mut().zip(x.chunks_exact(3)) {
        pose.place = [x[0], x[1]];
        pose.angle = x[2];
    }
}

/// The copies that can have the least value somewhere in a disc.
pub(super) fn candidates(map: &Map, poses: &[Turned], centre: Point, radius: f64, near: &mut Vec<usize>) {
    near.clear();
    let reach = map.radius();
    let squared = |pose: &Turned| {
        let away = [centre[0] - pose.place[0], centre[1] - pose.place[1]];
        away[0] * away[0] + away[1] * away[1]
    };
    // The distance to a copy is at least that to its bounding circle.
    let mut least = f64::INFINITY;
    let mut values: Vec<(usize, f64)> = Vec::new();
    for (j, pose) in poses.iter().enumerate() {
        let far = reach + least + 2.0 * LIPSCHITZ * radius;
        if far < 0.0 || squared(pose) > far * far {
            continue;
        }
        let value = map.value(pose.to_shape(centre));
        values.push((j, value));
        least = least.min(value);
    }
    let most = least + 2.0 * LIPSCHITZ * radius;
    near.extend(values.into_iter().filter(|(_, value)| *value <= most).map(|(j, _)| j));
}

/// The least value at a point among some copies, and the copy that has it.
pub(super) fn least(map: &Map, poses: &[Turned], near: &[usize], p: Point) -> (f64, usize) {
    let mut best = (f64::INFINITY, 0);
    for j in near {
        let value = map.value(poses[*j].to_shape(p));
        if value < best.0 {
            best = (value, *j);
        }
    }
    best
}
