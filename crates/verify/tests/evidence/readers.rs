//! One mesh in every format, and what is refused.

use pompeiu_verify::mesh::read;
use std::fmt::Write;

const OBJ: &str =
    "# four\nv 0 0 0\nv 1 0 0 1\nv 0 1 .5\nvn 0 0 1\nv 0.1 0 1\ng x\nf 1 2 3\nf -3/1/1 -2//1 4 # last\n";

#[test]
fn obj_stl_and_ply_state_the_same_triangles() {
    let obj = read(OBJ.as_bytes()).unwrap();
    assert_eq!(obj.faces, [[0, 1, 2], [1, 2, 3]]);
    let single = |x: f64| f64::from(x as f32);
    let corners: Vec<[[f64; 3]; 3]> =
        obj.faces.iter().map(|f| f.map(|i| obj.positions[i as usize])).collect();

    let mut text = "solid x\n".to_owned();
    let mut binary = vec![b'#'; 80];
    binary.extend(2_u32.to_le_bytes());
    for face in &corners {
        text += " facet normal 0 0 1\n outer loop\n";
        binary.extend([0; 12]);
        for p in face {
            writeln!(text, "  VERTEX {} {} {}", p[0], p[1], p[2]).unwrap();
            binary.extend(p.iter().flat_map(|x| (*x as f32).to_le_bytes()));
        }
        text += " endloop\n endfacet\n";
        binary.extend([0; 2]);
    }
    let of = |mesh: pompeiu_verify::mesh::Mesh| -> Vec<[[f64; 3]; 3]> {
        mesh.faces.iter().map(|f| f.map(|i| mesh.positions[i as usize])).collect()
    };
    assert_eq!(of(read((text + "endsolid x\n").as_bytes()).unwrap()), corners);
    assert_eq!(
        of(read(&binary).unwrap()),
        corners.iter().map(|t| t.map(|p| p.map(single))).collect::<Vec<_>>()
    );

    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let mut ply = format!(
            "ply\nformat {format} 1.0\ncomment c\nelement vertex 4\nproperty uchar red\nproperty double x\nproperty double y\nproperty double z\n\
             element edge 1\nproperty list uchar short ends\nelement face 2\nproperty list uchar int vertex_indices\nproperty short k\nend_header\n"
        )
        .into_bytes();
        let is_text = format == "ascii";
        let order = |mut bytes: Vec<u8>| {
            if format == "binary_big_endian" {
                bytes.reverse();
            }
            bytes
        };
        let mut put = |written: String, bytes: Vec<u8>| {
            if is_text { ply.extend(format!("{written} ").bytes()) } else { ply.extend(order(bytes)) }
        };
        for p in &obj.positions {
            put("7".into(), vec![7]);
            for x in p {
                put(x.to_string(), x.to_le_bytes().to_vec());
            }
        }
        put("2".into(), vec![2]);
        for end in [-1_i16, 300] {
            put(end.to_string(), end.to_le_bytes().to_vec());
        }
        for face in &obj.faces {
            put("3".into(), vec![3]);
            for i in face {
                put(i.to_string(), i.to_le_bytes().to_vec());
            }
            put("-5".into(), (-5_i16).to_le_bytes().to_vec());
        }
        assert_eq!(read(&ply).unwrap(), obj, "{format}");
        for length in 0..ply.len() - 2 {
            assert!(read(&ply[..length]).is_err(), "{format} {length}");
        }
    }
}

#[test]
fn what_is_no_mesh_of_triangles_is_refused() {
    for bad in [
        "",
        "v 0 0\n",
        "v 0 0 x\n",
        "v 0 0 0\nf 1 1\n",
        "v 0 0 0\nf 1 1 1 1\n",
        "v 0 0 0\nf 0 1 1\n",
        "v 0 0 0\nf 1 1 -9\n",
        "v 0 0 0\nf 1 1 \\\n1\n",
        "solid\nvertex 0 0 0\nendloop\n",
        "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nend_header\n1\n",
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n4 1 2 3 4\n",
        "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n3 1 2 -3\n",
    ] {
        assert!(read(bad.as_bytes()).is_err(), "{bad}");
    }
}
