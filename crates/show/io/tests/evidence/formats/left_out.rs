//! What files have besides their surface is named.

use super::three_mf::archive;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_io::{Attributes, OutputFormat, encode, read, read_appearance};
use std::fs;

/// What is named of a file.
fn named(name: &str, content: impl AsRef<[u8]>) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, content).unwrap();
    let mesh = read(&path).unwrap().mesh;
    read_appearance(&path, &mesh).unwrap().left_out
}

const NOTHING: [&str; 0] = [];

#[test]
fn normals_smoothing_and_groups_of_obj() {
    let corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let all = format!("o part\ng first\n{corners}vn 0 0 1\ns 1\nf 1//1 2//1 3//1\ng second\nf 1 3 2\n");
    assert_eq!(named("all.obj", all), ["normals", "smoothing groups", "names of groups"]);
    assert_eq!(named("one.obj", format!("o part\n{corners}s off\nf 1 2 3\n")), NOTHING);
}

#[test]
fn properties_and_elements_of_ply() {
    let header =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    let rows = "0 0 0 1 2 3 4\n1 0 0 1 2 3 4\n0 1 0 1 2 3 4\n3 0 1 2 9\n";
    let all = format!(
        "{header}property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n\
         element face 1\nproperty list uchar int vertex_indices\nproperty float quality\n\
         element camera 1\nproperty float focus\nend_header\n{rows}5\n"
    );
    let expected = [
        "properties \"alpha\" of element vertex",
        "properties \"quality\" of element face",
        "elements \"camera\"",
    ];
    assert_eq!(named("all.ply", all), expected);
    let plain = format!(
        "{header}element face 1\nproperty list uchar int vertex_indices\nelement edge 0\nproperty int from\nend_header\n\
         0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
    );
    assert_eq!(named("plain.ply", plain), NOTHING);
}

#[test]
fn colours_and_normals_of_off() {
    let all = "STCNOFF\n3 1 0\n0 0 0 0 0 1 1 0 0 1 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n";
    let expected = ["colours of vertices", "normals", "texture coordinates", "colours of faces"];
    assert_eq!(named("all.off", all), expected);
    assert_eq!(named("plain.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 # no colour\n"), NOTHING);
}

#[test]
fn attributes_of_stl() {
    let mut bytes = Vec::new();
    let mesh = icosphere(1.0, 1).unwrap();
    encode(&mut bytes, OutputFormat::Stl, &mesh, &Attributes::for_mesh(&mesh)).unwrap();
    assert_eq!(named("plain.stl", &bytes), NOTHING);
    let last = bytes.len() - 1;
    bytes[last] = 0x80;
    assert_eq!(named("colored.stl", &bytes), ["attributes of triangles, which may be colours,"]);
}

#[test]
fn arrays_of_vtk() {
    let mesh = icosphere(1.0, 1).unwrap();
    for format in [OutputFormat::Vtp, OutputFormat::Vtu] {
        let name = format!("mesh.{}", format.suffix());
        for has in [false, true] {
            let mut attributes = Attributes::for_mesh(&mesh);
            if has {
                let heights = mesh.positions().iter().map(|p| p[2]).collect();
                attributes = attributes.with_vertex_scalar("height", heights).unwrap();
                let areas = vec![1.0; mesh.faces().len()];
                attributes = attributes.with_face_scalar("area", areas).unwrap();
            }
            let mut bytes = Vec::new();
            encode(&mut bytes, format, &mesh, &attributes).unwrap();
            let expected: &[&str] = if has { &["arrays \"area\", \"height\""] } else { &[] };
            assert_eq!(named(&name, bytes), expected);
        }
    }
    let legacy = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n";
    assert_eq!(named("plain.vtk", legacy), NOTHING);
    let with_data = format!("{legacy}POINT_DATA 3\nSCALARS height float\nLOOKUP_TABLE default\n0 1 2\n");
    assert_eq!(named("data.vtk", with_data), ["data of points and cells"]);
}

#[test]
fn resources_of_3mf() {
    let object = |id: u32| {
        format!(
            "<object id='{id}'><mesh><vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/>\
             <vertex x='0' y='1' z='0'/></vertices><triangles><triangle v1='0' v2='1' v3='2'/></triangles></mesh></object>"
        )
    };
    let model = |resources: &str| {
        let text =
            format!("<model><resources>{resources}</resources><build><item objectid='1'/></build></model>");
        archive(&[("3D/3dmodel.model", &text)])
    };
    assert_eq!(named("plain.3mf", model(&object(1))), NOTHING);
    let colors = "<basematerials id='7'/><m:colorgroup id='8'><m:color color='#f00'/></m:colorgroup>";
    let all = model(&format!("{colors}{}{}", object(1), object(2)));
    assert_eq!(named("all.3mf", all), ["colours", "materials", "separate objects"]);
}
