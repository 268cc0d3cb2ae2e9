//! Simplification: fewer faces while the surface stays within a distance.

use super::collapses::Collapses;
use super::connectivity::DynamicMesh;
use super::features::{Curves, FeatureError};
use super::marked::Marked;
use super::places::Places;
use super::schedule;
use super::simplify_options::{Effort, Simplified, SimplifyError, SimplifyOptions, SimplifyTarget};
use super::simplify_run::Run;
use super::triangle::area_vector;
use glam::DVec3;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::mesh::repair::{RepairOptions, repair};
use pompeiu_core::run::Instant;
use pompeiu_core::run::{RunContext, on_threads};
use pompeiu_core::spatial::bvh::{Bvh, Slot};
use pompeiu_core::{FaceId, TriMesh};

/// Simplifies a mesh by quadric-error edge collapses.
///
/// # Shapes and units
/// An oriented manifold mesh, with or without boundary, of any number of components; lengths in its unit. With
/// [`repair`](SimplifyOptions::repair) any mesh: it is repaired first, which cuts faces apart where they form no manifold, and the
/// distance is measured from the mesh as it was.
/// # Accuracy
/// With [`SimplifyTarget::Within`] every collapse is tested on both sides: each new face lies near the input, and each face of the
/// input near the new faces. These tests steer only. What is returned was measured by
/// [`symmetric_hausdorff`](pompeiu_hausdorff::symmetric_hausdorff), and its upper end is at most the distance asked for, rounding included.
/// With [`SimplifyTarget::Faces`] the distance is not asked for, and measured in the same way. [`Effort::Best`] makes it small: it is
/// the better of two results, one by quadric errors alone, one within distances that grow by a tenth until the number is reached.
/// Where [`intersections`](SimplifyOptions::intersections) are refused, no more pairs of faces intersect than in the input: where a result
/// has more it is made again, and no collapse makes faces intersect that did not.
/// # Limits
/// A number of faces may not be reached: the topology stays, and faces are not turned over. [`Simplified::refusals`] says why.
/// The number of faces is not the least possible one: collapses are chosen greedily. The distance between boundary *curves* is
/// not bounded: a thin spike in the plane of a sheet can be cut off where the rest of the sheet is near it. With
/// [`features`](SimplifyOptions::features) curves stay curves and their corners stay where they are, yet how far a curve moves between its
/// corners is bounded by the surfaces on both sides only.
/// # Errors
/// [`SimplifyError`].
/// # Cost
/// O(m log m) collapses for m faces; the tests of one collapse grow with the faces of the input that it affects. Some 400 bytes
/// for each face of the input.
/// # Source
/// Quadric errors of `garland_surface_1997`; the two-sided test of faces against faces is ours.
/// # Example
/// ```
/// use pompeiu_core::mesh::shapes::icosphere;
/// use pompeiu_remesh::{SimplifyOptions, SimplifyTarget, simplify};
///
/// let sphere = icosphere(1.0, 4)?;
/// let found = simplify(&sphere, &SimplifyOptions::new(SimplifyTarget::Within(0.01)))?;
/// assert!(found.distance.distance.upper() <= 0.01);
/// assert!(found.mesh.faces().len() < sphere.faces().len() / 4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn simplify(mesh: &TriMesh, options: &SimplifyOptions<'_>) -> Result<Simplified, SimplifyError> {
    let mut levels = simplify_levels(mesh, options, 1)?;
    levels.pop().ok_or(SimplifyError::NoLevels)
}

/// Simplifies a mesh step by step: levels of detail, the finest first, the last one as [`simplify`] is asked for.
///
/// Each level has half the distance of the next one, or twice as many faces, and its own proof. Every level goes on where the one before
/// ended, so all of them together take little longer than the last.
///
/// # Errors
/// Those of [`simplify`]; [`SimplifyError::NoLevels`] if none is asked for.
pub fn simplify_levels(
    mesh: &TriMesh,
    options: &SimplifyOptions<'_>,
    levels: usize,
) -> Result<Vec<Simplified>, SimplifyError> {
    on_threads(options.limits.threads, || simplify_here(mesh, options, levels))
}

fn simplify_here(
    mesh: &TriMesh,
    options: &SimplifyOptions<'_>,
    levels: usize,
) -> Result<Vec<Simplified>, SimplifyError> {
    let started = Instant::now();
    let context = RunContext::start(options.limits.clone());
    let aabb = Aabb::of_faces(mesh);
    let targets = options.targets(aabb.diagonal(), levels)?;
    options.features.check(mesh.positions().len())?;
    if options.repair && !(options.features.vertices.is_empty() && options.features.edges.is_empty()) {
        return Err(FeatureError::Repaired.into());
    }
    let frame = Frame::of(&aabb);
    let places = Places { frame, grid: options.coordinates.within(&aabb) };
    let rounding = places.grid.rounding(mesh);
    for target in &targets {
        match target {
            SimplifyTarget::Within(d) => rounding.check(*d)?,
            SimplifyTarget::Faces(_) if places.grid.holds_all() => (),
            SimplifyTarget::Faces(faces) => places.grid.check_edges(&aabb, mean_edge(mesh, *faces))?,
        }
    }
    let repairs = RepairOptions { coordinates: options.coordinates, ..RepairOptions::default() };
    let repaired = if options.repair { Some(repair(mesh, &repairs)?.mesh) } else { None };
    let manifold = repaired.as_ref().unwrap_or(mesh);
    let run = Run { mesh, options, places, rounding, control: context.control(), context };
    if let (SimplifyTarget::Faces(_), Effort::Fast) = (options.target, options.effort) {
        let surface = || surface_of(manifold, &places, None, options);
        return run.levels(|| Ok(Collapses::by_error(surface()?, places)), &targets, started);
    }
    let bvh = Bvh::build(manifold, &frame);
    let surface = || surface_of(manifold, &places, Some(&bvh), options);
    match options.target {
        SimplifyTarget::Faces(_) => schedule::levels(&run, &bvh, surface, &targets, started),
        SimplifyTarget::Within(_) => {
            run.levels(|| Ok(Collapses::within(surface()?, &bvh, places)), &targets, started)
        }
    }
}

/// The edges of so many equilateral faces with the area of a mesh.
fn mean_edge(mesh: &TriMesh, faces: usize) -> f64 {
    let area =
        |face: usize| 0.5 * area_vector(mesh.corners(FaceId(face as u32)).map(DVec3::from_array)).length();
    let area: f64 = (0..mesh.faces().len()).map(area).sum();
    (4.0 / 3.0_f64.sqrt() * area / faces.max(1) as f64).sqrt()
}

/// The mesh in its frame, with the curves that are kept; faces near its vertices are known where there is a tree.
fn surface_of(
    mesh: &TriMesh,
    places: &Places,
    bvh: Option<&Bvh>,
    options: &SimplifyOptions<'_>,
) -> Result<Marked, SimplifyError> {
    let mut dynamic = DynamicMesh::new(mesh.positions(), mesh.faces())?;
    places.bring_in(&mut dynamic);
    let mut near = vec![Slot::default(); mesh.positions().len()];
    for (bvh, slot) in bvh.into_iter().flat_map(|bvh| bvh.slots().map(move |slot| (bvh, slot))) {
        for v in mesh.faces()[bvh.face(slot).index()] {
            near[v as usize] = slot;
        }
    }
    let keeps = !options.features.is_empty();
    let curves = if keeps { Curves::find(&dynamic, &options.features) } else { Curves::none(&dynamic) };
    Ok(Marked {
        curve: curves.of_halfedge,
        hold: curves.hold,
        // No length of edges is asked for.
        length: vec![0.0; near.len()],
        near,
        mesh: dynamic,
    })
}
