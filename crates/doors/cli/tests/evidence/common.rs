//! A folder of small meshes, and the command run in it.

use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A folder of its own for a test.
pub(crate) struct Folder(TempDir);

impl Folder {
    /// The names of the commands, as the help lists them.
    pub(crate) fn commands(&self) -> Vec<String> {
        let help = self.ok("--help");
        let listed = help
            .lines()
            .skip_while(|line| !line.starts_with("Usage:"))
            .take_while(|line| *line != "Options:");
        // A summary that is wider than the help goes on in the next line.
        let names = listed.filter(|line| line.starts_with("  ") && !line.starts_with("   "));
        names.filter_map(|line| line.split_whitespace().next().map(str::to_owned)).collect()
    }

    pub(crate) fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    /// A folder with `tent.obj`, of height 0.75 over the square `[-1, 1]²`, and that square as `square.obj`.
    pub(crate) fn with_tent() -> Self {
        let folder = Self::new();
        folder.ok("generate tent --height 0.75 -o tent.obj");
        folder.ok("generate grid --size 2,2 -o square.obj");
        folder
    }

    pub(crate) fn path(&self) -> &Path {
        self.0.path()
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        std::fs::write(self.path().join(name), content).unwrap();
    }

    /// The command with these arguments, to be run in the folder.
    pub(crate) fn pompeiu(&self, args: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pompeiu"));
        command.args(args.split_whitespace()).current_dir(self.path());
        for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE", "FORCE_COLOR", "RUST_BACKTRACE", "COLUMNS"] {
            command.env_remove(name);
        }
        command.stdin(Stdio::null());
        command
    }

    pub(crate) fn run(&self, args: &str) -> Output {
        self.pompeiu(args).output().unwrap()
    }

    /// Runs and expects exit code 0; gives stdout.
    #[track_caller]
    pub(crate) fn ok(&self, args: &str) -> String {
        let output = self.run(args);
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{args}: {stderr}");
        String::from_utf8(output.stdout).unwrap()
    }

    /// Runs and gives exit code, stdout and stderr.
    pub(crate) fn transcript(&self, args: &str) -> (Option<i32>, String, String) {
        let output = self.run(args);
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    }
}

/// What a command found: the report of its answer.
pub(crate) fn report_of(mut answer: Value) -> Value {
    answer["report"].take()
}

/// An answer without its times, at any depth.
pub(crate) fn without_times(mut answer: Value) -> Value {
    fn remove(value: &mut Value) {
        match value {
            Value::Object(entries) => {
                entries.retain(|key, _| !key.ends_with("_ms"));
                entries.values_mut().for_each(remove);
            }
            Value::Array(values) => values.iter_mut().for_each(remove),
            _ => {}
        }
    }
    remove(&mut answer);
    answer
}

/// The root of the repository.
pub(crate) fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..")
}
