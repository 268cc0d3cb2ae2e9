//! A tangent field and its parts as a picture.

use pompeiu_core::TriMesh;
use pompeiu_figures::{ColorMap, Figure, FigureError, Image, Panel, Scale, Theme, View, vertex_normals};
use pompeiu_operators::{Decomposition, FaceField};
use pompeiu_surface::EmbeddedSurface;

/// A field that was split into a gradient, a rotated gradient and a harmonic part, to be shown.
///
/// # Example
/// ```
/// use pompeiu::core::mesh::shapes::torus;
/// use pompeiu::operators::{Boundary, HodgeSolver, Splitting, rotation_field};
/// use pompeiu::report::FieldsReport;
/// use pompeiu::surface::EmbeddedSurface;
///
/// let mesh = torus(0.75, 0.25, 32, 16)?;
/// let surface = EmbeddedSurface::new(&mesh)?;
/// let solver = HodgeSolver::new(surface.surface(), Splitting::Primal, Boundary::Tangential)?;
/// let field = rotation_field(&surface, &mesh, [0.0, 0.0, 1.0]);
/// let parts = solver.decompose(&field)?;
/// let report = FieldsReport { mesh: &mesh, surface: &surface, field: &field, parts: &parts };
/// assert_eq!(report.image(640, 480, Default::default(), Default::default())?.height(), 480);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FieldsReport<'r> {
    /// The mesh.
    pub mesh: &'r TriMesh,
    /// The same as a surface.
    pub surface: &'r EmbeddedSurface,
    /// The field, in the frames of the faces.
    pub field: &'r FaceField,
    /// Its parts.
    pub parts: &'r Decomposition,
}

impl FieldsReport<'_> {
    /// The four fields as vectors in space, with the share of the energy that each has.
    fn fields(&self) -> [(String, Vec<[f64; 3]>); 4] {
        let norms = self.parts.quality.norms;
        let in_space = |u: &FaceField| -> Vec<[f64; 3]> {
            self.mesh.face_ids().map(|face| self.surface.to_space(face, u[face.index()])).collect()
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

    /// A picture of the field and its parts with one scale, of the given size in pixels.
    ///
    /// # Errors
    /// [`FigureError`] for a size that is none.
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
