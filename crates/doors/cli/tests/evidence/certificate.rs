//! Certificates that commands write, and what `pompeiu verify` says of them.

use crate::common::Folder;
use flate2::read::GzDecoder;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::io::Read;

fn folder() -> Folder {
    let folder = Folder::new();
    folder.ok("generate torus --major-segments 48 --minor-segments 32 -o a.obj");
    folder.ok("generate torus --major-segments 40 --minor-segments 24 --rotate 1,0,0,30 -o b.ply");
    folder
}

fn json(folder: &Folder, args: &str) -> (Option<i32>, Value) {
    let (code, stdout, stderr) = folder.transcript(&format!("{args} --json"));
    (code, serde_json::from_str(&stdout).unwrap_or_else(|_| panic!("{args}: {stderr}")))
}

fn exists(folder: &Folder, name: &str) -> bool {
    folder.path().join(name).exists()
}

/// What a certificate says of h(A, B), once it is verified.
fn verified(folder: &Folder, args: &str) -> [f64; 2] {
    let (code, answer) = json(folder, &format!("verify {args}"));
    assert_eq!((code, &answer["report"]["valid"]), (Some(0), &true.into()), "{args}: {answer}");
    ["lower", "upper"].map(|end| answer["report"]["a_to_b"][end].as_f64().unwrap())
}

#[test]
fn a_certificate_proves_what_is_printed() {
    let folder = folder();
    let (code, answer) = json(&folder, "distance a.obj b.ply --certificate proof.phc");
    let report = &answer["report"];
    assert_eq!(code, Some(0));
    let bytes = std::fs::metadata(folder.path().join("proof.phc")).unwrap().len();
    assert_eq!(report["certificate"]["written"]["bytes"], bytes);
    let [lower, upper] = verified(&folder, "proof.phc a.obj b.ply --threads 2");
    let [below, above] = ["lower", "upper"].map(|end| report["a_to_b"][end].as_f64().unwrap());
    assert!(lower <= below && above <= upper && upper - lower < 1e-11, "{lower} {below} {above} {upper}");
    // More slack, fewer bytes; one direction.
    folder.ok("distance a.obj b.ply --certificate short.phc --certificate-slack 1e-2 --direction a-to-b");
    let short = std::fs::metadata(folder.path().join("short.phc")).unwrap().len();
    assert!(short < bytes, "{short} {bytes}");
    assert!(verified(&folder, "short.phc a.obj b.ply")[1] > above + 1e-3);
}

#[test]
fn thresholds_limits_and_methods_are_certified() {
    let folder = folder();
    assert_eq!(folder.run("distance a.obj b.ply --within 3 --certificate p.phc").status.code(), Some(0));
    assert_eq!(verified(&folder, "p.phc a.obj b.ply")[1], 3.0);
    assert_eq!(folder.run("distance a.obj b.ply --within 1e-3 --certificate p.phc").status.code(), Some(1));
    assert!(verified(&folder, "p.phc a.obj b.ply")[0] > 1e-3);
    folder.ok("distance a.obj b.ply --method classic --tolerance 1e-2 --certificate p.phc");
    verified(&folder, "p.phc a.obj b.ply");
    // A search that has no time leaves an interval that could be certified, but writing has no time either.
    let (code, answer) = json(&folder, "distance a.obj b.ply --time-limit 0s --certificate none.phc");
    let problem = answer["report"]["certificate"]["problem"].as_str().unwrap();
    assert!(problem.contains("limit on time") && code == Some(3), "{problem}");
    assert!(!exists(&folder, "none.phc"));
    // What is found without trees is certified without them.
    let (code, answer) = json(&folder, "distance a.obj b.ply --memory-limit 1KiB --certificate p.phc");
    assert_eq!((code, &answer["stop"]), (Some(3), &"memory".into()));
    let [lower, upper] = verified(&folder, "p.phc a.obj b.ply");
    let [below, above] = ["lower", "upper"].map(|end| answer["report"]["a_to_b"][end].as_f64().unwrap());
    assert!(0.0 < lower && lower <= below && above <= upper && upper < 1.001 * above, "{lower} {upper}");
}

#[test]
fn the_first_statement_that_fails_is_named_and_files_that_are_none_are_told_apart() {
    let folder = folder();
    folder.ok("distance a.obj b.ply --certificate proof.phc");
    let (code, answer) = json(&folder, "verify proof.phc b.ply a.obj");
    assert_eq!((code, &answer["report"]["failure"]["statement"]), (Some(1), &"hash-of-a".into()));
    let packed = std::fs::read(folder.path().join("proof.phc")).unwrap();
    let mut whole = Vec::new();
    GzDecoder::new(&packed[..]).read_to_end(&mut whole).unwrap();
    let forge = |at: usize, bytes: &[u8]| {
        let mut forged = whole.clone();
        forged[at..at + bytes.len()].copy_from_slice(bytes);
        std::fs::write(folder.path().join("forged.phc"), forged).unwrap();
        json(&folder, "verify forged.phc a.obj b.ply")
    };
    let (code, answer) = forge(73, &2_f64.to_le_bytes());
    let failure = &answer["report"]["failure"];
    assert_eq!((code, &failure["statement"]), (Some(1), &"witness".into()));
    assert!(failure["other_face"].is_u64() && failure["face"].is_u64());
    let (code, answer) = forge(81, &0.01_f64.to_le_bytes());
    let failure = &answer["report"]["failure"];
    assert_eq!(
        (code, &failure["statement"], &failure["direction"]),
        (Some(1), &"cell".into(), &"a_to_b".into())
    );
    let (_, text, _) = folder.transcript("verify forged.phc a.obj b.ply");
    assert!(text.contains("invalid") && text.contains("cell "), "{text}");
    for broken in [&packed[..200], &whole[..200], b"PHCERT2\n", b"v 0 0 0\n"] {
        std::fs::write(folder.path().join("forged.phc"), broken).unwrap();
        let (code, stdout, stderr) = folder.transcript("verify forged.phc a.obj b.ply --json");
        assert_eq!((code, stdout.as_str()), (Some(2), ""));
        assert!(stderr.contains("forged.phc"), "{stderr}");
    }
    assert_eq!(folder.run("verify missing.phc a.obj b.ply").status.code(), Some(2));
}

#[test]
fn a_repaired_mesh_comes_with_a_proof_that_speaks_of_both_files() {
    let folder = folder();
    folder.ok("repair a.obj c.ply --weld 0.09 --within 0.2 --certificate proof.phc");
    assert_eq!(verified(&folder, "proof.phc a.obj c.ply"), [0.0, 0.2]);
    folder.ok("repair a.obj c.stl --weld 0.09 --within 0.2 --certificate proof.phc");
    assert_eq!(verified(&folder, "proof.phc a.obj c.stl"), [0.0, 0.2]);
    let refused = folder.run("repair a.obj d.ply --weld 0.09 --within 1e-6 --certificate none.phc");
    assert_eq!(refused.status.code(), Some(1));
    assert!(!exists(&folder, "none.phc") && !exists(&folder, "d.ply"));
}

#[test]
fn simplified_and_remeshed_files_come_with_proofs() {
    let folder = folder();
    for (output, within) in [("c.ply", 0.2), ("c.stl", 0.2), ("c.obj", 0.1)] {
        folder.ok(&format!("simplify a.obj --within {within} -o {output} --certificate proof.phc"));
        assert_eq!(verified(&folder, &format!("proof.phc a.obj {output}")), [0.0, within]);
    }
    folder.ok("remesh a.obj --relative 0.1 --within 0.3 -o r.stl --certificate proof.phc");
    assert_eq!(verified(&folder, "proof.phc a.obj r.stl"), [0.0, 0.3]);
    let (_, stdout, _) = folder.transcript("simplify a.obj --within 0.2 -o c.ply --certificate proof.phc");
    assert!(stdout.contains("proof.phc"), "{stdout}");
    let (code, _, _) = folder.transcript("verify proof.phc a.obj r.stl");
    assert_eq!(code, Some(1));
}

#[test]
fn pages_and_documents_name_the_proof_that_lies_beside_them() {
    let folder = folder();
    let (code, answer) =
        json(&folder, "deviation a.obj b.ply --within 3 --report d.html --pdf d.pdf --certificate d.phc");
    assert_eq!(code, Some(0));
    assert_eq!(verified(&folder, "d.phc a.obj b.ply")[1], 3.0);
    let sum = sha256(&folder, "d.phc");
    let of_a = answer["report"]["certificate"]["written"]["sha256"][0].as_str().unwrap();
    let html = std::fs::read_to_string(folder.path().join("d.html")).unwrap();
    for part in
        ["proof attached", "d.phc, checked with pompeiu-verify", &sum, of_a, "pompeiu verify d.phc A B"]
    {
        assert!(html.contains(part), "{part}");
    }
    folder.ok("deviation a.obj b.ply --certificate d.phc");
    assert!(verified(&folder, "d.phc a.obj b.ply")[1] < 3.0);
    folder.ok("remesh a.obj --relative 0.1 --within 0.3 -o r.ply --report r.html --certificate r.phc");
    let html = std::fs::read_to_string(folder.path().join("r.html")).unwrap();
    assert!(html.contains("r.phc, checked with pompeiu-verify") && html.contains(&sha256(&folder, "r.phc")));
}

fn sha256(folder: &Folder, name: &str) -> String {
    let bytes = std::fs::read(folder.path().join(name)).unwrap();
    <[u8; 32]>::from(Sha256::digest(bytes)).map(|byte| format!("{byte:02x}")).concat()
}

#[test]
fn what_would_prove_nothing_is_refused_before_any_work() {
    let folder = folder();
    for (args, message) in [
        ("repair a.obj c.ply --certificate p.phc", "--within"),
        ("repair a.obj c.ply --within 1 --center --certificate p.phc", "--center"),
        ("repair a.obj c.ply --within 1 --certificate c.ply", ".phc"),
        ("simplify a.obj --faces 50 -o c.ply --certificate p.phc", "--within"),
        ("simplify a.obj --within 1 -o c.ply --certificate c.ply", ".phc"),
        ("remesh a.obj --relative 0.1 -o c.ply --certificate p.phc", "--within"),
        ("remesh a.obj --relative 0.1 --within 1 --center -o c.ply --certificate p.phc", "--center"),
        ("distance a.obj b.ply --align rigid --certificate p.phc", "--align"),
        ("deviation a.obj b.ply --align rigid --certificate p.phc", "--align"),
        ("deviation a.obj b.ply --only-overlap --certificate p.phc", "left out"),
        ("distance a.obj b.ply --certificate a.obj", ".phc"),
        ("deviation a.obj b.ply --report x.pdf", "pages are HTML; give the name the suffix .html"),
        ("deviation a.obj b.ply --pdf x.html", "documents are PDF; give the name the suffix .pdf"),
        ("deviation a.obj b.ply --csv x.obj", "suffix .csv"),
        ("distance a.obj b.ply --certificate no/p.phc", "there is no folder"),
        ("distance a.obj b.ply --certificate p.phc --certificate-slack -1", "slack"),
    ] {
        let (code, _, stderr) = folder.transcript(args);
        assert!(code == Some(2) && stderr.contains(message), "{args}: {stderr}");
        assert!(!exists(&folder, "p.phc") && !exists(&folder, "c.ply"), "{args}");
    }
}
