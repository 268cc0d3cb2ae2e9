//! No bytes make a reader panic, and every accepted input is a valid mesh.

use super::meshes::{file, wavy_sphere};
use pompeiu_io::{Format, OutputFormat, read_bytes};
use pompeiu_testkit::effort::cases;
use proptest::prelude::*;
use std::sync::LazyLock;

const FORMATS: [Format; 4] = [Format::Obj, Format::Ply, Format::Stl, Format::Off];

/// Small valid files of every kind.
static FILES: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let mesh = wavy_sphere(2);
    let mut files: Vec<Vec<u8>> =
        [OutputFormat::Obj, OutputFormat::Ply, OutputFormat::Stl, OutputFormat::Off]
            .map(|f| file(f, &mesh))
            .to_vec();
    for text in [
        "v 0 0 0\nv 1 0 0 1\nv 1 1 0 .1 .2 .3\nv .5 .5 -1e-3\nvn 0 0 1\nf 1/1 2/2/2 3//3 -1\n#\\\nf 1 \\\n 2 3\nf -1 -2\n",
        "ply\nformat ascii 1.0\nelement e 1\nproperty list uchar float l\nelement vertex 3\nproperty float x\n\
         property float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n\
         element tristrips 1\nproperty list int int vertex_indices\nend_header\n2 1 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n5 0 1 2 -1 0\n",
        "ply\nformat binary_big_endian 1.0\nelement face 2\nproperty list uchar uchar vertex_index\n\
         property list ushort short more\nelement vertex 3\nproperty uchar x\nproperty short y\nproperty char z\n\
         end_header\n\x03\0\x01\x02\0\0\x04\0\x01\x02\0\0\x01\0\x05\0\0\0\0\x01\0\0\0\0\0\x01\0",
        "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
        "STCOFF # c\n4 2 0\n0 0 0 1 1\n1 0 0\n1 1 0\n.9 .1 0\n4 0 1 2 3 255 0 0\n3 0 1 2\n",
    ] {
        files.push(text.bytes().collect());
    }
    for file in &files {
        assert!(read_bytes(file, None).is_ok(), "{:?}", read_bytes(file, None).map(|read| read.format));
    }
    files
});

/// Reads the bytes as every format; any result will do.
fn read_as_everything(bytes: &[u8]) {
    for format in FORMATS.map(Some).into_iter().chain([None]) {
        match read_bytes(bytes, format) {
            Ok(read) => assert!(!read.mesh.faces().is_empty()),
            Err(error) => assert!(!error.to_string().contains('\n'), "{error}"),
        }
    }
}

/// One edit of a file.
#[derive(Clone, Debug)]
enum Edit {
    Replace(u8),
    Remove(usize),
    Insert(Vec<u8>),
    Repeat(usize),
    Truncate,
}

fn edit() -> impl Strategy<Value = Edit> {
    let tokens = [
        "-1",
        "0",
        "nan",
        "1e999",
        "4294967295",
        "4294967296",
        "18446744073709551616",
        "\\\n",
        "\r",
        "\n",
        " ",
        "#",
        "/",
        "f ",
        "v ",
        "list",
        "3 0 1 2\n",
        "f 1 2 3 4 5 6\n",
        "\u{0}",
        "\u{FEFF}",
    ];
    prop_oneof![
        any::<u8>().prop_map(Edit::Replace),
        (1_usize..20).prop_map(Edit::Remove),
        prop::sample::select(tokens.to_vec()).prop_map(|token| Edit::Insert(token.bytes().collect())),
        prop::collection::vec(any::<u8>(), 1..9).prop_map(Edit::Insert),
        (1_usize..200).prop_map(Edit::Repeat),
        Just(Edit::Truncate),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(2000)))]

    #[test]
    fn any_bytes(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        read_as_everything(&bytes);
    }

    #[test]
    fn any_text(text in "[-v fn0-9/.\\\\#\r\n]{0,200}") {
        read_as_everything(text.as_bytes());
    }

    #[test]
    fn edited_files(which in any::<prop::sample::Index>(), edits in prop::collection::vec((any::<prop::sample::Index>(), edit()), 1..6)) {
        let mut bytes = which.get(&FILES).clone();
        for (place, edit) in edits {
            if bytes.is_empty() {
                break;
            }
            let at = place.index(bytes.len());
            match edit {
                Edit::Replace(byte) => bytes[at] = byte,
                Edit::Remove(count) => drop(bytes.drain(at..(at + count).min(bytes.len()))),
                Edit::Insert(token) => drop(bytes.splice(at..at, token)),
                Edit::Repeat(count) => {
                    let part = bytes[at..(at + count).min(bytes.len())].to_vec();
                    bytes.splice(at..at, part);
                }
                Edit::Truncate => bytes.truncate(at),
            }
        }
        read_as_everything(&bytes);
    }
}
