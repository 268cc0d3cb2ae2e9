//! Our readers read what our writers write.

use super::{read_as, triangles};
use pompeiu_core::TriMesh;
use pompeiu_io::{Attributes, Format, OutputFormat, encode, read, read_bytes, write};
use proptest::prelude::*;

/// The double with these bits; where it would be too large, without the top bit of the exponent.
fn supported(bits: u64) -> f64 {
    let value = f64::from_bits(bits);
    if value.abs() <= TriMesh::MAX_COORDINATE { value } else { f64::from_bits(bits & !(1 << 62)) }
}

fn mesh_of(coordinate: impl Strategy<Value = f64> + Clone) -> impl Strategy<Value = TriMesh> {
    let position = [coordinate.clone(), coordinate.clone(), coordinate];
    prop::collection::vec(position, 1..40).prop_flat_map(|positions| {
        let n = positions.len() as u32;
        prop::collection::vec([0..n, 0..n, 0..n], 1..60)
            .prop_map(move |faces| TriMesh::new(positions.clone(), faces).unwrap())
    })
}

fn any_mesh() -> impl Strategy<Value = TriMesh> {
    mesh_of(any::<u64>().prop_map(supported).boxed())
}

fn encoded(format: OutputFormat, mesh: &TriMesh) -> Vec<u8> {
    let colors = mesh.positions().iter().map(|p| p.map(|x| x.to_bits() as u8)).collect();
    let mut attributes = Attributes::for_mesh(mesh);
    if format != OutputFormat::Stl {
        attributes = attributes.with_vertex_colors(colors).unwrap();
    }
    if format.holds_scalars() {
        let values = (0..mesh.faces().len()).map(|f| 1.0 / f as f64).collect();
        attributes = attributes.with_face_scalar("value", values).unwrap();
    }
    let mut bytes = Vec::new();
    encode(&mut bytes, format, mesh, &attributes).unwrap();
    bytes
}

fn same_bits(a: &TriMesh, b: &TriMesh) -> bool {
    let bits = |mesh: &TriMesh| mesh.positions().iter().map(|p| p.map(f64::to_bits)).collect::<Vec<_>>();
    bits(a) == bits(b) && a.faces() == b.faces()
}

proptest! {
    #[test]
    fn doubles_keep_every_bit(mesh in any_mesh()) {
        for (output, format) in [
            (OutputFormat::Obj, Format::Obj),
            (OutputFormat::Ply, Format::Ply),
            (OutputFormat::Off, Format::Off),
            (OutputFormat::Vtp, Format::Vtp),
            (OutputFormat::Vtu, Format::Vtu),
        ] {
            let bytes = encoded(output, &mesh);
            let read = read_bytes(&bytes, None).unwrap();
            prop_assert_eq!(read.format, format);
            prop_assert!(same_bits(&read.mesh, &mesh), "{}", format);
        }
    }

    #[test]
    fn glb_keeps_single_precision_numbers(mesh in mesh_of(any::<f32>().prop_map(f64::from).boxed())) {
        let read = read_bytes(&encoded(OutputFormat::Glb, &mesh), None).unwrap();
        prop_assert_eq!(read.format, Format::Glb);
        prop_assert!(same_bits(&read.mesh, &mesh));
    }

    #[test]
    fn stl_rounds_corners_to_single_precision(mesh in mesh_of((-1e6..1e6).boxed())) {
        let read = read_bytes(&encoded(OutputFormat::Stl, &mesh), None).unwrap();
        prop_assert_eq!(read.format, Format::Stl);
        let rounded: Vec<_> = triangles(&mesh).iter().map(|t| t.map(|p| p.map(|x| f64::from(x as f32)))).collect();
        prop_assert_eq!(triangles(&read.mesh), rounded);
    }

    #[test]
    fn glb_far_from_the_origin(mesh in mesh_of((1e6..1e6 + 1.0_f64).boxed())) {
        let read = read_as(Format::Glb, &encoded(OutputFormat::Glb, &mesh));
        for (a, b) in triangles(&read.mesh).as_flattened().iter().zip(triangles(&mesh).as_flattened()) {
            for axis in 0..3 {
                // Half a unit in the last place of single precision at 1/2 + 1/16, the largest coordinate after recentring on a
                // single-precision number, plus the rounding of two sums of doubles at 10⁶.
                prop_assert!((a[axis] - b[axis]).abs() <= 0.5 * f64::from(f32::EPSILON) * 0.5 + 2e-10);
            }
        }
    }
}

#[test]
fn files_with_and_without_compression() {
    let folder = tempfile::tempdir().unwrap();
    let mesh =
        TriMesh::new(vec![[0.5, -1.0, 0.25], [3.0, 0.0, 0.0], [0.0, 2.0, 0.0]], vec![[0, 1, 2]]).unwrap();
    for suffix in ["obj", "ply", "off", "vtp", "vtu", "glb", "3mf", "obj.gz", "vtp.gz", "glb.gz"] {
        let path = folder.path().join(format!("mesh.{suffix}"));
        write(&path, &mesh).unwrap();
        let read = read(&path).unwrap();
        assert!(same_bits(&read.mesh, &mesh), "{suffix}");
        assert_eq!(read.compressed, suffix.ends_with("gz"));
    }
}
