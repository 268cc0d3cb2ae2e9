//! Solid cells of VTK and VTU files.

use pompeiu_io::{SurfaceOrSolid, read_hexahedra, read_surface_or_solid, read_tetrahedra};
use std::fs;

const LEGACY: &str = "# vtk DataFile Version 3.0
two
ASCII
DATASET UNSTRUCTURED_GRID
POINTS 5 double
0 0 0  1 0 0  0 1 0  0 0 1  1 1 1
CELLS 3 14
4 0 1 2 3
3 0 1 2
4 1 2 3 4
CELL_TYPES 3
10 5 10
";

const XML: &str = r#"<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells></Piece>
<Piece NumberOfPoints="4" NumberOfCells="1"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">
5 0 0 6 0 0 5 1 0 5 0 1</DataArray></Points><Cells>
<DataArray type="Int32" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int32" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells></Piece>
</UnstructuredGrid></VTKFile>
"#;

#[test]
fn tetrahedra_are_read_without_the_cells_beside_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.vtk");
    fs::write(&path, LEGACY).unwrap();
    let found = read_tetrahedra(&path).unwrap();
    assert_eq!((found.positions.len(), found.cells), (5, vec![[0, 1, 2, 3], [1, 2, 3, 4]]));
    let path = folder.path().join("two.vtu");
    fs::write(&path, XML).unwrap();
    let found = read_tetrahedra(&path).unwrap();
    assert_eq!(found.cells, [[0, 1, 2, 3], [4, 5, 6, 7]]);
    assert_eq!(found.positions[7], [5.0, 0.0, 1.0]);
}

#[test]
fn other_cells_and_corners_that_do_not_exist_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wrong.vtk");
    for (from, to, words) in [
        (
            "10 5 10",
            "10 5 24",
            "a tetrahedron of ten points (VTK's type 24), expected tetrahedra (10); split",
        ),
        ("4 1 2 3 4", "4 1 2 3 9", "corner 9, but there are 5 points"),
        ("10 5 10", "10 10 10", "a tetrahedron with 3 corners, expected 4"),
    ] {
        fs::write(&path, LEGACY.replace(from, to)).unwrap();
        let message = read_tetrahedra(&path).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    }
    fs::write(&path, LEGACY).unwrap();
    let message = read_hexahedra(&path).unwrap_err().to_string();
    assert!(message.contains("a tetrahedron (VTK's type 10), expected hexahedra (12)"), "{message}");
}

#[test]
fn a_file_is_a_solid_where_it_has_tetrahedra_and_else_a_surface() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("either.vtk");
    fs::write(&path, LEGACY).unwrap();
    assert!(
        matches!(read_surface_or_solid(&path), Ok(SurfaceOrSolid::Solid(solid)) if solid.cells.len() == 2)
    );
    let surface = LEGACY.replace("4 0 1 2 3", "3 0 1 3").replace("4 1 2 3 4", "3 1 2 3");
    fs::write(&path, surface.replace("3 14", "3 12").replace("10 5 10", "5 5 5")).unwrap();
    assert!(
        matches!(read_surface_or_solid(&path), Ok(SurfaceOrSolid::Surface(read)) if read.mesh.faces().len() == 3)
    );
    assert!(read_surface_or_solid(folder.path().join("missing.vtk")).is_err());
}

#[test]
fn solid_cells_that_are_no_tetrahedra_are_refused_with_what_to_do() {
    let folder = tempfile::tempdir().unwrap();
    let replaced = |text: &str| text.replace(">10<", ">13<").replace("10 5 10", "12 5 12");
    for (name, text, words) in [
        ("prism.vtu", replaced(XML), "a wedge (VTK's type 13), expected tetrahedra (10); split the cells"),
        ("hexahedron.vtk", replaced(LEGACY), "a hexahedron (VTK's type 12), expected tetrahedra (10); split"),
    ] {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        let message = read_surface_or_solid(&path).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    }
}
