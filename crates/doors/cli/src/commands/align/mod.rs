//! `pompeiu align`.

mod text;

use crate::args::{suffix, tell};
pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::numbers::shortest;
use crate::pair;
use crate::{appearance, files};
use clap::Args;
use pompeiu::core::mesh::Coordinates;
use pompeiu::io::OutputFormat;
use pompeiu::matching::align::Registration;
use pompeiu::matching::request::{AlignReport, AlignRequest};
use std::fmt::Write;
use std::path::PathBuf;

pub(crate) type Align = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
The rotation and translation are found from the shapes: it does not matter how the files lie, and parts of either mesh may
have no counterpart in the other. What is found is a guess, so the answer says how much of the moved surface is matched and how
well, which other places fit nearly as well, which motions leave the fit as it is, and whether anything fits at all. The
distances of the moved mesh are proven. Both meshes must be in the same unit; with --scale one factor is found too, which needs
meshes that overlap nearly whole, and told with its standard deviation.

The matrix is that of the map as four rows that act on columns (x, y, z, 1), as CloudCompare takes it under \"Apply transformation\".
The row ParaView holds what its filter Transform takes.

Exit codes:
  0  done
  2  a file or an argument cannot be used
  3  the time limit ran out first, or nothing fits: the shapes seem to be different ones

Examples:
  pompeiu align scan.ply model.obj -o moved.ply
  pompeiu align part.stl whole.stl --overlap 0.3 --matrix part.txt
  pompeiu align inches.obj model.obj --scale -o moved.obj --json")]
pub(crate) struct Files {
    /// The mesh file to move
    #[arg(value_name = "MOVING")]
    moving: PathBuf,
    /// The mesh file that stays
    #[arg(value_name = "FIXED")]
    fixed: PathBuf,
    /// Write the moved mesh
    #[arg(long, short, value_name = "MOVED")]
    output: Option<PathBuf>,
    /// Write the matrix as text, four rows of four numbers: what `CloudCompare` reads
    #[arg(long, value_parser = suffix::matrix, value_name = "FILE")]
    matrix: Option<PathBuf>,
}

impl System for Files {
    type Request = AlignRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        let inputs = [self.moving.as_path(), self.fixed.as_path()];
        pair::check(inputs)?;
        if let Some(path) = &self.output {
            files::check_writable(path)?;
        }
        let outputs = [&self.output, &self.matrix].into_iter().flatten().map(PathBuf::as_path);
        files::check_places(outputs, &inputs)
    }

    fn run(&self, request: &mut AlignRequest, session: &mut Session<'_>) -> anyhow::Result<AlignReport> {
        let paths = [self.moving.as_path(), self.fixed.as_path()];
        let [moving, fixed] = session.read_pair(paths)?;
        let precision = self.output.as_deref().and_then(OutputFormat::from_path).map(OutputFormat::precision);
        let coordinates = Coordinates { precision: precision.unwrap_or_default(), center: false };
        let found = request.run(&moving, &fixed, coordinates, &session.context());
        let found = found.map_err(|error| pair::in_files(paths, error))?;
        session.stop_waiting();
        if let Some(path) = &self.output {
            tell(path, &found.rounding, session.printer);
            let mut looks = appearance::read(&self.moving, &moving, path, session.printer)?;
            if let Some(normals) = &mut looks.normals {
                turn(&mut normals.values, &found.report.registration);
            }
            let attributes = appearance::of_same_faces(looks, &found.mesh)?;
            files::write_with(path, &found.mesh, &attributes, session.printer)?;
        }
        if let Some(path) = &self.matrix {
            files::write_whole(path, rows(&found.report.registration).as_bytes(), session.printer)?;
        }
        Ok(found.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(answer)
    }
}

/// Turns normals with the mesh; a factor of the motion is without effect on their directions.
fn turn(normals: &mut [[f64; 3]], found: &Registration) {
    for normal in normals {
        let turned = [0, 1, 2].map(|row| (0..3).map(|i| found.matrix[row][i] * normal[i]).sum::<f64>());
        let length = turned.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.0 {
            *normal = turned.map(|x| x / length);
        }
    }
}

/// The matrix as text.
fn rows(found: &Registration) -> String {
    let mut text = String::new();
    for row in found.matrix {
        let _ = writeln!(text, "{}", row.map(shortest).join(" "));
    }
    text
}
