//! Assembly of the blocks of nodes and tubes.

use super::layout::Layout;
use super::node::{layer_of, place_in_disc};
use super::node_mesh::NodeMesh;
use super::section::Section;
use super::sweep::{RadialLength, Station, stations, twist};
use super::tube::Tube;
use glam::DVec3;
use pompeiu_volume::bernstein::interpolate;
use pompeiu_volume::{Refinement, RefinementKey, key_weights as weights};

/// The mesh under construction.
pub(super) struct Assembly<'a> {
    /// The section of tricubic cells; `None` for trilinear ones.
    section: Option<&'a Section>,
    /// Steps of the lattice in each block.
    parts: usize,
    pub(super) refinement: Refinement,
    pub(super) positions: Vec<DVec3>,
    /// The lattice of each block.
    pub(super) lattices: Vec<Vec<u32>>,
    /// The tube of each block, or -1 - k for node k.
    pub(super) blocks: Vec<i32>,
    /// The vertices of each cap, its tube, and whether it is at the tube's first end.
    pub(super) caps: Vec<(Vec<u32>, usize, bool)>,
    corners: u32,
}

/// The blocks of a node, and the positions or control points of their lattices.
pub(super) struct NodeBlocks<'n> {
    pub(super) node: &'n NodeMesh,
    pub(super) refinement: &'n Refinement,
    pub(super) positions: &'n [DVec3],
}

/// The index of a tube or node as a number; there are fewer than samples.
fn number(index: usize) -> i32 {
    i32::try_from(index).unwrap_or(i32::MAX)
}

impl<'a> Assembly<'a> {
    /// Trilinear cells, `parts` per block along each edge; or the control points of tricubic cells, with three steps per block.
    pub(super) fn new(parts: usize, section: Option<&'a Section>) -> Self {
        Self {
            section,
            parts,
            refinement: Refinement::new(parts),
            positions: Vec::new(),
            lattices: Vec::new(),
            blocks: Vec::new(),
            caps: Vec::new(),
            corners: 0,
        }
    }

    pub(super) fn build(
        mut self,
        tubes: &[Tube],
        layout: &Layout,
        lengths: &[Option<RadialLength>],
        nodes: &[Option<NodeBlocks<'_>>],
        layer: f64,
    ) -> Self {
        let mut offsets = Vec::with_capacity(nodes.len());
        for (index, node) in nodes.iter().enumerate() {
            offsets.push(self.corners);
            if let Some(node) = node {
                self.add_node(index, node);
            }
        }
        for (index, (span, lengths)) in layout.spans.iter().zip(lengths).enumerate() {
            let (Some(span), Some(lengths)) = (span, lengths) else { continue };
            let places = lengths.places(layer, self.parts);
            // The section at an end: corners in the core and on the wall, and its first side.
            let section = |end: usize| {
                span[end].arm.and_then(|(cluster, arm)| {
                    let section = nodes[cluster].as_ref()?.node.sections[arm].clone();
                    let offset = offsets[cluster];
                    Some((section.inner.map(|c| c + offset), section.outer.map(|c| c + offset), section.side))
                })
            };
            self.add_tube(index, &tubes[index], &places, section(0), section(1));
        }
        self
    }

    fn add_node(&mut self, index: usize, blocks: &NodeBlocks<'_>) {
        let (offset, node) = (self.corners, blocks.node);
        self.corners += node.corners as u32;
        let shift =
            |key: &RefinementKey| key.map(|(c, w)| if c == u32::MAX { (c, w) } else { (c + offset, w) });
        for (key, position) in blocks.refinement.keys().iter().zip(blocks.positions) {
            let vertex = self.refinement.vertex(shift(key));
            debug_assert_eq!(vertex as usize, self.positions.len(), "nodes have no common vertices");
            self.positions.push(*position);
        }
        for block in &node.blocks {
            self.lattices.push(self.refinement.lattice(block.map(|c| c + offset)));
            self.blocks.push(-1 - number(index));
        }
    }

    fn add_tube(
        &mut self,
        index: usize,
        tube: &Tube,
        places: &[f64],
        first: Option<([u32; 4], [u32; 4], DVec3)>,
        last: Option<([u32; 4], [u32; 4], DVec3)>,
    ) {
        let parts = self.parts;
        let layers = (places.len() - 1) / parts;
        let evened = self.section.map(|_| evened(places));
        let places = evened.as_deref().unwrap_or(places);
        let mut stations = stations(tube, places, first.map(|(_, _, side)| side));
        let last = last.map(|(inner, outer, side)| {
            let end = stations[stations.len() - 1];
            // The other node sees the tube in the opposite direction. The sides of tubes with corners have lengths.
            let across = end.sides[1].cross(end.sides[0]).normalize_or_zero().cross(side);
            let corners = [0, 1, 2, 3].map(|k| {
                let angle = std::f64::consts::FRAC_PI_4 * f64::from(2 * k + 1);
                side * libm::cos(angle) + across * libm::sin(angle)
            });
            let (start, _) = twist(&mut stations, corners);
            let turn = |c: [u32; 4]| [0, 1, 2, 3].map(|k| c[(start + 4 - k) % 4]);
            (turn(inner), turn(outer))
        });
        if self.section.is_some() {
            stations = control_stations(&stations);
        }
        let mut below = first.map_or_else(|| self.new_section(), |(inner, outer, _)| [inner, outer]);
        if first.is_none() {
            let vertices = self.cap(below, &stations[0]);
            self.caps.push((vertices, index, true));
        }
        for layer in 0..layers {
            let above = match last {
                Some((inner, outer)) if layer + 1 == layers => [inner, outer],
                _ => self.new_section(),
            };
            if layer + 1 == layers && last.is_none() {
                let vertices = self.cap(above, &stations[layers * parts]);
                self.caps.push((vertices, index, false));
            }
            let mut blocks = Vec::with_capacity(5);
            layer_of(&mut blocks, below, above);
            for block in blocks {
                let lattice = self.refinement.lattice(block);
                for vertex in self.positions.len()..self.refinement.keys().len() {
                    let (mut inner, mut outer, mut up) = ([0.0; 4], [0.0; 4], 0.0);
                    for (corner, weight) in weights(&self.refinement.keys()[vertex]) {
                        let corner = corner as u32;
                        for (side, section) in [below, above].into_iter().enumerate() {
                            if let Some(k) = section[0].iter().position(|&c| c == corner) {
                                inner[k] += weight;
                            } else if let Some(k) = section[1].iter().position(|&c| c == corner) {
                                outer[k] += weight;
                            } else {
                                continue;
                            }
                            up += side as f64 * weight;
                        }
                    }
                    let station = &stations[layer * parts + (up * parts as f64).round() as usize];
                    self.positions.push(station.at(self.in_section(inner, outer)));
                }
                self.lattices.push(lattice);
                self.blocks.push(number(tube.branch));
            }
            below = above;
        }
    }

    /// The position of a lattice point or control point of a section in the unit disc.
    fn in_section(&self, inner: [f64; 4], outer: [f64; 4]) -> [f64; 2] {
        self.section.map_or_else(|| place_in_disc(inner, outer).0, |section| section.control(inner, outer))
    }

    fn new_section(&mut self) -> [[u32; 4]; 2] {
        let base = self.corners;
        self.corners += 8;
        [[0, 1, 2, 3].map(|k| base + k), [4, 5, 6, 7].map(|k| base + k)]
    }

    /// The vertices of a flat end, created here.
    fn cap(&mut self, [inner, outer]: [[u32; 4]; 2], station: &Station) -> Vec<u32> {
        let parts = self.parts;
        // A layer without height: its lattice lists every vertex of the section.
        let mut blocks = Vec::with_capacity(5);
        layer_of(&mut blocks, [inner, outer], [inner, outer]);
        let mut vertices = Vec::new();
        for block in blocks {
            let quad = [block[0], block[1], block[2], block[3]];
            for j in 0..=parts {
                for i in 0..=parts {
                    let mut key: RefinementKey = [(u32::MAX, 0); 8];
                    let of = [(parts - i) * (parts - j), i * (parts - j), i * j, (parts - i) * j];
                    let (mut in_core, mut on_wall) = ([0.0; 4], [0.0; 4]);
                    for k in 0..4 {
                        if of[k] > 0 {
                            key[k] = (quad[k], (of[k] * parts) as u32);
                            let weight = of[k] as f64 / (parts * parts) as f64;
                            if let Some(place) = inner.iter().position(|&c| c == quad[k]) {
                                in_core[place] = weight;
                            } else if let Some(place) = outer.iter().position(|&c| c == quad[k]) {
                                on_wall[place] = weight;
                            }
                        }
                    }
                    key.sort_unstable();
                    let vertex = self.refinement.vertex(key);
                    if vertex as usize == self.positions.len() {
                        self.positions.push(station.at(self.in_section(in_core, on_wall)));
                    }
                    vertices.push(vertex);
                }
            }
        }
        vertices.sort_unstable();
        vertices.dedup();
        vertices
    }
}

/// Least derivative of the cubic through the places of a block, over its mean, from which on it is increasing enough.
const INCREASING: f64 = 0.2;

/// Places of sections, three steps per block, made equal in blocks where the cubic through them would turn back or nearly: where the radius changes
/// fast, places that are equal in radii are not equal in length.
fn evened(places: &[f64]) -> Vec<f64> {
    let mut found = places.to_vec();
    for start in (0..places.len().saturating_sub(3)).step_by(3) {
        let control = interpolate(std::array::from_fn(|k| places[start + k]));
        let length = control[3] - control[0];
        let is_increasing = control.windows(2).all(|pair| 3.0 * (pair[1] - pair[0]) >= INCREASING * length);
        if !is_increasing {
            for k in [1, 2] {
                found[start + k] = control[0] + length * k as f64 / 3.0;
            }
        }
    }
    found
}

/// The sections at control points along a tube, three steps per block, from the sections at thirds.
fn control_stations(stations: &[Station]) -> Vec<Station> {
    let mut result: Vec<Station> = stations
        .iter()
        .map(|s| Station { centre: s.centre, radius: 1.0, sides: s.sides.map(|side| side * s.radius) })
        .collect();
    for start in (0..stations.len().saturating_sub(3)).step_by(3) {
        let four: [Station; 4] = std::array::from_fn(|k| result[start + k]);
        let centres = interpolate(four.map(|s| s.centre));
        let sides = [0, 1].map(|axis| interpolate(four.map(|s| s.sides[axis])));
        for k in [1, 2] {
            result[start + k] =
                Station { centre: centres[k], radius: 1.0, sides: [sides[0][k], sides[1][k]] };
        }
    }
    result
}
