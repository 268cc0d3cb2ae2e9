//! `pompeiu rank` and `pompeiu matrix`: what they say, what they find, and that they can be interrupted.

use crate::common::{Folder, without_times};
use insta_cmd::assert_cmd_snapshot;
use pompeiu_testkit::data;
use serde_json::Value;

/// Spheres of radii 1, 1.1, ..., two of them the same, in the folder `library`.
fn library() -> Folder {
    let folder = Folder::new();
    std::fs::create_dir_all(folder.path().join("library/more")).unwrap();
    folder.ok("generate icosphere --subdivisions 2 -o template.obj");
    for (name, radius) in [("a", "1.5"), ("b", "1.125"), ("c", "1.25"), ("d", "1.25"), ("e", "4"), ("f", "9")]
    {
        folder.ok(&format!("generate icosphere --subdivisions 2 --radius {radius} -o library/{name}.ply"));
    }
    folder.ok("generate icosphere --subdivisions 2 --radius 1.0625 -o library/more/g.ply");
    folder
}

fn check(folder: &Folder, name: &str, args: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_omit_expression(true);
    settings.add_filter(r"total \d+(\.\d+)? (µs|ms|s)\b", "total [time]");
    settings.add_filter(r"\d+(,\d+)* distances", "[count] distances");
    // What is zero but for rounding.
    settings.add_filter(r"(at most )?\d\.\d+e-1[4-9]( to \d\.\d+e-1[4-9])? +", "[rounding]  ");
    settings.bind(|| assert_cmd_snapshot!(name, folder.pompeiu(args)));
}

#[test]
fn transcripts() {
    let folder = library();
    check(&folder, "rank_help", "rank --help");
    check(&folder, "matrix_help", "matrix --help");
    check(&folder, "rank", "rank template.obj library --top 2 --tolerance 1e-6");
    check(&folder, "rank_recursive", "rank template.obj library --recursive --top 1 --tolerance 1e-6");
    check(&folder, "rank_all", "rank template.obj library/*.ply --all --tolerance 1e-6");
    check(&folder, "rank_centroid", "rank template.obj library --align scale --top 1 --tolerance 1e-2");
    check(&folder, "matrix", "matrix template.obj library/a.ply library/b.ply --tolerance 0.5");
}

#[test]
fn hostile_inputs() {
    let folder = library();
    folder.write("empty.obj", "");
    folder.write("garbage.ply", "ply\nformat ascii 1.0\nelement vertex 99\nx");
    folder.write("points.obj", "v 0 0 0\nv 1 0 0\n");
    folder.write("segment.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\n");
    std::fs::create_dir(folder.path().join("nothing")).unwrap();
    let bad = "empty.obj garbage.ply points.obj missing.obj nothing *.vtp a[";
    check(&folder, "rank_bad_targets", &format!("rank template.obj {bad} library/b.ply --tolerance 1e-6"));
    check(&folder, "rank_only_bad_targets", "rank template.obj nothing missing/*.obj");
    check(&folder, "rank_bad_template", "rank garbage.ply library");
    check(&folder, "rank_no_template", "rank missing.obj library");
    check(&folder, "rank_flat_template", "rank segment.obj library --align rigid");
    check(&folder, "rank_no_places", "rank template.obj library --top 0");
    check(&folder, "rank_other_journal", "rank template.obj library --resume points.obj");
    check(&folder, "rank_table_over_target", "rank template.obj library --csv library/a.ply");
    check(&folder, "rank_table_over_journal", "rank template.obj library --csv new.csv --resume new.csv");
    check(&folder, "matrix_journal_over_mesh", "matrix template.obj library/a.ply --resume library/a.ply");
    check(&folder, "rank_table_in_no_folder", "rank template.obj library --csv nowhere/table.csv");
    check(&folder, "matrix_bad_files", "matrix garbage.ply library/b.ply missing.obj --tolerance 0.5");
    check(&folder, "matrix_of_nothing", "matrix nothing");
    assert_eq!(std::fs::read_to_string(folder.path().join("points.obj")).unwrap(), "v 0 0 0\nv 1 0 0\n");
}

/// A template and twelve noisy copies of it.
fn noisy() -> Folder {
    let folder = Folder::new();
    folder.ok("generate icosphere --subdivisions 4 -o template.obj");
    for seed in 0..12 {
        folder.ok(&format!(
            "generate mesh template.obj --noise 0.0{} --seed {seed} -o t{seed:02}.ply",
            10 + seed
        ));
    }
    folder
}

/// Lines of a file, 0 while it is not there.
fn lines(folder: &Folder, name: &str) -> usize {
    std::fs::read(folder.path().join(name)).map_or(0, |text| text.split(|b| *b == b'\n').count())
}

/// The JSON without times.
fn json(folder: &Folder, args: &str) -> Value {
    let output = folder.run(args);
    without_times(serde_json::from_slice(&output.stdout).unwrap())
}

/// The report alone: inputs name every file that was read.
fn report(folder: &Folder, args: &str) -> Value {
    json(folder, args)["report"].clone()
}

#[test]
fn ties_are_told_and_tables_agree() {
    let folder = library();
    let report = report(&folder, "rank template.obj library --top 2 --csv table.csv --json --align centroid");
    let targets = report["targets"].as_array().unwrap();
    let of = |key: &str| targets.iter().map(|target| target[key].clone()).collect::<Vec<_>>();
    let names = [
        "library/b.ply",
        "library/c.ply",
        "library/d.ply",
        "library/a.ply",
        "library/e.ply",
        "library/f.ply",
    ];
    assert_eq!(of("path"), names);
    assert_eq!(of("rank_first")[..4], [1, 2, 2, 4]);
    assert_eq!(of("rank_last")[..4], [1, 3, 3, 4]);
    assert_eq!(of("status")[2..4], ["ranked", "discarded"]);
    assert_eq!(targets[0]["transform"][3], serde_json::json!([0.0, 0.0, 0.0, 1.0]));
    let table = std::fs::read_to_string(folder.path().join("table.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    assert!(rows.len() == 7 && rows.iter().all(|row| row.len() == 22));
    for (row, target) in rows[1..].iter().zip(targets) {
        assert_eq!(row[0], target["path"]);
        assert_eq!(row[4].parse::<f64>().unwrap(), target["lower"].as_f64().unwrap());
        assert_eq!(row[21].parse::<f64>().unwrap(), target["transform"][2][3].as_f64().unwrap());
    }
}

#[test]
fn the_order_of_files_and_the_number_of_threads_do_not_matter() {
    let folder = library();
    // Places of targets are those of the arguments.
    let placeless = |args: &str| {
        let mut found = report(&folder, args);
        for target in found["targets"].as_array_mut().unwrap() {
            target.as_object_mut().unwrap().remove("target");
        }
        found
    };
    let one = placeless(
        "rank template.obj library/a.ply library/b.ply library/c.ply library/d.ply --top 2 --json --threads 1",
    );
    let other = "rank template.obj library/d.ply library/a.ply library/c.ply library/b.ply --top 2 --json --threads 8";
    assert_eq!(one, placeless(other));
    assert_eq!(one, placeless(&format!("{other} --cache 0B")));
}

/// Kills a run half way, as often as a journal has lines: cuts it off inside of every line.
#[test]
fn interrupted_runs_go_on_where_they_were_with_the_same_bits() {
    let folder = library();
    for args in [
        "rank template.obj library --top 2 --json --align rigid --tolerance 1e-6",
        "matrix library template.obj --json --tolerance 1e-6",
    ] {
        let expected = report(&folder, args);
        let resumed = format!("{args} --resume journal");
        assert_eq!(report(&folder, &resumed), expected);
        let path = folder.path().join("journal");
        let whole = std::fs::read(&path).unwrap();
        let ends: Vec<usize> = (0..whole.len()).filter(|&at| whole[at] == b'\n').collect();
        assert!(ends.len() > 12);
        for end in ends.iter().step_by(5) {
            for torn in [end + 1, (end + 40).min(whole.len())] {
                std::fs::write(&path, &whole[..torn]).unwrap();
                assert_eq!(report(&folder, &resumed), expected);
            }
        }
        // All is known now: nothing is added, and a file that has changed is measured anew.
        let length = std::fs::metadata(&path).unwrap().len();
        assert_eq!(report(&folder, &resumed), expected);
        assert_eq!(std::fs::metadata(&path).unwrap().len(), length);
        folder.ok("generate icosphere --subdivisions 2 --radius 1.03125 -o library/f.ply");
        let changed = report(&folder, args);
        assert_ne!(changed, expected);
        assert_eq!(report(&folder, &resumed), changed);
        folder.ok("generate icosphere --subdivisions 2 --radius 9 -o library/f.ply");
        std::fs::remove_file(&path).unwrap();
    }
}

#[test]
fn files_that_a_mesh_refers_to_are_part_of_it() {
    let folder = Folder::new();
    folder.ok("generate icosphere --subdivisions 1 -o template.obj");
    let buffer = |height: f32| -> Vec<u8> {
        [[0.0, 0.0, height], [1.0, 0.0, height], [0.0, 1.0, height]]
            .as_flattened()
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect()
    };
    folder.write(
        "mesh.gltf",
        r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"uri":"my%20mesh.bin","byteLength":36}]}"#,
    );
    for args in ["rank template.obj mesh.gltf --json", "matrix template.obj mesh.gltf --json"] {
        let mut before = Value::Null;
        for height in [2.0, 3.0] {
            folder.write("my mesh.bin", buffer(height));
            let found = report(&folder, &format!("{args} --resume journal"));
            assert_eq!(found, report(&folder, args), "at {height}");
            assert_ne!(found, before);
            before = found;
        }
        std::fs::remove_file(folder.path().join("journal")).unwrap();
    }
}

#[test]
fn only_files_that_cannot_be_read_end_in_exit_code_2() {
    let folder = library();
    folder.write("garbage.ply", "ply\nformat ascii 1.0\nelement vertex 99\nx");
    for args in [
        "rank template.obj garbage.ply missing.obj",
        "rank template.obj garbage.ply --json --all",
        "matrix garbage.ply missing.obj",
    ] {
        assert_eq!(folder.run(args).status.code(), Some(2), "{args}");
    }
    let mixed = "rank template.obj garbage.ply library/b.ply missing.obj --json";
    assert_eq!(folder.run(mixed).status.code(), Some(3));
    let answer = json(&folder, mixed);
    let read: Vec<&Value> = answer["inputs"].as_array().unwrap().iter().map(|one| &one["path"]).collect();
    assert_eq!(read, ["template.obj", "library/b.ply"]);
}

#[cfg(unix)]
#[test]
fn a_pipe_without_a_writer_is_refused() {
    let folder = library();
    let made = std::process::Command::new("mkfifo").arg(folder.path().join("pipe")).status();
    assert!(made.unwrap().success());
    for args in ["info pipe", "distance template.obj pipe", "convert pipe out.obj"] {
        let (code, stdout, stderr) = folder.transcript(args);
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{args}");
        assert!(stderr.contains("pipe: a pipe into which nobody writes"), "{args}: {stderr}");
    }
    let mut reader = folder.pompeiu("info pipe --json").stdout(std::process::Stdio::piped()).spawn().unwrap();
    std::fs::write(folder.path().join("pipe"), std::fs::read(folder.path().join("template.obj")).unwrap())
        .unwrap();
    assert!(reader.wait().unwrap().success());
}

#[test]
fn a_run_that_is_killed_can_be_resumed() {
    let folder = noisy();
    let args = "rank template.obj t*.ply --all --json";
    let expected = report(&folder, args);
    let resumed = format!("{args} --resume journal");
    let mut child = folder.pompeiu(&resumed).stdout(std::process::Stdio::null()).spawn().unwrap();
    // As soon as a few results are there; should it be done by then, resuming has only less to do.
    let lines = || lines(&folder, "journal");
    while lines() < 6 && child.try_wait().unwrap().is_none() {
        std::thread::yield_now();
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(lines() >= 6);
    assert_eq!(report(&folder, &resumed), expected);
}

#[test]
fn limits_end_a_run_with_what_is_proven_and_leave_nothing_half_done_in_the_journal() {
    let folder = library();
    for (args, open) in [
        ("rank template.obj library --top 2 --json --tolerance 1e-6", 6),
        ("matrix template.obj library/a.ply library/b.ply --json --tolerance 1e-6", 6),
    ] {
        let expected = report(&folder, args);
        assert_eq!(expected["stop"], "tolerance");
        for (limit, stop) in [("--time-limit 0s", "time"), ("--memory-limit 1B", "memory")] {
            let limited = format!("{args} {limit} --resume journal");
            assert_eq!(folder.run(&limited).status.code(), Some(3), "{limited}");
            let found = report(&folder, &limited);
            assert_eq!(found["stop"], stop);
            if stop == "time" && args.starts_with("rank") {
                let targets = found["targets"].as_array().unwrap();
                assert_eq!(targets.len(), open);
                assert!(
                    targets
                        .iter()
                        .all(|t| t["status"] == "open" && t["stop"] == stop && t["rank_last"] == open)
                );
            } else if args.starts_with("matrix") {
                assert_eq!(found["open"].as_array().unwrap().len(), open);
            }
        }
        assert_eq!(report(&folder, &format!("{args} --resume journal")), expected);
        std::fs::remove_file(folder.path().join("journal")).unwrap();
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_a_ranking_with_what_is_done() {
    let folder = noisy();
    let args = "rank template.obj t*.ply --all --json --threads 1 --resume journal";
    let child = folder.pompeiu(args).stdout(std::process::Stdio::piped()).spawn().unwrap();
    let lines = || lines(&folder, "journal");
    while lines() < 4 {
        std::thread::yield_now();
    }
    // By the shell: a bare system has no program of that name.
    let interrupt = format!("kill -INT {}", child.id());
    assert!(std::process::Command::new("sh").args(["-c", &interrupt]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(3));
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    let report = &answer["report"];
    assert_eq!((&report["stop"], report["targets"].as_array().unwrap().len()), (&"cancelled".into(), 12));
}

#[test]
fn real_meshes_are_ranked() {
    let folder = Folder::new();
    let Some(cow) = data::file("meshes/cow.off") else { return };
    let Some(spot) = data::file("meshes/spot.obj") else { return };
    let [cow, spot] = [cow, spot].map(|path| path.display().to_string());
    folder.ok(&format!("generate mesh {spot} --rotate 1,2,3,50 --translate 1,0,0 -o turned.ply"));
    let report = report(
        &folder,
        &format!("rank {spot} {cow} turned.ply --align rigid --top 1 --json --tolerance 1e-6"),
    );
    let best = &report["targets"][0];
    assert_eq!((&best["path"], &best["rank_last"]), (&"turned.ply".into(), &1.into()));
    assert!(best["upper"].as_f64().unwrap() < 1e-5, "{best}");
}
