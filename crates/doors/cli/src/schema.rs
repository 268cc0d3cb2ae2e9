//! The schemas of the JSON answers, which the guide publishes, are those of the types that the answers are made of.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

use crate::commands::answers;
use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, SchemaGenerator};
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../docs/guide/pages/schema")
}

/// The schema of what a type is written as, in draft 2020-12.
fn schema<T: JsonSchema>() -> String {
    let generator: SchemaGenerator = SchemaSettings::draft2020_12().for_serialize().into_generator();
    serde_json::to_string_pretty(&generator.into_root_schema_for::<T>()).unwrap() + "\n"
}

#[test]
fn published_schemas_are_those_of_the_types() {
    let mut published: Vec<String> = Vec::new();
    let mut check = |name: &str, made: String| {
        let path = folder().join(format!("{name}.json"));
        if std::env::var_os("SCHEMA_UPDATE").is_some() {
            std::fs::create_dir_all(folder()).unwrap();
            std::fs::write(&path, &made).unwrap();
        }
        let found = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(found == made, "{}: out of date; SCHEMA_UPDATE=1 writes it anew", path.display());
        published.push(format!("{name}.json"));
    };
    check("align", schema::<answers::Align<'static>>());
    check("complexity", schema::<answers::Complexity<'static>>());
    check("cut", schema::<answers::Cut<'static>>());
    check("decompose", schema::<answers::Decompose<'static>>());
    check("deviation", schema::<answers::Deviation<'static>>());
    check("distance", schema::<answers::Distance<'static>>());
    check("flatten", schema::<answers::Flatten<'static>>());
    check("flow", schema::<answers::Flow<'static>>());
    check("fluid", schema::<answers::Fluid<'static>>());
    check("info", schema::<answers::Info<'static>>());
    check("matrix", schema::<answers::Matrix<'static>>());
    check("medial", schema::<answers::Medial<'static>>());
    check("neuron", schema::<answers::Neuron<'static>>());
    check("puzzle", schema::<answers::Puzzle<'static>>());
    check("rank", schema::<answers::Rank<'static>>());
    check("remesh", schema::<answers::Remesh<'static>>());
    check("repair", schema::<answers::Repair<'static>>());
    check("simplify", schema::<answers::Simplify<'static>>());
    let names = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<String> = names.map(|name| name.into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, published, "a file of no answer, or an answer without a file");
}
