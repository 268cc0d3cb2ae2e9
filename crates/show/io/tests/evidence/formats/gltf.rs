//! glTF documents with one feature each.

use super::{read_as, refusal, triangles};
use base64::{Engine, prelude::BASE64_STANDARD};
use pompeiu_io::{Format, ReadError, read};
use serde_json::{Value, json};
use std::f64::consts::FRAC_1_SQRT_2;
use std::fs;

/// A buffer under construction and the views of it.
#[derive(Default)]
pub(super) struct Builder {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Builder {
    pub(super) fn view(&mut self, bytes: &[u8], stride: Option<usize>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(stride) = stride {
            view["byteStride"] = json!(stride);
        }
        self.bytes.extend_from_slice(bytes);
        self.views.push(view);
        self.views.len() - 1
    }

    pub(super) fn accessor(&mut self, accessor: Value) -> usize {
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    pub(super) fn positions(&mut self, positions: &[[f32; 3]]) -> usize {
        let bytes: Vec<u8> = positions.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes, None);
        self.accessor(
            json!({ "bufferView": view, "componentType": 5126, "count": positions.len(), "type": "VEC3" }),
        )
    }

    pub(super) fn indices(&mut self, bytes: &[u8], component_type: u32, count: usize) -> usize {
        let view = self.view(bytes, None);
        self.accessor(
            json!({ "bufferView": view, "componentType": component_type, "count": count, "type": "SCALAR" }),
        )
    }

    pub(super) fn document(&self, rest: &Value) -> Value {
        let uri = format!("data:application/octet-stream;base64,{}", BASE64_STANDARD.encode(&self.bytes));
        let mut document = json!({
            "asset": { "version": "2.0" },
            "buffers": [{ "uri": uri, "byteLength": self.bytes.len() }],
            "bufferViews": self.views,
            "accessors": self.accessors,
        });
        for (key, value) in rest.as_object().unwrap() {
            document[key] = value.clone();
        }
        document
    }
}

const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];

fn one_primitive(primitive: &Value) -> Value {
    json!({ "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }], "meshes": [{ "primitives": [primitive] }] })
}

fn faces(document: &Value) -> Vec<[u32; 3]> {
    read_as(Format::Gltf, document.to_string().as_bytes()).mesh.faces().to_vec()
}

fn error(document: &Value) -> String {
    refusal(Format::Gltf, document.to_string().as_bytes())
}

#[test]
fn every_way_to_make_triangles() {
    let mut builder = Builder::default();
    let position = builder.positions(&SQUARE);
    let bytes = builder.indices(&[3, 2, 1, 0, 1, 2], 5121, 6);
    let shorts = builder.indices(&[3_u16, 2, 1, 0, 1, 2].map(u16::to_le_bytes).concat(), 5123, 6);
    let words = builder.indices(&[3_u32, 2, 1, 0, 1, 2].map(u32::to_le_bytes).concat(), 5125, 6);
    for indices in [bytes, shorts, words] {
        let of = |mode: u32| {
            let primitive =
                json!({ "attributes": { "POSITION": position }, "indices": indices, "mode": mode });
            faces(&builder.document(&one_primitive(&primitive)))
        };
        assert_eq!(of(4), [[3, 2, 1], [0, 1, 2]]);
        assert_eq!(of(5), [[3, 2, 1], [2, 0, 1], [1, 0, 1], [0, 2, 1]]);
        assert_eq!(of(6), [[2, 1, 3], [1, 0, 3], [0, 1, 3], [1, 2, 3]]);
    }
    let of = |mode: u32| {
        faces(
            &builder
                .document(&one_primitive(&json!({ "attributes": { "POSITION": position }, "mode": mode }))),
        )
    };
    assert_eq!(of(5), [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(of(6), [[1, 2, 0], [2, 3, 0]]);
    let not_three = json!({ "attributes": { "POSITION": position } });
    let message = error(&builder.document(&one_primitive(&not_three)));
    assert_eq!(message, "mesh 0, primitive 0: 4 corners, expected three for each triangle");
}

#[test]
fn points_and_lines_are_counted_and_left_out() {
    let mut builder = Builder::default();
    let position = builder.positions(&SQUARE);
    let primitive = |mode: u32| json!({ "attributes": { "POSITION": position }, "mode": mode });
    let mut rest = one_primitive(&primitive(5));
    rest["meshes"][0]["primitives"] = (0..6).map(primitive).filter(|p| p["mode"] != 4).collect();
    let read = read_as(Format::Gltf, builder.document(&rest).to_string().as_bytes());
    assert_eq!(read.mesh.faces(), [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(read.mesh.positions().len(), 4, "primitives share their vertices");
    assert_eq!(read.faces_dropped, 4 + 2 + 3 + 3);
}

#[test]
fn nodes_place_meshes() {
    let mut builder = Builder::default();
    let position = builder.positions(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    let corners = |nodes: Value| {
        let rest = json!({ "scene": 0, "scenes": [{ "nodes": [0] }], "nodes": nodes,
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": position } }] }] });
        triangles(&read_as(Format::Gltf, builder.document(&rest).to_string().as_bytes()).mesh)
    };
    let x_y_z = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(corners(json!([{ "mesh": 0 }])), [x_y_z]);
    // Translations that single precision cannot hold are kept exactly.
    let shifted = x_y_z.map(|[x, y, z]| [x + 6_378_137.015_625, y, z - 0.1]);
    assert_eq!(corners(json!([{ "mesh": 0, "translation": [6_378_137.015_625, 0, -0.1] }])), [shifted]);
    // Scale, then a quarter turn about z, then translation.
    let placed = [[10.0, 2.0, 0.0], [7.0, 0.0, 0.0], [10.0, 0.0, 4.0]];
    let quarter = [0.0, 0.0, FRAC_1_SQRT_2, FRAC_1_SQRT_2];
    let node = json!({ "mesh": 0, "scale": [2, 3, 4], "rotation": quarter, "translation": [10, 0, 0] });
    let close = |a: &[[[f64; 3]; 3]], b: [[f64; 3]; 3]| {
        let pairs = a.as_flattened().as_flattened().iter().zip(b.as_flattened());
        assert!(a.len() == 1 && pairs.into_iter().all(|(p, q)| (p - q).abs() < 1e-14), "{a:?} {b:?}");
    };
    close(&corners(json!([node])), placed);
    // The same as a matrix, column by column, below a parent that doubles and lifts.
    let matrix = [0, 2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 10, 0, 0, 1];
    let nodes = json!([{ "children": [1], "scale": [2, 2, 2], "translation": [0, 0, 1] }, { "mesh": 0, "matrix": matrix }]);
    assert_eq!(corners(nodes), [placed.map(|[x, y, z]| [2.0 * x, 2.0 * y, 2.0 * z + 1.0])]);
    // A mirror reverses the corners, so that the outside stays outside.
    let mirrored = corners(json!([{ "mesh": 0, "scale": [-1e-120, 1e-120, 1e-120] }]));
    assert_eq!(mirrored, [[[-1e-120, 0.0, 0.0], [0.0, 0.0, 1e-120], [0.0, 1e-120, 0.0]]]);
    // Two nodes show one mesh twice.
    let twice = json!([{ "children": [1, 2] }, { "mesh": 0 }, { "mesh": 0, "translation": [0, 0, 5] }]);
    assert_eq!(corners(twice), [x_y_z, x_y_z.map(|[x, y, z]| [x, y, z + 5.0])]);
}

#[test]
fn nodes_name_their_faces_and_those_below_them() {
    let mut builder = Builder::default();
    let position = builder.positions(&SQUARE[..3]);
    let mesh =
        |name: Value| json!({ "name": name, "primitives": [{ "attributes": { "POSITION": position } }] });
    let groups = |rest: &Value| {
        let read = read_as(Format::Gltf, builder.document(rest).to_string().as_bytes());
        read.groups.into_iter().map(|group| (group.name, group.faces)).collect::<Vec<_>>()
    };
    let meshes = json!([mesh(json!("plate")), mesh(Value::Null)]);
    let nodes = json!([{ "name": "car", "children": [1, 3] }, { "name": "door", "mesh": 0, "children": [2] },
        { "mesh": 0 }, { "name": "empty" }, { "mesh": 1 }]);
    let found = groups(&json!({ "nodes": nodes, "meshes": meshes }));
    let expected = [("plate", 1..2), ("door", 0..2), ("car", 0..2)];
    assert_eq!(found, expected.map(|(name, faces)| (name.to_owned(), faces)));
    assert_eq!(groups(&json!({ "meshes": meshes })), [("plate".to_owned(), 0..1)]);
}

#[test]
fn what_is_shown() {
    let mut builder = Builder::default();
    let position = builder.positions(&SQUARE[..3]);
    let base = json!({ "meshes": [{ "primitives": [{ "attributes": { "POSITION": position } }] }] });
    let lowest = |extra: Value| {
        let mut rest = base.clone();
        rest.as_object_mut().unwrap().extend(extra.as_object().unwrap().clone());
        let mesh = read_as(Format::Gltf, builder.document(&rest).to_string().as_bytes()).mesh;
        triangles(&mesh).iter().map(|t| t[0][2]).collect::<Vec<_>>()
    };
    let nodes = json!([{ "mesh": 0, "translation": [0, 0, 1] }, { "mesh": 0, "children": [2] },
        { "mesh": 0, "translation": [0, 0, 3] }]);
    let scenes = json!([{ "nodes": [0] }, { "nodes": [1] }]);
    assert_eq!(lowest(json!({ "nodes": nodes, "scenes": scenes })), [1.0]);
    assert_eq!(lowest(json!({ "nodes": nodes, "scenes": scenes, "scene": 1 })), [0.0, 3.0]);
    assert_eq!(lowest(json!({ "nodes": nodes })), [1.0, 0.0, 3.0]);
    assert_eq!(lowest(json!({})), [0.0]);
}

#[test]
fn strides_and_sparse_values() {
    let mut builder = Builder::default();
    let interleaved: Vec<u8> =
        SQUARE.iter().flat_map(|p| [p[0], p[1], p[2], 9.0, 9.0].map(f32::to_le_bytes).concat()).collect();
    // The last element need not fill its stride.
    let view = builder.view(&interleaved[..interleaved.len() - 8], Some(20));
    let strided =
        builder.accessor(json!({ "bufferView": view, "componentType": 5126, "count": 4, "type": "VEC3" }));
    let offset = builder.accessor(
        json!({ "bufferView": view, "byteOffset": 20, "componentType": 5126, "count": 3, "type": "VEC3" }),
    );
    let of = |builder: &Builder, position: usize| {
        let rest = one_primitive(&json!({ "attributes": { "POSITION": position }, "mode": 6 }));
        read_as(Format::Gltf, builder.document(&rest).to_string().as_bytes()).mesh.positions().to_vec()
    };
    let square = SQUARE.map(|p| p.map(f64::from));
    assert_eq!(of(&builder, strided), square);
    assert_eq!(of(&builder, offset), square[1..]);
    let places = builder.view(&[2, 0, 3, 0], None);
    let values = builder.view(
        &[[7.0_f32, 8.0, 9.0], [-1.0; 3]]
            .as_flattened()
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect::<Vec<_>>(),
        None,
    );
    let sparse = json!({ "count": 2, "indices": { "bufferView": places, "componentType": 5123 }, "values": { "bufferView": values } });
    let patched = builder.accessor(
        json!({ "bufferView": view, "componentType": 5126, "count": 4, "type": "VEC3", "sparse": sparse }),
    );
    assert_eq!(of(&builder, patched), [square[0], square[1], [7.0, 8.0, 9.0], [-1.0; 3]]);
    // Quantized positions: signed bytes as fractions of 127, then as they are.
    let view = builder.view(&[127, 0, 129, 0, 0, 127, 0, 0, 128, 5, 6, 0], Some(4));
    for (normalized, expected) in [
        (true, [[1.0, 0.0, -1.0], [0.0, 1.0, 0.0], [-1.0, 5.0 / 127.0, 6.0 / 127.0]]),
        (false, [[127.0, 0.0, -127.0], [0.0, 127.0, 0.0], [-128.0, 5.0, 6.0]]),
    ] {
        let accessor = builder
            .accessor(json!({ "bufferView": view, "componentType": 5120, "normalized": normalized,
            "count": 3, "type": "VEC3" }));
        assert_eq!(of(&builder, accessor), expected);
    }
}

#[test]
fn buffers_in_other_files() {
    let folder = tempfile::tempdir().unwrap();
    let mut builder = Builder::default();
    let position = builder.positions(&SQUARE[..3]);
    let mut document = builder.document(&one_primitive(&json!({ "attributes": { "POSITION": position } })));
    let gltf = folder.path().join("mesh.gltf");
    let mut outcome = |uri: &str| {
        document["buffers"][0]["uri"] = json!(uri);
        fs::write(&gltf, document.to_string()).unwrap();
        read(&gltf).map_err(|error| match error {
            ReadError::Format { cause, .. } => cause.problem,
            other => panic!("{other}"),
        })
    };
    fs::create_dir(folder.path().join("parts")).unwrap();
    fs::write(folder.path().join("parts/the data.bin"), &builder.bytes).unwrap();
    fs::write(folder.path().join("short.bin"), &builder.bytes[1..]).unwrap();
    assert_eq!(outcome("parts/the%20data.bin").unwrap().mesh.positions().len(), 3);
    assert_eq!(outcome("./parts/the data.bin").unwrap().mesh.faces(), [[0, 1, 2]]);
    for (uri, part) in [
        ("short.bin", "buffer 0 has 35 bytes, expected 36"),
        ("missing.bin", "missing.bin, which holds a part of this one; put it there"),
        ("parts", "not a regular file"),
        ("../mesh.gltf", "does not lie next to the file"),
        ("/etc/hostname", "does not lie next to the file"),
        ("https://example.org/a.bin", "does not lie next to the file"),
        ("data:text/plain,hello", "without base64"),
        ("data:;base64,a", "base64: "),
    ] {
        let problem = outcome(uri).unwrap_err();
        assert!(problem.contains(part) && problem.starts_with("accessor 0: buffer 0"), "{uri}: {problem}");
    }
    // Without faces, the missing file is the reason that is told.
    document["buffers"][0]["uri"] = json!("missing.bin");
    document["nodes"] = json!([{ "name": "empty" }]);
    fs::write(&gltf, document.to_string()).unwrap();
    let error_of = |path: &std::path::Path| read(path).unwrap_err().to_string();
    assert!(error_of(&gltf).contains("missing.bin, which holds a part"), "{}", error_of(&gltf));
    document["nodes"] = json!([{ "mesh": 0 }]);
    let in_memory = error(&{
        document["buffers"][0]["uri"] = json!("short.bin");
        document
    });
    assert!(in_memory.contains("lies in another file"), "{in_memory}");
}

#[test]
fn what_does_not_fit_is_named() {
    let mut builder = Builder::default();
    let position = builder.positions(&SQUARE[..3]);
    let indices = builder.indices(&[0, 1, 3], 5121, 3);
    let good = builder.document(&one_primitive(&json!({ "attributes": { "POSITION": position } })));
    assert_eq!(faces(&good), [[0, 1, 2]]);
    let cases: [(&str, Value, &str); 22] = [
        ("/asset/version", json!("1.0"), "glTF version \"1.0\", expected 2.0"),
        ("/scenes/0/nodes", json!([7]), "node 7 does not exist, there are 1"),
        ("/scenes/0/nodes", json!([0, 0]), "node 0 is a child twice, expected trees of nodes"),
        ("/nodes/0", json!({ "children": [0] }), "node 0 is a child twice, expected trees of nodes"),
        ("/nodes/0/mesh", json!(1), "mesh 1 does not exist, there are 1"),
        ("/nodes/0", json!({ "rotation": [0, 0, 0, 0] }), "node 0 has a transform that is not affine"),
        (
            "/nodes/0",
            json!({ "matrix": [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] }),
            "node 0 has a transform that is not affine",
        ),
        ("/meshes/0/primitives/0/attributes/POSITION", json!(9), "accessor 9 does not exist, there are 2"),
        ("/meshes/0/primitives/0/mode", json!(7), "mesh 0, primitive 0: unknown mode 7"),
        (
            "/meshes/0/primitives/0/indices",
            json!(indices),
            "face 0: mesh 0, primitive 0: vertex 3 does not exist, there are 3 (the first is 0)",
        ),
        (
            "/meshes/0/primitives/0/indices",
            json!(position),
            "mesh 0, primitive 0: accessor 0 does not hold indices, which are SCALAR unsigned integers",
        ),
        ("/accessors/0/type", json!("VEC2"), "accessor 0 does not hold positions, which are VEC3 of numbers"),
        (
            "/accessors/0/componentType",
            json!(5124),
            "accessor 0 does not hold positions, which are VEC3 of numbers",
        ),
        (
            "/accessors/0/count",
            json!(u64::MAX),
            "accessor 0: 18446744073709551615 elements of 12 bytes, one every 12 bytes from byte 0 on, \
             but the buffer view has 36 bytes",
        ),
        (
            "/accessors/0/byteOffset",
            json!(u64::MAX),
            "accessor 0: 3 elements of 12 bytes, one every 12 bytes from byte 18446744073709551615 on, \
             but the buffer view has 36 bytes",
        ),
        ("/accessors/0/bufferView", json!(5), "accessor 0: buffer view 5 does not exist, there are 2"),
        ("/accessors/0/bufferView", Value::Null, "accessor 0: no buffer view"),
        ("/bufferViews/0/byteStride", json!(8), "accessor 0: elements of 12 bytes, but one every 8 bytes"),
        (
            "/bufferViews/0/byteLength",
            json!(1_u64 << 40),
            "accessor 0: buffer view 0 has 1099511627776 bytes from byte 0 on, but buffer 0 has 39 bytes",
        ),
        ("/bufferViews/0/buffer", json!(3), "accessor 0: buffer 3 does not exist, there are 1"),
        ("/buffers/0/byteLength", json!(40), "accessor 0: buffer 0 has 39 bytes, expected 40"),
        ("/buffers/0", json!({ "byteLength": 39 }), "accessor 0: buffer 0 has no data"),
    ];
    for (at, value, message) in cases {
        let mut document = good.clone();
        let (parent, key) = at.rsplit_once('/').unwrap();
        match document.pointer_mut(parent).unwrap() {
            Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
            object => object[key] = value,
        }
        assert_eq!(error(&document), message, "{at}");
    }
    for (extension, harmless) in [("KHR_draco_mesh_compression", false), ("KHR_materials_unlit", true)] {
        let mut document = good.clone();
        document["extensionsRequired"] = json!([extension]);
        if harmless {
            assert_eq!(faces(&document), [[0, 1, 2]]);
        } else {
            assert!(error(&document).contains(extension));
        }
    }
}

#[test]
fn instances_without_end_are_refused() {
    let mut builder = Builder::default();
    let position = builder.positions(&vec![SQUARE[1]; 30_000]);
    let count = 40_000;
    let nodes: Vec<Value> = (0..count).map(|_| json!({ "mesh": 0 })).collect();
    let roots: Vec<usize> = (0..count).collect();
    let mesh = json!({ "primitives": [{ "attributes": { "POSITION": position } }] });
    let document =
        builder.document(&json!({ "nodes": nodes, "scenes": [{ "nodes": roots }], "meshes": [mesh] }));
    let message = error(&document);
    assert!(message.contains("the most that a file of this size may hold"), "{message}");
}

#[test]
fn json_errors_name_the_place() {
    assert!(
        refusal(Format::Gltf, b"{\n\"asset\": 5 }").starts_with("line 2: not a glTF document: invalid type")
    );
    let deep = format!("{{\"asset\": {{\"version\": \"2.0\"}}, \"extras\": {}", "[".repeat(100_000));
    assert!(refusal(Format::Gltf, deep.as_bytes()).starts_with("line 1: not a glTF document: "));
    let mut glb = b"glTF\x02\0\0\0\x21\0\0\0\x0D\0\0\0JSON{\"asset\":[}  ".to_vec();
    assert_eq!(glb.len(), 33);
    assert!(refusal(Format::Glb, &glb).starts_with("byte 30: "), "{}", refusal(Format::Glb, &glb));
    glb[8] += 4;
    assert_eq!(
        refusal(Format::Glb, &glb),
        "byte 33: the file ends here, expected 37 bytes as its header says"
    );
    glb[4] = 1;
    assert_eq!(refusal(Format::Glb, &glb), "byte 4: GLB version 1, expected 2");
    assert_eq!(refusal(Format::Glb, &glb[..10]), "byte 4: GLB version 1, expected 2");
    assert_eq!(
        refusal(Format::Glb, b"glTF\x02\0\0\0\x22\0"),
        "byte 10: the file ends here, expected a header"
    );
}
