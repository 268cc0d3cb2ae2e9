//! What is made of a result: files, arrays, pages, documents.

use crate::error::CallError;
use crate::meshes::{Loaded, Meshes};
use crate::pages::{self, Changed};
use pompeiu::core::TriMesh;
use pompeiu::core::request::InfoReport;
use pompeiu::core::run::Limits;
use pompeiu::figures::View;
use pompeiu::figures::paper::Paper;
use pompeiu::flatten::Flattening;
use pompeiu::flatten::show::{FlattenPage, checker_png, layout_svg};
use pompeiu::hausdorff::show::{DeviationFigures, DeviationPage, search_stages};
use pompeiu::hausdorff::{Enclosure, PreparedPair};
use pompeiu::io::{Attributes, OutputFormat, encode};
use pompeiu::matching::request::AlignedDeviationReport;
use pompeiu::remesh::Remeshed;
use pompeiu::remesh::show::RemeshPage;
use pompeiu::surface::EmbeddedSurface;

/// Which way is up on pages.
const UP: [f64; 3] = [0.0, 0.0, 1.0];

/// What was found last, to be shown.
pub(crate) enum Found {
    Described(u32, Box<InfoReport>),
    Compared(Box<Compared>),
    Beside(u32, Box<Changed>),
    Remeshed(u32, Box<Remeshed>),
    Flat(Box<Flat>),
}

/// A surface and its map.
pub(crate) struct Flat {
    pub(crate) name: String,
    pub(crate) surface: EmbeddedSurface,
    pub(crate) map: Flattening,
}

/// A deviation.
pub(crate) struct Compared {
    pair: PreparedPair<'static>,
    report: AlignedDeviationReport,
    inputs: [String; 2],
    provenance: Vec<[String; 2]>,
    unit: String,
}

/// What the meshes of a comparison are called: as they should be, and as they are.
const NAMES: [&str; 2] = ["A", "B"];

impl Compared {
    pub(crate) fn new(
        pair: PreparedPair<'static>,
        report: AlignedDeviationReport,
        of: [&Loaded; 2],
        unit: &str,
    ) -> Self {
        let described = |loaded: &Loaded| {
            let input = &loaded.input;
            format!("{}: {} vertices, {} faces", loaded.name(), input.vertices, input.faces)
        };
        let mut provenance = Vec::new();
        for (name, loaded) in NAMES.into_iter().zip(of) {
            provenance.push([name.to_owned(), described(loaded)]);
            provenance
                .extend(loaded.input.sha256.iter().map(|sum| [String::new(), format!("SHA-256 {sum}")]));
        }
        let inputs = of.map(|loaded| loaded.name().to_owned());
        Self { pair, report, inputs, provenance, unit: unit.to_owned() }
    }

    /// Draws, with the command that does the same.
    fn with_figures<R>(
        &self,
        with_stages: bool,
        command: Option<&str>,
        draw: impl FnOnce(&DeviationFigures<'_>) -> Result<R, CallError>,
    ) -> Result<R, CallError> {
        let limits = Limits::default();
        let report = &self.report.measured;
        let stages = if with_stages { search_stages(&self.pair, &limits) } else { Vec::new() };
        let sentence = report.sentence(NAMES, &self.unit);
        let [a, b] = &self.inputs;
        let page = DeviationPage {
            pair: &self.pair,
            paths: [a, b],
            names: NAMES,
            deviation: &report.deviation,
            stages: &stages,
            unit: &self.unit,
            up: UP,
            threshold: report.threshold,
            bands: report.bands.as_ref(),
            verdict: report.verdict.as_ref().map(|found| found.answer).zip(sentence.as_deref()),
            proof: None,
            command,
        };
        draw(&page.figures(&limits))
    }
}

impl Found {
    /// A mesh beside the one that it was made of.
    pub(crate) fn beside(of: u32, what: &'static str, mesh: &TriMesh, distance: Option<Enclosure>) -> Self {
        Self::Beside(of, Box::new(Changed { what, mesh: mesh.clone(), distance }))
    }

    /// A page to explore.
    pub(crate) fn page(&self, meshes: &Meshes, command: Option<&str>) -> Result<String, CallError> {
        match self {
            Self::Compared(found) => found.with_figures(true, command, |figures| Ok(figures.html()?)),
            Self::Described(id, report) => pages::described(meshes.get(*id)?, report, command),
            Self::Beside(id, changed) => pages::changed(meshes.get(*id)?, changed, command),
            Self::Remeshed(id, found) => {
                let loaded = meshes.get(*id)?;
                let (path, input) = (loaded.name(), &loaded.mesh);
                Ok(RemeshPage { path, input, found, proof: None, up: UP, command }.html()?)
            }
            Self::Flat(found) => {
                let Flat { name, surface, map: flat } = &**found;
                Ok(FlattenPage { path: name, surface, flat, up: UP, command }.html()?)
            }
        }
    }

    /// A document for printing.
    pub(crate) fn document(&self, command: Option<&str>) -> Result<Vec<u8>, CallError> {
        let Self::Compared(found) = self else { return Err(CallError::NothingFound("printed")) };
        let mut provenance = found.provenance.clone();
        provenance.extend(command.map(|command| ["command".to_owned(), command.to_owned()]));
        provenance.push(["program".to_owned(), format!("pompeiu {}", env!("CARGO_PKG_VERSION"))]);
        found.with_figures(false, command, |figures| {
            Ok(figures.document(None, &provenance, View::default(), Paper::A4)?.pdf())
        })
    }

    /// The drawing of a map.
    pub(crate) fn drawing(&self) -> Result<String, CallError> {
        match self {
            Self::Flat(found) => Ok(layout_svg(&found.surface, &found.map)),
            _ => Err(CallError::NothingFound("drawn")),
        }
    }
}

/// A mesh in the format of a suffix.
pub(crate) fn file(loaded: &Loaded, suffix: &str) -> Result<Vec<u8>, CallError> {
    let Some(format) = OutputFormat::ALL.into_iter().find(|format| format.suffix() == suffix) else {
        return Err(CallError::Format(suffix.to_owned()));
    };
    let mut attributes = Attributes::for_mesh(&loaded.mesh);
    if let Some(texture) = loaded.texture.as_ref().filter(|_| format.holds_texture()) {
        let image = if format == OutputFormat::Glb {
            Some(checker_png().map_err(CallError::of_system)?)
        } else {
            None
        };
        attributes = attributes
            .with_texture(texture.coordinates.clone(), texture.corners.clone(), image)
            .map_err(CallError::of_system)?;
    }
    let mut bytes = Vec::new();
    encode(&mut bytes, format, &loaded.mesh, &attributes)?;
    Ok(bytes)
}

/// Rows of three as bytes.
pub(crate) fn bytes<T: Copy, const N: usize>(rows: &[[T; 3]], of: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    bytes_of(rows.as_flattened(), of)
}

/// Numbers as bytes.
pub(crate) fn bytes_of<T: Copy, const N: usize>(entries: &[T], of: impl Fn(T) -> [u8; N]) -> Vec<u8> {
    entries.iter().flat_map(|&entry| of(entry)).collect()
}

/// Rows of three from bytes.
pub(crate) fn rows<T, const N: usize>(
    bytes: &[u8],
    of: impl Fn([u8; N]) -> T,
) -> Result<Vec<[T; 3]>, CallError> {
    let (entries, rest) = bytes.as_chunks::<N>();
    if entries.len() % 3 != 0 || !rest.is_empty() {
        return Err(CallError::Rows { bytes: bytes.len(), row: 3 * N });
    }
    Ok(entries.chunks_exact(3).map(|row| [of(row[0]), of(row[1]), of(row[2])]).collect())
}
