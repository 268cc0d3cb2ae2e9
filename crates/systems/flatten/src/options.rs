//! How a surface is flattened.

use crate::{
    Conformal, ConvexBoundary, CutError, CutOptions, FlattenError, SymmetryError, VirtualBoundary, Weights,
};
use pompeiu_core::run::{Limits, ProgressObserver};

/// The kind of map.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Method {
    /// The boundary is free: the least symmetric Dirichlet energy that is reached without flips and overlaps.
    Free {
        /// Most Newton steps for each chart after the cut is found.
        steps: usize,
    },
    /// The boundary goes to a convex curve, and each vertex inside to a weighted mean of its neighbours.
    Convex {
        /// The curve.
        boundary: ConvexBoundary,
        /// The weights.
        weights: Weights,
        /// Faces that are mapped around the disk and then dropped, so that its own boundary is free to some extent.
        around: Option<VirtualBoundary>,
    },
    /// The boundary is free, and angles are kept as well as they can. Faces may flip and overlap, which the report says.
    Conformal(Conformal),
    /// The boundary is free, and each face is turned as rigidly as it can, from a map onto a circle. Faces may flip and overlap, which the
    /// report says.
    Rigid {
        /// Most turns of fitting rotations and places.
        steps: usize,
    },
}

impl Method {
    /// The name of the method, as in the command and in reports.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Free { .. } => "free",
            Self::Convex { .. } => "convex",
            Self::Conformal(Conformal::LeastSquares) => "lscm",
            Self::Conformal(Conformal::Spectral) => "spectral",
            Self::Rigid { .. } => "arap",
        }
    }
}

impl Default for Method {
    fn default() -> Self {
        Self::Free { steps: 100 }
    }
}

/// How a surface is flattened.
#[derive(Clone)]
pub struct FlattenOptions<'o> {
    /// How it is cut.
    pub cut: CutOptions,
    /// The kind of map.
    pub method: Method,
    /// With the strategy [`Auto`](crate::CutStrategy::Auto) and a free boundary, cuts are added to each chart until its mean symmetric
    /// Dirichlet energy is at most this (isometry: 4).
    pub target: f64,
    /// Most cuts that are added to a chart.
    pub most_cuts: usize,
    /// Whether charts are turned, scaled alike and packed into the unit square; a single chart otherwise stays as the method leaves it, in
    /// the unit of the mesh.
    pub pack: bool,
    /// Limits on time and threads. When time runs out, the map is the best found so far, one-to-one like any other.
    pub limits: Limits,
    /// Is told how many charts are done.
    pub progress: Option<&'o dyn ProgressObserver>,
}

impl Default for FlattenOptions<'_> {
    fn default() -> Self {
        Self {
            cut: CutOptions::default(),
            method: Method::default(),
            target: 4.25,
            most_cuts: 6,
            pack: true,
            limits: Limits::default(),
            progress: None,
        }
    }
}

impl FlattenOptions<'_> {
    pub(crate) fn check(&self) -> Result<(), FlattenError> {
        use ConvexBoundary::{Polygon, Square};
        if let Method::Convex { boundary: Square | Polygon(_), .. } = self.method
            && self.cut.symmetry.is_some()
        {
            return Err(CutError::from(SymmetryError::Boundary).into());
        }
        if self.target > 4.0 {
            return Ok(());
        }
        Err(FlattenError::Option {
            what: "target of the symmetric Dirichlet energy",
            value: self.target,
            expected: "it must be greater than 4, the value of an isometry",
        })
    }
}
