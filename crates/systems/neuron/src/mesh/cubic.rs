//! Tricubic meshes of neurons.

use super::assembly::{Assembly, NodeBlocks};
use super::build::{Blocks, Cap, Effort, Parts, folded, labels, mean};
use super::cubic_node::{CubicNode, START, Unfolding, bend};
use super::distance::{Net, Wanted, wall_distance};
use super::linear::{Labelled, linear_shares};
use super::node::mesh_node;
use super::node_mesh::NodeMesh;
use super::options::{MeshError, MeshOptions, MeshReport, go_on};
use super::proof::CellProof;
use super::section::Section;
use crate::Skeleton;
use glam::DVec3;
use pompeiu_core::run::{Control, on_threads};
use pompeiu_volume::{
    BezierMesh, BoundaryFace, CellData, FACE_AXES, Faces, PointData, write_bezier_vtu, write_vtu,
};
use rayon::prelude::*;

/// A mesh of a neuron whose cells are tricubic: each block is one patch.
#[derive(Clone, Debug)]
pub struct CubicMesh {
    /// Control points and patches; if the report says so, every patch is proven to have a positive Jacobian.
    pub mesh: BezierMesh,
    /// The faces of patches.
    pub faces: Faces,
    /// For each boundary face 0 if it lies on the wall, and 1 + k if it lies on cap k.
    pub labels: Vec<u32>,
    /// The flat ends of tubes.
    pub caps: Vec<Cap>,
    /// The branch of each patch, in the order of the skeleton's tubes, or −1 − k at node k.
    pub parts: Vec<i32>,
    /// The report.
    pub report: MeshReport,
}

impl CubicMesh {
    /// The patches as a VTK XML unstructured grid, exactly as Bézier hexahedra or as 27 trilinear cells per patch, with the branch
    /// of each cell as cell data.
    ///
    /// # Errors
    /// Only allocation errors.
    pub fn vtu(&self, linear: bool) -> std::io::Result<Vec<u8>> {
        cubic_vtu(&self.mesh, linear.then_some(LINEAR_PARTS), &[], &[("branch", &self.branches())])
    }

    /// The branch of each patch as a number.
    pub fn branches(&self) -> Vec<f64> {
        self.parts.iter().map(|&part| f64::from(part)).collect()
    }
}

/// Trilinear cells along each axis of a patch, in files of trilinear cells.
pub(crate) const LINEAR_PARTS: usize = 3;

/// A file of tricubic cells, or of trilinear ones with this many along each axis; with the first components of vectors at control
/// points, and cell data.
pub(crate) fn cubic_vtu(
    mesh: &BezierMesh,
    linear: Option<usize>,
    fields: &[(&str, &[DVec3], usize)],
    cells: &[(&str, &[f64])],
) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let columns = |field: &[DVec3], components: usize| -> Vec<f64> {
        field.iter().flat_map(|v| v.to_array().into_iter().take(components)).collect()
    };
    let Some(parts) = linear else {
        let values: Vec<Vec<f64>> = fields.iter().map(|(_, field, n)| columns(field, *n)).collect();
        let points: Vec<PointData<'_>> = fields
            .iter()
            .zip(&values)
            .map(|(&(name, _, components), values)| CellData { name, values, components })
            .collect();
        let cells: Vec<CellData<'_>> =
            cells.iter().map(|&(name, values)| CellData { name, values, components: 1 }).collect();
        write_bezier_vtu(&mut bytes, mesh, &points, &cells)?;
        return Ok(bytes);
    };
    let raw: Vec<&[DVec3]> = fields.iter().map(|(_, field, _)| *field).collect();
    let wrong = |error| std::io::Error::new(std::io::ErrorKind::InvalidInput, error);
    let (fine, fine_fields) = mesh.subdivided(parts, &raw).map_err(wrong)?;
    // Corners are points of the field; other control points are omitted.
    let corners = fine.corner_mesh().map_err(wrong)?;
    let mut number = vec![u32::MAX; corners.positions().len()];
    let mut kept = Vec::new();
    for &v in corners.cells().iter().flatten() {
        if number[v as usize] == u32::MAX {
            number[v as usize] = kept.len() as u32;
            kept.push(v as usize);
        }
    }
    let pick = |field: &[DVec3]| kept.iter().map(|&v| field[v]).collect::<Vec<_>>();
    let list = corners.cells().iter().map(|cell| cell.map(|v| number[v as usize])).collect();
    let plain = pompeiu_volume::HexMesh::new(pick(corners.positions()), list).map_err(wrong)?;
    let values: Vec<Vec<f64>> =
        fields.iter().zip(&fine_fields).map(|((_, _, n), field)| columns(&pick(field), *n)).collect();
    let points: Vec<PointData<'_>> = fields
        .iter()
        .zip(&values)
        .map(|(&(name, _, components), values)| CellData { name, values, components })
        .collect();
    let per_cell = parts.pow(3);
    let repeated: Vec<Vec<f64>> = cells
        .iter()
        .map(|(_, values)| values.iter().flat_map(|&x| std::iter::repeat_n(x, per_cell)).collect())
        .collect();
    let cells: Vec<CellData<'_>> = cells
        .iter()
        .zip(&repeated)
        .map(|(&(name, _), values)| CellData { name, values, components: 1 })
        .collect();
    write_vtu(&mut bytes, &plain, &points, &cells)?;
    Ok(bytes)
}

/// Meshes a neuron with tricubic cells: five patches per section, and the core complexes at nodes.
///
/// # Shapes and units
/// Lengths in micrometres. The rim of a section consists of four cubic arcs, whose distance from a circle is below 3e-4 of the
/// radius; sections have the area of their discs. [`MeshOptions::parts`] is not used.
/// # Accuracy
/// [`MeshReport::certified`] and the bounds of [`MeshReport::wall`] are proven, rounding included.
/// # Errors
/// [`MeshError`].
/// # Cost
/// Linear in the length of the tree in radii; about 0.6 s per node, in parallel.
/// # Source
/// The untangling energy: `garanzha_foldover_2021`. Bernstein coefficients of determinants: `johnen_hexahedra_2017`.
pub fn cubic_neuron(skeleton: &Skeleton, options: &MeshOptions<'_>) -> Result<CubicMesh, MeshError> {
    options.check()?;
    on_threads(options.limits.threads, || mesh(skeleton, options))
}

fn mesh(skeleton: &Skeleton, options: &MeshOptions<'_>) -> Result<CubicMesh, MeshError> {
    let control = Control::start(&options.limits);
    let section = Section::new();
    let blocks = (section.area_factor(), Blocks::Cubic);
    let parts = Parts::without_folded(skeleton, options, blocks, &control)?;
    let (parts, bent) = unfolded(skeleton, parts, &section, (options, &control))?;
    let nodes: Vec<Option<NodeBlocks<'_>>> = parts
        .nodes
        .iter()
        .zip(&bent)
        .map(|(node, bent)| {
            let bent = bent.as_ref()?;
            let node = bent.other.as_ref().or(node.as_ref())?;
            Some(NodeBlocks { node, refinement: &bent.cells.refinement, positions: &bent.cells.points })
        })
        .collect();
    let assembled = Assembly::new(3, Some(&section)).build(
        &parts.tubes,
        &parts.layout,
        &parts.lengths,
        &nodes,
        options.layer,
    );
    if assembled.lattices.is_empty() {
        return Err(MeshError::NoBranch);
    }
    finish(skeleton, &parts, assembled, (options, &control))
}

/// Nodes with tricubic cells, without branches with which they stay folded.
fn unfolded(
    skeleton: &Skeleton,
    mut parts: Parts,
    section: &Section,
    (options, control): (&MeshOptions<'_>, &Control),
) -> Result<(Parts, Vec<Option<BentNode>>), MeshError> {
    loop {
        let indices = (0..parts.nodes.len()).into_par_iter();
        let bent: Vec<Option<BentNode>> =
            indices.map(|index| bent(&parts, index, (section, options.within), control)).collect();
        go_on(control)?;
        let quality =
            |node: &Option<BentNode>| node.as_ref().map_or(f64::INFINITY, |node| node.cells.quality);
        let folded = folded(skeleton, parts.layout.clusters.iter().zip(bent.iter().map(quality)));
        if folded.is_empty() {
            return Ok((parts, bent));
        }
        let error = || MeshError::Nodes(folded.iter().map(|(_, node)| *node).collect());
        parts = parts.cut_at(skeleton, &folded).ok_or_else(error)?;
        parts.replace_nodes(skeleton, &parts.missing(), Effort::Best, (options, control))?;
    }
}

/// A node with tricubic cells.
struct BentNode {
    /// The complex that they fill, if it is not the usual one.
    other: Option<NodeMesh>,
    cells: CubicNode,
}

/// A node with tricubic cells; where they stay folded or their wall stays far from the cones, the better one of two: that of the usual complex, and
/// that of a complex whose trilinear cells follow the cones.
fn bent(
    parts: &Parts,
    index: usize,
    (section, within): (&Section, f64),
    control: &Control,
) -> Option<BentNode> {
    let node = parts.nodes[index].as_ref().filter(|_| !control.is_stopped())?;
    let (cluster, reach) = (&parts.layout.clusters[index], &parts.layout.reach[index]);
    let tubes = (&parts.tubes[..], parts.factor);
    let bend = |node: &NodeMesh, unfolding| {
        bend(cluster, tubes, reach, node, (section, within), (unfolding, control))
    };
    let mut best = BentNode { other: None, cells: bend(node, Unfolding::Little) };
    if best.cells.is_good || control.is_stopped() {
        return Some(best);
    }
    let following = mesh_node(cluster, tubes.0, reach, (START, Some(parts.factor)), control);
    if let Some(node) = following.filter(|node| node.quality > 0.0) {
        let cells = bend(&node, Unfolding::Much);
        if cells.fitness > best.cells.fitness {
            best = BentNode { other: Some(node), cells };
        }
    }
    if best.cells.fitness == f64::NEG_INFINITY && !control.is_stopped() {
        best = BentNode { other: None, cells: bend(node, Unfolding::Much) };
    }
    Some(best)
}

fn finish(
    skeleton: &Skeleton,
    parts: &Parts,
    assembly: Assembly<'_>,
    (options, control): (&MeshOptions<'_>, &Control),
) -> Result<CubicMesh, MeshError> {
    let Assembly { positions, lattices, blocks, caps, .. } = assembly;
    let cells: Vec<[u32; 64]> = lattices.iter().map(|lattice| std::array::from_fn(|k| lattice[k])).collect();
    let mesh = BezierMesh::new(positions, cells)?;
    let corners = mesh.corner_mesh()?;
    let faces = Faces::new(&corners)?;
    let proof = CellProof::of_patches(&mesh, control)?;
    let labels = labels(&faces, &caps, mesh.points().len());
    let mut vertices: Vec<u32> = corners.cells().iter().flatten().copied().collect();
    vertices.sort_unstable();
    vertices.dedup();
    go_on(control)?;
    let caps = parts.caps(skeleton, &caps);
    let wall = if options.measure {
        let ends: Vec<_> = caps.iter().map(|cap| (cap.sample, cap.normal)).collect();
        let walls = faces.boundary().iter().zip(&labels).filter(|(_, label)| **label == 0);
        let patches: Vec<_> = walls.map(|(face, _)| patch(&mesh, face)).collect();
        let wanted = (options.within, Wanted::Enclosed);
        wall_distance(options.reference.unwrap_or(skeleton), &ends, &patches, wanted, control)
    } else {
        None
    };
    go_on(control)?;
    let report = MeshReport {
        vertices: vertices.len(),
        hexahedra: mesh.cells().len(),
        min_scaled_jacobian: proof.least,
        certified: proof.is_complete(),
        unproven: proof.places(Some(skeleton), |cell| mean(&corners.corners(corners.cells()[cell]))),
        linear: Some(linear_shares(&mesh, Labelled { faces: &faces, labels: &labels }, LINEAR_PARTS, None)),
        wall,
        left_out: parts.left_out(skeleton),
        moved: parts.moved(skeleton),
    };
    Ok(CubicMesh { mesh, faces, labels, caps, parts: blocks, report })
}

/// A boundary face as a patch.
fn patch(mesh: &BezierMesh, face: &BoundaryFace) -> Net<4> {
    let points = mesh.control(face.cell as usize);
    let (axis, side, along) = FACE_AXES[face.place as usize];
    let strides = [1, 4, 16];
    let at =
        |i: usize, j: usize| points[3 * side * strides[axis] + i * strides[along[0]] + j * strides[along[1]]];
    Net { points: std::array::from_fn(|i| std::array::from_fn(|j| at(i, j))) }
}
