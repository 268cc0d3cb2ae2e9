//! The content of a picture: meshes, values on them, marks.

use crate::{FigureError, Rgb};
use pompeiu_core::TriMesh;

/// Values that colour a mesh, by the element they belong to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Values<'a> {
    /// One per vertex, linear on faces.
    Vertices(&'a [f64]),
    /// One per face, constant on it.
    Faces(&'a [f64]),
    /// Three per face, in the order of its corners, linear on it.
    Corners(&'a [[f64; 3]]),
}

/// One view of a mesh.
///
/// # Shapes and units
/// Positions are in the unit of the mesh, widths in pixels.
///
/// # Limits
/// NaN gets the scale's colour for missing values; marks with non-finite positions are not drawn.
#[derive(Clone, Debug)]
pub struct Panel<'a> {
    pub(crate) mesh: &'a TriMesh,
    pub(crate) values: Option<Values<'a>>,
    pub(crate) vectors: Option<&'a [[f64; 3]]>,
    pub(crate) normals: Option<&'a [[f64; 3]]>,
    pub(crate) title: String,
    pub(crate) edges: bool,
    pub(crate) marks: Vec<Mark>,
    /// Points with texts beside them.
    pub(crate) labels: Vec<([f64; 3], String)>,
}

impl<'a> Panel<'a> {
    /// A mesh in one colour.
    pub fn new(mesh: &'a TriMesh) -> Self {
        Self {
            mesh,
            values: None,
            vectors: None,
            normals: None,
            title: String::new(),
            edges: false,
            marks: Vec::new(),
            labels: Vec::new(),
        }
    }

    /// Colours the mesh by values on the figure's scale.
    #[must_use]
    pub fn with_values(mut self, values: Values<'a>) -> Self {
        self.values = Some(values);
        self
    }

    /// Shows a tangent field, one vector per face, by streaks along it and arrows for its direction.
    ///
    /// Without values, the mesh is coloured by the magnitude of the field. Streaks fade where the field is weak relative to the
    /// upper end of the figure's scale, so that panels with a common scale are comparable.
    #[must_use]
    pub fn with_vectors(mut self, vectors: &'a [[f64; 3]]) -> Self {
        self.vectors = Some(vectors);
        self
    }

    /// Shades the mesh smoothly, with one normal for each vertex, of any length.
    ///
    /// By default every face is shaded flat. Where a normal is far from that of a face, as at sharp edges, the face keeps its own.
    /// [`vertex_normals`](crate::vertex_normals) computes normals.
    #[must_use]
    pub fn with_normals(mut self, normals: &'a [[f64; 3]]) -> Self {
        self.normals = Some(normals);
        self
    }

    /// Writes a line of text over the panel.
    #[must_use]
    pub fn with_title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Draws the edges of faces, where faces are large enough in the picture.
    #[must_use]
    pub fn with_edges(mut self) -> Self {
        self.edges = true;
        self
    }

    /// Draws a mark over the mesh; later marks cover earlier ones.
    #[must_use]
    pub fn with_mark(mut self, mark: Mark) -> Self {
        self.marks.push(mark);
        self
    }

    /// Draws a point with a text beside it, unless the mesh hides the point.
    #[must_use]
    pub fn with_label(mut self, at: [f64; 3], text: impl Into<String>) -> Self {
        self.marks.push(Mark::point(at).with_opacity_behind(0.0));
        self.labels.push((at, text.into()));
        self
    }

    /// Checks that the numbers of values and normals match the mesh.
    pub(crate) fn check(&self) -> Result<(), FigureError> {
        let [vertices, faces] = [self.mesh.positions().len(), self.mesh.faces().len()];
        let check = |what, found, expected, of| {
            if found == expected { Ok(()) } else { Err(FigureError::Count { what, found, expected, of }) }
        };
        match self.values {
            Some(Values::Vertices(values)) => check("values", values.len(), vertices, "vertices")?,
            Some(Values::Faces(values)) => check("values", values.len(), faces, "faces")?,
            Some(Values::Corners(values)) => check("triples of values", values.len(), faces, "faces")?,
            None => {}
        }
        self.vectors.map_or(Ok(()), |vectors| check("vectors", vectors.len(), faces, "faces"))?;
        self.normals.map_or(Ok(()), |normals| check("normals", normals.len(), vertices, "vertices"))
    }
}

/// The shape of a [`Mark`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum MarkShape {
    /// A straight line between two points.
    Segment([[f64; 3]; 2]),
    /// A disc around a point.
    Point([f64; 3]),
    /// A straight line with a head at its second point.
    Arrow([[f64; 3]; 2]),
}

/// A point, a segment or an arrow with a width in pixels, drawn over a mesh, with reduced opacity where the mesh hides it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    pub(crate) shape: MarkShape,
    pub(crate) width: f64,
    pub(crate) color: Option<Rgb>,
    pub(crate) behind: f64,
}

impl Mark {
    /// Default opacity of hidden parts, so that they can be found.
    const BEHIND: f64 = 0.45;

    /// A straight line, 2.5 pixels wide.
    pub fn segment(from: [f64; 3], to: [f64; 3]) -> Self {
        Self { shape: MarkShape::Segment([from, to]), width: 2.5, color: None, behind: Self::BEHIND }
    }

    /// A disc, 9 pixels wide.
    pub fn point(at: [f64; 3]) -> Self {
        Self { shape: MarkShape::Point(at), width: 9.0, color: None, behind: Self::BEHIND }
    }

    /// A straight line with a head at `to`, 1.5 pixels wide.
    pub fn arrow(from: [f64; 3], to: [f64; 3]) -> Self {
        Self { shape: MarkShape::Arrow([from, to]), width: 1.5, color: None, behind: Self::BEHIND }
    }

    /// Changes the width, in pixels.
    #[must_use]
    pub fn with_width(mut self, width: f64) -> Self {
        self.width = width;
        self
    }

    /// Sets the colour instead of that of the theme.
    #[must_use]
    pub fn with_color(mut self, color: Rgb) -> Self {
        self.color = Some(color);
        self
    }

    /// Sets the opacity of the mark where the mesh hides it: from 0, invisible, to 1, as if in front of the mesh.
    #[must_use]
    pub fn with_opacity_behind(mut self, opacity: f64) -> Self {
        self.behind = opacity;
        self
    }
}
