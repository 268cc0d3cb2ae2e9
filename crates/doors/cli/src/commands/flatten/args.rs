//! Options of the flatten command.

use crate::args::{CutChoice, Limits, Picture};
use clap::{Args, ValueEnum};
use pompeiu::flatten::{Conformal, ConvexBoundary, Method, RingKind, VirtualBoundary, Weights};
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Cut a surface open and lay it flat, one-to-one
#[derive(Args)]
#[command(after_help = "\
The mesh must be a manifold; each of its parts becomes one chart, and all charts lie in the unit square. That the map is one-to-one
is decided exactly on the coordinates as they are stored. Without options the boundary is free, and cuts are added until lengths
are kept well. The exit code is 3 if the map is not one-to-one.

Outputs:
  .obj   the mesh with texture coordinates
  .glb   the same with a texture of squares
  .svg   the layout; both sides of each cut edge have one colour
  .png   surface and map beside each other

Boundaries:
  free             the least symmetric Dirichlet energy found (default)
  circle, square   in proportion to the lengths of the boundary
  own              the boundary as it is, where it lies in a plane
  polygon:X,Y;…    the corners of a convex polygon, counter-clockwise

Examples:
  pompeiu flatten cow.off -o cow.obj --report cow.html
  pompeiu flatten torus.obj --strategy genus -o torus.svg
  pompeiu flatten face.ply --boundary circle --weights mean-value -o face.png")]
pub(crate) struct Flatten {
    /// The mesh file
    pub(crate) mesh: PathBuf,
    #[command(flatten)]
    pub(crate) cut: CutChoice,
    /// Where the boundary goes: free, circle, square, own or polygon:X,Y;…
    #[arg(long, value_parser = boundary, default_value = "free", value_name = "BOUNDARY")]
    pub(crate) boundary: Boundary,
    /// Weights of edges where the boundary goes to a convex curve
    #[arg(long, value_enum, default_value_t)]
    pub(crate) weights: WeightsName,
    /// What is least where the boundary is free
    #[arg(long, value_enum, default_value_t)]
    pub(crate) energy: Energy,
    /// Layers of faces that are mapped around a convex boundary's disk and then dropped, so that its own boundary is freer
    #[arg(long, default_value = "0", value_name = "N")]
    pub(crate) virtual_layers: usize,
    /// How much wider each of these layers is than the one before
    #[arg(long, default_value = "1.2", value_name = "FACTOR")]
    pub(crate) virtual_scale: f64,
    /// Where the lengths of their edges come from
    #[arg(long, value_enum, default_value_t)]
    pub(crate) virtual_kind: VirtualKind,
    /// Add cuts until the mean symmetric Dirichlet energy is at most this (isometry: 4)
    #[arg(long, default_value = "4.25", value_name = "ENERGY")]
    pub(crate) target: f64,
    /// Most cuts that are added to a chart
    #[arg(long, default_value = "6", value_name = "N")]
    pub(crate) most_cuts: usize,
    /// Leave a single chart as large as the surface, where the method puts it
    #[arg(long)]
    pub(crate) no_pack: bool,
    /// The file to write: .obj, .glb, .svg or .png
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) picture: Picture,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}

/// Where the boundary goes; none where it is free.
#[derive(Clone)]
pub(crate) struct Boundary(pub(crate) Option<ConvexBoundary>);

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum WeightsName {
    /// One for each edge
    Uniform,
    /// The discrete harmonic map, on the intrinsic Delaunay triangulation
    Cotangent,
    /// Mean value coordinates
    #[default]
    MeanValue,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Energy {
    /// Lengths, without flips and overlaps
    #[default]
    SymmetricDirichlet,
    /// Angles, two vertices held; faces may flip
    Lscm,
    /// Angles, by an eigenvector; faces may flip
    Spectral,
    /// Lengths, as rigid as possible; faces may flip
    Arap,
}

impl Energy {
    /// The method with a free boundary.
    pub(crate) fn method(self) -> Method {
        match self {
            Self::SymmetricDirichlet => Method::default(),
            Self::Lscm => Method::Conformal(Conformal::LeastSquares),
            Self::Spectral => Method::Conformal(Conformal::Spectral),
            Self::Arap => Method::Rigid { steps: 100 },
        }
    }
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum VirtualKind {
    /// Circles around the circle as long as the boundary
    #[default]
    Intrinsic,
    /// The boundary moved away from its centroid in space
    Extrinsic,
}

impl Flatten {
    /// The kind of map that is asked for.
    pub(crate) fn method(&self) -> Method {
        let Some(boundary) = self.boundary.0.clone() else { return self.energy.method() };
        let kind = match self.virtual_kind {
            VirtualKind::Intrinsic => RingKind::Intrinsic,
            VirtualKind::Extrinsic => RingKind::Extrinsic,
        };
        let layers = NonZeroUsize::new(self.virtual_layers);
        let around = layers.map(|layers| VirtualBoundary { layers, scale: self.virtual_scale, kind });
        Method::Convex { boundary, weights: self.weights.into(), around }
    }
}

impl From<WeightsName> for Weights {
    fn from(name: WeightsName) -> Self {
        match name {
            WeightsName::Uniform => Self::Uniform,
            WeightsName::Cotangent => Self::Cotangent,
            WeightsName::MeanValue => Self::MeanValue,
        }
    }
}

fn boundary(text: &str) -> Result<Boundary, String> {
    let corner = |part: &str| crate::numbers::tuple::<2>(part.trim());
    Ok(Boundary(match text.split_once(':') {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boundaries_are_told_apart() {
        let parse = |text: &str| boundary(text).map(|boundary| boundary.0);
        assert_eq!(parse("free"), Ok(None));
        assert_eq!(parse("own"), Ok(Some(ConvexBoundary::Own)));
        let corners = vec![[0.0, 0.0], [1.0, 0.5], [0.0, -2.0]];
        assert_eq!(parse("polygon:0,0; 1,0.5;0,-2"), Ok(Some(ConvexBoundary::Polygon(corners))));
        for wrong in ["", "disk", "polygon", "polygon:1", "polygon:1,2;3"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
