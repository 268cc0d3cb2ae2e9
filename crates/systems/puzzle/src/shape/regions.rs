//! The regions of the plane nearest to each copy of a shape, with borders as segments between pixels.

use super::cover::{candidates, least};
use super::map::Map;
use super::pose::{Pose, Turned};
use crate::PuzzleError;
use pompeiu_planar::{Outline, Point, fill};
use rayon::prelude::*;
use std::collections::VecDeque;

/// Pixels per unit of length; fewer if that would be too many.
const PIXELS: f64 = 40.0;
const MOST_PIXELS: f64 = 40e6;

/// Bytes per pixel while regions are computed, and the fewest pixels per piece that show its shape.
const BYTES: f64 = 16.0;
const LEAST_PIXELS: f64 = 400.0;

/// Margin around the outline in pixels.
const MARGIN: usize = 4;

/// Pixels up to this far outside the outline belong to regions, too.
const BAND: usize = 2;

/// Pixels along the side of a block with a common list of candidate copies.
const SIDE: usize = 8;

/// No region yet.
const NONE: u32 = u32::MAX;

/// Smallest distance of a border from a pixel centre, relative to the pixel size.
const CLEARANCE: f64 = 0.02;

/// A label image of regions.
pub(super) struct Regions {
    width: usize,
    height: usize,
    origin: Point,
    step: f64,
    labels: Vec<u32>,
}

/// The largest number of pixels of a label image.
///
/// # Errors
/// [`PuzzleError::Memory`] if the limit leaves too few pixels to show the pieces.
pub(super) fn most_pixels(pieces: usize, memory: Option<usize>) -> Result<f64, PuzzleError> {
    let Some(limit) = memory else { return Ok(MOST_PIXELS) };
    let needed = LEAST_PIXELS * BYTES * pieces as f64;
    if (limit as f64) < needed {
        return Err(PuzzleError::Memory { needed: needed as usize, limit });
    }
    Ok((limit as f64 / BYTES).min(MOST_PIXELS))
}

/// The borders between the regions of least value on and around an outline, as segments that meet only at their ends.
///
/// Each region is connected: its smaller components are given to the regions around them.
///
/// # Definition
/// Marching squares for several labels: a border passes between the centres of two pixels where the values of their copies are
/// equal; there is a junction where three or four regions meet.
pub(super) fn borders(map: &Map, poses: &[Pose], outline: &Outline, most_pixels: f64) -> Vec<[Point; 2]> {
    let turned: Vec<Turned> = poses.iter().map(Pose::turn).collect();
    let mut regions = Regions::new(map, &turned, outline, most_pixels);
    regions.connect(outline, poses.len());
    regions.segments(map, &turned)
}

impl Regions {
    fn new(map: &Map, poses: &[Turned], outline: &Outline, most_pixels: f64) -> Self {
        let [low, high] = outline.bounds();
        let extent = [high[0] - low[0], high[1] - low[1]];
        let per_unit = PIXELS.min((most_pixels / (extent[0] * extent[1])).sqrt());
        let step = 1.0 / per_unit;
        let count = extent.map(|x| (x * per_unit).ceil() as usize + 2 * MARGIN);
        let [width, height] = count;
        // Offset from the outline's bounding box by a part of a pixel that is no simple fraction.
        let origin = [low[0] - (MARGIN as f64 - 0.618) * step, low[1] - (MARGIN as f64 - 0.618) * step];
        let bands: Vec<Vec<u32>> = (0..height.div_ceil(SIDE))
            .into_par_iter()
            .map(|band| {
                let rows = SIDE.min(height - band * SIDE);
                let mut labels = vec![NONE; rows * width];
                let mut near = Vec::new();
                for left in (0..width).step_by(SIDE) {
                    let corner = [left, band * SIDE].map(|k| k as f64 * step);
                    let half = 0.5 * (SIDE - 1) as f64 * step;
                    let centre = [0, 1].map(|k| origin[k] + corner[k] + half);
                    if map.is_distance() {
                        candidates(map, poses, centre, 1.5 * half, &mut near);
                    } else {
                        near = (0..poses.len()).collect();
                    }
                    for row in 0..rows {
                        for column in left..(left + SIDE).min(width) {
                            let p = [column, band * SIDE + row];
                            let p = [0, 1].map(|k| origin[k] + p[k] as f64 * step);
                            labels[row * width + column] = least(map, poses, &near, p).1 as u32;
                        }
                    }
                }
                labels
            })
            .collect();
        Self { width, height, origin, step, labels: bands.concat() }
    }

    fn at(&self, i: usize) -> Point {
        let place = [i % self.width, i / self.width];
        [0, 1].map(|k| self.origin[k] + place[k] as f64 * self.step)
    }

    fn neighbours(&self, i: usize) -> impl Iterator<Item = usize> + use<> {
        let (x, y, width, height) = (i % self.width, i / self.width, self.width, self.height);
        [
            (x > 0).then(|| i - 1),
            (x + 1 < width).then(|| i + 1),
            (y > 0).then(|| i - width),
            (y + 1 < height).then(|| i + width),
        ]
        .into_iter()
        .flatten()
    }

    /// Keeps the largest component of each region within the outline, and lets these grow over everything else.
    fn connect(&mut self, outline: &Outline, count: usize) {
        let to_pixels = |p: Point| [0, 1].map(|k| (p[k] - self.origin[k]) / self.step);
        let Ok(in_pixels) = outline.map(to_pixels) else { return };
        let mut counts: Vec<bool> =
            fill([&in_pixels], self.width, self.height).iter().map(|share| *share > 0.0).collect();
        for _ in 0..BAND {
            let grown: Vec<bool> =
                (0..counts.len()).map(|i| counts[i] || self.neighbours(i).any(|j| counts[j])).collect();
            counts = grown;
        }
        let mut part = vec![NONE; self.labels.len()];
        let mut sizes: Vec<(u32, usize)> = Vec::new();
        let mut stack = Vec::new();
        for start in 0..part.len() {
            if !counts[start] || part[start] != NONE {
                continue;
            }
            let (name, label) = (sizes.len() as u32, self.labels[start]);
            part[start] = name;
            stack.push(start);
            let mut size = 0;
            while let Some(i) = stack.pop() {
                size += 1;
                for j in self.neighbours(i) {
                    if counts[j] && part[j] == NONE && self.labels[j] == label {
                        part[j] = name;
                        stack.push(j);
                    }
                }
            }
            sizes.push((label, size));
        }
        let mut largest = vec![NONE; count];
        for (name, (label, size)) in sizes.iter().enumerate() {
            let best = &mut largest[*label as usize];
            if *best == NONE || sizes[*best as usize].1 < *size {
                *best = name as u32;
            }
        }
        let mut front = VecDeque::new();
        for i in 0..part.len() {
            let is_kept = part[i] != NONE && largest[self.labels[i] as usize] == part[i];
            if is_kept {
                front.push_back(i);
            } else {
                self.labels[i] = NONE;
            }
        }
        while let Some(i) = front.pop_front() {
            for j in self.neighbours(i) {
                if self.labels[j] == NONE {
                    self.labels[j] = self.labels[i];
                    front.push_back(j);
                }
            }
        }
    }

    /// Where the border passes between two pixels of different regions.
    fn crossing(&self, map: &Map, poses: &[Turned], i: usize, j: usize) -> Point {
        let (p, q) = (self.at(i), self.at(j));
        let [a, b] = [i, j].map(|k| poses[self.labels[k] as usize]);
        let lead = |p: Point| map.value(a.to_shape(p)) - map.value(b.to_shape(p));
        let (from, to) = (lead(p), lead(q));
        let t = if from < 0.0 && to > 0.0 { from / (from - to) } else { 0.5 };
        let t = t.clamp(CLEARANCE, 1.0 - CLEARANCE);
        [0, 1].map(|k| p[k] + t * (q[k] - p[k]))
    }

    fn segments(&self, map: &Map, poses: &[Turned]) -> Vec<[Point; 2]> {
        let rows: Vec<Vec<[Point; 2]>> = (0..self.height - 1)
            .into_par_iter()
            .map(|y| {
                let mut found = Vec::new();
                for x in 0..self.width - 1 {
                    self.cell(map, poses, y * self.width + x, &mut found);
                }
                found
            })
            .collect();
        rows.concat()
    }

    /// The borders within the square between four pixels.
    fn cell(&self, map: &Map, poses: &[Turned], i: usize, found: &mut Vec<[Point; 2]>) {
        // Around the square; side k lies between corners k and k + 1.
        let corners = [i, i + 1, i + 1 + self.width, i + self.width];
        let labels = corners.map(|c| self.labels[c]);
        let is_crossed = |k: usize| labels[k] != labels[(k + 1) % 4];
        let count = (0..4).filter(|k| is_crossed(*k)).count();
        if count == 0 {
            return;
        }
        let crossing = |k: usize| {
            // The same order from both sides of an edge, for identical bits.
            let (a, b) = (corners[k], corners[(k + 1) % 4]);
            self.crossing(map, poses, a.min(b), a.max(b))
        };
        let crossed: Vec<Point> = (0..4).filter(|k| is_crossed(*k)).map(crossing).collect();
        let opposite = (0..2).find(|k| labels[*k] == labels[k + 2]);
        match (count, opposite) {
            (2, _) => found.push([crossed[0], crossed[1]]),
            // The region on the diagonal stays connected; the other two corners are cut off.
            (4, Some(k)) => {
                found.push([crossed[k], crossed[k + 1]]);
                found.push([crossed[(k + 2) % 4], crossed[(k + 3) % 4]]);
            }
            _ => {
                let n = crossed.len() as f64;
                let middle = [0, 1].map(|k| crossed.iter().map(|p| p[k]).sum::<f64>() / n);
                found.extend(crossed.into_iter().map(|p| [p, middle]));
            }
        }
    }
}
