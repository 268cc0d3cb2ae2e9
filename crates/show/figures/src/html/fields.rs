//! The page of tangent fields on one surface.

use super::deviation::Axis;
use super::encode::{doubles, first_use_indices, singles};
use super::error::{check_finite, check_length};
use super::scene::{Indexed, Placement};
use super::{PageError, file};
use crate::ColorMap;
use serde_json::json;

/// Tangent fields on one surface, beside each other at one scale: most often a field and the parts that it is split into.
///
/// The page shows what it is given and computes nothing: norms, inner products and what is left over are the caller's.
///
/// # Shapes and units
/// One vector for each face and field, in the coordinates of the surface. Norms are those of fields over the surface.
///
/// # Example
/// ```
/// use pompeiu_figures::html::{FieldsPage, PageField};
///
/// let field = |label: &str, x: f64| PageField { label: label.into(), vectors: vec![[x, 0.0, 0.0]], norm: x };
/// let page = FieldsPage {
///     title: "A field of one vector".into(),
///     corners: vec![[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]],
///     fields: vec![field("field", 1.0), field("gradient", 1.0), field("harmonic", 0.0)],
///     inner_products: vec![vec![0.5, 0.5, 0.0], vec![0.5, 0.5, 0.0], vec![0.0; 3]],
///     ..FieldsPage::default()
/// };
/// assert!(page.html()?.contains("A field of one vector"));
/// # Ok::<(), pompeiu_figures::html::PageError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FieldsPage {
    /// What the page is about.
    pub title: String,
    /// The unit of vectors as it is to be shown; may be empty.
    pub unit: String,
    /// The axis that points up at first.
    pub up: Axis,
    /// The name of the surface's file.
    pub name: String,
    /// The file with its folder.
    pub path: String,
    /// Vertices of the surface.
    pub vertices: usize,
    /// Corners of each face.
    pub corners: Vec<[[f64; 3]; 3]>,
    /// The fields, in the order shown.
    pub fields: Vec<PageField>,
    /// The inner product of each field with each.
    pub inner_products: Vec<Vec<f64>>,
    /// The norm of what the parts leave over of the field.
    pub residual: f64,
    /// More numbers, such as degrees of freedom.
    pub tables: Vec<PageTable>,
    /// Remarks, paragraph by paragraph.
    pub notes: Vec<String>,
    /// Anything else about the run: names and values.
    pub facts: Vec<[String; 2]>,
    /// The command that makes this page again.
    pub command: Option<String>,
    /// The version of the program.
    pub version: String,
}

/// A field that is constant on each face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PageField {
    /// What it is called.
    pub label: String,
    /// Its vector on each face.
    pub vectors: Vec<[f64; 3]>,
    /// Its norm over the surface.
    pub norm: f64,
}

/// A table of text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PageTable {
    /// What it is about.
    pub title: String,
    /// Heads of its columns.
    pub head: Vec<String>,
    /// Its rows; the first entry names the row.
    pub rows: Vec<Vec<String>>,
}

impl FieldsPage {
    /// The page as a file.
    ///
    /// # Accuracy
    /// Vectors travel in double precision; coordinates are rounded to single precision relative to the middle of the scene.
    ///
    /// # Errors
    /// What is missing, does not belong together or is no number; see [`PageError`].
    ///
    /// # Cost
    /// Linear in faces times fields: some 30 bytes for each vector, and 0.7 MB.
    pub fn html(&self) -> Result<String, PageError> {
        self.check()?;
        let placement = Placement::around(self.corners.as_flattened());
        let indexed = Indexed::new(placement, &self.corners, None);
        let field = |field: &PageField| {
            let vectors = doubles(field.vectors.as_flattened().iter().copied());
            json!({ "label": field.label, "norm": field.norm, "vectors": vectors })
        };
        let table =
            |table: &PageTable| json!({ "title": table.title, "head": table.head, "rows": table.rows });
        let data = json!({
            "kind": "fields",
            "title": self.title,
            "unit": self.unit,
            "up": self.up.name(),
            "origin": placement.origin,
            "scale": placement.scale,
            "colors": { "name": ColorMap::Viridis.name(), "table": ColorMap::Viridis.table().as_flattened() },
            "surface": {
                "name": self.name, "path": self.path, "vertices": self.vertices, "faces": self.corners.len(),
                "positions": singles(indexed.positions.as_flattened().iter().copied()),
                "indices": first_use_indices(&indexed.indices),
            },
            "fields": self.fields.iter().map(field).collect::<Vec<_>>(),
            "innerProducts": self.inner_products,
            "residual": self.residual,
            "tables": self.tables.iter().map(table).collect::<Vec<_>>(),
            "notes": self.notes,
            "facts": self.facts,
            "command": self.command,
            "version": self.version,
        });
        Ok(file(&self.title, &format!("{}.", self.title), &data))
    }

    fn check(&self) -> Result<(), PageError> {
        if self.corners.is_empty() {
            return Err(PageError::NoTriangles { surface: 0 });
        }
        if self.fields.is_empty() {
            return Err(PageError::NothingMeasured);
        }
        check_finite("a corner of a face", self.corners.as_flattened().as_flattened())?;
        for field in &self.fields {
            check_length("a field", field.vectors.len(), self.corners.len())?;
            check_finite("a field", field.vectors.as_flattened())?;
            check_finite("the norm of a field", [&field.norm])?;
        }
        check_length("the list of inner products", self.inner_products.len(), self.fields.len())?;
        for row in &self.inner_products {
            check_length("a row of inner products", row.len(), self.fields.len())?;
            check_finite("a row of inner products", row)?;
        }
        check_finite("what the parts leave over", [&self.residual])
    }
}
