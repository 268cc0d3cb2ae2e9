//! Counts with what they were made with, as CSV.

use std::fmt::Write;
use std::path::Path;
use std::process::Command;

const HEADER: &str = "date,rustc,llvm,target,instruction_set,valgrind,libc,case,instructions";

/// What else than the code decides how many instructions there are.
#[derive(Clone, Debug, PartialEq)]
pub struct Tools {
    date: String,
    rustc: String,
    llvm: String,
    target: String,
    /// The widest instruction set that the kernels find when they run under the emulator.
    instruction_set: String,
    valgrind: String,
    /// Copying and comparing memory is counted too.
    libc: String,
}

impl Tools {
    pub fn present() -> Result<Self, String> {
        let rustc = output("rustc", &["-vV"])?;
        let field = |name: &str| {
            let line = rustc.lines().find_map(|line| line.strip_prefix(name));
            line.map_or_else(|| "unknown".to_owned(), |value| value.trim().to_owned())
        };
        Ok(Self {
            date: output("date", &["-u", "+%Y-%m-%d"])?,
            rustc: field("release:"),
            llvm: field("LLVM version:"),
            target: field("host:"),
            instruction_set: instruction_set().to_owned(),
            valgrind: output("valgrind", &["--version"])?.replace("valgrind-", ""),
            libc: output("getconf", &["GNU_LIBC_VERSION"]).unwrap_or_else(|_| "unknown".to_owned()),
        })
    }

    /// What differs, other than the date.
    pub fn differences(&self, now: &Self) -> Vec<String> {
        let pairs = [
            ("rustc", &self.rustc, &now.rustc),
            ("LLVM", &self.llvm, &now.llvm),
            ("target", &self.target, &now.target),
            ("instruction set", &self.instruction_set, &now.instruction_set),
            ("valgrind", &self.valgrind, &now.valgrind),
            ("C library", &self.libc, &now.libc),
        ];
        let different = pairs.into_iter().filter(|(_, before, now)| before != now);
        different.map(|(what, before, now)| format!("{what} {before}, now {now}")).collect()
    }
}

fn output(program: &str, arguments: &[&str]) -> Result<String, String> {
    let run = Command::new(program).args(arguments).output();
    let run = run.map_err(|error| format!("cannot start {program}: {error}"))?;
    Ok(String::from_utf8_lossy(&run.stdout).trim().to_owned())
}

/// The emulator has no AVX-512; the kernels choose as they do here, from what the processor reports, AVX-512 left out.
#[cfg(target_arch = "x86_64")]
fn instruction_set() -> &'static str {
    if std::arch::is_x86_feature_detected!("avx2") { "avx2" } else { "sse2" }
}

#[cfg(not(target_arch = "x86_64"))]
fn instruction_set() -> &'static str {
    "baseline"
}

/// All counts of one build.
pub struct Record {
    pub tools: Tools,
    pub counts: Vec<(String, u64)>,
}

impl Record {
    pub fn count(&self, name: &str) -> Option<u64> {
        self.counts.iter().find(|(case, _)| case == name).map(|(_, count)| *count)
    }

    pub fn write(&self, path: &Path) -> Result<(), String> {
        let Tools { date, rustc, llvm, target, instruction_set, valgrind, libc } = &self.tools;
        let mut text = format!("{HEADER}\n");
        for (case, count) in &self.counts {
            let _ = writeln!(
                text,
                "{date},{rustc},{llvm},{target},{instruction_set},{valgrind},{libc},{case},{count}"
            );
        }
        std::fs::write(path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))
    }

    pub fn read(path: &Path) -> Result<Self, String> {
        let text = std::fs::read_to_string(path)
            .map_err(|error| format!("cannot read {}: {error}", path.display()))?;
        let mut lines = text.lines();
        let wrong = |what: &str| format!("{} is no record of counts: {what}", path.display());
        if lines.next() != Some(HEADER) {
            return Err(wrong("its first line is another"));
        }
        let mut tools = None;
        let mut counts = Vec::new();
        for (number, line) in lines.enumerate() {
            let fields: Vec<&str> = line.split(',').collect();
            let [date, rustc, llvm, target, instruction_set, valgrind, libc, case, count] = fields.as_slice()
            else {
                return Err(wrong(&format!("line {} has {} fields, expected 9", number + 2, fields.len())));
            };
            let count = count
                .parse()
                .map_err(|_| wrong(&format!("line {} ends in \"{count}\", expected a count", number + 2)))?;
            counts.push(((*case).to_owned(), count));
            let [date, rustc, llvm, target, instruction_set, valgrind, libc] =
                [date, rustc, llvm, target, instruction_set, valgrind, libc].map(|field| (*field).to_owned());
            tools = Some(Tools { date, rustc, llvm, target, instruction_set, valgrind, libc });
        }
        Ok(Self { tools: tools.ok_or_else(|| wrong("it holds no counts"))?, counts })
    }
}
