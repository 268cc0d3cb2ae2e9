//! Cutting a surface open and laying it flat.

use super::CutRequest;
use crate::chords::without_chords;
use crate::flatten::flatten_along;
use crate::{
    Charts, Conformal, ConvexBoundary, CutOptions, CutStrategy, FlattenError, FlattenOptions, FlattenReport,
    Flattening, Method, RingKind, VirtualBoundary, Weights, choose_cut, flatten, straighten,
};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::Precision;
use pompeiu_core::request::{Conclusion, Limit, Report, Request, values};
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_surface::EmbeddedSurface;
use std::fmt;
use std::num::NonZeroUsize;
use std::str::FromStr;

/// Cut a surface open and lay it flat, one-to-one.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FlattenRequest {
    /// Where to cut.
    #[cfg_attr(feature = "clap", command(flatten))]
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub cut: CutRequest,
    /// The shape of the boundary in the plane: free, circle, square, own or polygon:X,Y;… with the corners of a convex polygon,
    /// counter-clockwise.
    #[cfg_attr(feature = "clap", arg(long, value_name = "BOUNDARY"))]
    pub boundary: Boundary,
    /// Weights of edges where the boundary goes to a convex curve.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub weights: Weights,
    /// The distortion that is minimised where the boundary is free.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub energy: Energy,
    /// Layers of faces that are mapped around a convex boundary's disk and then dropped, so that its own boundary is freer.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub virtual_layers: usize,
    /// The ratio of the widths of two successive layers.
    #[cfg_attr(feature = "clap", arg(long, value_name = "FACTOR"))]
    pub virtual_scale: f64,
    /// The source of the lengths of their edges.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub virtual_kind: RingKind,
    /// Add cuts until the mean symmetric Dirichlet energy is at most this (isometry: 4).
    #[cfg_attr(feature = "clap", arg(long, value_name = "ENERGY"))]
    pub target: f64,
    /// Most cuts that are added to a chart; where nothing is said 6 to 32, the more the fewer faces there are, or 12 where charts are divided.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub most_cuts: Option<usize>,
    /// How many charts: components for one of each connected part, a number, or auto for as many as the distortion needs.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub charts: Charts,
    /// Divide charts until the mean symmetric Dirichlet energy of the whole map is at most this (isometry: 4); 4.1 where nothing is said and
    /// the number of charts is auto.
    #[cfg_attr(feature = "clap", arg(long, value_name = "ENERGY"))]
    pub max_distortion: Option<f64>,
    /// Pack all charts into the unit square; otherwise a single chart stays as large as the surface, where the method puts it.
    #[cfg_attr(
        feature = "clap",
        arg(long = "no-pack", action = clap::ArgAction::SetFalse, help = "Leave a single chart as large as the surface, where the method puts it")
    )]
    pub pack: bool,
    /// Numbers in which the coordinates of the map are kept; single where the file that is written holds no others, as GLB does.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub precision: Precision,
}

impl Default for FlattenRequest {
    fn default() -> Self {
        let FlattenOptions { target, pack, precision, .. } = FlattenOptions::default();
        let around = VirtualBoundary::default();
        Self {
            cut: CutRequest::default(),
            boundary: Boundary(None),
            weights: Weights::default(),
            energy: Energy::default(),
            virtual_layers: 0,
            virtual_scale: around.scale,
            virtual_kind: around.kind,
            target,
            most_cuts: None,
            charts: Charts::default(),
            max_distortion: None,
            pack,
            precision,
        }
    }
}

/// The shape of the boundary in the plane; none where it is free.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "BoundaryValue", into = "BoundaryValue"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(with = "BoundaryValue"))]
pub struct Boundary(pub Option<ConvexBoundary>);

/// A boundary in a file or a dictionary: its name, or the corners of a convex polygon, counter-clockwise.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(
    untagged,
    expecting = "expected \"free\", \"circle\", \"square\", \"own\" or the corners of a polygon"
)]
enum BoundaryValue {
    /// free, circle, square, own or polygon:X,Y;…
    Text(String),
    /// Corners.
    Corners(Vec<[f64; 2]>),
}

#[cfg(feature = "serde")]
impl TryFrom<BoundaryValue> for Boundary {
    type Error = String;

    fn try_from(value: BoundaryValue) -> Result<Self, String> {
        match value {
            BoundaryValue::Text(text) => text.parse(),
            BoundaryValue::Corners(corners) => Ok(Self(Some(ConvexBoundary::Polygon(corners)))),
        }
    }
}

#[cfg(feature = "serde")]
impl From<Boundary> for BoundaryValue {
    fn from(boundary: Boundary) -> Self {
        match boundary.0 {
            Some(ConvexBoundary::Polygon(corners)) => Self::Corners(corners),
            _ => Self::Text(boundary.to_string()),
        }
    }
}

impl FromStr for Boundary {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let corner = |part: &str| values::tuple::<2>(part.trim());
        Ok(Self(match text.split_once(':') {
            None if text == "free" => None,
            None if text == "circle" => Some(ConvexBoundary::Circle),
            None if text == "square" => Some(ConvexBoundary::Square),
            None if text == "own" => Some(ConvexBoundary::Own),
            Some(("polygon", rest)) => {
                Some(ConvexBoundary::Polygon(rest.split(';').map(corner).collect::<Result<_, _>>()?))
            }
            _ => return Err("expected free, circle, square, own or polygon:X,Y;…".to_owned()),
        }))
    }
}

impl fmt::Display for Boundary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            None => f.write_str("free"),
            Some(ConvexBoundary::Circle) => f.write_str("circle"),
            Some(ConvexBoundary::Square) => f.write_str("square"),
            Some(ConvexBoundary::Own) => f.write_str("own"),
            Some(ConvexBoundary::Polygon(corners)) => {
                let corners: Vec<String> = corners.iter().map(|[x, y]| format!("{x},{y}")).collect();
                write!(f, "polygon:{}", corners.join(";"))
            }
        }
    }
}

/// The distortion that is minimised where the boundary is free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Energy {
    /// Lengths, without flips and overlaps.
    #[default]
    SymmetricDirichlet,
    /// Angles, two vertices held; faces may flip.
    Lscm,
    /// Angles, by an eigenvector; faces may flip.
    Spectral,
    /// Lengths, as rigid as possible; faces may flip.
    Arap,
}

impl Energy {
    /// The method with a free boundary.
    fn method(self) -> Method {
        match self {
            Self::SymmetricDirichlet => Method::default(),
            Self::Lscm => Method::Conformal(Conformal::LeastSquares),
            Self::Spectral => Method::Conformal(Conformal::Spectral),
            Self::Arap => Method::Rigid { steps: 100 },
        }
    }
}

impl Request for FlattenRequest {
    const NAME: &'static str = "flatten";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time];
    type Report = FlattenReport;
}

impl Report for FlattenReport {
    fn stop(&self) -> StopReason {
        self.stop
    }

    /// A map that is not one-to-one falls short of what was asked.
    fn conclusion(&self) -> Conclusion {
        if self.is_one_to_one() && !self.stop.is_early() {
            Conclusion::AsAsked
        } else {
            Conclusion::Incomplete
        }
    }
}

/// A surface and its flat map.
#[derive(Clone, Debug)]
pub struct FlatSurface {
    /// The surface that was flattened: the input, or that after a straightened cut was inserted or edges were divided.
    pub surface: EmbeddedSurface,
    /// The mesh into which a straightened cut was inserted, or in which edges were divided.
    pub inserted: Option<TriMesh>,
    /// Number of edges that were divided at their midpoints, because both ends would be on one straight side of the boundary.
    pub divided: usize,
    /// The map.
    pub flat: Flattening,
}

impl FlattenRequest {
    /// Cuts a surface open and lays it flat.
    ///
    /// # Errors
    /// [`FlattenError`].
    pub fn run(
        &self,
        surface: EmbeddedSurface,
        context: &RunContext<'_>,
    ) -> Result<FlatSurface, FlattenError> {
        // A bound on the distortion needs as many charts as it needs.
        let charts = match (self.charts, self.max_distortion) {
            (Charts::Components, Some(_)) => Charts::Auto,
            (charts, _) => charts,
        };
        if self.cut.straighten && charts != Charts::Components {
            return Err(FlattenError::Whole { option: "the straightened cut" });
        }
        let most_cuts = self.most_cuts.unwrap_or(match charts {
            Charts::Components => FlattenOptions::most_cuts_of(surface.mesh().faces()),
            Charts::Count(_) | Charts::Auto => FlattenOptions::MOST_CUTS_OF_MANY,
        });
        let options = |cut| FlattenOptions {
            cut,
            method: self.method(),
            target: self.target,
            most_cuts,
            charts,
            max_distortion: self.max_distortion,
            pack: self.pack,
            precision: self.precision,
            limits: context.limits(),
            progress: context.progress(),
        };
        let chosen = self.cut.options(&surface)?;
        let strategy = chosen.strategy.name();
        let mut cut = chosen.clone();
        let (mut surface, mut inserted, mut divided) = (surface, None, 0);
        let mut along = None;
        if self.cut.straighten {
            // Only a map with a free boundary adds cuts.
            let chosen = match self.straight_boundary() {
                Some(_) => choose_cut(&surface, &chosen)?,
                None => flatten(&surface, &options(chosen))?.cut,
            };
            let straight = straighten(&surface, &chosen)?;
            cut = CutOptions { strategy: CutStrategy::Along(straight.paths()), ..CutOptions::default() };
            (surface, inserted) = (straight.surface, Some(straight.mesh));
        }
        if let Some(boundary) = self.straight_boundary()
            && let chosen = choose_cut(&surface, &cut)?
            && let Some(made) = without_chords(&surface, &chosen, boundary, cut.symmetry.as_ref())?
        {
            // Vertices and faces that cuts must not enter have been kept out of this one, and have other numbers now.
            cut = CutOptions { symmetry: cut.symmetry, ..CutOptions::default() };
            along = Some(made.cut);
            (surface, inserted, divided) = (made.surface, Some(made.mesh), made.divided);
        }
        let mut flat = flatten_along(&surface, &options(cut), along)?;
        flat.report.cut.strategy = strategy;
        Ok(FlatSurface { surface, inserted, divided, flat })
    }

    /// The boundary to which the surface itself goes, if that has straight sides.
    fn straight_boundary(&self) -> Option<&ConvexBoundary> {
        let is_straight =
            |b: &&ConvexBoundary| matches!(b, ConvexBoundary::Square | ConvexBoundary::Polygon(_));
        self.boundary.0.as_ref().filter(is_straight).filter(|_| self.virtual_layers == 0)
    }

    /// The kind of map that is asked for.
    fn method(&self) -> Method {
        let Some(boundary) = self.boundary.0.clone() else { return self.energy.method() };
        let (scale, kind) = (self.virtual_scale, self.virtual_kind);
        let layers = NonZeroUsize::new(self.virtual_layers);
        let around = layers.map(|layers| VirtualBoundary { layers, scale, kind });
        Method::Convex { boundary, weights: self.weights, around }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boundaries_are_read_and_written() {
        let parse = |text: &str| text.parse::<Boundary>().map(|boundary| boundary.0);
        assert_eq!(parse("free"), Ok(None));
        assert_eq!(parse("own"), Ok(Some(ConvexBoundary::Own)));
        let corners = vec![[0.0, 0.0], [1.0, 0.5], [0.0, -2.0]];
        assert_eq!(parse("polygon:0,0; 1,0.5;0,-2"), Ok(Some(ConvexBoundary::Polygon(corners))));
        for wrong in ["", "disk", "polygon", "polygon:1", "polygon:1,2;3"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
        for text in ["free", "circle", "square", "own", "polygon:0,0;1,0.5;0,-2"] {
            assert_eq!(text.parse::<Boundary>().unwrap().to_string(), text);
        }
    }
}
