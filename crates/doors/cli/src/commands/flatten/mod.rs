//! `pompeiu flatten`.

mod output;
mod text;

use crate::appearance;
use crate::args::{ForbidFile, Picture};
use crate::called::called;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::files;
use crate::numbers::counted;
use anyhow::{Context, bail};
use clap::Args;
use output::{Kind, kind, write_textured};
use pompeiu::core::mesh::Precision;
use pompeiu::flatten::show::{FlattenPage, layout_svg};
use pompeiu::flatten::{FlattenReport, FlattenRequest};
use pompeiu::io::Appearance;
use std::path::PathBuf;

pub(crate) use crate::door::run;

pub(crate) type Flatten = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
The mesh must be a manifold; each of its parts becomes one chart, or several with --charts or --max-distortion, and all charts lie
in the unit square. That the map is one-to-one is decided exactly on the coordinates as they are stored. Without options the
boundary is free, and cuts are added until lengths are kept well. The exit code is 3 if the map is not one-to-one.

Outputs:
  .obj   the mesh with texture coordinates
  .glb   the same with a texture of squares, or with the materials of the input, if it has any: their texture coordinates follow the map
         as further sets
  .svg   the layout; both sides of each cut edge have one colour
  .png   surface and map beside each other

Boundaries:
  free             the least symmetric Dirichlet energy found (default)
  circle, square   in proportion to the lengths of the boundary
  own              the boundary as it is, where it lies in a plane
  polygon:X,Y;…    the corners of a convex polygon, counter-clockwise

Examples:
  pompeiu flatten cow.off -o cow.obj --report cow.html
  pompeiu flatten cow.off --max-distortion 4.05 -o cow.glb
  pompeiu flatten torus.obj --strategy genus -o torus.svg
  pompeiu flatten face.ply --boundary circle --weights mean-value -o face.png")]
pub(crate) struct Files {
    /// The mesh file
    mesh: PathBuf,
    #[command(flatten)]
    forbid: ForbidFile,
    /// The file to write: .obj, .glb, .svg or .png
    #[arg(long, short, value_name = "OUT")]
    output: Option<PathBuf>,
    #[command(flatten)]
    picture: Picture,
}

impl System for Files {
    type Request = FlattenRequest;

    fn check(&self, json: bool) -> anyhow::Result<()> {
        if self.output.is_none() && self.picture.outputs().next().is_none() && !json {
            bail!(
                "nothing would be written; name the result with -o, or ask for --report, --image or --json"
            );
        }
        self.output.as_deref().map(kind).transpose()?;
        let outputs = self.output.iter().map(PathBuf::as_path).chain(self.picture.outputs());
        files::check_places(outputs, &[&self.mesh])
    }

    fn run(&self, request: &mut FlattenRequest, session: &mut Session<'_>) -> anyhow::Result<FlattenReport> {
        let shown = self.mesh.display().to_string();
        let (mesh, surface) = session.read_surface(&self.mesh)?;
        self.forbid.add_to(&mut request.cut)?;
        if let Some(Kind::Textured(format)) = self.output.as_deref().map(kind).transpose()?
            && format.precision() == Precision::Single
        {
            request.precision = Precision::Single;
        }
        let found = request.run(surface, &session.context()).with_context(|| shown.clone())?;
        session.stop_waiting();
        let (flat, printer) = (&found.flat, session.printer);
        if found.divided > 0 {
            let edges = counted(found.divided, "edge");
            let (are, midpoints) =
                if found.divided == 1 { ("is", "its midpoint") } else { ("are", "their midpoints") };
            printer.note(format_args!(
                "{edges} {are} divided at {midpoints}, because both ends are on one side of the boundary"
            ));
        }
        let page = FlattenPage {
            path: &shown,
            surface: &found.surface,
            flat,
            up: self.picture.up.axis(),
            command: Some(&called()),
        };
        if let Some(output) = &self.output {
            match kind(output)? {
                Kind::Textured(format) => {
                    let looks = if found.inserted.is_some() {
                        let why = "because edges were divided";
                        appearance::leave_out(&self.mesh, &mesh, why, printer)?;
                        Appearance::default()
                    } else {
                        appearance::read(&self.mesh, &mesh, output, printer)?
                    };
                    let mesh = found.inserted.as_ref().unwrap_or(&mesh);
                    write_textured(output, format, mesh, (flat, looks), printer)?;
                }
                Kind::Drawing => {
                    files::write_whole(output, layout_svg(&found.surface, flat).as_bytes(), printer)?;
                }
                Kind::Picture => self.picture.write_image(
                    output,
                    |width, height, theme, view| page.image(width, height, theme, view),
                    printer,
                )?,
            }
        }
        self.picture.write(
            || page.html(),
            |width, height, theme, view| page.image(width, height, theme, view),
            printer,
        )?;
        Ok(found.flat.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(answer)
    }
}
