//! 3MF: archives made here, read and written.

use super::{read_as, refusal, triangles};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{icosphere, torus};
use pompeiu_io::{Attributes, Format, OutputFormat, encode, read_bytes};
use pompeiu_testkit::effort::cases;
use proptest::prelude::*;
use std::io::{Cursor, Read, Write};
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

pub(super) fn archive(parts: &[(&str, &str)]) -> Vec<u8> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in parts {
        archive.start_file(*name, SimpleFileOptions::default()).unwrap();
        archive.write_all(text.as_bytes()).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

const TRIANGLE: &str = "<mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='.5'/></vertices>\
    <triangles><triangle v1='0' v2='1' v3='2' pid='7'/></triangles></mesh>";

fn model(unit: &str, objects: &str, items: &str) -> Vec<u8> {
    let text = format!("<model {unit}><resources>{objects}</resources><build>{items}</build></model>");
    archive(&[("3D/3dmodel.model", &text)])
}

#[test]
fn units_become_millimetres() {
    let object = format!("<object id='1'>{TRIANGLE}</object>");
    for (unit, factor) in [
        ("", 1.0),
        ("unit='micron'", 0.001),
        ("unit='millimeter'", 1.0),
        ("unit='centimeter'", 10.0),
        ("unit='inch'", 25.4),
        ("unit='foot'", 304.8),
        ("unit='meter'", 1000.0),
    ] {
        let read = read_bytes(&model(unit, &object, "<item objectid='1'/>"), None).unwrap();
        assert_eq!(read.format, Format::ThreeMf);
        let expected = [[0.0; 3], [factor, 0.0, 0.0], [0.0, factor, 0.5 * factor]];
        assert_eq!(read.mesh.positions(), expected, "{unit}");
    }
    let problem = refusal(Format::ThreeMf, &model("unit='cubit'", &object, ""));
    assert!(problem.contains("found the unit \"cubit\""), "{problem}");
}

#[test]
fn items_components_and_other_parts_are_placed() {
    let other = format!("<model><resources><object id='5'>{TRIANGLE}</object></resources><build/></model>");
    // Rows of coordinates are multiplied from the left: x to y, y to -x, and a translation.
    let turned = "0 1 0 -1 0 0 0 0 1 10 20 30";
    let mirrored = "-1 0 0 0 1 0 0 0 1 0 0 0";
    let objects = format!(
        "<object id='2' name='two &amp; more'><components><component objectid='3' transform='{turned}'/>\
         <component p:path='/3D/Objects/other.model' objectid='5' transform='{mirrored}'/></components></object>\
         <object id='3'>{TRIANGLE}<s:slice><s:vertex x='9' y='9' z='9'/></s:slice></object>"
    );
    let items = "<item objectid='2' transform='1 0 0 0 1 0 0 0 1 100 0 0'/><item objectid='3'/>";
    let root = format!("<model><resources>{objects}</resources><build>{items}</build></model>");
    let relationships = "<Relationships><Relationship Target='/thumb.png' Type='thumbnail'/>\
        <Relationship Target='/3D/part.model' Type='http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel'/></Relationships>";
    let parts =
        [("_rels/.rels", relationships), ("3D/part.model", &root), ("3D/Objects/other.model", &other)];
    let read = read_as(Format::ThreeMf, &archive(&parts));
    let expected = [
        [[110.0, 20.0, 30.0], [110.0, 21.0, 30.0], [109.0, 20.0, 30.5]],
        // A mirror turns faces over.
        [[100.0, 0.0, 0.0], [100.0, 1.0, 0.5], [99.0, 0.0, 0.0]],
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.5]],
    ];
    assert_eq!(triangles(&read.mesh), expected);
    let groups: Vec<_> = read.groups.iter().map(|group| (group.name.as_str(), group.faces.clone())).collect();
    assert_eq!(groups, [("two & more", 0..2), ("object 3", 2..3)]);
}

#[test]
fn what_is_wrong_is_named() {
    let object = |id: u32, inner: &str| format!("<object id='{id}'>{inner}</object>");
    let component = |id: u32| {
        format!("<components><component objectid='{id}'/><component objectid='{id}'/></components>")
    };
    let one = "<item objectid='1'/>";
    let wrong_corner = TRIANGLE.replace("v2='1'", "v2='3'");
    let chain: String = (1..40).map(|i| object(i, &component(i + 1))).chain([object(40, TRIANGLE)]).collect();
    for (file, problem) in [
        (archive(&[("a.txt", "")]), "a zip archive: found no part 3D/3dmodel.model, expected a 3MF file"),
        (model("", "", ""), "3D/3dmodel.model: found no item in the build, expected at least one"),
        (model("", "", one), "3D/3dmodel.model: found no object 1, which is referred to"),
        (
            model("", &object(1, &wrong_corner), one),
            "object 1: triangle 0 has corners 0, 3 and 2, but there are only 3 vertices",
        ),
        (model("", &object(1, &component(1)), one), "components are nested deeper than 64, or in a circle"),
        (model("", &chain, one), "objects that are placed often grow beyond 67108864 bytes"),
        (model("", &TRIANGLE.replace("x='1'", "x='one'"), one), "found no object 1"),
        (
            model("", &object(1, &TRIANGLE.replace("x='1'", "x='one'")), one),
            "found x=\"one\" of a vertex, expected a number",
        ),
        (model("", &object(1, &TRIANGLE.replace("x='1'", "")), one), "found a vertex without x"),
        (model("", "<object id='1'>", one), "3D/3dmodel.model: "),
    ] {
        let found = refusal(Format::ThreeMf, &file);
        assert!(found.contains(problem), "{found}, expected {problem}");
        assert!(!found.contains('\n'), "{found}");
    }
}

/// 200 MB of blanks shrink to 200 kB: they are not unpacked.
#[test]
fn parts_that_grow_without_end_are_refused() {
    let bomb = model("", &" ".repeat(200 << 20), "");
    assert!(bomb.len() < 1 << 20);
    let problem = refusal(Format::ThreeMf, &bomb);
    assert!(problem.contains("the parts unpack to more than 67108864 bytes"), "{problem}");
}

fn encoded(mesh: &TriMesh) -> Vec<u8> {
    let mut bytes = Vec::new();
    encode(&mut bytes, OutputFormat::ThreeMf, mesh, &Attributes::for_mesh(mesh)).unwrap();
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(64)))]

    #[test]
    fn every_bit_of_every_coordinate_is_kept(positions in prop::collection::vec(prop::array::uniform3(any::<f64>()), 3..30)) {
        let positions: Vec<_> = positions.into_iter().map(|p| p.map(|x| if x.abs() <= TriMesh::MAX_COORDINATE { x } else { -0.0 })).collect();
        let n = positions.len() as u32;
        let faces = (0..n - 2).map(|v| [v, v + 1, v + 2]).collect();
        let mesh = TriMesh::new(positions, faces).unwrap();
        let read = read_bytes(&encoded(&mesh), None).unwrap().mesh;
        let bits = |mesh: &TriMesh| mesh.positions().iter().map(|p| p.map(f64::to_bits)).collect::<Vec<_>>();
        prop_assert_eq!(bits(&read), bits(&mesh));
        prop_assert_eq!(read.faces(), mesh.faces());
    }
}

/// Another parser of XML finds what was written, and the same mesh gives the same bytes.
#[test]
fn what_is_written_is_a_package_of_one_object() {
    let mesh = torus(1.0, 0.25, 12, 8).unwrap();
    let bytes = encoded(&mesh);
    assert_eq!(bytes, encoded(&mesh));
    let mut archive = ZipArchive::new(Cursor::new(&bytes)).unwrap();
    assert_eq!(
        archive.file_names().collect::<Vec<_>>(),
        ["[Content_Types].xml", "_rels/.rels", "3D/3dmodel.model"]
    );
    let mut text = String::new();
    archive.by_name("3D/3dmodel.model").unwrap().read_to_string(&mut text).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    assert_eq!(document.root_element().attribute("unit"), Some("millimeter"));
    let numbers = |name: &str, attributes: [&str; 3]| -> Vec<[f64; 3]> {
        let elements = document.descendants().filter(|node| node.tag_name().name() == name);
        elements.map(|node| attributes.map(|a| node.attribute(a).unwrap().parse().unwrap())).collect()
    };
    assert_eq!(numbers("vertex", ["x", "y", "z"]), mesh.positions());
    let faces: Vec<_> = mesh.faces().iter().map(|face| face.map(f64::from)).collect();
    assert_eq!(numbers("triangle", ["v1", "v2", "v3"]), faces);
}

#[test]
fn faces_with_a_vertex_twice_are_refused() {
    let sphere = icosphere(1.0, 0).unwrap();
    let faces = vec![[0, 1, 2], [3, 3, 4]];
    let mesh = TriMesh::new(sphere.positions().to_vec(), faces).unwrap();
    let error = encode(Vec::new(), OutputFormat::ThreeMf, &mesh, &Attributes::for_mesh(&mesh)).unwrap_err();
    assert!(error.to_string().contains("a vertex twice"), "{error}");
}
