//! The user guide says what the program does: each `sh` block of its pages is run, and a `text` block after one holds what
//! the last command of it printed, times aside; what blocks write into `pictures` are the pictures of the guide, bit for bit.
//! `GUIDE_UPDATE=1` writes those blocks and pictures anew.

use crate::common::{Folder, repository};
use std::fmt::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

fn pages() -> Vec<PathBuf> {
    let folder = repository().join("docs/guide/pages");
    let mut pages: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    pages.retain(|path| path.extension().is_some_and(|suffix| suffix == "md"));
    pages.sort();
    pages
}

/// A folder with the example meshes, and one for pictures.
fn folder_with_examples() -> Folder {
    let folder = Folder::new();
    std::fs::create_dir(folder.path().join("pictures")).unwrap();
    for entry in std::fs::read_dir(repository().join("examples/meshes")).unwrap() {
        let path = entry.unwrap().path();
        std::fs::copy(&path, folder.path().join(path.file_name().unwrap())).unwrap();
    }
    folder
}

/// Runs a line in a shell that knows the program; gives what it printed.
#[track_caller]
fn run(folder: &Folder, page: &str, line: &str) -> String {
    let expected = line.split_once("# exit code ").map_or(0, |(_, code)| code.trim().parse().unwrap());
    let program = Path::new(env!("CARGO_BIN_EXE_pompeiu")).parent().unwrap();
    let path = std::env::join_paths(
        std::iter::once(program.to_owned()).chain(std::env::split_paths(&std::env::var_os("PATH").unwrap())),
    );
    let output = std::process::Command::new("bash")
        .args(["-c", line])
        .current_dir(folder.path())
        .env("PATH", path.unwrap())
        .env_remove("CLICOLOR_FORCE")
        .stdin(std::process::Stdio::null())
        .output()
        .unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(expected), "{page}: {line}\n{stderr}");
    String::from_utf8(output.stdout).unwrap()
}

/// The same with `…` for every time, which differs from run to run.
fn without_times(text: &str) -> String {
    let units = ["µs", "ms", "s"];
    let words = |line: &str| -> String {
        let mut words: Vec<_> = line.split_whitespace().collect();
        for i in 1..words.len() {
            if units.contains(&words[i].trim_end_matches(',')) {
                words[i - 1] = "…";
                words[i] = "…";
            }
        }
        words.join(" ")
    };
    text.trim_end().lines().map(words).collect::<Vec<_>>().join("\n")
}

#[test]
fn what_the_guide_shows_is_what_the_program_says() {
    let update = std::env::var_os("GUIDE_UPDATE").is_some();
    let pages = pages();
    assert!(pages.len() >= 6, "pages are missing");
    // Each page has a folder of its own, so pages need not wait for each other.
    let next = AtomicUsize::new(0);
    let threads = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(path) = pages.get(next.fetch_add(1, Ordering::Relaxed)) {
                    check_page(path, update);
                }
            });
        }
    });
}

fn check_page(path: &Path, update: bool) {
    let page = path.file_name().unwrap().to_string_lossy().into_owned();
    let text = std::fs::read_to_string(path).unwrap();
    let folder = folder_with_examples();
    let (mut updated, mut printed) = (String::new(), None);
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        let _ = writeln!(updated, "{line}");
        let Some(tag) = line.strip_prefix("```") else {
            if !line.trim().is_empty() {
                printed = None;
            }
            continue;
        };
        let block: Vec<_> = lines.by_ref().take_while(|line| *line != "```").collect();
        let mut shown = block.join("\n");
        match (tag, printed.take()) {
            ("sh", _) => {
                for line in block.iter().filter(|line| !line.is_empty() && !line.starts_with('#')) {
                    printed = Some(run(&folder, &page, line));
                }
            }
            ("text", Some(found)) => {
                if update {
                    found.trim_end().clone_into(&mut shown);
                } else {
                    assert_eq!(without_times(&shown), without_times(&found), "{page}");
                }
            }
            _ => {}
        }
        let _ = writeln!(updated, "{shown}\n```");
    }
    if update {
        std::fs::write(path, updated).unwrap();
    }
    for entry in std::fs::read_dir(folder.path().join("pictures")).unwrap() {
        let made = entry.unwrap().path();
        let shown = path.with_file_name("pictures").join(made.file_name().unwrap());
        if update {
            std::fs::copy(&made, &shown).unwrap();
        }
        let same = std::fs::read(&made).unwrap() == std::fs::read(&shown).unwrap_or_default();
        assert!(same, "{page}: {} is out of date", shown.display());
    }
}
