//! A deviation as people look at it.

use crate::errors::{Raise, unknown};
use crate::mesh::Mesh;
use crate::wait;
use pompeiu::core::TriMesh;
use pompeiu::figures::paper::Paper;
use pompeiu::figures::{Theme, View};
use pompeiu::hausdorff::deviation::{BandReport, Deviation};
use pompeiu::hausdorff::show::{self, NamedMesh, search_stages};
use pyo3::prelude::*;

/// What a page and a picture are made from: both meshes and what was found.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct DeviationPage {
    a: Py<Mesh>,
    b: Py<Mesh>,
    deviation: Deviation,
    threshold: Option<f64>,
    bands: Option<BandReport>,
}

/// How the meshes are called and shown, from a dictionary.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Look {
    names: [String; 2],
    unit: String,
    up: [f64; 3],
}

impl DeviationPage {
    pub(super) fn new(
        [a, b]: [&Bound<'_, Mesh>; 2],
        deviation: Deviation,
        threshold: Option<f64>,
        bands: Option<BandReport>,
    ) -> Self {
        Self { a: a.clone().unbind(), b: b.clone().unbind(), deviation, threshold, bands }
    }

    fn page<'r>(&'r self, [a, b]: &'r [String; 2], unit: &'r str, up: [f64; 3]) -> show::DeviationPage<'r> {
        show::DeviationPage {
            a: named(a, self.a.get().inner()),
            b: named(b, self.b.get().inner()),
            deviation: &self.deviation,
            stages: &[],
            unit,
            up,
            threshold: self.threshold,
            bands: self.bands.as_ref(),
            verdict: None,
            command: None,
        }
    }
}

fn named<'m>(path: &'m str, mesh: &'m TriMesh) -> NamedMesh<'m> {
    NamedMesh { path, mesh, whole: mesh }
}

fn looking(up: [f64; 3], direction_to_eye: Option<[f64; 3]>) -> View {
    let view = View::default().with_up(up);
    direction_to_eye.map_or(view, |direction| view.with_direction_to_eye(direction))
}

/// Draws, and returns at once on Ctrl-C.
fn drawn<R: Send + 'static>(
    of: &Bound<'_, DeviationPage>,
    draw: impl FnOnce(&DeviationPage) -> R + Send + 'static,
) -> PyResult<R> {
    let this = of.clone().unbind();
    wait::abandonable(of.py(), move || draw(this.get()))
}

#[pymethods]
impl DeviationPage {
    /// The page as a file.
    fn html(of: &Bound<'_, Self>, look: Look) -> PyResult<String> {
        let Look { names, unit, up } = look;
        let html = drawn(of, move |this| {
            let stages = search_stages(this.a.get().inner(), this.b.get().inner());
            show::DeviationPage { stages: &stages, ..this.page(&names, &unit, up) }.figures().html()
        })?;
        html.map_err(Raise::raise)
    }

    /// A document for printing, as the bytes of a PDF file.
    fn pdf(
        of: &Bound<'_, Self>,
        look: Look,
        direction_to_eye: Option<[f64; 3]>,
        verdict: Option<String>,
        paper: &str,
    ) -> PyResult<Vec<u8>> {
        let Look { names, unit, up } = look;
        let paper = match paper {
            "a4" => Paper::A4,
            "letter" => Paper::Letter,
            other => return Err(unknown("paper", other, "\"a4\" or \"letter\"")),
        };
        let view = looking(up, direction_to_eye);
        let measured = |name: &str, mesh: &TriMesh| {
            let (vertices, faces) = (mesh.positions().len(), mesh.faces().len());
            [name.to_owned(), format!("{vertices} vertices, {faces} faces")]
        };
        let provenance = [
            measured(&names[0], of.get().a.get().inner()),
            measured(&names[1], of.get().b.get().inner()),
            ["program".to_owned(), format!("pompeiu {} in Python", env!("CARGO_PKG_VERSION"))],
        ];
        let pdf = drawn(of, move |this| {
            let figures = this.page(&names, &unit, up).figures();
            figures.document(verdict, &provenance, view, paper).map(|document| document.pdf())
        })?;
        pdf.map_err(Raise::raise)
    }

    /// The picture as the bytes of a PNG file.
    fn png(
        of: &Bound<'_, Self>,
        look: Look,
        direction_to_eye: Option<[f64; 3]>,
        size: (u32, u32),
        theme: &str,
    ) -> PyResult<Vec<u8>> {
        let Look { names, unit, up } = look;
        let theme = match theme {
            "light" => Theme::Light,
            "dark" => Theme::Dark,
            other => return Err(unknown("theme", other, "\"light\" or \"dark\"")),
        };
        let view = looking(up, direction_to_eye);
        let (width, height) = size;
        let image =
            drawn(of, move |this| this.page(&names, &unit, up).figures().image(width, height, theme, view))?;
        let mut png = Vec::new();
        image.map_err(Raise::raise)?.write_png(&mut png)?;
        Ok(png)
    }
}
