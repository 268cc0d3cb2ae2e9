//! Cutting surfaces open and laying them flat.

use crate::arrays::array_of_rows;
use crate::errors::{Raise, unknown};
use crate::hausdorff::limits;
use crate::json::written;
use crate::mesh::Mesh;
use crate::wait::{self, Share, Watch};
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pompeiu::core::{FaceId, TriMesh, VertexId};
use pompeiu::flatten::{
    Conformal, ConvexBoundary, CutError, CutOptions, CutStrategy, FlattenError, FlattenOptions,
    MedialOptions, Method, Opened, RingKind, SymmetryPlane, VirtualBoundary, Weights, medial_balls,
};
use pompeiu::surface::{EdgeData, EmbeddedSurface};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::num::NonZeroUsize;

/// Where to cut, as the Python half hands it over.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Cutting {
    strategy: String,
    cuts: usize,
    through: Vec<u32>,
    along: Vec<Vec<u32>>,
    balls: NonZeroUsize,
    sections: bool,
    forbidden: Vec<u32>,
    forbidden_edges: Vec<[u32; 2]>,
    forbidden_faces: Vec<u32>,
    curvature: f64,
    spread: Option<f64>,
    symmetry: Option<([f64; 3], f64)>,
}

/// What map to make of it.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Mapping {
    boundary: String,
    polygon: Vec<[f64; 2]>,
    weights: String,
    energy: String,
    virtual_layers: usize,
    virtual_scale: f64,
    virtual_kind: String,
    target: f64,
    most_cuts: usize,
    pack: bool,
    threads: Option<usize>,
    time_limit: Option<f64>,
}

impl Cutting {
    fn options(self) -> PyResult<CutOptions> {
        let ids = |list: Vec<u32>| -> Vec<VertexId> { list.into_iter().map(VertexId).collect() };
        let strategy = match self.strategy.as_str() {
            "auto" => CutStrategy::Auto,
            "genus" => CutStrategy::Genus,
            "euclidean" => CutStrategy::Euclidean { cuts: self.cuts },
            "geodesic" => CutStrategy::Geodesic { cuts: self.cuts },
            "tips" => CutStrategy::Tips,
            "medial" => CutStrategy::Medial { balls: self.balls },
            "medial-tree" => CutStrategy::MedialTree { balls: self.balls },
            "bones" => CutStrategy::Bones { balls: self.balls, sections: self.sections },
            "through" => CutStrategy::Through(ids(self.through)),
            "along" => CutStrategy::Along(self.along.into_iter().map(ids).collect()),
            _ => {
                let expected = "\"auto\", \"genus\", \"euclidean\", \"geodesic\", \"tips\", \"medial\", \"medial-tree\" or \"bones\"";
                return Err(unknown("strategy", self.strategy, expected));
            }
        };
        Ok(CutOptions {
            strategy,
            forbidden: ids(self.forbidden),
            forbidden_edges: self.forbidden_edges.into_iter().map(|ends| ends.map(VertexId)).collect(),
            forbidden_faces: self.forbidden_faces.into_iter().map(FaceId).collect(),
            curvature: self.curvature,
            spread: self.spread,
            symmetry: self.symmetry.map(|(normal, offset)| SymmetryPlane { normal, offset }),
        })
    }
}

impl Mapping {
    fn options(self, cut: CutOptions) -> PyResult<FlattenOptions<'static>> {
        let weights = match self.weights.as_str() {
            "uniform" => Weights::Uniform,
            "cotangent" => Weights::Cotangent,
            "mean-value" => Weights::MeanValue,
            _ => {
                return Err(unknown("weights", self.weights, "\"uniform\", \"cotangent\" or \"mean-value\""));
            }
        };
        let free = match self.energy.as_str() {
            "symmetric-dirichlet" => Method::default(),
            "lscm" => Method::Conformal(Conformal::LeastSquares),
            "spectral" => Method::Conformal(Conformal::Spectral),
            "arap" => Method::Rigid { steps: 100 },
            _ => {
                let expected = "\"symmetric-dirichlet\", \"lscm\", \"spectral\" or \"arap\"";
                return Err(unknown("energy", self.energy, expected));
            }
        };
        let kind = match self.virtual_kind.as_str() {
            "intrinsic" => RingKind::Intrinsic,
            "extrinsic" => RingKind::Extrinsic,
            _ => return Err(unknown("virtual_kind", self.virtual_kind, "\"intrinsic\" or \"extrinsic\"")),
        };
        let layers = NonZeroUsize::new(self.virtual_layers);
        let around = layers.map(|layers| VirtualBoundary { layers, scale: self.virtual_scale, kind });
        let boundary = match self.boundary.as_str() {
            "free" => None,
            "circle" => Some(ConvexBoundary::Circle),
            "square" => Some(ConvexBoundary::Square),
            "own" => Some(ConvexBoundary::Own),
            "polygon" => Some(ConvexBoundary::Polygon(self.polygon)),
            _ => {
                let expected = "\"free\", \"circle\", \"square\", \"own\" or the corners of a polygon";
                return Err(unknown("boundary", self.boundary, expected));
            }
        };
        Ok(FlattenOptions {
            cut,
            method: boundary.map_or(free, |boundary| Method::Convex { boundary, weights, around }),
            target: self.target,
            most_cuts: self.most_cuts,
            pack: self.pack,
            limits: limits(self.threads, self.time_limit, None)?,
            progress: None,
        })
    }
}

/// What was cut: the vertex that each one is a copy of, and the ends of the edges.
type Seams<'py> = (Bound<'py, PyArray1<u32>>, Bound<'py, PyArray2<u32>>);

fn seams<'py>(
    py: Python<'py>,
    surface: &EmbeddedSurface,
    cut: &EdgeData<bool>,
    opened: &Opened,
) -> PyResult<Seams<'py>> {
    let mesh = surface.mesh();
    let edges: Vec<[u32; 2]> =
        mesh.edge_ids().filter(|&edge| cut[edge]).map(|edge| mesh.ends(edge).map(|v| v.0)).collect();
    let copies: Vec<u32> = opened.vertex_map().iter().map(|v| v.0).collect();
    Ok((copies.into_pyarray(py), array_of_rows(py, edges)?))
}

/// The surface that a mesh is.
fn surface_of(mesh: &Bound<'_, Mesh>) -> PyResult<EmbeddedSurface> {
    let held = mesh.clone().unbind();
    let made = wait::abandonable(mesh.py(), move || EmbeddedSurface::new(held.get().inner()))?;
    made.map_err(Raise::raise)
}

/// Opens a surface into disks.
#[pyfunction]
pub(crate) fn cut<'py>(
    py: Python<'py>,
    mesh: &Bound<'py, Mesh>,
    cutting: Cutting,
) -> PyResult<(Mesh, Seams<'py>)> {
    let options = cutting.options()?;
    let surface = surface_of(mesh)?;
    let (surface, found) = wait::abandonable(py, move || {
        let found = pompeiu::flatten::choose_cut(&surface, &options)
            .and_then(|cut| pompeiu::flatten::open(surface.mesh(), &cut).map(|opened| (cut, opened)));
        (surface, found)
    })?;
    let (cut, opened) = found.map_err(|error| FlattenError::from(error).raise())?;
    let positions = opened.spread(mesh.get().inner().positions());
    let whole = TriMesh::new(positions, opened.faces().to_vec()).map_err(Raise::raise)?;
    Ok((Mesh::from(whole), seams(py, &surface, &cut, &opened)?))
}

/// A straightened cut: the mesh that it was inserted into, its edges, and the face of the input that each face is a part of.
type Straight<'py> = (Mesh, Bound<'py, PyArray2<u32>>, Bound<'py, PyArray1<u32>>);

/// Straightens a cut and inserts it into the mesh.
#[pyfunction]
pub(crate) fn straighten<'py>(
    py: Python<'py>,
    mesh: &Bound<'py, Mesh>,
    edges: Vec<[u32; 2]>,
) -> PyResult<Straight<'py>> {
    let surface = surface_of(mesh)?;
    let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let ends = |edge| sorted(surface.mesh().ends(edge).map(|v| v.0));
    let by_ends: BTreeMap<[u32; 2], _> = surface.mesh().edge_ids().map(|edge| (ends(edge), edge)).collect();
    let mut cut = EdgeData::filled(surface.mesh().edges(), false);
    for ends in edges {
        let missing = || CutError::NoEdge { ends: ends.map(VertexId) };
        let edge = by_ends.get(&sorted(ends)).ok_or_else(missing);
        cut[*edge.map_err(|error| FlattenError::from(error).raise())?] = true;
    }
    let straight = wait::abandonable(py, move || pompeiu::flatten::straighten(&surface, &cut))?;
    let straight = straight.map_err(|error| FlattenError::from(error).raise())?;
    let of = straight.surface.mesh();
    let edges: Vec<[u32; 2]> =
        of.edge_ids().filter(|&edge| straight.cut[edge]).map(|edge| of.ends(edge).map(|v| v.0)).collect();
    let faces: Vec<u32> = straight.faces.iter().map(|face| face.0).collect();
    Ok((Mesh::from(straight.mesh), array_of_rows(py, edges)?, faces.into_pyarray(py)))
}

/// A flat map: places, which of them each corner has, the vertex that each is a copy of, the edges cut, the energy of each face.
type Map<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray2<u32>>,
    Bound<'py, PyArray1<u32>>,
    Bound<'py, PyArray2<u32>>,
    Bound<'py, PyArray1<f64>>,
    String,
);

/// Cuts a surface open and lays it flat.
#[pyfunction]
pub(crate) fn flatten<'py>(
    py: Python<'py>,
    mesh: &Bound<'py, Mesh>,
    cutting: Cutting,
    mapping: Mapping,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Map<'py>> {
    let options = mapping.options(cutting.options()?)?;
    let surface = surface_of(mesh)?;
    let (surface, flat) = wait::run_detached(py, progress, move |watch: &mut Watch<'_, Share>| {
        let options = FlattenOptions { progress: Some(&*watch), ..options };
        let flat = pompeiu::flatten::flatten(&surface, &options);
        (surface, flat)
    })?;
    let flat = flat.map_err(Raise::raise)?;
    let (copies, edges) = seams(py, &surface, &flat.cut, &flat.opened)?;
    let report = written(&flat.report)?;
    let distortion = flat.face_distortion().into_vec().into_pyarray(py);
    let corners = array_of_rows(py, flat.opened.faces().to_vec())?;
    Ok((array_of_rows(py, flat.uv.into_vec())?, corners, copies, edges, distortion, report))
}

/// How a surface is to be filled, as the Python half hands it over.
#[derive(Clone, Copy, FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Filling {
    balls: NonZeroUsize,
    samples: NonZeroUsize,
    tolerance: f64,
    threads: Option<usize>,
    time_limit: Option<f64>,
}

/// Balls: centres, radii, pairs beside each other, pairs that overlap, bounds, why it stopped.
type Balls<'py> = (
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<u32>>,
    Bound<'py, PyArray2<u32>>,
    ([f64; 2], f64),
    String,
);

/// Fills a closed surface with balls.
#[pyfunction]
pub(crate) fn medial<'py>(
    py: Python<'py>,
    mesh: &Bound<'py, Mesh>,
    filling: Filling,
) -> PyResult<Balls<'py>> {
    let options = MedialOptions {
        balls: filling.balls,
        samples: filling.samples,
        tolerance: filling.tolerance,
        limits: limits(filling.threads, filling.time_limit, None)?,
    };
    let surface = surface_of(mesh)?;
    let found = wait::abandonable(py, move || medial_balls(&surface, &options))?.map_err(Raise::raise)?;
    let centres: Vec<[f64; 3]> = found.balls.iter().map(|ball| ball.centre).collect();
    let radii: Vec<f64> = found.balls.iter().map(|ball| ball.radius).collect();
    let overlaps = found.overlaps();
    Ok((
        array_of_rows(py, centres)?,
        radii.into_pyarray(py),
        array_of_rows(py, found.edges)?,
        array_of_rows(py, overlaps)?,
        (found.deviation.surface_to_balls, found.deviation.balls_to_surface),
        written(&found.stop)?,
    ))
}
