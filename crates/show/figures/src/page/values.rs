//! Numbers and vectors on meshes, and their colour scales.

use super::encode::doubles;
use super::error::{check_finite, check_length};
use super::mesh::{PlacedMesh, SharedCorners};
use super::mesh_values::{Element, MeshValues};
use super::{MeshId, PageError, ScaleId, SceneId};
use crate::ColorMap;
use serde_json::{Value, json};

/// Values of a page, with their mesh and scale.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PlacedValues {
    pub(super) mesh: MeshId,
    pub(super) scale: ScaleId,
    pub(super) values: MeshValues,
}

impl PlacedValues {
    pub(super) fn check(&self, meshes: &[PlacedMesh]) -> Result<(), PageError> {
        let mesh = self.mesh.of(meshes)?;
        check_finite("the list of values", &self.values.numbers)?;
        let elements = match self.values.on {
            Element::Corner => 3 * mesh.triangle_count(meshes),
            Element::Vertex => mesh.vertex_count(),
            Element::Face => mesh.face_count(meshes),
        };
        check_length("the list of values", self.values.numbers.len(), self.values.width * elements)
    }

    pub(super) fn is_on_corners(&self) -> bool {
        self.values.on == Element::Corner
    }

    pub(super) fn is_on_vertices(&self) -> bool {
        self.values.on == Element::Vertex
    }

    pub(super) fn is_vector(&self) -> bool {
        self.values.width == 3
    }

    pub(super) fn data(&self, shared: Option<&SharedCorners>) -> Value {
        let of = |element: usize| (0..self.values.width).map(move |k| self.values.at(element, k));
        let numbers: Vec<f64> = match (self.values.on, shared) {
            (Element::Corner, Some(shared)) => shared.first.iter().flat_map(|&i| of(i)).collect(),
            (Element::Vertex, Some(shared)) => shared.vertices.iter().flat_map(|&v| of(v as usize)).collect(),
            _ => self.values.numbers.clone(),
        };
        json!({
            "mesh": self.mesh, "scale": self.scale, "on": self.values.on, "width": self.values.width,
            "data": doubles(numbers.into_iter()),
        })
    }
}

/// The range of values of a [`ValueScale`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Span {
    /// From zero on: magnitudes, distances.
    #[default]
    Size,
    /// Symmetric about zero. A threshold applies to absolute values.
    Signed,
    /// From a number to a greater one.
    Between(f64, f64),
}

/// The quantity that values have in common, and their colours.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueScale {
    /// The quantity, such as "distance".
    pub title: String,
    /// The unit as displayed; empty if unknown.
    pub unit: String,
    /// The colours.
    pub colors: ColorMap,
    /// The range of values.
    pub span: Span,
    /// The initial threshold.
    pub threshold: Option<f64>,
    /// Class boundaries, ascending, at least two or none. Each class then has one colour at first; values below the first and above
    /// the last boundary form classes, too. A boundary belongs to the class below it, except the first, which belongs to the class
    /// above.
    pub bands: Vec<f64>,
    /// Whether what is beyond the threshold is painted in one colour at first.
    pub painting: bool,
}

impl Default for ValueScale {
    fn default() -> Self {
        Self {
            title: String::new(),
            unit: String::new(),
            colors: ColorMap::Viridis,
            span: Span::default(),
            threshold: None,
            bands: Vec::new(),
            painting: false,
        }
    }
}

/// An upper end for a scale that users can select.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// The label, after "up to".
    pub text: String,
    /// The upper end.
    pub end: RangeEnd,
}

/// The upper end of a scale.
#[derive(Clone, Debug, PartialEq)]
pub enum RangeEnd {
    /// The greatest of these values over the scenes that are shown.
    Scenes(Vec<(SceneId, f64)>),
    /// At the threshold.
    Threshold,
}

/// A scale with its ranges.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RangedScale {
    pub(super) scale: ValueScale,
    pub(super) ranges: Vec<Range>,
    /// The range selected at first.
    pub(super) first: usize,
}

impl RangedScale {
    pub(super) fn check(&self) -> Result<(), PageError> {
        check_finite("the threshold", &self.scale.threshold)?;
        check_finite("the ends of bands", &self.scale.bands)?;
        if let Some(index) = self.scale.bands.windows(2).position(|ends| ends[0] >= ends[1]) {
            let [lower, upper] = [self.scale.bands[index], self.scale.bands[index + 1]];
            return Err(PageError::Crossed { what: "the ends of bands", index, lower, upper });
        }
        if let Span::Between(low, high) = self.scale.span {
            check_finite("the span of a scale", [&low, &high])?;
            if low > high {
                return Err(PageError::Crossed {
                    what: "the span of a scale",
                    index: 0,
                    lower: low,
                    upper: high,
                });
            }
        }
        Ok(())
    }

    /// `largest` is the greatest absolute value on this scale.
    pub(super) fn data(&self, largest: f64) -> Value {
        let ValueScale { title, unit, colors, span, threshold, bands, painting } = &self.scale;
        let (low, end) = match span {
            Span::Between(low, high) => (Some(low), high - low),
            Span::Size | Span::Signed => (None, largest),
        };
        let range = |range: &Range| match &range.end {
            RangeEnd::Scenes(ends) => json!({ "text": range.text, "ends": ends }),
            RangeEnd::Threshold => json!({ "text": range.text, "ends": null }),
        };
        json!({
            "title": title, "unit": unit, "signed": *span == Span::Signed, "low": low, "end": end,
            "colors": { "name": colors.name(), "table": colors.table().as_flattened(), "contrast": colors.contrast() },
            "threshold": threshold, "bands": bands, "ranges": self.ranges.iter().map(range).collect::<Vec<_>>(),
            "range": self.first, "painting": painting,
        })
    }
}
