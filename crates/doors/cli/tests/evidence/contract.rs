//! What holds of every command: the limits that it offers act, an early end is exit code 3 and a `stop` in its answer, options from a
//! file give the answer of those on the command line.

use crate::common::{Folder, without_times};
use serde_json::Value;
use std::collections::BTreeMap;

/// Commands that compute nothing that could be asked for in another way.
const NO_ANSWER: [&str; 6] = ["app", "completions", "convert", "generate", "help", "man"];

/// A call of each system, with options and the same as a file.
const CALLS: [(&str, &str, &str, &str); 21] = [
    (
        "align",
        "dense.obj turned.obj",
        "--overlap 0.9 --no-measure",
        "overlap = 0.9
measure = false
",
    ),
    (
        "distance",
        "dense.obj turned.obj",
        "--direction b-to-a --tolerance 1e-3 --tolerance-kind relative --trace",
        "direction = \"b-to-a\"
tolerance = 1e-3
tolerance_kind = \"relative\"
trace = true
",
    ),
    (
        "rank",
        "dense.obj turned.obj dense.obj",
        "--top 1 --direction to-template --align centroid --tolerance 1e-3",
        "top = 1\ndirection = \"to-template\"\nalign = \"centroid\"\ntolerance = 1e-3\n",
    ),
    (
        "matrix",
        "dense.obj turned.obj",
        "--directed --tolerance 0.1 --tolerance-kind absolute",
        "directed = true\ntolerance = 0.1\ntolerance_kind = \"absolute\"\n",
    ),
    (
        "complexity",
        "shapes",
        "--rank-by boundary-25 --features convexity --clusters 2 --staircase",
        "rank_by = \"boundary-25\"\nfeatures = [\"convexity\"]\nclusters = 2\nstaircase = true\n",
    ),
    (
        "couple",
        "tube.toml",
        "--windows 3 --scheme two-models --extrapolate 1",
        "windows = 3\nscheme = \"two-models\"\nextrapolate = 1\n",
    ),
    (
        "contact",
        "crash.toml",
        "--steps 2 --dt 0.02 --pairs plain --check last --gravity 0,0,-1",
        "steps = 2\ndt = 0.02\npairs = \"plain\"\ncheck = \"last\"\ngravity = [0, 0, -1]\n",
    ),
    (
        "neuron",
        "transport rod.swc",
        "--parts 1 --layer 3 --within 0.3 --set-transport steps=5,order=2",
        "parts = 1\nlayer = 3\nwithin = 0.3\n[transport]\nsteps = 5\norder = 2\n",
    ),
    (
        "fluid",
        "dense.obj --steps 2 --dt 0.01",
        "--vorticity z --viscosity 0.1 --wall free-slip --density x^2",
        "vorticity = \"z\"\nviscosity = 0.1\nwall = \"free-slip\"\n[[density]]\ninitial = \"x^2\"\n",
    ),
    (
        "puzzle",
        "--outline shapes/b.svg",
        "-n 9 --layout voronoi --tab dovetail --size 80,80",
        "pieces = 9\nlayout = \"voronoi\"\ntab = \"dovetail\"\nsize = [80, 80]\n",
    ),
    (
        "deviation",
        "dense.obj turned.obj",
        "--band -1000um..2mm --unit mm --allow 5% --accuracy 0.1 --percentiles 50,99 --ignore-beyond 0.9mm --box -9,-9,-9,9,9,9",
        "bands = [[\"-1000um\", \"2mm\"]]
unit = \"mm\"
allow = 0.05
accuracy = 0.1
percentiles = [50, 99]
ignore_beyond = \"0.9mm\"
box = [-9, -9, -9, 9, 9, 9]
",
    ),
    (
        "flow",
        "dense.obj -o flowed.obj --until steps:2",
        "--scheme conformalized --time-step 0.001 --no-keep-angles",
        "scheme = \"conformalized\"\ntime_step = 0.001\nkeep_angles = false\n",
    ),
    ("info", "dense.obj", "--intersections", "intersections = true\n"),
    (
        "remesh",
        "dense.obj -o even.stl --relative 0.1",
        "--features 60 --iterations 3 --intersections refuse --center",
        "features = 60\niterations = 3\nintersections = \"refuse\"\ncenter = true\n",
    ),
    (
        "simplify",
        "dense.obj -o few.stl --faces 300",
        "--effort fast --levels 2 --intersections ignore --precision single",
        "effort = \"fast\"\nlevels = 2\nintersections = \"ignore\"\nprecision = \"single\"\n",
    ),
    (
        "repair",
        "dense.obj mended.obj",
        "--weld 0.001 --fill-holes 5 --within 0.1",
        "weld = 0.001
fill_holes = 5
within = 0.1
",
    ),
    ("verify", "proof.phc dense.obj turned.obj", "", "# there are no options\n"),
    (
        "cut",
        "dense.obj",
        "--strategy tips --avoid-curvature 0.5",
        "strategy = \"tips\"\navoid_curvature = 0.5\n",
    ),
    (
        "decompose",
        "dense.obj",
        "--field gradient:x*y --splitting dual --boundary normal",
        "field = \"gradient:x*y\"\nsplitting = \"dual\"\nboundary = \"normal\"\n",
    ),
    (
        "flatten",
        "dense.obj",
        "--strategy genus --boundary circle --virtual-layers 1 --no-pack",
        "strategy = \"genus\"\nboundary = \"circle\"\nvirtual_layers = 1\npack = false\n",
    ),
    (
        "medial",
        "dense.obj",
        "--balls 4 --samples 40 --tolerance 0.01",
        "balls = 4\nsamples = 40\ntolerance = 0.01\n",
    ),
];

fn folder() -> Folder {
    let folder = Folder::new();
    folder.ok("generate torus --major-segments 48 --minor-segments 32 -o dense.obj");
    std::fs::create_dir(folder.path().join("shapes")).unwrap();
    folder.write("tube.toml", "kind = 'tube'\nwindows = 4\n[tube]\nsegments = 20\n");
    folder.write("crash.toml", "kind = 'collision'\ncells = 1\n");
    folder.write("rod.swc", "1 2 0 0 0 1 -1\n2 2 12 0 0 1 1\n");
    folder.ok("generate polyline --order angle --points 9 -o shapes/a.svg");
    folder.ok("generate noisy-circle --radius 8 -o shapes/b.svg");
    folder.ok("generate torus --major-segments 40 --minor-segments 24 --rotate 1,0,0,30 -o turned.obj");
    folder.ok("distance dense.obj turned.obj --certificate proof.phc");
    folder
}

/// The commands of the program, with their help.
fn commands(folder: &Folder) -> BTreeMap<String, String> {
    let names = folder.commands().into_iter();
    names.map(|name| (name.clone(), folder.ok(&format!("help {name}")))).collect()
}

fn answer(folder: &Folder, args: &str) -> (Option<i32>, Value) {
    let output = folder.run(&format!("{args} --json"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    (output.status.code(), serde_json::from_str(&text).unwrap_or_else(|_| panic!("{args}: {message}")))
}

#[test]
fn every_command_is_a_system_or_computes_nothing() {
    let folder = folder();
    let mut known: Vec<&str> = CALLS.iter().map(|call| call.0).chain(NO_ANSWER).collect();
    known.sort_unstable();
    let commands = commands(&folder);
    assert_eq!(commands.keys().map(String::as_str).collect::<Vec<_>>(), known);
    for (name, help) in &commands {
        let is_system = CALLS.iter().any(|call| call.0 == name);
        assert_eq!(help.contains("Take options from this TOML file"), is_system, "{name}");
    }
}

#[test]
fn limits_that_are_offered_act() {
    let folder = folder();
    let commands = commands(&folder);
    for (name, files, ..) in CALLS {
        for (limit, value, stop) in [("--time-limit", "0s", "time"), ("--memory-limit", "1KiB", "memory")] {
            let is_offered = commands[name].contains(&format!("{limit} <"));
            let called = format!("{name} {files} {limit} {value}");
            if is_offered {
                let (code, answer) = answer(&folder, &called);
                assert_eq!((code, &answer["stop"]), (Some(3), &Value::from(stop)), "{called}");
            } else {
                assert_eq!(folder.run(&called).status.code(), Some(2), "{called}");
            }
        }
    }
}

#[test]
fn options_of_a_file_are_those_of_the_command_line() {
    let folder = folder();
    for (name, files, options, config) in CALLS {
        folder.write("options.toml", config);
        let (code, by_line) = answer(&folder, &format!("{name} {files} {options}"));
        let (code_by_file, by_file) = answer(&folder, &format!("{name} {files} --config options.toml"));
        assert_eq!((code, without_times(by_line.clone())), (code_by_file, without_times(by_file)), "{name}");
        assert!(matches!(code, Some(0 | 3)), "{name}");
        let sum = by_line["inputs"][0]["sha256"].as_str().unwrap();
        assert!(sum.len() == 64 && by_line["command"] == name, "{name}");
    }
    // The command line comes before the file, the file before defaults.
    folder.write("options.toml", "balls = 4\nsamples = 40\n");
    let (_, both) = answer(&folder, "medial dense.obj --config options.toml --balls 3");
    let request = &both["request"];
    assert_eq!(
        (&request["balls"], &request["samples"], &request["tolerance"]),
        (&3.into(), &40.into(), &0.001.into())
    );
}

#[test]
fn files_of_options_that_cannot_be_used() {
    let folder = folder();
    for (config, message) in [
        ("bals = 4\n", "medial has no option `bals`; did you mean `balls`?"),
        ("balls = 0\n", "option `balls` of medial"),
        ("tolerance = inf\n", "inf is no finite number"),
        ("balls = \n", "options.toml: TOML parse error at line 1"),
        ("[medial]\nballs = 4\n", "medial has no option `medial`"),
    ] {
        folder.write("options.toml", config);
        let (code, stdout, stderr) = folder.transcript("medial dense.obj --config options.toml --json");
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{config}");
        assert!(stderr.contains("options.toml") && stderr.contains(message), "{config}: {stderr}");
    }
    assert_eq!(folder.run("medial dense.obj --config missing.toml --json").status.code(), Some(2));
}
