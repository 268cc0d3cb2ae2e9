//! Formats that are recognised and not read, with what to do instead.

/// How a file of another kind begins, what it is, and what to do with it.
const BEGINNINGS: [(&[u8], &str, &str); 8] = [
    (b"ISO-10303-21", "a STEP file", EXACT),
    (b"ASTM-E57", "an E57 file", SCANNED),
    (b"LASF", "a LAS file", SCANNED),
    (b"# .PCD", "a PCD file", SCANNED),
    (b"Kaydara FBX Binary", "an FBX file", SCENE),
    (b"BLENDER", "a Blender file", SCENE),
    (b"DBRep_DrawableShape", "a BREP file", EXACT),
    (b"AC10", "a DWG file", EXACT),
];

const EXACT: &str = "with exact surfaces, expected triangles: export it from CAD as STL, 3MF or OBJ, finer than the tolerance in question";
const SCANNED: &str =
    "with scanned points, which is not read: export it as PLY or XYZ, with CloudCompare for example";
const SCENE: &str = "with a scene, which is not read: export it as glTF, OBJ or PLY";

/// Each line of an IGES file has 80 characters, with the letter of its section, and a number.
const SECTION: usize = 72;

/// What the file is and what to do with it; `None` if it is not recognised as one of another kind.
pub(crate) fn advice(bytes: &[u8]) -> Option<String> {
    let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    let known = BEGINNINGS.iter().find(|(beginning, ..)| start.starts_with(beginning));
    let (what, to_do) = match known {
        Some((_, what, to_do)) => (*what, *to_do),
        None if is_iges(bytes) => ("an IGES file", EXACT),
        None => return None,
    };
    Some(format!("{what} {to_do}"))
}

fn is_iges(bytes: &[u8]) -> bool {
    let number = |text: &[u8]| text.trim_ascii() == b"1";
    bytes.get(SECTION) == Some(&b'S') && bytes.get(SECTION + 1..SECTION + 8).is_some_and(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_other_programs_are_known_by_their_beginning() {
        let iges = format!("{:<72}S      1\n", "a part");
        for (bytes, expected) in [
            (&b"ISO-10303-21;\nHEADER;"[..], Some("a STEP file")),
            (b"ASTM-E57\x01\0\0\0", Some("an E57 file")),
            (iges.as_bytes(), Some("an IGES file")),
            (b"solid part", None),
            (b"v 0 0 0", None),
            (b"", None),
        ] {
            let found = advice(bytes);
            assert_eq!(found.is_some(), expected.is_some(), "{found:?}");
            assert!(found.unwrap_or_default().starts_with(expected.unwrap_or_default()));
        }
    }
}
