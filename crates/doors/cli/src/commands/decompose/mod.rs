//! `pompeiu decompose`.

mod output;
mod text;

use crate::args::Picture;
use crate::called::called;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::{field, files};
use anyhow::bail;
use clap::Args;
use pompeiu::fields::show::DecompositionPage;
use pompeiu::fields::{DecomposeError, DecomposeReport, DecomposeRequest};
use pompeiu::operators::FieldSource;
use std::path::{Path, PathBuf};

pub(crate) use crate::door::run;

pub(crate) type Decompose = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
The mesh must be an orientable manifold, with or without boundary. The parts add up to the field and are orthogonal to each other;
the report says how nearly.

Fields:
  FILE             a vector for each face: VTP or VTU cell data, PLY properties NAME_x, NAME_y, NAME_z, or CSV
  rotation:AXIS    rotation about an axis through the origin, x, y, z or three numbers: 0,1,1
  gradient:WHAT    gradient of a coordinate, of a direction such as 0,1,1, or of an expression such as sin(x)*y^2
  random:SEED      random vectors
  harmonic:K       the harmonic field with number K, from 0

OUT is VTP, VTU or PLY, or VTP.gz: vectors field, gradient, rotated and harmonic on faces, and both potentials, one on vertices
and one on faces (its value at their centres).

Examples:
  pompeiu decompose torus.obj --field rotation:z -o parts.vtp
  pompeiu decompose torus.obj --field rotation:z --image parts.png --up z
  pompeiu decompose scan.ply --field wind.csv --json
  pompeiu decompose open.obj --field gradient:x*y --boundary normal
  pompeiu decompose fertility.off")]
pub(crate) struct Files {
    /// The mesh file
    mesh: PathBuf,
    /// Write the field, its parts and their potentials
    #[arg(long, short, value_name = "OUT")]
    output: Option<PathBuf>,
    #[command(flatten)]
    picture: Picture,
}

impl Files {
    fn outputs(&self) -> impl Iterator<Item = &Path> {
        self.output.iter().map(PathBuf::as_path).chain(self.picture.outputs())
    }
}

impl System for Files {
    type Request = DecomposeRequest;

    fn check(&self, _json: bool) -> anyhow::Result<()> {
        self.output.as_deref().map_or(Ok(()), output::check)?;
        files::check_places(self.outputs(), &[&self.mesh])
    }

    fn run(
        &self,
        request: &mut DecomposeRequest,
        session: &mut Session<'_>,
    ) -> anyhow::Result<DecomposeReport> {
        let source = request.field.as_ref();
        if source.is_none() && self.outputs().next().is_some() {
            bail!("-o, --report and --image show a field and its parts; name one with --field");
        }
        let file = source.and_then(FieldSource::file);
        if let Some(file) = file {
            files::check_places(self.outputs(), &[&self.mesh, file])?;
            // Before what may take long.
            files::check_readable(file)?;
        }
        let shown = self.mesh.display().to_string();
        let (mesh, surface) = session.read_surface(&self.mesh)?;
        let read = source.map(|source| field::vectors(source, request.name.as_deref())).transpose()?;
        session.wait.show("splitting".to_owned());
        let found = request.run(&surface, read.flatten().as_deref());
        session.stop_waiting();
        let found = found.map_err(|error| {
            let place = match (&error, file) {
                (DecomposeError::Surface(_), _) => shown.clone(),
                (DecomposeError::Source(_), Some(file)) => file.display().to_string(),
                _ => "--field".to_owned(),
            };
            anyhow::Error::from(error).context(place)
        })?;
        let Some((field, parts)) = &found.split else { return Ok(found.report) };
        let printer = session.printer;
        if let Some(source) = source {
            field::warn_of_normal_part(source, (field.is_tangent, field.normal_part), printer);
        }
        let field = &field.field;
        if let Some(output) = &self.output {
            output::write(output, &mesh, &surface, request.splitting, field, parts, printer)?;
        }
        let page = DecompositionPage {
            path: &shown,
            mesh: &mesh,
            surface: &surface,
            field,
            parts,
            degrees_of_freedom: found.report.degrees_of_freedom,
            up: self.picture.up.axis(),
            command: Some(&called()),
        };
        self.picture.write(
            || page.html(),
            |width, height, theme, view| page.image(width, height, theme, view),
            printer,
        )?;
        Ok(found.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(&self.mesh, answer)
    }
}
