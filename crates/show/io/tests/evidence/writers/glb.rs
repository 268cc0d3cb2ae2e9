//! GLB, read back and validated by the `gltf` crate.

use super::encoded;
use super::meshes::{colored, single_precision_mesh, tetrahedron};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_io::{Attributes, EncodeError, OutputFormat, encode};
use proptest::prelude::*;

struct Read {
    translation: [f64; 3],
    positions: Vec<[f32; 3]>,
    faces: Vec<[u32; 3]>,
    colors: Option<Vec<[u16; 4]>>,
    bounds: [[f32; 3]; 2],
}

fn read(bytes: &[u8]) -> Read {
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(bytes).unwrap();
    let blob = blob.unwrap();
    let node = document.default_scene().unwrap().nodes().next().unwrap();
    let (translation, rotation, scale) = node.transform().decomposed();
    assert_eq!((rotation, scale), ([0.0, 0.0, 0.0, 1.0], [1.0; 3]));
    let mesh = node.mesh().unwrap();
    let primitive = mesh.primitives().next().unwrap();
    let reader = primitive.reader(|_| Some(&blob));
    let corners: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
    let bounds = primitive.bounding_box();
    Read {
        translation: translation.map(f64::from),
        positions: reader.read_positions().unwrap().collect(),
        faces: corners.as_chunks().0.to_vec(),
        colors: reader.read_colors(0).map(|colors| colors.into_rgba_u16().collect()),
        bounds: [bounds.min, bounds.max],
    }
}

fn check_bounds(read: &Read) {
    for axis in 0..3 {
        let mut values: Vec<f32> = read.positions.iter().map(|p| p[axis]).collect();
        values.sort_by(f32::total_cmp);
        assert_eq!([read.bounds[0][axis], read.bounds[1][axis]], [values[0], values[values.len() - 1]]);
    }
}

/// The sRGB value of a linear channel, by the inverse of IEC 61966-2-1.
fn srgb(linear: u16) -> u8 {
    let linear = f64::from(linear) / 65535.0;
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded).round() as u8
}

/// `shift` moves a mesh of size one away from the origin along each axis.
fn shifted_mesh() -> impl Strategy<Value = (TriMesh, [f64; 3])> {
    let shift = [-1e9..1e9, -10.0..10.0, -1e30..1e30];
    (prop::collection::vec([0.0..1.0, 0.0..1.0, 0.0..1.0], 3..20), shift).prop_map(|(points, shift)| {
        let positions = points.iter().map(|p: &[f64; 3]| [0, 1, 2].map(|k| p[k] + shift[k])).collect();
        (TriMesh::new(positions, vec![[0, 1, 2]]).unwrap(), shift)
    })
}

proptest! {
    #[test]
    fn mesh_and_colors((mesh, attributes) in colored(single_precision_mesh())) {
        let bytes = encoded(OutputFormat::Glb, &mesh, &attributes);
        prop_assert_eq!(bytes.len() % 4, 0);
        let read = read(&bytes);
        // The vertices of the mesh come first, further ones with other normals after them.
        let first = mesh.positions().len();
        prop_assert!(read.positions.len() >= first);
        check_bounds(&read);
        let colors: Vec<[u8; 3]> = read.colors.unwrap().iter().map(|c| [0, 1, 2].map(|k| srgb(c[k]))).collect();
        prop_assert_eq!(&colors[..first], attributes.vertex_colors().unwrap());
        for (face, corners) in mesh.faces().iter().zip(&read.faces) {
            for (v, w) in face.iter().zip(corners) {
                prop_assert_eq!(read.positions[*w as usize], read.positions[*v as usize]);
                prop_assert_eq!(colors[*w as usize], colors[*v as usize]);
            }
        }
    }

    #[test]
    fn single_precision_numbers_keep_every_bit(mesh in single_precision_mesh()) {
        let positions = mesh.positions().iter().map(|p| p.map(|x| f64::from(x as f32))).collect();
        let mesh = TriMesh::new(positions, mesh.faces().to_vec()).unwrap();
        let read = read(&encoded(OutputFormat::Glb, &mesh, &Attributes::for_mesh(&mesh)));
        prop_assert_eq!(read.translation, [0.0; 3]);
        let same = read.positions.iter().zip(mesh.positions()).all(|(p, q)| {
            p.map(|x| f64::from(x).to_bits()) == q.map(f64::to_bits)
        });
        prop_assert!(same);
    }

    #[test]
    fn far_from_the_origin_the_shape_survives((mesh, shift) in shifted_mesh()) {
        let read = read(&encoded(OutputFormat::Glb, &mesh, &Attributes::for_mesh(&mesh)));
        check_bounds(&read);
        for (written, position) in read.positions.iter().zip(mesh.positions()) {
            for axis in 0..3 {
                // The rounding of `shift` to single precision moves the centre, and the error scales with it.
                let reach = 1.0 + shift[axis].abs() * f64::from(f32::EPSILON);
                let difference = f64::from(written[axis]) + read.translation[axis] - position[axis];
                let allowed = 0.5 * f64::from(f32::EPSILON) * reach + f64::EPSILON * shift[axis].abs();
                prop_assert!(difference.abs() <= allowed, "axis {axis}: off by {difference:e}, allowed {allowed:e}");
            }
        }
    }
}

#[test]
fn vertices_at_one_place_stay_apart() {
    let mesh =
        TriMesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]], vec![[0, 1, 2], [3, 2, 1]])
            .unwrap();
    let bytes = encoded(OutputFormat::Glb, &mesh, &Attributes::for_mesh(&mesh));
    let gltf::Gltf { document, .. } = gltf::Gltf::from_slice(&bytes).unwrap();
    let primitive = document.meshes().next().unwrap().primitives().next().unwrap();
    assert!(primitive.get(&gltf::Semantic::Extras("VERTEX".to_owned())).is_some());
    // Each face has its own vertices along the sharp edge; those of the mesh come first.
    assert_eq!(read(&bytes).positions.len(), 6);
}

#[test]
fn overflow_is_an_error_before_the_first_byte() {
    let mesh = TriMesh::new(vec![[0.0; 3], [0.0, 0.0, -1e39]], vec![[0, 1, 0]]).unwrap();
    let mut bytes = Vec::new();
    let error = encode(&mut bytes, OutputFormat::Glb, &mesh, &Attributes::for_mesh(&mesh)).unwrap_err();
    assert!(matches!(error, EncodeError::SinglePrecision { vertex: VertexId(1), axis: 2, value: -1e39, .. }));
    assert!(bytes.is_empty());
}

#[test]
fn layout_follows_the_specification() {
    let mesh = tetrahedron();
    let attributes = Attributes::for_mesh(&mesh).with_vertex_colors(vec![[0, 128, 255]; 4]).unwrap();
    let bytes = encoded(OutputFormat::Glb, &mesh, &attributes);
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&bytes[..4], word(4), word(8)), (&b"glTF"[..], 2, bytes.len()));
    let json_length = word(12);
    assert_eq!((&bytes[16..20], json_length % 4), (&b"JSON"[..], 0));
    // At the sharp corners of a tetrahedron each of its faces has vertices of its own: twelve positions, normals, colours and indices.
    let content = 12 * (12 + 12 + 8 + 4);
    assert_eq!(word(20 + json_length), content);
    assert_eq!(&bytes[24 + json_length..28 + json_length], b"BIN\0");
    assert_eq!(bytes.len(), 28 + json_length + content);
    // 128 in sRGB is 21.586 % of the light of 255 (computed by hand from the standard).
    assert_eq!(
        read(&bytes).colors.unwrap()[3],
        [0, (0.215_860_5_f64 * 65535.0).round() as u16, 65535, 65535]
    );
}

#[test]
fn textures_are_seen_where_they_belong() {
    let (mesh, places, corners) = super::obj::with_seams();
    let image = b"five!".to_vec();
    let attributes = Attributes::for_mesh(&mesh)
        .with_texture(places.clone(), corners.clone(), Some(image.clone()))
        .unwrap()
        .with_vertex_colors(vec![[0; 3], [255; 3], [0; 3], [0; 3]])
        .unwrap();
    let bytes = encoded(OutputFormat::Glb, &mesh, &attributes);
    assert_eq!(bytes.len() % 4, 0);
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(&bytes).unwrap();
    let blob = blob.unwrap();
    let primitive = document.meshes().next().unwrap().primitives().next().unwrap();
    let reader = primitive.reader(|_| Some(&blob));
    let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
    let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
    let uv: Vec<[f32; 2]> = reader.read_tex_coords(0).unwrap().into_f32().collect();
    let colors: Vec<[u16; 4]> = reader.read_colors(0).unwrap().into_rgba_u16().collect();
    assert_eq!([uv.len(), colors.len()], [positions.len(); 2]);
    for (f, face) in mesh.faces().iter().enumerate() {
        for i in 0..3 {
            let at = indices[3 * f + i] as usize;
            assert_eq!(positions[at].map(f64::from), mesh.positions()[face[i] as usize]);
            assert_eq!(colors[at][0] > 0, face[i] == 1);
            let [u, v] = places[corners[f][i] as usize];
            assert_eq!(uv[at], [u as f32, (1.0 - v) as f32]);
        }
    }
    let texture = primitive.material().pbr_metallic_roughness().base_color_texture().unwrap();
    let gltf::image::Source::View { view, mime_type } = texture.texture().source().source() else { panic!() };
    assert_eq!((mime_type, &blob[view.offset()..view.offset() + view.length()]), ("image/png", &image[..]));
}
