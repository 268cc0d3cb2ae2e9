//! A deviation as people look at it.

use crate::errors::{Raise, unknown};
use crate::wait;
use pompeiu::core::TriMesh;
use pompeiu::core::run::Limits;
use pompeiu::figures::paper::Paper;
use pompeiu::figures::{Theme, View};
use pompeiu::hausdorff::show::{self, search_stages};
use pompeiu::hausdorff::{DeviationReport, PreparedPair, Stage};
use pyo3::prelude::*;

/// What a page and a picture are made from: both meshes with their trees, and what was found.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct DeviationPage {
    pair: PreparedPair<'static>,
    report: DeviationReport,
    unit: String,
}

/// How the meshes are called and shown, from a dictionary.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Look {
    names: [String; 2],
    unit: Option<String>,
    up: [f64; 3],
}

impl DeviationPage {
    pub(super) fn new(pair: PreparedPair<'static>, report: DeviationReport, unit: String) -> Self {
        Self { pair, report, unit }
    }

    fn unit<'r>(&'r self, look: &'r Look) -> &'r str {
        look.unit.as_deref().unwrap_or(&self.unit)
    }

    fn page<'r>(&'r self, look: &'r Look, stages: &'r [Stage]) -> show::DeviationPage<'r> {
        show::DeviationPage {
            pair: &self.pair,
            paths: look.names.each_ref().map(String::as_str),
            deviation: &self.report.deviation,
            stages,
            unit: self.unit(look),
            up: look.up,
            threshold: self.report.threshold,
            bands: self.report.bands.as_ref(),
            names: ["A", "B"],
            verdict: self.report.verdict.as_ref().map(|found| (found.answer, found.sentence.as_str())),
            proof: None,
            command: None,
        }
    }
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
        let html = drawn(of, move |this| {
            let limits = Limits::default();
            let stages = search_stages(&this.pair, &limits);
            this.page(&look, &stages).figures(&limits).html()
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
        let paper = match paper {
            "a4" => Paper::A4,
            "letter" => Paper::Letter,
            other => return Err(unknown("paper", other, "\"a4\" or \"letter\"")),
        };
        let view = looking(look.up, direction_to_eye);
        let measured = |name: &str, mesh: &TriMesh| {
            let (vertices, faces) = (mesh.positions().len(), mesh.faces().len());
            [name.to_owned(), format!("{vertices} vertices, {faces} faces")]
        };
        let pair = &of.get().pair;
        let provenance = [
            measured(&look.names[0], pair.a()),
            measured(&look.names[1], pair.b()),
            ["program".to_owned(), format!("pompeiu {} in Python", env!("CARGO_PKG_VERSION"))],
        ];
        let pdf = drawn(of, move |this| {
            let figures = this.page(&look, &[]).figures(&Limits::default());
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
        let theme = match theme {
            "light" => Theme::Light,
            "dark" => Theme::Dark,
            other => return Err(unknown("theme", other, "\"light\" or \"dark\"")),
        };
        let view = looking(look.up, direction_to_eye);
        let (width, height) = size;
        let image = drawn(of, move |this| {
            this.page(&look, &[]).figures(&Limits::default()).image(width, height, theme, view)
        })?;
        let mut png = Vec::new();
        image.map_err(Raise::raise)?.write_png(&mut png)?;
        Ok(png)
    }
}
