//! What the command finds: numbers, exit codes, JSON, files.

use crate::common::{Folder, report_of, repository, without_times};
use pompeiu_testkit::data;
use serde_json::Value;
use std::io::Read;
use std::process::Stdio;

fn json(folder: &Folder, args: &str) -> Value {
    report_of(serde_json::from_slice(&folder.run(args).stdout).unwrap())
}

/// The keys of an object, in order.
fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}

#[track_caller]
fn assert_encloses(value: &Value, distance: f64) {
    let [lower, upper] = ["lower", "upper"].map(|end| value[end].as_f64().unwrap());
    assert!(lower <= distance && distance <= upper, "{distance} is not between {lower} and {upper}");
    assert!(upper - lower < 1e-11, "[{lower}, {upper}] is wide");
}

#[test]
fn decompose_reports_and_writes_what_adds_up() {
    let folder = Folder::new();
    folder.ok("generate torus --major-segments 24 --minor-segments 16 -o torus.obj");
    let report_of = |args: &str| json(&folder, &format!("decompose torus.obj {args} --json"));
    let whole = report_of("--field random:1 -o parts.vtp");
    let of_mesh = [
        "faces",
        "genus",
        "boundary_loops",
        "components",
        "harmonic_dimension",
        "degrees_of_freedom",
        "decomposition",
    ];
    let of_field = ["residual", "part_error", "inner_products", "norms", "normal_part", "timing_ms"];
    let report = &whole["decomposition"];
    assert_eq!((keys(&whole), keys(report)), (sorted(&of_mesh), sorted(&of_field)));
    let products = ["gradient_rotated", "gradient_harmonic", "rotated_harmonic"];
    assert_eq!(keys(&report["inner_products"]), sorted(&products));
    assert_eq!(keys(&report["norms"]), sorted(&["field", "gradient", "rotated", "harmonic"]));
    assert_eq!(keys(&report["timing_ms"]), sorted(&["factor", "solve", "basis"]));
    assert_eq!((&whole["genus"], &whole["harmonic_dimension"]), (&1.into(), &2.into()));
    assert_eq!(whole["degrees_of_freedom"]["conforming"]["residual_dimension"], 770);
    assert!(report["residual"].as_f64().unwrap() <= 1e-12 && report["part_error"].as_f64().unwrap() <= 1e-12);
    for product in products {
        assert!(report["inner_products"][product].as_f64().unwrap().abs() <= 1e-12);
    }
    // The parts that were written are split into themselves, whatever the format they are read from.
    folder.ok("decompose torus.obj --field parts.vtp --name field -o parts.ply");
    let norm = |report: &Value, part: &str| report["norms"][part].as_f64().unwrap();
    for file in ["parts.vtp", "parts.ply"] {
        for part in ["field", "gradient", "rotated", "harmonic"] {
            let again = report_of(&format!("--field {file} --name {part}"));
            let again = &again["decomposition"];
            for other in ["gradient", "rotated", "harmonic"] {
                let expected = if part == "field" || part == other { norm(report, other) } else { 0.0 };
                assert!((norm(again, other) - expected).abs() < 1e-11, "{file}: {other} of {part}");
            }
        }
    }
    let counted = report_of("");
    assert_eq!((keys(&counted), &counted["decomposition"]), (sorted(&of_mesh), &Value::Null));
}

#[test]
fn decompose_finds_the_handles_of_real_meshes() {
    let folder = Folder::new();
    for (name, genus) in [("3holes", 3), ("fertility", 4)] {
        let Some(path) = data::file(&format!("meshes/{name}.off")) else { continue };
        let report = json(&folder, &format!("decompose {} --field rotation:1,2,3 --json", path.display()));
        assert_eq!((&report["genus"], &report["harmonic_dimension"]), (&genus.into(), &(2 * genus).into()));
        assert!(report["decomposition"]["residual"].as_f64().unwrap() <= 1e-12);
    }
}

#[test]
fn json_has_exactly_the_documented_keys() {
    let folder = Folder::with_tent();
    let mut answer: Value = serde_json::from_str(&folder.ok("distance tent.obj square.obj --json")).unwrap();
    let all = ["version", "command", "inputs", "request", "report", "stop", "timing_ms"];
    assert_eq!(keys(&answer), sorted(&all));
    assert_eq!(keys(&answer["timing_ms"]), ["read", "total"]);
    for mesh in [0, 1] {
        assert_eq!(keys(&answer["inputs"][mesh]), sorted(&["path", "vertices", "faces", "sha256"]));
    }
    assert_eq!(answer["inputs"][0]["path"], "tent.obj");
    assert_eq!((&answer["inputs"][0]["vertices"], &answer["inputs"][1]["faces"]), (&5.into(), &2.into()));
    let report = answer["report"].take();
    let all = ["tolerance", "a_to_b", "b_to_a", "hausdorff", "timing_ms"];
    assert_eq!(keys(&report), sorted(&all));
    assert_eq!(keys(&report["tolerance"]), sorted(&["requested", "kind", "absolute"]));
    assert_eq!(report["tolerance"]["kind"], "diagonal");
    let directed = ["lower", "upper", "stop", "tolerance", "witness", "work", "timing_ms"];
    for direction in ["a_to_b", "b_to_a"] {
        assert_eq!(keys(&report[direction]), sorted(&directed));
        assert_eq!(report[direction]["stop"], "tolerance");
        assert_eq!(keys(&report[direction]["witness"]), ["a", "b"]);
        for end in ["a", "b"] {
            let point = &report[direction]["witness"][end];
            assert_eq!(keys(point), sorted(&["face", "barycentric", "position"]));
            assert_eq!(point["barycentric"].as_array().map(Vec::len), Some(3));
            assert_eq!(point["position"].as_array().map(Vec::len), Some(3));
        }
    }
    assert_eq!(keys(&report["hausdorff"]), ["lower", "upper"]);
    assert_eq!(keys(&report["timing_ms"]), sorted(&["build", "search"]));
    assert_encloses(&report["a_to_b"], 0.75);
    assert_encloses(&report["b_to_a"], 0.6);
    assert_encloses(&report["hausdorff"], 0.75);

    let report = json(&folder, "distance tent.obj square.obj --json --direction b-to-a");
    assert_eq!(keys(&report), sorted(&["tolerance", "b_to_a", "timing_ms"]));
    assert_encloses(&report["b_to_a"], 0.6);
    let report = json(&folder, "distance tent.obj square.obj --json --direction a-to-b");
    assert_eq!(keys(&report), sorted(&["tolerance", "a_to_b", "timing_ms"]));
    assert_encloses(&report["a_to_b"], 0.75);
}

/// The parser of the tests keeps objects sorted by key.
fn sorted<'k>(keys: &[&'k str]) -> Vec<&'k str> {
    let mut keys = keys.to_vec();
    keys.sort_unstable();
    keys
}

#[test]
fn witnesses_lie_on_the_meshes_that_their_keys_name() {
    let folder = Folder::with_tent();
    // The apex of the tent is the farthest point of it; nearest to it is the middle of the square.
    let report = json(&folder, "distance tent.obj square.obj --json");
    let position = |direction: &str, end: &str| -> Vec<f64> {
        serde_json::from_value(report[direction]["witness"][end]["position"].clone()).unwrap()
    };
    let near = |p: Vec<f64>, q: [f64; 3]| p.iter().zip(q).all(|(x, y)| (x - y).abs() < 1e-6);
    assert!(near(position("a_to_b", "a"), [0.0, 0.0, 0.75]));
    assert!(near(position("a_to_b", "b"), [0.0, 0.0, 0.0]));
    // From the middle of the square the nearest points of the tent are on its sides.
    assert!(near(position("b_to_a", "b"), [0.0, 0.0, 0.0]));
    assert!(position("b_to_a", "a")[2] > 0.4);
    assert!(report["b_to_a"]["witness"]["b"]["face"].as_u64().unwrap() < 2);
}

#[test]
fn a_mesh_is_at_no_distance_from_itself() {
    let folder = Folder::with_tent();
    let report = json(&folder, "distance tent.obj tent.obj --json");
    for distance in ["a_to_b", "b_to_a", "hausdorff"] {
        assert_encloses(&report[distance], 0.0);
    }
}

#[test]
fn numbers_read_back_to_the_same_double() {
    let folder = Folder::with_tent();
    let text = folder.ok("distance tent.obj square.obj --json --direction b-to-a --tolerance 1e-7");
    let after = |key: &str| {
        let start = text.find(key).unwrap() + key.len();
        let number: String = text[start..].chars().take_while(|c| !",}".contains(*c)).collect();
        number
    };
    for key in ["\"lower\":", "\"upper\":", "\"absolute\":", "\"requested\":"] {
        let number = after(key);
        let value: f64 = number.parse().unwrap();
        assert!(number.len() <= format!("{value:e}").len().max(format!("{value}").len()) + 2, "{number}");
    }
    assert_eq!(after("\"requested\":"), "1e-7");
    let tolerance: f64 = after("\"absolute\":").parse().unwrap();
    assert_eq!(tolerance, 1e-7 * (4.0_f64 + 4.0 + 0.75 * 0.75).sqrt());
}

#[test]
fn thresholds_decide_the_exit_code() {
    let folder = Folder::with_tent();
    for (threshold, direction, code, answer) in [
        ("1", "both", 0, "below"),
        ("0.75000001", "both", 0, "below"),
        ("0.74999999", "both", 1, "above"),
        ("0.7", "b-to-a", 0, "below"),
        ("0.7", "a-to-b", 1, "above"),
        ("0", "both", 1, "above"),
    ] {
        let args = format!("distance tent.obj square.obj --within {threshold} --direction {direction}");
        let (exit, stdout, stderr) = folder.transcript(&args);
        assert_eq!((exit, stderr.as_str()), (Some(code), ""), "{args}");
        let words = if answer == "below" { "is at most" } else { "exceeds" };
        assert!(stdout.contains(&format!("{words} {threshold}: proven")), "{stdout}");
        let report = json(&folder, &(args + " --json"));
        assert_eq!(report["threshold"]["answer"], answer);
        assert_eq!(report["threshold"]["value"], threshold.parse::<f64>().unwrap());
    }
}

#[test]
fn budgets_end_in_a_valid_interval_and_exit_code_3() {
    let folder = Folder::new();
    let (lantern, cylinder) = ("lantern.obj", "cylinder.obj");
    folder.ok(&format!("generate schwarz-lantern -o {lantern}"));
    folder.ok(&format!("generate cylinder --segments 64 --rows 8 -o {cylinder}"));
    let exact = json(&folder, &format!("distance {lantern} {cylinder} --json"));
    let [lower, upper] = ["lower", "upper"].map(|end| exact["hausdorff"][end].as_f64().unwrap());
    for (limit, stop) in [("--time-limit 1ns", "time"), ("--memory-limit 10kB", "memory")] {
        let args = format!("distance {lantern} {cylinder} --json {limit}");
        let output = folder.run(&args);
        assert_eq!(output.status.code(), Some(3), "{limit}");
        let report = json(&folder, &args);
        assert_eq!(report["a_to_b"]["stop"], stop);
        assert!(report["hausdorff"]["lower"].as_f64().unwrap() <= upper);
        assert!(report["hausdorff"]["upper"].as_f64().unwrap() >= lower);
        let undecided = format!("distance {lantern} {cylinder} --json {limit} --within {lower}");
        assert_eq!(folder.run(&undecided).status.code(), Some(3));
        assert_eq!(json(&folder, &undecided)["threshold"]["answer"], "undecided");
    }
}

/// Nothing is said of what was not read, but that there was no time for it.
#[cfg(unix)]
#[test]
fn reading_ends_with_the_time_limit() {
    let folder = Folder::new();
    folder.ok("generate icosphere -o sphere.obj");
    // Somebody begins to write into a pipe, and does not go on.
    let mut writer = std::process::Command::new("sh")
        .args(["-c", "mkfifo scan.ply && exec > scan.ply && echo ply && exec sleep 60"])
        .current_dir(folder.path())
        .spawn()
        .unwrap();
    while !folder.path().join("scan.ply").exists() {
        std::thread::yield_now();
    }
    let output = folder.run("distance scan.ply sphere.obj --time-limit 100ms");
    writer.kill().unwrap();
    writer.wait().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), output.stdout.len()), (Some(3), 0), "{said}");
    assert!(said.contains("the time limit of 100ms was over before the files were read"), "{said}");
}

#[test]
fn tolerances_mean_what_they_say() {
    let folder = Folder::new();
    folder.ok("generate icosphere -o sphere.obj");
    folder.ok("generate torus --major-radius 7 --minor-radius 2 --major-segments 12 --minor-segments 9 -o torus.obj");
    for (option, kind) in [
        ("--tolerance 0.01", "diagonal"),
        ("--tolerance 0.001 --tolerance-kind relative", "relative"),
        ("--tolerance 0.1 --tolerance-kind absolute", "absolute"),
    ] {
        let report = json(&folder, &format!("distance sphere.obj torus.obj --json {option}"));
        let [lower, upper, absolute] =
            [&report["hausdorff"]["lower"], &report["hausdorff"]["upper"], &report["tolerance"]["absolute"]]
                .map(|value| value.as_f64().unwrap());
        assert_eq!(report["tolerance"]["kind"], kind);
        assert!(upper - lower <= absolute * (1.0 + 1e-12), "{option}: {lower} {upper} {absolute}");
        let expected = match kind {
            "diagonal" => 0.01 * (18.0_f64.powi(2) + 18.0_f64.powi(2) + 4.0_f64.powi(2)).sqrt(),
            "relative" => 0.001 * upper,
            _ => 0.1,
        };
        assert!((absolute / expected - 1.0).abs() < 0.02, "{option}: {absolute} {expected}");
    }
}

#[test]
fn both_methods_trace_their_way_to_the_same_answer() {
    let folder = Folder::with_tent();
    let mut examined = Vec::new();
    for method in ["fast", "classic"] {
        let args = format!("distance tent.obj square.obj --method {method} --tolerance 1e-4 --trace");
        let text = folder.ok(&args);
        assert_eq!(text.matches("pieces left").count(), 2, "{text}");
        let report = json(&folder, &(args + " --json"));
        examined.push(report["b_to_a"]["work"]["pieces"].as_u64().unwrap());
        let rows = report["trace"].as_array().unwrap();
        let expected =
            ["direction", "tolerance", "absolute", "lower", "upper", "pieces", "distances", "time_ms"];
        for (direction, distance) in [("a_to_b", 0.75), ("b_to_a", 0.6)] {
            let rows: Vec<_> = rows.iter().filter(|row| row["direction"] == direction).collect();
            let fractions: Vec<_> = rows.iter().map(|row| row["tolerance"].as_f64().unwrap()).collect();
            assert_eq!(fractions[..3], [1e-1, 1e-2, 1e-3], "{method}");
            assert!(fractions.len() == 4 && (fractions[3] / 1e-4 - 1.0).abs() < 1e-3, "{fractions:?}");
            for row in rows {
                assert_eq!(keys(row), sorted(&expected));
                let [lower, upper, absolute] =
                    ["lower", "upper", "absolute"].map(|key| row[key].as_f64().unwrap());
                assert!(lower <= distance * (1.0 + 1e-12) && distance <= upper * (1.0 + 1e-12), "{row}");
                assert!(upper - lower <= absolute * (1.0 + 1e-9), "{row}");
            }
        }
    }
    assert!(10 * examined[0] < examined[1], "{examined:?}");
}

#[test]
fn rows_of_a_trace_name_the_direction_asked_for() {
    let folder = Folder::with_tent();
    for (option, direction) in [("a-to-b", "a_to_b"), ("b-to-a", "b_to_a")] {
        let report =
            json(&folder, &format!("distance tent.obj square.obj --trace --json --direction {option}"));
        let rows = report["trace"].as_array().unwrap();
        assert!(rows.len() == 12 && rows.iter().all(|row| row["direction"] == direction), "{rows:?}");
    }
}

#[test]
fn threads_do_not_change_the_answer() {
    let folder = Folder::new();
    folder.ok("generate icosphere -o a.obj");
    folder.ok("generate icosphere --noise 0.05 -o b.obj");
    let answer = |threads: &str| {
        without_times(json(&folder, &format!("distance a.obj b.obj --json --threads {threads}")))
    };
    assert_eq!(answer("1"), answer("2"));
    assert_eq!(answer("1"), answer("8"));
}

#[test]
fn a_closed_pipe_is_not_an_error() {
    let folder = Folder::with_tent();
    for args in ["distance tent.obj square.obj", "info tent.obj --json", "completions bash", "--help"] {
        let mut child = folder.pompeiu(args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let mut stderr = String::new();
        child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
        assert_eq!((child.wait().unwrap().code(), stderr.as_str()), (Some(0), ""), "{args}");
    }
}

#[test]
fn a_full_disk_is_an_error() {
    if !std::path::Path::new("/dev/full").exists() {
        println!("skipped: there is no /dev/full");
        return;
    }
    let folder = Folder::with_tent();
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let output = folder.pompeiu("info tent.obj").stdout(full).stderr(Stdio::piped()).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).starts_with("error: stdout: "));
}

#[test]
fn there_are_completions_for_every_shell() {
    let folder = Folder::new();
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = folder.ok(&format!("completions {shell}"));
        assert!(script.contains("certificate-slack") && script.contains("schwarz-lantern"), "{shell}");
    }
}

#[test]
fn there_is_a_manual_page_for_every_command() {
    let folder = Folder::new();
    folder.ok("man -o made/man1");
    let page = |name: &str| std::fs::read_to_string(folder.path().join("made/man1").join(name)).unwrap();
    let names = folder.commands();
    let is_known = |name: &str| names.iter().any(|known| known == name);
    assert!(is_known("distance") && is_known("man"), "{names:?}");
    for name in names.iter().filter(|name| *name != "help") {
        assert!(page(&format!("pompeiu-{name}.1")).contains(".SH SYNOPSIS"), "{name}");
        assert!(page("pompeiu.1").contains(&format!("pompeiu\\-{name}(1)")), "{name}");
    }
    assert!(page("pompeiu-distance.1").contains("\\-\\-within"));
    folder.write("file", "");
    assert_eq!(folder.run("man -o file").status.code(), Some(2));
}

#[test]
fn a_field_and_its_parts_as_a_picture_and_a_page() {
    let folder = Folder::new();
    folder.ok("generate torus -o torus.obj");
    let picture = |name: &str, field: &str| {
        folder.ok(&format!("decompose torus.obj --field {field} --image {name} --image-size 400x300 --up z"));
        std::fs::read(folder.path().join(name)).unwrap()
    };
    let rotation = picture("a.png", "rotation:z");
    assert!(rotation.starts_with(b"\x89PNG"));
    assert_eq!(rotation, picture("b.png", "rotation:z"));
    assert_ne!(rotation, picture("c.png", "gradient:x"));
    folder.ok("decompose torus.obj --field rotation:z --report a.html");
    let page = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
    assert!(page.contains("torus.obj") && page.contains("degrees of freedom"));
    for args in [
        "--image d.png",
        "--field rotation:z --report torus.obj",
        "--field rotation:z --image nowhere/d.png",
        "--field rotation:z --image d.jpg",
        "--field rotation:z --report d.vtp -o d.vtp",
    ] {
        let (code, stdout, _) = folder.transcript(&format!("decompose torus.obj {args}"));
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{args}");
    }
}

#[test]
fn colours_are_for_terminals() {
    let folder = Folder::with_tent();
    let (_, stdout, stderr) = folder.transcript("distance tent.obj square.obj --tolerance 0");
    assert!(!stdout.contains('\u{1b}') && !stderr.contains('\u{1b}'));
    let forced = folder.pompeiu("info tent.obj").env("CLICOLOR_FORCE", "1").output().unwrap();
    assert!(forced.stdout.contains(&0x1b));
    let both =
        folder.pompeiu("info tent.obj").env("CLICOLOR_FORCE", "1").env("NO_COLOR", "1").output().unwrap();
    assert!(!both.stdout.contains(&0x1b));
}

#[test]
fn converted_meshes_are_the_same_mesh() {
    let folder = Folder::new();
    folder.ok("generate torus --noise 0.01 -o torus.obj");
    let info = |file: &str| {
        let mut info = json(&folder, &format!("info {file} --json"));
        info.as_object_mut().unwrap().remove("file");
        info
    };
    for suffix in ["ply", "off", "vtp", "obj.gz", "ply.gz"] {
        let name = format!("copy.{suffix}");
        folder.ok(&format!("convert torus.obj {name}"));
        assert_eq!(info(&name), info("torus.obj"), "{suffix}");
    }
    for suffix in ["stl", "glb"] {
        folder.ok(&format!("convert torus.obj copy.{suffix}"));
        let report = json(&folder, &format!("distance torus.obj copy.{suffix} --json"));
        let upper = report["hausdorff"]["upper"].as_f64().unwrap();
        assert!(upper > 0.0 && upper < 1e-6, "{suffix}: {upper}");
    }
}

#[test]
fn edits_are_made_in_the_order_of_the_help() {
    let folder = Folder::new();
    folder
        .ok("generate cube --translate 1,0,0 --rotate 0,0,1,90 --scale 2 --unweld --subdivide 1 -o cube.obj");
    let info = json(&folder, "info cube.obj --json");
    // Scaled to side 2, turned, then moved by 1 along x; unwelding comes last.
    assert_eq!(info["bounding_box"]["lower"], serde_json::json!([0.0, -1.0, -1.0]));
    assert_eq!(info["bounding_box"]["upper"], serde_json::json!([2.0, 1.0, 1.0]));
    assert_eq!((&info["faces"], &info["vertices"]), (&48.into(), &144.into()));
    folder.ok("generate icosphere --noise 0.1 --seed 1 -o a.obj");
    folder.ok("generate icosphere --noise 0.1 --seed 1 --shuffle 5 -o b.obj");
    let report = json(&folder, "distance a.obj b.obj --json");
    assert_eq!(report["hausdorff"]["lower"], 0.0);
    assert!(report["hausdorff"]["upper"].as_f64().unwrap() < 1e-11);
}

#[test]
fn a_mesh_of_a_file_is_edited_like_a_shape() {
    let folder = Folder::new();
    folder.ok("generate torus --noise 0.01 --seed 3 -o torus.ply");
    folder.ok("generate mesh torus.ply --subdivide 1 --ripple 0.05,1 --shuffle 2 -o edited.obj");
    folder.ok("generate torus --noise 0.01 --seed 3 --subdivide 1 -o fine.obj");
    let edited = json(&folder, "info edited.obj --json");
    assert_eq!(edited["faces"], json(&folder, "info fine.obj --json")["faces"]);
    // Vertices moved by at most sqrt(3) x 0.05, and did move.
    let report = json(&folder, "distance edited.obj torus.ply --json");
    let upper = report["hausdorff"]["upper"].as_f64().unwrap();
    assert!(upper > 0.02 && upper < 0.087, "{upper}");
}

#[test]
fn every_shape_can_be_generated_and_described() {
    let folder = Folder::new();
    let help = folder.ok("generate --help");
    let shapes: Vec<_> = help
        .lines()
        .skip_while(|line| *line != "Shapes:")
        .skip(1)
        .map_while(|line| line.split_whitespace().next())
        .filter(|&name| !matches!(name, "help" | "mesh" | "wire" | "polyline" | "noisy-circle"))
        .collect();
    assert_eq!(shapes.len(), 21, "{help}");
    for shape in shapes {
        folder.ok(&format!("generate {shape} -o {shape}.ply"));
        let info = json(&folder, &format!("info {shape}.ply --json"));
        assert!(info["faces"].as_u64().unwrap() > 0);
    }
}

#[test]
fn example_meshes_are_made_by_the_commands_beside_them() {
    let folder = Folder::new();
    let examples = repository().join("examples/meshes");
    let readme = std::fs::read_to_string(examples.join("README.md")).unwrap();
    let mut made = 0;
    for command in readme.lines().filter_map(|line| line.strip_prefix("pompeiu generate ")) {
        folder.ok(&format!("generate {command}"));
        let name = command.rsplit(' ').next().unwrap();
        let [ours, theirs] =
            [folder.path(), examples.as_path()].map(|place| std::fs::read(place.join(name)).unwrap());
        assert!(ours == theirs, "{name} is not what `pompeiu generate {command}` makes");
        made += 1;
    }
    let meshes = std::fs::read_dir(&examples).unwrap().filter(|entry| {
        entry.as_ref().is_ok_and(|entry| entry.path().extension().is_some_and(|suffix| suffix == "obj"))
    });
    assert_eq!(meshes.count(), made);
}

#[test]
fn topology_of_well_known_meshes() {
    let folder = Folder::new();
    for (name, genus, boundary_loops) in
        [("fertility.off", 4, 0), ("3holes.off", 3, 0), ("camelhead.off", 0, 1), ("spot.obj", 0, 0)]
    {
        let Some(path) = data::file(&format!("meshes/{name}")) else { continue };
        let output = folder.pompeiu("info --json").arg(&path).output().unwrap();
        let info = report_of(serde_json::from_slice(&output.stdout).unwrap());
        assert_eq!(
            (&info["genus"], &info["boundary_loops"]),
            (&genus.into(), &boundary_loops.into()),
            "{name}"
        );
        assert_eq!((&info["components"], &info["non_manifold_edges"]), (&1.into(), &0.into()), "{name}");
        println!("checked {name}");
    }
}

#[test]
fn repair_says_what_it_did_and_proves_how_far_it_went() {
    let folder = Folder::new();
    // A tetrahedron of loose faces: one turned, one twice, one without area; and a vertex in no face.
    folder.write(
        "loose.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nv 1 0 0\nv 0 0 1\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 0\nv 0 1 0\nv 0 0 1\nv 9 9 9\n\
         f 1 3 2\nf 4 5 6\nf 7 8 9\nf 10 11 12\nf 2 3 1\nf 1 1 2\n",
    );
    let said = folder.ok("info loose.obj");
    assert!(
        said.contains(" seam edges (at the place of another boundary edge; pompeiu repair welds them)"),
        "{said}"
    );
    let report = json(&folder, "repair loose.obj clean.ply --within 1e-9 --json");
    let count = |name: &str| report[name]["count"].as_u64().unwrap();
    assert_eq!(count("welded_vertices"), 8);
    assert_eq!((count("degenerate_faces"), count("duplicate_faces"), count("turned_faces")), (1, 1, 1));
    assert_eq!(report["unreferenced_vertices"]["places"], serde_json::json!([[9.0, 9.0, 9.0]]));
    assert!(report["written"] == true && report["distance"]["upper"].as_f64().unwrap() <= 1e-9);
    let info = json(&folder, "info clean.ply --json");
    assert_eq!(
        (info["genus"].as_u64(), info["boundary_edges"].as_u64(), info["faces"].as_u64()),
        (Some(0), Some(0), Some(4))
    );
    let text = folder.ok("repair clean.ply again.ply");
    assert!(text.contains("nothing: the mesh is sound"), "{text}");
    // Without the slanted face a hole is left; filling it moves away from the input.
    folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n");
    let output = folder.run("repair open.obj closed.ply --fill-holes 3 --within 0.01 --json");
    assert_eq!((output.status.code(), folder.path().join("closed.ply").exists()), (Some(1), false));
    folder.ok("repair open.obj closed.ply --fill-holes 3 --within 0.9");
    assert_eq!(json(&folder, "info closed.ply --json")["boundary_edges"].as_u64(), Some(0));
}

#[test]
fn align_brings_a_part_back_and_says_how_sure_it_is() {
    let folder = Folder::new();
    folder.ok("generate icosphere --subdivisions 3 -o ball.obj");
    // An ellipsoid with a bump has no symmetry but a mirror's, which no motion has.
    let ball = std::fs::read_to_string(folder.path().join("ball.obj")).unwrap();
    let bumped = |line: &str, place: fn([f64; 3]) -> [f64; 3]| {
        let Some(numbers) = line.strip_prefix("v ") else { return line.to_owned() };
        let numbers: Vec<f64> = numbers.split(' ').map(|x| x.parse().unwrap()).collect();
        let [x, y, z] = numbers[..] else { unreachable!() };
        let bump = 1.0 + (0.6 - (x - 0.6).abs() - (y - 0.5).abs() - (z - 0.6).abs()).max(0.0);
        let [x, y, z] = place([2.0 * x * bump, 1.3 * y * bump, 0.9 * z * bump]);
        format!("v {x} {y} {z}")
    };
    let write = |name: &str, place: fn([f64; 3]) -> [f64; 3]| {
        folder.write(name, ball.lines().map(|line| bumped(line, place)).collect::<Vec<_>>().join("\n"));
    };
    write("model.obj", |p| p);
    write("moved.obj", |[x, y, z]| [z + 9.0, x - 4.0, y + 2.0]);
    let found = json(&folder, "align moved.obj model.obj -o back.ply --matrix m.txt --json");
    assert_eq!(found["unique"], true, "{found}");
    for way in ["moved_to_fixed", "fixed_to_moved"] {
        assert!(found[way]["upper"].as_f64().unwrap() < 1e-9, "{found}");
    }
    let back = json(&folder, "distance back.ply model.obj --json");
    assert!(back["hausdorff"]["upper"].as_f64().unwrap() < 1e-9);
    let text = std::fs::read_to_string(folder.path().join("m.txt")).unwrap();
    let rows: Vec<f64> = text.split_whitespace().map(|x| x.parse().unwrap()).collect();
    let matrix: Vec<f64> = found["matrix"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|row| row.as_array().unwrap())
        .map(|x| x.as_f64().unwrap())
        .collect();
    assert_eq!((rows.len(), rows), (16, matrix));
    let text = folder.ok("align ball.obj ball.obj");
    assert!(text.starts_with("verdict") && text.contains("3 motions leave the fit"), "{text}");
    // What it is not, in which unit it is, and for which programs.
    folder.ok("generate torus --major-segments 24 --minor-segments 16 -o torus.obj");
    let other = folder.run("align torus.obj model.obj");
    let text = String::from_utf8(other.stdout).unwrap();
    assert!(other.status.code() == Some(3) && text.starts_with("verdict   DIFFERENT SHAPES"), "{text}");
    write("inches.obj", |p| p.map(|x| x / 25.4));
    let text = folder.ok("align inches.obj model.obj --scale");
    assert!(text.contains("scaled by 25.4") && text.contains("millimetres to an inch"), "{text}");
    assert!(text.contains("ParaView  Translate ") && text.contains("Scale 25."), "{text}");
    let refused = folder.run("align moved.obj model.obj -o model.obj");
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn cut_answers_with_what_glues_back() {
    let folder = Folder::new();
    folder.ok("generate torus --major-segments 24 --minor-segments 16 -o torus.obj");
    let report = json(&folder, "cut torus.obj -o opened.obj --json");
    let all = [
        "vertices",
        "copies",
        "faces",
        "components",
        "cut",
        "euler_characteristic",
        "boundary_loops",
        "vertex_map",
    ];
    assert_eq!(keys(&report), sorted(&all));
    assert_eq!(keys(&report["cut"]), sorted(&["edges", "length", "strategy"]));
    assert_eq!((&report["euler_characteristic"], &report["boundary_loops"]), (&1.into(), &1.into()));
    let [before, after] =
        ["torus.obj", "opened.obj"].map(|name| pompeiu::io::read_mesh(folder.path().join(name)).unwrap());
    let map: Vec<usize> =
        report["vertex_map"].as_array().unwrap().iter().map(|v| v.as_u64().unwrap() as usize).collect();
    assert_eq!(
        (after.positions().len(), report["vertices"].as_u64().unwrap() as usize),
        (map.len(), map.len())
    );
    for (glued, face) in after.faces().iter().zip(before.faces()) {
        assert_eq!(glued.map(|v| map[v as usize] as u32), *face);
    }
    for (position, &v) in after.positions().iter().zip(&map) {
        assert_eq!(*position, before.positions()[v]);
    }
    assert!(folder.run("cut torus.obj").stdout.is_empty());
}

#[test]
fn medial_fills_a_surface_with_balls_and_writes_them() {
    let folder = Folder::new();
    folder.ok("generate torus --major-segments 24 --minor-segments 16 -o torus.obj");
    let report =
        json(&folder, "medial torus.obj --balls 10 --samples 400 -o balls.ma --report balls.html --json");
    let all = ["balls", "edges", "overlaps", "shrunk", "deviation", "stop", "timing_ms"];
    assert_eq!(keys(&report), sorted(&all));
    let balls = report["balls"].as_array().unwrap();
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let text = read("balls.ma");
    assert_eq!(text.lines().filter(|line| line.starts_with("v ")).count(), balls.len());
    assert_eq!(
        text.lines().filter(|line| line.starts_with("e ")).count(),
        report["edges"].as_array().unwrap().len()
    );
    assert!(read("balls.html").contains("Balls in torus.obj"));
    let spheres = "medial torus.obj --balls 3 --samples 400 -o spheres.ply";
    assert!(folder.ok(spheres).contains("from the surface to the balls between"));
    assert_eq!(pompeiu::io::read_mesh(folder.path().join("spheres.ply")).unwrap().faces().len(), 3 * 1280);
    folder.ok("medial torus.obj --balls 3 --samples 400 -o balls.png --image-size 320x200");
    folder.ok("cut torus.obj --strategy bones --balls 8 --sections -o bones.obj");
    std::fs::write(folder.path().join("closed.txt"), "v 0\ne 5 6\nf 7\n").unwrap();
    folder.ok("cut torus.obj --strategy genus --forbid-file closed.txt --avoid-curvature 0.5 -o away.obj");
    std::fs::write(folder.path().join("wrong.txt"), "v 0\nnothing\n").unwrap();
    let refused = folder.run("cut torus.obj --forbid-file wrong.txt -o away.obj");
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("line 2"));
    assert!(folder.run("medial torus.obj").stdout.is_empty());
    for options in
        ["--energy lscm", "--energy spectral", "--energy arap", "--boundary circle --virtual-layers 3"]
    {
        let report = folder.run(&format!("flatten torus.obj {options} --json"));
        assert!(matches!(report.status.code(), Some(0 | 3)), "{options}");
    }
}

#[test]
fn complexity_measures_a_folder_and_goes_on_after_files_that_cannot_be_used() {
    let folder = Folder::new();
    std::fs::create_dir(folder.path().join("shapes")).unwrap();
    folder.write("shapes/circle.svg", "<svg><circle r='9'/></svg>");
    folder.write("shapes/arch.svg", "<svg><path d='M0 0h9v9h-3V3H3v6H0z'/></svg>");
    folder.write("mine.csv", "file,place\ncircle,1\narch,2\n");
    let report =
        json(&folder, "complexity shapes --clusters 2 --against mine.csv --report gallery.html --json");
    let shape = &report["shapes"][0];
    assert_eq!(shape["file"], "shapes/arch.svg");
    for key in ["500", "100", "50", "25", "8"] {
        assert!(shape["boundary"][key].as_f64().unwrap() <= 1.0, "{key}");
    }
    assert_eq!(shape["curvature"]["histogram"].as_array().unwrap().len(), 10);
    for key in ["first_bin", "one_minus_first_bin"] {
        assert!(shape["curvature"][key].is_number(), "{key}");
    }
    assert_eq!(report["ranking"][0]["file"], "shapes/circle.svg");
    assert_eq!(
        (&report["agreement"]["kendall"], &report["clusters"]["is_optimal"]),
        (&1.0.into(), &true.into())
    );
    assert!(std::fs::read_to_string(folder.path().join("gallery.html")).unwrap().contains("arch.svg"));
    // Damage in one file is told with its name, and the others are measured.
    folder.write("shapes/broken.png", b"\x89PNG\r\n\x1a\n\0\0");
    folder.write("shapes/open.svg", "<svg><path fill='none' d='M0 0H9V9'/></svg>");
    let (code, answer, messages) = folder.transcript("complexity shapes --json");
    assert_eq!(code, Some(3));
    assert!(messages.contains("shapes/broken.png: the PNG") && messages.contains("shapes/open.svg: curve 0"));
    let answer: Value = serde_json::from_str(&answer).unwrap();
    let answer = &answer["report"];
    assert_eq!(
        (answer["shapes"].as_array().unwrap().len(), answer["failed"].as_array().unwrap().len()),
        (2, 2)
    );
    std::fs::create_dir(folder.path().join("empty")).unwrap();
    for (arguments, words) in [
        ("complexity empty", "empty: holds no picture"),
        ("complexity shapes/arch.svg --rank-by size", "there is no measure `size`"),
        ("complexity shapes/arch.svg --clusters 2", "2 clusters are asked for of 1 shapes"),
        ("complexity shapes/arch.svg --smoothing 2", "the smoothing is 2"),
        ("complexity shapes/arch.svg --level 3 --against missing.csv", "missing.csv"),
    ] {
        let (code, _, message) = folder.transcript(arguments);
        assert!(code == Some(2) && message.contains(words), "{arguments}: {message}");
    }
}

#[test]
fn couple_solves_scenes_compares_schemes_and_says_why_solvers_do_not_agree() {
    let folder = Folder::new();
    folder.write("tube.toml", "kind = 'tube'\nwindows = 3\n[coupling]\ntolerance = 1e-5\n");
    let report = json(&folder, "couple tube.toml -o sections.csv --json");
    let run = &report["runs"][0];
    assert_eq!((&run["scheme"], &run["windows"][0]["solves"]), (&"iqn-ils".into(), &20.into()));
    assert!(run["from_monolithic"].as_f64().unwrap() < 1e-4);
    let table = std::fs::read_to_string(folder.path().join("sections.csv")).unwrap();
    assert_eq!(table.lines().count(), 1 + 2 * 3);
    assert!(table.lines().all(|line| line.split(',').count() == 2 + 101));

    let report = json(&folder, "couple tube.toml --compare --json");
    assert_eq!(report["runs"].as_array().unwrap().len(), 7);
    let (code, answer, _) = folder.transcript("couple tube.toml --scheme fixed");
    assert_eq!(code, Some(3));
    assert!(answer.contains("AGREED in 0 of 3 windows") && answer.contains("added-mass number"), "{answer}");

    folder.write("box.toml", "kind = 'box'\nwindows = 3\n[box]\ncells = [8, 8]\n");
    let report = json(&folder, "couple box.toml --json");
    assert!(report["runs"][0]["windows"][2]["pressure_constant"].as_f64().unwrap() > 0.0);
    let (code, answer, _) = folder.transcript("couple box.toml --closed refuse");
    assert!(code == Some(3) && answer.contains("-∮u·n is"), "{answer}");

    folder.write("wrong.toml", "kind = 'tube'\n[tube]\nmodulos = 1\n");
    folder.write("soft.toml", "kind = 'tube'\n[tube]\nmodulus = -1\n");
    for (arguments, words) in [
        ("couple missing.toml", "missing.toml"),
        ("couple wrong.toml", "did you mean `modulus`?"),
        ("couple soft.toml", "the modulus of the wall is -1"),
        ("couple tube.toml --scheme magic", "there is no scheme `magic`"),
        ("couple tube.toml --extrapolate 3", "the order of the extrapolation is 3"),
    ] {
        let (code, _, message) = folder.transcript(arguments);
        assert!(code == Some(2) && message.contains(words), "{arguments}: {message}");
    }
}

#[test]
fn couple_writes_a_page_that_plays_the_run() {
    let folder = Folder::new();
    folder.write("channel.toml", "kind = 'channel'\nwindows = 4\n[channel]\ncells = [12, 4]\n");
    let plain = json(&folder, "couple channel.toml --json");
    let report = json(&folder, "couple channel.toml --video run.html --report same.html --json");
    assert_eq!(report["runs"], plain["runs"]);
    let page = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let page_of_run = page("run.html");
    assert!(page_of_run.contains("Solves of each window") && page_of_run.contains("iqn-ils, 4 of"));
    // The command names the files of the page itself, the same for both.
    assert_eq!(page_of_run, page("same.html"));

    // A run that fails at once has a page that says why.
    let (code, _, _) = folder.transcript("couple channel.toml --scheme fixed --report failed.html");
    assert_eq!(code, Some(3));
    assert!(page("failed.html").contains("cannot agree by plain iteration"));
    let (code, _, _) = folder.transcript("couple channel.toml --time-limit 1ns --report limited.html");
    assert_eq!(code, Some(3));
    assert!(
        page("limited.html").contains("1 of ") && page("limited.html").contains("interrupted after window 1")
    );

    for (arguments, words) in [
        ("couple channel.toml --report folder/that/is/not/there.html", "there is no folder"),
        ("couple channel.toml --report page.pdf", "page.pdf"),
        ("couple channel.toml --report run.html --video run.html", "named for two outputs"),
        ("couple channel.toml --report page.html --compare", "--report has the data of one run"),
    ] {
        let (code, _, message) = folder.transcript(arguments);
        assert!(code == Some(2) && message.contains(words), "{arguments}: {message}");
    }
}

#[test]
fn puzzle_says_whether_pieces_can_move_and_draws_them() {
    let folder = Folder::new();
    let report = json(&folder, "puzzle --pieces 12 -o pieces.svg --cuts cuts.dxf --report page.html --json");
    let keys: Vec<&str> = report.as_object().unwrap().keys().map(String::as_str).collect();
    assert_eq!(
        keys,
        ["area", "clusters", "depth", "energy", "least_neck", "pieces", "timing_ms", "without_tab"]
    );
    assert_eq!(report["clusters"].as_array().unwrap().len(), 1);
    let pieces = report["pieces"].as_array().unwrap();
    assert_eq!((pieces.len(), &pieces[0]["lock"], &pieces[0]["id"]), (12, &"locked".into(), &0.into()));
    let numbers = |key: &str| report["area"][key].as_f64().unwrap();
    assert!(
        (numbers("sum") - numbers("outline")).abs() < 1e-7 && (numbers("outline") - 60_000.0).abs() < 1e-7
    );
    let text = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(text("pieces.svg").matches("<path").count(), 12);
    assert!(text("cuts.dxf").contains("POLYLINE") && text("page.html").contains("Locked"));
    folder.write("disk.svg", "<svg><circle r='5'/></svg>");
    folder.write("bow.svg", "<svg><path d='M0 0H4L.5 3 4 5Z'/></svg>");
    folder.write("ring.svg", "<svg><path fill-rule='evenodd' d='M0 0H9V9H0Z M3 3H6V6H3Z'/></svg>");
    let disk = json(&folder, "puzzle --outline disk.svg --size 100,100 --layout voronoi -n 20 --json");
    let area = disk["area"]["outline"].as_f64().unwrap();
    assert!((area / (2500.0 * std::f64::consts::PI) - 1.0).abs() < 1e-3);
    let free = json(&folder, "puzzle --pieces 12 --tab none --json");
    assert_eq!((&free["depth"], free["clusters"].as_array().unwrap().len()), (&Value::Null, 12));
    assert_eq!(
        (&free["pieces"][0]["lock"], &free["pieces"][0]["similarity"]),
        (&"free".into(), &Value::Null)
    );
    let sheet = json(&folder, "puzzle -n 6 --kerf 0.4 --layout-on 600x300 -o sheet.svg --json");
    let used = sheet["packing"]["used"].as_f64().unwrap();
    assert!((used - 60_000.0 / 180_000.0).abs() < 1e-9, "{used}");
    assert!(text("sheet.svg").contains("viewBox=\"0 0 600 300\""));
    folder.write("box.svg", "<svg><rect width='4' height='4'/></svg>");
    let like = json(&folder, "puzzle --piece box.svg -n 6 --tab none --json");
    let overlap = |piece: &Value| piece["similarity"]["iou"].as_f64().unwrap();
    assert!(like["pieces"].as_array().unwrap().iter().all(|piece| overlap(piece) > 0.97));
    let energy: Vec<f64> = like["energy"].as_array().unwrap().iter().map(|e| e.as_f64().unwrap()).collect();
    assert!(energy.windows(2).all(|pair| pair[1] < pair[0]));
    for (arguments, words) in [
        ("puzzle --pieces 1", "the number of pieces is 1"),
        ("puzzle --pieces 1000000", "at most 20000"),
        ("puzzle --size 0,3", "the width is 0"),
        ("puzzle --outline bow.svg", "bow.svg: the outline crosses itself: side 1 meets side 3"),
        ("puzzle --outline ring.svg", "ring.svg: the shape has holes (1)"),
        ("puzzle --piece ring.svg", "ring.svg: the shape has holes (1)"),
        ("puzzle --piece bow.svg", "the piece shape crosses itself"),
        ("puzzle --piece none.png", "none.png: it cannot be read"),
        ("puzzle --outline none.png", "none.png: it cannot be read"),
        ("puzzle -o pieces.pdf", "puzzles are written as .svg or .dxf"),
        ("puzzle -n 6 --layout-on 150x400", "the sheet of 150 × 400 holds 3 of the 6 pieces"),
        ("puzzle --layout-on 0x400", "the layout_on is 0"),
        ("puzzle --layout-on 900x400 --pull 1", "exclude each other"),
        ("puzzle --layout-on 900x400 -o sheet.png", "written as .svg or .dxf"),
    ] {
        let (code, _, message) = folder.transcript(arguments);
        assert!(code == Some(2) && message.contains(words), "{arguments}: {message}");
    }
}

#[test]
fn flatten_says_whether_the_map_is_one_to_one_and_writes_it() {
    let folder = Folder::new();
    folder.ok("generate torus --major-segments 24 --minor-segments 16 -o torus.obj");
    let report = json(&folder, "flatten torus.obj -o flat.obj --report flat.html --json");
    let named = ["charts", "flipped", "overlapping", "boundary_loops", "cut", "distortion", "timing_ms"];
    for key in named {
        assert!(!report[key].is_null(), "{key}");
    }
    assert_eq!(
        [&report["charts"], &report["flipped"], &report["overlapping"]],
        [1, 0, 0].map(Value::from).each_ref()
    );
    for key in ["edges", "length", "strategy"] {
        assert!(!report["cut"][key].is_null(), "{key}");
    }
    let distortion = &report["distortion"];
    for (key, inner) in [("angle", "mean"), ("area", "max"), ("symmetric_dirichlet", "mean")] {
        assert!(distortion[key][inner].as_f64().unwrap() >= 1.0, "{key}");
    }
    for key in ["stretch_l2", "stretch_linf", "least_singular_ratio"] {
        assert!(distortion[key].as_f64().unwrap() > 0.0, "{key}");
    }
    assert_eq!(keys(&report["timing_ms"]), sorted(&["cut", "factor", "solve", "check", "total"]));
    let text = std::fs::read_to_string(folder.path().join("flat.obj")).unwrap();
    let count = |tag: &str| text.lines().filter(|line| line.starts_with(tag)).count();
    assert_eq!((count("v "), count("f ")), (24 * 16, 2 * 24 * 16));
    assert!(count("vt ") > 24 * 16);
    for (arguments, begins) in [
        ("flatten torus.obj -o flat.glb", &b"glTF"[..]),
        ("flatten torus.obj --boundary circle --weights cotangent -o flat.svg", b"<svg"),
        ("flatten torus.obj --strategy genus -o flat.png --image-size 320x200", b"\x89PNG"),
    ] {
        folder.ok(arguments);
        let name = arguments.split(' ').find(|word| word.starts_with("flat.")).unwrap();
        assert!(std::fs::read(folder.path().join(name)).unwrap().starts_with(begins), "{arguments}");
    }
    for wrong in
        ["flatten torus.obj", "flatten torus.obj -o flat.stl", "flatten torus.obj --boundary own -o x.obj"]
    {
        assert_eq!(folder.run(wrong).status.code(), Some(2), "{wrong}");
    }
    assert!(!folder.path().join("x.obj").exists());
    // A limit leaves a map that is one-to-one.
    let late = folder.run("flatten torus.obj --time-limit 0s --json");
    assert_eq!(late.status.code(), Some(3));
    let late: Value = serde_json::from_slice(&late.stdout).unwrap();
    assert_eq!(
        (&late["stop"], &late["report"]["flipped"], &late["report"]["overlapping"]),
        (&"time".into(), &0.into(), &0.into())
    );
}

/// Files without a command, and a matrix of one mesh, are answered with what was probably meant.
#[test]
fn what_was_meant_is_said() {
    let folder = Folder::with_tent();
    for (args, code, words) in [
        ("tent.obj square.obj", 2, "did you mean `pompeiu distance tent.obj square.obj`?"),
        ("tent.obj", 2, "did you mean `pompeiu info tent.obj`?"),
        ("tent.obj square.obj tent.obj", 2, "did you mean `pompeiu matrix"),
        ("decimate tent.obj", 2, "decimate is called `pompeiu simplify` here"),
        ("compare tent.obj square.obj", 2, "compare is called `pompeiu deviation` here"),
        ("matrix tent.obj", 0, "tent.obj is the only mesh"),
    ] {
        let (found, _, errors) = folder.transcript(args);
        assert!(found == Some(code) && errors.contains(words), "{args}: {errors}");
    }
    let (_, _, errors) = folder.transcript("distanc tent.obj square.obj");
    assert!(!errors.contains("did you mean"), "{errors}");
}

#[test]
fn fluid_measures_what_is_conserved_and_writes_its_steps() {
    let folder = Folder::new();
    folder.ok("generate torus --major-segments 24 --minor-segments 12 -o torus.obj");
    let scene = "steps = 6\ndt = 0.05\nvorticity = \"x*y+z\"\nharmonic = [0.5, -0.2]\nviscosity = 1e-3\n\
                 gravity = [0, 0, -1]\n[[density]]\nname = \"dye\"\nweight = 1\ninitial = \"exp(-4*x)\"\n";
    std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
    let command = "fluid torus.obj scene.toml -o run.pvd --every 3 --video run.html --json";
    let report = json(&folder, command);
    let steps = report["steps"].as_array().unwrap();
    assert_eq!((steps.len(), report["scheme"]["harmonic_fields"].as_u64()), (7, Some(2)));
    for step in steps {
        for key in ["time", "energy", "divergence", "mass", "harmonic", "max_speed"] {
            assert!(!step[key].is_null(), "{key}");
        }
        assert!(step["divergence"].as_f64().unwrap() < 1e-12);
        let [mass, first] = [step, &steps[0]].map(|step| step["mass"][0].as_f64().unwrap());
        assert!((mass / first - 1.0).abs() < 1e-12);
    }
    assert_eq!(keys(&report["timing_ms"]), sorted(&["factor", "per_step"]));
    assert_eq!(keys(&report["timing_ms"]["per_step"]), sorted(&["diffuse", "advect", "project"]));
    let list = std::fs::read_to_string(folder.path().join("run.pvd")).unwrap();
    for step in [0, 3, 6] {
        assert!(list.contains(&format!("run/step-{step:05}.vtp")), "{list}");
        assert!(folder.path().join(format!("run/step-{step:05}.vtp")).is_file());
    }
    assert_eq!(std::fs::read_dir(folder.path().join("run")).unwrap().count(), 3);
    assert!(std::fs::read_to_string(folder.path().join("run.html")).unwrap().contains("Flow on torus.obj"));
    for (scene, said) in [
        (
            "steps = 2\ndt = 0.1\nviscosty = 1\n",
            "line 3: fluid has no option `viscosty`; did you mean `viscosity`?",
        ),
        ("steps = 2\ndt = 0\n", "the time step is 0; it must be finite and above 0"),
        ("steps = 2\ndt = nan\n", "NaN is no finite number"),
        ("steps = 2\ndt = 1e9\nvelocity = \"rotation:z\"\n", "choose a shorter step, or the scheme any-step"),
        (
            "steps = 2\ndt = 0.1\n[[force]]\nat = [9, 9, 9]\nradius = 1\nacceleration = [1, 0, 0]\n",
            "there is no face within",
        ),
        ("steps = 2\ndt = 0.1\n[[density]]\ninitial = \"1/x*0+q\"\n", "unknown variable q"),
    ] {
        std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
        let wrong = folder.run("fluid torus.obj scene.toml --json");
        let stderr = String::from_utf8(wrong.stderr).unwrap();
        assert_eq!(wrong.status.code(), Some(2), "{scene}");
        assert!(stderr.contains(said), "{stderr}");
    }
    let tube = "dt = 0.1\nsteps = 2\nwall = \"free-slip\"\n[[inflow]]\nat = [0, 0, -1]\nradius = 1.01\nspeed = 0.5\n\
                [[outflow]]\nat = [0, 0, 1]\nradius = 1.01\n";
    std::fs::write(folder.path().join("tube.toml"), tube).unwrap();
    folder.ok("generate schwarz-lantern --radius 1 --height 2 --segments 24 --bands 6 -o tube.obj");
    let report = json(&folder, "fluid tube.obj tube.toml --json");
    let last = report["steps"].as_array().unwrap().last().unwrap();
    assert!((last["max_speed"].as_f64().unwrap() / 0.5 - 1.0).abs() < 0.05, "{last}");
    assert!(last["divergence"].as_f64().unwrap() < 1e-12);
    let late = folder.run("fluid torus.obj --velocity rotation:z --steps 3 --dt 0.1 --time-limit 0s");
    assert_eq!(late.status.code(), Some(3));
}

/// A picture of two pixels in the format BMP: black on the left, white on the right.
fn black_and_white() -> Vec<u8> {
    let mut bytes = b"BM".to_vec();
    for word in [62_u32, 0, 54, 40, 2, 1, 0x0018_0001, 0, 8, 0, 0, 0, 0] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend([0, 0, 0, 255, 255, 255, 0, 0]);
    bytes
}

#[test]
fn fluid_goes_on_from_a_checkpoint_bit_for_bit() {
    let folder = Folder::new();
    folder.ok("generate icosphere --subdivisions 2 -o ball.obj");
    std::fs::write(folder.path().join("left.bmp"), black_and_white()).unwrap();
    let scene = "dt = 0.1\n[[density]]\nname = \"dye\"\npicture = \"left.bmp\"\ndiffusivity = 0.01\n\
                 source = [{ picture = \"left.bmp\", axis = \"x\", rate = 1 }]\n";
    std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
    for flow in [
        "ball.obj scene.toml --velocity rotation:z --viscosity 0.1 --scheme crouzeix-raviart --transport faces",
        "ball.obj scene.toml --vorticity z+x*y --scheme faces --correction bfecc",
        "--square 8 scene.toml --viscosity 0.01 --lid 1",
    ] {
        let whole = json(&folder, &format!("fluid {flow} --steps 4 --json"));
        json(&folder, &format!("fluid {flow} --steps 2 --checkpoint half.json --json"));
        let rest = json(&folder, &format!("fluid {flow} --steps 4 --resume half.json --json"));
        assert_eq!(whole["steps"], rest["steps"], "{flow}");
        let mass = whole["steps"][0]["mass"][0].as_f64().unwrap();
        // The black half, of a sphere of area 12.1 and of the square.
        let expected = if flow.starts_with("--square") { 0.5 } else { 6.05 };
        assert!((mass / expected - 1.0).abs() < 0.1, "{flow}: {mass}");
        let other = folder.run(&format!("fluid {flow} --steps 4 --dt 0.2 --resume half.json"));
        let stderr = String::from_utf8(other.stderr).unwrap();
        assert_eq!(other.status.code(), Some(2), "{stderr}");
        assert!(stderr.contains("was written with another `time_step`"), "{stderr}");
    }
    std::fs::write(folder.path().join("half.json"), "{\"version\": 1}").unwrap();
    let broken = folder.run("fluid --square 8 --steps 4 --dt 0.1 --resume half.json");
    assert!(String::from_utf8(broken.stderr).unwrap().contains("half.json: no checkpoint"));
}

#[test]
fn fluid_flows_in_the_square_too() {
    let folder = Folder::new();
    let command = "fluid --square 16 --lid 1 --viscosity 0.01 --steps 5 --dt 0.05 -o lid.pvd --json";
    let report = json(&folder, command);
    assert_eq!(report["scheme"]["name"], "mac");
    let last = report["steps"].as_array().unwrap().last().unwrap();
    assert!(last["energy"].as_f64().unwrap() > 0.0 && last["divergence"].as_f64().unwrap() < 1e-12);
    assert!(folder.path().join("lid/step-00005.vtp").is_file());
    let scene = "steps = 3\ndt = 0.02\ngrid = \"stam:20\"\nedges = \"periodic\"\nvelocity = \"sin(6.28*y); 0\"\n\
                 [[density]]\nname = \"dye\"\ninitial = \"x*y\"\n";
    std::fs::write(folder.path().join("scene.toml"), scene).unwrap();
    let report = json(&folder, "fluid --square 12 scene.toml --video run.html --json");
    assert_eq!(report["scheme"]["name"], "stam");
    assert!(std::fs::read_to_string(folder.path().join("run.html")).unwrap().contains("Flow on square"));
    for (arguments, said) in [
        ("fluid --square 1 --steps 1 --dt 0.1", "expected 2 to 4096"),
        ("fluid --square 8 --steps 1 --dt 0.1 --grid stam --lid 1", "choose the scheme mac"),
        ("fluid --square 8 --steps 1 --dt 0.1 --obstacles nothing.png", "nothing.png"),
        ("fluid --square 8 --steps 1 --dt 0.1 --rotation 0,0,1", "`rotation` is for surfaces"),
        ("fluid --square 8 a.obj b.toml --steps 1 --dt 0.1", "the square has no mesh"),
    ] {
        let wrong = folder.run(arguments);
        let stderr = String::from_utf8(wrong.stderr).unwrap();
        assert!(wrong.status.code() == Some(2) && stderr.contains(said), "{arguments}: {stderr}");
    }
}

#[test]
fn contact_moves_bodies_and_certifies_every_step() {
    let folder = Folder::new();
    folder.write("crash.toml", "kind = 'collision'\ncells = 1\nspeed = 4\n");
    let report = json(
        &folder,
        "contact crash.toml --steps 4 --dt 0.01 -o run.pvd --every 2 --video run.html --report same.html --json",
    );
    assert_eq!(report["certificate"], serde_json::json!({ "steps": 4, "tested": 4, "intersecting": 0 }));
    assert_eq!(report["steps"].as_array().unwrap().len(), 4);
    // The momentum is that of the start.
    let momentum = |value: &Value| value["momentum"][0].as_f64().unwrap();
    let moved = momentum(&report["steps"][3]) - momentum(&report["start"]);
    assert!(moved.abs() < 1e-13 * 1000.0 * 4.0 * 2.0, "{moved}");
    let list = std::fs::read_to_string(folder.path().join("run.pvd")).unwrap();
    assert_eq!(list.matches("<DataSet").count(), 3);
    let step = json(&folder, "info run/step-00004.vtp --intersections --json");
    assert_eq!((&step["vertices"], &step["self_intersections"]["count"]), (&16.into(), &0.into()), "{step}");
    let page = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(page("run.html") == page("same.html") && page("run.html").contains("Newton steps"));

    let last = json(&folder, "contact crash.toml --steps 2 --check last --json");
    assert_eq!(last["certificate"]["tested"], 1);
    let (code, answer, _) = folder.transcript("contact crash.toml --steps 2 --check never");
    assert!(code == Some(0) && answer.contains("not tested after the start"), "{answer}");
    let (code, answer, _) = folder.transcript("contact crash.toml --steps 2 --tolerance 1e-300");
    assert!(code == Some(3) && answer.contains("Newton's method stopped"), "{answer}");
}

#[test]
fn contact_takes_meshes_and_refuses_what_cannot_be_simulated() {
    let folder = Folder::new();
    folder.ok("generate icosphere --subdivisions 1 -o ball.obj");
    folder.write("one.vtk", ONE_TETRAHEDRON);
    folder.write("floor.toml", "[[obstacle]]\nnormal = [0, 0, 1]\n[[body]]\nmove = [0, 0, 1.1]\n");
    let report = json(&folder, "contact floor.toml ball.obj one.vtk --steps 1 --gravity 0,0,0 --json");
    assert_eq!(
        (&report["bodies"], &report["tetrahedra"], &report["vertices"]),
        (&2.into(), &1.into(), &46.into())
    );
    folder.write("two.toml", "[[body]]\n[[body]]\nmove = [0.5, 0, 0]\n");
    folder.write("wrong.toml", "kind = 'drape'\nturns = 2\n");
    folder.write("typo.toml", "kind = 'drape'\nfricton = 2\n");
    folder.write("solid.toml", "[[body]]\nkind = 'solid'\n");
    folder.write("thin.toml", "[[body]]\nkind = 'shell'\n");
    folder.write("held.toml", "[[body]]\n[[handle]]\nlow = [9, 9, 9]\n");
    for (arguments, words) in [
        (
            "contact missing.toml",
            "there is no scene `missing.toml`: expected a file or one of incline, stack",
        ),
        ("contact two.toml ball.obj ball.obj", "of body 1 and face"),
        ("contact two.toml ball.obj", "body 2 has no mesh"),
        ("contact floor.toml", "body 1 has no mesh"),
        ("contact drape ball.obj", "the scene drape has bodies of its own"),
        ("contact wrong.toml", "`turns` is not for a scene of drape"),
        ("contact typo.toml", "did you mean `friction`?"),
        ("contact solid.toml ball.obj", "fill it with tetrahedra first"),
        ("contact thin.toml one.vtk", "name the mesh of its surface"),
        ("contact held.toml ball.obj", "has no vertex in its box"),
        ("contact stack --distance 0", "the distance of contact is 0"),
        ("contact stack -o run.vtu", "give it the suffix .pvd"),
    ] {
        let (code, _, message) = folder.transcript(arguments);
        assert!(code == Some(2) && message.contains(words), "{arguments}: {message}");
    }
}

#[test]
fn contact_takes_meshes_as_obstacles_that_stay_or_move() {
    let folder = Folder::new();
    folder.ok("generate icosphere --subdivisions 1 -o ball.obj");
    let body = "[[body]]\nmove = [0, 0, 2.2]\nmaterial = { thickness = 0.05 }\n";
    let below = "[[obstacle]]\nmesh = 'ball.obj'\n";
    let up = "velocity = [0, 0, 5]\n";
    for (name, scene) in [("stays", format!("{below}{body}")), ("moves", format!("{below}{up}{body}"))] {
        folder.write(&format!("{name}.toml"), &scene);
        let run = format!("contact {name}.toml ball.obj --steps 10 --dt 0.01 --gravity 0,0,0 --json");
        let report = json(&folder, &run);
        assert_eq!((&report["bodies"], &report["vertices"]), (&1.into(), &84.into()));
        assert_eq!(report["certificate"]["intersecting"], 0);
        // Only what is pushed moves, and only upwards.
        let momentum = report["steps"][9]["momentum"][2].as_f64().unwrap();
        assert!(if name == "moves" { momentum > 1.0 } else { momentum == 0.0 }, "{name}: {momentum}");
    }
    let with = |keys: &str| format!("{below}{keys}{body}");
    folder.write("inside.toml", with("move = [0, 0, 1]\n"));
    folder.write("both.toml", with("radius = 1.0\n"));
    folder.write("axis.toml", with("turns = 1.0\n"));
    folder.write("ball.toml", format!("[[obstacle]]\ncentre = [0, 0, 0]\nradius = 1.0\n{up}{body}"));
    folder.write("none.toml", format!("[[obstacle]]\nmesh = 'none.obj'\n{body}"));
    for (scene, words) in [
        ("inside.toml", "of mesh 1 of obstacles"),
        ("both.toml", "needs either `mesh`, or `normal`"),
        ("ball.toml", "needs either `mesh`, or `normal`"),
        ("axis.toml", "`turns` is not for a motion that is not `about` an axis"),
        ("none.toml", "none.obj"),
    ] {
        let (code, _, message) = folder.transcript(&format!("contact {scene} ball.obj"));
        assert!(code == Some(2) && message.contains(words), "{scene}: {message}");
    }
}

#[test]
fn contact_goes_on_from_a_checkpoint_bit_for_bit() {
    let folder = Folder::new();
    folder.write("crash.toml", "kind = 'collision'\ncells = 1\nspeed = 4\n");
    for integrator in ["euler", "bdf2"] {
        let run = format!("contact crash.toml --dt 0.01 --integrator {integrator}");
        let whole = json(&folder, &format!("{run} --steps 4 --json"));
        json(&folder, &format!("{run} --steps 2 --checkpoint half.json --json"));
        let rest = json(&folder, &format!("{run} --steps 4 --resume half.json --json"));
        assert_eq!(whole["steps"], rest["steps"]);
        for (arguments, words) in [
            (format!("{run} --steps 4 --friction 0.1 --resume half.json"), "written with another `friction`"),
            (format!("{run} --steps 1 --resume half.json"), "2 steps are done already and --steps is 1"),
            ("contact stack --resume half.json".to_owned(), "is of other bodies"),
            ("contact stack --resume crash.toml".to_owned(), "no checkpoint"),
        ] {
            let (code, _, message) = folder.transcript(&arguments);
            assert!(code == Some(2) && message.contains(words), "{arguments}: {message}");
        }
    }
}

const ONE_TETRAHEDRON: &str = "# vtk DataFile Version 3.0
one
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 4 double
0 0 5  1 0 5  0 1 5  0 0 6
CELLS 2 9
4 0 2 1 3
3 0 1 2
CELL_TYPES 2
10 5
";

#[test]
fn a_skeleton_without_samples_is_told_so() {
    let folder = Folder::new();
    folder.write("empty.swc", "");
    folder.write("comment.swc", "# nothing\n");
    for name in ["empty.swc", "comment.swc"] {
        for stage in ["check", "mesh", "flow"] {
            let (code, _, stderr) = folder.transcript(&format!("neuron {stage} {name} --json"));
            assert_eq!(code, Some(2), "{stderr}");
            assert!(stderr.contains(&format!("{name}: there is no sample in the file")), "{stderr}");
        }
    }
}

#[test]
fn cells_of_a_neuron_that_are_not_proven_are_named() {
    let folder = Folder::new();
    // A branch that turns at every sample, shorter between them than it is wide.
    let text = "1 2 0.00 0.00 0.00 1.29 -1\n2 2 1.67 -0.11 0.65 0.70 1\n3 2 2.61 -1.37 0.61 1.48 2\n4 2 2.36 -2.71 -0.81 1.32 3\n5 2 2.02 -2.79 -1.78 0.92 4\n6 2 0.89 -2.83 -2.81 1.28 5\n7 2 0.04 -2.52 -3.81 1.39 6\n8 2 -0.62 -2.02 -4.37 1.07 7\n9 2 -1.99 -3.33 -4.97 2.39 8\n10 2 -2.47 -3.77 -5.55 2.48 9\n11 2 -3.07 -3.83 -5.96 1.00 10\n12 2 -3.32 -3.75 -7.20 1.82 11\n";
    folder.write("bend.swc", text);
    let mesh = &json(&folder, "neuron mesh bend.swc --json")["mesh"];
    let unproven = mesh["unproven"].as_array().unwrap();
    assert_eq!(mesh["certified"], false);
    assert!(unproven[0]["scaled_jacobian"].as_f64().unwrap() <= 0.0);
    assert_eq!(
        keys(&unproven[0]),
        sorted(&["cell", "scaled_jacobian", "folded", "centre", "sample", "line"])
    );
    let folded = unproven.iter().filter(|cell| cell["folded"] == true).count();
    assert!(folded > 0);
    let answer = folder.run("neuron mesh bend.swc -o bend.vtu --within 50");
    assert_eq!(answer.status.code(), Some(1));
    let answer = String::from_utf8(answer.stdout).unwrap();
    let row = answer.lines().find(|line| line.starts_with("unproven")).unwrap();
    let (line, cell) = (&unproven[0]["line"], &unproven[0]["cell"]);
    assert!(row.contains(&format!("line {line}: cell {cell} at (")) && row.contains("is folded"), "{row}");
    let result = answer.lines().next().unwrap();
    assert!(result.contains(&format!("{folded} cells are folded")), "{result}");
    // Nothing flows through folded cells.
    let flow = folder.run("neuron flow bend.swc --within 50 --json");
    assert_eq!(flow.status.code(), Some(1));
    let flow: Value = serde_json::from_slice(&flow.stdout).unwrap();
    let report = &flow["report"];
    assert!(report["ended"].as_str().unwrap().contains("folded, the worst near sample"), "{report}");
    assert!(report.get("flow").is_none());
}
