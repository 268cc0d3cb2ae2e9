//! The schemas of the JSON answers, which the guide publishes, are those of the types that the answers are made of.

use super::{Visitor, compare};
use crate::commands::visit_systems;
use crate::door::{AnswerOf, System};
use pompeiu::core::request::Request;
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

/// The files of schemas that there are to be.
struct Published(Vec<String>);

impl Published {
    fn check<T: JsonSchema>(&mut self, name: &str) {
        compare(&folder().join(format!("{name}.json")), &schema::<T>());
        self.0.push(format!("{name}.json"));
    }
}

impl Visitor for Published {
    fn system<S: System>(&mut self) {
        self.check::<AnswerOf<S>>(<S::Request as Request>::NAME);
    }
}

#[test]
fn published_schemas_are_those_of_the_types() {
    let mut published = Published(Vec::new());
    visit_systems(&mut published);
    let names = std::fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().file_name());
    let mut names: Vec<String> = names.map(|name| name.into_string().unwrap()).collect();
    names.sort();
    published.0.sort();
    assert_eq!(names, published.0, "a file of no answer, or an answer without a file");
}
