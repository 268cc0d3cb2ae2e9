//! `pompeiu puzzle`.

mod args;
mod output;
mod text;

use crate::door::{AnswerOf, Invocation, Session, System};
pub(crate) use args::Files;
use output::Outputs;
use pompeiu::puzzle::{PuzzleReport, PuzzleRequest};

pub(crate) use crate::door::run;

pub(crate) type Puzzle = Invocation<Files>;

impl System for Files {
    type Request = PuzzleRequest;

    fn check(&self, _: bool) -> anyhow::Result<()> {
        Outputs::of(self, &PuzzleRequest::default()).map(|_| ())
    }

    fn run(&self, request: &mut PuzzleRequest, session: &mut Session<'_>) -> anyhow::Result<PuzzleReport> {
        let outputs = Outputs::of(self, request)?;
        let print = outputs.print()?;
        let wants_motion = self.motion.is_some() || self.report.is_some();
        let found = request.run(wants_motion, &session.context())?;
        session.stop_waiting();
        for (path, corners) in &found.read {
            session.note_points(path, *corners);
        }
        for left_out in &found.report.left_out {
            session.printer.warning(left_out);
        }
        outputs.write(&found, request.kerf_width()?, print.as_ref(), session.printer)?;
        Ok(found.report)
    }

    fn text(&self, answer: &AnswerOf<Self>) -> String {
        text::text(answer)
    }
}
