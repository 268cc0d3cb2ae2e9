//! A part with objects and what is built of them.

use crate::formats::gltf::transform::Transform;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::collections::{BTreeSet, HashMap};
use std::io::BufRead;

/// The objects of a part by number, and what it builds.
#[derive(Debug, Default)]
pub(super) struct Model {
    /// Millimetres in a unit of its coordinates.
    pub(super) millimetres: f64,
    pub(super) objects: HashMap<u32, Object>,
    pub(super) items: Vec<Reference>,
    /// Resources that are not read, in the plural.
    pub(super) left_out: BTreeSet<&'static str>,
}

/// A mesh, other objects, or both.
#[derive(Debug, Default)]
pub(super) struct Object {
    pub(super) name: Option<String>,
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) faces: Vec<[u32; 3]>,
    pub(super) components: Vec<Reference>,
}

/// An object, placed.
#[derive(Debug)]
pub(super) struct Reference {
    /// Another part, if it is there.
    pub(super) part: Option<String>,
    pub(super) object: u32,
    pub(super) transform: Transform,
}

impl Model {
    /// The other parts that are referred to.
    pub(super) fn other_parts(&self) -> impl Iterator<Item = &str> {
        // The order decides only which error is told of several; the parts are sorted by what refers to them.
        let mut numbers: Vec<&u32> = self.objects.keys().collect();
        numbers.sort_unstable();
        let components = numbers.into_iter().flat_map(|number| &self.objects[number].components);
        self.items.iter().chain(components).filter_map(|reference| reference.part.as_deref())
    }

    pub(super) fn parse(xml: &mut dyn BufRead) -> Result<Self, String> {
        let mut reader = Reader::from_reader(xml);
        let mut model = Self { millimetres: 1.0, ..Self::default() };
        let mut open: Option<(u32, Object)> = None;
        let mut buffer = Vec::new();
        loop {
            buffer.clear();
            match reader.read_event_into(&mut buffer).map_err(|error| error.to_string())? {
                Event::Start(tag) => model.begin(&tag, &mut open)?,
                Event::Empty(tag) => {
                    model.begin(&tag, &mut open)?;
                    model.end(tag.name().as_ref(), &mut open)?;
                }
                Event::End(tag) => model.end(tag.name().as_ref(), &mut open)?,
                Event::Eof if open.is_some() => return Err("the XML ends within an object".to_owned()),
                Event::Eof => return Ok(model),
                _ => {}
            }
        }
    }

    /// Elements of extensions have a prefix: what is called `vertex` in a slice is none of a mesh.
    fn begin(&mut self, tag: &BytesStart<'_>, open: &mut Option<(u32, Object)>) -> Result<(), String> {
        match (tag.name().as_ref(), open.as_mut()) {
            (b"model", None) => self.millimetres = unit(tag)?,
            (b"object", None) => {
                let object = Object { name: text(tag, "name")?, ..Object::default() };
                *open = Some((whole(tag, "id")?, object));
            }
            (b"item", None) => self.items.push(reference(tag)?),
            (b"component", Some((_, object))) => object.components.push(reference(tag)?),
            (b"vertex", Some((_, object))) => object.positions.push(numbers(tag, ["x", "y", "z"])?),
            (b"triangle", Some((_, object))) => object.faces.push(corners(tag)?),
            (name, _) => self.left_out.extend(resource(name)),
        }
        Ok(())
    }

    fn end(&mut self, name: &[u8], open: &mut Option<(u32, Object)>) -> Result<(), String> {
        if name != b"object" {
            return Ok(());
        }
        let Some((id, object)) = open.take() else { return Ok(()) };
        let vertices = object.positions.len();
        let wrong = object
            .faces
            .iter()
            .enumerate()
            .find(|(_, corners)| corners.iter().any(|v| *v as usize >= vertices));
        if let Some((face, [a, b, c])) = wrong {
            return Err(format!(
                "object {id}: triangle {face} has corners {a}, {b} and {c}, but there are only {vertices} vertices (the first is 0)"
            ));
        }
        if self.objects.insert(id, object).is_some() {
            return Err(format!("two objects have the number {id}, expected one"));
        }
        Ok(())
    }
}

/// A resource that is not read, in the plural. Those of extensions have a prefix, which files choose.
fn resource(name: &[u8]) -> Option<&'static str> {
    let local = name.rsplit(|byte| *byte == b':').next()?;
    Some(match local {
        b"basematerials" | b"compositematerials" => "materials",
        b"colorgroup" => "colours",
        b"texture2dgroup" => "textures",
        b"beamlattice" => "beams",
        b"slicestack" => "slices",
        _ => return None,
    })
}

/// Millimetres in the unit of a model.
fn unit(tag: &BytesStart<'_>) -> Result<f64, String> {
    let Some(unit) = text(tag, "unit")? else { return Ok(1.0) };
    Ok(match unit.as_str() {
        "micron" => 0.001,
        "millimeter" => 1.0,
        "centimeter" => 10.0,
        "inch" => 25.4,
        "foot" => 304.8,
        "meter" => 1000.0,
        _ => {
            return Err(format!(
                "found the unit \"{unit}\", expected micron, millimeter, centimeter, inch, foot or meter"
            ));
        }
    })
}

fn reference(tag: &BytesStart<'_>) -> Result<Reference, String> {
    // The prefix of the production extension is usually `p`.
    let part = attributes(tag).find_map(|found| match found {
        Ok((name, value)) if name == b"path" || name.ends_with(b":path") => Some(value),
        _ => None,
    });
    let part = part.map(|value| String::from_utf8_lossy(&value).trim_start_matches('/').to_owned());
    let transform = match text(tag, "transform")? {
        Some(text) => transform(&text)?,
        None => Transform::IDENTITY,
    };
    Ok(Reference { part, object: whole(tag, "objectid")?, transform })
}

/// Four rows of three numbers, by which rows of coordinates are multiplied.
fn transform(text: &str) -> Result<Transform, String> {
    let expected = || format!("found the transform \"{text}\", expected twelve numbers");
    let mut words = text.split_ascii_whitespace();
    let mut m = [0.0; 12];
    for x in &mut m {
        *x = words.next().and_then(|word| fast_float2::parse(word).ok()).ok_or_else(expected)?;
    }
    if words.next().is_some() {
        return Err(expected());
    }
    Ok(Transform::from_rows([0, 1, 2].map(|k| [m[k], m[3 + k], m[6 + k], m[9 + k]])))
}

type Attribute<'t> = Result<(&'t [u8], std::borrow::Cow<'t, [u8]>), String>;

fn attributes<'t>(tag: &'t BytesStart<'_>) -> impl Iterator<Item = Attribute<'t>> {
    let mut list = tag.attributes();
    // Comparing each with all others would take a square of their number.
    list.with_checks(false);
    list.map(|found| {
        let found = found.map_err(|error| error.to_string())?;
        Ok((found.key.into_inner(), found.value))
    })
}

/// The value of an attribute as it is in the file.
fn raw<'t>(tag: &'t BytesStart<'_>, name: &str) -> Result<Option<std::borrow::Cow<'t, [u8]>>, String> {
    for found in attributes(tag) {
        let (key, value) = found?;
        if key == name.as_bytes() {
            return Ok(Some(value));
        }
    }
    Ok(None)
}

/// The text of an attribute.
pub(super) fn text(tag: &BytesStart<'_>, name: &str) -> Result<Option<String>, String> {
    let Some(value) = raw(tag, name)? else { return Ok(None) };
    let value = String::from_utf8_lossy(&value);
    Ok(Some(quick_xml::escape::unescape(&value).map_err(|error| error.to_string())?.into_owned()))
}

fn missing(tag: &BytesStart<'_>, name: &str) -> String {
    format!("found a {} without {name}", String::from_utf8_lossy(tag.name().as_ref()))
}

fn numbers<const N: usize>(tag: &BytesStart<'_>, names: [&str; N]) -> Result<[f64; N], String> {
    let mut found = [0.0; N];
    for (x, name) in found.iter_mut().zip(names) {
        let value = raw(tag, name)?.ok_or_else(|| missing(tag, name))?;
        *x = fast_float2::parse(value.trim_ascii()).map_err(|_| {
            format!("found {name}=\"{}\" of a vertex, expected a number", String::from_utf8_lossy(&value))
        })?;
    }
    Ok(found)
}

fn corners(tag: &BytesStart<'_>) -> Result<[u32; 3], String> {
    Ok([whole(tag, "v1")?, whole(tag, "v2")?, whole(tag, "v3")?])
}

fn whole(tag: &BytesStart<'_>, name: &str) -> Result<u32, String> {
    let value = raw(tag, name)?.ok_or_else(|| missing(tag, name))?;
    let parsed = std::str::from_utf8(&value).ok().and_then(|text| text.trim().parse().ok());
    parsed.ok_or_else(|| {
        format!("found {name}=\"{}\", expected a whole number", String::from_utf8_lossy(&value))
    })
}
