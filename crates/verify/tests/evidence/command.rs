//! The command: its exit codes and what it says.

use pompeiu_verify::{MAGIC, Rejected, Soup, mesh, verify};
use std::path::Path;
use std::process::Command;

const A: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const B: &str = "v 0 0 2\nv 1 0 2\nv 0 1 2\nf 1 2 3\n";

/// That h(A, B) is 2 with the upper end `upper`: one face of A, and its tree.
fn certificate_of(lower: f64, upper: f64, tree: &[u8]) -> Vec<u8> {
    let hash = |text: &str| {
        let mesh = mesh::read(text.as_bytes()).unwrap();
        Soup::new(&mesh.positions, &mesh.faces).unwrap().hash()
    };
    let mut bytes = MAGIC.to_vec();
    bytes.extend([hash(A), hash(B)].concat());
    bytes.push(1);
    bytes.extend([lower, upper].map(f64::to_le_bytes).concat());
    bytes.extend(0_u32.to_le_bytes());
    bytes.extend([0.25, 0.25, 0.5].map(f64::to_le_bytes).concat());
    bytes.extend((tree.len() as u32).to_le_bytes());
    bytes.extend(tree);
    bytes
}

/// The same with a leaf: it is face 0 of B, and no more faces have it.
fn certificate(lower: f64, upper: f64) -> Vec<u8> {
    certificate_of(lower, upper, &[0, 0])
}

#[test]
fn trees_that_are_none_are_refused() {
    let [a, b] = [A, B].map(|text| mesh::read(text.as_bytes()).unwrap());
    let [a, b] = [&a, &b].map(|mesh| Soup::new(&mesh.positions, &mesh.faces).unwrap());
    let verdict = |tree: &[u8]| verify(&a, &b, certificate_of(0.0, 3.0, tree).as_slice(), 1);
    // Between sides 0 and 1, the first end at seven bytes over 2^52, the second at a corner.
    let chord = |first: u8| [&[0xE1, 0x03, first, 0, 0, 0, 0, 0, 0], &[0_u8; 2][..]].concat();
    assert_eq!(verdict(&[0, 0]).unwrap().claims[0].unwrap().cells, 1);
    assert_eq!(verdict(&chord(0x08)).unwrap().claims[0].unwrap().cells, 2);
    for upper in [f64::INFINITY, f64::NAN, -1.0] {
        let found = verify(&a, &b, certificate_of(0.0, upper, &[0, 0]).as_slice(), 1);
        assert!(matches!(found, Err(Rejected::Claim(..))), "{upper} is no length");
    }
    for (tree, what) in [
        (chord(0x10), "a position at the end of a side"),
        (chord(0x1F), "a position beyond it"),
        (vec![3], "a node of no kind"),
        (vec![1, 0, 0], "a chord from a side to itself"),
        (vec![0x81, 0x06, 0, 0], "sides in the wrong order"),
        (vec![8, 0], "a face that B does not have"),
        (vec![4, 0], "a face below the first"),
        (vec![0, 1], "a run beyond the last face"),
        (vec![0, 0, 0], "a spare byte"),
        (vec![0], "an early end"),
        (vec![0x80; 12], "an endless number"),
        (vec![0x22, 0], "a side that crosses nothing"),
    ] {
        assert!(verdict(&tree).is_err_and(|error| error.is_unreadable()), "{what}");
    }
}

fn run(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_pompeiu-verify"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn exit_codes_tell_valid_from_invalid_from_unreadable() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    for (name, text) in [("a.obj", A), ("b.obj", B), ("quad.obj", "v 0 0 0\nf 1 1 1 1\n")] {
        std::fs::write(path(name), text).unwrap();
    }
    let just_below = 2.0 - 1e-14;
    for (name, bytes) in [
        ("true", certificate(just_below, 2.0 + 1e-14)),
        ("high", certificate(just_below, 1.9)),
        ("low", certificate(2.1, 3.0)),
        ("short", certificate(just_below, 3.0)[..100].to_vec()),
        ("other", b"no certificate".to_vec()),
    ] {
        std::fs::write(path(name), bytes).unwrap();
    }
    let (code, out, _) = run(folder.path(), &["true", "a.obj", "b.obj", "--threads", "3"]);
    assert!(
        code == 0 && out.contains("<= h(A, B) <= 2.00000000000001") && out.contains("(1 cells)"),
        "{out}"
    );
    let (code, out, _) = run(folder.path(), &["true", "a.obj", "b.obj", "--json"]);
    assert!(code == 0 && out.starts_with("{\"status\":\"valid\",\"a_to_b\":{\"lower\":"), "{out}");
    for (name, says) in [
        ("high", "cell 0 of face 0 of A is not shown to be as near to face 0 of B"),
        ("low", "the witness on face 0 of A is not shown to be as far from face 0 of B"),
    ] {
        let (code, out, _) = run(folder.path(), &[name, "a.obj", "b.obj"]);
        assert!(code == 1 && out.contains(says), "{out}");
    }
    let (code, out, _) = run(folder.path(), &["true", "b.obj", "b.obj"]);
    assert!(code == 1 && out.contains("mesh A is not the one that was certified"), "{out}");
    for arguments in [
        ["short", "a.obj", "b.obj"].as_slice(),
        &["other", "a.obj", "b.obj"],
        &["true", "quad.obj", "b.obj"],
        &["true", "a.obj", "missing.obj"],
        &["missing", "a.obj", "b.obj"],
        &["true", "a.obj"],
        &["true", "a.obj", "b.obj", "--threads", "0"],
        &["true", "a.obj", "b.obj", "--fast"],
    ] {
        let (code, out, error) = run(folder.path(), arguments);
        assert!(code == 2 && out.is_empty() && !error.is_empty(), "{arguments:?} {out}");
    }
}
