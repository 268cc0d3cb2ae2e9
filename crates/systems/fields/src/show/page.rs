//! A tangent field and its parts as a page and as a picture.

use super::content::{FieldsContent, NamedField, TextTable};
use crate::{Decomposition, DegreesOfFreedom, Ranks};
use pompeiu_core::TriMesh;
use pompeiu_figures::names::{axis, name};
use pompeiu_figures::page::PageError;
use pompeiu_figures::{ColorMap, Figure, FigureError, Image, Panel, Scale, Theme, View, vertex_normals};
use pompeiu_operators::{FaceField, field_inner_product};
use pompeiu_surface::EmbeddedSurface;

/// The page of a field and its gradient, rotated gradient and harmonic part.
///
/// # Example
/// ```
/// use pompeiu_core::mesh::shapes::torus;
/// use pompeiu_fields::show::DecompositionPage;
/// use pompeiu_fields::{Boundary, DecompositionOptions, DegreesOfFreedom, HodgeSolver};
/// use pompeiu_operators::rotation_field;
/// use pompeiu_surface::EmbeddedSurface;
///
/// let mesh = torus(0.75, 0.25, 32, 16)?;
/// let surface = EmbeddedSurface::new(&mesh)?;
/// let solver = HodgeSolver::new(surface.surface(), &DecompositionOptions::default())?;
/// let field = rotation_field(&surface, [0.0, 0.0, 1.0]);
/// let parts = solver.decompose(&field)?;
/// let page = DecompositionPage {
///     path: "torus.obj",
///     mesh: &mesh,
///     surface: &surface,
///     field: &field,
///     parts: &parts,
///     degrees_of_freedom: DegreesOfFreedom::of(surface.mesh(), Boundary::Tangential),
///     up: [0.0, 0.0, 1.0],
///     command: None,
/// };
/// assert!(page.html()?.contains("torus.obj"));
/// assert_eq!(page.image(640, 480, Default::default(), Default::default())?.height(), 480);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DecompositionPage<'r> {
    /// The file of the mesh or another name.
    pub path: &'r str,
    /// The mesh.
    pub mesh: &'r TriMesh,
    /// The same as a surface.
    pub surface: &'r EmbeddedSurface,
    /// The field, in the frames of the faces.
    pub field: &'r FaceField,
    /// Its parts.
    pub parts: &'r Decomposition,
    /// The degrees of freedom.
    pub degrees_of_freedom: DegreesOfFreedom,
    /// The up direction.
    pub up: [f64; 3],
    /// The command that reproduces the page.
    pub command: Option<&'r str>,
}

impl DecompositionPage<'_> {
    /// The four fields as vectors in space, each with its share of the energy.
    fn fields(&self) -> [(String, Vec<[f64; 3]>); 4] {
        let norms = self.parts.quality.norms;
        let in_space = |u: &FaceField| -> Vec<[f64; 3]> {
            self.mesh.face_ids().map(|face| self.surface.to_space(face, u[face])).collect()
        };
        let titled = |name: &str, norm: f64, u: &FaceField| {
            let part = if norms.field > 0.0 { norm / norms.field } else { 0.0 };
            (format!("{name}, {:.3} % of the energy", 100.0 * part * part), in_space(u))
        };
        [
            ("field".to_owned(), in_space(self.field)),
            titled("gradient", norms.gradient, &self.parts.gradient),
            titled("rotated gradient", norms.rotated, &self.parts.rotated),
            titled("harmonic", norms.harmonic, &self.parts.harmonic),
        ]
    }

    /// The page as an HTML file.
    ///
    /// # Errors
    /// [`PageError`] if a field is not finite or not on this mesh.
    pub fn html(&self) -> Result<String, PageError> {
        Ok(self.content().page()?.html())
    }

    /// The data of the page.
    fn content(&self) -> FieldsContent {
        let Decomposition { gradient, rotated, harmonic, quality, .. } = self.parts;
        let norms = quality.norms;
        let all = [self.field, gradient, rotated, harmonic];
        let inner = |u: &FaceField, w: &FaceField| field_inner_product(self.surface.surface(), u, w);
        let fields = self.fields().into_iter().zip([
            ("field", norms.field),
            ("gradient", norms.gradient),
            ("rotated gradient", norms.rotated),
            ("harmonic", norms.harmonic),
        ]);
        let surface = self.surface.mesh();
        FieldsContent {
            title: format!("A field on {} and its parts", name(self.path)),
            up: axis(self.up),
            name: name(self.path).to_owned(),
            path: self.path.to_owned(),
            vertices: surface.vertices(),
            corners: self.mesh.face_ids().map(|face| self.mesh.corners(face)).collect(),
            fields: fields
                .map(|((_, vectors), (label, norm))| NamedField { label: label.to_owned(), vectors, norm })
                .collect(),
            inner_products: all.iter().map(|u| all.iter().map(|w| inner(u, w)).collect()).collect(),
            residual: quality.residual * norms.field,
            tables: vec![self.freedom()],
            notes: vec![format!(
                "No part is farther from the true one than {:.1e} of the norm of the field: what the three parts leave over, and how \
                 far the harmonic part is from the harmonic fields, measured by projecting it onto both other spaces.",
                quality.part_error
            )],
            facts: vec![
                ["components".to_owned(), surface.components().to_string()],
                ["genus".to_owned(), surface.genus().to_string()],
                ["boundary loops".to_owned(), surface.boundary_loops().len().to_string()],
                ["dimension of the harmonic fields".to_owned(), self.degrees_of_freedom.harmonic.to_string()],
            ],
            command: self.command.map(str::to_owned),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            ..FieldsContent::default()
        }
    }

    fn freedom(&self) -> TextTable {
        let row = |label: &str, ranks: Ranks| {
            let counts = [ranks.gradient, ranks.rotated].map(|rank| rank.to_string());
            std::iter::once(label.to_owned())
                .chain(counts)
                .chain([ranks.residual_dimension.to_string()])
                .collect()
        };
        TextTable {
            title: format!("{} degrees of freedom", self.degrees_of_freedom.total),
            head: ["functions", "gradients", "rotated gradients", "residual dimension"]
                .map(str::to_owned)
                .to_vec(),
            rows: vec![
                row("one space for each potential", self.degrees_of_freedom.mixed),
                row("conforming only", self.degrees_of_freedom.conforming),
                row("nonconforming only", self.degrees_of_freedom.nonconforming),
            ],
        }
    }

    /// A picture of the field and its parts on one scale, of the given size in pixels.
    ///
    /// # Errors
    /// [`FigureError`] for an invalid size.
    pub fn image(&self, width: u32, height: u32, theme: Theme, view: View) -> Result<Image, FigureError> {
        let fields = self.fields();
        let length = |u: &[f64; 3]| (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]).sqrt();
        let greatest = |m: f64, u: &[f64; 3]| if length(u) > m { length(u) } else { m };
        let largest = fields.iter().flat_map(|(_, u)| u).fold(0.0, greatest);
        let normals = vertex_normals(self.mesh);
        let mut figure = Figure::new(width, height)
            .with_theme(theme)
            .with_view(view)
            .with_scale(Scale::new(ColorMap::Viridis, 0.0, largest)?, "length of the vectors");
        for (title, field) in &fields {
            let panel = Panel::new(self.mesh).with_vectors(field).with_normals(&normals).with_title(title);
            figure = figure.with_panel(panel);
        }
        figure.draw()
    }
}
