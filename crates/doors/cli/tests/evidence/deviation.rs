//! The answers of `pompeiu deviation`, against closed forms and against its own files.

use crate::common::{Folder, report_of, repository};
use serde_json::Value;

/// A plate of side 2 at height 0.5 over a larger one at height 0: every point is exactly half a unit away.
fn plates() -> Folder {
    let folder = Folder::new();
    folder.ok("generate grid --size 2,2 --cells 3 --translate 0,0,0.5 -o above.obj");
    folder.ok("generate grid --size 4,4 -o below.obj");
    folder
}

fn json(folder: &Folder, args: &str) -> Value {
    report_of(serde_json::from_str(&folder.ok(args)).unwrap())
}

/// The answer of a command that ends with an exit code.
#[track_caller]
fn json_with(folder: &Folder, expected: i32, args: &str) -> Value {
    let (code, answer, errors) = folder.transcript(args);
    assert_eq!(code, Some(expected), "{args}: {errors}");
    report_of(serde_json::from_str(&answer).unwrap())
}

#[track_caller]
fn check_encloses(bounds: &Value, value: f64, width: f64) {
    let [lower, upper] = ["lower", "upper"].map(|end| bounds[end].as_f64().unwrap());
    assert!(lower <= value && value <= upper, "{value} is not in [{lower}, {upper}]");
    assert!(upper - lower <= width, "[{lower}, {upper}] is wider than {width}");
}

#[test]
fn a_plate_over_a_larger_one() {
    let folder = plates();
    let found = json_with(&folder, 1, "deviation above.obj below.obj --threshold 0.25 --json");
    let there = &found["a_to_b"];
    check_encloses(&there["distance"], 0.5, 1e-11);
    for name in ["mean", "rms"] {
        check_encloses(&there["statistics"][name], 0.5, 1e-11);
    }
    for percentile in there["statistics"]["percentiles"].as_array().unwrap() {
        check_encloses(percentile, 0.5, 1e-11);
    }
    check_encloses(&there["statistics"]["share_above_threshold"], 1.0, 1e-11);
    assert!((there["statistics"]["area"].as_f64().unwrap() - 4.0).abs() < 1e-12);
    assert_eq!(there["beyond_threshold"][0]["faces"].as_array().unwrap().len(), 18);
    // Back: the corner of the larger plate is farthest.
    check_encloses(&found["b_to_a"]["distance"], 1.5, 1e-11);
    check_encloses(&found["distance"], 1.5, 1e-11);
    let shares: Vec<_> = there["statistics"]["percentiles"]
        .as_array()
        .unwrap()
        .iter()
        .map(|p| p["share"].as_f64().unwrap())
        .collect();
    assert_eq!(shares, [0.5, 0.9, 0.95, 0.99]);
}

#[test]
fn the_share_of_a_leaning_plate_above_a_threshold() {
    let folder = Folder::new();
    // Leans over the larger plate, from height 0 to height 1.
    folder.write("leaning.obj", "v 0 0 0\nv 1 0 1\nv 1 1 1\nv 0 1 0\nf 1 2 3 4\n");
    folder.write("below.obj", "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n");
    let found =
        json_with(&folder, 1, "deviation leaning.obj below.obj --threshold 0.7 --percentiles 10,50 --json");
    let statistics = &found["a_to_b"]["statistics"];
    check_encloses(&statistics["mean"], 0.5, 0.005);
    check_encloses(&statistics["rms"], (1.0_f64 / 3.0).sqrt(), 0.006);
    check_encloses(&statistics["percentiles"][0], 0.1, 0.001);
    check_encloses(&statistics["share_above_threshold"], 0.3, 0.01);
}

#[test]
fn a_threshold_is_answered_first_and_by_the_exit_code() {
    let folder = plates();
    let answer = |code, options: &str| {
        let found = json_with(&folder, code, &format!("deviation above.obj below.obj --json {options}"));
        found["verdict"]["answer"].as_str().unwrap().to_owned()
    };
    // The corners of the larger plate are 1.5 away, a fifth of its area, 9 % of it beyond 1.2.
    assert_eq!(answer(0, "--threshold 1.6"), "within");
    assert_eq!(answer(1, "--threshold 1.4"), "out");
    assert_eq!(answer(0, "--threshold 1.4 --allow 20%"), "within");
    assert_eq!(answer(1, "--threshold 0.6 --allow 1%"), "out");
    assert_eq!(answer(0, "--threshold 160um --unit in --allow 1").as_str(), "within");
    // The plate above is exactly at the threshold: no interval with rounding can tell.
    assert_eq!(answer(3, "--threshold 1.5"), "undecided");
    let (code, text, _) = folder.transcript("deviation above.obj below.obj --threshold 1.4cm --unit mm");
    assert_eq!(
        (code, text.lines().next().unwrap().contains("WITHIN TOLERANCE 14 mm")),
        (Some(0), true),
        "{text}"
    );
    let (code, _, errors) = folder.transcript("deviation above.obj below.obj --threshold 1mm");
    assert!(code == Some(2) && errors.contains("--unit"), "{errors}");
}

#[test]
fn bands_tell_too_low_from_too_high() {
    let folder = Folder::new();
    folder.transcript("generate cube --side 2 -o model.obj");
    folder.transcript("generate cube --side 2.2 -o scan.obj");
    // The scan stands out by 0.1 on all sides, by more at its edges; no point of the model is farther than 0.1 from it.
    let found = json_with(&folder, 1, "deviation model.obj scan.obj --json --band -0.05..0.05");
    assert_eq!(found["verdict"]["answer"], "out");
    let shares = &found["bands"]["b_to_a"]["shares"];
    check_encloses(&shares[2], 1.0, 1e-9);
    check_encloses(&found["bands"]["a_to_b"]["shares"][2], 1.0, 1e-9);
    check_encloses(&found["bands"]["b_to_a"]["highest"], 0.1 * 3.0_f64.sqrt(), 1e-9);
    let answer = |code, options: &str| {
        let found = json_with(&folder, code, &format!("deviation model.obj scan.obj --json {options}"));
        found["verdict"]["answer"].as_str().unwrap().to_owned()
    };
    assert_eq!(answer(0, "--band -0.05..0.2"), "within");
    // The other way round something is missing.
    let found = json_with(&folder, 1, "deviation scan.obj model.obj --json --band -0.05..0.2");
    check_encloses(&found["bands"]["b_to_a"]["shares"][0], 1.0, 1e-9);
    assert_eq!(answer(0, "--band 50um..150um --unit mm --allow 100%").as_str(), "within");
    assert_eq!(answer(0, "--band -0.05..0.12 --band 0..0.15 --allow 5%"), "within");
    assert_eq!(answer(1, "--band -0.05..0.12 --allow 1e-6").as_str(), "out");
    let (code, text, _) = folder.transcript("deviation model.obj scan.obj --band -0.05..0.12 --unit mm");
    let first = text.lines().next().unwrap();
    assert_eq!(code, Some(1), "{text}");
    assert!(first.contains("OUT OF TOLERANCE -0.05..0.12 mm: too low nothing of A's area"), "{text}");
    let (code, _, errors) = folder.transcript("deviation model.obj scan.obj --band -1..0 --band 0.1..1");
    assert!(code == Some(2) && errors.contains("leave out"), "{errors}");
    let (code, _, errors) = folder.transcript("deviation model.obj scan.obj --band -1..0 --threshold 1");
    assert!(code == Some(2) && errors.contains("cannot be used with"), "{errors}");
}

#[test]
fn what_has_no_counterpart_can_be_left_out() {
    let folder = Folder::new();
    // A plate and a quarter of it; junk far away.
    folder.write("plate.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 1 0\nv 1 2 0\nf 5 2 8 6\nf 1 5 6 7\nf 6 8 3 9\nf 7 6 9 4\n");
    folder.write(
        "scan.obj",
        "v 0 0 .1\nv 1 0 .1\nv 1 1 .1\nv 0 1 .1\nv 9 9 9\nv 9 9.001 9\nv 9 9 9.001\nf 1 2 3 4\nf 5 6 7\n",
    );
    let (_, _, warned) = folder.transcript("deviation plate.obj scan.obj");
    assert!(warned.contains("--ignore-components"), "{warned}");
    let found = json_with(&folder, 1, "deviation plate.obj scan.obj --json --threshold 0.15");
    assert!(found.get("left_out").is_none());
    let options = "--only-overlap --ignore-components 1% --threshold 0.15 --report r.html --pdf p.pdf";
    let found = json_with(&folder, 0, &format!("deviation plate.obj scan.obj --json {options}"));
    // Of the quarter, what lies beside the rim of the scan by no more than three quarters of the distance goes as well.
    let is_about = |found: &serde_json::Value, share: f64| {
        let lower = found["share"]["lower"].as_f64().unwrap();
        assert!((lower - share).abs() < 1e-3, "{lower} {share}");
        check_encloses(&found["share"], lower, 1e-9);
    };
    is_about(&found["left_out"]["a"], 1.0 - 0.85 * 0.85 / 4.0);
    let counts = ["faces", "cut", "components"].map(|name| found["left_out"]["a"][name].as_u64());
    assert_eq!(counts, [6, 2, 1].map(Some));
    // Of the scan the junk, and what is as near to the rim of the plate.
    let counts = ["faces", "cut", "components"].map(|name| found["left_out"]["b"][name].as_u64());
    assert_eq!(counts, [1, 2, 2].map(Some));
    check_encloses(&found["distance"], 0.1, 1e-9);
    // Faces keep their numbers: the quarter under the scan is the second of the plate.
    let found = json_with(&folder, 0, "deviation scan.obj plate.obj --json --ignore-beyond 0.2");
    assert_eq!(found["left_out"]["a"]["faces"], 1);
    let beside = 0.03_f64.sqrt();
    is_about(&found["left_out"]["b"], 1.0 - (1.0 + 2.0 * beside + 0.03 * std::f64::consts::PI / 4.0) / 4.0);
    let found = json_with(&folder, 0, "deviation plate.obj scan.obj --json --box 0,0,-1,1,1,1");
    assert_eq!(found["a_to_b"]["regions"][0]["faces"], serde_json::json!([2, 3]));
    let found = json_with(&folder, 0, "deviation plate.obj scan.obj --json --box -0.1,-0.1,-1,1.1,1.1,1");
    check_encloses(&found["left_out"]["a"]["share"], 1.0 - 1.1 * 1.1 / 4.0, 1e-9);
    let corner = (0.1_f64 * 0.1 * 3.0).sqrt();
    check_encloses(&found["a_to_b"]["distance"], corner, 1e-9);
    let (code, _, errors) = folder.transcript("deviation plate.obj scan.obj --box 5,5,5,6,6,6");
    assert!(code == Some(2) && errors.contains("nothing of A is left"), "{errors}");
    let (_, text, _) =
        folder.transcript("deviation plate.obj scan.obj --only-overlap --ignore-components 1%");
    assert!(text.contains("% of B's area, 1 face and parts of 2 faces in 2 connected parts"), "{text}");
    assert!(text.contains("% of A's area, 6 faces and parts of 2 faces in 1 connected part"), "{text}");
    let (_, _, warned) = folder.transcript("deviation plate.obj scan.obj --threshold 1e-3");
    assert!(warned.contains("--align rigid"), "{warned}");
    // Without a threshold, too, if they are far apart for their size.
    folder.ok("generate cube --side 2 -o here.obj");
    folder.ok("generate cube --side 2 --translate 9,0,0 -o there.obj");
    let (_, _, warned) = folder.transcript("deviation here.obj there.obj");
    assert!(warned.contains("--align rigid"), "{warned}");
    // A part that lies elsewhere is noticed however small the way is.
    folder.ok("generate torus -o ring.obj");
    for way in ["0.01,0,0", "151,0,0"] {
        folder.ok(&format!("generate torus --translate {way} -o moved.obj"));
        let (_, _, warned) = folder.transcript("deviation ring.obj moved.obj");
        assert!(warned.contains("the poses do not fit, and --align rigid moves B onto A first"), "{warned}");
    }
    let (_, _, warned) = folder.transcript("deviation ring.obj ring.obj");
    assert!(!warned.contains("--align rigid"), "{warned}");
    let (_, _, warned) = folder.transcript("deviation here.obj here.obj");
    assert!(!warned.contains("--align rigid"), "{warned}");
}

#[test]
fn a_group_or_a_node_can_be_measured_alone() {
    let folder = Folder::new();
    let plates = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 5\nv 1 0 5\nv 1 1 5\nv 0 1 5\n";
    folder.write("assembly.obj", format!("{plates}o lower\nf 1 2 3 4\no upper\ng lid cover\nf 5 6 7 8\n"));
    folder.write("scan.obj", "v 0 0 5.1\nv 1 0 5.1\nv 1 1 5.1\nv 0 1 5.1\nf 1 2 3 4\n");
    for name in ["upper", "lid", "cover"] {
        let found = json_with(
            &folder,
            0,
            &format!("deviation assembly.obj scan.obj --json --threshold 0.15 --group {name}"),
        );
        check_encloses(&found["distance"], 0.1, 1e-9);
        check_encloses(&found["left_out"]["a"]["share"], 0.5, 1e-9);
        assert_eq!(found["left_out"]["b"]["faces"], 0);
    }
    let both = json_with(
        &folder,
        1,
        "deviation assembly.obj scan.obj --json --threshold 0.15 --group lid --group lower",
    );
    assert_eq!(both["left_out"]["a"]["faces"], 0);
    let (code, _, errors) = folder.transcript("deviation assembly.obj scan.obj --group bottom");
    assert!(code == Some(2) && errors.contains("neither file has a group `bottom`; there are"), "{errors}");
    assert!(["lower", "upper", "lid", "cover"].iter().all(|name| errors.contains(name)), "{errors}");
    let (_, _, errors) = folder.transcript("deviation scan.obj scan.obj --group bottom");
    assert!(errors.contains("they have none"), "{errors}");
}

#[test]
fn files_hold_what_the_answer_says() {
    let folder = plates();
    let files = "-a a.ply -b b.vtu --csv s.csv --report r.html --image p.png --image-size 320x200 --unit mm --pdf p.pdf \
                 --title Cover --part P-7 --operator Ann";
    let found = json(&folder, &format!("deviation above.obj below.obj --json {files}"));
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let csv = String::from_utf8(read("s.csv")).unwrap();
    let upper = &found["a_to_b"]["statistics"]["mean"]["upper"];
    let row = csv.lines().find(|row| row.starts_with("a_to_b,mean,")).unwrap();
    assert_eq!(row.rsplit(',').next().unwrap().parse::<f64>().unwrap(), upper.as_f64().unwrap());
    assert!(csv.lines().all(|row| row.split(',').count() == 4), "{csv}");
    let header = read("a.ply");
    let header =
        String::from_utf8_lossy(&header[..header.windows(10).position(|w| w == b"end_header").unwrap()]);
    for name in ["property double distance", "property uchar red", "property double max_upper"] {
        assert!(header.contains(name), "{header}");
    }
    assert_eq!(json(&folder, "info b.vtu --json")["faces"], 2);
    assert!(read("p.png").starts_with(b"\x89PNG"));
    let document = read("p.pdf");
    assert!(document.starts_with(b"%PDF-") && document.ends_with(b"%%EOF"), "a whole document");
    assert!(document.windows(14).any(|part| part == b"/Title (Cover)"), "the title");
    let page = String::from_utf8(read("r.html")).unwrap();
    assert!(page.contains("above.obj") && page.contains("--unit mm"), "names and command");
    assert!(!page.contains("<script src") && !page.contains("<link rel=\"stylesheet"), "one file");
}

#[test]
fn inside_is_negative() {
    let folder = Folder::new();
    folder.ok("generate icosphere --subdivisions 2 --radius 1 -o inner.ply");
    folder.ok("generate icosphere --subdivisions 2 --radius 2 -o outer.ply");
    let found = json(&folder, "deviation inner.ply outer.ply --signed --json -a a.vtp --report r.html");
    let inside = |way: &str| found[way]["vertices_inside"].as_u64().unwrap();
    assert_eq!((inside("a_to_b"), inside("b_to_a")), (162, 0));
    let header = std::fs::read(folder.path().join("a.vtp")).unwrap();
    let header = String::from_utf8_lossy(&header[..2000]);
    assert!(header.contains("\"signed_distance\"") && header.contains("\"winding_number\""), "{header}");
    let page = std::fs::read_to_string(folder.path().join("r.html")).unwrap();
    assert!(page.contains("\"signed\":true"));
}

#[test]
fn files_are_refused_before_any_work() {
    let folder = plates();
    for (args, reason) in [
        ("-a a.stl", "no room for colours"),
        ("-a above.obj", "both input and output"),
        ("--report nowhere/r.html", "there is no folder"),
        ("--image .", "is a folder"),
        ("--image p.jpg", "give the name the suffix .png"),
        ("--report r.html --image ./r.html", "give the name the suffix .png"),
        ("-a a.ply -b a.ply", "is named for two outputs"),
        ("--accuracy 0", "accuracy"),
    ] {
        let (code, stdout, stderr) = folder.transcript(&format!("deviation above.obj below.obj {args}"));
        assert_eq!((code, stdout.as_str()), (Some(2), ""), "{args}");
        assert!(stderr.contains(reason), "{args}: {stderr}");
    }
}

#[test]
fn a_time_limit_leaves_true_and_wider_numbers() {
    let folder = Folder::new();
    folder.ok("generate icosphere --subdivisions 3 --noise 0.05 --seed 3 -o a.ply");
    folder.ok("generate icosphere --subdivisions 3 -o b.ply");
    let full = json(&folder, "deviation a.ply b.ply --json");
    let output = folder.run("deviation a.ply b.ply --time-limit 1ns --json");
    assert_eq!(output.status.code(), Some(3));
    let short = report_of(serde_json::from_slice(&output.stdout).unwrap());
    let ends =
        |v: &Value| ["lower", "upper"].map(|end| v["a_to_b"]["statistics"]["mean"][end].as_f64().unwrap());
    let ([low, high], [wide_low, wide_high]) = (ends(&full), ends(&short));
    assert!(wide_low <= high && low <= wide_high && wide_high - wide_low >= high - low);
}

/// A screenful by default, all of it when asked; roles name the surfaces in any order.
#[test]
fn an_answer_fits_on_a_screen() {
    let folder = plates();
    let (_, brief, _) = folder.transcript("deviation --scan below.obj --model above.obj --threshold 0.25");
    let (_, full, _) = folder.transcript("deviation above.obj below.obj --threshold 0.25 --full");
    assert!(brief.lines().count() <= 24 && brief.contains("model to scan"), "{brief}");
    assert!(full.contains("pooled") && !brief.contains("pooled"), "{full}");
}

/// A copy that was turned and moved has distance 0 once it is aligned.
#[test]
fn each_defect_of_a_scan_is_listed() {
    // The dent is nearer to the missing rib than the rib is high; seen from the scan, both are the same places.
    let folder = Folder::new();
    for name in ["bracket.obj", "bracket-scan.obj"] {
        std::fs::copy(repository().join("examples/bracket").join(name), folder.path().join(name)).unwrap();
    }
    let asked = "deviation --model bracket.obj --scan bracket-scan.obj --within 0.5mm --unit mm";
    let (code, answer, errors) = folder.transcript(asked);
    assert_eq!(code, Some(1), "{errors}");
    let listed = ["1. 17.0", "2. 4.39", "3. 0.59"];
    assert!(listed.iter().all(|place| answer.contains(place)), "{answer}");
}

#[test]
fn a_moved_copy_is_aligned_before_it_is_compared() {
    let folder = Folder::new();
    let corners = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 0.5, 1.0]];
    let write = |name: &str, map: fn([f64; 3]) -> [f64; 3]| {
        let vertices = corners.map(map).map(|[x, y, z]| format!("v {x} {y} {z}\n")).concat();
        folder.write(name, format!("{vertices}f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"));
    };
    write("here.obj", |p| p);
    write("there.obj", |[x, y, z]| [z + 10.0, x - 3.0, y + 7.0]);
    for command in ["distance", "deviation"] {
        let found = json(&folder, &format!("{command} here.obj there.obj --align rigid --json"));
        let upper = |found: &Value| {
            found["a_to_b"]["distance"]["upper"].as_f64().or(found["a_to_b"]["upper"].as_f64())
        };
        assert!(upper(&found).unwrap() < 1e-6, "{found}");
        assert!(found["alignment"]["matched"].as_f64().unwrap() > 0.99, "{found}");
        let unmoved = json(&folder, &format!("{command} here.obj there.obj --json"));
        assert!(upper(&unmoved).unwrap() > 1.0 && unmoved.get("alignment").is_none(), "{unmoved}");
    }
}

/// A page that cannot be written does not cost the answer.
#[test]
fn the_answer_is_printed_before_files_are_written() {
    let folder = plates();
    let impossible = format!("{}.html", "x".repeat(300));
    let called = format!("deviation above.obj below.obj --threshold 0.25 --report {impossible}");
    let (code, text, errors) = folder.transcript(&called);
    assert_eq!(code, Some(2), "{errors}");
    assert!(text.starts_with("verdict") && text.contains("largest") && !text.contains("total"), "{text}");
    let (code, text, _) = folder.transcript(&format!("{called} --json"));
    let answer: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((code, answer["report"]["verdict"].is_object()), (Some(2), true), "{answer}");
    let (_, text, _) =
        folder.transcript("deviation above.obj below.obj --threshold 0.25 --report r.html --unit mm");
    let last = text.lines().last().unwrap();
    assert!(last.starts_with("time") && last.contains("files") && last.contains("total"), "{text}");
    let page = std::fs::read_to_string(folder.path().join("r.html")).unwrap();
    assert!(
        page.contains("\"banner\":{\"head\":\"OUT OF TOLERANCE\",\"kind\":\"bad\""),
        "the verdict is above all"
    );
}

/// What a time limit leaves undone on a page is drawn coarsely, and the names of the meshes are those that were given.
#[test]
fn limits_act_on_pages_and_names_are_shown() {
    let folder = plates();
    let output = folder
        .run("deviation --model above.obj --scan below.obj --time-limit 1ns --report r.html --pdf p.pdf");
    assert_eq!(output.status.code(), Some(3));
    let page = std::fs::read_to_string(folder.path().join("r.html")).unwrap();
    assert!(page.contains("model \u{2192} scan") && page.contains("Missing on scan"), "names");
    assert!(folder.path().join("p.pdf").exists());
}
