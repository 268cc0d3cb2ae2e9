//! What ARCHITECTURE.md and REFERENCES.bib say, held against the repository.

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Names of crates, by the crate that depends on them.
type Arrows = BTreeMap<String, BTreeSet<String>>;

pub(crate) fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../..")
}

fn text(name: &str) -> String {
    fs::read_to_string(root().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// What cargo knows of the crates of the workspace.
fn metadata() -> Value {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--no-deps", "--offline"])
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Dependencies among the crates of the workspace, of one kind.
fn arrows(kind: &Value) -> Arrows {
    let metadata = metadata();
    let packages = metadata["packages"].as_array().unwrap();
    let name = |value: &Value| value["name"].as_str().unwrap().to_owned();
    let ours: BTreeSet<String> = packages.iter().map(name).collect();
    let to = |package: &Value| {
        let dependencies = package["dependencies"].as_array().unwrap().iter();
        dependencies.filter(|d| d["kind"] == *kind).map(name).filter(|d| ours.contains(d)).collect()
    };
    packages.iter().map(|package| (name(package), to(package))).collect()
}

#[test]
fn crates_depend_on_each_other_as_drawn() {
    let document = text("ARCHITECTURE.md");
    let section = document.split("### Dependencies").nth(1).expect("a section on dependencies");
    let drawing = section.split("```").nth(1).expect("a drawing").trim_start_matches("text");
    let drawn: Arrows = drawing
        .lines()
        .filter(|line| !line.trim().is_empty())
        .map(|line| {
            let (from, to) = line.split_once("─►").unwrap_or((line, ""));
            let to = to.split(',').map(str::trim).filter(|name| !name.is_empty());
            (from.trim().to_owned(), to.map(str::to_owned).collect())
        })
        .collect();
    assert_eq!(arrows(&Value::Null), drawn, "the manifests, and the drawing in ARCHITECTURE.md");

    let command_is_used = arrows(&Value::from("dev")).values().any(|to| to.contains("pompeiu-cli"));
    assert!(!command_is_used, "even in tests no crate depends on the command");
}

/// Tests in a target that is not compiled for tests, and examples in the documentation of a library without such tests, never run.
#[test]
fn no_test_is_where_none_is_run() {
    let metadata = metadata();
    let targets =
        metadata["packages"].as_array().unwrap().iter().flat_map(|p| p["targets"].as_array().unwrap());
    for target in targets {
        let main = Path::new(target["src_path"].as_str().unwrap());
        let is_library = target["kind"].as_array().unwrap().iter().any(|kind| kind == "lib");
        let mut all = Vec::new();
        if is_library {
            source_files(main.parent().unwrap(), &mut all);
        } else {
            all.push(main.to_owned());
        }
        for file in all {
            let text = fs::read_to_string(&file).unwrap();
            let of = |is_run: &str, mark: &str| target[is_run] == false && text.contains(mark);
            assert!(
                !of("test", "#[cfg(test)]") && !of("test", "#[test]"),
                "{} is not tested",
                file.display()
            );
            let has_example = ["/// ```\n", "//! ```\n"].iter().any(|mark| of("doctest", mark));
            assert!(!is_library || !has_example, "examples in {} are not run", file.display());
        }
    }
}

/// The source files below a folder.
fn source_files(folder: &Path, files: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            source_files(&path, files);
        } else if path.extension().is_some_and(|suffix| suffix == "rs") {
            files.push(path);
        }
    }
}

#[test]
fn the_code_map_is_complete_and_true() {
    let tops = ["bench/", "crates/", "docs/", "examples/", "scripts/"];
    named_places_exist("ARCHITECTURE.md", "", &tops);
    let map = text("ARCHITECTURE.md");
    for of_crate in crate_folders() {
        let document = format!("{of_crate}/README.md");
        assert!(map.contains(&format!("({document})")), "ARCHITECTURE.md lacks {document}");
        named_places_exist(&document, &of_crate, &["src/", "tests/", "web/"]);
        let described = text(&document);
        let mut files = BTreeSet::new();
        sources(&root().join(&of_crate).join("src"), &mut files);
        for file in described.split('`').filter(|word| {
            Path::new(word).extension().is_some_and(|suffix| suffix == "rs") && !word.contains('/')
        }) {
            assert!(files.contains(file), "{document} names {file}, which does not exist");
        }
        for room in fs::read_dir(root().join(&of_crate).join("src")).unwrap().map(Result::unwrap) {
            let place = format!("src/{}", room.file_name().into_string().unwrap());
            let is_room = room.path().join("mod.rs").exists();
            assert!(!is_room || described.contains(&format!("`{place}`")), "{document} lacks {place}");
        }
    }
}

/// Asserts that what a document names between backquotes, below certain folders, exists below a folder.
fn named_places_exist(document: &str, below: &str, tops: &[&str]) {
    let written = text(document);
    let places = written.split('`').filter(|word| tops.iter().any(|top| word.starts_with(top)));
    for place in places {
        assert!(root().join(below).join(place).exists(), "{document} names {place}, which does not exist");
    }
}

/// Names of the source files below a folder.
fn sources(folder: &Path, names: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
        if entry.path().is_dir() {
            sources(&entry.path(), names);
        } else {
            names.insert(entry.file_name().into_string().unwrap());
        }
    }
}

/// The folders of the crates of the workspace, from the root of the repository.
pub(crate) fn crate_folders() -> Vec<String> {
    let groups = ["base", "systems", "show", "doors"].map(|group| format!("crates/{group}"));
    let inside = groups.iter().flat_map(|group| {
        let folders = fs::read_dir(root().join(group)).unwrap().map(Result::unwrap);
        folders.map(move |folder| format!("{group}/{}", folder.file_name().into_string().unwrap()))
    });
    inside.chain(["crates/fuzz", "crates/testkit", VERIFIER].map(str::to_owned)).collect()
}

/// The packages of the crates in a folder of `crates`.
fn packages_in(group: &str) -> BTreeSet<String> {
    let start = format!("crates/{group}/");
    let names =
        crate_folders().into_iter().filter_map(|folder| folder.strip_prefix(&start).map(str::to_owned));
    names.map(|name| if name == "pompeiu" { name } else { format!("pompeiu-{name}") }).collect()
}

/// What checks certificates, and must not depend on anything here.
const VERIFIER: &str = "crates/verify";

/// The system that every other one may ask to prove how far its result is from what it should be.
const JUDGE: &str = "pompeiu-hausdorff";

/// Systems that need another one on their way, which ARCHITECTURE.md argues.
const ARGUED: [(&str, &str); 2] = [("pompeiu-flow", "pompeiu-remesh"), ("pompeiu-flatten", "pompeiu-medial")];

#[test]
fn a_system_depends_on_no_other() {
    let allowed: BTreeSet<String> = [JUDGE, "pompeiu-figures", "pompeiu-verify"].map(str::to_owned).into();
    let allowed: BTreeSet<String> = allowed.union(&packages_in("base")).cloned().collect();
    let all = arrows(&Value::Null);
    for system in packages_in("systems") {
        let argued = |to: &&String| !ARGUED.contains(&(system.as_str(), to.as_str()));
        let beyond: Vec<_> = all[&system].difference(&allowed).filter(argued).collect();
        assert!(beyond.is_empty(), "{system} depends on {beyond:?}");
    }
    assert!(all["pompeiu-verify"].is_empty(), "the verifier depends on {:?}", all["pompeiu-verify"]);
    for base in packages_in("base") {
        let beyond: Vec<_> = all[&base].difference(&packages_in("base")).cloned().collect();
        assert!(beyond.is_empty(), "{base} depends on {beyond:?}");
    }
}

#[test]
fn requests_and_pages_of_systems_are_where_the_document_says() {
    let systems = fs::read_dir(root().join("crates/systems")).unwrap().map(|entry| entry.unwrap().path());
    let mut requests = 0;
    for system in systems {
        for file in ["README.md", "src/lib.rs"] {
            assert!(system.join(file).is_file(), "{}: no {file}", system.display());
        }
        for file in rust_files(&system.join("src")) {
            let place = file.strip_prefix(system.join("src")).unwrap().to_string_lossy().into_owned();
            let text = fs::read_to_string(&file).unwrap();
            let asks = text.lines().any(|line| line.starts_with("impl Request for "));
            let is_request = place == "request.rs" || place.starts_with("request/");
            assert!(!asks || is_request, "{}: a request outside of request.rs", file.display());
            let draws = text.contains("use pompeiu_figures");
            let is_show = ["show", "draw"].iter().any(|room| place.starts_with(room));
            assert!(!draws || is_show, "{}: figures outside of show", file.display());
            requests += usize::from(asks);
        }
    }
    assert!(requests >= 6, "{requests}");
}

/// The Rust files of a folder and its folders.
fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let of = |path: PathBuf| if path.is_dir() { rust_files(&path) } else { vec![path] };
    entries.flat_map(of).filter(|path| path.extension().is_some_and(|suffix| suffix == "rs")).collect()
}

#[test]
fn the_recipe_for_a_system_names_what_there_is() {
    let document = text("CONTRIBUTING.md");
    let section = document.split("## How a system moves in").nth(1).expect("a recipe");
    let rows = section.lines().filter(|line| line.starts_with("| `")).collect::<Vec<_>>();
    assert!(rows.len() > 10, "{rows:?}");
    let mut folder = PathBuf::new();
    for name in rows
        .iter()
        .flat_map(|row| row.split('|').nth(1).expect("a first column").split('`').skip(1).step_by(2))
    {
        let name = name.replace("NAME", "fields").replace("COMMAND", "decompose");
        // A bare name lies beside the one before it.
        let place = if name.contains('/') || root().join(&name).exists() {
            PathBuf::from(&name)
        } else {
            folder.join(&name)
        };
        assert!(root().join(&place).exists(), "CONTRIBUTING.md names {name}, which does not exist");
        folder = place.parent().map(Path::to_owned).unwrap_or_default();
        let own = place.to_string_lossy();
        if place.is_file()
            && !own.ends_with("errors.rs")
            && !own.contains("fields")
            && !own.contains("decompose")
        {
            let content = text(&own);
            assert!(
                content.contains("fields") || content.contains("decompose"),
                "{own} does not know the example"
            );
        }
    }
}

/// What `cargo tree` lists, one line each.
fn tree(arguments: &[&str]) -> BTreeSet<String> {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--locked", "--prefix", "none"])
        .args(arguments)
        .current_dir(root())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let listed = String::from_utf8(output.stdout).unwrap();
    listed.lines().map(|line| line.trim_end_matches(" (*)").to_owned()).collect()
}

/// The packages of this workspace that are compiled for a package with some features.
fn compiled(package: &str, features: &str) -> BTreeSet<String> {
    let listed = tree(&[
        "--no-default-features",
        "--package",
        package,
        "--features",
        features,
        "--edges",
        "normal,build",
        "--format",
        "{p}",
    ]);
    let names = listed.iter().filter_map(|line| line.split(' ').next());
    names.filter(|name| name.starts_with("pompeiu")).map(str::to_owned).collect()
}

#[test]
fn the_command_and_the_python_package_are_built_from_what_tests_compile() {
    let format = ["--format", "{p} with {f}"];
    let tests = tree(&[&format[..], &["--workspace"]].concat());
    for door in ["pompeiu-cli", "pompeiu-py"] {
        let package = ["--package", door, "--features", "as-tested", "--edges", "normal,build"];
        let package = tree(&[&format[..], &package].concat());
        let own = format!("{door} ");
        let other: Vec<_> = package.difference(&tests).filter(|line| !line.starts_with(&own)).collect();
        assert!(other.is_empty(), "compiled twice; adapt the feature `as-tested` of {door}: {other:#?}");
    }
}

#[test]
fn a_user_of_one_system_compiles_no_other() {
    let systems = packages_in("systems");
    for system in &systems {
        let feature = system.trim_start_matches("pompeiu-");
        let features = if system == JUDGE { String::new() } else { feature.to_owned() };
        for (package, features) in [(system.as_str(), ""), ("pompeiu", features.as_str())] {
            let found = compiled(package, features);
            let argued = |other: &str| ARGUED.contains(&(system.as_str(), other));
            let others = systems.iter().filter(|other| *other != system && *other != JUDGE && !argued(other));
            let extra: Vec<_> = others.filter(|other| found.contains(*other)).collect();
            assert!(found.contains(system) && extra.is_empty(), "{package} with {features:?}: {found:?}");
        }
    }
}

/// All `name_word_year` between backquotes in the sources below a folder.
fn cited(folder: &Path, keys: &mut BTreeSet<String>) {
    for entry in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if entry.is_dir() {
            cited(&entry, keys);
        } else if entry.extension().is_some_and(|suffix| suffix == "rs") {
            let source = fs::read_to_string(&entry).unwrap();
            keys.extend(source.split('`').filter(|word| is_key(word)).map(str::to_owned));
        }
    }
}

fn is_key(word: &str) -> bool {
    let parts: Vec<&str> = word.split('_').collect();
    let is_year = |year: &str| year.len() == 4 && year.bytes().all(|b| b.is_ascii_digit());
    let is_word = |part: &&str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_lowercase());
    parts.len() == 3 && parts[..2].iter().all(is_word) && is_year(parts[2])
}

#[test]
fn citations_and_references_are_the_same() {
    let references = text("REFERENCES.bib");
    let entries = references.lines().filter(|line| line.starts_with('@'));
    let listed: BTreeSet<String> = entries
        .map(|line| {
            let (_, key) = line.split_once('{').expect("an entry opens with a brace");
            key.trim_end_matches(',').to_owned()
        })
        .collect();
    assert!(listed.iter().all(|key| is_key(key)), "keys are name_word_year: {listed:?}");
    let mut keys = BTreeSet::new();
    cited(&root().join("crates"), &mut keys);
    assert_eq!(keys, listed, "cited in the code, and listed in REFERENCES.bib");
}
