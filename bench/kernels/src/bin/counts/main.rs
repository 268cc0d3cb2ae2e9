//! Instructions that the kernels take, recorded and compared; see README.md.

mod cases;
mod emulator;
mod record;

use emulator::Emulator;
use record::{Record, Tools};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Growth of a count, as a fraction, that a comparison lets pass: what a change of inlining elsewhere may bring.
const MARGIN: f64 = 0.01;

/// Exit codes beside success.
const GREW: u8 = 1;
const NOT_COMPARED: u8 = 2;

const USAGE: &str = "usage: counts record [FILE] | compare [--margin FRACTION] [FILE] | list | run CASE
FILE is bench/record/instructions.csv unless given.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match arguments.as_slice() {
        ["run", name] => run(name),
        ["list"] => {
            for name in cases::names() {
                println!("{name}");
            }
            Ok(ExitCode::SUCCESS)
        }
        ["record"] => write(&committed()),
        ["record", file] => write(Path::new(file)),
        ["compare"] => compare(&committed(), MARGIN),
        ["compare", "--margin", margin] => with_margin(margin, &committed()),
        ["compare", "--margin", margin, file] => with_margin(margin, Path::new(file)),
        ["compare", file] => compare(Path::new(file), MARGIN),
        _ => Err(USAGE.to_owned()),
    };
    done.unwrap_or_else(|message| {
        eprintln!("{message}");
        ExitCode::from(NOT_COMPARED)
    })
}

fn committed() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../record/instructions.csv")
}

/// Prepares one case and does it, under the emulator or not.
fn run(name: &str) -> Result<ExitCode, String> {
    bench_kernels::stay_on_this_thread();
    let mut work = cases::prepare(name).ok_or_else(|| format!("there is no case {name}"))?;
    cases::counted_region(work.as_mut());
    Ok(ExitCode::SUCCESS)
}

fn count_all(tools: Tools) -> Result<Record, String> {
    let emulator = Emulator::new()?;
    let mut counts = Vec::new();
    for name in cases::names() {
        let count = emulator.count(name)?;
        eprintln!("{name:<24}{count:>16}");
        counts.push((name.to_owned(), count));
    }
    Ok(Record { tools, counts })
}

fn write(path: &Path) -> Result<ExitCode, String> {
    count_all(Tools::present()?)?.write(path)?;
    Ok(ExitCode::SUCCESS)
}

fn with_margin(margin: &str, path: &Path) -> Result<ExitCode, String> {
    let fraction = margin.parse().ok().filter(|m: &f64| *m >= 0.0 && m.is_finite());
    compare(
        path,
        fraction.ok_or_else(|| format!("found margin \"{margin}\", expected a fraction such as 0.01"))?,
    )
}

/// Counts anew and says what grew. Counts of other tools are shown, but prove nothing.
fn compare(path: &Path, margin: f64) -> Result<ExitCode, String> {
    let before = Record::read(path)?;
    let now = count_all(Tools::present()?)?;
    println!("{:<24}{:>16}{:>16}{:>10}", "case", "recorded", "now", "change");
    let mut grew = 0;
    for (name, count) in &now.counts {
        let Some(recorded) = before.count(name) else {
            println!("{name:<24}{:>16}{count:>16}{:>10}", "-", "new");
            continue;
        };
        let change = *count as f64 / recorded as f64 - 1.0;
        let verdict = if change > margin { "  grew" } else { "" };
        grew += usize::from(change > margin);
        println!("{name:<24}{recorded:>16}{count:>16}{:>+9.2}%{verdict}", 100.0 * change);
    }
    for (name, _) in before.counts.iter().filter(|(name, _)| now.count(name).is_none()) {
        println!("{name:<24} is in the record but no longer counted");
    }
    let differences = before.tools.differences(&now.tools);
    if !differences.is_empty() {
        return Err(format!(
            "nothing is proven, for the record was made with other tools: {}; record the older state with these tools and \
             compare with that",
            differences.join(", ")
        ));
    }
    if grew > 0 {
        println!("{grew} of {} counts grew by more than {} %", now.counts.len(), 100.0 * margin);
        return Ok(ExitCode::from(GREW));
    }
    Ok(ExitCode::SUCCESS)
}
