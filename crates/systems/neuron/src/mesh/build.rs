//! From a skeleton to the mesh.

use super::assembly::{Assembly, NodeBlocks};
use super::cluster::Cluster;
use super::cubic_node::START;
use super::cut::Cut;
use super::distance::{Net, Wanted, wall_distance};
use super::folds::Division;
use super::layout::{Layout, Span, layout};
use super::node::{mesh_node, sketch_node};
use super::node_mesh::NodeMesh;
use super::options::{FoldedNode, MeshError, MeshOptions, MeshReport, go_on};
use super::proof::CellProof;
use super::sweep::RadialLength;
use super::tube::{Tube, tubes};
use crate::Skeleton;
use glam::DVec3;
use pompeiu_core::run::{Control, Progress, StopReason};
use pompeiu_volume::{BoundaryFace, CellData, Faces, HexMesh, write_vtu};
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::Mutex;

/// A mesh of a neuron.
#[derive(Clone, Debug)]
pub struct NeuronMesh {
    /// Vertices and cells; if the report says so, every cell is proven to have a positive Jacobian.
    pub mesh: HexMesh,
    /// Its faces.
    pub faces: Faces,
    /// For each boundary face 0 if it lies on the wall, and 1 + k if it lies on cap k.
    pub labels: Vec<u32>,
    /// The flat ends of tubes.
    pub caps: Vec<Cap>,
    /// The branch of each cell, in the order of the skeleton's tubes, or −1 − k at node k.
    pub parts: Vec<i32>,
    /// The report.
    pub report: MeshReport,
}

impl NeuronMesh {
    /// The mesh as a VTK XML unstructured grid, with the branch of each cell as cell data.
    ///
    /// # Errors
    /// Only allocation errors.
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
        let columns = concentrations(values);
        let data = columns.each_ref().map(|(name, values)| CellData { name, values, components: 1 });
        let mut bytes = Vec::new();
        write_vtu(&mut bytes, &self.mesh, &[], &data)?;
        Ok(bytes)
    }
}

/// Concentrations of cells as columns of a file, their sum first.
pub(crate) fn concentrations(values: &[[f64; 3]]) -> [(&'static str, Vec<f64>); 4] {
    let column = |kind: usize| values.iter().map(|v| v[kind]).collect();
    let total = values.iter().map(|v| v.iter().sum()).collect();
    [("total", total), ("free", column(0)), ("plus", column(1)), ("minus", column(2))]
}

/// The flat end of a tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cap {
    /// The sample, by its number in the file.
    pub sample: i64,
    /// Whether the sample is a root: the inlet by default.
    pub is_root: bool,
    /// Its centre.
    pub centre: DVec3,
    /// Its unit normal, outwards.
    pub normal: DVec3,
    /// Radius of the tube in the skeleton.
    pub radius: f64,
}

impl Cap {
    /// The index of the cap at a sample, or else the samples that have one.
    pub(crate) fn at(caps: &[Self], sample: i64) -> Result<u32, String> {
        caps.iter().position(|cap| cap.sample == sample).map(|k| k as u32).ok_or_else(|| {
            let ends: Vec<String> = caps.iter().map(|cap| cap.sample.to_string()).collect();
            ends.join(", ")
        })
    }

    /// The index of the first cap at a root.
    pub(crate) fn of_root(caps: &[Self]) -> Option<u32> {
        caps.iter().position(|cap| cap.is_root).map(|k| k as u32)
    }
}

/// Memory per cell while faces are computed and files are written, in bytes.
const BYTES_PER_CELL: usize = 1200;

/// Largest memory if no limit is given, in bytes.
const MOST_BYTES: usize = 8 << 30;

/// The factor for radii at which a regular polygon has the area of its circle.
pub(super) fn area_factor(sides: usize) -> f64 {
    let angle = std::f64::consts::TAU / sides as f64;
    (angle / libm::sin(angle)).sqrt()
}

/// The tubes and nodes of trilinear cells, without branches with which they would be folded.
pub(super) fn unfolded_parts(
    skeleton: &Skeleton,
    options: &MeshOptions<'_>,
    control: &Control,
) -> Result<Parts, MeshError> {
    let factor = area_factor(4 * options.parts);
    Parts::without_folded(skeleton, options, (factor, Blocks::Linear(options.parts)), control)
}

/// The tubes and nodes of trilinear cells.
pub(super) fn linear_parts(
    skeleton: &Skeleton,
    options: &MeshOptions<'_>,
    effort: Effort,
    control: &Control,
) -> Result<Parts, MeshError> {
    let factor = area_factor(4 * options.parts);
    Parts::new(skeleton, options, (factor, Blocks::Linear(options.parts)), effort, control)
}

/// The mesh of tubes and nodes.
pub(super) fn assembled(
    skeleton: &Skeleton,
    parts: &Parts,
    wanted: Option<Wanted>,
    (options, control): (&MeshOptions<'_>, &Control),
) -> Result<NeuronMesh, MeshError> {
    let nodes: Vec<Option<NodeBlocks<'_>>> = parts
        .nodes
        .iter()
        .map(|node| {
            let node = node.as_ref()?;
            Some(NodeBlocks { node, refinement: &node.refinement, positions: &node.positions })
        })
        .collect();
    let assembled = Assembly::new(options.parts, None).build(
        &parts.tubes,
        &parts.layout,
        &parts.lengths,
        &nodes,
        options.layer,
    );
    if assembled.lattices.is_empty() {
        return Err(MeshError::NoBranch);
    }
    finish(skeleton, parts, assembled, wanted, (options, control))
}

/// How well nodes are meshed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Effort {
    /// As well as they can be.
    Best,
    /// Until they are valid and near the cones; as well as they can be where that is not found at once.
    Enough,
    /// The same, but not at all where that is not found at once.
    Sketch,
}

/// The subdivision of the blocks of nodes.
#[derive(Clone, Copy)]
pub(super) enum Blocks {
    /// So many trilinear cells along each edge.
    Linear(usize),
    /// The initial cells of tricubic ones, which follow the wall by themselves.
    Cubic,
}

/// Tubes and the meshed nodes between them.
pub(super) struct Parts {
    pub(super) factor: f64,
    pub(super) tubes: Vec<Tube>,
    pub(super) layout: Layout,
    pub(super) lengths: Vec<Option<RadialLength>>,
    pub(super) nodes: Vec<Option<NodeMesh>>,
    /// Parts of the blocks of nodes along each edge, and the factor if their walls are drawn to the cones.
    of_nodes: (usize, Option<f64>),
    division: Division,
    /// Tubes that are left out because cells of nodes would be folded.
    cut: Cut,
}

impl Parts {
    /// Multiplies radii by the factor, and subdivides the blocks of nodes.
    pub(super) fn new(
        skeleton: &Skeleton,
        options: &MeshOptions<'_>,
        (factor, blocks): (f64, Blocks),
        effort: Effort,
        control: &Control,
    ) -> Result<Self, MeshError> {
        let mut parts = Self::planned(skeleton, options, (factor, blocks))?;
        parts.replace_nodes(skeleton, &parts.missing(), effort, (options, control))?;
        Ok(parts)
    }

    /// The same without branches with which the cells of nodes stay folded, unless nothing would be left.
    pub(super) fn without_folded(
        skeleton: &Skeleton,
        options: &MeshOptions<'_>,
        (factor, blocks): (f64, Blocks),
        control: &Control,
    ) -> Result<Self, MeshError> {
        let mut parts = Self::planned(skeleton, options, (factor, blocks))?;
        let mut first = None;
        loop {
            match parts.replace_nodes(skeleton, &parts.missing(), Effort::Best, (options, control)) {
                Err(MeshError::Nodes(nodes)) => {
                    let error = first.get_or_insert(MeshError::Nodes(nodes)).clone();
                    parts = parts.cut_at(skeleton, &parts.folded(skeleton)).ok_or(error)?;
                }
                other => return other.map(|_| parts),
            }
        }
    }

    /// Tubes and the layout of nodes, none of which is meshed.
    fn planned(
        skeleton: &Skeleton,
        options: &MeshOptions<'_>,
        (factor, blocks): (f64, Blocks),
    ) -> Result<Self, MeshError> {
        if let Some(sample) = skeleton.samples().iter().find(|sample| sample.radius <= 0.0) {
            return Err(MeshError::ZeroRadius { sample: sample.id, line: sample.line });
        }
        let (tubes, layout, division) = arranged(skeleton, factor);
        let lengths = lengths(&tubes, &layout);
        check_memory(&layout, &lengths, options)?;
        let of_nodes = match blocks {
            // One face between two corners of a section is beyond the tolerance by itself.
            Blocks::Linear(parts) => (parts, (parts > 1).then_some(factor)),
            Blocks::Cubic => (START, None),
        };
        let nodes = vec![None; layout.clusters.len()];
        Ok(Self { factor, tubes, layout, lengths, nodes, of_nodes, division, cut: Cut::default() })
    }

    /// The nodes that are not meshed.
    pub(super) fn missing(&self) -> Vec<usize> {
        (0..self.nodes.len()).filter(|node| self.nodes[*node].is_none()).collect()
    }

    /// The nodes whose cells are folded.
    fn folded(&self, skeleton: &Skeleton) -> Vec<(usize, FoldedNode)> {
        let quality =
            |index: usize| self.nodes[index].as_ref().map_or(f64::NEG_INFINITY, |node| node.quality);
        folded(
            skeleton,
            self.layout.clusters.iter().enumerate().map(|(index, cluster)| (cluster, quality(index))),
        )
    }

    /// These tubes without one arm at each of some nodes, and what is beyond it. Nodes that stay as they are keep their meshes, the others have
    /// none. `None` if nothing is left.
    pub(super) fn cut_at(&self, skeleton: &Skeleton, nodes: &[(usize, FoldedNode)]) -> Option<Self> {
        let of_clusters: Vec<_> =
            nodes.iter().map(|(index, node)| (&self.layout.clusters[*index], *node)).collect();
        let cut = self.cut.at_nodes(&self.tubes, &of_clusters);
        let (tubes, layout) = arranged_with(skeleton, self.factor, self.division, &cut);
        if layout.has_nothing() {
            return None;
        }
        let kept = |(index, cluster): (usize, &Cluster)| {
            let is_same = |other: &usize| {
                let (before, reach) = (&self.layout.clusters[*other], &self.layout.reach[*other]);
                before.samples == cluster.samples
                    && before.ends == cluster.ends
                    && *reach == layout.reach[index]
            };
            let other = (0..self.nodes.len()).find(is_same)?;
            self.nodes[other].clone().filter(|_| nodes.iter().all(|(node, _)| *node != other))
        };
        let meshed = layout.clusters.iter().enumerate().map(kept).collect();
        let lengths = lengths(&tubes, &layout);
        let Self { factor, of_nodes, division, .. } = *self;
        Some(Self { factor, tubes, layout, lengths, nodes: meshed, of_nodes, division, cut })
    }

    /// Meshes nodes, given by their indices, in the place of what they were. Returns whether there are any new ones.
    pub(super) fn replace_nodes(
        &mut self,
        skeleton: &Skeleton,
        which: &[usize],
        effort: Effort,
        (options, control): (&MeshOptions<'_>, &Control),
    ) -> Result<bool, MeshError> {
        let found = self.mesh_nodes(which, effort, (options, control))?;
        let mut is_new = false;
        for (&index, node) in which.iter().zip(found) {
            is_new |= node.is_some();
            if node.is_some() || effort != Effort::Sketch {
                self.nodes[index] = node;
            }
        }
        let quality = |node: &Option<NodeMesh>| node.as_ref().map_or(f64::NEG_INFINITY, |node| node.quality);
        let pairs = self.layout.clusters.iter().zip(&self.nodes);
        refuse_folded(skeleton, pairs.map(|(cluster, node)| (cluster, quality(node))))?;
        Ok(is_new)
    }

    fn mesh_nodes(
        &self,
        which: &[usize],
        effort: Effort,
        (options, control): (&MeshOptions<'_>, &Control),
    ) -> Result<Vec<Option<NodeMesh>>, MeshError> {
        let done = Mutex::new(0_usize);
        let mesh = |&index: &usize| {
            go_on(control)?;
            let (cluster, reach) = (&self.layout.clusters[index], &self.layout.reach[index]);
            if cluster.ends.is_empty() {
                return Ok(None);
            }
            let sketch = if effort == Effort::Best {
                None
            } else {
                sketch_node(cluster, &self.tubes, reach, self.of_nodes, options.within, control)
            };
            let best = || mesh_node(cluster, &self.tubes, reach, self.of_nodes, control);
            let node = if effort == Effort::Sketch { sketch } else { sketch.or_else(best) };
            if let (Some(observer), Ok(mut done)) = (options.progress, done.lock()) {
                *done += 1;
                let share = Some(*done as f64 / which.len() as f64);
                if observer.progress(&Progress { doing: "meshing nodes", share }) == ControlFlow::Break(()) {
                    control.stop(StopReason::Cancelled);
                }
            }
            // A mesh that was stopped early may be folded.
            go_on(control)?;
            Ok(node)
        };
        let nodes: Vec<Result<Option<NodeMesh>, MeshError>> = which.par_iter().map(mesh).collect();
        nodes.into_iter().collect()
    }

    /// Sentences about branches whose axis is farther from the samples than the tolerance.
    pub(super) fn moved(&self, skeleton: &Skeleton) -> Vec<String> {
        let sentence = |tube: &Tube| {
            let [a, b] = tube.nodes.map(|node| skeleton.samples()[node].id);
            format!(
                "the branch from sample {a} to {b}: its axis is up to {:.2} radii from the samples",
                tube.moved
            )
        };
        self.tubes.iter().filter(|tube| tube.moved > 0.0).map(sentence).collect()
    }

    /// The flat ends.
    pub(super) fn caps(&self, skeleton: &Skeleton, caps: &[(Vec<u32>, usize, bool)]) -> Vec<Cap> {
        let cap = |&(_, tube, first): &(Vec<u32>, usize, bool)| {
            let tube = &self.tubes[tube];
            let node = tube.nodes[usize::from(!first)];
            let s = if first { 0.0 } else { tube.length() };
            let (centre, radius) = tube.at(s);
            let tangent = tube.tangent(s);
            Cap {
                sample: skeleton.samples()[node].id,
                is_root: skeleton.parent(node).is_none(),
                centre,
                normal: if first { -tangent } else { tangent },
                radius: radius / self.factor,
            }
        };
        caps.iter().map(cap).collect()
    }

    /// A sentence about a root that is left out, if no other one is the inlet of a flow.
    fn without_inlet(&self, skeleton: &Skeleton) -> Option<String> {
        let is_left_out = |root: usize| {
            let mut tubes = self.tubes.iter().enumerate().filter(|(_, tube)| tube.nodes.contains(&root));
            tubes.all(|(tube, _)| self.layout.dropped.contains(&tube))
        };
        let mut ends = skeleton.roots().filter(|root| skeleton.degree(*root) == 1);
        let first = ends.next().filter(|root| is_left_out(*root) && ends.all(is_left_out))?;
        let sample = skeleton.samples()[first].id;
        Some(format!(
            "the root, sample {sample}, is left out, so that flow has no inlet: name the sample of another end for it"
        ))
    }

    /// Sentences about branches that are not meshed.
    pub(super) fn left_out(&self, skeleton: &Skeleton) -> Vec<String> {
        let sentence = |&t: &usize| {
            let [a, b] = self.tubes[t].nodes.map(|node| skeleton.samples()[node].id);
            let why = match self.cut.node(t) {
                Some(node) => format!("is left out: {node}"),
                None if self.cut.contains(t) => "lies beyond a branch that is left out".to_owned(),
                None => "ends too near to its node".to_owned(),
            };
            format!("the branch from sample {a} to {b}, {:.4} long, {why}", self.tubes[t].length())
        };
        let mut found: Vec<String> = self.layout.dropped.iter().map(sentence).collect();
        found.extend(self.without_inlet(skeleton));
        found
    }
}

/// The tubes and the layout of the nodes between them. Where the corners of a tube have no room beside its nodes, its samples are moved. Branches
/// are divided where they turn back, unless that leaves nothing to mesh.
pub(super) fn arranged(skeleton: &Skeleton, factor: f64) -> (Vec<Tube>, Layout, Division) {
    let with = |division| {
        let (tubes, layout) = arranged_with(skeleton, factor, division, &Cut::default());
        (tubes, layout, division)
    };
    let found = with(Division::AtFolds);
    if found.1.has_nothing() { with(Division::None) } else { found }
}

fn arranged_with(skeleton: &Skeleton, factor: f64, division: Division, cut: &Cut) -> (Vec<Tube>, Layout) {
    let mut is_moved = Vec::new();
    loop {
        let tubes = tubes(skeleton, (factor, division), &is_moved);
        let layout = layout(skeleton, &tubes, factor, cut);
        is_moved.resize(tubes.len(), false);
        let mut is_done = true;
        for ((span, tube), is_moved) in layout.spans.iter().zip(&tubes).zip(&mut is_moved) {
            if let Some([a, b]) = span
                && !tube.has_room(a.at, b.at)
            {
                (*is_moved, is_done) = (true, false);
            }
        }
        if is_done {
            return (tubes, layout);
        }
    }
}

/// The lengths in radii of the tubes' own meshes.
fn lengths(tubes: &[Tube], layout: &Layout) -> Vec<Option<RadialLength>> {
    let length =
        |(span, tube): (&Option<[Span; 2]>, &Tube)| span.map(|[a, b]| RadialLength::new(tube, a.at, b.at));
    layout.spans.iter().zip(tubes).map(length).collect()
}

/// For each boundary face 0 if it lies on the wall, and 1 + k if it lies on cap k.
pub(super) fn labels(faces: &Faces, caps: &[(Vec<u32>, usize, bool)], vertices: usize) -> Vec<u32> {
    let mut cap_of = vec![0_u32; vertices];
    for (k, (vertices, ..)) in caps.iter().enumerate() {
        for &v in vertices {
            cap_of[v as usize] = k as u32 + 1;
        }
    }
    let label = |vertices: [u32; 4]| {
        let [a, b, c, d] = vertices.map(|v| cap_of[v as usize]);
        if a == b && b == c && c == d { a } else { 0 }
    };
    faces.boundary().iter().map(|face| label(face.vertices)).collect()
}

fn check_memory(
    layout: &Layout,
    lengths: &[Option<RadialLength>],
    options: &MeshOptions<'_>,
) -> Result<(), MeshError> {
    let along: usize = lengths.iter().flatten().map(|lengths| 5 * lengths.blocks_along(options.layer)).sum();
    let at_nodes: usize = layout.clusters.iter().map(|cluster| 10 * cluster.ends.len() + 8).sum();
    let cells = (along + at_nodes) * options.parts.pow(3);
    let needed = cells.saturating_mul(BYTES_PER_CELL);
    let limit = options.limits.memory.unwrap_or(MOST_BYTES);
    if needed > limit {
        return Err(MeshError::Memory { cells, needed: needed.div_ceil(1 << 20), limit: limit >> 20 });
    }
    Ok(())
}

/// An error that names the nodes whose cells are folded.
fn refuse_folded<'c>(
    skeleton: &Skeleton,
    nodes: impl Iterator<Item = (&'c Cluster, f64)>,
) -> Result<(), MeshError> {
    let folded: Vec<_> = folded(skeleton, nodes).into_iter().map(|(_, node)| node).collect();
    if folded.is_empty() { Ok(()) } else { Err(MeshError::Nodes(folded)) }
}

/// The nodes whose cells are folded, by their indices.
pub(super) fn folded<'c>(
    skeleton: &Skeleton,
    nodes: impl Iterator<Item = (&'c Cluster, f64)>,
) -> Vec<(usize, FoldedNode)> {
    let node = |(index, (cluster, quality)): (usize, (&Cluster, f64))| {
        let sample = skeleton.samples()[cluster.samples[0]];
        (index, FoldedNode { sample: sample.id, line: sample.line, arms: cluster.ends.len(), quality })
    };
    let folded =
        nodes.enumerate().filter(|(_, (cluster, quality))| *quality <= 0.0 && !cluster.ends.is_empty());
    folded.map(node).collect()
}

/// The mean of the corners of a cell.
pub(super) fn mean(corners: &[DVec3; 8]) -> DVec3 {
    corners.iter().sum::<DVec3>() / 8.0
}

fn finish(
    skeleton: &Skeleton,
    parts: &Parts,
    assembly: Assembly<'_>,
    wanted: Option<Wanted>,
    (options, control): (&MeshOptions<'_>, &Control),
) -> Result<NeuronMesh, MeshError> {
    go_on(control)?;
    let Assembly { refinement, positions, lattices, blocks, caps, .. } = assembly;
    let cells: Vec<[u32; 8]> =
        lattices.iter().flat_map(|lattice| refinement.cells(lattice).collect::<Vec<_>>()).collect();
    let per_block = options.parts.pow(3);
    let mesh = HexMesh::new(positions, cells)?;
    let faces = Faces::new(&mesh)?;
    go_on(control)?;
    let proof = CellProof::of_cells(&mesh, control)?;
    let labels = labels(&faces, &caps, mesh.positions().len());
    let caps = parts.caps(skeleton, &caps);
    let wall = wanted.and_then(|wanted| {
        let ends: Vec<_> = caps.iter().map(|cap| (cap.sample, cap.normal)).collect();
        let walls = faces.boundary().iter().zip(&labels).filter(|(_, label)| **label == 0);
        let patch = |(face, _): (&BoundaryFace, _)| {
            let [a, b, c, d] = face.vertices.map(|v| mesh.positions()[v as usize]);
            Net { points: [[a, b], [d, c]] }
        };
        let patches: Vec<_> = walls.map(patch).collect();
        let reference = options.reference.unwrap_or(skeleton);
        wall_distance(reference, &ends, &patches, (options.within, wanted), control)
    });
    go_on(control)?;
    let report = MeshReport {
        vertices: mesh.positions().len(),
        hexahedra: mesh.cells().len(),
        min_scaled_jacobian: proof.least,
        certified: proof.is_complete(),
        unproven: proof.places(Some(skeleton), |cell| mean(&mesh.corners(mesh.cells()[cell]))),
        linear: None,
        wall,
        left_out: parts.left_out(skeleton),
        moved: parts.moved(skeleton),
    };
    let parts = blocks.iter().flat_map(|&block| std::iter::repeat_n(block, per_block)).collect();
    Ok(NeuronMesh { mesh, faces, labels, caps, parts, report })
}
