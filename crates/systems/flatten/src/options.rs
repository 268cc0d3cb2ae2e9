//! Options of flattening.

use crate::{
    Charts, Conformal, ConvexBoundary, CutError, CutOptions, CutStrategy, FlattenError, SymmetryError,
    VirtualBoundary, Weights,
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
    /// How many charts there are. The chart that adds most to the distortion is divided first, along a short seam.
    pub charts: Charts,
    /// The mean symmetric Dirichlet energy of the whole map at which no more charts are divided, and at which no more cuts are added to a
    /// chart; 4 for an isometry. None stands for [`FlattenOptions::DISTORTION`] where the number of charts is free, and for no such end
    /// where it is given.
    pub max_distortion: Option<f64>,
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
            most_cuts: Self::MOST_CUTS,
            charts: Charts::default(),
            max_distortion: None,
            pack: true,
            precision: Precision::default(),
            limits: Limits::default(),
            progress: None,
        }
    }
}

/// Cuts added to a chart at most, times the faces of the surface; and cuts at most where these are few.
const FACES_OF_CUTS: usize = 500_000;
const MOST_CUTS_OF_FEW_FACES: usize = 32;

impl FlattenOptions<'_> {
    /// The mean symmetric Dirichlet energy up to which charts are divided where nothing else is asked for.
    pub const DISTORTION: f64 = 4.1;

    /// Cuts added to a chart at most where nothing else is asked for, however many faces the surface has.
    pub const MOST_CUTS: usize = 6;

    /// Cuts added to a chart at most where nothing else is asked for: the fewer faces, the more cuts take as long.
    pub fn most_cuts_of(faces: usize) -> usize {
        (FACES_OF_CUTS / faces.max(1)).clamp(Self::MOST_CUTS, MOST_CUTS_OF_FEW_FACES)
    }

    /// The same where charts are divided: a cut takes less length than a seam where few are needed, and more where many are.
    pub const MOST_CUTS_OF_MANY: usize = 12;

    /// The mean energy of the whole map at which no more charts are divided.
    pub(crate) fn enough(&self) -> Option<f64> {
        self.max_distortion.or((self.charts == Charts::Auto).then_some(Self::DISTORTION))
    }

    /// The mean energy of a chart at which no more cuts are added to it.
    pub(crate) fn chart_target(&self) -> f64 {
        self.enough().unwrap_or(self.target)
    }

    /// An option with which charts are not divided.
    fn keeps_charts_whole(&self) -> Option<&'static str> {
        if !matches!(self.method, Method::Free { .. }) {
            Some("the boundary or the energy")
        } else if self.cut.strategy != CutStrategy::Auto {
            Some("the strategy of cuts")
        } else if self.cut.symmetry.is_some() {
            Some("the plane of symmetry")
        } else if self.cut.forbids() {
            Some("what cuts must not enter")
        } else {
            None
        }
    }

    pub(crate) fn check(&self) -> Result<(), FlattenError> {
        use ConvexBoundary::{Polygon, Square};
        if let Method::Convex { boundary: Square | Polygon(_), around: Some(_), .. } = self.method
            && self.cut.symmetry.is_some()
        {
            return Err(CutError::from(SymmetryError::Virtual).into());
        }
        if self.charts != Charts::Components
            && let Some(option) = self.keeps_charts_whole()
        {
            return Err(FlattenError::Whole { option });
        }
        if let Some(value) = self.max_distortion.filter(|value| value.is_nan() || *value <= 4.0) {
            return Err(FlattenError::Option {
                what: "greatest mean symmetric Dirichlet energy",
                value,
                expected: "it must be greater than 4, the value of an isometry",
            });
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
