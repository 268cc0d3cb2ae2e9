//! Answers of the library as plain data: dictionaries, which the classes in Python are made of.

use pompeiu::core::MeshSummary;
use pompeiu::fields::{self, Audit};
use pompeiu::hausdorff::{DirectedReport, SurfacePoint, SymmetricReport, Timing, Witness, WorkCount};
use pyo3::prelude::*;

#[derive(IntoPyObject)]
pub(crate) struct Point {
    face: u32,
    barycentric: (f64, f64, f64),
    position: (f64, f64, f64),
}

impl From<SurfacePoint> for Point {
    fn from(point: SurfacePoint) -> Self {
        Self { face: point.face.0, barycentric: point.barycentric.into(), position: point.position.into() }
    }
}

#[derive(IntoPyObject)]
pub(crate) struct Pair {
    from_: Point,
    to: Point,
}

impl From<Witness> for Pair {
    fn from(witness: Witness) -> Self {
        Self { from_: witness.from.into(), to: witness.to.into() }
    }
}

#[derive(IntoPyObject)]
pub(crate) struct Work {
    queries: u64,
    distances: u64,
    pieces: u64,
    games: u64,
    cuts: u64,
    depth: u32,
}

impl From<WorkCount> for Work {
    fn from(work: WorkCount) -> Self {
        let WorkCount { queries, distances, pieces, games, cuts, depth } = work;
        Self { queries, distances, pieces, games, cuts, depth }
    }
}

#[derive(IntoPyObject)]
pub(crate) struct Seconds {
    build: f64,
    search: f64,
}

impl From<Timing> for Seconds {
    fn from(timing: Timing) -> Self {
        Self { build: timing.build.as_secs_f64(), search: timing.search.as_secs_f64() }
    }
}

#[derive(IntoPyObject)]
pub(crate) struct Directed {
    lower: f64,
    upper: f64,
    witness: Pair,
    stop: &'static str,
    tolerance: f64,
    work: Work,
    timing: Seconds,
}

impl From<DirectedReport> for Directed {
    fn from(report: DirectedReport) -> Self {
        Self {
            lower: report.distance.lower(),
            upper: report.distance.upper(),
            witness: report.witness.into(),
            stop: report.stop.name(),
            tolerance: report.tolerance,
            work: report.work.into(),
            timing: report.timing.into(),
        }
    }
}

#[derive(IntoPyObject)]
pub(crate) struct Symmetric {
    lower: f64,
    upper: f64,
    a_to_b: Directed,
    b_to_a: Directed,
}

impl From<SymmetricReport> for Symmetric {
    fn from(report: SymmetricReport) -> Self {
        Self {
            lower: report.distance.lower(),
            upper: report.distance.upper(),
            a_to_b: report.a_to_b.into(),
            b_to_a: report.b_to_a.into(),
        }
    }
}

#[derive(IntoPyObject)]
pub(crate) struct Summary {
    vertices: usize,
    unreferenced_vertices: usize,
    faces: usize,
    degenerate_faces: usize,
    duplicate_faces: usize,
    lower_corner: (f64, f64, f64),
    upper_corner: (f64, f64, f64),
    area: f64,
    volume: Option<f64>,
    edges: usize,
    boundary_edges: usize,
    boundary_loops: usize,
    non_manifold_edges: usize,
    non_manifold_vertices: usize,
    inconsistent_edges: usize,
    components: usize,
    euler_characteristic: isize,
    orientable: bool,
    genus: Option<usize>,
}

impl From<MeshSummary> for Summary {
    fn from(summary: MeshSummary) -> Self {
        let connectivity = summary.connectivity;
        Self {
            vertices: summary.vertices,
            unreferenced_vertices: summary.unreferenced_vertices,
            faces: summary.faces,
            degenerate_faces: summary.degenerate_faces,
            duplicate_faces: summary.duplicate_faces,
            lower_corner: summary.bounding_box.lower.into(),
            upper_corner: summary.bounding_box.upper.into(),
            area: summary.area,
            volume: summary.volume,
            edges: connectivity.edges,
            boundary_edges: connectivity.boundary_edges,
            boundary_loops: connectivity.boundary_loops,
            non_manifold_edges: connectivity.non_manifold_edges,
            non_manifold_vertices: connectivity.non_manifold_vertices,
            inconsistent_edges: connectivity.inconsistent_edges,
            components: connectivity.components,
            euler_characteristic: connectivity.euler_characteristic,
            orientable: connectivity.orientable,
            genus: connectivity.genus,
        }
    }
}

#[derive(IntoPyObject)]
pub(crate) struct Quality {
    residual: f64,
    part_error: f64,
    gradient_rotated: f64,
    gradient_harmonic: f64,
    rotated_harmonic: f64,
    field_norm: f64,
    gradient_norm: f64,
    rotated_norm: f64,
    harmonic_norm: f64,
}

impl From<fields::Quality> for Quality {
    fn from(quality: fields::Quality) -> Self {
        Self {
            residual: quality.residual,
            part_error: quality.part_error,
            gradient_rotated: quality.inner_products.gradient_rotated,
            gradient_harmonic: quality.inner_products.gradient_harmonic,
            rotated_harmonic: quality.inner_products.rotated_harmonic,
            field_norm: quality.norms.field,
            gradient_norm: quality.norms.gradient,
            rotated_norm: quality.norms.rotated,
            harmonic_norm: quality.norms.harmonic,
        }
    }
}

#[derive(IntoPyObject)]
pub(crate) struct Ranks {
    gradient: usize,
    rotated: usize,
    left_over: isize,
}

impl From<fields::OneKind> for Ranks {
    fn from(ranks: fields::OneKind) -> Self {
        let fields::OneKind { gradient, rotated, left_over } = ranks;
        Self { gradient, rotated, left_over }
    }
}

#[derive(IntoPyObject)]
pub(crate) struct Dimensions {
    degrees_of_freedom: usize,
    harmonic: usize,
    mixed: Ranks,
    conforming: Ranks,
    nonconforming: Ranks,
    adds_up: bool,
}

impl From<Audit> for Dimensions {
    fn from(audit: Audit) -> Self {
        Self {
            degrees_of_freedom: audit.degrees_of_freedom,
            harmonic: audit.harmonic,
            mixed: audit.mixed.into(),
            conforming: audit.conforming.into(),
            nonconforming: audit.nonconforming.into(),
            adds_up: audit.adds_up(),
        }
    }
}
