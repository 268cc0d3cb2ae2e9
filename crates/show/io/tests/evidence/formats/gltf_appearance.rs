//! How glTF meshes look: read, and written again.

use super::gltf::Builder;
use pompeiu_core::TriMesh;
use pompeiu_io::{
    Appearance, Attributes, CornerValues, OutputFormat, read, read_appearance, write, write_with,
};
use serde_json::{Value, json};
use std::f64::consts::FRAC_1_SQRT_2;
use std::fs;
use std::path::Path;

/// A red pixel.
const PNG: &[u8] = b"\x89PNG\r\n\x1a\n and no more";

fn reals(builder: &mut Builder, values: &[f32], shape: &str) -> usize {
    let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
    let view = builder.view(&bytes, None);
    let components = match shape {
        "VEC2" => 2,
        "VEC3" => 3,
        _ => 4,
    };
    let count = values.len() / components;
    builder.accessor(json!({ "bufferView": view, "componentType": 5126, "count": count, "type": shape }))
}

/// A roof of two squares that meet at a right angle in the x axis. Each has vertices of its own, and a material of its own.
fn roof() -> (Builder, Value) {
    let mut builder = Builder::default();
    let mut primitives = Vec::new();
    for (material, up) in [(0, [0.0, 0.0, 1.0]), (1, [0.0, -1.0, 0.0])] {
        let far: [f32; 3] = if material == 0 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, -1.0] };
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, far[1], far[2]], far];
        let position = builder.positions(&corners);
        let normal = reals(&mut builder, &[up; 4].concat(), "VEC3");
        let shift = 0.5 * material as f32;
        let places: Vec<f32> = corners.iter().flat_map(|p| [0.25 + p[0] / 2.0, shift + p[1] / 4.0]).collect();
        let other: Vec<f32> = corners.iter().flat_map(|p| [p[0], 0.125]).collect();
        let sets = [reals(&mut builder, &places, "VEC2"), reals(&mut builder, &other, "VEC2")];
        let colors = builder.view(&[255, 0, 51, 128].repeat(4), None);
        let colors = builder
            .accessor(json!({ "bufferView": colors, "componentType": 5121, "normalized": true,
            "count": 4, "type": "VEC4" }));
        let order: [u8; 6] = if material == 0 { [0, 1, 2, 0, 2, 3] } else { [0, 2, 1, 0, 3, 2] };
        let indices = builder.indices(&order, 5121, 6);
        let attributes = json!({ "POSITION": position, "NORMAL": normal, "TEXCOORD_0": sets[0],
            "TEXCOORD_1": sets[1], "COLOR_0": colors });
        primitives.push(json!({ "attributes": attributes, "indices": indices, "material": material }));
    }
    let image = builder.view(PNG, None);
    let transform = json!({ "KHR_texture_transform": { "scale": [2, 2], "texCoord": 1 } });
    let rest = json!({
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": primitives }],
        "materials": [
            { "name": "tiles", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "extensions": transform } } },
            { "name": "tiles", "normalTexture": { "index": 0, "texCoord": 1 }, "alphaMode": "BLEND",
                "extensions": { "KHR_materials_ior": { "ior": 1.4 } }, "extras": { "extensions": { "mine": 1 } } },
        ],
        "textures": [{ "source": 0, "sampler": 0 }],
        "samplers": [{ "wrapS": 33071 }],
        "images": [{ "bufferView": image, "name": "red" }],
        "extensionsUsed": ["KHR_texture_transform", "KHR_materials_ior", "KHR_lights_punctual"],
        "extensionsRequired": ["KHR_texture_transform"],
    });
    (builder, rest)
}

fn read_both(path: &Path) -> (TriMesh, Appearance) {
    let mesh = read(path).unwrap().mesh;
    let appearance = read_appearance(path, &mesh).unwrap();
    (mesh, appearance)
}

fn at_corners<const N: usize>(values: &CornerValues<N>) -> Vec<[[f64; N]; 3]> {
    values.corners.iter().map(|face| face.map(|i| values.values[i as usize])).collect()
}

fn document_of(glb: &[u8]) -> Value {
    let length = u32::from_le_bytes(glb[12..16].try_into().unwrap()) as usize;
    serde_json::from_slice(&glb[20..20 + length]).unwrap()
}

#[test]
fn all_that_is_read_is_written_and_read_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("roof.gltf");
    let (builder, rest) = roof();
    fs::write(&path, builder.document(&rest).to_string()).unwrap();
    let (mesh, found) = read_both(&path);
    assert_eq!(mesh.positions().len(), 6, "both squares share the vertices of the edge between them");
    assert_eq!(found.colors.as_ref().unwrap()[..], [[255, 0, 124]; 6], "a fifth of the light is 124 in sRGB");
    assert_eq!(found.linear_colors.as_ref().unwrap().values[0], [1.0, 0.0, 0.2, 128.0 / 255.0]);
    assert_eq!(found.texture.len(), 2);
    assert_eq!(at_corners(&found.texture[0])[0][0], [0.25, 1.0]);
    assert_eq!(at_corners(&found.texture[0])[2][0], [0.25, 0.5], "a seam");
    assert_eq!(at_corners(&found.texture[1])[3], [[0.0, 0.875], [0.0, 0.875], [1.0, 0.875]]);
    let normals = at_corners(found.normals.as_ref().unwrap());
    assert_eq!((normals[0][0], normals[2][0]), ([0.0, 0.0, 1.0], [0.0, -1.0, 0.0]));
    let materials = found.materials.as_ref().unwrap();
    assert_eq!(materials.names, ["", "tiles", "tiles-1"]);
    assert_eq!(materials.faces, [1, 1, 2, 2]);
    assert_eq!(materials.descriptions.as_ref().unwrap().image_count(), 1);
    assert_eq!(found.left_out, [""; 0]);

    let glb = folder.path().join("roof.glb");
    let attributes = Attributes::for_mesh(&mesh).with_appearance(found.clone()).unwrap();
    write_with(&glb, &mesh, &attributes).unwrap();
    let bytes = fs::read(&glb).unwrap();
    gltf::Gltf::from_slice_without_validation(&bytes).expect("a document");
    let document = document_of(&bytes);
    for list in ["materials", "textures", "samplers"] {
        assert_eq!(document[list], rest[list], "{list}");
    }
    assert_eq!(document["extensionsUsed"], json!(["KHR_materials_ior", "KHR_texture_transform"]));
    assert_eq!(document["extensionsRequired"], json!(["KHR_texture_transform"]));
    assert_eq!(
        (&document["images"][0]["name"], &document["images"][0]["mimeType"]),
        (&json!("red"), &json!("image/png"))
    );
    assert!(bytes.windows(PNG.len()).any(|part| part == PNG));

    let (again, mut anew) = read_both(&glb);
    assert_eq!((again.positions(), again.faces()), (mesh.positions(), mesh.faces()));
    assert_eq!((&anew.colors, &anew.left_out), (&found.colors, &found.left_out));
    assert_eq!(
        at_corners(anew.linear_colors.as_ref().unwrap()),
        at_corners(found.linear_colors.as_ref().unwrap())
    );
    assert_eq!(at_corners(anew.normals.as_ref().unwrap()), at_corners(found.normals.as_ref().unwrap()));
    for (a, b) in anew.texture.iter().zip(&found.texture) {
        assert_eq!(at_corners(a), at_corners(b));
    }
    assert_eq!(anew.materials, found.materials);

    // Materials follow the sets of texture coordinates to other places.
    anew.materials.as_mut().unwrap().descriptions.as_mut().unwrap().shift_texture_sets(1);
    let first = anew.texture[0].clone();
    anew.texture.insert(0, first);
    let attributes = Attributes::for_mesh(&mesh).with_appearance(anew).unwrap();
    write_with(&glb, &mesh, &attributes).unwrap();
    let document = document_of(&fs::read(&glb).unwrap());
    let texture = &document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    assert_eq!(texture["texCoord"], 1);
    assert_eq!(texture["extensions"]["KHR_texture_transform"]["texCoord"], 2);
    assert_eq!(document["materials"][1]["normalTexture"]["texCoord"], 2);
}

#[test]
fn normals_turn_with_their_nodes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("node.gltf");
    let (builder, mut rest) = roof();
    let s = FRAC_1_SQRT_2;
    // A shear of the roof's first normal: scale 2 along z, then an eighth turn about x; and a mirror.
    let eighth = [(std::f64::consts::PI / 8.0).sin(), 0.0, 0.0, (std::f64::consts::PI / 8.0).cos()];
    for (node, expected) in [
        (json!({ "mesh": 0, "scale": [1, 1, 2], "rotation": eighth }), [0.0, -s, s]),
        (json!({ "mesh": 0, "scale": [1, 1, -3] }), [0.0, 0.0, -1.0]),
    ] {
        rest["nodes"][0] = node;
        fs::write(&path, builder.document(&rest).to_string()).unwrap();
        let (mesh, found) = read_both(&path);
        let normal = at_corners(&found.normals.unwrap())[0][0];
        assert!((0..3).all(|i| (normal[i] - expected[i]).abs() < 1e-12), "{normal:?} {expected:?}");
        // The outside of the faces is where the normals point.
        let [p, q, r] = mesh.faces()[0].map(|v| mesh.positions()[v as usize]);
        let [a, b] = [q, r].map(|to| [to[0] - p[0], to[1] - p[1], to[2] - p[2]]);
        let outside = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        assert!((0..3).map(|i| outside[i] * normal[i]).sum::<f64>() > 0.0);
    }
}

#[test]
fn what_is_left_out_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rich.gltf");
    let (builder, mut rest) = roof();
    rest["animations"] = json!([{}]);
    rest["skins"] = json!([{}]);
    rest["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0, "translation": [0, 0, 9] }]);
    let attributes = rest["meshes"][0]["primitives"][0]["attributes"].clone();
    rest["meshes"][0]["primitives"][0]["attributes"]["TANGENT"] = attributes["COLOR_0"].clone();
    rest["meshes"][0]["primitives"][1]["attributes"].as_object_mut().unwrap().remove("NORMAL");
    fs::write(&path, builder.document(&rest).to_string()).unwrap();
    let (_, found) = read_both(&path);
    assert_eq!(found.normals, None);
    let expected = ["animations", "normals, which some faces lack", "separate nodes", "skins", "tangents"];
    assert_eq!(found.left_out, expected);
}

#[test]
fn formats_say_what_they_have_no_place_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("roof.gltf");
    let (builder, rest) = roof();
    fs::write(&path, builder.document(&rest).to_string()).unwrap();
    let (mesh, found) = read_both(&path);
    let all = Attributes::for_mesh(&mesh).with_appearance(found).unwrap();
    for (format, missing) in [
        (OutputFormat::Obj, "OBJ has no place for further sets of texture coordinates"),
        (OutputFormat::Ply, "PLY has no place for texture coordinates"),
        (OutputFormat::Stl, "STL has no place for vertex colours"),
    ] {
        let error = write_with(folder.path().join(format!("a.{}", format.suffix())), &mesh, &all);
        assert!(error.unwrap_err().to_string().ends_with(missing));
    }
}

#[test]
fn damaged_appearance_is_an_error_and_damaged_images_cost_no_memory() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("damaged.gltf");
    let (mut builder, good) = roof();
    let large = builder.view(&vec![0; 100_000], None);
    let outcome = |change: &dyn Fn(&mut Value)| {
        let mut document = builder.document(&good);
        change(&mut document);
        fs::write(&path, document.to_string()).unwrap();
        let mesh = read(&path).unwrap().mesh;
        read_appearance(&path, &mesh).map_err(|error| error.to_string())
    };
    let attribute = |name: &'static str, value: Value| {
        move |document: &mut Value| document["meshes"][0]["primitives"][0]["attributes"][name] = value.clone()
    };
    for (change, part) in [
        (attribute("NORMAL", json!(5)), "accessor 5 has 6 values for 4 vertices"),
        (attribute("NORMAL", json!(2)), "accessor 2 does not hold VEC3 of numbers"),
        (attribute("COLOR_0", json!(2)), "accessor 2 does not hold VEC4 of numbers"),
        (attribute("TEXCOORD_0", json!(99)), "accessor 99 does not exist"),
    ] {
        let problem = outcome(&change).unwrap_err();
        assert!(problem.contains(part), "{problem}");
    }
    let many = outcome(&|document| {
        document["images"] = json!(vec![json!({ "bufferView": large, "mimeType": "image/png" }); 800]);
    });
    assert!(many.unwrap_err().contains("the images take more than"));
    let nowhere = outcome(&|document| document["images"] = json!([{ "bufferView": 77 }]));
    assert!(nowhere.unwrap_err().contains("image 0: buffer view 77 does not exist"));
    // An image that is not there stays named; materials that do not exist are none.
    let absent = outcome(&|document| {
        document["images"] = json!([{ "uri": "absent.png" }]);
        document["meshes"][0]["primitives"][0]["material"] = json!(7);
        document["materials"][0]["name"] = json!(5);
    });
    let materials = absent.unwrap().materials.unwrap();
    assert_eq!((materials.names[1].as_str(), &materials.faces[..]), ("material-0", &[0, 0, 2, 2][..]));
    assert_eq!(materials.descriptions.unwrap().image_count(), 0);
}

#[test]
fn vertices_of_one_position_become_one_even_where_numbers_are_none() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("soup.glb");
    let (positions, faces) = pompeiu_core::mesh::shapes::icosphere(1.0, 2).unwrap().into_parts();
    let corners: Vec<[f64; 3]> =
        faces.as_flattened().iter().map(|v| positions[*v as usize].map(|x| f64::from(x as f32))).collect();
    let soup: Vec<[u32; 3]> = (0..faces.len() as u32).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]).collect();
    write(&path, &TriMesh::new(corners, soup).unwrap()).unwrap();
    assert_eq!(
        read(&path).unwrap().mesh.positions().len(),
        3 * faces.len(),
        "corners of a soup are vertices of their own"
    );
    let mesh = TriMesh::new(positions, faces).unwrap();
    write(&path, &mesh).unwrap();
    assert_eq!(read(&path).unwrap().mesh.positions().len(), mesh.positions().len());
    let mut builder = Builder::default();
    let mut infinite = vec![[f32::NAN; 3]; 30_000];
    infinite[0] = [0.0; 3];
    let position = builder.positions(&infinite);
    let rest = json!({ "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": position } }] }] });
    let path = folder.path().join("nan.gltf");
    fs::write(&path, builder.document(&rest).to_string()).unwrap();
    let error = read(&path).unwrap_err().to_string();
    assert!(error.contains("vertex 1"), "{error}");
}

#[test]
fn vertices_at_one_position_are_told_apart_by_their_numbers() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("torn.glb");
    // Both triangles of a torn square, with colours, behind more vertices than sixteen bits count.
    let mut positions: Vec<[f64; 3]> = (0..70_000).map(|i| [f64::from(i), 5.0, 0.0]).collect();
    let square = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0; 3], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    positions.extend(square);
    let first = 70_000;
    let faces = vec![[first, first + 1, first + 2], [first + 3, first + 4, first + 5]];
    let mesh = TriMesh::new(positions, faces).unwrap();
    let colors = (0..mesh.positions().len()).map(|v| [v as u8; 3]).collect();
    let attributes = Attributes::for_mesh(&mesh).with_vertex_colors(colors).unwrap();
    write_with(&path, &mesh, &attributes).unwrap();
    let (again, look) = read_both(&path);
    assert_eq!(again, mesh);
    assert_eq!(look.left_out, [""; 0]);
    // Positions that only single precision makes equal.
    let near = vec![[1.0 + 1e-12, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    write(&path, &TriMesh::new(near, vec![[0, 2, 3], [1, 3, 2]]).unwrap()).unwrap();
    assert_eq!(read(&path).unwrap().mesh.faces(), [[0, 2, 3], [1, 3, 2]]);
}

#[test]
fn numbers_of_another_program_are_not_taken_for_ours() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("roof.gltf");
    let (mut builder, mut rest) = roof();
    let numbers = reals(&mut builder, &[0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 2.0, 3.0], "VEC2");
    rest["meshes"][0]["primitives"][0]["attributes"]["_VERTEX"] = json!(numbers);
    fs::write(&path, builder.document(&rest).to_string()).unwrap();
    assert_eq!(read(&path).unwrap().mesh.positions().len(), 6);
}
