//! Mesh files: what the reader takes is written and read back as it was, and the small reader of the verifier, which shares no code
//! with it, reads the same triangles.

use pompeiu::core::TriMesh;
use pompeiu::core::mesh::Precision;
use pompeiu::io::{Attributes, Format, OutputFormat, encode, read_bytes};
use pompeiu_verify::Soup;

/// Corners of polygons in the order of the file cannot be told from triangles after they were cut; faces that were left out are in no mesh.
pub(crate) fn run(bytes: &[u8]) {
    let Ok(read) = read_bytes(bytes, None) else {
        // A format that is named by the suffix of a file rather than found in its content.
        for format in Format::ALL {
            drop(read_bytes(bytes, Some(format)));
        }
        drop(pompeiu_verify::mesh::read(bytes));
        return;
    };
    let is_triangles = read.polygons_triangulated == 0 && read.faces_dropped == 0 && !read.compressed;
    if is_triangles && matches!(read.format, Format::Obj | Format::Stl | Format::Ply) {
        agrees_with_the_small_reader(&read.mesh, bytes);
    }
    comes_back(&read.mesh);
}

/// Where both readers take a file, they find the same triangles: the hash of a certificate made from one is that of the other.
fn agrees_with_the_small_reader(mesh: &TriMesh, bytes: &[u8]) {
    let Ok(small) = pompeiu_verify::mesh::read(bytes) else { return };
    let Some(soup) = Soup::new(&small.positions, &small.faces) else { return };
    let own = Soup::new(mesh.positions(), mesh.faces()).expect("a mesh is finite and has a face");
    assert_eq!(soup.hash(), own.hash(), "the two readers find other triangles");
}

/// What keeps every bit keeps every bit.
fn comes_back(mesh: &TriMesh) {
    for format in OutputFormat::ALL {
        let mut written = Vec::new();
        // Some meshes have no place in a format: coordinates beyond single precision, for one.
        if encode(&mut written, format, mesh, &Attributes::for_mesh(mesh)).is_err() {
            continue;
        }
        let back = read_bytes(&written, None).expect("what was written is read").mesh;
        assert_eq!(back.faces().len(), mesh.faces().len(), "{format:?}");
        if format.precision() == Precision::Double {
            assert!(back.positions() == mesh.positions() && back.faces() == mesh.faces(), "{format:?}");
        }
    }
}
