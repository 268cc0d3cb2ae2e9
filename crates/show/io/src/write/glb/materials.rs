//! Materials, textures and images of the document, and which faces have which material.

use super::super::Attributes;
use super::views::Views;
use crate::appearance::{Descriptions, Materials};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// How the faces look.
pub(super) struct Looks<'a> {
    materials: Option<&'a Materials>,
    image: Option<&'a [u8]>,
    /// Which materials are written, by their numbers in the document, and the faces of each.
    pub(super) primitives: Vec<(Option<usize>, Vec<u32>)>,
}

impl<'a> Looks<'a> {
    pub(super) fn of(attributes: &'a Attributes, faces: usize) -> Self {
        let materials = attributes.materials();
        let image = attributes.image();
        let Some(own) = materials else {
            return Self { materials, image, primitives: vec![(Some(0), (0..faces as u32).collect())] };
        };
        let mut faces = vec![Vec::new(); own.names.len()];
        for (f, material) in own.faces.iter().enumerate() {
            faces[*material as usize].push(f as u32);
        }
        let number = |material: usize| match (&own.descriptions, material) {
            // Faces without a material have none there either.
            (Some(_), 0) => None,
            (Some(_), material) => Some(material - 1),
            (None, material) => Some(material),
        };
        let used = faces.into_iter().enumerate().filter(|(_, faces)| !faces.is_empty());
        let primitives = used.map(|(material, faces)| (number(material), faces)).collect();
        Self { materials, image, primitives }
    }

    fn descriptions(&self) -> Option<&'a Descriptions> {
        self.materials.and_then(|materials| materials.descriptions.as_ref())
    }

    /// The data of the images, in the order of their views.
    pub(super) fn images(&self) -> impl Iterator<Item = &'a [u8]> {
        let own = self.descriptions().map_or(&[][..], |found| &found.images);
        let added = self.image.filter(|image| !image.is_empty() && self.descriptions().is_none());
        own.iter().flatten().map(Vec::as_slice).chain(added)
    }

    /// Adds what the materials look like to the document.
    pub(super) fn describe(&self, document: &mut Value, views: &mut Views) {
        match self.descriptions() {
            Some(found) => describe_as_read(found, document, views),
            None => self.describe_matte(document, views),
        }
    }

    /// Matte materials with the names that are known.
    fn describe_matte(&self, document: &mut Value, views: &mut Views) {
        let texture = self.images().next().map(|image| views.add(image.len() as u64, None));
        let matte = |name: &str| {
            // The default material is polished metal, which looks dark without an environment to reflect.
            let mut material = json!({
                "pbrMetallicRoughness": { "metallicFactor": 0, "roughnessFactor": 1 }, "doubleSided": true
            });
            if !name.is_empty() {
                material["name"] = json!(name);
            }
            if texture.is_some() {
                material["pbrMetallicRoughness"]["baseColorTexture"] = json!({ "index": 0 });
            }
            material
        };
        let materials: Vec<Value> = match self.materials {
            Some(materials) => materials.names.iter().map(|name| matte(name)).collect(),
            None => vec![matte("")],
        };
        document["materials"] = Value::Array(materials);
        if let Some(view) = texture {
            document["images"] = json!([{ "bufferView": view, "mimeType": "image/png" }]);
            document["textures"] = json!([{ "source": 0 }]);
        }
    }
}

/// The descriptions as they were read, with the data of the images.
fn describe_as_read(found: &Descriptions, document: &mut Value, views: &mut Views) {
    for (name, list) in &found.lists {
        document[name] = list.clone();
    }
    for (i, image) in found.images.iter().enumerate() {
        if let Some(image) = image {
            document["images"][i]["bufferView"] = json!(views.add(image.len() as u64, None));
        }
    }
    let mut used = BTreeSet::new();
    found.lists.values().for_each(|list| extensions(list, &mut used));
    let required: Vec<&String> = found.required.iter().filter(|name| used.contains(name.as_str())).collect();
    if !required.is_empty() {
        document["extensionsRequired"] = json!(required);
    }
    if !used.is_empty() {
        document["extensionsUsed"] = json!(used);
    }
}

/// The names of the extensions in a description; the parser of documents limits its depth.
fn extensions<'d>(value: &'d Value, used: &mut BTreeSet<&'d str>) {
    match value {
        Value::Array(values) => values.iter().for_each(|value| extensions(value, used)),
        Value::Object(entries) => {
            if let Some(Value::Object(own)) = entries.get("extensions") {
                used.extend(own.keys().map(String::as_str));
            }
            // Extras are of the author, whatever their names.
            let inside = entries.iter().filter(|(name, _)| *name != "extras");
            inside.for_each(|(_, value)| extensions(value, used));
        }
        _ => {}
    }
}
