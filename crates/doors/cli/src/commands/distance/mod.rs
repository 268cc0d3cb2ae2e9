//! `pompeiu distance`.

mod text;

use crate::aligned;
use crate::args::{Meshes, suffix};
pub(crate) use crate::door::run;
use crate::door::{AnswerOf, Invocation, Session, System};
use crate::numbers::shortest;
use crate::pair;
use crate::{certificate, files};
use anyhow::bail;
use clap::Args;
use pompeiu::core::run::StopReason;
use pompeiu::hausdorff::Directions;
use pompeiu::matching::request::{AlignedDistanceReport, AlignedDistanceRequest};
use std::path::{Path, PathBuf};

pub(crate) type Distance = Invocation<Files>;

#[derive(Args)]
#[command(after_help = "\
The directed distance h(A, B) is the largest distance of a point of A from B; H(A, B) is the larger of
h(A, B) and h(B, A). All points of all faces count, not only vertices. Faces are counted from 0.
A file with points and no faces (PLY, XYZ) is a cloud: how far its points are from the mesh is measured, not the way back.
In JSON, witness.a lies on A and witness.b on B in both directions.

Exit codes:
  0  done; with --within: proven to be at most that
  1  with --within: proven to exceed it
  2  a file or an argument cannot be used
  3  undecided within the time or memory limit, or within double precision; or the certificate could not be written

Examples:
  pompeiu distance model.obj scan.ply
  pompeiu distance model.obj scan.ply --direction a-to-b --json
  pompeiu distance model.obj scan.ply --tolerance 1e-3 --tolerance-kind relative
  pompeiu distance model.obj scan.ply --within 0.05 --time-limit 10s
  pompeiu distance model.obj scan.ply --certificate proof.phc")]
pub(crate) struct Files {
    #[command(flatten)]
    meshes: Meshes,
    /// Write a file from which anybody can prove the answer anew, see `pompeiu verify`. A time limit holds for the search, and again
    /// for writing
    #[arg(long, value_parser = suffix::certificate, value_name = "FILE")]
    certificate: Option<PathBuf>,
}

impl Files {
    /// Between its points a cloud says nothing of the surface: beside a mesh, only the way from its points is measured.
    fn choose_direction(
        &self,
        request: &mut AlignedDistanceRequest,
        is_cloud: [bool; 2],
        session: &Session<'_>,
    ) -> anyhow::Result<()> {
        let from_points = match is_cloud {
            [true, false] => Directions::AToB,
            [false, true] => Directions::BToA,
            _ if is_cloud == [false; 2] => return Ok(()),
            _ => request.distance.direction,
        };
        let [a, b] = self.meshes.paths().map(Path::display);
        if request.align.is_some() {
            bail!(
                "--align needs two surfaces, but a cloud of points has none; align the cloud where it was measured"
            );
        }
        if self.certificate.is_some() {
            bail!(
                "a certificate is about triangles in two files, but a cloud of points has none; leave out --certificate"
            );
        }
        if request.distance.direction == from_points {
            return Ok(());
        }
        let (cloud, mesh) = if is_cloud[0] { (a, b) } else { (b, a) };
        if request.distance.direction != Directions::Both {
            bail!(
                "{cloud} is a cloud of points, which says nothing of the surface between them: how far {mesh} is from \
                 it cannot be measured; ask for the other direction"
            );
        }
        request.distance.direction = from_points;
        session.printer.warning(format_args!(
            "{cloud} is a cloud of points: measured is how far they are from {mesh}. The way back is left out, because \
             between its points a cloud says nothing of the surface"
        ));
        Ok(())
    }
}

impl System for Files {
    type Request = AlignedDistanceRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        pair::check(self.meshes.paths())?;
        self.certificate.as_ref().map_or(Ok(()), |path| files::check_place(path, &self.meshes.paths()))
    }

    fn run(
        &self,
        request: &mut AlignedDistanceRequest,
        session: &mut Session<'_>,
    ) -> anyhow::Result<AlignedDistanceReport> {
        let paths = self.meshes.paths();
        if self.certificate.is_some() && request.align.is_some() {
            bail!(
                "a certificate is about the triangles in the files, but --align moves B; \
                 write the moved mesh with `pompeiu align` and compare that"
            );
        }
        let [a, b] = session.read_pair_or_points(paths)?;
        self.choose_direction(request, [a.is_cloud, b.is_cloud], session)?;
        let [a, b] = [a.mesh, b.mesh];
        session.wait.show("building trees".to_owned());
        let context = session.context();
        let mut report = request.run(&a, &b, &context, None).map_err(|error| pair::in_files(paths, error))?;
        if let Some(path) = &self.certificate {
            let (found, slack) = (&report.distance, request.distance.certificate_slack);
            let answer = certificate::write(path, session, |options, into| {
                found.certify([&a, &b], slack, options, into)
            })?;
            report.distance.certificate = Some(answer);
        }
        session.stop_waiting();
        if let Some(found) = &report.alignment {
            aligned::warn(paths, found, session.printer);
        }
        let distance = &report.distance;
        if distance.directions().any(|one| one.stop == StopReason::Rounding) {
            session.printer.warning(format_args!(
                "the interval is wider than the tolerance {}: that is what double precision tells apart here",
                shortest(distance.tolerance.absolute)
            ));
        }
        Ok(report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(self.meshes.names(), self.certificate.as_deref(), answer)
    }
}
