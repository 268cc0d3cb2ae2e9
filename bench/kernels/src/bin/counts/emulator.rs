//! Counting under callgrind.

use std::env;
use std::path::PathBuf;
use std::process::Command;

/// Runs cases of this very program under valgrind, one process for each.
pub struct Emulator {
    program: PathBuf,
    output: PathBuf,
}

impl Emulator {
    pub fn new() -> Result<Self, String> {
        let program = env::current_exe().map_err(|error| format!("cannot find this program: {error}"))?;
        let output = env::temp_dir().join(format!("bench-kernels-{}.callgrind", std::process::id()));
        Ok(Self { program, output })
    }

    /// Instructions executed inside `counted_region`.
    pub fn count(&self, case: &str) -> Result<u64, String> {
        let run = Command::new("valgrind")
            .args(["--tool=callgrind", "--collect-atstart=no", "--toggle-collect=*counted_region*"])
            .arg(format!("--callgrind-out-file={}", self.output.display()))
            .arg(&self.program)
            .args(["run", case])
            .output()
            .map_err(|error| format!("cannot start valgrind: {error}"))?;
        if !run.status.success() {
            return Err(format!("{case} failed: {}", String::from_utf8_lossy(&run.stderr)));
        }
        let text = std::fs::read_to_string(&self.output)
            .map_err(|error| format!("cannot read {}: {error}", self.output.display()))?;
        total(&text).ok_or_else(|| format!("callgrind counted nothing in {case}"))
    }
}

impl Drop for Emulator {
    fn drop(&mut self) {
        // Nothing was written when valgrind did not start.
        let _ = std::fs::remove_file(&self.output);
    }
}

/// The sum that callgrind writes at the end of its output, if anything was counted.
fn total(output: &str) -> Option<u64> {
    let line = output.lines().rev().find_map(|line| line.strip_prefix("totals:"))?;
    line.trim().parse().ok().filter(|count| *count > 0)
}
