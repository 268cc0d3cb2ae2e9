//! What is proven of the shape of all cells of a mesh.

use super::options::{MeshError, UnprovenCell, go_on};
use crate::{Sample, Skeleton};
use glam::DVec3;
use pompeiu_core::run::Control;
use pompeiu_volume::{
    BezierMesh, HexMesh, Jacobian, certify, certify_bezier, scaled_jacobian, scaled_jacobian_bezier,
    scaled_jacobian_bound, scaled_jacobian_bound_bezier,
};
use rayon::prelude::*;

/// The shape of the cells.
pub(super) struct CellProof {
    /// A proven lower bound on the scaled Jacobian over all cells.
    pub(super) least: f64,
    /// The cells whose determinant is not proven positive, the worst first.
    unproven: Vec<Unproven>,
    /// The cell with the least scaled Jacobian at points, and this value.
    pub(super) worst: (usize, f64),
}

/// A cell whose determinant is not proven positive.
struct Unproven {
    cell: usize,
    /// Its least scaled Jacobian at points.
    at_points: f64,
    /// Whether its determinant is proven to be zero or negative at a point.
    is_folded: bool,
}

impl CellProof {
    pub(super) fn of_cells(mesh: &HexMesh, control: &Control) -> Result<Self, MeshError> {
        let corners = |cell: usize| mesh.corners(mesh.cells()[cell]);
        Self::new(
            mesh.cells().len(),
            control,
            |cell| (scaled_jacobian(&corners(cell)), certify(&corners(cell))),
            |cell, attained| scaled_jacobian_bound(&corners(cell), attained),
        )
    }

    pub(super) fn of_patches(mesh: &BezierMesh, control: &Control) -> Result<Self, MeshError> {
        let at_points = |cell: usize| {
            let points = mesh.control(cell);
            (scaled_jacobian_bezier(&points), certify_bezier(&points))
        };
        Self::new(mesh.cells().len(), control, at_points, |cell, attained| {
            scaled_jacobian_bound_bezier(&mesh.control(cell), attained)
        })
    }

    fn new(
        count: usize,
        control: &Control,
        at_points: impl Fn(usize) -> (f64, Jacobian) + Sync,
        bound: impl Fn(usize, f64) -> f64 + Sync,
    ) -> Result<Self, MeshError> {
        let going = |_: &usize| !control.is_stopped();
        let found: Vec<(f64, Jacobian)> = (0..count).into_par_iter().filter(going).map(&at_points).collect();
        go_on(control)?;
        let values = found.iter().map(|(value, _)| *value).enumerate();
        let worst = values.min_by(|a, b| a.1.total_cmp(&b.1)).ok_or(MeshError::NoCell)?;
        // Other cells are bounded as far as the worst one needs it.
        let bounds = (0..count).into_par_iter().filter(going).map(|cell| bound(cell, worst.1));
        let least = bounds.reduce(|| f64::INFINITY, |a, b| if a < b { a } else { b });
        go_on(control)?;
        let unproven = found.iter().enumerate().filter(|(_, (_, proof))| *proof != Jacobian::Positive);
        let mut unproven: Vec<Unproven> = unproven
            .map(|(cell, &(at_points, proof))| Unproven {
                cell,
                at_points,
                is_folded: proof == Jacobian::Folded,
            })
            .collect();
        unproven.sort_by(|a, b| a.at_points.total_cmp(&b.at_points));
        Ok(Self { least, unproven, worst })
    }

    /// Whether every determinant is proven positive.
    pub(super) fn is_complete(&self) -> bool {
        self.unproven.is_empty()
    }

    /// The cells whose determinant is not proven positive, given the centre of each cell, and the samples next to them.
    pub(super) fn places(
        &self,
        skeleton: Option<&Skeleton>,
        centre: impl Fn(usize) -> DVec3,
    ) -> Vec<UnprovenCell> {
        let place = |&Unproven { cell, at_points, is_folded }: &Unproven| {
            let centre = centre(cell);
            let samples = skeleton.map_or(&[][..], Skeleton::samples).iter();
            let square = |sample: &Sample| sample.position.distance_squared(centre);
            let nearest = samples.min_by(|a, b| square(a).total_cmp(&square(b)));
            UnprovenCell {
                cell,
                scaled_jacobian: at_points,
                folded: is_folded,
                centre: centre.to_array(),
                sample: nearest.map(|sample| sample.id),
                line: nearest.map(|sample| sample.line),
            }
        };
        self.unproven.iter().map(place).collect()
    }
}
