//! What a command does while it runs: it reads within the limits, shows progress, and remembers what it read and how long that took.

use crate::args::Limits;
use crate::printer::Printer;
use crate::wait::Wait;
use crate::{files, interrupt, pair, surface};
use pompeiu::core::TriMesh;
use pompeiu::core::request::Input;
use pompeiu::core::run::RunContext;
use pompeiu::io::ReadMesh;
use pompeiu::surface::EmbeddedSurface;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

pub(crate) struct Session<'s> {
    pub(crate) printer: &'s Printer,
    pub(crate) wait: Wait,
    limits: &'s Limits,
    json: bool,
    started: Instant,
    read: Duration,
    inputs: Vec<(PathBuf, Input)>,
}

impl<'s> Session<'s> {
    /// The clock starts, and Ctrl-C ends what computes from here on.
    pub(super) fn start(limits: &'s Limits, json: bool, printer: &'s Printer) -> Self {
        Self {
            printer,
            wait: Wait::new(printer),
            limits,
            json,
            started: Instant::now(),
            read: Duration::ZERO,
            inputs: Vec::new(),
        }
    }

    /// Reads a mesh, and warns of what its file has that a mesh has not.
    pub(crate) fn read_mesh(&mut self, path: &Path) -> anyhow::Result<TriMesh> {
        let mesh = files::read_shown(path, &self.wait, self.printer)?;
        self.note(path, &mesh);
        Ok(mesh)
    }

    /// Reads a mesh as an oriented surface, see [`surface::read`].
    pub(crate) fn read_surface(&mut self, path: &Path) -> anyhow::Result<(TriMesh, EmbeddedSurface)> {
        let (mesh, surface) = surface::read(path, &self.wait, self.printer)?;
        self.note(path, &mesh);
        Ok((mesh, surface))
    }

    /// Reads two meshes within the time limit, and warns of what deserves it.
    pub(crate) fn read_pair(&mut self, paths: [&Path; 2]) -> anyhow::Result<[TriMesh; 2]> {
        Ok(self.read_pair_with_groups(paths)?.map(|read| read.mesh))
    }

    /// The same with the groups of faces that the files name.
    pub(crate) fn read_pair_with_groups(&mut self, paths: [&Path; 2]) -> anyhow::Result<[ReadMesh; 2]> {
        self.read_pair_by(paths, files::read)
    }

    /// The same of files with points and no faces, too.
    pub(crate) fn read_pair_or_points(&mut self, paths: [&Path; 2]) -> anyhow::Result<[ReadMesh; 2]> {
        self.read_pair_by(paths, files::read_or_points)
    }

    fn read_pair_by(
        &mut self,
        paths: [&Path; 2],
        read: fn(&Path) -> anyhow::Result<ReadMesh>,
    ) -> anyhow::Result<[ReadMesh; 2]> {
        let files = pair::read_files(paths, read, (self.limits, self.started), &self.wait, self.printer)?;
        for (path, file) in paths.into_iter().zip(&files) {
            if file.is_cloud {
                self.note_points(path, file.mesh.positions().len());
                self.read = self.started.elapsed();
            } else {
                self.note(path, &file.mesh);
            }
        }
        Ok(files)
    }

    /// Remembers what was read until now.
    pub(crate) fn note(&mut self, path: &Path, mesh: &TriMesh) {
        let input = Input { path: Some(path.display().to_string()), ..Input::of_mesh(mesh) };
        self.inputs.push((path.to_owned(), input));
        self.read = self.started.elapsed();
    }

    /// Remembers an input of so many points that is no mesh: an outline or a skeleton.
    pub(crate) fn note_points(&mut self, path: &Path, points: usize) {
        let input = Input { path: Some(path.display().to_string()), vertices: points, ..Input::default() };
        self.inputs.push((path.to_owned(), input));
    }

    /// Remembers a mesh that was read without the session.
    pub(crate) fn note_counts(&mut self, path: &Path, [vertices, faces]: [usize; 2]) {
        let input = Input { path: Some(path.display().to_string()), vertices, faces, ..Input::default() };
        self.inputs.push((path.to_owned(), input));
    }

    /// The memory that everything may take.
    pub(crate) fn memory_limit(&self) -> Option<usize> {
        self.limits.memory_limit
    }

    /// What a computation runs with: what is left of the limits, Ctrl-C and the progress bar.
    pub(crate) fn context(&self) -> RunContext<'_> {
        interrupt::listen();
        RunContext::start(self.limits.after(self.started.elapsed())).watched_by(&self.wait)
    }

    /// The limits for something beside the computation, whose time starts now.
    pub(crate) fn limits_anew(&self) -> pompeiu::core::run::Limits {
        interrupt::listen();
        self.limits.after(Duration::ZERO)
    }

    /// Whether the answer is JSON.
    pub(crate) fn is_json(&self) -> bool {
        self.json
    }

    /// Shows what is done next, after the bar was taken away.
    pub(crate) fn wait_for(&mut self, message: &str) {
        self.wait = Wait::new(self.printer);
        self.wait.show(message.to_owned());
    }

    /// Takes the progress bar away.
    pub(crate) fn stop_waiting(&mut self) {
        self.wait = Wait::hidden();
    }

    pub(crate) fn elapsed(&self) -> Duration {
        self.started.elapsed()
    }

    pub(super) fn read_time(&self) -> Duration {
        self.read
    }

    /// What was read, with the sums of the files where they are asked for.
    pub(super) fn inputs(&self, with_sums: bool) -> Vec<Input> {
        let with_sum = |(path, input): &(PathBuf, Input)| Input {
            sha256: if with_sums { files::sha256(path).ok() } else { None },
            ..input.clone()
        };
        self.inputs.iter().map(with_sum).collect()
    }
}
