//! Files that a command reads beside meshes, damaged: scenes, checkpoints, journals, files of options. It answers or says what is wrong; it
//! never panics.

use crate::common::Folder;
use pompeiu_testkit::mutate::attack;
use std::fs;

/// Mutations of each file in an ordinary test; a program is started for each.
const USUAL: u32 = 24;

/// Runs a command on files of this name as they are and with bytes changed.
fn damage(folder: &Folder, name: &str, args: &str) {
    let inputs = folder.path().join("inputs");
    fs::create_dir(&inputs).unwrap();
    fs::copy(folder.path().join(name), inputs.join(name)).unwrap();
    attack(&inputs, USUAL, |bytes| {
        folder.write(name, bytes);
        let (code, _, stderr) = folder.transcript(args);
        assert!(matches!(code, Some(0..=3)) && !stderr.contains("panicked"), "{args}: {code:?} {stderr}");
        assert!(code != Some(2) || stderr.starts_with("error: "), "{args}: {stderr}");
    });
}

#[test]
fn checkpoints_of_fluids() {
    let folder = Folder::new();
    folder.ok("fluid --square 4 --viscosity 0.01 --lid 1 --dt 0.1 --steps 1 --checkpoint half.json");
    damage(
        &folder,
        "half.json",
        "fluid --square 4 --viscosity 0.01 --lid 1 --dt 0.1 --steps 2 --resume half.json",
    );
}

#[test]
fn checkpoints_of_flows_on_surfaces() {
    let folder = Folder::new();
    folder.ok("generate icosphere --subdivisions 0 -o ball.obj");
    folder.ok("fluid ball.obj --vorticity z --dt 0.1 --steps 1 --checkpoint half.json");
    damage(&folder, "half.json", "fluid ball.obj --vorticity z --dt 0.1 --steps 2 --resume half.json");
}

#[test]
fn journals() {
    let folder = Folder::new();
    folder.ok("generate tetrahedron -o a.obj");
    folder.ok("generate icosphere --subdivisions 0 -o b.obj");
    folder.ok("matrix a.obj b.obj --resume journal");
    damage(&folder, "journal", "matrix a.obj b.obj --resume journal");
}

#[test]
fn scenes() {
    let folder = Folder::new();
    folder.write(
        "scene.toml",
        "steps = 1\ndt = 0.02\nviscosity = 0.01\ngrid = \"stam:4\"\nedges = \"periodic\"\nvelocity = \"sin(6.28*y); 0\"\n\
         [[density]]\nname = \"dye\"\ninitial = \"x*y\"\ndiffusivity = 0.01\n",
    );
    damage(&folder, "scene.toml", "fluid --square 4 scene.toml --steps 1 --dt 0.02");
}

#[test]
fn options() {
    let folder = Folder::new();
    folder.ok("generate tetrahedron -o a.obj");
    folder.write(
        "options.toml",
        "direction = \"b-to-a\"\ntolerance = 1e-3\ntolerance_kind = \"relative\"\nassert_below = 0.5\n",
    );
    damage(&folder, "options.toml", "distance a.obj a.obj --config options.toml");
}
