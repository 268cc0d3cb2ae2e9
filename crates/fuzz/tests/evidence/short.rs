//! A short run of every target.

use pompeiu_fuzz::{TARGETS, corpus, target};
use pompeiu_testkit::mutate::attack;

fn run(name: &str) {
    let target = target(name).expect("the name is one of the list");
    attack(&corpus(name), target.usual, target.run);
}

macro_rules! targets {
    ($($test:ident: $name:literal,)*) => {
        $(#[test]
        fn $test() {
            run($name);
        })*

        #[test]
        fn every_target_is_run() {
            let listed = [$($name),*];
            assert_eq!(TARGETS.map(|target| target.name), listed);
        }
    };
}

targets! {
    meshes: "meshes",
    certificates: "certificates",
    engine: "engine",
    deviation: "deviation",
    skeletons: "skeletons",
    drawings: "drawings",
    pictures: "pictures",
    options: "options",
    neuron_files: "neuron-files",
}
