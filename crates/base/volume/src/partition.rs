//! Partitions of cells for parallel processes: balanced, with few faces between parts.

use crate::Faces;
use std::collections::{BinaryHeap, VecDeque};

/// Largest imbalance of one half of a bisection, relative to its target size: at the end, and during the improvement. At least one
/// and four cells.
const IMBALANCE: [f64; 2] = [0.004, 0.02];

/// Starting cells of each bisection; the best result is kept.
const STARTS: usize = 2;

/// Smoothing passes that replace distances by means with those of the neighbours; they flatten fronts across tubes.
const SMOOTHING: usize = 60;

/// Largest number of improvement passes over the border of a bisection.
const PASSES: usize = 6;

/// A pass ends after this many moves without an improvement.
const PATIENCE: usize = 400;

/// Balance and cut of a partition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartitionQuality {
    /// Cells of the largest part over the mean.
    pub imbalance: f64,
    /// Inner faces between different parts.
    pub cut: usize,
}

/// The part of each cell, from 0: recursive bisection of the graph of cells that share faces.
///
/// Each half consists of the cells nearest to a cell at the end of the mesh, by smoothed distances in the graph; then cells at the
/// border change sides while that reduces the number of cut faces.
/// change sides as long as fewer faces are cut.
/// Deterministic. The cut is not optimal: the method is a heuristic.
/// Deterministic. No optimum: the cut is that of a good heuristic.
/// # Cost
/// O(n log n) for each of the log₂(parts) levels.
/// # Source
/// Moves by gain: `fiduccia_lineartime_1982`.
pub fn partition(cells: usize, faces: &Faces, parts: usize) -> Vec<u32> {
    let parts = parts.clamp(1, cells.max(1));
    let mut graph = Graph { starts: vec![0; cells + 1], neighbours: Vec::new() };
    for face in faces.inner() {
        for &cell in &face.cells {
            graph.starts[cell as usize + 1] += 1;
        }
    }
    for cell in 0..cells {
        graph.starts[cell + 1] += graph.starts[cell];
    }
    graph.neighbours = vec![0; graph.starts[cells] as usize];
    let mut next = graph.starts.clone();
    for face in faces.inner() {
        let [a, b] = face.cells;
        for (from, to) in [(a, b), (b, a)] {
            graph.neighbours[next[from as usize] as usize] = to;
            next[from as usize] += 1;
        }
    }
    let mut of = vec![0; cells];
    // Cells, the first number of their parts, and the number of parts to make of them.
    let mut waiting = vec![((0..cells as u32).collect::<Vec<_>>(), 0, parts)];
    let mut bisection = Bisection { graph: &graph, side: vec![NONE; cells] };
    while let Some((list, first, count)) = waiting.pop() {
        if count == 1 {
            for &cell in &list {
                of[cell as usize] = first as u32;
            }
            continue;
        }
        let half = count / 2;
        let [a, b] = bisection.halves(&list, half as f64 / count as f64, [half, count - half]);
        waiting.push((b, first + half, count - half));
        waiting.push((a, first, half));
    }
    of
}

/// The balance and cut of a partition.
pub fn partition_quality(faces: &Faces, of: &[u32]) -> PartitionQuality {
    let mut sizes = vec![0_usize; of.iter().max().map_or(0, |most| *most as usize + 1)];
    for &part in of {
        sizes[part as usize] += 1;
    }
    let largest = sizes.iter().max().copied().unwrap_or(0) as f64;
    let cut = faces.inner().iter().filter(|face| {
        let [a, b] = face.cells;
        of[a as usize] != of[b as usize]
    });
    let imbalance = largest * sizes.len() as f64 / of.len().max(1) as f64;
    PartitionQuality { imbalance, cut: cut.count() }
}

/// A partition in the format of METIS: the part of each cell on a line of its own, for a file `NAME.epart.N`.
pub fn epart(of: &[u32]) -> String {
    let mut text = String::with_capacity(3 * of.len());
    for part in of {
        text.push_str(&part.to_string());
        text.push('\n');
    }
    text
}

struct Graph {
    starts: Vec<u32>,
    neighbours: Vec<u32>,
}

impl Graph {
    fn of(&self, cell: u32) -> &[u32] {
        &self.neighbours[self.starts[cell as usize] as usize..self.starts[cell as usize + 1] as usize]
    }
}

/// The cell is not part of this bisection.
const NONE: u8 = 2;

struct Bisection<'g> {
    graph: &'g Graph,
    side: Vec<u8>,
}

impl Bisection<'_> {
    /// Bisects a list of cells; the first half gets about this share, and each half at least as many cells as parts it will be
    /// divided into.
    fn halves(&mut self, list: &[u32], share: f64, least: [usize; 2]) -> [Vec<u32>; 2] {
        let target = (list.len() as f64 * share).round() as usize;
        let target = target.clamp(least[0], list.len() - least[1]);
        let range = |least_slack: f64, share: f64| {
            let slack = (share * target.min(list.len() - target) as f64).max(least_slack) as usize;
            [target.saturating_sub(slack).max(least[0]), (target + slack).min(list.len() - least[1])]
        };
        let ranges = [range(1.0, IMBALANCE[0]), range(4.0, IMBALANCE[1])];
        let mut best: Option<(usize, Vec<u8>)> = None;
        let mut start = list[0];
        for _ in 0..STARTS {
            // Starts at the cell farthest from here, an end of the mesh.
            let there = self.breadth_first(list, start);
            start = there[there.len() - 1];
            let near = self.breadth_first(list, start);
            for order in [self.smoothed(&near), near] {
                for (k, &cell) in order.iter().enumerate() {
                    self.side[cell as usize] = u8::from(k >= target);
                }
                let cut = self.improve(list, ranges, target);
                if best.as_ref().is_none_or(|(least, _)| cut < *least) {
                    best = Some((cut, list.iter().map(|&cell| self.side[cell as usize]).collect()));
                }
            }
        }
        let mut halves = [Vec::new(), Vec::new()];
        for (&cell, side) in list.iter().zip(best.map(|best| best.1).unwrap_or_default()) {
            halves[side as usize].push(cell);
        }
        for &cell in list {
            self.side[cell as usize] = NONE;
        }
        halves
    }

    fn breadth_first(&mut self, list: &[u32], start: u32) -> Vec<u32> {
        const NEW: u8 = 3;
        for &cell in list {
            self.side[cell as usize] = NEW;
        }
        let mut order = Vec::with_capacity(list.len());
        for &seed in std::iter::once(&start).chain(list) {
            if self.side[seed as usize] != NEW {
                continue;
            }
            let mut queue = VecDeque::from([seed]);
            self.side[seed as usize] = 0;
            while let Some(cell) = queue.pop_front() {
                order.push(cell);
                for &next in self.graph.of(cell) {
                    if self.side[next as usize] == NEW {
                        self.side[next as usize] = 0;
                        queue.push_back(next);
                    }
                }
            }
        }
        order
    }

    /// The cells sorted by their smoothed position in a given order; all of them take part.
    fn smoothed(&mut self, order: &[u32]) -> Vec<u32> {
        let mut place: Vec<f64> = (0..order.len()).map(|k| k as f64).collect();
        let mut index: std::collections::HashMap<u32, usize> = std::collections::HashMap::new();
        index.extend(order.iter().enumerate().map(|(k, &cell)| (cell, k)));
        let neighbours: Vec<Vec<usize>> = order
            .iter()
            .map(|&cell| self.graph.of(cell).iter().filter_map(|next| index.get(next).copied()).collect())
            .collect();
        for _ in 0..SMOOTHING {
            place = neighbours
                .iter()
                .zip(&place)
                .map(|(list, own)| {
                    let sum: f64 = list.iter().map(|&k| place[k]).sum();
                    (own + sum) / (list.len() + 1) as f64
                })
                .collect();
        }
        let mut keyed: Vec<(f64, u32)> = place.into_iter().zip(order.iter().copied()).collect();
        keyed.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        keyed.into_iter().map(|(_, cell)| cell).collect()
    }

    /// Reduction of the number of cut faces if the cell changes sides.
    fn gain(&self, cell: u32) -> i64 {
        let own = self.side[cell as usize];
        let of = |&next: &u32| match self.side[next as usize] {
            side if side > 1 => 0,
            side if side == own => -1,
            _ => 1,
        };
        self.graph.of(cell).iter().map(of).sum()
    }

    fn cut(&self, list: &[u32]) -> usize {
        let of = |&cell: &u32| {
            let is_cut = |next: &&u32| self.side[cell as usize] == 0 && self.side[**next as usize] == 1;
            self.graph.of(cell).iter().filter(is_cut).count()
        };
        list.iter().map(of).sum()
    }

    /// Improves the border; returns the number of cut faces.
    fn improve(&mut self, list: &[u32], [last, range]: [[usize; 2]; 2], target: usize) -> usize {
        let mut size = target;
        let mut is_done = vec![];
        for _ in 0..PASSES {
            let mut heap: BinaryHeap<(i64, std::cmp::Reverse<u32>)> = list
                .iter()
                .map(|&cell| (self.gain(cell), std::cmp::Reverse(cell)))
                .filter(|(gain, _)| *gain > -4)
                .collect();
            is_done.clear();
            is_done.resize(self.side.len(), false);
            let (mut moved, mut sum, mut best) = (Vec::new(), 0, (0, 0));
            let mut held = Vec::new();
            while let Some((gain, std::cmp::Reverse(cell))) = heap.pop() {
                if is_done[cell as usize] || gain != self.gain(cell) {
                    continue;
                }
                let own = self.side[cell as usize];
                let next = if own == 0 { size.wrapping_sub(1) } else { size + 1 };
                if next < range[0] || next > range[1] {
                    held.push((gain, std::cmp::Reverse(cell)));
                    continue;
                }
                is_done[cell as usize] = true;
                self.side[cell as usize] = 1 - own;
                size = next;
                sum += gain;
                moved.push(cell);
                if sum > best.0 && (last[0]..=last[1]).contains(&size) {
                    best = (sum, moved.len());
                }
                if moved.len() - best.1 > PATIENCE {
                    break;
                }
                heap.extend(held.drain(..));
                for &other in self.graph.of(cell) {
                    if self.side[other as usize] <= 1 && !is_done[other as usize] {
                        heap.push((self.gain(other), std::cmp::Reverse(other)));
                    }
                }
            }
            for &cell in moved[best.1..].iter().rev() {
                let own = self.side[cell as usize];
                self.side[cell as usize] = 1 - own;
                size = if own == 0 { size - 1 } else { size + 1 };
            }
            if best.0 == 0 {
                break;
            }
        }
        self.cut(list)
    }
}
