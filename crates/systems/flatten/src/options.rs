//! Options of flattening.

use crate::{
    Conformal, ConvexBoundary, CutError, CutOptions, FlattenError, SymmetryError, VirtualBoundary, Weights,
};
use pompeiu_core::mesh::Precision;
use pompeiu_core::run::{Limits, ProgressObserver};

/// The kind of map.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Method {
    /// Free boundary: minimises the symmetric Dirichlet energy without flips and overlaps.
    Free {
        /// Largest number of Newton steps for each chart after the cut is found.
        steps: usize,
    },
    /// Convex boundary: each inner vertex is a weighted mean of its neighbours.
    Convex {
        /// The curve.
        boundary: ConvexBoundary,
        /// The weights.
        weights: Weights,
        /// A virtual boundary around the disk, which gives its own boundary some freedom.
        around: Option<VirtualBoundary>,
    },
    /// Free boundary with least angle distortion. Faces may flip and overlap; the report says so.
    Conformal(Conformal),
    /// Free boundary, as rigid as possible, starting from a map to a circle. Faces may flip and overlap; the report says so.
    Rigid {
        /// Largest number of alternations between rotations and positions.
        steps: usize,
    },
}

impl Method {
    /// The name of the method in the command and in reports.
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

/// Options of flattening.
#[derive(Clone)]
pub struct FlattenOptions<'o> {
    /// How the surface is cut.
    pub cut: CutOptions,
    /// The kind of map.
    pub method: Method,
    /// With the strategy [`Auto`](crate::CutStrategy::Auto) and a free boundary, cuts are added to each chart until its mean
    /// symmetric Dirichlet energy is at most this (4 for an isometry).
    pub target: f64,
    /// Largest number of cuts added to a chart.
    pub most_cuts: usize,
    /// Whether charts are rotated, scaled by a common factor and packed into the unit square. Otherwise a single chart keeps its
    /// position and the unit of the mesh.
    pub pack: bool,
    /// The numbers of the file that the map is for: coordinates are rounded to them before the map is checked.
    pub precision: Precision,
    /// Limits on time and threads. When time runs out, the best map found so far is returned; it is one-to-one like any other.
    pub limits: Limits,
    /// Receives the number of finished charts.
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
            precision: Precision::default(),
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
