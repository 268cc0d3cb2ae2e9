//! From a skeleton to the mesh.

use super::blocks::{Key, Refinement, weights};
use super::cluster::{Layout, layout};
use super::node::{NodeMesh, layer_of, mesh_node, place_in_disc};
use super::options::{MeshError, MeshOptions, MeshReport};
use super::surface::surface_distance;
use super::sweep::{RadialLength, Station, stations, twist};
use super::tube::{Tube, tubes};
use crate::Skeleton;
use glam::DVec3;
use pompeiu_core::run::{Control, Progress, StopReason, on_threads};
use pompeiu_volume::{CellData, Faces, HexMesh, Jacobian, certify, scaled_jacobian, write_vtu};
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::Mutex;

/// A mesh of a neuron.
#[derive(Clone, Debug)]
pub struct NeuronMesh {
    /// Vertices and cells; every cell is proven to be unfolded where the report says so.
    pub mesh: HexMesh,
    /// Its faces.
    pub faces: Faces,
    /// For each boundary face 0 where it lies on the wall, and 1 + k on cap k.
    pub labels: Vec<u32>,
    /// The flat ends of tubes.
    pub caps: Vec<Cap>,
    /// For each cell the branch that it belongs to, in the order of the skeleton's tubes, or −1 − k at node k.
    pub parts: Vec<i32>,
    /// What is said of it.
    pub report: MeshReport,
}

impl NeuronMesh {
    /// The mesh as a VTK XML unstructured grid, with the branch of each cell as cell data.
    ///
    /// # Errors
    /// None but those of an allocation.
    pub fn vtu(&self) -> std::io::Result<Vec<u8>> {
        let branches: Vec<f64> = self.parts.iter().map(|&part| f64::from(part)).collect();
        let mut bytes = Vec::new();
        write_vtu(
            &mut bytes,
            &self.mesh,
            &[],
            &[CellData { name: "branch", values: &branches, components: 1 }],
        )?;
        Ok(bytes)
    }
}

impl NeuronMesh {
    /// The mesh with concentrations of each cell as cell data: `free`, `plus`, `minus` and their sum, `total`.
    ///
    /// # Errors
    /// [`std::io::ErrorKind::InvalidInput`] unless there are concentrations for each cell.
    pub fn vtu_with(&self, values: &[[f64; 3]]) -> std::io::Result<Vec<u8>> {
        let columns: Vec<Vec<f64>> = (0..3).map(|kind| values.iter().map(|v| v[kind]).collect()).collect();
        let total: Vec<f64> = values.iter().map(|v| v.iter().sum()).collect();
        let of = |name, values| CellData { name, values, components: 1 };
        let data =
            [of("total", &total), of("free", &columns[0]), of("plus", &columns[1]), of("minus", &columns[2])];
        let mut bytes = Vec::new();
        write_vtu(&mut bytes, &self.mesh, &[], &data)?;
        Ok(bytes)
    }
}

/// The flat end of a tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cap {
    /// The sample, by its number in the file.
    pub sample: i64,
    /// Whether the sample is a root: where material comes in, unless said otherwise.
    pub is_root: bool,
    /// Its centre.
    pub centre: DVec3,
    /// Its unit normal, outwards.
    pub normal: DVec3,
    /// Radius of the tube in the skeleton.
    pub radius: f64,
}

/// Bytes of memory for each cell, while faces are found and files are written.
const BYTES_PER_CELL: usize = 1200;

/// Bytes that are taken at most where no limit is given.
const MOST_BYTES: usize = 8 << 30;

/// Factor on radii with which a regular polygon has the area of its circle.
fn area_factor(sides: usize) -> f64 {
    let angle = std::f64::consts::TAU / sides as f64;
    (angle / libm::sin(angle)).sqrt()
}

/// Meshes a neuron.
///
/// # Shapes and units
/// Lengths in micrometres. Sections are polygons with the area of the disc. At tips and at roots with one neighbour the mesh ends with
/// a flat cap; a ball that is a soma, or the end of a branch that lost all others, is round.
/// # Accuracy
/// [`MeshReport::certified`] is proven, rounding included. Tubes of branches that are no neighbours are meshed apart from each other
/// even where they overlap: see [`problems`](crate::problems).
/// # Errors
/// [`MeshError`]: a sample without a radius, a node that cannot be meshed, memory, a limit on time.
/// # Cost
/// Linear in the length of the tree in radii; some 0.3 s for each node, in parallel.
/// # Source
/// The energy that unfolds cells: `garanzha_foldover_2021`.
pub fn mesh_neuron(skeleton: &Skeleton, options: &MeshOptions<'_>) -> Result<NeuronMesh, MeshError> {
    options.check()?;
    on_threads(options.limits.threads, || mesh(skeleton, options))
}

fn mesh(skeleton: &Skeleton, options: &MeshOptions<'_>) -> Result<NeuronMesh, MeshError> {
    if let Some(sample) = skeleton.samples().iter().find(|sample| sample.radius <= 0.0) {
        return Err(MeshError::ZeroRadius { sample: sample.id, line: sample.line });
    }
    let control = Control::start(&options.limits);
    let factor = area_factor(4 * options.parts);
    let tubes = tubes(skeleton, factor);
    let layout = layout(skeleton, &tubes, factor);
    let lengths: Vec<Option<RadialLength>> = layout
        .spans
        .iter()
        .zip(&tubes)
        .map(|(span, tube)| span.map(|[a, b]| RadialLength::new(tube, a.at, b.at)))
        .collect();
    check_memory(&layout, &lengths, options)?;
    let nodes = mesh_nodes(skeleton, &tubes, &layout, options, &control)?;
    let assembled = Assembly::new(options.parts).build(&tubes, &layout, &lengths, &nodes, options);
    if assembled.cells.is_empty() {
        return Err(MeshError::NoBranch);
    }
    finish(skeleton, &tubes, &layout, assembled, factor, options)
}

fn blocks_along(lengths: &RadialLength, options: &MeshOptions<'_>) -> usize {
    (lengths.total() / options.layer).ceil().max(1.0) as usize
}

fn check_memory(
    layout: &Layout,
    lengths: &[Option<RadialLength>],
    options: &MeshOptions<'_>,
) -> Result<(), MeshError> {
    let along: usize = lengths.iter().flatten().map(|lengths| 5 * blocks_along(lengths, options)).sum();
    let at_nodes: usize = layout.clusters.iter().map(|cluster| 10 * cluster.ends.len() + 8).sum();
    let cells = (along + at_nodes) * options.parts.pow(3);
    let needed = cells.saturating_mul(BYTES_PER_CELL);
    let limit = options.limits.memory.unwrap_or(MOST_BYTES);
    if needed > limit {
        return Err(MeshError::Memory { cells, needed: needed.div_ceil(1 << 20), limit: limit >> 20 });
    }
    Ok(())
}

fn mesh_nodes(
    skeleton: &Skeleton,
    tubes: &[Tube],
    layout: &Layout,
    options: &MeshOptions<'_>,
    control: &Control,
) -> Result<Vec<Option<NodeMesh>>, MeshError> {
    let done = Mutex::new(0_usize);
    let count = layout.clusters.len();
    let nodes: Vec<Result<Option<NodeMesh>, MeshError>> = layout
        .clusters
        .par_iter()
        .zip(&layout.reach)
        .map(|(cluster, reach)| {
            if control.is_stopped() {
                return Err(MeshError::Stopped);
            }
            if cluster.ends.is_empty() {
                return Ok(None);
            }
            let node = mesh_node(cluster, tubes, reach, options.parts);
            if let (Some(observer), Ok(mut done)) = (options.progress, done.lock()) {
                *done += 1;
                let share = Some(*done as f64 / count as f64);
                if observer.progress(&Progress { doing: "meshing nodes", share }) == ControlFlow::Break(()) {
                    control.stop(StopReason::Cancelled);
                }
            }
            let quality = node.as_ref().map_or(f64::NEG_INFINITY, |node| node.quality);
            if quality > 0.0 {
                return Ok(node);
            }
            let sample = skeleton.samples()[cluster.samples[0]];
            Err(MeshError::Node { sample: sample.id, line: sample.line, arms: cluster.ends.len(), quality })
        })
        .collect();
    nodes.into_iter().collect()
}

/// A tube or node as a number; there are fewer than samples.
fn part(index: usize) -> i32 {
    i32::try_from(index).unwrap_or(i32::MAX)
}

/// The mesh while it grows.
struct Assembly {
    refinement: Refinement,
    positions: Vec<DVec3>,
    cells: Vec<[u32; 8]>,
    parts: Vec<i32>,
    /// For each cap its vertices, its tube, and whether it is at the first end.
    caps: Vec<(Vec<u32>, usize, bool)>,
    corners: u32,
}

impl Assembly {
    fn new(parts: usize) -> Self {
        Self {
            refinement: Refinement::new(parts),
            positions: Vec::new(),
            cells: Vec::new(),
            parts: Vec::new(),
            caps: Vec::new(),
            corners: 0,
        }
    }

    fn build(
        mut self,
        tubes: &[Tube],
        layout: &Layout,
        lengths: &[Option<RadialLength>],
        nodes: &[Option<NodeMesh>],
        options: &MeshOptions<'_>,
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
            let layers = blocks_along(lengths, options);
            // The section at an end: corners in the core and on the wall, and its side.
            let section = |end: usize| {
                span[end].arm.and_then(|(cluster, arm)| {
                    let section = nodes[cluster].as_ref()?.sections[arm].clone();
                    let offset = offsets[cluster];
                    Some((section.inner.map(|c| c + offset), section.outer.map(|c| c + offset), section.side))
                })
            };
            self.add_tube(index, &tubes[index], lengths, layers, section(0), section(1), options.parts);
        }
        self
    }

    fn add_node(&mut self, index: usize, node: &NodeMesh) {
        let offset = self.corners;
        self.corners += node.corners as u32;
        let shift = |key: &Key| key.map(|(c, w)| if c == u32::MAX { (c, w) } else { (c + offset, w) });
        for (key, position) in node.refinement.keys.iter().zip(&node.positions) {
            let vertex = self.refinement.vertex(shift(key));
            debug_assert_eq!(vertex as usize, self.positions.len(), "nodes have no common vertices");
            self.positions.push(*position);
        }
        for block in &node.blocks {
            let lattice = self.refinement.lattice(block.map(|c| c + offset));
            let before = self.cells.len();
            self.cells.extend(self.refinement.cells(&lattice));
            self.parts.extend(std::iter::repeat_n(-1 - part(index), self.cells.len() - before));
        }
    }

    #[expect(clippy::too_many_arguments, reason = "a tube, where it is, and what it meets")]
    fn add_tube(
        &mut self,
        index: usize,
        tube: &Tube,
        lengths: &RadialLength,
        layers: usize,
        first: Option<([u32; 4], [u32; 4], DVec3)>,
        last: Option<([u32; 4], [u32; 4], DVec3)>,
        parts: usize,
    ) {
        let mut stations = stations(tube, lengths, layers * parts, first.map(|(_, _, side)| side));
        let last = last.map(|(inner, outer, side)| {
            let end = stations[stations.len() - 1];
            // The other node looks along the tube the other way.
            let across = end.sides[1].cross(end.sides[0]).cross(side);
            let corners = [0, 1, 2, 3].map(|k| {
                let angle = std::f64::consts::FRAC_PI_4 * f64::from(2 * k + 1);
                side * libm::cos(angle) + across * libm::sin(angle)
            });
            let (start, _) = twist(&mut stations, corners);
            let turn = |c: [u32; 4]| [0, 1, 2, 3].map(|k| c[(start + 4 - k) % 4]);
            (turn(inner), turn(outer))
        });
        let mut below = first.map_or_else(|| self.new_section(), |(inner, outer, _)| [inner, outer]);
        if first.is_none() {
            let vertices = self.cap(below, parts, &stations[0]);
            self.caps.push((vertices, index, true));
        }
        for layer in 0..layers {
            let above = match last {
                Some((inner, outer)) if layer + 1 == layers => [inner, outer],
                _ => self.new_section(),
            };
            if layer + 1 == layers && last.is_none() {
                let vertices = self.cap(above, parts, &stations[layers * parts]);
                self.caps.push((vertices, index, false));
            }
            let mut blocks = Vec::with_capacity(5);
            layer_of(&mut blocks, below, above);
            for block in blocks {
                let lattice = self.refinement.lattice(block);
                for vertex in self.positions.len()..self.refinement.keys.len() {
                    let (mut inner, mut outer, mut up) = ([0.0; 4], [0.0; 4], 0.0);
                    for (corner, weight) in weights(&self.refinement.keys[vertex]) {
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
                    self.positions.push(station.at(place_in_disc(inner, outer).0));
                }
                let before = self.cells.len();
                self.cells.extend(self.refinement.cells(&lattice));
                self.parts.extend(std::iter::repeat_n(part(index), self.cells.len() - before));
            }
            below = above;
        }
    }

    fn new_section(&mut self) -> [[u32; 4]; 2] {
        let base = self.corners;
        self.corners += 8;
        [[0, 1, 2, 3].map(|k| base + k), [4, 5, 6, 7].map(|k| base + k)]
    }

    /// The vertices of a flat end, made now.
    fn cap(&mut self, [inner, outer]: [[u32; 4]; 2], parts: usize, station: &Station) -> Vec<u32> {
        // A layer without height: its lattice names every vertex of the section.
        let mut blocks = Vec::with_capacity(5);
        layer_of(&mut blocks, [inner, outer], [inner, outer]);
        let mut vertices = Vec::new();
        for block in blocks {
            let quad = [block[0], block[1], block[2], block[3]];
            for j in 0..=parts {
                for i in 0..=parts {
                    let mut key: Key = [(u32::MAX, 0); 8];
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
                        self.positions.push(station.at(place_in_disc(in_core, on_wall).0));
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

fn finish(
    skeleton: &Skeleton,
    tubes: &[Tube],
    layout: &Layout,
    assembly: Assembly,
    factor: f64,
    options: &MeshOptions<'_>,
) -> Result<NeuronMesh, MeshError> {
    let Assembly { positions, cells, parts, caps, .. } = assembly;
    let mesh = HexMesh::new(positions, cells)?;
    let faces = Faces::new(&mesh)?;
    let least = mesh
        .cells()
        .par_iter()
        .map(|&cell| scaled_jacobian(&mesh.corners(cell)))
        .reduce(|| f64::INFINITY, |a, b| if a < b { a } else { b });
    let certified = mesh.cells().par_iter().all(|&cell| certify(&mesh.corners(cell)) == Jacobian::Positive);
    let mut cap_of = vec![0_u32; mesh.positions().len()];
    for (k, (vertices, ..)) in caps.iter().enumerate() {
        for &v in vertices {
            cap_of[v as usize] = k as u32 + 1;
        }
    }
    let labels: Vec<u32> = faces
        .boundary()
        .iter()
        .map(|face| {
            let [a, b, c, d] = face.vertices.map(|v| cap_of[v as usize]);
            if a == b && b == c && c == d { a } else { 0 }
        })
        .collect();
    let caps: Vec<Cap> = caps
        .iter()
        .map(|&(_, tube, first)| {
            let tube = &tubes[tube];
            let node = tube.nodes[usize::from(!first)];
            let s = if first { 0.0 } else { tube.length() };
            let (centre, radius) = tube.at(s);
            let tangent = tube.tangent(s);
            Cap {
                sample: skeleton.samples()[node].id,
                is_root: skeleton.parent(node).is_none(),
                centre,
                normal: if first { -tangent } else { tangent },
                radius: radius / factor,
            }
        })
        .collect();
    let left_out = layout
        .dropped
        .iter()
        .map(|&t| {
            let [a, b] = tubes[t].nodes.map(|node| skeleton.samples()[node].id);
            format!(
                "the branch from sample {a} to {b}, {:.4} long, ends too near to its node",
                tubes[t].length()
            )
        })
        .collect();
    let surface_distance = if options.measure {
        surface_distance(skeleton, tubes, &mesh, &faces, &labels, factor)
    } else {
        None
    };
    let report = MeshReport {
        vertices: mesh.positions().len(),
        hexahedra: mesh.cells().len(),
        min_scaled_jacobian: least,
        certified,
        surface_distance,
        left_out,
    };
    Ok(NeuronMesh { mesh, faces, labels, caps, parts, report })
}
