//! What the command says, word by word. Times, bounds and witness points are replaced by their names.

use crate::common::Folder;
use insta_cmd::assert_cmd_snapshot;

/// Compares exit code, stdout and stderr with the snapshot of this name.
fn check(folder: &Folder, name: &str, args: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_omit_expression(true);
    for (pattern, replacement) in [
        (r"\d+(\.\d+)? (µs|ms|s)\b", "[time]"),
        (r"between [0-9.e-]+ and [0-9.e-]+ \(gap [0-9.e-]+\)", "between [lower] and [upper] (gap [gap])"),
        (r"at most [0-9.]+e-\d+", "at most [rounding]"),
        (r"at \([^)]*\) on face \d+", "at [point] on face [face]"),
        (r"(at most )?\d\.\de-?\d+ of the", "[rounding] of the"),
        (r"\d(\.\d+)?e-\d+ \(0\.000 %", "[rounding] (0.000 %"),
        (r"pompeiu \d+\.\d+\.\d+", "pompeiu [version]"),
        (r#""timing_ms":\{[^}]*\}"#, r#""timing_ms":[times]"#),
        (r#""version":"[^"]*""#, r#""version":"[version]""#),
    ] {
        settings.add_filter(pattern, replacement);
    }
    settings.bind(|| assert_cmd_snapshot!(name, folder.pompeiu(args)));
}

#[test]
fn help_shows_examples() {
    let folder = Folder::new();
    check(&folder, "help", "--help");
    check(&folder, "help_short", "-h");
    for command in ["info", "decompose", "convert", "generate", "completions", "man"] {
        check(&folder, &format!("help_{command}"), &format!("{command} --help"));
    }
    check(&folder, "help_torus", "generate torus --help");
    check(&folder, "version", "--version");
}

#[test]
fn no_line_of_help_is_wider_than_80_columns() {
    let folder = Folder::new();
    let help = |arguments: &str| {
        let found = folder.pompeiu(arguments).env("COLUMNS", "80").output().unwrap();
        String::from_utf8(found.stdout).unwrap()
    };
    let commands = folder.commands();
    assert!(commands.len() > 15, "{commands:?}");
    for command in [""].into_iter().chain(commands.iter().map(String::as_str)) {
        for line in help(&format!("{command} --help")).lines() {
            // A list of names is one word, which nothing wraps.
            let is_one_word = !line.trim().contains(' ');
            assert!(is_one_word || line.chars().count() <= 80, "{command}: {line}");
        }
    }
}

#[test]
fn wrong_arguments() {
    let folder = Folder::with_tent();
    for (name, args) in [
        ("no_command", ""),
        ("unknown_option", "info tent.obj --jsn"),
        ("missing_file_argument", "distance tent.obj"),
        ("negative_tolerance", "distance tent.obj square.obj --tolerance -1"),
        ("negative_radius", "generate icosphere --radius -1 -o a.obj"),
        ("nan_threshold", "distance tent.obj square.obj --within nan"),
        ("time_without_unit", "distance tent.obj square.obj --time-limit 10"),
        ("memory_without_sense", "distance tent.obj square.obj --memory-limit much"),
        ("no_threads", "distance tent.obj square.obj --threads 0"),
        ("unknown_shape", "generate sphere -o a.obj"),
        ("two_numbers_for_three", "generate box --size 1,2 -o a.obj"),
        ("no_output", "generate torus"),
    ] {
        check(&folder, &format!("arguments_{name}"), args);
    }
}

#[test]
fn files_that_cannot_be_used() {
    let folder = Folder::with_tent();
    folder.write("empty.obj", "");
    folder.write("letter.txt", "Dear mesh,\n");
    folder.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    folder.write("nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
    folder.write("points.obj", "v 0 0 0\nv 1 0 0\n");
    folder.write("flat\nname.obj", "");
    std::fs::create_dir(folder.path().join("folder")).unwrap();
    for (name, args) in [
        ("missing", "distance tent.obj missing.obj"),
        ("folder", "distance folder tent.obj"),
        ("empty", "info empty.obj"),
        ("unrecognised", "info letter.txt"),
        ("index", "distance index.obj tent.obj"),
        ("nan", "info nan.obj"),
        ("no_faces", "convert points.obj a.ply"),
        ("convert_same", "convert tent.obj tent.obj"),
        ("convert_unknown", "convert tent.obj tent.xyz"),
        ("convert_into_folder", "convert tent.obj folder"),
        ("convert_into_nowhere", "convert tent.obj nowhere/tent.obj"),
    ] {
        check(&folder, &format!("files_{name}"), args);
    }
    // The name of a file cannot break the line.
    let output = folder.pompeiu("info").arg("flat\nname.obj").output().unwrap();
    assert_eq!(String::from_utf8_lossy(&output.stderr).lines().count(), 1);
}

#[test]
fn distance_for_people() {
    let folder = Folder::with_tent();
    check(&folder, "distance", "distance tent.obj square.obj");
    check(&folder, "distance_swapped", "distance square.obj tent.obj");
    check(&folder, "distance_a_to_b", "distance tent.obj square.obj --direction a-to-b");
    check(&folder, "distance_b_to_a", "distance tent.obj square.obj --direction b-to-a");
    check(&folder, "distance_rounding", "distance tent.obj square.obj --tolerance 0 --direction a-to-b");
    check(
        &folder,
        "distance_rounding_quiet",
        "distance tent.obj square.obj --tolerance 0 -q --direction a-to-b",
    );
}

/// Points above a square: how far they are is proven, and the way back is not offered.
#[test]
fn clouds_of_points_are_measured_from_their_points() {
    let folder = Folder::with_tent();
    folder.write("cloud.xyz", "# x y z\n0 0 0.125\n0.5,0.5,-0.25\n1 0 0 17\n");
    check(&folder, "cloud", "distance square.obj cloud.xyz");
    check(&folder, "cloud_asserted", "distance cloud.xyz square.obj --direction a-to-b --within 0.26");
    check(&folder, "cloud_way_back", "distance square.obj cloud.xyz --direction a-to-b");
    check(&folder, "cloud_align", "distance square.obj cloud.xyz --align rigid");
    check(&folder, "cloud_deviation", "deviation square.obj cloud.xyz");
    folder.write("part.step", "ISO-10303-21;\nHEADER;\n");
    check(&folder, "step", "distance square.obj part.step");
}

#[test]
fn distance_warns() {
    let folder = Folder::with_tent();
    folder.ok("generate grid --size 50.8,50.8 -o inches.obj");
    folder.write("quads.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 9 9 9\nf 1 2 3 4\nl 1 2\nf 1 2\n");
    check(&folder, "warning_unit", "distance inches.obj square.obj");
    check(&folder, "warning_unit_quiet", "distance inches.obj square.obj --quiet");
    check(&folder, "warning_same", "distance tent.obj ./tent.obj");
    check(&folder, "warning_oddities", "distance quads.obj square.obj");
    check(&folder, "warning_info", "info quads.obj");
}

#[test]
fn info_for_people_and_programs() {
    let folder = Folder::with_tent();
    folder.ok("generate torus --major-segments 8 --minor-segments 6 -o torus.obj");
    folder.ok("generate mobius-strip --segments 8 --strips 1 -o mobius.ply.gz");
    folder.ok("generate point-lattice --cells 2 -o points.obj");
    folder.write(
        "odd.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 7 7 7\nf 1 2 3\nf 1 2 3\nf 2 1 4\nf 1 1 3\n",
    );
    for shape in ["torus.obj", "tent.obj", "points.obj", "odd.obj"] {
        check(&folder, &format!("info_{}", &shape[..shape.len() - 4]), &format!("info {shape}"));
    }
    folder.ok("generate cube --side 1e160 -o huge.obj");
    check(&folder, "info_huge", "info huge.obj");
    check(&folder, "info_json", "info torus.obj --json");
    check(&folder, "info_json_open", "info tent.obj --json");
}

#[test]
fn generate_and_convert() {
    let folder = Folder::with_tent();
    check(&folder, "generate", "generate icosphere --subdivisions 1 -o sphere.obj");
    check(&folder, "generate_quiet", "generate icosphere --subdivisions 1 -o sphere.obj --quiet");
    check(&folder, "generate_size", "generate icosphere --radius -1 -o sphere.obj");
    check(&folder, "generate_counts", "generate torus --minor-segments 2 -o torus.obj");
    check(&folder, "generate_too_many", "generate cube --cells 100000 -o cube.obj");
    check(&folder, "generate_axis", "generate cube --rotate 0,0,0,90 -o cube.obj");
    check(&folder, "generate_ripple", "generate cube --ripple 0.1,0 -o cube.obj");
    check(&folder, "generate_mesh", "generate mesh sphere.obj --subdivide 1 --ripple 0.1,1 -o fine.obj");
    check(&folder, "generate_mesh_same", "generate mesh sphere.obj --subdivide 1 -o sphere.obj");
    check(&folder, "generate_mesh_missing", "generate mesh nothing.obj -o fine.obj");
    check(&folder, "convert", "convert sphere.obj sphere.ply.gz");
    check(&folder, "convert_single_precision", "convert sphere.obj sphere.stl");
    assert!(!folder.path().join("torus.obj").exists());
}

#[test]
fn decompose_for_people() {
    let folder = Folder::new();
    folder.ok("generate torus --major-segments 24 --minor-segments 16 -o torus.obj");
    folder.ok("generate cylinder --segments 12 --rows 4 -o tube.obj");
    folder.ok("generate perforated-plate --holes 2 -o plate.obj");
    check(&folder, "decompose_freedom", "decompose torus.obj");
    check(&folder, "decompose_rotation", "decompose torus.obj --field rotation:z -o parts.vtp");
    check(&folder, "decompose_dual", "decompose torus.obj --field random:3 --splitting dual");
    check(&folder, "decompose_gradient", "decompose tube.obj --field gradient:sin(x)*y^2 --boundary normal");
    check(&folder, "decompose_harmonic", "decompose plate.obj --field harmonic:3 -q");
}

#[test]
fn decompose_refuses() {
    let folder = Folder::with_tent();
    folder.ok("generate mobius-strip --segments 8 --strips 1 -o mobius.obj");
    folder.write("three.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 2 1 4\nf 1 2 5\n");
    folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 4\nf 2 1 3\n");
    folder.write("short.csv", "1,0,0\n");
    let nan = "0 0 1\n".repeat(3) + "0 nan 1\n";
    folder.write("nan.csv", nan);
    folder.write("normal.csv", "0 0 1\n".repeat(4));
    folder.write("loose.obj", "v 0 0 0\nv 9 9 9\nv 1 0 0\nv 0 1 0\nf 1 3 4\n");
    for (name, args) in [
        ("non_orientable", "decompose mobius.obj"),
        ("non_manifold", "decompose three.obj"),
        ("degenerate", "decompose flat.obj"),
        ("short_field", "decompose tent.obj --field short.csv"),
        ("nan_field", "decompose tent.obj --field nan.csv"),
        ("no_file", "decompose tent.obj --field missing.csv"),
        ("axis", "decompose tent.obj --field rotation:w"),
        ("variable", "decompose tent.obj --field gradient:w*x"),
        ("pole", "decompose square.obj --field gradient:1/(x-1)"),
        ("syntax", "decompose tent.obj --field gradient:x+*"),
        ("no_harmonic", "decompose tent.obj --field harmonic:0"),
        ("output", "decompose tent.obj --field rotation:z -o parts.obj"),
        ("normal", "decompose tent.obj --field normal.csv"),
        ("loose", "decompose loose.obj"),
    ] {
        check(&folder, &format!("decompose_{name}"), args);
    }
}
