//! OFF, read back word by word.

use super::encoded;
use super::meshes::{any_colors, any_mesh, bits, colored};
use pompeiu_io::{Attributes, OutputFormat};
use proptest::prelude::*;

fn words(bytes: Vec<u8>) -> Vec<Vec<String>> {
    let text = String::from_utf8(bytes).unwrap();
    text.lines().map(|line| line.split(' ').map(str::to_owned).collect()).collect()
}

proptest! {
    #[test]
    fn rows_hold_what_was_given((mesh, attributes) in colored(any_mesh())) {
        let rows = words(encoded(OutputFormat::Off, &mesh, &attributes));
        let (n, m) = (mesh.positions().len(), mesh.faces().len());
        prop_assert_eq!(&rows[0], &["COFF"]);
        prop_assert_eq!(&rows[1], &[n.to_string(), m.to_string(), "0".into()]);
        prop_assert_eq!(rows.len(), 2 + n + m);
        let (vertices, faces) = rows[2..].split_at(n);
        let positions: Vec<_> = vertices.iter().map(|row| [0, 1, 2].map(|k| row[k].parse().unwrap())).collect();
        prop_assert_eq!(bits(&positions), bits(mesh.positions()));
        let color = |row: &Vec<String>| [3, 4, 5].map(|k| row[k].parse::<u8>().unwrap());
        prop_assert_eq!(&vertices.iter().map(color).collect::<Vec<_>>(), attributes.vertex_colors().unwrap());
        prop_assert!(vertices.iter().all(|row| row.len() == 7 && row[6] == "255"));
        for (row, face) in faces.iter().zip(mesh.faces()) {
            prop_assert_eq!(row, &[3, face[0], face[1], face[2]].map(|i| i.to_string()));
        }
    }

    #[test]
    fn face_colors_follow_the_corners(
        (mesh, colors) in any_mesh().prop_flat_map(|mesh| (any_colors(mesh.faces().len()), Just(mesh)))
            .prop_map(|(colors, mesh)| (mesh, colors))
    ) {
        let attributes = Attributes::for_mesh(&mesh).with_face_colors(colors.clone()).unwrap();
        let rows = words(encoded(OutputFormat::Off, &mesh, &attributes));
        prop_assert_eq!(&rows[0], &["OFF"]);
        for (row, color) in rows[2 + mesh.positions().len()..].iter().zip(colors) {
            prop_assert_eq!(&row[4..], &color.map(|c| c.to_string()));
        }
    }
}
