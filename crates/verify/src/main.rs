//! The command `pompeiu-verify`.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "a command prints")]

use pompeiu_verify::{Soup, Verified, mesh, verify};
use std::fs;
use std::process::ExitCode;

const USAGE: &str = "usage: pompeiu-verify FILE A B [--threads N] [--json]
Proves lower <= h(A, B) <= upper from the certificate FILE and two meshes (OBJ, STL or PLY, triangles only).
Exit code: 0 the certificate is valid, 1 it is not (the first statement that fails is named), 2 it cannot be read.";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let is_json = arguments.iter().any(|argument| argument == "--json");
    match run(&arguments) {
        Ok(Ok(verified)) => {
            println!("{}", text(&verified, is_json));
            ExitCode::SUCCESS
        }
        Ok(Err(reason)) => {
            println!("{}", if is_json { json_of("invalid", &reason) } else { format!("invalid: {reason}") });
            ExitCode::from(1)
        }
        Err(reason) => {
            if is_json {
                println!("{}", json_of("unreadable", &reason));
            }
            eprintln!("error: {reason}");
            ExitCode::from(2)
        }
    }
}

/// What was proven, or the first statement that fails; outside of it what cannot be read.
fn run(arguments: &[String]) -> Result<Result<Verified, String>, String> {
    let (mut paths, mut threads) = (Vec::new(), thread_count());
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.as_str() {
            "--json" => {}
            "--threads" => {
                let count = rest.next().and_then(|n| n.parse().ok()).filter(|n| (1..=1024).contains(n));
                threads = count.ok_or("--threads needs a number from 1 to 1024")?;
            }
            option if option.starts_with("--") => return Err(USAGE.to_owned()),
            path => paths.push(path),
        }
    }
    let [certificate, a, b] = paths[..] else { return Err(USAGE.to_owned()) };
    let read = |path: &str| {
        let bytes = fs::read(path).map_err(|error| format!("{path}: {error}"))?;
        mesh::read(&bytes).map_err(|error| format!("{path}: {error}"))
    };
    let (mesh_a, mesh_b) = (read(a)?, read(b)?);
    let unusable = |path: &str| {
        format!("{path}: a coordinate is not finite, or a face names a vertex that is not there")
    };
    let a = Soup::new(&mesh_a.positions, &mesh_a.faces).ok_or_else(|| unusable(a))?;
    let b = Soup::new(&mesh_b.positions, &mesh_b.faces).ok_or_else(|| unusable(b))?;
    let file = fs::File::open(certificate).map_err(|error| format!("{certificate}: {error}"))?;
    match verify(&a, &b, file, threads) {
        Ok(verified) => Ok(Ok(verified)),
        Err(error) if error.is_unreadable() => Err(format!("{certificate}: {error}")),
        Err(error) => Ok(Err(error.to_string())),
    }
}

fn thread_count() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

fn json_of(status: &str, reason: &str) -> String {
    let escaped: String = reason.chars().flat_map(char::escape_default).collect();
    format!("{{\"status\":\"{status}\",\"reason\":\"{}\"}}", escaped.replace("\\'", "'"))
}

fn text(verified: &Verified, is_json: bool) -> String {
    let hex = |hash: [u8; 32]| hash.map(|byte| format!("{byte:02x}")).concat();
    let [a, b] = verified.hashes.map(hex);
    let names = [("h(A, B)", "a_to_b"), ("h(B, A)", "b_to_a")];
    let claims = names.iter().zip(verified.claims).filter_map(|(name, claim)| Some((name, claim?)));
    if is_json {
        let claims: Vec<String> = claims
            .map(|((_, key), c)| {
                format!(
                    ",\"{key}\":{{\"lower\":{:e},\"upper\":{:e},\"cells\":{}}}",
                    c.lower, c.upper, c.cells
                )
            })
            .collect();
        return format!(
            "{{\"status\":\"valid\"{},\"sha256_a\":\"{a}\",\"sha256_b\":\"{b}\"}}",
            claims.concat()
        );
    }
    let lines: Vec<String> = claims
        .map(|((name, _), c)| format!("{} <= {name} <= {}   ({} cells)\n", c.lower, c.upper, c.cells))
        .collect();
    format!(
        "valid: proven of the triangles in these files\n{}sha256 of A {a}\nsha256 of B {b}",
        lines.concat()
    )
}
